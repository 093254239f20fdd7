#pragma once
/// \file  Private to hydro/potential: the formats of coefficients, and what their readers share.
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/io/hdf5.hpp"
#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// What is to be read, as far as formats look to know it.
struct Candidate {
  std::filesystem::path path;
  bool is_folder = false, is_classic_netcdf = false;
  const io::Hdf5Reader* hdf5 = nullptr;  ///< null for other files
  std::string head = {};                 ///< the first kilobytes of a text, in which every mark stands
  bool has(std::string_view mark) const { return head.find(mark) != std::string::npos; }
  std::string_view first_line() const { return std::string_view(head).substr(0, head.find('\n')); }
};

/// A format of coefficients: whether a candidate is of it, and its reader. Each is defined in the file of its reader.
struct Format {
  bool (*knows)(const Candidate& candidate);
  Coefficients (*read)(const std::filesystem::path& path, const ReadOptions& options);
};
extern const Format froude_files, bemio_files, capytaine_files, aqwa_ah1_files, aqwa_lis_files, hams_files, veres_files,
    hdb_files, nemoh_files, wamit_printed_files, wamit_files;
/// In the order in which they are asked: WAMIT's tables have no mark, so any text that no other knows is one.
inline constexpr std::array<const Format*, 11> formats{
    &froude_files, &bemio_files, &capytaine_files, &nemoh_files,         &aqwa_ah1_files, &aqwa_lis_files,
    &hams_files,   &veres_files, &hdb_files,       &wamit_printed_files, &wamit_files};

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
