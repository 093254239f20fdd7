#include <cmath>
#include <optional>

#include "fit/verdict.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "morison_report.hpp"
#include "telling.hpp"

namespace fit::morison {
namespace {

/// (F79) Drag that is negative beyond twice its interval feeds the motion, which no steady force of water does.
void require_drag_that_brakes(const MorisonFit& fit, const Source& source) {
  const auto& [low, high] = fit.cd.interval;
  if (!fit.cd.value || !is_surely_negative(fit.cd.interval)) return;
  throw Refused{drives_the_motion(fmt::format("drag comes out negative (cd {:.3g} to {:.3g})", low, high), source)};
}

/// (F112) Inertia that no still water has, beyond twice its interval: a total that is negative, or next to none of the
/// mass that the load cells are said to carry together with next to no drag.
void require_inertia_of_water(const FittedRun& run) {
  const MorisonFit& fit = run.fit;
  if (!fit.inertia.value) return;
  const Coefficient ca = inertia_as(fit, "ca");
  const Cylinder& c = run.cylinder;
  const double mass = c.mass_beyond_load_cells / (c.density * c.volume());  // over that of the water in its place
  const auto surely_below = [&](double least) {
    return is_surely_negative({ca.interval.low - least, ca.interval.high - least});
  };
  constexpr double little = 0.05, little_drag = 0.1;
  const bool next_to_none = mass > 0 && surely_below((little - 1) * mass) && middle(fit.cd) < little_drag;
  if (!next_to_none && !surely_below(-1)) return;
  std::string why = fmt::format("added mass comes out as ca {:.3g} to {:.3g}, ", ca.interval.low, ca.interval.high);
  why += surely_below(-1) ? "so that C_M = 1 + C_A would be negative, which no water has"
                          : "and with the mass beyond the load cells next to no force would accelerate the body";
  why +=
      ": the force stands in another unit than its header says (kN under [N]), the force or the motion has the "
      "wrong sign, or the mass beyond the load cells is too large";
  throw Refused{{.reason = Refusal::Reason::wrong_sign, .why = why, .source = run.source.file.string()}};
}

/// The same record with a delay of the force beside the coefficients; none, with the reason among the cautions, where
/// it cannot be fitted.
std::optional<MorisonFit> fit_with_delay(const Options& options, FittedRun& run) {
  MorisonOptions force = options.force;
  force.force_errors = run.prepared.force_errors;
  force.method = IntervalMethod::effective_samples;  // the others ask for more cycles than may be left
  force.bands = false;
  std::string why_not;
  try {
    MorisonFit with = fit_morison_and_delay(run.cylinder, run.prepared.record, run.fit.period / 4, force).fit;
    if (std::isfinite(with.delay->standard_error)) return with;
    why_not = with.delay->why_not;
  } catch (const hydro::InputError& e) {  // too short a record, or lines that hide the delay
    why_not = e.rule();
  } catch (const SearchFailed& e) {
    why_not = e.what();
  }
  run.prepared.cautions.push_back("whether the force is late could not be found out: " + why_not);
  return {};
}

/// What one coefficient is with a delay and without, over the half of its interval without.
double shift_of(const Coefficient& without, const Coefficient& with) {
  constexpr double least = 1e-3;  // less is nothing, though rounding alone may leave an interval that is narrower
  const double shift = std::abs(middle(with) - middle(without)),
               half = (without.interval.high - without.interval.low) / 2;
  return shift > least ? shift / std::max(half, 1e-12) : 0;
}

/// (F70) A delay that nobody asked for: told where it is no chance and moves a coefficient beyond its interval; far
/// beyond, the channels do not belong together in time, and the coefficients say nothing.
void look_for_delay(const Options& options, FittedRun& run) {
  constexpr double chance = 1e-3, far = 3;
  if (options.longest_delay || !run.fit.search.all_identifiable()) return;
  const std::optional<MorisonFit> with = fit_with_delay(options, run);
  if (!with || !with->delay->value) return;
  if (with->residual_rms >= run.fit.residual_rms) return;  // noise of the motion, where a delay makes the fit worse
  const double late = *with->delay->value, in_all = late + options.prepare.delay_s,
               error = std::hypot(with->delay->standard_error, options.force.delay_error_s);
  if (std::abs(late) <= hydro::signal::student_t_quantile(1 - chance / 2, with->dof) * error) return;
  const double shift = std::max(shift_of(run.fit.cd, with->cd), shift_of(run.fit.inertia, with->inertia));
  if (shift <= 1) return;
  const std::string why = fmt::format(
      "the force comes {:.3g} s {} the motion (error {:.2g} s): with that taken off cd is {:.4g} in place of {:.4g} "
      "and {} {:.4g} in place of {:.4g}, up to {:.2g} times the half of an interval away, and {:.3g} N rms are left in "
      "place of {:.3g} N. Write delay = \"{:.3g} s\" in [prepare], or \"estimate\"; if the channels are known to "
      "belong together in time, the delay that they do have with a delay_error that counts the rest",
      std::abs(late), late > 0 ? "after" : "before", error, middle(with->cd), middle(run.fit.cd), run.fit.inertia.name,
      middle(with->inertia), middle(run.fit.inertia), shift, with->residual_rms, run.fit.residual_rms, in_all);
  run.prepared.cautions.push_back(why);
  if (shift <= far) return;
  for (Coefficient* c : {&run.fit.cd, &run.fit.inertia}) {
    c->value.reset();
    c->why_not = why;
  }
}

/// The fit of one raw record, with its delay where that is to be estimated.
FittedRun fit_raw(const Options& options, const Source& source, const Cylinder& cylinder, RawRun raw) {
  FittedRun run;
  run.source = source;
  run.cylinder = cylinder;
  run.prepared = prepare(std::move(raw), options.prepare);
  MorisonOptions force = options.force;
  force.force_errors = run.prepared.force_errors;
  if (options.longest_delay) {
    DelayedFit delayed = fit_morison_and_delay(cylinder, run.prepared.record, *options.longest_delay, force);
    run.fit = std::move(delayed.fit);
    run.prepared.record = std::move(delayed.aligned);
  } else {
    run.fit = fit_morison(cylinder, run.prepared.record, force);
  }
  if (const std::string trouble = sign_trouble(cylinder, run.fit); !trouble.empty())
    throw Refused{{.reason = Refusal::Reason::wrong_sign, .why = trouble, .source = source.file.string()}};
  require_drag_that_brakes(run.fit, source);
  require_inertia_of_water(run);
  return run;
}

/// A choice that is made otherwise, in words, and the options with it.
struct Otherwise {
  std::string what;
  Options options;
};

/// Each low pass of the force, and where derivatives are taken their bandwidth, times `factor`.
std::vector<Otherwise> other_cutoffs(const Options& options, const RawRun& raw, double period, double factor) {
  using Filter = FilterChoice::Kind;
  std::vector<Otherwise> out;
  for (std::size_t i = 0; i < options.prepare.filters.size(); ++i) {
    if (const Filter kind = options.prepare.filters[i].kind; kind == Filter::notch || kind == Filter::moving_average)
      continue;
    Options other = options;
    other.prepare.filters[i].hz *= factor;
    out.push_back({fmt::format("low pass at {:.3g} Hz", other.prepare.filters[i].hz), other});
  }
  if (!raw.velocity.empty() && !raw.acceleration.empty()) return out;
  Options other = options;
  const double usual = 5 / period, chosen = options.prepare.derivative_bandwidth_hz;
  other.prepare.derivative_bandwidth_hz = factor * (chosen > 0 ? chosen : usual);
  out.push_back({fmt::format("derivatives to {:.3g} Hz", other.prepare.derivative_bandwidth_hz), other});
  return out;
}

/// Either half of the window, if it has two periods at least.
std::vector<Otherwise> half_windows(const Options& options, const std::vector<double>& time, double period) {
  if (time.back() - time.front() < 4 * period) return {};
  std::vector<Otherwise> out;
  Options half = options;
  half.prepare.window.kind = WindowChoice::Kind::span;
  half.prepare.average_cycles = false;  // half a window is read as it is: it may hold a cycle or two
  for (const bool first : {true, false}) {
    const double center = (time.front() + time.back()) / 2;
    half.prepare.window.from = first ? time.front() : center;
    half.prepare.window.to = first ? center : time.back();
    out.push_back({first ? "first half of the window" : "second half of the window", half});
  }
  return out;
}

/// The same fit with another cutoff, another bandwidth, and half of the window.
std::vector<Variant> variants_of(const Options& options, const RawRun& raw, const FittedRun& run) {
  std::vector<Otherwise> all;
  for (const double factor : {0.7, 1.4})
    for (Otherwise& other : other_cutoffs(options, raw, run.fit.period, factor)) all.push_back(std::move(other));
  for (Otherwise& other : half_windows(options, run.prepared.record.time, run.fit.period))
    all.push_back(std::move(other));
  std::vector<Variant> out;
  for (Otherwise& other : all) {
    // Values alone are asked, and half a window may hold few cycles.
    other.options.force.method = IntervalMethod::effective_samples;
    const FittedRun again = fit_raw(other.options, run.source, run.cylinder, raw);
    out.push_back(
        {other.what, middle(again.fit.cd) - middle(run.fit.cd), middle(again.fit.inertia) - middle(run.fit.inertia)});
  }
  return out;
}

ResidualReport residuals_of(const FittedRun& run) {
  const ForceRecord& r = run.prepared.record;
  Eigen::VectorXd residuals = Eigen::Map<const Eigen::VectorXd>(r.force.data(), std::ssize(r.force));
  const double rms = std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
  residuals -= Eigen::Map<const Eigen::VectorXd>(run.fit.fitted.data(), residuals.size());
  return look_at_residuals(residuals, rms, r.time[1] - r.time[0], run.fit.period);
}

/// (F113) A constant that makes a large part of what is left over: it moves the coefficients little and widens all of
/// their intervals, though a key takes it off.
void look_for_offset(const Options& options, FittedRun& run) {
  constexpr double large = 0.2;  // of the squares; noise gives a mean one part in as many as it has independent samples
  if (options.force.force_offset || !run.fit.search.all_identifiable()) return;
  const std::vector<double>& force = run.prepared.record.force;
  const auto count = static_cast<double>(force.size());
  double mean = 0;
  for (std::size_t j = 0; j < force.size(); ++j) mean += (force[j] - run.fit.fitted[j]) / count;
  const double share = mean * mean / (run.fit.residual_rms * run.fit.residual_rms);
  if (!(share > large)) return;
  run.prepared.cautions.push_back(
      fmt::format("{:.0f} % of the squares of what is left over are those of a constant force of {:.3g} N: a zero that "
                  "nobody took off widens the intervals. Write offset = true in [model], or name the `zero` run",
                  100 * share, mean));
}

FittedRun fitted(Options options, const Run& of) {
  if (of.delay_s) options.prepare.delay_s = *of.delay_s;
  FittedRun run = fit_raw(options, of.source, of.cylinder, of.raw);
  look_for_delay(options, run);
  look_for_offset(options, run);
  run.left = residuals_of(run);
  run.fourier = fourier_averages(run.cylinder, run.prepared.record, run.fit.period);
  if (options.cycles) run.cycles = fit_cycles(run.cylinder, run.prepared.record, run.prepared.cycle_starts);
  if (options.sensitivity) run.variants = variants_of(options, of.raw, run);
  for (const std::string& name : options.coefficients)
    run.asked.push_back(name == "cd" ? run.fit.cd : inertia_as(run.fit, name));
  return run;
}

CoefficientLaw law_of(const Options& options, std::size_t coefficient, const std::vector<FittedRun>& runs) {
  CoefficientLaw law{.coefficient = options.coefficients[coefficient], .laws = {}, .runs = 0, .left_out = 0};
  std::vector<RunEstimate> estimates;
  for (const FittedRun& run : runs) {
    const Coefficient& c = run.asked[coefficient];
    const double re = run.fit.re.value_or(0);
    if (c.value)
      estimates.push_back({*c.value, c.standard_error, run.fit.kc, re, re / run.fit.kc, run.source.file.string()});
    else
      ++law.left_out;
  }
  law.runs = estimates.size();
  if (options.law->only)
    law.laws = {fit_runs(estimates, *options.law->only, options.force.confidence)};
  else
    law.laws = compare_laws(estimates, options.force.confidence);
  return law;
}

}  // namespace

Solution solve(const Problem& problem) try {
  hydro::require(!problem.runs.empty(), "a fit of Morison's equation needs one run at least");
  const Options& options = problem.options;
  Solution out;
  for (const Run& run : problem.runs) out.runs.push_back(of_run(run.source, [&] { return fitted(options, run); }));
  for (std::size_t i = 0; options.law && i < options.coefficients.size(); ++i)
    out.laws.push_back(law_of(options, i, out.runs));
  out.report = told(options, out.runs, out.laws);
  return out;
} catch (const Refused& e) {
  return {.report = {.refused = e.refusal}, .runs = {}, .laws = {}};
}

}  // namespace fit::morison
