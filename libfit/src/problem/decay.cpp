#include "decay_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "decay_rest.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/welch.hpp"
#include "swings.hpp"
#include "telling.hpp"

namespace fit::decay {
namespace {

Record prepared(const Problem& problem, const Run& run) {
  if (problem.turns) require_within_half_a_turn(run.motion);
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

/// The same fit of one half of a record.
DecayFit fit_half(const Options& options, const Window& whole, bool first) {
  const Eigen::Index n = whole.values.rows(), half = n / 2;
  const Eigen::MatrixXd part = whole.values.middleRows(first ? 0 : half, first ? half : n - half);
  return fit_decay(std::vector{Window{whole.step, part}}, plain(options));
}

/// Why a half of a record tells nothing by itself; empty where it does.
std::string half_trouble(const DecayFit& half) {
  if (half.motion.explained[0] < least_explained)
    return fmt::format("its motion explains {:.3g} % of the variance", 100 * half.motion.explained[0]);
  if (!half.motion.search.all_identifiable()) return half.motion.search.identifiability;
  const auto told = [](const Coefficient& c) { return std::isfinite(middle(c)) && std::isfinite(c.standard_error); };
  if (!told(half.period) || !std::all_of(half.damping.begin(), half.damping.end(), told))
    return "its search tells no error of a coefficient";
  return {};
}

/// Where halves differ from the whole by many errors, damping is not what the terms say.
void vary(const Options& options, const Window& whole, FittedRun& run) {
  for (const bool first : {true, false}) {
    Variant v{first ? "the first half of the record" : "the second half of the record", {}, {}};
    try {
      const DecayFit again = fit_half(options, whole, first);
      v.why_not = half_trouble(again);
      const auto add = [&](const Coefficient& a, const Coefficient& b) {
        v.changes.push_back((middle(a) - middle(b)) / b.standard_error);
      };
      if (v.why_not.empty()) add(again.period, run.fit.period);
      for (std::size_t k = 0; v.why_not.empty() && k < again.damping.size(); ++k)
        add(again.damping[k], run.fit.damping[k]);
    } catch (const hydro::InputError& e) {
      v.why_not = e.rule();
    } catch (const hydro::NumericsError& e) {
      v.why_not = e.what();
    }
    run.variants.push_back(std::move(v));
  }
}

/// Where a search ended, of the parameters that were fitted.
std::vector<std::string> best_point(const Problem& problem, const ShootingFit& motion) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < motion.parameters.size(); ++k) {
    const Coefficient& c = motion.parameters[k];
    if (c.standard_error == 0) continue;  // held
    const bool frequency = c.name == "omega0";
    const std::string name = frequency ? "period" : c.name;
    out.push_back(fmt::format("{} {:.5g} {}", name,
                              frequency ? 2 * std::numbers::pi / motion.ended[k] : motion.ended[k],
                              unit_of(name, problem.turns)));
  }
  return out;
}

/// (F67) Nobody has stated how large residuals of a decay may be; larger than what is explained is too large.
void require_explained(const Problem& problem, const FittedRun& run, const ShootingFit& motion) {
  if (motion.explained[0] >= least_explained || problem.options.accept_residuals) return;
  throw Refused{
      {.reason = Refusal::Reason::residuals_too_large,
       .why = fmt::format("no value is told: the motion fitted differs by {:.3g} {} rms from {} and explains {:.3g} "
                          "% of its variance; {:g} % are the least",
                          motion.rms[0], problem.turns ? "rad" : "m", run.alone() ? run.name() : "the records together",
                          100 * motion.explained[0], 100 * least_explained),
       .source = run.source.file.string(),
       .best_point = best_point(problem, motion)}};
}

/// Differences of the halves' coefficients over what chance allows, the largest of them.
double difference(const DecayFit& a, const DecayFit& b) {
  // One right record in a thousand differs by more; an error made from some thirty independent residuals is itself
  // known to an eighth, and so are two of them together.
  constexpr double chance = 1e-3, known = 1.25;
  const auto tests = static_cast<double>(a.damping.size() + 1);
  const double allowed =
      known * hydro::signal::student_t_quantile(1 - chance / (2 * tests), std::min(a.motion.dof, b.motion.dof));
  const auto apart = [&](const Coefficient& x, const Coefficient& y) {
    const double error = std::hypot(x.standard_error, y.standard_error);
    return error > 0 ? std::abs(middle(x) - middle(y)) / (allowed * error) : 0.0;
  };
  double out = apart(a.period, b.period);
  for (std::size_t k = 0; k < a.damping.size(); ++k) out = std::max(out, apart(a.damping[k], b.damping[k]));
  return out;
}

/// (F78) Terms that are right tell the same of each half of a record.
void compare_halves(const Problem& problem, const Window& whole, FittedRun& run) {
  if (!run.alone() || problem.options.memory) return;
  std::optional<DecayFit> first, second;
  for (auto* half : {&first, &second}) {
    std::string why;
    try {
      *half = fit_half(problem.options, whole, half == &first);
      why = half_trouble(**half);
    } catch (const hydro::InputError& e) {  // a half with two swings tells nothing by itself
      why = e.rule();
    } catch (const hydro::NumericsError& e) {  // nor does one in which the motion has died out
      why = e.what();
    }
    if (why.empty()) continue;
    run.records[0].steps.push_back(fmt::format("both halves of the record cannot be compared: of the {} one, {}",
                                               half == &first ? "first" : "second", why));
    return;
  }
  run.halves = difference(*first, *second);
  if (run.halves < 1 || problem.options.accept_residuals) return;
  std::string told;
  const auto tell = [&](const Coefficient& of, const Coefficient& a, const Coefficient& b) {
    told += fmt::format("{}{} {:.4g} and {:.4g} {}", told.empty() ? "" : ", ", of.name, middle(a), middle(b),
                        unit_of(of.name, problem.turns));
  };
  tell(run.fit.period, first->period, second->period);
  for (std::size_t k = 0; k < first->damping.size(); ++k)
    tell(run.fit.damping[k], first->damping[k], second->damping[k]);
  throw Refused{{.reason = Refusal::Reason::halves_differ,
                 .why = fmt::format("no value is told: the first and the second half of {} tell values that exclude "
                                    "each other, {}, {:.3g} times as far apart as chance allows",
                                    run.name(), told, *run.halves),
                 .source = run.source.file.string(),
                 .best_point = best_point(problem, run.fit.motion)}};
}

/// √ of what the cost rises by where a parameter is held at one end of its interval and all else is fitted again, over
/// what the second derivative says. Infinite where there is no such motion.
double rise_against_quadratic(const DecayFit& fit, std::size_t parameter, double end) {
  const Coefficient& c = fit.motion.parameters[parameter];
  ShootingProblem held = fit.problem;
  held.start = fit.motion.ended;
  held.start[parameter] = end;
  held.fitted[parameter] = false;
  const double expected = fit.motion.search.cost_last * std::pow((end - *c.value) / c.standard_error, 2) /
                          std::max(1.0, c.effective_samples);
  try {
    const double rise = fit_motion(held).search.cost_last - fit.motion.search.cost_last;
    return std::sqrt(std::max(0.0, rise) / expected);
  } catch (const hydro::NumericsError&) {
    return std::numeric_limits<double>::infinity();
  }
}

/// (F76) The interval of the likelihood where the second derivative does not describe it. \return whether it is that
bool replace_if_bent(const DecayFit& fit, std::size_t parameter, Coefficient& c) {
  constexpr double off = 1.25;  // an end off by a quarter of its distance, as in fits of a simulation
  const Coefficient& own = fit.motion.parameters[parameter];
  if (!c.value || !own.value || !(own.standard_error > 0)) return false;
  const double low = rise_against_quadratic(fit, parameter, own.interval.low),
               high = rise_against_quadratic(fit, parameter, own.interval.high);
  if (std::min(low, high) > 1 / off && std::max(low, high) < off) return false;
  try {
    c.interval = profile_interval(fit.problem, fit.motion, parameter);
    return true;
  } catch (const hydro::NumericsError& e) {
    withhold(
        c, fmt::format("the second derivative does not describe the cost about {:.6g}, and {}", *own.value, e.what()));
    return false;
  }
}

void compare_with_likelihood(FittedRun& run) {
  if (run.fit.several_ends) return;  // a profile would follow one of them alone
  const auto names = parameters_of(run.fit.problem.law);
  for (Coefficient& c : run.fit.damping) {
    const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), c.name) - names.begin());
    if (!replace_if_bent(run.fit, at, c)) continue;
    run.by_likelihood.push_back(c.name);
    if (!(c.interval.low <= 0 && c.interval.high >= 0)) continue;
    c.value.reset();
    c.why_not =
        fmt::format("its likelihood cannot tell it from zero ({:.3g} to {:.3g})", c.interval.low, c.interval.high);
  }
  if (!replace_if_bent(run.fit, 0, run.fit.period)) return;
  const Interval omega = run.fit.period.interval;
  run.fit.period.interval = {2 * std::numbers::pi / omega.high, 2 * std::numbers::pi / omega.low};
  run.by_likelihood.push_back(run.fit.period.name);
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

/// (F105) Terms of a motion twice as large are as many times smaller as their power of the velocity is above one; the
/// period of a pendulum goes with 1 + x²/16.
double power_of(const std::string& term) {
  return term == "quadratic" ? -1 : term == "cubic" ? -2 : term == "coulomb" ? 1 : 0;
}

void count_slopes(const Problem& problem, FittedRun& run) {
  for (Coefficient& c : run.fit.damping) count_slope(problem.motion_slope, power_of(c.name) * middle(c), c);
  if (run.water)
    for (Coefficient& c : run.water->damping) count_slope(problem.motion_slope, power_of(c.name) * middle(c), c);
  const double x = problem.options.motion.pendulum ? run.decrement.amplitude.front() : 0;
  count_slope(problem.motion_slope, middle(run.fit.period) * x * x / 8, run.fit.period);
}

/// (F34) By the swings that stand out of the noise; three are needed, else all extremes serve for the amplitude alone.
void tell_decrement(FittedRun& run) {
  const Record& r = run.records[0];
  try {
    run.decrement = logarithmic_decrement(find_swings(r.time, r.values));
  } catch (const hydro::InputError&) {
    run.decrement = logarithmic_decrement(find_extremes(r.time, r.values));
    run.decrement.ratio.clear();  // what noise makes of them is none
  }
}

/// Fits the records of a run with one set of coefficients.
FittedRun fitted(const Problem& problem, const Source& source, std::vector<Record> records) try {
  const Options& options = problem.options;
  FittedRun run{.source = source, .records = std::move(records), .decrement = {}, .fit = {}};
  std::vector<Window> windows;
  for (const Record& r : run.records) windows.push_back(window_of(r));
  tell_decrement(run);
  run.fit = fit_decay(windows, plain(options));
  require_explained(problem, run, run.fit.motion);
  // A rest tells nothing more, and half a record of it nothing at all (F114).
  const Window moving = before_rest(windows[0], run.fit.motion.motion[0]);
  compare_halves(problem, moving, run);
  compare_with_likelihood(run);
  if (options.sensitivity && run.alone()) vary(options, moving, run);
  if (problem.body) run.water = added_mass(run.fit, *problem.body, options.motion.confidence);
  if (options.memory) add_memory(problem, windows, run);
  run.left = residuals_of(run, windows[0]);
  if (options.profile) run.profiles = profiles_of(run.fit);
  count_slopes(problem, run);
  return run;
} catch (const SearchFailed& e) {
  throw Refused{{.reason = Refusal::Reason::search_without_end,
                 .why = std::string("no value is told: ") + e.what(),
                 .source = source.file.string()}};
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
