// `froude poincare`: Poincaré sections of a record.
#include "hydro/signal/poincare_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "answers/picture.hpp"
#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/record_file.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace hs = hydro::signal;
using hydro::InputError;

/// What is drawn and written: both signals of the plane, and the points.
struct Plane {
  Signal x, y;
  hs::PoincareSection section;
  std::string how;  ///< "where … rises through …"
};

void require_one_way(const PoincareArguments& a) {
  if (a.at.has_value() == a.every.has_value())
    throw InputError("a Poincare section is taken either where a signal crosses a level or once in a period",
                     {.file = "command line"}, "give --at with --level, or --every");
  if (a.at.has_value() != a.level.has_value())
    throw InputError("--at needs a --level to cross, and --level a signal that does", {.file = "command line"},
                     "give both, for example --at chain.link1.polar --level \"90 deg\"");
}

double level_of(const PoincareArguments& a, const Signal& across) {
  return scene::placed({.file = "--level"}, [&] {
    return hydro::parse_si(*a.level, hydro::parse_unit(across.units.empty() ? "1" : across.units).dimension);
  });
}

Plane plane_of(const PoincareArguments& a) {
  require_one_way(a);
  RunResult record = read_record(a.file);
  hydro::require(!record.time.empty(), "the record has no samples");
  std::optional<double> from;
  if (a.from) from.emplace(hydro::parse_si(*a.from, hydro::dim::time));
  Plane out{signal_of(record, a.x, a.file), signal_of(record, a.y, a.file), {}, {}};
  const auto samples = [&](double step) {
    return hs::Samples{record.time.front(), step, {out.x.values, out.y.values}};
  };
  if (a.every) {
    // Samples before the first point stay: it is interpolated from both sides.
    const double period = hydro::parse_si(*a.every, hydro::dim::time);
    out.section =
        hs::poincare_section_every(from.value_or(record.time.front()), period, samples(hs::even_step(record.time)));
    out.how = fmt::format("once in {:.6g} s", period);
    return out;
  }
  if (from) drop_before(record, *from, a.file);
  out.x = signal_of(record, a.x, a.file);
  out.y = signal_of(record, a.y, a.file);
  const Signal& across = signal_of(record, *a.at, a.file);
  const auto through = a.through == "up"     ? hs::Through::up
                       : a.through == "down" ? hs::Through::down
                                             : hs::Through::both;
  out.section =
      hs::poincare_section_at(across.values, level_of(a, across), through, samples(hs::even_step(record.time)));
  out.how = fmt::format("where {} {} {}", across.name,
                        a.through == "up"     ? "rises through"
                        : a.through == "down" ? "falls through"
                                              : "passes",
                        *a.level);
  return out;
}

/// Angles without their full turns.
void wrap(const Signal& signal, std::vector<double>& values) {
  if (signal.units != "rad") return;
  for (double& v : values) v = std::remainder(v, 2 * std::numbers::pi);
}

struct Spread {
  double lowest, highest, error;  ///< the last: the largest of a point
};

Spread spread(const hs::PoincareSection& s, std::size_t i) {
  const auto [low, high] = std::minmax_element(s.values[i].begin(), s.values[i].end());
  return {*low, *high, *std::max_element(s.errors[i].begin(), s.errors[i].end())};
}

/// A thousandth of the way that the whole signal goes up and down: less than a point is drawn wide.
double sharp(const Signal& signal) {
  const auto [low, high] = std::minmax_element(signal.values.begin(), signal.values.end());
  return 1e-3 * (*high - *low);
}

Report report_of(const Plane& p) {
  const std::size_t left_out = p.section.left_out;
  Report out;
  out.say(
      "{} points {}{}", fact("points", p.section.time_s.size()), fact("how", p.how),
      fact("left_out", left_out,
           left_out ? fmt::format("; {} at the ends of the record left out, with fewer than three samples on a side",
                                  left_out)
                    : ""));
  out.keep("time_s", p.section.time_s);
  out.say("{:<24} {:>12} {:>12} {:>16} {}", "signal", "lowest", "highest", "largest error", "unit");
  for (std::size_t i = 0; i < 2; ++i) {
    const Spread s = spread(p.section, i);
    const Signal& signal = i == 0 ? p.x : p.y;
    Report axis;
    axis.say("{:<24} {:>12.4g} {:>12.4g} {:>16.2g} {}", fact("signal", signal.name), fact("lowest", s.lowest),
             fact("highest", s.highest), fact("largest_error", s.error), fact("unit", signal.units));
    axis.keep("values", p.section.values[i]).keep("errors", p.section.errors[i]);
    out.part(i == 0 ? "x" : "y", axis);
    if (s.error > sharp(signal))
      out.sentences("notes", "note: {}",
                    {fmt::format("points of {} are up to {:.2g} {} off: take samples more often", signal.name, s.error,
                                 signal.units)});
  }
  return out;
}

/// The range of an axis: wide enough that one point, scattered by its error, is drawn as one.
std::pair<double, double> range(const Spread& s) {
  const double size = std::max(std::abs(s.lowest), std::abs(s.highest)),
               half = std::max({0.55 * (s.highest - s.lowest), 20 * s.error, 1e-3 * size, 1e-12}),
               middle = (s.lowest + s.highest) / 2;
  return {middle - half, middle + half};
}

plot::Figure figure(const Plane& p, const std::string& file_name) {
  return {.title = fmt::format("{}: {}", file_name, p.how),
          .panels =
              {{.x = {.label = p.x.name, .unit = p.x.units, .range = range(spread(p.section, 0))},
                .y = {.label = p.y.name, .unit = p.y.units, .range = range(spread(p.section, 1))},
                .series =
                    {{.name = "", .x = p.section.values[0], .y = p.section.values[1], .line = false, .marks = true}}}},
          .width = 700,
          .panel_height = 560};
}

}  // namespace

void poincare(const PoincareArguments& arguments, const Console& console) {
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  {{"the record", arguments.file}});
  require_picture(arguments.picture);
  Plane plane = scene::placed({.file = arguments.file.string()}, [&] { return plane_of(arguments); });
  hs::PoincareSection& s = plane.section;
  if (arguments.wrap) {
    wrap(plane.x, s.values[0]);
    wrap(plane.y, s.values[1]);
  }
  if (s.time_s.empty())
    throw InputError(fmt::format("no point of the record lies {}", plane.how), {.file = arguments.file.string()},
                     "look at the signals' ranges: froude psd lists means");
  if (arguments.output)
    hydro::io::write_csv(*arguments.output,
                         {{"time", "s", &s.time_s},
                          {plane.x.name, plane.x.units, &s.values[0]},
                          {plane.y.name, plane.y.units, &s.values[1]},
                          {plane.x.name + ".error", plane.x.units, &s.errors[0]},
                          {plane.y.name + ".error", plane.y.units, &s.errors[1]}},
                         {"Poincare section " + plane.how});
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(plane, arguments.file.filename().string()));
  tell(report_of(plane).wrote(arguments.output).wrote(arguments.picture), console);
}

}  // namespace froude
