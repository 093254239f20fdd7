#pragma once
/// \file  Private: the parts of the WAMIT reader. Symbols as in the numeric files: PER is the first column, whatever it
/// means.
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"
#include "wamit_table.hpp"

namespace hydro::potential {

/// What a dimensionless entry of (i, j) is multiplied by beside ρ (and ω, g): L^3, L^4, L^5 for A and B, one power less
/// for C; the power grows by one for each rotation (P8).
double added_mass_scale(Eigen::Index i, Eigen::Index j, double ulen);
double restoring_scale(Eigen::Index i, Eigen::Index j, double ulen);
double excitation_scale(Eigen::Index i, double ulen);  ///< L^2 for forces, L^3 for moments

/// All rows of one PER of a .1 file, still dimensionless.
struct RadiationBlock {
  double per;
  WamitTable::Row first_row;
  Eigen::MatrixXd A, B;
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> present;
};

/// ω of a positive PER under IPEROUT (P9).
double frequency_of_per(double per, int iperout, const Water& water, double ulen);

/// Which of the blocks with PER < 0 and PER = 0 is A(0) and which A(∞), dimensionless.
struct WamitLimits {
  const RadiationBlock* zero = nullptr;
  const RadiationBlock* infinite = nullptr;
  std::optional<std::string> note;
};
/// `finite` is ascending in ω. IPEROUT = 1: PER < 0 is ω → 0 and PER = 0 is ω → ∞. Otherwise both meanings are in use,
/// and continuity with the neighbouring frequencies decides (P9).
/// \throws InputError if it does not decide
WamitLimits assign_limits(const RadiationBlock* negative, const RadiationBlock* zero,
                          const std::vector<const RadiationBlock*>& finite, int iperout, const WamitTable& table);

/// Excitation of a .3 file into `c`, whose frequencies have the values `per` in the .1 file.
/// \throws InputError with the line for another PER, a mode beyond the bodies, a row twice, or a row that is missing
void fill_excitation(Coefficients& c, const WamitTable& table, const std::vector<double>& per, double ulen);

/// A sentence if the coefficients would look clearly better with the order of frequencies turned round, which is what a
/// wrong IPEROUT does: limits that join the wrong ends, or heave excitation that grows with frequency.
std::optional<std::string> sign_of_wrong_iperout(const Coefficients& coefficients);

}  // namespace hydro::potential
