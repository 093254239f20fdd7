#include <algorithm>

#include "answers/fit_kinds.hpp"
#include "answers/scene_runs.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

using Motion = scene::MotionModel;

/// The runs of a scene with the record that they follow.
struct FollowedRecord {
  const MeasuredRun measured;
  SceneRuns runs;

  FollowedRecord(const scene::FitScene& scene, const Motion& model)
      : measured(MeasuredRun::read(scene, model)), runs(model, measured) {}
};

/// The deviation of a signal's noise, SI, and the dimension of its column against that of the run.
double deviation_of(const Motion::Signal& s, const std::string& unit, const hydro::io::CsvTable& table) {
  const hydro::Dimension needed = hydro::parse_unit(unit).dimension;
  table.column(s.column, needed);  // refuses a column of another dimension
  return scene::placed(s.deviation.place, [&] {
    const double out = hydro::parse_si(s.deviation.value, needed);
    hydro::require(out > 0, "the deviation of \"{}\" must be positive, got {}", s.of, out);
    return out;
  });
}

/// Signals and weights of a film, whose angles and places must be what the run's signals are.
void add_film(const Motion& model, const MeasuredRun& measured, const std::vector<std::string>& units,
              ::fit::motion::Problem& out) {
  for (std::size_t c = 0; c < units.size(); ++c) {
    const Motion::Signal& s = model.signals[c];
    const char* needed = s.marker.empty() ? "rad" : "m";
    if (units[c] != needed)
      throw hydro::InputError(
          fmt::format("\"{}\" is in {}; {} of a film is in {}", s.of, units[c].empty() ? "1" : units[c],
                      s.marker.empty() ? "the angle of a line" : "a coordinate", needed),
          s.deviation.place, "name a signal of the run that is what the film shows");
    out.signals.push_back({s.of, units[c], measured.deviations[c]});
  }
  for (std::size_t w = 0; w < measured.first.size(); ++w) {
    const auto from = measured.whitening.begin() + measured.first[w];
    out.whitening.emplace_back(from, from + measured.rows(w));
  }
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

}  // namespace

::fit::motion::Problem problem_of(const scene::FitScene& scene, const scene::MotionModel& model) {
  const auto followed = std::make_shared<FollowedRecord>(scene, model);
  const MeasuredRun& measured = followed->measured;
  ::fit::motion::Problem out{.source = {scene.files[0].value},
                             .simulation = {followed, &followed->runs},
                             .parameters = {},
                             .signals = {},
                             .time = measured.time,
                             .measured = {},
                             .options = {.confidence = scene.confidence,
                                         .starts = model.starts,
                                         .iterations_reach = model.iterations,
                                         .profile = model.profile,
                                         .accept_residuals = model.accept_residuals}};
  const std::vector<std::string> units = followed->runs.units();
  for (const auto& q : model.parameters) out.parameters.push_back({q.number, q.unit});
  for (std::size_t w = 0; w < measured.first.size(); ++w)
    out.measured.emplace_back(measured.values.middleRows(measured.first[w], measured.rows(w)));
  if (model.camera) {
    add_film(model, measured, units, out);
    return out;
  }
  const auto table = hydro::io::CsvTable::read(scene.files[0].value);
  for (std::size_t c = 0; c < units.size(); ++c)
    out.signals.push_back({model.signals[c].of, units[c], deviation_of(model.signals[c], units[c], table)});
  return out;
}

Remedy remedy_of(const scene::FitScene& scene, const ::fit::motion::Problem& problem,
                 const ::fit::motion::Solution& solution) {
  using enum ::fit::Refusal::Reason;
  if (!solution.trouble.empty()) return {scene.model_place, "Put that right in [[data.signal]] or in the file"};
  const auto& stated = solution.fit.stated;
  switch (solution.report.refused->reason) {
    case search_without_end:
      return {.text = fmt::format("Begin elsewhere (first of a [[model.parameter]]) or at several points ([model] "
                                  "starts), let it take more steps ([model] iterations, now {}), or change the model",
                                  problem.options.iterations_reach)};
    case residuals_too_large:
      break;
    default:
      return {};
  }
  const auto bad = std::find_if(stated.begin(), stated.end(), [](const auto& s) { return !s.hold(); });
  const auto& signals = std::get<Motion>(scene.model).signals;
  return {signals[static_cast<std::size_t>(bad - stated.begin())].deviation.place,
          "begin elsewhere (first) or at several points (starts), change the model, or state the deviation that the "
          "noise has; to have values all the same: [ask] accept = [\"residuals\"]"};
}

Panels panels_of(const ::fit::motion::Problem& problem, const ::fit::motion::Solution& solution) {
  const ::fit::SimulationFit& fit = solution.fit;
  Panels out;
  for (std::size_t c = 0; c < problem.signals.size(); ++c) {
    const auto& [name, unit, deviation] = problem.signals[c];
    Panels both = panels_of(FittedRecord{.legend = "measured",
                                         .axis = {name, unit},
                                         .confidence = problem.options.confidence,
                                         .time = problem.time,
                                         .measured = joined(problem.measured, c),
                                         .fitted = joined(fit.motion, c),
                                         .sample_band = joined(fit.sample_band, c),
                                         .fit_band = joined(fit.fit_band, c)});
    both[1].series[0].line = false;  // windows begin anew: what is left has jumps between them
    both[1].series[0].marks = true;
    out.insert(out.end(), both.begin(), both.end());
  }
  return out;
}

}  // namespace froude
