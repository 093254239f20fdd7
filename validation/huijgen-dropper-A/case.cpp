#include <algorithm>
#include <cmath>
#include <sstream>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/node_damping.hpp"
#include "dynamics/line/stepper.hpp"
#include "harness/case.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/line_models.hpp"

namespace froude::validation::huijgen_dropper {
namespace {

namespace dl = dynamics::line;
constexpr int links = 7;
constexpr double gap = 0.4;

/// Angles of one run, positive down; a run that was not made is empty.
using Angles = std::vector<double>;

std::vector<Angles> measured(const std::filesystem::path& file, const std::string& scenario) {
  const std::string text = hydro::io::read_text(file);
  std::vector<Angles> runs(3);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(scenario + ",")) continue;
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; std::getline(cells, cell, ',') && column < 5; ++column)
      if (column >= 2 && !cell.empty())
        // In B and C the source counts angles the other way round.
        runs[static_cast<std::size_t>(column) - 2].push_back((scenario == "A" ? 1 : -1) * std::stod(cell));
  }
  std::erase_if(runs, [](const Angles& a) { return a.empty(); });
  for (const Angles& a : runs) hydro::require(a.size() == links, "scenario {} needs {} angles", scenario, links);
  return runs;
}

/// Rest with node `lifted` where the angles put it; the largest difference of an angle from them.
double difference_at_rest(const Angles& angles, int lifted) {
  dl::Description d = support::dropper();
  d.held.push_back({.node = lifted});
  const dl::Line line(d);
  dl::State s = support::in_plane(line, angles);
  s.position.col(links) = Eigen::Vector3d(gap, 0, 0);
  const dl::State rest = dl::equilibrium(line, dl::hanging_shape(line, s));
  double worst = 0;
  for (int j = 0; j < links; ++j) {
    const double now = dl::link_angles(rest, j, {angles[static_cast<std::size_t>(j)], 0}).polar;
    worst = std::max(worst, std::abs(now - angles[static_cast<std::size_t>(j)]));
  }
  return worst;
}

struct Swing {
  plot::Series angle{.name = {}, .x = {}, .y = {}};  ///< of the second link
  double change = 0, tail = 0;  ///< of energy, of the largest kinetic energy; half the range of the angle from 45 s on
  bool failed = false;
};

Swing swing(const Angles& angles, const dl::Stepper::Settings& settings, double h, bool damped) {
  dl::Description d = support::dropper();
  if (damped)
    for (dl::Node& n : d.nodes)
      n.forces = {std::make_shared<dl::NodeDamping>(dl::NodeDamping::Coefficients{0.002, 0.001})};
  const dl::Line line(d);
  dl::State s = support::in_plane(line, angles);
  dl::Stepper stepper(line, settings);
  stepper.start(s);
  Swing out;
  dl::LinkAngles last = dl::link_angles(s, 1);
  double liveliest = 0, low = 1e9, high = -1e9;
  try {
    for (int i = 1; i <= static_cast<int>(std::lround(50 / h)); ++i) {
      stepper.step(s, h);
      liveliest = std::max(liveliest, stepper.energies().kinetic);
      out.change = std::max(out.change, std::abs(stepper.energies().residual()));
      last = dl::link_angles(s, 1, last);
      if (s.time >= 45) low = std::min(low, last.polar), high = std::max(high, last.polar);
      out.angle.x.push_back(s.time);
      out.angle.y.push_back(last.polar);
    }
  } catch (const hydro::NumericsError&) {
    out.failed = true;
  }
  out.change /= liveliest;
  out.tail = (high - low) / 2;
  return out;
}

Outcome dropper(const std::filesystem::path& table, const std::string& scenario, int lifted) {
  const std::vector<Angles> runs = measured(table, scenario);
  double at_rest = 0;
  for (const Angles& a : runs) at_rest = std::max(at_rest, difference_at_rest(a, lifted));
  const Angles& start = runs[1];
  const dl::Stepper::Settings keeping{}, trapezium{.scheme = dl::Scheme::gamma, .gamma = 0.5};
  const Swing fine = swing(start, keeping, 0.0065, false), coarse = swing(start, keeping, 0.05, false);
  const Swing half_fine = swing(start, trapezium, 0.0065, false), half_coarse = swing(start, trapezium, 0.05, false);
  Swing damped = swing(start, keeping, 0.0065, true);
  const int failures = fine.failed + coarse.failed + half_fine.failed + half_coarse.failed;
  Swing shown = fine;
  shown.angle.name = "undamped";
  damped.angle.name = "b_l = 0.002 kg/s, b_q = 0.001 kg";
  return {.numbers = {{"angles of the links at rest, largest difference from the measured ones", at_rest, "rad"},
                      {"undamped runs of 50 s that failed, gamma = 1/2 and energy-momentum at 0.0065 and 0.05 s",
                       static_cast<double>(failures), ""},
                      {"energy-momentum, step 0.05 s: largest change of energy, of the largest kinetic energy",
                       coarse.change, ""},
                      {"energy-momentum, step 0.0065 s: largest change of energy, of the largest kinetic energy",
                       fine.change, ""},
                      {"gamma = 1/2, step 0.0065 s: the same", half_fine.change, ""},
                      {"damped: half the range of the second link's angle from 45 to 50 s", damped.tail, "rad"}},
          .pictures = {{"angle",
                        "Second link after the release: undamped by energy-momentum, and with the source's damping.",
                        {.title = "Model dropper, scenario " + scenario,
                         .panels = {{.x = {.label = "time", .unit = "s"},
                                     .y = {.label = "polar angle of link 2", .unit = "rad"},
                                     .series = {shown.angle, damped.angle}}}}}}};
}

}  // namespace

// The three scenarios differ in the node that was lifted; the table stands with the first.
Outcome of_a(const Folders& f) { return dropper(f.reference("huijgen_E2_E3_E4_initial_angles.csv"), "A", 1); }
Outcome of_b(const Folders& f) {
  return dropper(f.own().parent_path() / "huijgen-dropper-A/reference/huijgen_E2_E3_E4_initial_angles.csv", "B", 2);
}
Outcome of_c(const Folders& f) {
  return dropper(f.own().parent_path() / "huijgen-dropper-A/reference/huijgen_E2_E3_E4_initial_angles.csv", "C", 3);
}

}  // namespace froude::validation::huijgen_dropper
