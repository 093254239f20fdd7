#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/verdict.hpp"
#include "froude/fit_decay.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using Json = FitJson;

const char* unit_of(const std::string& term, bool angle) {
  if (term == "linear" || term == "memory_decay") return "1/s";
  if (term == "memory_strength") return "1/s^2";
  if (term == "memory_frequency") return "rad/s";
  if (term == "quadratic") return angle ? "1/rad" : "1/m";
  if (term == "cubic") return angle ? "s/rad^2" : "s/m^2";
  if (term == "period") return "s";
  return angle ? "rad/s^2" : "m/s^2";
}

std::string sentence(const Coefficient& c, const char* unit, double confidence) {
  const std::string interval =
      fmt::format("{:g} % interval {:.5g} to {:.5g}", 100 * confidence, c.interval.low, c.interval.high);
  if (!c.value) return fmt::format("  {:<10} not identifiable: {}\n", c.name, c.why_not);
  return fmt::format("  {:<10} {:.5g} {}, {}\n", c.name, *c.value, unit, interval);
}

/// Units of added mass and of the damping terms with the body's mass in them.
const char* mass_unit_of(const std::string& what, bool angle) {
  if (what == "added_mass") return angle ? "kg m^2" : "kg";
  if (what == "linear" || what == "damping") return angle ? "N m s/rad" : "N s/m";
  if (what == "quadratic") return angle ? "N m s^2/rad^2" : "N s^2/m^2";
  if (what == "cubic") return angle ? "N m s^3/rad^3" : "N s^3/m^3";
  return angle ? "N m" : "N";
}

void tell_water(const DecayRun& run, bool angle, const Console& console, double confidence) {
  if (!run.water) return;
  console.out << fmt::format("  at {:.4g} rad/s, with the body's mass and stiffness:\n", run.water->omega);
  console.out << sentence(run.water->added_mass, mass_unit_of("added_mass", angle), confidence);
  for (const Coefficient& c : run.water->damping) console.out << sentence(c, mass_unit_of(c.name, angle), confidence);
}

std::string listed(const Eigen::VectorXd& values) {
  std::string out;
  for (const double v : values) out += fmt::format("{}{:.3g}", out.empty() ? "" : ", ", v);
  return out;
}

void tell_memory(const DecayRun& run, bool angle, const Console& console, double confidence) {
  if (!run.memory) return;
  const auto& m = *run.memory;
  console.out << fmt::format(
      "  with a memory of the water in place of a constant damping: swings at {:.4g} rad/s, decays by {:.4g}/s; "
      "residual "
      "{:.3g} rms; AICc lower by {:.4g} than without\n",
      m.omega, m.rate, m.motion.rms[0], m.gain);
  for (const auto* group : {&m.memory, &m.damping})
    for (const Coefficient& c : *group) console.out << sentence(c, unit_of(c.name, angle), confidence);
  if (m.singular_values.size() > 0)
    console.out << fmt::format("  singular values of the parameters over their errors {}; {}\n",
                               listed(m.singular_values), m.weakest);
  console.out << fmt::format("  search: iterations {}, {}; {}\n", m.motion.search.iterations, m.motion.search.why,
                             m.motion.search.identifiability);
  if (!m.motion.caution.empty()) console.out << "  caution: " << m.motion.caution << '\n';
  if (!run.swing) return;
  console.out << fmt::format("  by the memory at {:.4g} rad/s:\n", run.swing->omega);
  for (const Coefficient* c : {&run.swing->added_mass, &run.swing->damping})
    console.out << sentence(*c, mass_unit_of(c->name, angle), confidence);
  console.out << "  and at infinite frequency:\n"
              << sentence(run.limit->added_mass, mass_unit_of("added_mass", angle), confidence);
}

Json own_json(const Coefficient& c) {
  Json j = as_json(c);
  j.erase("shift_per_degree");
  return j;
}

Json as_json(const ::fit::DecayRadiation& r) {
  Json j{{"added_mass", own_json(r.added_mass)}, {"damping", own_json(r.damping)}};
  if (std::isfinite(r.omega)) j["omega_rad_s"] = r.omega;
  for (const char* name : {"added_mass", "damping"})
    for (const char* of_series : {"effective_samples", "interval_if_independent"}) j[name].erase(of_series);
  return j;
}

Json memory_as_json(const DecayRun& run) {
  const auto& m = *run.memory;
  Json j{{"omega_rad_s", m.omega}, {"rate_1_s", m.rate},   {"residual_rms", m.motion.rms[0]},
         {"aicc_gained", m.gain},  {"weakest", m.weakest}, {"identifiability", m.motion.search.identifiability}};
  if (!m.motion.caution.empty()) j["caution"] = m.motion.caution;
  j["singular_values"] = Json::array();
  for (const double s : m.singular_values) j["singular_values"].push_back(s);
  for (const auto* group : {&m.memory, &m.damping})
    for (const Coefficient& c : *group) j[c.name] = own_json(c);
  if (run.swing) j["swing"] = as_json(*run.swing);
  if (run.limit) j["limit"] = as_json(*run.limit);
  return j;
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

}  // namespace

void tell_decay(const scene::FitScene& scene, const DecayRun& run, const Console& console) {
  const bool angle = scene.turns();
  const auto& m = run.fit.motion;
  if (run.records.size() == 1)
    console.out << fmt::format("{}: {} half cycles from {:.4g} to {:.4g} {}, residual {:.3g} rms", run.name,
                               run.decrement.amplitude.size(), run.decrement.amplitude.front(),
                               run.decrement.amplitude.back(), angle ? "rad" : "m", m.rms[0]);
  else
    console.out << fmt::format("{} runs with one set of coefficients: residual {:.3g} rms", run.records.size(),
                               m.rms[0]);
  console.out << fmt::format(", {:.4g} % of the variance explained\n", 100 * m.explained[0]);
  if (m.explained[0] < ::fit::least_explained)
    console.out << fmt::format(
        "  accepted: less than {:g} % is explained; intervals are made from what is left, and an error of the model is "
        "in none of them\n",
        100 * ::fit::least_explained);
  console.out << sentence(run.fit.period, "s", scene.confidence);
  for (const Coefficient& c : run.fit.damping) console.out << sentence(c, unit_of(c.name, angle), scene.confidence);
  tell_water(run, angle, console, scene.confidence);
  for (std::size_t k = 0; k < run.profiles.size(); ++k)
    console.out << fmt::format("  {:<10} by profile likelihood {:.5g} to {:.5g}\n", run.fit.damping[k].name,
                               run.profiles[k].low, run.profiles[k].high);
  if (run.records.size() == 1) {
    console.out << fmt::format(
        "  damping ratio by decrement {:.4g} in the first half cycle, {:.4g} in the last; by energy:",
        run.decrement.ratio.front(), run.decrement.ratio.back());
    for (const Coefficient& c : run.fit.energy.damping) console.out << fmt::format(" {} {:.4g}", c.name, *c.value);
    console.out << '\n';
  }
  console.out << fmt::format(
      "  AICc {:.1f}, BIC {:.1f} (to compare terms on this record); halving the steps changes {:.1g} % of the "
      "amplitude\n",
      run.fit.aicc, run.fit.bic, m.integration_error);
  if (!m.fit_band.empty())
    console.out << fmt::format("  {:.1f} % of the samples lie in the band in which {:g} % should\n", 100 * m.inside,
                               100 * scene.confidence);
  console.out << fmt::format("  search: iterations {}, {}; {}\n", m.search.iterations, m.search.why,
                             m.search.identifiability);
  if (!m.caution.empty()) console.out << "  caution: " << m.caution << '\n';
  tell_memory(run, angle, console, scene.confidence);
  for (const DecayVariant& v : run.variants) {
    console.out << fmt::format("  with {}: ", v.what);
    if (!v.why_not.empty()) console.out << "cannot be fitted: " << v.why_not;
    for (std::size_t k = 0; k < v.changes.size(); ++k)
      console.out << fmt::format("{}{} {:+.1f} errors", k > 0 ? ", " : "",
                                 k == 0 ? "period" : run.fit.damping[k - 1].name, v.changes[k]);
    console.out << '\n';
  }
  if (run.records.size() == 1) {
    for (const std::string& step : run.records[0].steps) console.out << "  " << step << '\n';
    for (const std::string& caution : run.records[0].cautions) console.out << "  caution: " << caution << '\n';
  }
  if (run.left)
    console.out << fmt::format(
        "  residuals: {:.0f} % of their variance in harmonics; neighbouring fortieths of a period correlate by {:.2f} "
        "(white with p = {:.2g})\n",
        100 * run.left->harmonic_share, run.left->lag_one, run.left->ljung_box_p);
}

void tell_decay_laws(const scene::FitScene& scene, const std::vector<DecayLaw>& laws, std::size_t runs,
                     const Console& console) {
  for (const DecayLaw& law : laws) {
    const auto& r = law.over_runs;
    console.out << fmt::format(
        "{} over {} runs: {:.4g} {}, {:g} % interval {:.4g} to {:.4g}; from run to run ±{:.2g}; the next between "
        "{:.4g} and {:.4g}\n",
        law.coefficient, runs, r.coefficients[0], unit_of(law.coefficient, scene.turns()), 100 * scene.confidence,
        r.intervals[0].low, r.intervals[0].high, r.between, r.prediction.low, r.prediction.high);
  }
}

FitJson decay_as_json(const DecayRun& run) {
  Json j{{"file", run.name},
         {"residual_rms", run.fit.motion.rms[0]},
         {"explained", run.fit.motion.explained[0]},
         {"bic", run.fit.bic},
         {"search", run.fit.motion.search.why},
         {"identifiability", run.fit.motion.search.identifiability}};
  for (const auto& [name, value] : run.labels) j["labels"][name] = value;
  if (run.records.size() == 1)
    j.update({{"decrement_ratio", run.decrement.ratio}, {"decrement_amplitude", run.decrement.amplitude}});
  if (std::isfinite(run.fit.aicc)) j["aicc"] = run.fit.aicc;
  if (!run.fit.motion.caution.empty()) j["caution"] = run.fit.motion.caution;
  if (!run.fit.motion.fit_band.empty())
    j.update({{"samples_in_band", run.fit.motion.inside},
              {"widest_band_of_fit", run.fit.motion.fit_band[0].maxCoeff()},
              {"widest_band_of_sample", run.fit.motion.sample_band[0].maxCoeff()}});
  const auto put = [&](const Coefficient& c) {
    j[c.name] = own_json(c);
    j[c.name].erase("systematic_error");
  };
  put(run.fit.period);
  for (const Coefficient& c : run.fit.damping) put(c);
  for (std::size_t k = 0; k < run.profiles.size(); ++k)
    j[run.fit.damping[k].name]["profile_interval"] = {run.profiles[k].low, run.profiles[k].high};
  for (const Coefficient& c : run.fit.energy.damping) j["energy"][c.name] = *c.value;
  if (run.records.size() == 1) {
    j["steps"] = run.records[0].steps;
    j["cautions"] = run.records[0].cautions;
  }
  for (const DecayVariant& v : run.variants) {
    Json one{{"with", v.what}};
    if (!v.why_not.empty()) one["why_not"] = v.why_not;
    for (std::size_t k = 0; k < v.changes.size(); ++k)
      one[k == 0 ? "period" : run.fit.damping[k - 1].name] = v.changes[k];
    j["variant"].push_back(one);
  }
  if (run.left)
    j["residuals"] = {{"harmonic_share", run.left->harmonic_share},
                      {"lag_one", run.left->lag_one},
                      {"ljung_box_p", run.left->ljung_box_p}};
  if (run.memory) j["memory"] = memory_as_json(run);
  if (!run.water) return j;
  Json& water = j["water"];
  water["omega_rad_s"] = run.water->omega;
  for (Coefficient c : run.water->damping) water["damping"][c.name] = froude::as_json(c);
  water["added_mass"] = froude::as_json(run.water->added_mass);
  return j;
}

FitJson decay_law_as_json(const DecayLaw& law) {
  const auto& r = law.over_runs;
  return {{"value", r.coefficients[0]},
          {"interval", {r.intervals[0].low, r.intervals[0].high}},
          {"between_runs", r.between},
          {"prediction", {r.prediction.low, r.prediction.high}}};
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
    out += fmt::format(",{0} [{1}],{0}_low [{1}],{0}_high [{1}]", c.name, unit_of(c.name, angle));
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
  plot::Figure f{.title = scene.title.empty() ? scene.file.filename().string() : scene.title, .panels = {}};
  for (const DecayRun& run : runs) {
    for (std::size_t w = 0; w < run.records.size(); ++w) add_record(scene, run, w, f);
    if (!run.swing || !run.swing->damping.value) continue;
    f.panels.push_back(panel_over_frequency(run, false, mass_unit_of("added_mass", angle), scene.confidence));
    f.panels.push_back(panel_over_frequency(run, true, mass_unit_of("damping", angle), scene.confidence));
  }
  return f;
}

}  // namespace froude
