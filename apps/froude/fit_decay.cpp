#include <algorithm>
#include <cmath>

#include "fit/decay.hpp"
#include "fit/forced_radiation.hpp"
#include "froude/fit_report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using ::fit::Coefficient;
using Json = FitJson;

struct DecayRun {
  std::string name;
  std::vector<double> time, values;
  ::fit::Decrement decrement;
  ::fit::DecayFit fit;
  std::vector<::fit::Interval> profiles;       ///< of the terms, where asked for
  std::optional<::fit::AddedMass> water = {};  ///< where the body is known
};

::fit::DampingTerms terms_of(const scene::FitScene& scene) {
  ::fit::DampingTerms terms{.linear = false};
  for (const std::string& name : scene.coefficients) {
    if (name == "linear") terms.linear = true;
    if (name == "quadratic") terms.quadratic = true;
    if (name == "cubic") terms.cubic = true;
    if (name == "coulomb") terms.coulomb = true;
  }
  return terms;
}

DecayRun fit_one(const scene::FitScene& scene, const std::filesystem::path& file) try {
  const auto table = hydro::io::CsvTable::read(file);
  const bool angle = scene.channels.count("angle") > 0;
  DecayRun run{.name = file.filename().string(),
               .time = table.column(scene.channels.at("time"), dim::time),
               .values = angle ? table.column(scene.channels.at("angle"), dim::angle)
                               : table.column(scene.channels.at("position"), dim::length),
               .decrement = {},
               .fit = {},
               .profiles = {}};
  const ::fit::Window window{hydro::signal::even_step(run.time),
                             Eigen::Map<const Eigen::VectorXd>(run.values.data(), std::ssize(run.values))};
  run.decrement = ::fit::logarithmic_decrement(::fit::find_extremes(run.time, run.values));
  run.fit = ::fit::fit_decay(std::vector{window},
                             {.terms = terms_of(scene), .pendulum = scene.model.sine, .confidence = scene.confidence});
  if (const auto& b = scene.model.body)
    run.water =
        ::fit::added_mass(run.fit, {b->mass, b->stiffness, b->mass_error, b->stiffness_error}, scene.confidence);
  const auto names = ::fit::parameters_of(run.fit.problem.law);
  for (const Coefficient& c : run.fit.damping) {
    if (!scene.profile) break;
    const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), c.name) - names.begin());
    run.profiles.push_back(::fit::profile_interval(run.fit.problem, run.fit.motion, at));
  }
  return run;
} catch (const hydro::InputError& e) {
  throw e.at({.file = file.string()});
}

const char* unit_of(const std::string& term, bool angle) {
  if (term == "linear") return "1/s";
  if (term == "quadratic") return angle ? "1/rad" : "1/m";
  if (term == "cubic") return angle ? "s/rad^2" : "s/m^2";
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
  if (what == "linear") return angle ? "N m s/rad" : "N s/m";
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

void tell(const scene::FitScene& scene, const DecayRun& run, const Console& console) {
  const bool angle = scene.channels.count("angle") > 0;
  const auto& m = run.fit.motion;
  console.out << fmt::format("{}: {} half cycles from {:.4g} to {:.4g} {}, residual {:.3g} rms\n", run.name,
                             run.decrement.amplitude.size(), run.decrement.amplitude.front(),
                             run.decrement.amplitude.back(), angle ? "rad" : "m", m.rms[0]);
  console.out << sentence(run.fit.period, "s", scene.confidence);
  for (const Coefficient& c : run.fit.damping) console.out << sentence(c, unit_of(c.name, angle), scene.confidence);
  tell_water(run, angle, console, scene.confidence);
  for (std::size_t k = 0; k < run.profiles.size(); ++k)
    console.out << fmt::format("  {:<10} by profile likelihood {:.5g} to {:.5g}\n", run.fit.damping[k].name,
                               run.profiles[k].low, run.profiles[k].high);
  console.out << fmt::format(
      "  damping ratio by decrement {:.4g} in the first half cycle, {:.4g} in the last; by energy:",
      run.decrement.ratio.front(), run.decrement.ratio.back());
  for (const Coefficient& c : run.fit.energy.damping) console.out << fmt::format(" {} {:.4g}", c.name, *c.value);
  console.out << fmt::format(
      "\n  AICc {:.1f}, BIC {:.1f} (to compare terms on this record); halving the steps changes {:.1g} % of the "
      "amplitude\n",
      run.fit.aicc, run.fit.bic, m.integration_error);
  if (!m.fit_band.empty())
    console.out << fmt::format("  {:.1f} % of the samples lie in the band in which {:g} % should\n", 100 * m.inside,
                               100 * scene.confidence);
  console.out << fmt::format("  search: iterations {}, {}; {}\n", m.search.iterations, m.search.why,
                             m.search.identifiability);
  if (!m.caution.empty()) console.out << "  caution: " << m.caution << '\n';
}

Json as_json_of(const DecayRun& run) {
  Json j{{"file", run.name},
         {"residual_rms", run.fit.motion.rms[0]},
         {"decrement_ratio", run.decrement.ratio},
         {"decrement_amplitude", run.decrement.amplitude},
         {"bic", run.fit.bic},
         {"search", run.fit.motion.search.why},
         {"identifiability", run.fit.motion.search.identifiability}};
  if (std::isfinite(run.fit.aicc)) j["aicc"] = run.fit.aicc;
  if (!run.fit.motion.caution.empty()) j["caution"] = run.fit.motion.caution;
  if (!run.fit.motion.fit_band.empty())
    j.update({{"samples_in_band", run.fit.motion.inside},
              {"widest_band_of_fit", run.fit.motion.fit_band[0].maxCoeff()},
              {"widest_band_of_sample", run.fit.motion.sample_band[0].maxCoeff()}});
  const auto put = [&](const Coefficient& c) {
    j[c.name] = as_json(c);
    for (const char* of_force : {"shift_per_degree", "systematic_error"}) j[c.name].erase(of_force);
  };
  put(run.fit.period);
  for (const Coefficient& c : run.fit.damping) put(c);
  for (std::size_t k = 0; k < run.profiles.size(); ++k)
    j[run.fit.damping[k].name]["profile_interval"] = {run.profiles[k].low, run.profiles[k].high};
  for (const Coefficient& c : run.fit.energy.damping) j["energy"][c.name] = *c.value;
  if (!run.water) return j;
  Json& water = j["water"];
  water["omega_rad_s"] = run.water->omega;
  for (Coefficient c : run.water->damping) water["damping"][c.name] = as_json(c);
  water["added_mass"] = as_json(run.water->added_mass);
  return j;
}

plot::Figure figure(const scene::FitScene& scene, const std::vector<DecayRun>& runs) {
  const bool angle = scene.channels.count("angle") > 0;
  plot::Figure f{.title = scene.title.empty() ? scene.file.filename().string() : scene.title, .panels = {}};
  for (const DecayRun& run : runs) {
    const auto& motion = run.fit.motion.motion[0];
    std::vector<double> fitted(motion.data(), motion.data() + motion.rows()), left = run.values;
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= fitted[i];
    f.panels.push_back(
        {.x = {"time", "s"},
         .y = {angle ? "angle" : "position", angle ? "rad" : "m"},
         .series = {{run.name + ": measured", run.time, run.values}, {"fitted", run.time, fitted, true, false, true}}});
    plot::Panel residual{
        .x = {"time", "s"}, .y = {"residual", angle ? "rad" : "m"}, .series = {{"measured − fitted", run.time, left}}};
    if (!run.fit.motion.fit_band.empty()) {
      const auto half = [](const Eigen::MatrixXd& band) {
        return std::vector<double>(band.data(), band.data() + band.rows());
      };
      const std::string level = fmt::format("{:g} % band", 100 * scene.confidence);
      residual.series.push_back(
          band_outline(level + " of a sample", run.time, half(run.fit.motion.sample_band[0]), true));
      residual.series.push_back(band_outline(level + " of the fit", run.time, half(run.fit.motion.fit_band[0]), false));
    }
    f.panels.push_back(std::move(residual));
  }
  return f;
}

}  // namespace

void fit_decays(const scene::FitScene& scene, const FitArguments& arguments, const Console& console) {
  std::vector<DecayRun> runs;
  for (const auto& file : scene.files) runs.push_back(fit_one(scene, file.value));
  Json j{{"scene", scene.file.filename().string()}, {"kind", "decay"}, {"confidence", scene.confidence}};
  if (runs.size() == 1) {
    if (runs[0].fit.period.value) j["coefficients"]["period"] = *runs[0].fit.period.value;
    for (const Coefficient& c : runs[0].fit.damping)
      if (c.value) j["coefficients"][c.name] = *c.value;
    if (runs[0].water && runs[0].water->added_mass.value)
      j["coefficients"]["added_mass"] = *runs[0].water->added_mass.value;
  }
  j["run"] = Json::array();
  for (const DecayRun& run : runs) {
    if (!console.json) tell(scene, run, console);
    j["run"].push_back(as_json_of(run));
  }
  deliver(arguments, console, j, figure(scene, runs));
}

}  // namespace froude
