#include "morison_report.hpp"

#include <algorithm>
#include <cmath>

#include "telling.hpp"

namespace fit::morison {
namespace {

const char* equation_of(Experiment experiment) {
  switch (experiment) {
    case Experiment::water_moves:
      return "F = cm rho V du/dt + 1/2 rho D L cd |u| u, water moving past the body; cm = 1 + ca";
    case Experiment::body_moves:
      return "F = -(ca rho V + m) a - 1/2 rho D L cd |v| v, body moving in still water; cm = 1 + ca";
    case Experiment::both_move:
      break;
  }
  return "F = rho V du/dt - m a + ca rho V (du/dt - a) + 1/2 rho D L cd |u - v| (u - v), body moving in waves; cm = 1 "
         "+ ca; KC and Re are those of u - v";
}

Estimate asked(const Coefficient& c, std::size_t samples) {
  Estimate e{.coefficient = c};
  e.more = fmt::format(" (worth {:.0f} of {} samples; if they were independent: {:.4g} to {:.4g})", c.effective_samples,
                       samples, c.white_interval.low, c.white_interval.high);
  if (c.value) e.more += fmt::format("\n      a force 1 degree late would shift it by {:.2g}", c.shift_per_degree);
  return e;
}

/// What was fitted beside drag and inertia.
void add_others(const MorisonFit& f, Report& report) {
  for (const auto& [c, unit] : {std::pair{&f.linear_drag, "N s/m"}, {&f.offset, "N"}, {&f.delay, "s"}})
    if (*c) report.estimates.push_back({.coefficient = **c, .unit = unit});
  add_rows(report, "line", f.lines, [&](const FittedLine& line) {
    const Coefficient& a = line.amplitude;
    Facts facts{{"frequency_Hz", line.hz}, {"phase_rad", line.phase}};
    append(facts, facts_of({.coefficient = a, .unit = "N"}));
    const std::string value = a.value ? fmt::format("{:.4g} N, {:g} % interval {:.4g} to {:.4g}", *a.value,
                                                    100 * f.confidence, a.interval.low, a.interval.high)
                                      : "not identifiable: " + a.why_not;
    return std::pair{facts, a.name + ' ' + value};
  });
}

void add_bands(const MorisonFit& f, Report& report) {
  if (f.fit_band.empty()) return;
  const double of_fit = *std::max_element(f.fit_band.begin(), f.fit_band.end()),
               of_sample = *std::max_element(f.sample_band.begin(), f.sample_band.end());
  append(report.facts,
         {{"samples_in_band", f.inside}, {"widest_band_of_fit_N", of_fit}, {"widest_band_of_sample_N", of_sample}});
  report.say(
      "bands: the fitted force within {:.3g} N, a new sample within {:.3g} N; {:.1f} % of the samples lie where {:g} % "
      "should",
      of_fit, of_sample, 100 * f.inside, 100 * f.confidence);
}

/// Other readings of the same record: harmonics, cycles, variants, the stated uncertainties.
void add_checks(const FittedRun& run, Report& report) {
  const MorisonFit& f = run.fit;
  const std::string& inertia = f.inertia.name;
  append(report.facts, {{"correlation", f.correlation},
                        {"share_inside", f.share_inside},
                        {"fourier", Facts{{"cd", run.fourier.cd}, {inertia, run.fourier.inertia}}}});
  report.say("errors of cd and {0} correlate by {1:.2f}; main harmonic alone: cd {2:.4g}, {0} {3:.4g}", inertia,
             f.correlation, run.fourier.cd, run.fourier.inertia);
  add_residuals(report, run.left, "N");
  add_rows(report, "cycle", run.cycles, [&](const CycleFit& c) {
    return std::pair{
        Facts{{"start_s", c.start}, {"end_s", c.end}, {"cd", c.cd}, {inertia, c.inertia}},
        fmt::format("cycle {:.4g} s to {:.4g} s: cd {:.4g}, {} {:.4g}", c.start, c.end, c.cd, inertia, c.inertia)};
  });
  add_rows(report, "variant", run.variants, [&](const Variant& v) {
    return std::pair{Facts{{"with", v.what}, {"cd", v.cd}, {inertia, v.inertia}},
                     fmt::format("with {}: cd {:+.2g} ({:+.1f} errors), {} {:+.2g} ({:+.1f} errors)", v.what, v.cd,
                                 v.cd / f.cd.standard_error, inertia, v.inertia, v.inertia / f.inertia.standard_error)};
  });
  add_rows(report, "one_deviation", f.budget, [&](const SystematicError& e) {
    return std::pair{
        Facts{{"of", e.source}, {"cd", e.cd}, {inertia, e.inertia}},
        fmt::format("one deviation of the {}: cd {:+.2g}, {} {:+.2g}", e.source, e.cd, inertia, e.inertia)};
  });
}

std::string told(RobustLoss loss, double inside) {
  switch (loss) {
    case RobustLoss::huber:
      return fmt::format("robust, Huber: {:.2f} % of the samples count in full", 100 * inside);
    case RobustLoss::bisquare:
      return fmt::format("robust, bisquare: {:.2g} % of the samples count for nothing", 100 * (1 - inside));
    case RobustLoss::least_absolute:
      return fmt::format("robust, least absolute residuals: {:.2f} % of the samples lie within 1.345 deviations",
                         100 * inside);
  }
  return {};
}

Report told(const FittedRun& run, std::optional<RobustLoss> robust) {
  const MorisonFit& f = run.fit;
  Report report = begin_run(run.source);
  report.heading =
      fmt::format("{}: KC {:.4g}, {}T {:.4g} s, residual {:.4g} N rms, {:.2f} % of the force's variance explained",
                  run.source.name(), f.kc, f.re ? fmt::format("Re {:.4g}, ", *f.re) : "", f.period, f.residual_rms,
                  100 * f.explained);
  append(report.facts, {{"kc", f.kc},
                        {"period_s", f.period},
                        {"residual_rms_N", f.residual_rms},
                        {"squared_error_N2", f.squared_error},
                        {"explained", f.explained},
                        {"explained_adjusted", f.explained_adjusted},
                        {"samples", f.samples},
                        {"iterations", f.search.iterations},
                        {"search", f.search.why},
                        {"identifiability", f.search.identifiability}});
  if (f.re) append(report.facts, {{"re", *f.re}, {"beta", *f.re / f.kc}});
  add_labels(report, run.source);
  for (const Coefficient& c : run.asked) report.estimates.push_back(asked(c, f.samples));
  add_others(f, report);
  report.say("search: iterations {}, {}; singular values {:.3g} and {:.3g}; {}", f.search.iterations, f.search.why,
             f.search.singular_values[0], f.search.singular_values[1], f.search.identifiability);
  report.say("sum of squared residuals {:.4g} N^2; R^2 {:.6f}, adjusted {:.6f}", f.squared_error, f.explained,
             f.explained_adjusted);
  if (robust) report.say("{}", told(*robust, f.share_inside));
  add_bands(f, report);
  add_checks(run, report);
  report.steps = run.prepared.steps;
  report.cautions = run.prepared.cautions;
  report.warn(f.caution);
  return report;
}

Facts facts_of_law(const CoefficientLaw& law, const RandomEffects& r) {
  Facts out{{"of", law.coefficient},
            {"runs", law.runs},
            {"left_out", law.left_out},
            {"law", name_of(r.law)},
            {"terms", r.terms},
            {"between_runs", r.between},
            {"heterogeneity", r.heterogeneity},
            {"prediction", r.prediction},
            {"log_likelihood", r.log_likelihood},
            {"bic", r.bic},
            {"cross_validation", r.cross_validation}};
  if (std::isfinite(r.aicc)) out.emplace_back("aicc", r.aicc);
  append(out, {{"coefficients", r.coefficients}, {"intervals", r.intervals}});
  return out;
}

Report told(const CoefficientLaw& law, const RandomEffects& r) {
  Report report{.key = "law", .one_of_many = true, .facts = facts_of_law(law, r)};
  std::string formula;
  for (std::size_t k = 0; k < r.terms.size(); ++k)
    formula +=
        fmt::format("{}{:.4g} ({:.4g} to {:.4g}){}", k > 0 ? " + " : "", r.coefficients[static_cast<Eigen::Index>(k)],
                    r.intervals[k].low, r.intervals[k].high, k > 0 ? " " + r.terms[k] : "");
  report.say("{}: {}", name_of(r.law), formula);
  report.say(
      "    from run to run ±{:.2g}, I2 {:.0f} %; next run {:.3g} to {:.3g}; AICc {:.1f}, BIC {:.1f}, cross-validation "
      "{:.2g}",
      r.between, 100 * r.heterogeneity, r.prediction.low, r.prediction.high, r.aicc, r.bic, r.cross_validation);
  return report;
}

/// What a scene of motion may include: the value of the one run, or of the law in the middle of the runs.
Facts coefficients_of(const Options& options, const std::vector<FittedRun>& runs,
                      const std::vector<CoefficientLaw>& laws) {
  Facts out;
  for (std::size_t i = 0; i < options.coefficients.size(); ++i) {
    const std::string& name = options.coefficients[i];
    if (!laws.empty())
      out.emplace_back(name, laws[i].laws.front().coefficients[0]);
    else if (runs.size() == 1 && runs[0].asked[i].value)
      out.emplace_back(name, *runs[0].asked[i].value);
  }
  return out;
}

}  // namespace

Report told(const Options& options, const std::vector<FittedRun>& runs, const std::vector<CoefficientLaw>& laws) {
  Report report;
  report.heading = equation_of(runs[0].cylinder.experiment);
  if (Facts all = coefficients_of(options, runs, laws); !all.empty())
    report.facts.emplace_back("coefficients", std::move(all));
  for (const FittedRun& run : runs) report.parts.push_back(told(run, options.force.robust));
  for (const CoefficientLaw& law : laws) {
    const std::string left_out = law.left_out > 0 ? fmt::format(" ({} not identifiable)", law.left_out) : "";
    for (const RandomEffects& r : law.laws) {
      report.parts.push_back(told(law, r));
      if (&r == &law.laws.front())
        report.parts.back().heading = fmt::format("{} over {} runs{}:", law.coefficient, law.runs, left_out);
    }
  }
  return report;
}

}  // namespace fit::morison
