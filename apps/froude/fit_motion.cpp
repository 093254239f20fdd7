#include <algorithm>
#include <optional>

#include "fit/simulated.hpp"
#include "fit/verdict.hpp"
#include "froude/fit_report.hpp"
#include "froude/scene_runs.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using Json = FitJson;
using Motion = scene::MotionModel;

/// What was asked, what was measured, and what came of it.
struct FittedMotion {
  const scene::FitScene& scene;
  const Motion& model;
  const MeasuredRun& measured;
  const std::vector<std::string>& units;  ///< of the signals
  const ::fit::SimulationFit& fit;
};

/// The deviation of a signal's noise, SI, and the dimension of its column against that of the run.
double deviation_of(const Motion::Signal& s, const std::string& unit, const hydro::io::CsvTable& table) {
  const hydro::Dimension needed = hydro::parse_unit(unit).dimension;
  table.column(s.column, needed);  // refuses a column of another dimension
  try {
    const double out = hydro::parse_si(s.deviation.value, needed);
    hydro::require(out > 0, "the deviation of \"{}\" must be positive, got {}", s.of, out);
    return out;
  } catch (const hydro::InputError& e) {
    throw e.at(s.deviation.place);
  }
}

::fit::SimulationProblem problem_of(const scene::FitScene& scene, const Motion& model, const MeasuredRun& measured,
                                    const std::vector<std::string>& units) {
  ::fit::SimulationProblem p;
  for (const auto& q : model.parameters) p.parameters.push_back(q.number);
  for (std::size_t w = 0; w < measured.first.size(); ++w)
    p.measured.emplace_back(measured.values.middleRows(measured.first[w], measured.rows(w)));
  const auto table = hydro::io::CsvTable::read(scene.files[0].value);
  for (std::size_t c = 0; c < units.size(); ++c)
    p.deviations.push_back(deviation_of(model.signals[c], units[c], table));
  p.confidence = scene.confidence;
  p.iterations_reach = model.iterations;
  p.accept_residuals = model.accept_residuals;
  return p;
}

void tell_values(const FittedMotion& m, const Console& console) {
  const auto& fit = m.fit;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const Coefficient& c = fit.parameters[k];
    const std::string unit = m.model.parameters[k].unit;
    const std::string interval =
        fmt::format("{:g} % interval {:.5g} to {:.5g}", 100 * m.scene.confidence, c.interval.low, c.interval.high);
    if (c.value)
      console.out << fmt::format("  {} {:.5g}{}{}, {} (if residuals were independent {:.5g} to {:.5g})\n", c.name,
                                 *c.value, unit.empty() ? "" : " ", unit, interval, c.white_interval.low,
                                 c.white_interval.high);
    else
      console.out << fmt::format("  {} not identifiable: {}; {}\n", c.name, c.why_not, interval);
  }
}

/// "x differs by 0.057 m rms; its deviation is stated as 0.002 m, which allows 0.0026 m"
std::string difference(const FittedMotion& m, std::size_t c) {
  const auto& s = m.fit.stated[c];
  const std::string& unit = m.units[c];
  return fmt::format("{} differs by {:.3g} {} rms; its deviation is stated as {:.3g} {}, which allows {:.3g} {}",
                     m.model.signals[c].of, m.fit.rms[c], unit, s.stated, unit, s.allowed, unit);
}

/// What is too large and was accepted; values are told all the same.
std::vector<std::string> accepted(const FittedMotion& m) {
  std::vector<std::string> out;
  for (std::size_t c = 0; c < m.units.size(); ++c)
    if (const auto& s = m.fit.stated[c]; !s.hold())
      out.push_back(
          fmt::format("{}; intervals are made from these residuals, {:.3g} times what is stated, and an error of the "
                      "model is in none of them",
                      difference(m, c), s.rms / s.stated));
  return out;
}

void tell(const FittedMotion& m, const Console& console) {
  const auto& [scene, model, measured, units, fit] = m;
  console.out << fmt::format("{}: {} samples of {} signals in {} window{}, {} runs of a window\n",
                             scene.files[0].value.filename().string(), measured.values.rows(), measured.values.cols(),
                             measured.first.size(), measured.first.size() == 1 ? "" : "s", fit.windows_followed);
  if (fit.refused.empty()) tell_values(m, console);
  for (std::size_t c = 0; c < units.size(); ++c) console.out << "  " << difference(m, c) << '\n';
  if (fit.refused.empty()) {
    console.out << fmt::format("  {:.1f} % of the samples lie in the band in which {:g} % should\n", 100 * fit.inside,
                               100 * m.scene.confidence);
    for (const std::string& a : accepted(m)) console.out << "  accepted: " << a << '\n';
  }
  if (fit.starts_all > 0)
    console.out << fmt::format("  of {} numbers of the windows' starts the signals see {}, which are fitted too\n",
                               fit.starts_all, fit.starts_seen);
  if (fit.refused.empty())
    console.out << fmt::format("  singular values {:.3g}; {}\n", fmt::join(fit.singular_values, ", "), fit.weakest);
  console.out << fmt::format("  search: iterations {}, {}\n", fit.search.iterations, fit.search.why);
  if (!fit.caution.empty()) console.out << "  caution: " << fit.caution << '\n';
}

/// By the likelihood, of each parameter that has a value and an error, where asked for.
using Profiles = std::vector<std::optional<::fit::Interval>>;
Profiles profiles_of(const Motion& model, ::fit::Simulation& runs, const ::fit::SimulationProblem& problem,
                     const ::fit::SimulationFit& fit) {
  Profiles out(fit.parameters.size());
  for (std::size_t k = 0; model.profile && k < out.size(); ++k)
    if (fit.parameters[k].value && fit.parameters[k].standard_error > 0)
      out[k] = ::fit::profile_interval(runs, problem, fit, k);
  return out;
}

void tell(const ::fit::SimulationFit& fit, const Profiles& profiles, const Console& console) {
  for (std::size_t k = 0; k < profiles.size(); ++k)
    if (profiles[k])
      console.out << fmt::format("  {} by profile likelihood {:.5g} to {:.5g}\n", fit.parameters[k].name,
                                 profiles[k]->low, profiles[k]->high);
}

/// "line[1].damping.linear" as a bare key of TOML.
std::string bare(std::string key) {
  std::replace(key.begin(), key.end(), '.', '_');
  std::erase_if(key, [](char c) { return c == '[' || c == ']'; });
  return key;
}

double widest(const std::vector<Eigen::MatrixXd>& bands, std::size_t column) {
  double out = 0;
  for (const auto& band : bands) out = std::max(out, band.col(static_cast<Eigen::Index>(column)).maxCoeff());
  return out;
}

Json as_json_of(const FittedMotion& m) {
  const auto& [scene, model, measured, units, fit] = m;
  Json j{{"scene", scene.file.filename().string()},
         {"kind", scene.kind()},
         {"confidence", scene.confidence},
         {"of", model.scene.value.filename().string()},
         {"search", fit.search.why},
         {"accepted", accepted(m)},
         {"weakest", fit.weakest},
         {"singular_values", std::vector<double>(fit.singular_values.begin(), fit.singular_values.end())}};
  if (!fit.caution.empty()) j["caution"] = fit.caution;
  j["samples_in_band"] = fit.inside;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const Coefficient& c = fit.parameters[k];
    const auto& parameter = model.parameters[k];
    if (c.value && parameter.unit.empty()) j["coefficients"][bare(c.name)] = *c.value;
    if (c.value && !parameter.unit.empty())
      j["coefficients"][bare(c.name)] = fmt::format("{:.10g} {}", *c.value, parameter.unit);
    Json own = as_json(c);
    for (const char* of_force : {"shift_per_degree", "systematic_error"}) own.erase(of_force);
    own["key"] = parameter.number.name;
    own["unit"] = parameter.unit;
    j["parameter"][bare(c.name)] = own;
  }
  for (std::size_t c = 0; c < units.size(); ++c)
    j["signal"].push_back({{"of", model.signals[c].of},
                           {"unit", units[c]},
                           {"rms", fit.rms[c]},
                           {"deviation", fit.stated[c].stated},
                           {"rms_allowed", fit.stated[c].allowed},
                           {"widest_band_of_fit", widest(fit.fit_band, c)},
                           {"widest_band_of_sample", widest(fit.sample_band, c)}});
  return j;
}

/// A column of all windows, one after the other.
std::vector<double> joined(const std::vector<Eigen::MatrixXd>& windows, std::size_t column) {
  std::vector<double> out;
  for (const auto& w : windows) {
    const auto own = w.col(static_cast<Eigen::Index>(column));
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

plot::Figure figure(const FittedMotion& m) {
  const auto& [scene, model, measured, units, fit] = m;
  plot::Figure f{.title = scene.title.empty() ? scene.file.filename().string() : scene.title, .panels = {}};
  if (!fit.refused.empty()) f.title += ": no fit";
  const std::string level = fmt::format("{:g} % band", 100 * m.scene.confidence);
  const auto& t = measured.time;
  for (std::size_t c = 0; c < units.size(); ++c) {
    const auto column = measured.values.col(static_cast<Eigen::Index>(c));
    const std::vector<double> values(column.begin(), column.end()), fitted = joined(fit.motion, c);
    std::vector<double> left = values;
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= fitted[i];
    f.panels.push_back({.x = {"time", "s"},
                        .y = {model.signals[c].of, units[c]},
                        .series = {{"measured", t, values}, {"fitted", t, fitted, true, false, true}}});
    plot::Panel residual{
        .x = {"time", "s"}, .y = {"residual", units[c]}, .series = {{"measured − fitted", t, left, false, true}}};
    if (fit.refused.empty()) {
      residual.series.push_back(band_outline(level + " of a sample", t, joined(fit.sample_band, c), true));
      residual.series.push_back(band_outline(level + " of the fit", t, joined(fit.fit_band, c), false));
    }
    f.panels.push_back(std::move(residual));
  }
  return f;
}

/// (F65), (F66) Nothing is told but what stands against it: the picture alone is written.
[[noreturn]] void refuse_values(const FittedMotion& m) {
  const auto& [scene, model, measured, units, fit] = m;
  std::string signals;
  for (std::size_t c = 0; c < units.size(); ++c)
    if (!fit.stated[c].hold()) signals += "; " + difference(m, c);
  if (!fit.search.ended())
    throw hydro::NumericsError(fmt::format(
        "no value is told: the search has no end: {}{}. Begin elsewhere (first of a [[model.parameter]]) or "
        "at several points ([model] starts), let it take more steps ([model] iterations, now {}), or change "
        "the model",
        ::fit::why_unended(fit.search), signals, model.iterations));
  const auto bad = static_cast<std::size_t>(
      std::find_if(fit.stated.begin(), fit.stated.end(), [](const auto& s) { return !s.hold(); }) - fit.stated.begin());
  throw CheckFailed(hydro::InputError(
      fmt::format("no value is told: the search ended, but not at the motion that was measured{}", signals),
      model.signals[bad].deviation.place,
      "begin elsewhere (first) or at several points (starts), change the model, or state the deviation that the noise "
      "has; to have values all the same: [ask] accept = [\"residuals\"]"));
}

}  // namespace

void fit_model(const scene::FitScene& scene, const Motion& model, const FitArguments& arguments,
               const Console& console) {
  const MeasuredRun measured = MeasuredRun::read(scene, model);
  SceneRuns runs(model, measured);
  const std::vector<std::string> units = runs.units();
  const ::fit::SimulationProblem problem = problem_of(scene, model, measured, units);
  std::optional<::fit::SeveralStarts> several;
  if (model.starts > 1) several = ::fit::fit_simulation_from(runs, problem, model.starts);
  const auto result = several ? several->best : ::fit::fit_simulation(runs, problem);
  const FittedMotion fitted{scene, model, measured, units, result};
  if (!console.json) tell(fitted, console);
  if (several && !console.json)
    console.out << fmt::format("  of {} starts {} came there, {} had no motion to follow, {} came to no end\n",
                               several->tried, several->agree, several->failed, several->unended);
  if (!result.refused.empty()) {
    if (arguments.picture) hydro::io::write_atomically(*arguments.picture, plot::svg(figure(fitted)));
    refuse_values(fitted);
  }
  FitJson j = as_json_of(fitted);
  if (several)
    j["starts"] = {{"tried", several->tried},
                   {"agree", several->agree},
                   {"failed", several->failed},
                   {"unended", several->unended}};
  const Profiles profiles = profiles_of(model, runs, problem, result);
  for (std::size_t k = 0; k < profiles.size(); ++k)
    if (profiles[k])
      j["parameter"][bare(result.parameters[k].name)]["profile_interval"] = {profiles[k]->low, profiles[k]->high};
  if (!console.json) tell(result, profiles, console);
  deliver(arguments, console, j, figure(fitted));
}

}  // namespace froude
