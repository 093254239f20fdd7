// Frequencies that the program chooses, of five modules between which waves resonate. (P36), (P37), (P6).
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "answers/linear_response.hpp"
#include "answers/rao_check.hpp"
#include "compile/compile.hpp"
#include "compile/cylinders.hpp"
#include "harness/case.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/radiation/rational.hpp"

namespace froude::validation::chosen_frequencies {
namespace {

using hydro::potential::Coefficients;

scene::Scene five_modules(const Folders& folders, double tolerance) {
  scene::Scene scene = scene::parse(hydro::io::read_text(folders.own() / "scene.toml"), folders.own() / "scene.toml");
  for (scene::Body& body : scene.bodies) body.hydrodynamics->cylinders->frequency_tolerance = tolerance;
  return scene;
}

/// Of the same bodies, just at these frequencies.
Coefficients solved_at(scene::Scene scene, const std::vector<double>& omega) {
  for (scene::Body& body : scene.bodies) {
    body.hydrodynamics->cylinders->frequency_tolerance.reset();
    body.hydrodynamics->cylinders->omega = omega;
  }
  return compile::solve_cylinders(scene, compile::bodies_of_cylinders(scene)).coefficients;
}

std::vector<double> evenly(double from, double to, std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1));
  return out;
}

/// The largest miss of B + iω(A − A(∞)) that a user of the table gets, over the largest dampings of the two modes in
/// `truth`, but a tenth of the square root of those of the kind at least (P11).
double missed(const Coefficients& table, const Coefficients& truth) {
  std::vector<Eigen::Vector3d> place;
  for (const auto& body : table.body) place.push_back(*body.reference_point);
  const hydro::potential::FrequencyTable read(table, place);
  Eigen::VectorXd size = Eigen::VectorXd::Zero(truth.modes());
  for (const auto& B : truth.B) size = size.cwiseMax(B.diagonal());
  double largest[2] = {0, 0};
  for (Eigen::Index i = 0; i < size.size(); ++i) largest[i % 6 / 3] = std::max(largest[i % 6 / 3], size[i]);
  for (Eigen::Index i = 0; i < size.size(); ++i) size[i] = std::sqrt(std::max(size[i], 0.01 * largest[i % 6 / 3]));
  double out = 0;
  for (std::size_t w = 0; w < truth.omega.size(); ++w) {
    const double omega = truth.omega[w];
    const Eigen::MatrixXd B = read.damping(omega) - truth.B[w], A = omega * (read.added_mass(omega) - truth.A[w]);
    for (Eigen::Index i = 0; i < size.size(); ++i)
      for (Eigen::Index j = 0; j < size.size(); ++j)
        out = std::max(out, std::hypot(B(i, j), A(i, j)) / (size[i] * size[j]));
  }
  return out;
}

/// The largest difference of responses, of each kind of motion over its largest.
double apart(const Responses& a, const Responses& b) {
  std::map<std::string, double> size, difference;
  for (std::size_t s = 0; s < a.signals.size(); ++s) {
    const std::string kind = a.signals[s].name.substr(a.signals[s].name.find('.'));
    for (std::size_t i = 0; i < a.signals[s].values.size(); ++i) {
      size[kind] = std::max(size[kind], std::abs(b.signals[s].values[i]));
      difference[kind] = std::max(difference[kind], std::abs(a.signals[s].values[i] - b.signals[s].values[i]));
    }
  }
  double out = 0;
  for (const auto& [kind, d] : difference) out = std::max(out, d / size[kind]);
  return out;
}

/// The largest difference of runs of `scene` in regular waves of 2.5 to 5 s from responses of `finer`, over their
/// peaks.
double runs_apart(scene::Scene scene, scene::Scene finer) {
  scene.rao->omega = finer.rao->omega = evenly(2 * std::numbers::pi / 5, 2 * std::numbers::pi / 2.5, 41);
  double out = 0;
  for (const CheckedCell& cell : check_in_time(scene, respond(finer, compile::prepare(finer))))
    out = std::max(out, cell.difference());
  return out;
}

plot::Series heave_damping(const char* name, const Coefficients& c, bool marks) {
  plot::Series s{.name = name, .x = c.omega, .y = {}, .line = !marks, .marks = marks};
  for (const auto& B : c.B) s.y.push_back(B(14, 14) / 1000);
  return s;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const scene::Scene scene = five_modules(folders, 1e-2), finer = five_modules(folders, 1e-3);
  const auto chosen = compile::solve_cylinders(scene, compile::bodies_of_cylinders(scene));
  const Coefficients& table = chosen.coefficients;
  // 173 places that are none of an even grid, a fiftieth of a radian a second apart.
  const Coefficients truth = solved_at(scene, evenly(0.2137, 3.9871, 173));
  const std::size_t count = chosen.check.solved_omega.size();
  const Coefficients even = solved_at(scene, evenly(table.omega.front(), table.omega.back(), count));
  const auto memory =
      hydro::radiation::fit({table.omega, table.B}, table.A, table.A_inf, {.tolerance = 1e-2, .largest_order = 160});
  const double rao = apart(respond(scene, compile::prepare(scene)), respond(finer, compile::prepare(finer)));
  Coefficients solved = solved_at(scene, chosen.check.solved_omega);
  const plot::Panel panel{.x = {.label = "frequency", .unit = "rad/s"},
                          .y = {.label = "heave damping of the middle module", .unit = "t/s"},
                          .series = {heave_damping("table", table, false), heave_damping("solved", solved, true)}};
  return {.numbers = {{"frequencies solved", static_cast<double>(count), ""},
                      {"largest error at 173 unseen frequencies", missed(table, truth), ""},
                      {"the same by cubics between as many even ones", missed(even, truth), ""},
                      {"memory by poles, largest error", memory.report.error, ""},
                      {"responses against those with a tolerance of 1e-3", rao, ""},
                      {"runs in waves of 2.5 to 5 s against those responses", runs_apart(scene, finer), ""}},
          .pictures = {{"damping",
                        "Heave damping of the middle one of five modules: where it was solved, and the table.",
                        {.title = "Chosen frequencies", .panels = {panel}}}}};
}

}  // namespace froude::validation::chosen_frequencies
