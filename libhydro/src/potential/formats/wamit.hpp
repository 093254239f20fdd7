#pragma once
/// \file  Private: the parts of the WAMIT reader. Symbols as in the numeric files: PER is the first column, whatever it
/// means.
#include <Eigen/Core>

#include <filesystem>
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

/// What PER is: WAMIT's IPEROUT 1 to 4 (P9), and the wavelength, which HAMS can write (P23).
enum class FirstColumn { period = 1, omega = 2, deep_wavenumber = 3, wavenumber = 4, wavelength = 5 };

/// ω of a positive PER (P9).
double frequency_of_per(double per, FirstColumn column, const Water& water, double ulen);

/// Which of the blocks with PER < 0 and PER = 0 is A(0) and which A(∞), dimensionless.
struct WamitLimits {
  const RadiationBlock* zero = nullptr;
  const RadiationBlock* infinite = nullptr;
  std::optional<std::string> note;
};
/// `finite` is ascending in ω. Periods and lengths: PER < 0 is ω → 0 and PER = 0 is ω → ∞. Otherwise both meanings are
/// in use, and continuity with the neighbouring frequencies decides (P9). \throws InputError if it does not decide
WamitLimits assign_limits(const RadiationBlock* negative, const RadiationBlock* zero,
                          const std::vector<const RadiationBlock*>& finite, FirstColumn column,
                          const WamitTable& table);

/// Excitation of a .3 file into `c`, whose frequencies have the values `per` in the .1 file.
/// \throws InputError with the line for another PER, a mode beyond the bodies, a row twice, or a row that is missing
void fill_excitation(Coefficients& c, const WamitTable& table, const std::vector<double>& per, double ulen);

/// The files of one run that Froude reads; a path need not exist, except that of `radiation`.
struct WamitFiles {
  std::filesystem::path radiation;
  std::string stem;
  std::filesystem::path member(const char* extension) const { return stem + extension; }
};

/// Seven digits are printed, six in .3fk and .3sc; two files of one run agree to half of the last of them.
constexpr double per_tolerance = 5.5e-6;

/// The set of files, from any of them or from the stem. \throws InputError if there is no .1 file
WamitFiles find_wamit_files(const std::filesystem::path& path);

/// The bodies whose modes stand in these columns, from 1; `told` by the .out file, where there is one.
/// \throws InputError naming generalised modes if the modes are not six a body
int count_bodies(const WamitTable& table, const std::vector<std::size_t>& columns, std::optional<int> told);

/// Everything that the numeric files leave unsaid.
struct WamitRun {
  Water water;
  FirstColumn column = FirstColumn::period;
  double ulen = 1;
  TimeFactor time_factor = TimeFactor::plus_i_omega_t;
  std::optional<int> bodies = {};  ///< as the .out file tells
};

/// Radiation, excitation and restoring of a set of numeric files, whoever wrote them.
Coefficients read_numeric_files(const WamitFiles& files, const WamitRun& run);

/// A sentence on rows whose modulus and phase are not those of the real and imaginary part behind them, which are what
/// is used; `modulus` is its column.
std::optional<std::string> note_on_phases(const WamitTable& table, std::size_t modulus);

/// What a .out file says of water and bodies.
struct WamitOut {
  double gravity, ulen;
  std::optional<double> density = {};  ///< only some versions write it
  WaterDepth depth = WaterDepth::infinite();
  std::vector<BodyData> body;
  std::vector<std::string> notes;
};
/// \throws InputError with the line for a .out file without these statements, or with bodies turned about the vertical
WamitOut read_wamit_out(const std::filesystem::path& path);

/// What a file's numbers need to be known of the water.
struct WamitNeeds {
  bool density = true, gravity = true, depth = true;
};

/// What is known of the run of `file`: the caller's word and the .out file's, which is believed where they differ (then
/// with a note). What is neither needed nor stated has the values of Water{}. \throws InputError for what is needed
/// and not stated
WamitRun run_of(const ReadOptions& options, const std::optional<WamitOut>& out, const WamitNeeds& needs,
                const std::filesystem::path& file, std::vector<std::string>& notes);

/// What to refuse phases with, and what to do about them.
struct WrongPhases {
  std::string rule, remedy;
};

/// If long waves of every heading push the bodies the wrong way, and heave does not say that the time factor is right:
/// then the phases are of e^{−iωt} (P21).
std::optional<WrongPhases> sign_of_other_time_factor(const Coefficients& coefficients);

/// A sentence if the coefficients would look clearly better with the order of frequencies turned round, which is what a
/// wrong IPEROUT does: limits that join the wrong ends, or heave excitation that grows with frequency.
std::optional<std::string> sign_of_wrong_iperout(const Coefficients& coefficients);

}  // namespace hydro::potential
