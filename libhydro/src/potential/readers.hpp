#pragma once
/// \file  Private to hydro/potential: one function per format, and what they share.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

Coefficients read_wamit(const std::filesystem::path& path, const ReadOptions& options);
Coefficients read_capytaine(const std::filesystem::path& path);
Coefficients read_bemio(const std::filesystem::path& path);
Coefficients read_nemoh(const std::filesystem::path& path);  ///< the folder, its Nemoh.cal, or one of its results
Coefficients read_aqwa_ah1(const std::filesystem::path& path);
Coefficients read_aqwa_lis(const std::filesystem::path& path);  ///< one structure
Coefficients read_hams(const std::filesystem::path& control, const ReadOptions& options);
Coefficients read_froude(const std::filesystem::path& path);
Coefficients read_veres(const std::filesystem::path& path, const ReadOptions& options);  ///< .re7, and .re8 beside it
Coefficients read_hdb(const std::filesystem::path& path, const ReadOptions& options);    ///< one structure

/// The entry of `folder` of this name, in whatever case its letters are; as written first. An empty path if there is
/// none.
std::filesystem::path entry_of(const std::filesystem::path& folder, const std::string& name);

/// The control file of the HAMS run whose output is in the folder of `path`, if there is one.
std::optional<std::filesystem::path> hams_run_around(const std::filesystem::path& path);

/// The text by which Froude's own files are known: root attribute `format`.
inline constexpr const char* froude_format = "Froude coefficients";

/// Where in the file's order the frequencies stand, ascending; the limits ω = 0 and ω = ∞ apart.
struct FrequencyOrder {
  std::vector<std::size_t> finite;
  std::optional<std::size_t> zero, infinite;
};
/// \throws InputError for a frequency that is negative, NaN or there twice, or if none is finite and positive
FrequencyOrder order_frequencies(const std::vector<double>& omega, const std::filesystem::path& file);

/// Indices that sort the headings. \throws InputError for one that is not finite or there twice
std::vector<std::size_t> order_headings(const std::vector<double>& heading_rad, const std::filesystem::path& file);

/// `values` at `indices`.
std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& indices);

/// \throws InputError naming file, quantity, frequency and modes unless the number is finite
void require_finite(double value, const std::filesystem::path& file, const std::string& what);

/// "sway of body 2"; `mode` counts from 0 through all bodies.
std::string mode_label(Eigen::Index mode);

/// ω of wavenumber ν by (W1); the limits ν = 0 and ν = ∞ give themselves.
double frequency_of_wavenumber(double nu, const Water& water);

/// True for translations: modes 0, 1, 2 of each body.
constexpr bool is_translation(Eigen::Index mode) { return mode % 6 < 3; }

}  // namespace hydro::potential
