#pragma once
/// \file  Damping beyond the end of its table, told by the added mass inside it.
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "hydro/radiation/kernel.hpp"

namespace hydro::radiation {

/// A damping table extrapolated to four times its last frequency, with the added mass that belongs to it.
struct ExtrapolatedDamping {
  DampingTable table;     ///< the given one, then the tail at the same spacing, down to zero
  Eigen::MatrixXd A_inf;  ///< the constant that belongs to the table: the limit given or found, less what the tail
                          ///< leaves at slow motions, (n, n)
  double
      misfit;  ///< rms of what A(ω) differs by up to 0.6 of the given table's end, relative to √(A_ii A_jj), worst pair
  double shift;  ///< of A_inf from the limit given or found with the tail, relative as misfit
};

/// Where a table ends before its damping has died away, the waves beyond the end act as added mass on slower motions
/// (Kramers and Kronig, (R10)): from A(ω) inside the table follows B beyond it, as a polygon with seven corners, fitted
/// by least squares with a preference for straightness (R11). Without this a run would differ from the frequency domain
/// by what is cut.
///
/// `A`: one matrix a frequency of the table. Modes whose damping has died away get a tail of next to nothing.
/// \throws InputError as RetardationKernel::from_damping, or if the sizes disagree
ExtrapolatedDamping extrapolated(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                                 const std::optional<Eigen::MatrixXd>& A_inf);

/// A(ω) − A∞ that belongs to a damping table, cubic between its frequencies and nothing beyond the last, by Kramers and
/// Kronig (R10), (n, n).
Eigen::MatrixXd added_mass_above_limit(const DampingTable& damping, double omega);

/// The way back: B(ω) from added mass at the frequencies `given`, cubic between them, its first value kept down to ω =
/// 0 and its limit A∞ beyond the last, (n, n). (R21)
Eigen::MatrixXd damping_from_added_mass(const std::vector<double>& given, const std::vector<Eigen::MatrixXd>& A,
                                        const Eigen::MatrixXd& A_inf, double omega);

}  // namespace hydro::radiation
