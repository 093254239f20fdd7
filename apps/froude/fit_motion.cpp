#include <algorithm>
#include <optional>

#include "fit/simulated.hpp"
#include "fit/verdict.hpp"
#include "froude/fit_summary.hpp"
#include "froude/scene_runs.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
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

/// Values of the parameters, and what a scene of motion may include of them.
void add_values(const FittedMotion& m, FitSummary& summary) {
  summary.group = "parameter";
  for (std::size_t k = 0; k < m.fit.parameters.size(); ++k) {
    const Coefficient& c = m.fit.parameters[k];
    const auto& [number, unit, place] = m.model.parameters[k];
    const std::string key = bare(c.name);
    if (c.value && unit.empty()) summary.facts["coefficients"][key] = *c.value;
    if (c.value && !unit.empty()) summary.facts["coefficients"][key] = fmt::format("{:.10g} {}", *c.value, unit);
    Estimate e{c, unit};
    e.key = key;
    e.facts = {{"key", number.name}, {"unit", unit}};
    if (c.value)
      e.more =
          fmt::format(" (if residuals were independent {:.5g} to {:.5g})", c.white_interval.low, c.white_interval.high);
    summary.estimates.push_back(std::move(e));
  }
}

/// Residuals of each signal against the deviation that was stated, and the bands.
void add_signals(const FittedMotion& m, FitSummary& summary) {
  const auto& fit = m.fit;
  for (std::size_t c = 0; c < m.units.size(); ++c) {
    summary.say("{}", difference(m, c));
    if (!fit.refused.empty()) continue;
    summary.facts["signal"].push_back({{"of", m.model.signals[c].of},
                                       {"unit", m.units[c]},
                                       {"rms", fit.rms[c]},
                                       {"deviation", fit.stated[c].stated},
                                       {"rms_allowed", fit.stated[c].allowed},
                                       {"widest_band_of_fit", widest(fit.fit_band, c)},
                                       {"widest_band_of_sample", widest(fit.sample_band, c)}});
  }
  if (!fit.refused.empty()) return;
  summary.facts["samples_in_band"] = fit.inside;
  summary.say("{:.1f} % of the samples lie in the band in which {:g} % should", 100 * fit.inside,
              100 * m.scene.confidence);
}

FitSummary summary_of(const FittedMotion& m) {
  const auto& fit = m.fit;
  const bool told = fit.refused.empty();
  FitSummary summary = begin_summary(m.scene);
  summary.heading =
      fmt::format("{}: {} samples of {} signals in {} window{}, {} runs of a window",
                  m.scene.files[0].value.filename().string(), m.measured.values.rows(), m.measured.values.cols(),
                  m.measured.first.size(), m.measured.first.size() == 1 ? "" : "s", fit.windows_followed);
  summary.facts["of"] = m.model.scene.value.filename().string();
  summary.facts["search"] = fit.search.why;
  if (told) add_values(m, summary);
  add_signals(m, summary);
  if (told) {
    const std::vector<std::string> all = accepted(m);
    summary.facts["accepted"] = all;
    for (const std::string& one : all) summary.say("accepted: {}", one);
  }
  if (fit.starts_all > 0)
    summary.say("of {} numbers of the windows' starts the signals see {}, which are fitted too", fit.starts_all,
                fit.starts_seen);
  if (told) {
    summary.facts["weakest"] = fit.weakest;
    summary.facts["singular_values"] = std::vector<double>(fit.singular_values.begin(), fit.singular_values.end());
    summary.say("singular values {:.3g}; {}", fmt::join(fit.singular_values, ", "), fit.weakest);
  }
  summary.say("search: iterations {}, {}", fit.search.iterations, fit.search.why);
  summary.warn(fit.caution);
  return summary;
}

void add_starts(const ::fit::SeveralStarts& several, FitSummary& summary) {
  summary.facts["starts"] = {
      {"tried", several.tried}, {"agree", several.agree}, {"failed", several.failed}, {"unended", several.unended}};
  summary.say("of {} starts {} came there, {} had no motion to follow, {} came to no end", several.tried, several.agree,
              several.failed, several.unended);
}

/// Intervals by the likelihood of each parameter that has a value and an error.
void add_profiles(const FittedMotion& m, ::fit::Simulation& runs, const ::fit::SimulationProblem& problem,
                  FitSummary& summary) {
  for (std::size_t k = 0; k < summary.estimates.size(); ++k)
    if (const Coefficient& c = m.fit.parameters[k]; c.value && c.standard_error > 0)
      summary.estimates[k].profile = ::fit::profile_interval(runs, problem, m.fit, k);
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
  plot::Figure f{.title = title_of(scene), .panels = {}};
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
std::exception_ptr refusal_of(const FittedMotion& m) {
  std::string signals;
  for (std::size_t c = 0; c < m.units.size(); ++c)
    if (!m.fit.stated[c].hold()) signals += "; " + difference(m, c);
  if (!m.fit.search.ended())
    return std::make_exception_ptr(hydro::NumericsError(fmt::format(
        "no value is told: the search has no end: {}{}. Begin elsewhere (first of a [[model.parameter]]) or "
        "at several points ([model] starts), let it take more steps ([model] iterations, now {}), or change "
        "the model",
        ::fit::why_unended(m.fit.search), signals, m.model.iterations)));
  const auto bad = std::find_if(m.fit.stated.begin(), m.fit.stated.end(), [](const auto& s) { return !s.hold(); });
  return std::make_exception_ptr(CheckFailed(hydro::InputError(
      "no value is told: the search ended, but not at the motion that was measured" + signals,
      m.model.signals[static_cast<std::size_t>(bad - m.fit.stated.begin())].deviation.place,
      "begin elsewhere (first) or at several points (starts), change the model, or state the deviation that the noise "
      "has; to have values all the same: [ask] accept = [\"residuals\"]")));
}

}  // namespace

FitOutcome fit_model(const scene::FitScene& scene, const scene::MotionModel& model) {
  const MeasuredRun measured = MeasuredRun::read(scene, model);
  SceneRuns runs(model, measured);
  const std::vector<std::string> units = runs.units();
  const ::fit::SimulationProblem problem = problem_of(scene, model, measured, units);
  std::optional<::fit::SeveralStarts> several;
  if (model.starts > 1) several = ::fit::fit_simulation_from(runs, problem, model.starts);
  const auto result = several ? several->best : ::fit::fit_simulation(runs, problem);
  const FittedMotion fitted{scene, model, measured, units, result};
  FitOutcome out{summary_of(fitted), figure(fitted)};
  if (several) add_starts(*several, out.summary);
  if (!result.refused.empty()) {
    out.refused = refusal_of(fitted);
  } else if (model.profile) {
    try {
      add_profiles(fitted, runs, problem, out.summary);
    } catch (const hydro::NumericsError&) {  // values are printed all the same
      out.refused = std::current_exception();
    }
  }
  return out;
}

}  // namespace froude
