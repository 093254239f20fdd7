#include <cmath>

#include "potential/readers.hpp"
#include "text_lines.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// What ControlFile.in says.
struct HamsControl {
  double depth;  ///< m; negative for infinite depth
  FirstColumn column;
  double length;
  Eigen::Vector3d centre;
};

/// The line whose first word is `key`. \throws InputError
int line_of(const TextLines& text, std::string_view key) {
  for (int line = 1; line <= text.count(); ++line)
    if (const auto words = text.words(line); !words.empty() && words.front() == key) return line;
  throw InputError(fmt::format("there is no line \"{} …\"", key), {.file = text.path().string()},
                   "give the ControlFile.in with which HAMS was run");
}

/// HAMS's own numbers: 1 deep-water wavenumber, 2 wavenumber, 3 frequency, 4 period, 5 wavelength (P23).
FirstColumn column_of(const TextLines& text, double length) {
  const int line = line_of(text, "Output_frequency_type");
  const int type = text.whole(line, 1, "Output_frequency_type", 1);
  if (type > 5) throw InputError(fmt::format("Output_frequency_type is 1 to 5, got {}", type), text.place(line, 1));
  if (type <= 2 && length != 1)
    throw InputError(
        "wavenumbers with a reference length that is not 1 m: it is not known whether they are "
        "made dimensionless with it",
        text.place(line, 1), "run HAMS with Output_frequency_type 3 (frequency) or 4 (period)");
  constexpr FirstColumn columns[] = {FirstColumn::deep_wavenumber, FirstColumn::wavenumber, FirstColumn::omega,
                                     FirstColumn::period, FirstColumn::wavelength};
  return columns[type - 1];
}

HamsControl read_control(const fs::path& path) {
  const TextLines text = TextLines::read(path);
  HamsControl out{};
  const int depth = line_of(text, "Waterdepth");
  out.depth = text.number(depth, 1, "the depth of the water");
  if (out.depth == 0) text.refuse(depth, "the depth is zero", "HAMS takes a negative number for infinite depth");
  const int length = line_of(text, "Reference_body_length");
  out.length = text.number(length, 1, "the reference length");
  if (!(out.length > 0)) text.refuse(length, "the reference length must be positive");
  out.column = column_of(text, out.length);
  const int centre = line_of(text, "Reference_body_center");
  for (Eigen::Index i = 0; i < 3; ++i)
    out.centre(i) = text.number(centre, static_cast<std::size_t>(i + 1), "a coordinate of the body's centre");
  return out;
}

/// The one .1 file in Output/Wamit_format beside the folder Input, or beside the control file itself.
WamitFiles find_results(const fs::path& control) {
  const fs::path own = fs::absolute(control).parent_path();
  std::vector<fs::path> found;
  for (const fs::path& folder : {own.parent_path() / "Output" / "Wamit_format", own}) {
    if (!found.empty() || !fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".1") found.push_back(entry.path());
  }
  if (found.size() != 1)
    throw InputError(fmt::format("there are {} files *.1 for this run; one is needed", found.size()),
                     {.file = control.string()}, "keep HAMS's folders Input and Output side by side");
  std::string stem = found.front().string();
  stem.resize(stem.size() - 2);
  return {found.front(), stem};
}

Coefficients read_hams(const fs::path& path, const ReadOptions& options) {
  const HamsControl control = read_control(path);
  if (!options.density || !options.gravity)
    throw InputError("HAMS's files do not hold density and gravity", {.file = path.string()},
                     "state them: in the [water] table of a scene, or as options of `froude bem`");
  require(*options.density > 0 && *options.gravity > 0, "density and gravity must be positive, got {} and {}",
          *options.density, *options.gravity);
  WamitRun run;
  run.water = {*options.density, *options.gravity,
               control.depth < 0 ? WaterDepth::infinite() : WaterDepth::from_metres(control.depth)};
  run.column = control.column;
  run.ulen = control.length;
  run.time_factor = TimeFactor::minus_i_omega_t;  // (P7)
  Coefficients c = read_numeric_files(find_results(path), run);
  c.source = fmt::format("HAMS run {}, {}", path.string(), c.source);
  if (c.bodies() != 1)
    throw InputError(fmt::format("the results are of {} bodies, the control file of one", c.bodies()),
                     {.file = path.string()}, "give a run of HAMS with one body");
  c.body.front().reference_point = control.centre;
  return c;
}

}  // namespace

const Format hams_files{[](const Candidate& c) {
                          if (c.is_folder) return fs::exists(c.path / "Input" / "ControlFile.in");
                          return c.has("Output_frequency_type") || hams_run_around(c.path).has_value();
                        },
                        [](const fs::path& path, const ReadOptions& options) {
                          if (fs::is_directory(path)) return read_hams(path / "Input" / "ControlFile.in", options);
                          return read_hams(hams_run_around(path).value_or(path), options);
                        }};

}  // namespace hydro::potential
