#include <algorithm>
#include <cmath>

#include "froude/fit_report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using Json = FitJson;

std::string sentence(const Coefficient& c, double confidence, std::size_t samples) {
  const std::string worth = fmt::format("worth {:.0f} of {} samples; if they were independent: {:.4g} to {:.4g}",
                                        c.effective_samples, samples, c.white_interval.low, c.white_interval.high);
  if (!c.value)
    return fmt::format("  {:<3} not identifiable: {} ({:g} % interval {:.4g} to {:.4g}; {})\n", c.name, c.why_not,
                       100 * confidence, c.interval.low, c.interval.high, worth);
  return fmt::format(
      "  {:<3} {:.4g}, {:g} % interval {:.4g} to {:.4g} ({})\n      a force 1 degree late would shift it by {:.2g}\n",
      c.name, *c.value, 100 * confidence, c.interval.low, c.interval.high, worth, c.shift_per_degree);
}

std::string delay_sentence(const Coefficient& d, double confidence) {
  if (!d.value) return fmt::format("  delay of the force not identifiable: {}\n", d.why_not);
  return fmt::format("  delay of the force {:.4g} s, {:g} % interval {:.4g} s to {:.4g} s\n", *d.value,
                     100 * confidence, d.interval.low, d.interval.high);
}

std::vector<std::string> cautions_of(const MorisonRun& run) {
  auto all = run.prepared.cautions;
  if (!run.fit.caution.empty()) all.push_back(run.fit.caution);
  return all;
}

/// What was fitted beside drag and inertia, and how wide the bands are.
void tell_others(const MorisonRun& run, const Console& console) {
  const auto& f = run.fit;
  const auto say = [&](const Coefficient& c, const char* what, const char* unit) {
    if (!c.value)
      console.out << fmt::format("  {} not identifiable: {}\n", what, c.why_not);
    else
      console.out << fmt::format("  {} {:.4g} {}, {:g} % interval {:.4g} to {:.4g}\n", what, *c.value, unit,
                                 100 * f.confidence, c.interval.low, c.interval.high);
  };
  if (f.linear_drag) say(*f.linear_drag, "linear drag", "N s/m");
  if (f.offset) say(*f.offset, "offset", "N");
  for (const auto& line : f.lines) say(line.amplitude, line.amplitude.name.c_str(), "N");
  if (!f.fit_band.empty())
    console.out << fmt::format(
        "  bands: the fitted force within {:.3g} N, a new sample within {:.3g} N; {:.1f} % of the samples lie where "
        "{:g} % should\n",
        *std::max_element(f.fit_band.begin(), f.fit_band.end()),
        *std::max_element(f.sample_band.begin(), f.sample_band.end()), 100 * f.inside, 100 * f.confidence);
}

/// Other readings of the same record: harmonics, cycles, variants.
void tell_checks(const MorisonRun& run, const Console& console) {
  const auto& f = run.fit;
  console.out << fmt::format("  errors of cd and {} correlate by {:.2f}; main harmonic alone: cd {:.4g}, {} {:.4g}\n",
                             f.inertia.name, f.correlation, run.fourier.cd, f.inertia.name, run.fourier.inertia);
  std::string left;
  for (const auto& h : run.left.harmonics)
    if (h.relative > 0.01) left += fmt::format("{}{} ({:.2g} N)", left.empty() ? "" : ", ", h.number, h.amplitude);
  console.out << fmt::format(
      "  residuals: {:.0f} % of their variance in harmonics{}; neighbouring fortieths of a period correlate by {:.2f} "
      "(white with p = {:.2g})\n",
      100 * run.left.harmonic_share, left.empty() ? "" : ", above 1 % of the force in number " + left, run.left.lag_one,
      run.left.ljung_box_p);
  for (const auto& c : run.cycles)
    console.out << fmt::format("  cycle {:.4g} s to {:.4g} s: cd {:.4g}, {} {:.4g}\n", c.start, c.end, c.cd,
                               f.inertia.name, c.inertia);
  for (const auto& v : run.variants)
    console.out << fmt::format("  with {}: cd {:+.2g} ({:+.1f} errors), {} {:+.2g} ({:+.1f} errors)\n", v.what, v.cd,
                               v.cd / f.cd.standard_error, f.inertia.name, v.inertia,
                               v.inertia / f.inertia.standard_error);
}

}  // namespace

void tell_laws(const std::vector<CoefficientLaw>& laws, const Console& console) {
  for (const CoefficientLaw& law : laws) {
    console.out << fmt::format("{} over {} runs{}:\n", law.coefficient, law.runs,
                               law.left_out > 0 ? fmt::format(" ({} not identifiable)", law.left_out) : "");
    for (const auto& r : law.laws) {
      std::string formula;
      for (std::size_t j = 0; j < r.terms.size(); ++j)
        formula += fmt::format("{}{:.4g} ({:.4g} to {:.4g}){}", j > 0 ? " + " : "",
                               r.coefficients[static_cast<Eigen::Index>(j)], r.intervals[j].low, r.intervals[j].high,
                               j > 0 ? " " + r.terms[j] : "");
      console.out << fmt::format(
          "  {}: {}\n      from run to run ±{:.2g}, I2 {:.0f} %; next run {:.3g} to {:.3g}; AICc {:.1f}, BIC {:.1f}, "
          "cross-validation {:.2g}\n",
          ::fit::name_of(r.law), formula, r.between, 100 * r.heterogeneity, r.prediction.low, r.prediction.high, r.aicc,
          r.bic, r.cross_validation);
    }
  }
}

void tell_runs(const scene::MorisonModel& model, const std::vector<MorisonRun>& runs, const Console& console) {
  console.out << (model.cylinder.experiment == ::fit::Experiment::water_moves
                      ? "F = cm rho V du/dt + 1/2 rho D L cd |u| u, water moving past the body; cm = 1 + ca\n"
                  : model.cylinder.experiment == ::fit::Experiment::body_moves
                      ? "F = -(ca rho V + m) a - 1/2 rho D L cd |v| v, body moving in still water; cm = 1 + ca\n"
                      : "F = rho V du/dt - m a + ca rho V (du/dt - a) + 1/2 rho D L cd |u - v| (u - v), body moving in "
                        "waves; cm = 1 + ca; KC and Re are those of u - v\n");
  for (const MorisonRun& run : runs) {
    const auto& f = run.fit;
    console.out << fmt::format(
        "{}: KC {:.4g}, {}T {:.4g} s, residual {:.4g} N rms, {:.2f} % of the force's variance explained\n", run.name,
        f.kc, f.re ? fmt::format("Re {:.4g}, ", *f.re) : "", f.period, f.residual_rms, 100 * f.explained);
    for (const Coefficient& c : run.asked) console.out << sentence(c, f.confidence, f.samples);
    console.out << fmt::format("  search: iterations {}, {}; singular values {:.3g} and {:.3g}; {}\n",
                               f.search.iterations, f.search.why, f.search.singular_values[0],
                               f.search.singular_values[1], f.search.identifiability);
    if (model.options.robust)
      console.out << fmt::format("  robust: {:.2f} % of the samples count in full\n", 100 * f.share_inside);
    tell_others(run, console);
    tell_checks(run, console);
    if (f.delay) console.out << delay_sentence(*f.delay, f.confidence);
    for (const auto& e : f.budget)
      console.out << fmt::format("  one deviation of the {}: cd {:+.2g}, {} {:+.2g}\n", e.source, e.cd, f.inertia.name,
                                 e.inertia);
    for (const std::string& step : run.prepared.steps) console.out << "  " << step << '\n';
    for (const std::string& caution : cautions_of(run)) console.out << "  caution: " << caution << '\n';
  }
}

Json as_json(const Coefficient& c) {
  Json j{{"identifiable", c.value.has_value()},
         {"standard_error", c.standard_error},
         {"systematic_error", c.systematic_error},
         {"interval", {c.interval.low, c.interval.high}},
         {"interval_if_independent", {c.white_interval.low, c.white_interval.high}},
         {"effective_samples", c.effective_samples},
         {"shift_per_degree", c.shift_per_degree}};
  if (c.value) j["value"] = *c.value;
  if (!c.why_not.empty()) j["why_not"] = c.why_not;
  return j;
}

namespace {

Json checks_as_json(const MorisonRun& run) {
  const std::string& inertia = run.fit.inertia.name;
  Json j{{"correlation", run.fit.correlation},
         {"share_inside", run.fit.share_inside},
         {"fourier", {{"cd", run.fourier.cd}, {inertia, run.fourier.inertia}}},
         {"residuals",
          {{"harmonic_share", run.left.harmonic_share},
           {"lag_one", run.left.lag_one},
           {"ljung_box_p", run.left.ljung_box_p}}}};
  for (const auto& h : run.left.harmonics) j["residuals"]["harmonic_amplitudes_N"].push_back(h.amplitude);
  for (const auto& c : run.cycles)
    j["cycle"].push_back({{"start_s", c.start}, {"end_s", c.end}, {"cd", c.cd}, {inertia, c.inertia}});
  for (const auto& v : run.variants) j["variant"].push_back({{"with", v.what}, {"cd", v.cd}, {inertia, v.inertia}});
  for (const auto& e : run.fit.budget)
    j["one_deviation"].push_back({{"of", e.source}, {"cd", e.cd}, {inertia, e.inertia}});
  return j;
}

Json run_as_json(const MorisonRun& run) {
  const auto& f = run.fit;
  Json r{{"file", run.name},
         {"kc", f.kc},
         {"period_s", f.period},
         {"residual_rms_N", f.residual_rms},
         {"explained", f.explained},
         {"samples", f.samples},
         {"iterations", f.search.iterations},
         {"search", f.search.why},
         {"identifiability", f.search.identifiability}};
  if (f.re) r.update({{"re", *f.re}, {"beta", *f.re / f.kc}});
  for (const auto& [name, value] : run.labels) r["labels"][name] = value;
  r["steps"] = run.prepared.steps;
  r["cautions"] = cautions_of(run);
  r.update(checks_as_json(run));
  if (f.delay) r["delay"] = as_json(*f.delay);
  if (f.linear_drag) r["linear_drag"] = as_json(*f.linear_drag);
  if (f.offset) r["offset"] = as_json(*f.offset);
  if (!f.fit_band.empty())
    r.update({{"samples_in_band", f.inside},
              {"widest_band_of_fit_N", *std::max_element(f.fit_band.begin(), f.fit_band.end())},
              {"widest_band_of_sample_N", *std::max_element(f.sample_band.begin(), f.sample_band.end())}});
  for (const auto& line : f.lines) {
    Json own{{"frequency_Hz", line.hz}, {"phase_rad", line.phase}};
    own.update(as_json(line.amplitude));
    for (const char* of_coefficients : {"shift_per_degree", "systematic_error"}) own.erase(of_coefficients);
    r["line"].push_back(own);
  }
  for (const Coefficient& c : run.asked) r[c.name] = as_json(c);
  return r;
}

Json as_json(const ::fit::RandomEffects& r) {
  Json j{{"law", ::fit::name_of(r.law)},
         {"terms", r.terms},
         {"between_runs", r.between},
         {"heterogeneity", r.heterogeneity},
         {"prediction", {r.prediction.low, r.prediction.high}},
         {"log_likelihood", r.log_likelihood},
         {"bic", r.bic},
         {"cross_validation", r.cross_validation}};
  if (std::isfinite(r.aicc)) j["aicc"] = r.aicc;
  for (std::size_t k = 0; k < r.terms.size(); ++k) {
    j["coefficients"].push_back(r.coefficients[static_cast<Eigen::Index>(k)]);
    j["intervals"].push_back({r.intervals[k].low, r.intervals[k].high});
  }
  return j;
}

}  // namespace

Json runs_as_json(const scene::FitScene& scene, const scene::MorisonModel& model, const std::vector<MorisonRun>& runs,
                  const std::vector<CoefficientLaw>& laws) {
  Json j{{"scene", scene.file.filename().string()},
         {"kind", scene.kind()},
         {"motion", scene::word_of(model.cylinder.experiment)},
         {"confidence", scene.confidence},
         {"intervals", scene::word_of(model.options.method)}};
  // What a scene of motion may include: the value of the one run, or of the law in the middle of the runs.
  for (std::size_t i = 0; i < model.coefficients.size(); ++i) {
    const std::string& name = model.coefficients[i];
    if (!laws.empty())
      j["coefficients"][name] = laws[i].laws.front().coefficients[0];
    else if (runs.size() == 1 && runs[0].asked[i].value)
      j["coefficients"][name] = *runs[0].asked[i].value;
  }
  j["run"] = Json::array();
  for (const MorisonRun& run : runs) j["run"].push_back(run_as_json(run));
  for (const CoefficientLaw& law : laws)
    for (const auto& r : law.laws) {
      Json one{{"of", law.coefficient}, {"runs", law.runs}, {"left_out", law.left_out}};
      one.update(as_json(r));
      j["law"].push_back(one);
    }
  return j;
}

}  // namespace froude
