#include <algorithm>
#include <cmath>

#include "froude/fit_morison.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using Json = FitJson;

const char* equation_of(::fit::Experiment experiment) {
  switch (experiment) {
    case ::fit::Experiment::water_moves:
      return "F = cm rho V du/dt + 1/2 rho D L cd |u| u, water moving past the body; cm = 1 + ca";
    case ::fit::Experiment::body_moves:
      return "F = -(ca rho V + m) a - 1/2 rho D L cd |v| v, body moving in still water; cm = 1 + ca";
    case ::fit::Experiment::both_move:
      break;
  }
  return "F = rho V du/dt - m a + ca rho V (du/dt - a) + 1/2 rho D L cd |u - v| (u - v), body moving in waves; cm = 1 "
         "+ "
         "ca; KC and Re are those of u - v";
}

Estimate asked(const Coefficient& c, std::size_t samples) {
  Estimate e{.coefficient = c};
  e.more = fmt::format(" (worth {:.0f} of {} samples; if they were independent: {:.4g} to {:.4g})", c.effective_samples,
                       samples, c.white_interval.low, c.white_interval.high);
  if (c.value) e.more += fmt::format("\n      a force 1 degree late would shift it by {:.2g}", c.shift_per_degree);
  return e;
}

/// What was fitted beside drag and inertia.
void add_others(const ::fit::MorisonFit& f, FitSummary& summary) {
  for (const auto& [c, unit] : {std::pair{&f.linear_drag, "N s/m"}, {&f.offset, "N"}, {&f.delay, "s"}})
    if (*c) summary.estimates.push_back({.coefficient = **c, .unit = unit});
  for (const auto& line : f.lines) {
    const Coefficient& a = line.amplitude;
    Json one{{"frequency_Hz", line.hz}, {"phase_rad", line.phase}};
    one.update(tree_of(Estimate{.coefficient = a}));
    summary.facts["line"].push_back(one);
    summary.remarks.push_back(a.name + ' ' +
                              (a.value ? fmt::format("{:.4g} N, {:g} % interval {:.4g} to {:.4g}", *a.value,
                                                     100 * f.confidence, a.interval.low, a.interval.high)
                                       : "not identifiable: " + a.why_not));
  }
}

void add_bands(const ::fit::MorisonFit& f, FitSummary& summary) {
  if (f.fit_band.empty()) return;
  const double of_fit = *std::max_element(f.fit_band.begin(), f.fit_band.end()),
               of_sample = *std::max_element(f.sample_band.begin(), f.sample_band.end());
  summary.facts.update(
      {{"samples_in_band", f.inside}, {"widest_band_of_fit_N", of_fit}, {"widest_band_of_sample_N", of_sample}});
  summary.say(
      "bands: the fitted force within {:.3g} N, a new sample within {:.3g} N; {:.1f} % of the samples lie where {:g} % "
      "should",
      of_fit, of_sample, 100 * f.inside, 100 * f.confidence);
}

/// Other readings of the same record: harmonics, cycles, variants, the stated uncertainties.
void add_checks(const MorisonRun& run, FitSummary& summary) {
  const auto& f = run.fit;
  const std::string& inertia = f.inertia.name;
  Json& j = summary.facts;
  j.update({{"correlation", f.correlation},
            {"share_inside", f.share_inside},
            {"fourier", {{"cd", run.fourier.cd}, {inertia, run.fourier.inertia}}}});
  summary.say("errors of cd and {0} correlate by {1:.2f}; main harmonic alone: cd {2:.4g}, {0} {3:.4g}", inertia,
              f.correlation, run.fourier.cd, run.fourier.inertia);
  add_residuals(summary, run.left, "N");
  for (const auto& c : run.cycles) {
    j["cycle"].push_back({{"start_s", c.start}, {"end_s", c.end}, {"cd", c.cd}, {inertia, c.inertia}});
    summary.say("cycle {:.4g} s to {:.4g} s: cd {:.4g}, {} {:.4g}", c.start, c.end, c.cd, inertia, c.inertia);
  }
  for (const auto& v : run.variants) {
    j["variant"].push_back({{"with", v.what}, {"cd", v.cd}, {inertia, v.inertia}});
    summary.say("with {}: cd {:+.2g} ({:+.1f} errors), {} {:+.2g} ({:+.1f} errors)", v.what, v.cd,
                v.cd / f.cd.standard_error, inertia, v.inertia, v.inertia / f.inertia.standard_error);
  }
  for (const auto& e : f.budget) {
    j["one_deviation"].push_back({{"of", e.source}, {"cd", e.cd}, {inertia, e.inertia}});
    summary.say("one deviation of the {}: cd {:+.2g}, {} {:+.2g}", e.source, e.cd, inertia, e.inertia);
  }
}

FitSummary summary_of(const MorisonRun& run, bool robust) {
  const auto& f = run.fit;
  FitSummary summary{.key = "run", .one_of_many = true};
  summary.heading = fmt::format(
      "{}: KC {:.4g}, {}T {:.4g} s, residual {:.4g} N rms, {:.2f} % of the force's variance explained", run.name, f.kc,
      f.re ? fmt::format("Re {:.4g}, ", *f.re) : "", f.period, f.residual_rms, 100 * f.explained);
  summary.facts = {{"file", run.name},
                   {"kc", f.kc},
                   {"period_s", f.period},
                   {"residual_rms_N", f.residual_rms},
                   {"explained", f.explained},
                   {"samples", f.samples},
                   {"iterations", f.search.iterations},
                   {"search", f.search.why},
                   {"identifiability", f.search.identifiability}};
  if (f.re) summary.facts.update({{"re", *f.re}, {"beta", *f.re / f.kc}});
  for (const auto& [name, value] : run.labels) summary.facts["labels"][name] = value;
  for (const Coefficient& c : run.asked) summary.estimates.push_back(asked(c, f.samples));
  add_others(f, summary);
  summary.say("search: iterations {}, {}; singular values {:.3g} and {:.3g}; {}", f.search.iterations, f.search.why,
              f.search.singular_values[0], f.search.singular_values[1], f.search.identifiability);
  if (robust) summary.say("robust: {:.2f} % of the samples count in full", 100 * f.share_inside);
  add_bands(f, summary);
  add_checks(run, summary);
  summary.steps = run.prepared.steps;
  summary.cautions = run.prepared.cautions;
  summary.warn(f.caution);
  return summary;
}

FitSummary summary_of(const CoefficientLaw& law, const ::fit::RandomEffects& r) {
  FitSummary summary{.key = "law", .one_of_many = true};
  Json& j = summary.facts = {{"of", law.coefficient},
                             {"runs", law.runs},
                             {"left_out", law.left_out},
                             {"law", ::fit::name_of(r.law)},
                             {"terms", r.terms},
                             {"between_runs", r.between},
                             {"heterogeneity", r.heterogeneity},
                             {"prediction", {r.prediction.low, r.prediction.high}},
                             {"log_likelihood", r.log_likelihood},
                             {"bic", r.bic},
                             {"cross_validation", r.cross_validation}};
  if (std::isfinite(r.aicc)) j["aicc"] = r.aicc;
  std::string formula;
  for (std::size_t k = 0; k < r.terms.size(); ++k) {
    const double c = r.coefficients[static_cast<Eigen::Index>(k)];
    const auto& [low, high] = r.intervals[k];
    j["coefficients"].push_back(c);
    j["intervals"].push_back({low, high});
    formula +=
        fmt::format("{}{:.4g} ({:.4g} to {:.4g}){}", k > 0 ? " + " : "", c, low, high, k > 0 ? " " + r.terms[k] : "");
  }
  summary.say("{}: {}", ::fit::name_of(r.law), formula);
  summary.say(
      "    from run to run ±{:.2g}, I2 {:.0f} %; next run {:.3g} to {:.3g}; AICc {:.1f}, BIC {:.1f}, cross-validation "
      "{:.2g}",
      r.between, 100 * r.heterogeneity, r.prediction.low, r.prediction.high, r.aicc, r.bic, r.cross_validation);
  return summary;
}

}  // namespace

FitSummary summary_of(const scene::FitScene& scene, const scene::MorisonModel& model,
                      const std::vector<MorisonRun>& runs, const std::vector<CoefficientLaw>& laws) {
  FitSummary summary = begin_summary(scene);
  summary.heading = equation_of(model.cylinder.experiment);
  summary.facts["motion"] = scene::word_of(model.cylinder.experiment);
  summary.facts["intervals"] = scene::word_of(model.options.method);
  // What a scene of motion may include: the value of the one run, or of the law in the middle of the runs.
  for (std::size_t i = 0; i < model.coefficients.size(); ++i) {
    const std::string& name = model.coefficients[i];
    if (!laws.empty())
      summary.facts["coefficients"][name] = laws[i].laws.front().coefficients[0];
    else if (runs.size() == 1 && runs[0].asked[i].value)
      summary.facts["coefficients"][name] = *runs[0].asked[i].value;
  }
  for (const MorisonRun& run : runs) summary.parts.push_back(summary_of(run, model.options.robust));
  for (const CoefficientLaw& law : laws) {
    const std::string left_out = law.left_out > 0 ? fmt::format(" ({} not identifiable)", law.left_out) : "";
    for (const auto& r : law.laws) {
      summary.parts.push_back(summary_of(law, r));
      if (&r == &law.laws.front())
        summary.parts.back().heading = fmt::format("{} over {} runs{}:", law.coefficient, law.runs, left_out);
    }
  }
  return summary;
}

}  // namespace froude
