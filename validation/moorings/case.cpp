#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include <fmt/format.h>

#include "dynamics/line/catenary.hpp"
#include "dynamics/line/path.hpp"
#include "harness/case.hpp"
#include "harness/line_cases.hpp"
#include "hydro/base/interpolation.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation::moorings {
namespace {

using Eigen::Vector3d;

/// Rows of numbers between blanks or commas.
std::vector<std::vector<double>> table(const std::filesystem::path& file) {
  std::string text = hydro::io::read_text(file);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    std::vector<double> row;
    for (double x = 0; numbers >> x;) row.push_back(x);
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

/// One of MoorDyn's three chains, as its input files have them.
struct Chain {
  int depth;
  double span, length;
  int segments;
  double fairlead_kn, anchor_kn;  ///< of quasi-static codes
};
const std::vector<Chain> chains{
    {50, 400, 410, 41, 991.6, 826.2}, {200, 700, 760, 76, 2065.4, 1402.2}, {600, 1500, 1700, 170, 5232.6, 3244.2}};

MooringLine mooring(const Chain& c) {
  const double depth = c.depth, ell = c.length / c.segments;
  return {.length = c.length,
          .mass_per_length = 390,
          .diameter = 0.252,
          .axial_stiffness = 1.674e9,
          .axial_damping = ell * std::sqrt(1.674e9 * 390),
          .cd = 1.37,
          .cd_tangential = 0.64,
          .ca = 1,
          .anchor = {c.span, 0, -depth},
          .fairlead = {0, 0, 0},
          .water = {.density = 1025, .gravity = 9.80665, .depth = hydro::WaterDepth::from_metres(depth)},
          .bed = {{.z = -depth, .stiffness = 1e5, .damping = 1e4, .friction = 0.5}}};
}

struct Range {
  double low, high;
};
Range range(const std::vector<double>& v) {
  return {*std::min_element(v.begin(), v.end()), *std::max_element(v.begin(), v.end())};
}

/// Tension and shape at rest, added to `out`; the worst differences from the catenary.
struct FromCatenary {
  double tension = 0, place = 0;
};
void add_static(const Chain& c, FromCatenary& worst, Outcome& out) {
  const MooringLine line = mooring(c);
  const dynamics::line::State s = line.at_rest(c.segments);
  const EndPulls pulls = end_pulls(line, s);
  // The chain sinks until the bed carries it: the catenary stands on that level.
  const double sunk = line.weight() / (line.bed.front().stiffness * line.diameter);
  const auto exact = dynamics::catenary({c.length, line.weight(), line.axial_stiffness, true}, c.span, c.depth + sunk);
  worst.tension = std::max(worst.tension, std::abs(pulls.fairlead.norm() / exact.fairlead() - 1));
  for (int i = 1; i < c.segments; ++i) {
    const double along = c.length * i / c.segments, hanging = along - exact.resting;
    Eigen::Vector2d at(along * (1 + exact.horizontal / line.axial_stiffness), 0);
    if (hanging > 0)
      at = dynamics::catenary_span({hanging, line.weight(), line.axial_stiffness, false}, exact.horizontal,
                                   line.weight() * hanging) +
           Eigen::Vector2d(exact.resting * (1 + exact.horizontal / line.axial_stiffness), 0);
    const Vector3d place(c.span - at.x(), 0, at.y() - c.depth - sunk);
    worst.place = std::max(worst.place, (s.position.col(i) - place).norm() / c.length);
  }
  out.numbers.push_back({fmt::format("static fairlead tension, {} m, over the reference", c.depth),
                         pulls.fairlead.norm() / 1e3 / c.fairlead_kn, ""});
  out.numbers.push_back({fmt::format("static anchor tension, {} m, over the reference", c.depth),
                         pulls.anchor.norm() / 1e3 / c.anchor_kn, ""});
}

/// How a driven chain differs from the reference at its fairlead.
struct Difference {
  double range;    ///< of the tension, over the reference's, less one
  double dynamic;  ///< largest of what comes on top of the static tension, over twice the reference's largest
};
Difference heaving(const Folders& folders, const Chain& c, const std::string& motion, plot::Panel& panel) {
  const std::string folder = "mooring_lines/moordyn/QuasiStatic/";
  std::vector<double> time;
  std::vector<Vector3d> places;
  for (const auto& row : table(folders.shared(folder + motion + ".txt"))) {
    time.push_back(row[0]);
    places.emplace_back(row[1], row[2], row[3]);
  }
  const PrescribedRun run =
      run_prescribed(mooring(c), c.segments, std::make_shared<dynamics::line::SplinePath>(time, places), time.front(),
                     time.back() - 0.1, 0.05);
  plot::Series ours{.name = "ours", .x = {}, .y = {}}, theirs{.name = "reference", .x = {}, .y = {}, .dashed = true};
  for (std::size_t i = 0; i < run.time.size(); ++i)
    if (run.time[i] >= 0) ours.x.push_back(run.time[i]), ours.y.push_back(run.fairlead[i] / 1e3);
  for (const auto& row : table(folders.shared(fmt::format("{}WD{:04}_Chain_{}.txt", folder, c.depth, motion)))) {
    theirs.x.push_back(row[0]);
    theirs.y.push_back(row[3]);
  }
  const Range our = range(ours.y), their = range(theirs.y);
  // As MoorDyn's test of these runs has it: both less their own static tension, at the instants of the reference.
  const double rest = end_pulls(mooring(c), mooring(c).at_rest(c.segments)).fairlead.norm() / 1e3;
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < theirs.x.size() && theirs.x[i] <= ours.x.back(); ++i) {
    const double on_top = theirs.y[i] - c.fairlead_kn;
    const hydro::Stencil s = hydro::straight_stencil(ours.x, theirs.x[i]);
    const double there = s.weight[0] * ours.y[s.first] + s.weight[1] * ours.y[s.first + 1];
    difference = std::max(difference, std::abs(there - rest - on_top));
    largest = std::max(largest, std::abs(on_top));
  }
  panel.series = {ours, theirs};
  return {(our.high - our.low) / (their.high - their.low) - 1, difference / (2 * largest)};
}

// ---- the jumper ----

MooringLine jumper() {
  return {.length = 170,
          .mass_per_length = 165,
          .diameter = 0.396,
          .axial_stiffness = 500e6,
          .axial_damping = 0.5 * 170 / 68 * std::sqrt(500e6 * 165),
          .cd = 1,
          .cd_tangential = 0,
          .ca = 1,
          .anchor = {-100, 0, -55},
          .fairlead = {0, 0, -5},
          .water = {.density = 1000, .gravity = 9.807, .depth = hydro::WaterDepth::from_metres(100)},
          .wet = dynamics::line::Wet::below_surface,
          .catenary = false};
}

class Driven final : public dynamics::line::Path {
 public:
  Driven(const Vector3d& place, const Vector3d& way) : place_(place), way_(way) {}
  Place at(double t) const override {
    constexpr double omega = 2 * std::numbers::pi / 27;
    return {place_ + std::sin(omega * t) * way_, omega * std::cos(omega * t) * way_,
            -omega * omega * std::sin(omega * t) * way_};
  }

 private:
  Vector3d place_, way_;
};

/// rms difference over the digitised record after the best shift of time; the panel shows both.
double driven(const Folders& folders, int axis, plot::Panel& panel) {
  const MooringLine line = jumper();
  constexpr double h = 0.05, period = 27;
  const PrescribedRun run =
      run_prescribed(line, 34, std::make_shared<Driven>(line.fairlead, 10 * Vector3d::Unit(axis)), 0, 6 * period, h);
  const auto theirs = table(folders.shared(fmt::format("mooring_lines/lowe_and_langley_2006/Case_{}.csv", axis + 1)));
  const auto ours_at = [&](double t) {  // from the fourth period on
    const double steps = (3 * period + std::fmod(t, period)) / h - 1;
    const auto k = static_cast<std::size_t>(steps);
    const double share = steps - std::floor(steps);
    return ((1 - share) * run.fairlead[k] + share * run.fairlead[k + 1]) / 1e3;
  };
  double best = 1e9, best_shift = 0;
  for (double shift = 0; shift < period; shift += 0.1) {
    double sum = 0;
    for (const auto& row : theirs) sum += std::pow(ours_at(row[0] + shift) - row[1], 2);
    const double rms = std::sqrt(sum / static_cast<double>(theirs.size()));
    if (rms < best) best = rms, best_shift = shift;
  }
  plot::Series ours{.name = "ours", .x = {}, .y = {}}, reference{.name = "digitised", .x = {}, .y = {}, .dashed = true};
  for (const auto& row : theirs) {
    reference.x.push_back(row[0]);
    reference.y.push_back(row[1]);
    ours.x.push_back(row[0]);
    ours.y.push_back(ours_at(row[0] + best_shift));
  }
  panel.series = {ours, reference};
  return best;
}

plot::Panel tension_panel(const std::string& label) {
  return {.x = {.label = "time", .unit = "s"}, .y = {.label = label, .unit = "kN"}, .series = {}};
}

}  // namespace

Outcome outcome(const Folders& folders) {
  Outcome out;
  FromCatenary worst;
  for (const Chain& c : chains) add_static(c, worst, out);
  out.numbers.push_back({"static fairlead tensions against the catenary, worst, relative", worst.tension, ""});
  out.numbers.push_back(
      {"static shape against the catenary, worst distance of a node, of the length", worst.place, ""});
  double dynamic = 0;
  plot::Figure heave{.title = "Heaving fairlead, 2 m at 10 s", .panels = {}};
  for (const Chain& c : chains)
    for (const char* motion : {"ZZP1_A1", "ZZP1_A2"}) {
      plot::Panel panel = tension_panel(fmt::format("tension, {} m", c.depth));
      const Difference off = heaving(folders, c, motion, panel);
      out.numbers.push_back(
          {fmt::format("heaving fairlead, {} m, {}: range over the reference's", c.depth, motion), 1 + off.range, ""});
      dynamic = std::max(dynamic, off.dynamic);
      if (motion == std::string("ZZP1_A1")) heave.panels.push_back(panel);
    }
  out.numbers.push_back(
      {"heaving fairlead, dynamic tension: largest difference over twice the reference's largest, worst of six runs",
       dynamic, ""});
  const MooringLine line = jumper();
  const Vector3d top = end_pulls(line, line.at_rest(34)).fairlead;
  out.numbers.push_back({"jumper, static top tension, horizontal", std::hypot(top.x(), top.y()) / 1e3, "kN"});
  out.numbers.push_back({"jumper, static top tension, vertical", std::abs(top.z()) / 1e3, "kN"});
  plot::Figure jumper_figure{.title = "Driven jumper", .panels = {}};
  for (int axis = 0; axis < 3; ++axis) {
    plot::Panel panel = tension_panel(fmt::format("along {}", "xyz"[axis]));
    out.numbers.push_back({fmt::format("jumper, driven along {}: rms difference of the top tension", "xyz"[axis]),
                           driven(folders, axis, panel), "kN"});
    jumper_figure.panels.push_back(panel);
  }
  out.pictures = {{"heave", "Tension at the fairlead of three chains.", heave, true},
                  {"jumper", "Tension at the top of the jumper.", jumper_figure, true}};
  return out;
}

}  // namespace froude::validation::moorings
