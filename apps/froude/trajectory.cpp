// `froude trajectory`: paths in space, drawn in perspective.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "answers/picture.hpp"
#include "answers/plot_space.hpp"
#include "froude/commands.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/record_file.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

using hydro::InputError;

/// One path: its name, and the signals along x, y and z.
struct Trajectory {
  std::string name;
  std::array<const Signal*, 3> along;
};

std::vector<Trajectory> trajectories_of(const RunResult& record, const TrajectoryArguments& a) {
  const bool single = a.x || a.y || a.z;
  if (single == !a.points.empty())
    throw InputError("a trajectory is of points, or of three signals", {.file = "command line"},
                     "give --point, or --x, --y and --z");
  if (single && !(a.x && a.y && a.z))
    throw InputError("a trajectory by signals needs one along each axis", {.file = "command line"},
                     "give --x, --y and --z");
  std::vector<Trajectory> out;
  const auto add = [&](const std::string& name, const std::string& x, const std::string& y, const std::string& z) {
    out.push_back(
        {name, {&signal_of(record, x, a.file), &signal_of(record, y, a.file), &signal_of(record, z, a.file)}});
  };
  if (single) add("", *a.x, *a.y, *a.z);
  for (const std::string& point : a.points) add(point, point + ".x", point + ".y", point + ".z");
  for (const Trajectory& t : out)
    for (std::size_t i = 0; i < 3; ++i)
      if (t.along[i]->units != out.front().along[i]->units)
        throw InputError(fmt::format("{} is in \"{}\" and {} in \"{}\": they have no axis together", t.along[i]->name,
                                     t.along[i]->units, out.front().along[i]->name, out.front().along[i]->units),
                         {.file = a.file.string()}, "draw them one by one");
  return out;
}

plot::Eye eye_of(const TrajectoryArguments& a) {
  const double up = option_si("--elevation", a.elevation, hydro::dim::angle);
  if (!(std::abs(up) < std::numbers::pi / 2))
    throw InputError("the eye is straight above or below, where z has no length", {.file = "--elevation"},
                     "give an angle between -90 and 90 deg; what lies in a plane is drawn by `froude poincare`");
  return {option_si("--azimuth", a.azimuth, hydro::dim::angle), up};
}

plot::Space space_of(const std::vector<Trajectory>& paths, const TrajectoryArguments& a) {
  plot::Space out{.title = a.file.filename().string(), .x = {}, .y = {}, .z = {}, .paths = {}, .eye = eye_of(a)};
  const bool single = a.points.empty();
  const std::array<plot::Axis*, 3> axes{&out.x, &out.y, &out.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const Signal& first = *paths.front().along[i];
    *axes[i] = {.label = single ? first.name : std::string(1, "xyz"[i]), .unit = first.units};
  }
  for (const Trajectory& t : paths)
    out.paths.push_back({t.name, t.along[0]->values, t.along[1]->values, t.along[2]->values});
  return out;
}

Report report_of(const std::vector<Trajectory>& paths, const RunResult& record) {
  Report out;
  out.say("{} samples from {:.6g} to {:.6g} s", fact("samples", record.time.size()),
          fact("from_s", record.time.front()), fact("to_s", record.time.back()));
  for (const Trajectory& t : paths) {
    Report path;
    path.keep("name", t.name);
    for (std::size_t i = 0; i < 3; ++i) {
      const Signal& s = *t.along[i];
      const auto [low, high] = std::minmax_element(s.values.begin(), s.values.end());
      Report axis;
      axis.say("  {:<24} from {:>10.4g} to {:>10.4g} {}", fact("signal", s.name), fact("lowest", *low),
               fact("highest", *high), fact("unit", s.units));
      path.one_of("axes", axis);
    }
    out.one_of("paths", path);
  }
  return out;
}

}  // namespace

void trajectory(const TrajectoryArguments& a, const Console& console) {
  require_outputs({{"--picture", a.picture}}, {{"the record", a.file}});
  plot::require_picture(a.picture);
  RunResult record = read_record(a.file);
  hydro::require(!record.time.empty(), "the record has no samples");
  if (a.from) drop_before(record, option_si("--from", *a.from, hydro::dim::time), a.file);
  if (a.to) drop_after(record, option_si("--to", *a.to, hydro::dim::time), a.file);
  const auto paths = trajectories_of(record, a);
  plot::write_svg(a.picture, plot::svg(space_of(paths, a)));
  tell(report_of(paths, record).wrote(a.picture), console);
}

}  // namespace froude
