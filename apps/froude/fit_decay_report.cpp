#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/verdict.hpp"
#include "froude/fit_decay.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using Json = FitJson;

/// Units of added mass and of the damping terms with the body's mass in them.
const char* mass_unit_of(const std::string& what, bool angle) {
  if (what == "added_mass") return angle ? "kg m^2" : "kg";
  if (what == "linear" || what == "damping") return angle ? "N m s/rad" : "N s/m";
  if (what == "quadratic") return angle ? "N m s^2/rad^2" : "N s^2/m^2";
  if (what == "cubic") return angle ? "N m s^3/rad^3" : "N s^3/m^3";
  return angle ? "N m" : "N";
}

Estimate in_units_of_decay(const Coefficient& c, bool angle) { return {c, unit_of_decay(c.name, angle)}; }
Estimate in_units_of_mass(const Coefficient& c, bool angle) { return {c, mass_unit_of(c.name, angle)}; }

/// Added mass and damping that belong to the natural period of the fit without a memory.
FitSummary summary_of(const ::fit::AddedMass& water, bool angle) {
  FitSummary summary{.key = "water"}, damping{.key = "damping"};
  summary.heading = fmt::format("  at {:.4g} rad/s, with the body's mass and stiffness:", water.omega);
  summary.facts["omega_rad_s"] = water.omega;
  summary.estimates = {in_units_of_mass(water.added_mass, angle)};
  for (const Coefficient& c : water.damping) damping.estimates.push_back(in_units_of_mass(c, angle));
  summary.parts.push_back(std::move(damping));
  return summary;
}

/// By the memory at the frequency of the swing, or at infinite frequency.
FitSummary summary_of(const ::fit::DecayRadiation& r, bool angle) {
  const bool swing = std::isfinite(r.omega);
  FitSummary summary{.key = swing ? "swing" : "limit"};
  summary.heading = swing ? fmt::format("  by the memory at {:.4g} rad/s:", r.omega) : "  and at infinite frequency:";
  summary.estimates = {in_units_of_mass(r.added_mass, angle)};
  if (swing) {
    summary.facts["omega_rad_s"] = r.omega;
    summary.estimates.push_back(in_units_of_mass(r.damping, angle));
  } else {
    summary.facts["damping"] = tree_of(in_units_of_mass(r.damping, angle));
  }
  return summary;
}

FitSummary summary_of_memory(const DecayRun& run, bool angle) {
  const auto& m = *run.memory;
  FitSummary summary{.key = "memory"};
  summary.heading = fmt::format(
      "  with a memory of the water in place of a constant damping: swings at {:.4g} rad/s, decays by {:.4g}/s; "
      "residual {:.3g} rms; AICc lower by {:.4g} than without",
      m.omega, m.rate, m.motion.rms[0], m.gain);
  summary.facts = {{"omega_rad_s", m.omega},
                   {"rate_1_s", m.rate},
                   {"residual_rms", m.motion.rms[0]},
                   {"aicc_gained", m.gain},
                   {"weakest", m.weakest},
                   {"identifiability", m.motion.search.identifiability},
                   {"singular_values", std::vector<double>(m.singular_values.begin(), m.singular_values.end())}};
  for (const auto* group : {&m.memory, &m.damping})
    for (const Coefficient& c : *group) summary.estimates.push_back(in_units_of_decay(c, angle));
  if (m.singular_values.size() > 0)
    summary.say("singular values of the parameters over their errors {:.3g}; {}", fmt::join(m.singular_values, ", "),
                m.weakest);
  summary.say("search: iterations {}, {}; {}", m.motion.search.iterations, m.motion.search.why,
              m.motion.search.identifiability);
  summary.warn(m.motion.caution);
  if (run.swing) summary.parts = {summary_of(*run.swing, angle), summary_of(*run.limit, angle)};
  return summary;
}

std::vector<double> column_of(const Eigen::MatrixXd& band) {
  return std::vector<double>(band.data(), band.data() + band.rows());
}

/// A coefficient over frequency with its interval; the swing's frequency is marked.
plot::Panel panel_over_frequency(const DecayRun& run, bool damping, const char* unit, double confidence) {
  plot::Series value{"by the memory", {}, {}}, low{fmt::format("{:g} % interval", 100 * confidence), {}, {}, true},
      swing{"at the swing", {}, {}, false, true};
  const auto part = [&](const ::fit::DecayRadiation& r) { return damping ? r.damping : r.added_mass; };
  for (const auto& r : run.curve) {
    value.x.push_back(r.omega);
    value.y.push_back(*part(r).value);
    low.x.push_back(r.omega);
    low.y.push_back(part(r).interval.low);
  }
  low.x.push_back(low.x.back());
  low.y.push_back(std::numeric_limits<double>::quiet_NaN());
  for (const auto& r : run.curve) {
    low.x.push_back(r.omega);
    low.y.push_back(part(r).interval.high);
  }
  swing.x = {run.swing->omega};
  swing.y = {*part(*run.swing).value};
  return {.x = {"frequency", "rad/s"},
          .y = {(run.name + ": ") + (damping ? "damping" : "added mass"), unit},
          .series = {value, low, swing}};
}

void add_record(const scene::FitScene& scene, const DecayRun& run, std::size_t w, plot::Figure& f) {
  const bool angle = scene.turns();
  const auto& m = run.fit.motion;
  const DecayRecord& r = run.records[w];
  const std::vector<double> fitted = column_of(m.motion[w]);
  std::vector<double> left = r.values;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= fitted[i];
  f.panels.push_back(
      {.x = {"time", "s"},
       .y = {angle ? "angle" : "position", angle ? "rad" : "m"},
       .series = {{r.name + ": measured", r.time, r.values}, {"fitted", r.time, fitted, true, false, true}}});
  plot::Panel residual{
      .x = {"time", "s"}, .y = {"residual", angle ? "rad" : "m"}, .series = {{"measured − fitted", r.time, left}}};
  if (!m.fit_band.empty()) {
    const std::string level = fmt::format("{:g} % band", 100 * scene.confidence);
    residual.series.push_back(band_outline(level + " of a sample", r.time, column_of(m.sample_band[w]), true));
    residual.series.push_back(band_outline(level + " of the fit", r.time, column_of(m.fit_band[w]), false));
  }
  if (run.memory) {
    std::vector<double> by_memory = column_of(run.memory->motion.motion[w]);
    for (std::size_t i = 0; i < by_memory.size(); ++i) by_memory[i] = r.values[i] - by_memory[i];
    residual.series.push_back({"measured − fitted with a memory", r.time, by_memory});
  }
  f.panels.push_back(std::move(residual));
}

/// How large the residual is of a record, or of several together.
FitSummary begin_run(const DecayRun& run, bool angle) {
  const auto& m = run.fit.motion;
  FitSummary summary{.key = "run", .one_of_many = true};
  if (run.records.size() == 1) {
    const auto& amplitude = run.decrement.amplitude;
    summary.heading = fmt::format("{}: {} half cycles from {:.4g} to {:.4g} {}, residual {:.3g} rms", run.name,
                                  amplitude.size(), amplitude.front(), amplitude.back(), angle ? "rad" : "m", m.rms[0]);
  } else {
    summary.heading =
        fmt::format("{} runs with one set of coefficients: residual {:.3g} rms", run.records.size(), m.rms[0]);
  }
  summary.heading += fmt::format(", {:.4g} % of the variance explained", 100 * m.explained[0]);
  summary.facts = {{"file", run.name},   {"residual_rms", m.rms[0]}, {"explained", m.explained[0]},
                   {"bic", run.fit.bic}, {"search", m.search.why},   {"identifiability", m.search.identifiability}};
  for (const auto& [name, value] : run.labels) summary.facts["labels"][name] = value;
  for (const Coefficient& c : run.fit.energy.damping) summary.facts["energy"][c.name] = *c.value;
  return summary;
}

/// What extremes alone tell.
void add_energy(const DecayRun& run, FitSummary& summary) {
  const auto& d = run.decrement;
  summary.facts.update({{"decrement_ratio", d.ratio}, {"decrement_amplitude", d.amplitude}});
  std::string by_energy;
  for (const Coefficient& c : run.fit.energy.damping) by_energy += fmt::format(" {} {:.4g}", c.name, *c.value);
  summary.say("damping ratio by decrement {:.4g} in the first half cycle, {:.4g} in the last; by energy:{}",
              d.ratio.front(), d.ratio.back(), by_energy);
}

void add_variant(const DecayRun& run, const DecayVariant& v, FitSummary& summary) {
  Json one{{"with", v.what}};
  if (!v.why_not.empty()) one["why_not"] = v.why_not;
  std::string changes = v.why_not.empty() ? "" : "cannot be fitted: " + v.why_not;
  for (std::size_t k = 0; k < v.changes.size(); ++k) {
    const std::string name = k == 0 ? "period" : run.fit.damping[k - 1].name;
    one[name] = v.changes[k];
    changes += fmt::format("{}{} {:+.1f} errors", k > 0 ? ", " : "", name, v.changes[k]);
  }
  summary.facts["variant"].push_back(one);
  summary.say("with {}: {}", v.what, changes);
}

}  // namespace

const char* unit_of_decay(const std::string& term, bool angle) {
  if (term == "linear" || term == "memory_decay") return "1/s";
  if (term == "memory_strength") return "1/s^2";
  if (term == "memory_frequency") return "rad/s";
  if (term == "quadratic") return angle ? "1/rad" : "1/m";
  if (term == "cubic") return angle ? "s/rad^2" : "s/m^2";
  if (term == "period") return "s";
  return angle ? "rad/s^2" : "m/s^2";
}

FitSummary summary_of(const scene::FitScene& scene, const DecayRun& run) {
  const bool angle = scene.turns(), alone = run.records.size() == 1;
  const auto& m = run.fit.motion;
  FitSummary summary = begin_run(run, angle);
  summary.estimates = {in_units_of_decay(run.fit.period, angle)};
  for (std::size_t k = 0; k < run.fit.damping.size(); ++k) {
    summary.estimates.push_back(in_units_of_decay(run.fit.damping[k], angle));
    if (k < run.profiles.size()) summary.estimates.back().profile = run.profiles[k];
  }
  if (m.explained[0] < ::fit::least_explained)
    summary.say(
        "accepted: less than {:g} % is explained; intervals are made from what is left, and an error of the model is "
        "in none of them",
        100 * ::fit::least_explained);
  if (alone) add_energy(run, summary);
  if (std::isfinite(run.fit.aicc)) summary.facts["aicc"] = run.fit.aicc;
  summary.say(
      "AICc {:.1f}, BIC {:.1f} (to compare terms on this record); halving the steps changes {:.1g} % of the "
      "amplitude",
      run.fit.aicc, run.fit.bic, m.integration_error);
  if (!m.fit_band.empty()) {
    summary.facts.update({{"samples_in_band", m.inside},
                          {"widest_band_of_fit", m.fit_band[0].maxCoeff()},
                          {"widest_band_of_sample", m.sample_band[0].maxCoeff()}});
    summary.say("{:.1f} % of the samples lie in the band in which {:g} % should", 100 * m.inside,
                100 * scene.confidence);
  }
  summary.say("search: iterations {}, {}; {}", m.search.iterations, m.search.why, m.search.identifiability);
  for (const DecayVariant& v : run.variants) add_variant(run, v, summary);
  if (run.left) add_residuals(summary, *run.left);
  if (alone) summary.steps = run.records[0].steps;
  if (alone) summary.cautions = run.records[0].cautions;
  summary.warn(m.caution);
  if (run.water) summary.parts.push_back(summary_of(*run.water, angle));
  if (run.memory) summary.parts.push_back(summary_of_memory(run, angle));
  return summary;
}

std::string decay_table(const scene::FitScene& scene, const std::vector<DecayRun>& runs) {
  const bool angle = scene.turns();
  const auto all_of = [](const DecayRun& run) {
    std::vector<Coefficient> all{run.fit.period};
    all.insert(all.end(), run.fit.damping.begin(), run.fit.damping.end());
    if (run.memory) all.insert(all.end(), run.memory->memory.begin(), run.memory->memory.end());
    return all;
  };
  std::string out = "file";
  for (const auto& [name, value] : runs[0].labels) out += "," + name;
  out += fmt::format(",first_amplitude [{}]", angle ? "rad" : "m");
  for (const Coefficient& c : all_of(runs[0]))
    out += fmt::format(",{0} [{1}],{0}_low [{1}],{0}_high [{1}]", c.name, unit_of_decay(c.name, angle));
  out += '\n';
  for (const DecayRun& run : runs) {
    out += run.name;
    for (const auto& [name, value] : run.labels) out += "," + value;
    out += fmt::format(",{:.6g}", run.decrement.amplitude.front());
    for (const Coefficient& c : all_of(run)) {
      out += c.value ? fmt::format(",{:.6g}", *c.value) : ",";
      // An interval is told for what cannot be told from zero, and is none where a direction is not seen.
      out += std::isfinite(c.interval.low) && std::isfinite(c.interval.high)
                 ? fmt::format(",{:.6g},{:.6g}", c.interval.low, c.interval.high)
                 : ",,";
    }
    out += '\n';
  }
  return out;
}

plot::Figure decay_figure(const scene::FitScene& scene, const std::vector<DecayRun>& runs) {
  const bool angle = scene.turns();
  plot::Figure f{.title = title_of(scene), .panels = {}};
  for (const DecayRun& run : runs) {
    for (std::size_t w = 0; w < run.records.size(); ++w) add_record(scene, run, w, f);
    if (!run.swing || !run.swing->damping.value) continue;
    f.panels.push_back(panel_over_frequency(run, false, mass_unit_of("added_mass", angle), scene.confidence));
    f.panels.push_back(panel_over_frequency(run, true, mass_unit_of("damping", angle), scene.confidence));
  }
  return f;
}

}  // namespace froude
