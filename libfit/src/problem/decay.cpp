#include "decay_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/verdict.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"
#include "telling.hpp"

namespace fit::decay {
namespace {

Record prepared(const Problem& problem, const Run& run) {
  auto motion = prepare_motion(problem.turns ? "angle" : "position", run.time, run.motion, problem.options.prepare);
  return {run.source.name(), std::move(motion.time), std::move(motion.values), std::move(motion.steps),
          std::move(motion.cautions)};
}

Window window_of(const Record& r) {
  return {hydro::signal::even_step(r.time), Eigen::Map<const Eigen::VectorXd>(r.values.data(), std::ssize(r.values))};
}

/// Of the fit without a memory, which a memory is set against.
DecayOptions plain(const Options& options) {
  DecayOptions out = options.motion;
  if (out.terms.count() == 0) out.terms.linear = true;
  return out;
}

/// The same fit of each half of the record: where they differ by many errors, damping is not what the terms say.
void vary(const Options& options, const Window& whole, FittedRun& run) {
  const Eigen::Index n = whole.values.rows(), half = n / 2;
  for (const bool first : {true, false}) {
    Variant v{first ? "the first half of the record" : "the second half of the record", {}, {}};
    const Eigen::MatrixXd part = whole.values.middleRows(first ? 0 : half, first ? half : n - half);
    try {
      const DecayFit again = fit_decay(std::vector{Window{whole.step, part}}, plain(options));
      const auto add = [&](const Coefficient& a, const Coefficient& b) {
        v.changes.push_back((middle(a) - middle(b)) / b.standard_error);
      };
      add(again.period, run.fit.period);
      for (std::size_t k = 0; k < again.damping.size(); ++k) add(again.damping[k], run.fit.damping[k]);
    } catch (const hydro::InputError& e) {
      v.why_not = e.rule();
    } catch (const hydro::NumericsError& e) {
      v.why_not = e.what();
    }
    run.variants.push_back(std::move(v));
  }
}

/// (F67) Nobody has stated how large residuals of a decay may be; larger than what is explained is too large.
void require_explained(const Problem& problem, const FittedRun& run, const ShootingFit& motion) {
  if (motion.explained[0] >= least_explained || problem.options.accept_residuals) return;
  throw Refused{
      {Refusal::Reason::residuals_too_large,
       fmt::format("no value is told: the motion fitted differs by {:.3g} {} rms from {} and explains {:.3g} "
                   "% of its variance; {:g} % are the least",
                   motion.rms[0], problem.turns ? "rad" : "m", run.alone() ? run.name() : "the records together",
                   100 * motion.explained[0], 100 * least_explained),
       run.source.file.string()}};
}

/// The memory, and what it makes of the body where that is known.
void add_memory(const Problem& problem, const std::vector<Window>& windows, FittedRun& run) {
  run.memory = fit_decay_memory(windows, *problem.options.memory);
  require_explained(problem, run, run.memory->motion);
  if (!problem.body) return;
  const auto at = [&](double omega) {
    return radiation_of(*run.memory, *problem.body, omega, problem.options.motion.confidence);
  };
  run.swing = at(run.memory->omega);
  run.limit = at(std::numeric_limits<double>::infinity());
  for (int k = 1; k <= 100; ++k) run.curve.push_back(at(0.03 * k * run.memory->omega));
}

/// What is left of one record by the model that holds what was asked for. The scale of harmonics is that of the record.
std::optional<ResidualReport> residuals_of(const FittedRun& run, const Window& window) {
  const Eigen::VectorXd measured = window.values.col(0);
  if (!run.alone() || measured.size() < 64 || !run.fit.period.value) return {};
  return look_at_residuals(measured - (run.memory ? run.memory->motion : run.fit.motion).motion[0].col(0),
                           std::sqrt((measured.array() - measured.mean()).square().mean()), window.step,
                           *run.fit.period.value);
}

std::vector<Interval> profiles_of(const DecayFit& fit) {
  const auto names = parameters_of(fit.problem.law);
  std::vector<Interval> out;
  for (const Coefficient& c : fit.damping) {
    const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), c.name) - names.begin());
    out.push_back(profile_interval(fit.problem, fit.motion, at));
  }
  return out;
}

/// Fits the records of a run with one set of coefficients.
FittedRun fitted(const Problem& problem, const Source& source, std::vector<Record> records) try {
  const Options& options = problem.options;
  FittedRun run{.source = source, .records = std::move(records), .decrement = {}, .fit = {}};
  std::vector<Window> windows;
  for (const Record& r : run.records) windows.push_back(window_of(r));
  run.decrement = logarithmic_decrement(find_extremes(run.records[0].time, run.records[0].values));
  run.fit = fit_decay(windows, plain(options));
  require_explained(problem, run, run.fit.motion);
  if (options.sensitivity && run.alone()) vary(options, windows[0], run);
  if (problem.body) run.water = added_mass(run.fit, *problem.body, options.motion.confidence);
  if (options.memory) add_memory(problem, windows, run);
  run.left = residuals_of(run, windows[0]);
  if (options.profile) run.profiles = profiles_of(run.fit);
  return run;
} catch (const SearchFailed& e) {
  throw Refused{
      {Refusal::Reason::search_without_end, std::string("no value is told: ") + e.what(), source.file.string()}};
}

/// (F63) All runs with one set of coefficients; each keeps the rest position that its own best fit has.
std::optional<FittedRun> fitted_together(const Problem& problem, const std::vector<FittedRun>& runs) {
  if (!problem.options.together) return {};
  hydro::require(runs.size() >= 2, "one run cannot be fitted together with others");
  std::vector<Record> records;
  for (const FittedRun& run : runs) {
    Record r = run.records[0];
    const double rest = run.memory ? run.memory->motion.ended[4] : run.fit.motion.ended[5];
    for (double& x : r.values) x -= rest;
    records.push_back(std::move(r));
  }
  return fitted(problem, {}, std::move(records));
}

}  // namespace

Solution solve(const Problem& problem) try {
  hydro::require(!problem.runs.empty(), "a fit of decays needs one record at least");
  Solution out;
  for (const Run& run : problem.runs)
    out.runs.push_back(of_run(run.source, [&] { return fitted(problem, run.source, {prepared(problem, run)}); }));
  out.together = fitted_together(problem, out.runs);
  out.report = told(problem, out.runs, out.together);
  return out;
} catch (const Refused& e) {
  return {.report = {.refused = e.refusal}, .runs = {}, .together = {}};
}

}  // namespace fit::decay
