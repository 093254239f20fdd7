#include <algorithm>
#include <cmath>

#include "answers/scene_runs.hpp"
#include "fit/simulated.hpp"
#include "harness/case.hpp"
#include "harness/damping_tally.hpp"
#include "hydro/base/random.hpp"

namespace froude::validation::huijgen_damping {
namespace {

constexpr double b_l = 0.002, b_q = 0.001;        // of dropper.toml
constexpr double noise = 0.01, smallest = 0.005;  // rad, of an angle; what it is rounded to
constexpr int seeds = 100;

/// The angles without noise, one column a signal of the fit.
MeasuredRun truth(const scene::MotionModel& fit) {
  const Run record = simulate(scene::read(fit.scene.value));
  Eigen::MatrixXd values(std::ssize(record.time), std::ssize(fit.signals));
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const auto& v = record.signal(fit.signals[static_cast<std::size_t>(c)].of);
    values.col(c) = Eigen::Map<const Eigen::VectorXd>(v.data(), std::ssize(v));
  }
  return MeasuredRun::of(record.time, std::move(values), fit.window);
}

MeasuredRun filmed(MeasuredRun run, std::uint64_t seed) {
  const hydro::RandomStream random(seed, 8);
  for (Eigen::Index i = 0; i < run.values.size(); ++i) {
    double& angle = run.values.data()[i];
    angle = smallest * std::round((angle + noise * random.normal(static_cast<std::uint64_t>(i))) / smallest);
  }
  return run;
}

::fit::SimulationFit fitted(const scene::MotionModel& fit, SceneRuns& runs, const MeasuredRun& run,
                            const ::fit::SimulationFit* begin) {
  ::fit::SimulationProblem p;
  for (const auto& q : fit.parameters) p.parameters.push_back(q.number);
  for (std::size_t w = 0; w < run.first.size(); ++w)
    p.measured.emplace_back(run.values.middleRows(run.first[w], run.rows(w)));
  p.deviations.assign(fit.signals.size(), noise);
  p.begin = begin;
  return ::fit::fit_simulation(runs, p);
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto fit = scene::read_fit(folders.own() / "fit.toml").model<scene::MotionModel>();
  const MeasuredRun exact = truth(fit);
  SceneRuns runs(fit, exact);
  DampingTally tally{.b_l = b_l, .b_q = b_q, .estimates = {"b_q against b_l, 100 seeds", {}, {}, false, true}};
  ::fit::SimulationFit first;
  double followed = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    auto f = fitted(fit, runs, filmed(exact, static_cast<std::uint64_t>(seed)), seed == 1 ? nullptr : &first);
    tally.add(f.parameters[0], f.parameters[1]);
    if (seed == 1)
      first = std::move(f);
    else
      followed += static_cast<double>(f.windows_followed);
  }
  return {.numbers = {{"share of seeds with b_l and b_q both in their intervals of 95 %", tally.both / seeds, ""},
                      {"share of seeds with b_l in its interval of 95 %", tally.linear / seeds, ""},
                      {"share of seeds with b_q in its interval of 95 %", tally.quadratic / seeds, ""},
                      {"mean half-width of the interval of b_l, of b_l", tally.half_linear / seeds, ""},
                      {"mean half-width of the interval of b_q, of b_q", tally.half_quadratic / seeds, ""},
                      {"mean error of b_l, of its standard error", tally.error / seeds, ""},
                      {"seeds", seeds, ""},
                      {"windows of 2 s followed for the fit of the first seed",
                       static_cast<double>(first.windows_followed), ""},
                      {"windows of 2 s followed for the fit of another seed, mean", followed / (seeds - 1), ""}},
          .pictures = {{"estimates",
                        "Both dampings from 100 noisy records of the same motion; the truth is at 0.002 and 0.001.",
                        {.title = "Damping of the model dropper",
                         .panels = {{.x = {"b_l", "kg/s"},
                                     .y = {"b_q", "kg/m"},
                                     .series = {tally.estimates, {"truth", {b_l}, {b_q}, false, true}}}}}}}};
}

}  // namespace froude::validation::huijgen_damping
