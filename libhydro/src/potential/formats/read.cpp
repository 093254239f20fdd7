#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string_view>

#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/io/trial.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/potential/formats/files.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

bool has_magic_of_classic_netcdf(const std::string& head) {
  return head.starts_with("CDF") && head.size() > 3 && (head[3] == 1 || head[3] == 2 || head[3] == 5);
}

/// The first bytes of a file; a few kilobytes hold every mark by which formats are known.
std::string head_of(const fs::path& path) {
  std::string head(4096, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

[[noreturn]] void refuse_unknown(const Candidate& candidate) {
  if (candidate.is_folder)
    throw InputError(fmt::format("\"{}\" is a folder", candidate.path.string()), {},
                     "give a file in it; only folders of NEMOH (with Nemoh.cal) and HAMS (with Input/ControlFile.in) "
                     "are read as a whole");
  throw InputError("an HDF5 file, but none that holds coefficients Froude knows", {.file = candidate.path.string()},
                   "give a file of Froude (`froude bem convert`), of BEMIO (groups body1, simulation_parameters) or of "
                   "Capytaine (variables added_mass, radiating_dof)");
}

/// \throws InputError if none knows it
const Format& format_of(const fs::path& path) {
  Candidate candidate{path, fs::is_directory(path)};
  if (!candidate.is_folder) candidate.head = head_of(path);
  candidate.is_classic_netcdf = has_magic_of_classic_netcdf(candidate.head);
  std::optional<io::Hdf5Reader> hdf5;
  if (candidate.head.starts_with("\x89HDF")) candidate.hdf5 = &hdf5.emplace(path);
  for (const Format* format : formats)
    if (format->knows(candidate)) return *format;
  refuse_unknown(candidate);
}

/// ULEN and IPEROUT are facts of WAMIT's files alone: with another format they are a mistake of the caller.
void require_no_wamit_options(const ReadOptions& options, const Coefficients& c, const fs::path& path) {
  constexpr const char* remedy = "leave it out: the file itself says what its numbers are";
  if (options.ulen)
    throw InputError(
        fmt::format("ULEN = {} m is given, but this is no set of WAMIT files: {}", *options.ulen, c.source),
        {.file = path.string()}, remedy);
  if (options.iperout)
    throw InputError(
        fmt::format("IPEROUT = {} is given, but this is no set of WAMIT files: {}", *options.iperout, c.source),
        {.file = path.string()}, remedy);
}

/// Formats that state ρ, g and h are believed; a caller who holds another value is told.
void note_differing_water(Coefficients& c, const ReadOptions& options) {
  const auto differs = [](double a, double b) {  // either may be an infinite depth
    return a != b && !(std::abs(a - b) <= 1e-6 * std::min(std::abs(a), std::abs(b)));
  };
  const auto note = [&](const char* what, double asked, double found) {
    c.notes.push_back(fmt::format("{} {} was asked for, but the file states {}, which is used", what, asked, found));
  };
  if (options.density && differs(*options.density, c.water.density)) note("density", *options.density, c.water.density);
  if (options.gravity && differs(*options.gravity, c.water.gravity)) note("gravity", *options.gravity, c.water.gravity);
  if (options.depth && differs(options.depth->metres(), c.water.depth.metres()))
    note("depth", options.depth->metres(), c.water.depth.metres());
}

// What the readers open beside the file that they are given. Sets share a stem, runs share a folder.
constexpr std::array set_endings{".1", ".2", ".3", ".3fk", ".3sc", ".hst", ".out", ".re7", ".re8"};
constexpr std::array run_endings{".cal", ".tec", ".dat", ".in", ".1", ".3", ".hst"};

template <class Endings>
bool ends_in(const fs::path& path, const Endings& endings) {
  return std::find(endings.begin(), endings.end(), path.extension().string()) != endings.end();
}

/// The folder of a run of NEMOH or HAMS of which `path` is the whole or a part, or an empty path.
fs::path run_folder(const fs::path& path) {
  fs::path at = fs::absolute(path).lexically_normal();
  std::error_code failure;  // of names that are too long to be any file's
  if (!fs::is_directory(at, failure) && !ends_in(at, run_endings)) return {};
  for (int up = 0; up <= 3; ++up, at = at.parent_path())  // HAMS: Output/Wamit_format/buoy.1
    if (!entry_of(at, "Nemoh.cal").empty() || fs::exists(at / "Input" / "ControlFile.in", failure)) return at;
  return {};
}

}  // namespace

std::vector<fs::path> files_behind(const fs::path& path) {
  std::vector<fs::path> out;
  const auto add = [&](const fs::path& file) {
    std::error_code unknown;
    if (fs::is_regular_file(file, unknown)) out.push_back(file);
  };
  add(path);
  const std::string stem = ends_in(path, set_endings) ? fs::path(path).replace_extension().string() : path.string();
  for (const char* ending : set_endings) add(stem + ending);
  if (const fs::path folder = run_folder(path); !folder.empty()) {
    std::error_code failed;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
      if (at.depth() >= 2) at.disable_recursion_pending();  // results lie two folders below at most
      if (ends_in(at->path(), run_endings)) add(at->path());
    }
  }
  return out;
}

fs::path entry_of(const fs::path& folder, const std::string& name) {
  std::error_code unknown;
  if (fs::exists(folder / name, unknown)) return folder / name;
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
    if (lower(at->path().filename().string()) == lower(name)) return at->path();
  return {};
}

std::optional<fs::path> hams_run_around(const fs::path& path) {
  const fs::path folder = fs::absolute(path).parent_path();
  const fs::path control = folder.parent_path().parent_path() / "Input" / "ControlFile.in";
  return folder.filename() == "Wamit_format" && fs::exists(control) ? std::optional(control) : std::nullopt;
}

namespace {
Coefficients read_here(const fs::path& path, const ReadOptions& options) {
  const Format& format = format_of(path);
  Coefficients c = format.read(path, options);
  if (&format != &wamit_files) {
    require_no_wamit_options(options, c, path);
    note_differing_water(c, options);
  }
  try {
    c.validate();
  } catch (const InputError& error) {
    throw error.at({.file = path.string()});
  }
  return c;
}
}  // namespace

Coefficients read(const fs::path& path, const ReadOptions& options) {
  return io::read_tried(path, [&] { return read_here(path, options); });
}

FrequencyOrder order_frequencies(const std::vector<double>& omega, const fs::path& file) {
  const Place place{.file = file.string()};
  FrequencyOrder order;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    if (!(omega[i] >= 0))
      throw InputError(fmt::format("frequency {} is {} rad/s; it must be zero, positive or infinite", i + 1, omega[i]),
                       place);
    if (omega[i] == 0 || std::isinf(omega[i])) {
      auto& limit = omega[i] == 0 ? order.zero : order.infinite;
      if (limit)
        throw InputError(fmt::format("frequency {} rad/s is there twice", omega[i]), place, "keep one of them");
      limit = i;
    } else {
      order.finite.push_back(i);
    }
  }
  if (order.finite.empty()) throw InputError("there is no finite, positive frequency", place);
  std::sort(order.finite.begin(), order.finite.end(),
            [&](std::size_t a, std::size_t b) { return omega[a] < omega[b]; });
  for (std::size_t i = 1; i < order.finite.size(); ++i)
    if (omega[order.finite[i]] == omega[order.finite[i - 1]])
      throw InputError(fmt::format("frequency {} rad/s is there twice", omega[order.finite[i]]), place,
                       "keep one of them");
  return order;
}

std::vector<std::size_t> order_headings(const std::vector<double>& heading_rad, const fs::path& file) {
  const Place place{.file = file.string()};
  std::vector<std::size_t> order(heading_rad.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const double beta : heading_rad)
    if (!std::isfinite(beta)) throw InputError("a wave heading is not finite", place);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return heading_rad[a] < heading_rad[b]; });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (heading_rad[order[i]] == heading_rad[order[i - 1]])
      throw InputError(
          fmt::format("heading {:.6g} deg is there twice", Angle::from_radians(heading_rad[order[i]]).degrees()), place,
          "keep one of them");
  return order;
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& indices) {
  std::vector<double> out;
  for (const std::size_t i : indices) out.push_back(values[i]);
  return out;
}

void require_finite(double value, const fs::path& file, const std::string& what) {
  if (!std::isfinite(value))
    throw InputError(fmt::format("{} is {}", what, value), {.file = file.string()},
                     "a failed computation is stored this way: run that case again, or leave its frequency out");
}

std::string mode_label(Eigen::Index mode) {
  return fmt::format("{} of body {}", mode_names[static_cast<std::size_t>(mode % 6)], mode / 6 + 1);
}

double frequency_of_wavenumber(double nu, const Water& water) {
  return nu == 0 || std::isinf(nu) ? nu : waves::angular_frequency(nu, water);
}

}  // namespace hydro::potential
