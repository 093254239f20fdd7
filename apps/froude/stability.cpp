/// \file  `froude stability`: whether periodic motions in regular waves last, over periods and heights of the waves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "answers/answers.hpp"
#include "answers/picture.hpp"
#include "answers/plot_field.hpp"
#include "answers/stability_check.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "froude/scene_result.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

using Cell = StabilityMap::Cell;
using Branch = StabilityMap::Branch;
using Reached = StabilityMap::Reached;

constexpr const char* red = "#e00000";  // as the source draws boundaries

std::string fate_of(const StabilityMap::Motion& motion) { return motion.fate ? name_of(*motion.fate) : "none found"; }
std::string fate_of(const Cell& cell) { return cell.fate ? name_of(*cell.fate) : name_of(cell.reached); }

/// "stable to 1.5 m, period-doubled to 4 m": equal neighbours are told once.
template <class FateOf, class At>
std::string fates_told(std::size_t count, const FateOf& fate, const At& at, const char* unit) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i)
    if (i + 1 == count || fate(i + 1) != fate(i))
      out += fmt::format("{}{} to {:.4g} {}", out.empty() ? "" : ", ", fate(i), at(i), unit);
  return out;
}

Report report_of(const StabilityMap& map, std::size_t p) {
  Report out;
  for (std::size_t h = 0; h < map.height.size(); ++h) {
    const Cell& cell = map.cells[map.index(p, h)];
    Report one;
    one.keep("height_m", map.height[h]).keep("fate", fate_of(cell)).keep("reached", name_of(cell.reached));
    one.keep("multiplier", cell.multiplier).keep("harmonics", cell.harmonics);
    out.one_of("cells", one);
  }
  const std::string row = fates_told(
      map.height.size(), [&](std::size_t h) { return fate_of(map.cells[map.index(p, h)]); },
      [&](std::size_t h) { return map.height[h]; }, "m");
  const bool grows = std::isfinite(map.mathieu[p]);
  return out
      .say("{:>9.4g} {:>8}  {}", fact("period_s", map.period[p]),
           fact("mathieu_height_m", map.mathieu[p], grows ? fmt::format("{:.3g}", map.mathieu[p]) : "none"), row)
      .keep("mathieu_motion", map.motion[p]);
}

/// Where a branch turns back: the last point before what varies goes the other way.
std::vector<double> folds_of(const Branch& branch) {
  std::vector<double> out;
  for (std::size_t i = 1; i < branch.points.size(); ++i)
    if (branch.points[i].forwards != branch.points[i - 1].forwards) out.push_back(branch.varied(branch.points[i - 1]));
  return out;
}

Report report_of_branch(const Branch& branch, std::size_t number) {
  const char *unit = branch.over_periods ? "s" : "m", *held = branch.over_periods ? "m" : "s";
  Report out;
  for (const Branch::Point& p : branch.points)
    out.one_of("points", Report()
                             .keep("period_s", p.period)
                             .keep("height_m", p.height)
                             .keep("fate", fate_of(p))
                             .keep("multiplier", p.multiplier)
                             .keep("forwards", p.forwards));
  std::string turns;
  const std::vector<double> folds = folds_of(branch);
  for (const double at : folds)
    turns += fmt::format("{}{:.4g} {}", turns.empty() ? ", turns back at " : ", ", at, unit);
  const std::string fates = fates_told(
      branch.points.size(), [&](std::size_t i) { return fate_of(branch.points[i]); },
      [&](std::size_t i) { return branch.varied(branch.points[i]); }, unit);
  if (branch.begin == Reached::jumped) out.say("branch {} begins on a motion that no branch joins to rest", number);
  out.say("branch {} of {:.4g} {}: {} points{}{}{}", number, branch.held, held, branch.points.size(), turns,
          fates.empty() ? "" : ": " + fates, fact("end", branch.end, branch.end.empty() ? "" : "; " + branch.end));
  return out.keep(branch.over_periods ? "height_m" : "period_s", branch.held)
      .keep("folds", folds)
      .keep("begin", name_of(branch.begin));
}

/// "28 cells: 20 stable, 6 period-doubled, 2 beyond breaking; 3 reached round folds", and where Newton jumped.
Report counted(const StabilityMap& map) {
  std::map<std::string, int> fates;
  std::string jumps;
  int round_folds = 0, jumped = 0;
  for (std::size_t c = 0; c < map.cells.size(); ++c) {
    ++fates[fate_of(map.cells[c])];
    round_folds += map.cells[c].reached == Reached::round_folds ? 1 : 0;
    if (map.cells[c].reached != Reached::jumped) continue;
    ++jumped;
    jumps += fmt::format("{}{:.4g} s, {:.4g} m", jumps.empty() ? ": " : "; ", map.period_of(c), map.height_of(c));
  }
  std::string told;
  Report out, one;
  for (const auto& [fate, count] : fates) {
    told += fmt::format("{}{} {}", told.empty() ? "" : ", ", count, fate);
    one.keep(fate, count);
  }
  out.say("{} cells: {}; {} reached round folds, {} by a jump onto another branch{}", map.cells.size(), told,
          fact("round_folds", round_folds), fact("jumped", jumped), jumps);
  out.part("fates", one);
  return out;
}

Report report_of(const scene::Scene& scene, const StabilityMap& map, const Path& file) {
  Report out;
  out.say("{}: periodic motions in waves of {} periods and {} heights, {:.2f} s of processor time",
          scene.file.filename().string(), map.period.size(), map.height.size(), fact("processor_s", map.processor_s));
  out.say("{:>9} {:>8}  {}", "period[s]", "grows[m]", "motions of the period of the waves");
  for (std::size_t p = 0; p < map.period.size(); ++p) out.one_of("periods", report_of(map, p));
  out.part("counts", counted(map));
  for (std::size_t b = 0; b < map.branches.size(); ++b)
    out.one_of("branches", report_of_branch(map.branches[b], b + 1));
  return out.sentences("notes", "note: {}", map.notes).say("wrote {}", fact("file", file.string()));
}

Report report_of(const StabilityMap& map, const SteppedCell& c) {
  const Cell& cell = map.cells[c.cell];
  Report out;
  out.say("stepped: {:.4g} s, {:.4g} m: {}, multiplier {:.4g}; the run {}{}", fact("period_s", map.period_of(c.cell)),
          fact("height_m", map.height_of(c.cell)), fact("fate", fate_of(cell)), cell.multiplier,
          fact("left", c.left(),
               !c.stopped.empty() ? "stopped: " + c.stopped
               : c.left()         ? fmt::format("left the periodic motion ({:.2g} apart)", c.apart)
                                  : fmt::format("has the periodic motion ({:.2g} apart)", c.apart)),
          fact("decided", c.decided, c.decided ? "" : "; too near the boundary to be decided"));
  return out.keep("apart", c.apart).keep("agrees", c.agrees(cell));
}

/// "6 of 6 cells stepped in time agree, 2 more are too near the boundary to be decided"
Report report_of(const StabilityMap& map, const MapCheck& check) {
  Report out;
  int decided = 0, agree = 0;
  for (const SteppedCell& c : check.cells) {
    out.one_of("cells", report_of(map, c));
    decided += c.decided ? 1 : 0;
    agree += c.decided && c.agrees(map.cells[c.cell]) ? 1 : 0;
  }
  const double a_run = check.processor_s / static_cast<double>(check.cells.size()),
               a_cell = map.processor_s / static_cast<double>(map.cells.size());
  out.say("{} of {} cells stepped in time agree, {} more are too near the boundary to be decided", fact("agree", agree),
          fact("decided", decided), std::ssize(check.cells) - decided);
  if (check.cells.empty()) return out;
  return out.say("{:.2f} s of processor time a run, {:.0f} times that of a cell of the map", fact("run_s", a_run),
                 fact("run_over_cell", a_run / a_cell));
}

/// Rows of a table, to which cells and points of branches are added.
struct Rows {
  std::vector<double> branch, period, height, fate, multiplier, mathieu, forwards, reached;
  std::vector<std::vector<double>> signals;

  void add(double of_branch, const StabilityMap::Motion& motion, double T, double H, double grows, double onwards,
           double how) {
    branch.push_back(of_branch);
    period.push_back(T);
    height.push_back(H);
    fate.push_back(motion.fate_number());
    multiplier.push_back(motion.multiplier);
    mathieu.push_back(grows);
    forwards.push_back(onwards);
    reached.push_back(how);
  }
  void add(const std::vector<Signal>& of) {
    signals.resize(of.size());
    for (std::size_t s = 0; s < of.size(); ++s)
      signals[s].insert(signals[s].end(), of[s].values.begin(), of[s].values.end());
  }
};

void write_csv(const Path& path, const StabilityMap& map) {
  Rows rows;
  for (std::size_t c = 0; c < map.cells.size(); ++c)
    rows.add(0, map.cells[c], map.period_of(c), map.height_of(c), map.mathieu[c % map.period.size()], 1,
             static_cast<double>(map.cells[c].reached));
  rows.add(map.signals);
  for (std::size_t b = 0; b < map.branches.size(); ++b) {
    for (const Branch::Point& p : map.branches[b].points)
      rows.add(static_cast<double>(b + 1), p, p.period, p.height, std::nan(""), p.forwards ? 1 : 0, std::nan(""));
    rows.add(map.branches[b].signals);
  }
  std::vector<hydro::io::CsvColumn> columns{
      {"period", "s", &rows.period},        {"height", "m", &rows.height},          {"fate", "", &rows.fate},
      {"multiplier", "", &rows.multiplier}, {"mathieu height", "m", &rows.mathieu}, {"reached", "", &rows.reached}};
  if (!map.branches.empty()) {
    columns.push_back({"branch", "", &rows.branch});
    columns.push_back({"forwards", "", &rows.forwards});
  }
  for (std::size_t s = 0; s < map.signals.size(); ++s)
    columns.push_back({map.signals[s].name, map.signals[s].units, &rows.signals[s]});
  std::vector<std::string> comments{
      "fate: 0 stable, 1 period-doubled, 2 quasi-periodic, 3 fold; signals by their standard deviation",
      "reached: 0 grown as the waves grow, 1 round folds, 2 jumped onto another branch, 3 none found, 4 beyond "
      "breaking"};
  if (!map.branches.empty())
    comments.emplace_back(
        "branch: 0 cells of the map, 1 and on points of that branch, in their order; forwards: 0 where it has turned "
        "back");
  hydro::io::write_csv(path, columns, comments);
}

plot::Field field(const StabilityMap& map, plot::Axis value, const std::vector<double>& values) {
  plot::Field out{.value = std::move(value), .xs = map.period, .ys = map.height, .values = {}};
  const auto columns = static_cast<std::ptrdiff_t>(map.period.size());
  for (auto row = values.begin(); row != values.end(); row += columns) out.values.emplace_back(row, row + columns);
  return out;
}

/// Where the largest multiplier is 1.
std::vector<plot::ContourLine> floquet_lines(const StabilityMap& map) {
  std::vector<double> multiplier;
  for (const Cell& c : map.cells) multiplier.push_back(c.multiplier);
  return plot::joined(plot::contour(field(map, {}, multiplier), 1));
}
plot::Series floquet_boundary(const StabilityMap& map) {
  plot::Series out{.name = "|multiplier| = 1", .x = {}, .y = {}, .colour = red};
  for (plot::ContourLine& line : floquet_lines(map)) {
    for (auto* along : {&line.x, &line.y}) along->push_back(std::numeric_limits<double>::quiet_NaN());  // lifts the pen
    out.x.insert(out.x.end(), line.x.begin(), line.x.end());
    out.y.insert(out.y.end(), line.y.begin(), line.y.end());
  }
  return out;
}
/// Over the periods at which a motion grows, one line for each row of neighbours.
std::vector<plot::ContourLine> mathieu_lines(const StabilityMap& map) {
  std::vector<plot::ContourLine> out;
  for (std::size_t p = 0; p < map.period.size(); ++p) {
    if (!std::isfinite(map.mathieu[p])) continue;
    if (p == 0 || !std::isfinite(map.mathieu[p - 1])) out.emplace_back();
    out.back().x.push_back(map.period[p]);
    out.back().y.push_back(map.mathieu[p]);
  }
  return out;
}

/// Both boundaries as points from end to end, for other pictures: lines of one and of the other in turn, so that where
/// the name changes a line ends. What is left of either has numbers: "Floquet 3".
void write_boundaries(const Path& path, const StabilityMap& map) {
  std::string last, out =
                        "# Where motions of the period of the waves begin to grow: by Floquet's multipliers of the "
                        "whole model, and by\n"
                        "# Mathieu's equation of each free motion (froude stability)\nboundary,period [s],height [m]\n";
  const std::vector<std::pair<std::string, std::vector<plot::ContourLine>>> both = {{"Floquet", floquet_lines(map)},
                                                                                    {"Mathieu", mathieu_lines(map)}};
  for (std::size_t l = 0; l < std::max(both[0].second.size(), both[1].second.size()); ++l)
    for (const auto& [boundary, lines] : both) {
      if (l >= lines.size()) continue;
      const std::string name = boundary == last ? fmt::format("{} {}", boundary, l + 1) : boundary;
      for (std::size_t i = 0; i < lines[l].x.size(); ++i)
        out += fmt::format("{},{:.6g},{:.6g}\n", name, lines[l].x[i], lines[l].y[i]);
      last = name;
    }
  hydro::io::write_atomically(path, out);
}

/// Marks in the cells of one fate; "none found" is one too, waves beyond breaking are left empty, and jumps are marked
/// beside what becomes of them. `told`: after the fates of motions that do not last.
std::vector<plot::Series> marks_of_fates(const StabilityMap& map, const std::string& told) {
  std::vector<plot::Series> out;
  const auto mark = [&](std::size_t c, const std::string& name, const char* colour) {
    auto at = std::find_if(out.begin(), out.end(), [&](const auto& s) { return s.name == name; });
    if (at == out.end())
      at = out.insert(at, {.name = name, .x = {}, .y = {}, .line = false, .marks = true, .colour = colour});
    at->x.push_back(map.period_of(c));
    at->y.push_back(map.height_of(c));
  };
  for (std::size_t c = 0; c < map.cells.size(); ++c) {
    const Cell& cell = map.cells[c];
    if (cell.reached == Reached::jumped) mark(c, "jumped", "#0072b2");
    if (cell.fate == dynamics::frequency::Fate::stable || cell.reached == Reached::beyond_breaking) continue;
    mark(c, fate_of(cell) + (cell.fate ? told : ""),
         cell.fate == dynamics::frequency::Fate::doubled ? "#111111" : "#cc79a7");
  }
  return out;
}

/// Of each signal its standard deviation, with both boundaries and what becomes of motions that do not last.
std::vector<plot::Panel> panels_of_map(const StabilityMap& map) {
  std::vector<plot::Panel> out;
  const auto add = [&](plot::Axis value, const std::vector<double>& values, const std::string& told) {
    std::vector<plot::Series> over = {
        floquet_boundary(map), {.name = "Mathieu", .x = map.period, .y = map.mathieu, .dashed = true, .colour = red}};
    for (plot::Series& marks : marks_of_fates(map, told)) over.push_back(std::move(marks));
    out.push_back({.x = {"wave period", "s"},
                   .y = {"wave height", "m"},
                   .series = std::move(over),
                   .field = field(map, std::move(value), values)});
  };
  std::vector<double> multiplier;
  for (const Cell& c : map.cells) multiplier.push_back(c.multiplier);
  add({"largest |multiplier|", ""}, multiplier, "");
  // The field goes on where a run goes elsewhere: said where the marks are.
  for (const Signal& s : map.signals) add({s.name + ", std. dev.", s.units}, s.values, ", not reached");
  return out;
}

/// A signal along a branch: whole where motions last, dashed between points of which one does not.
plot::Panel panel_of(const Branch& branch, const Signal& signal) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();  // lifts the pen
  plot::Series lasting{.name = "stable", .x = {}, .y = {}, .colour = "#0072b2"};
  plot::Series other{.name = "not stable", .x = {}, .y = {}, .dashed = true, .colour = red};
  const auto lasts = [&](std::size_t i) { return branch.points[i].fate == dynamics::frequency::Fate::stable; };
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    plot::Series& piece = lasts(i - 1) && lasts(i) ? lasting : other;
    piece.x.insert(piece.x.end(), {branch.varied(branch.points[i - 1]), branch.varied(branch.points[i]), nowhere});
    piece.y.insert(piece.y.end(), {signal.values[i - 1], signal.values[i], nowhere});
  }
  const plot::Axis x = branch.over_periods
                           ? plot::Axis{fmt::format("wave period at a height of {:.4g} m", branch.held), "s"}
                           : plot::Axis{fmt::format("wave height at a period of {:.4g} s", branch.held), "m"};
  return {.x = x, .y = {signal.name + ", std. dev.", signal.units}, .series = {std::move(lasting), std::move(other)}};
}

bool is_map(const scene::AskStability& asked) { return asked.periods.size() > 1 && asked.heights.size() > 1; }

plot::Figure figure(const scene::Scene& scene, const StabilityMap& map) {
  plot::Figure out{.title = scene.title.empty() ? "Periodic motions" : scene.title, .panels = {}};
  if (is_map(*scene.stability)) out.panels = panels_of_map(map);
  for (const Branch& branch : map.branches)
    for (const Signal& signal : branch.signals)
      if (!branch.points.empty()) out.panels.push_back(panel_of(branch, signal));
  return out;
}

}  // namespace

void stability(const StabilityArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.stability.has_value(), scene, "a stability map",
                "stability = { periods = \"5 s .. 15 s, 21 values\", heights = \"0.5 m .. 4 m, 8 values\" }");
  if (arguments.picture && !is_map(*scene.stability) && scene.stability->branches.empty())
    throw hydro::InputError("a picture of the map needs two periods and two heights, or a branch",
                            scene.stability->place, "ask for more of them, or leave --picture out");
  if (arguments.boundaries && !is_map(*scene.stability))
    throw hydro::InputError("boundaries need two periods and two heights", scene.stability->place,
                            "ask for more of them, or leave --boundaries out");
  const Path file = checked_output(arguments, ".stability.h5", {{"--boundaries", arguments.boundaries}});
  Progress progress(console.err, "stability", console.show_progress);
  const StabilityMap map = stability(scene, [&](double done) { progress.update(done); });
  map.write(file);
  if (arguments.csv) write_csv(*arguments.csv, map);
  if (arguments.boundaries) write_boundaries(*arguments.boundaries, map);
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(scene, map));
  Report report = report_of(scene, map, file);
  if (!arguments.check.empty()) {
    Progress runs(console.err, "runs", console.show_progress);
    report.part("check",
                report_of(map, check_in_time(scene, map, static_cast<std::size_t>(arguments.check_cells),
                                             arguments.check_duration, [&](double done) { runs.update(done); })));
  }
  tell(report, console);
}

}  // namespace froude
