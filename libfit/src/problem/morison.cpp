#include <cmath>
#include <optional>

#include "fit/verdict.hpp"
#include "hydro/base/error.hpp"
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

/// (F70) A delay that nobody asked for and that explains the larger part of what a fit leaves over: such a fit is of
/// channels that do not belong together in time, and its coefficients say nothing.
void look_for_delay(const Options& options, FittedRun& run) {
  constexpr double variance_left =
      0.25;  // of the residuals; noise gives a needless delay one degree of freedom and no more
  if (options.longest_delay || !run.fit.search.all_identifiable()) return;
  MorisonOptions force = options.force;
  force.force_errors = run.prepared.force_errors;
  std::optional<DelayedFit> delayed;
  try {
    delayed = fit_morison_and_delay(run.cylinder, run.prepared.record, run.fit.period / 4, force);
  } catch (const hydro::InputError&) {  // too short a record, or lines that hide the delay
    return;
  } catch (const SearchFailed&) {
    return;
  }
  const MorisonFit& with = delayed->fit;
  if (!with.delay->value || !(with.residual_rms < std::sqrt(variance_left) * run.fit.residual_rms)) return;
  const double late = *with.delay->value, in_all = late + options.prepare.delay_s;
  const std::string why = fmt::format(
      "the force comes {:.3g} s {} the motion: taken off, it leaves {:.3g} N rms in place of {:.3g} N. Write delay = "
      "\"{:.3g} s\" in [prepare], or \"estimate\"",
      std::abs(late), late > 0 ? "after" : "before", with.residual_rms, run.fit.residual_rms, in_all);
  for (Coefficient* c : {&run.fit.cd, &run.fit.inertia}) {
    c->value.reset();
    c->why_not = why;
  }
  run.prepared.cautions.push_back(why);
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

FittedRun fitted(Options options, const Run& of) {
  if (of.delay_s) options.prepare.delay_s = *of.delay_s;
  FittedRun run = fit_raw(options, of.source, of.cylinder, of.raw);
  look_for_delay(options, run);
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
