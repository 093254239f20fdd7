/// \file  `froude stability`: whether periodic motions in regular waves last, over periods and heights of the waves.
#include <cmath>

#include "answers/answers.hpp"
#include "answers/plot.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "froude/scene_result.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

using Cell = StabilityMap::Cell;

std::string fate_of(const Cell& cell) { return cell.fate ? name_of(*cell.fate) : "none found"; }

Report report_of(const StabilityMap& map, std::size_t p) {
  Report out;
  for (std::size_t h = 0; h < map.height.size(); ++h) {
    const Cell& cell = map.cells[h * map.period.size() + p];
    Report one;
    one.keep("height_m", map.height[h]).keep("fate", fate_of(cell)).keep("beyond_fold", cell.beyond_fold);
    one.keep("multiplier", cell.multiplier).keep("harmonics", cell.harmonics);
    out.one_of("cells", one);
  }
  // In a row equal neighbours are told once: "stable to 1.5 m, period-doubled to 4 m".
  std::string row;
  for (std::size_t h = 0; h < map.height.size(); ++h) {
    const auto fate = [&](std::size_t i) { return fate_of(map.cells[i * map.period.size() + p]); };
    if (h + 1 == map.height.size() || fate(h + 1) != fate(h))
      row += fmt::format("{}{} to {:.4g} m", row.empty() ? "" : ", ", fate(h), map.height[h]);
  }
  const bool grows = std::isfinite(map.mathieu[p]);
  return out
      .say("{:>9.4g} {:>8}  {}", fact("period_s", map.period[p]),
           fact("mathieu_height_m", map.mathieu[p], grows ? fmt::format("{:.3g}", map.mathieu[p]) : "none"), row)
      .keep("mathieu_motion", map.motion[p]);
}

Report report_of(const scene::Scene& scene, const StabilityMap& map, const Path& file) {
  Report out;
  out.say("{}: periodic motions in waves of {} periods and {} heights, {:.2f} s of work",
          scene.file.filename().string(), map.period.size(), map.height.size(), fact("balance_s", map.balance_s));
  out.say("{:>9} {:>8}  {}", "period[s]", "grows[m]", "motions of the period of the waves");
  for (std::size_t p = 0; p < map.period.size(); ++p) out.one_of("periods", report_of(map, p));
  for (const StabilityMap::Check& c : map.checks) {
    Report one;
    const Cell& cell = map.cells[c.cell];
    one.say("stepped: {:.4g} s, {:.4g} m: {}, the run {} ({:.2g} apart){}",
            fact("period_s", map.period[c.cell % map.period.size()]),
            fact("height_m", map.height[c.cell / map.period.size()]), fact("fate", fate_of(cell)),
            fact("left", c.left, c.left ? "left it" : "stayed"), fact("apart", c.apart),
            fact("decided", c.decided, c.decided ? "" : "; too near the boundary to be decided"));
    out.one_of("checks", one.keep("agrees", c.agrees(cell)));
  }
  if (!map.checks.empty())
    out.say("{}, {:.2f} s of work", fact("agreement", map.agreement()), fact("checks_s", map.checks_s));
  return out.sentences("notes", "note: {}", map.notes).say("wrote {}", fact("file", file.string()));
}

void write_csv(const Path& path, const StabilityMap& map) {
  std::vector<double> period, height, fate, multiplier, mathieu;
  for (std::size_t c = 0; c < map.cells.size(); ++c) {
    period.push_back(map.period[c % map.period.size()]);
    height.push_back(map.height[c / map.period.size()]);
    fate.push_back(map.cells[c].fate ? static_cast<double>(*map.cells[c].fate) : std::nan(""));
    multiplier.push_back(map.cells[c].multiplier);
    mathieu.push_back(map.mathieu[c % map.period.size()]);
  }
  std::vector<hydro::io::CsvColumn> columns{{"period", "s", &period},
                                            {"height", "m", &height},
                                            {"fate", "", &fate},
                                            {"multiplier", "", &multiplier},
                                            {"mathieu height", "m", &mathieu}};
  for (const Signal& s : map.signals) columns.push_back({s.name, s.units, &s.values});
  hydro::io::write_csv(
      path, columns,
      {"fate: 0 stable, 1 period-doubled, 2 quasi-periodic, 3 fold; signals by their standard deviation"});
}

std::vector<double> multipliers(const StabilityMap& map) {
  std::vector<double> out;
  for (const Cell& c : map.cells) out.push_back(c.multiplier);
  return out;
}

/// Contours over periods and heights, with the boundaries of both kinds.
plot::Panel panel(const StabilityMap& map, const std::vector<double>& of, const std::vector<double>& levels,
                  const std::string& unit) {
  plot::Panel out{.x = {"wave period", "s"}, .y = {"wave height", "m"}, .series = {}};
  for (const double level : levels)
    out.series.push_back(plot::contour(fmt::format("{:.3g}{}{}", level, unit.empty() ? "" : " ", unit), map.period,
                                       map.height, of, level));
  out.series.push_back(plot::contour("multiplier 1", map.period, map.height, multipliers(map), 1));
  out.series.push_back({.name = "Mathieu", .x = map.period, .y = map.mathieu, .dashed = true});
  return out;
}

plot::Figure figure(const scene::Scene& scene, const StabilityMap& map) {
  plot::Figure f{.title = scene.title.empty() ? "Periodic motions" : scene.title, .panels = {}};
  f.panels.push_back(panel(map, multipliers(map), {0.9, 1.1, 1.3, 1.6}, ""));
  plot::Series agree{.name = "stepped, agrees", .x = {}, .y = {}, .line = false, .marks = true}, differ = agree;
  differ.name = "stepped, differs";
  for (const auto& c : map.checks) {
    if (!c.decided) continue;
    plot::Series& to = c.agrees(map.cells[c.cell]) ? agree : differ;
    to.x.push_back(map.period[c.cell % map.period.size()]);
    to.y.push_back(map.height[c.cell / map.period.size()]);
  }
  for (plot::Series* s : {&agree, &differ})
    if (!s->x.empty()) f.panels.front().series.push_back(*s);
  constexpr std::size_t most = 4;
  for (std::size_t i = 0; i < std::min(most, map.signals.size()); ++i) {
    const Signal& s = map.signals[i];
    double highest = 0;
    for (const double v : s.values) highest = std::max(highest, std::isfinite(v) ? v : 0);
    f.panels.push_back(panel(map, s.values, plot::ticks(0.05 * highest, highest, plot::Scale::linear, 4), s.units));
    f.panels.back().y.label = s.name + ": wave height";
  }
  return f;
}

}  // namespace

void stability(const SceneArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.stability.has_value(), scene, "stability map",
                "stability = { periods = \"5 s .. 15 s, 21 values\", heights = \"0.5 m .. 4 m, 8 values\" }");
  const Path file = checked_output(arguments, ".stability.h5");
  Progress progress(console.err, "stability", console.show_progress);
  const StabilityMap map = stability(scene, [&](double done) { progress.update(done); });
  map.write(file);
  if (arguments.csv) write_csv(*arguments.csv, map);
  if (arguments.picture) hydro::io::write_atomically(*arguments.picture, plot::svg(figure(scene, map)));
  tell(report_of(scene, map, file), console);
}

}  // namespace froude
