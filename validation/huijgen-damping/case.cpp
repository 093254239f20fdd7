#include <algorithm>
#include <cmath>

#include "fit/simulated.hpp"
#include "froude/scene_runs.hpp"
#include "harness/case.hpp"
#include "hydro/base/random.hpp"
#include "scene/fit_scene.hpp"

namespace froude::validation {
namespace {

constexpr double b_l = 0.002, b_q = 0.001;        // of dropper.toml
constexpr double noise = 0.01, smallest = 0.005;  // rad, of an angle; what it is rounded to
constexpr int seeds = 100;

/// The angles without noise, one column a signal of the fit.
MeasuredRun truth(const scene::FitScene& fit) {
  const Record record = simulate(scene::read(fit.motion.scene.value));
  Eigen::MatrixXd values(std::ssize(record.time), std::ssize(fit.motion.signals));
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const auto& v = record.signal(fit.motion.signals[static_cast<std::size_t>(c)].of);
    values.col(c) = Eigen::Map<const Eigen::VectorXd>(v.data(), std::ssize(v));
  }
  return MeasuredRun::of(record.time, std::move(values), fit.motion.window);
}

MeasuredRun filmed(MeasuredRun run, std::uint64_t seed) {
  const hydro::RandomStream random(seed, 8);
  for (Eigen::Index i = 0; i < run.values.size(); ++i) {
    double& angle = run.values.data()[i];
    angle = smallest * std::round((angle + noise * random.normal(static_cast<std::uint64_t>(i))) / smallest);
  }
  return run;
}

::fit::SimulationFit fitted(const scene::FitScene& fit, const MeasuredRun& run) {
  ::fit::SimulationProblem p;
  for (const auto& q : fit.motion.parameters) p.parameters.push_back({q.key, q.first, *q.lowest});
  for (std::size_t w = 0; w < run.first.size(); ++w)
    p.measured.emplace_back(run.values.middleRows(run.first[w], run.rows(w)));
  p.deviations.assign(fit.motion.signals.size(), noise);
  SceneRuns runs(fit, run);
  return ::fit::fit_simulation(runs, p);
}

bool holds(const ::fit::Coefficient& c, double value) { return c.interval.low <= value && value <= c.interval.high; }

}  // namespace

Outcome huijgen_damping(const Folders& folders) {
  const scene::FitScene fit = scene::read_fit(folders.own() / "fit.toml");
  const MeasuredRun exact = truth(fit);
  double both = 0, linear = 0, quadratic = 0, half_linear = 0, half_quadratic = 0, bias = 0, followed = 0;
  plot::Series estimates{"b_q against b_l, 100 seeds", {}, {}, false, true};
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto f = fitted(fit, filmed(exact, static_cast<std::uint64_t>(seed)));
    const auto &l = f.parameters[0], &q = f.parameters[1];
    linear += holds(l, b_l);
    quadratic += holds(q, b_q);
    both += holds(l, b_l) && holds(q, b_q);
    half_linear += (l.interval.high - l.interval.low) / 2 / b_l;
    half_quadratic += (q.interval.high - q.interval.low) / 2 / b_q;
    const double middle_l = (l.interval.low + l.interval.high) / 2, middle_q = (q.interval.low + q.interval.high) / 2;
    bias += (middle_l - b_l) / l.standard_error;
    followed += static_cast<double>(f.windows_followed);
    estimates.x.push_back(middle_l);
    estimates.y.push_back(middle_q);
  }
  return {.numbers = {{"share of seeds with b_l and b_q both in their intervals of 95 %", both / seeds, ""},
                      {"share of seeds with b_l in its interval of 95 %", linear / seeds, ""},
                      {"share of seeds with b_q in its interval of 95 %", quadratic / seeds, ""},
                      {"mean half-width of the interval of b_l, of b_l", half_linear / seeds, ""},
                      {"mean half-width of the interval of b_q, of b_q", half_quadratic / seeds, ""},
                      {"mean error of b_l, of its standard error", bias / seeds, ""},
                      {"windows of 2 s followed for one fit", followed / seeds, ""}},
          .pictures = {{"estimates",
                        "Both dampings from 100 noisy records of the same motion; the truth is at 0.002 and 0.001.",
                        {.title = "Damping of the model dropper",
                         .panels = {{.x = {"b_l", "kg/s"},
                                     .y = {"b_q", "kg/m"},
                                     .series = {estimates, {"truth", {b_l}, {b_q}, false, true}}}}}}}};
}

}  // namespace froude::validation
