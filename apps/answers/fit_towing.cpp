#include <algorithm>

#include "answers/fit_kinds.hpp"

namespace froude {

namespace dim = hydro::dim;

::fit::towing::Problem problem_of(const scene::FitScene& scene, const scene::TowingModel& model) {
  ::fit::towing::Problem out{model.cylinder, {}, model};
  for (const auto& file : scene.files) {
    const Measurements measured(scene, file.value);
    const auto column = [&](const char* role, const hydro::Dimension& dimension) {
      const std::vector<double> values = measured.of_role(role, dimension);
      return values.empty() ? std::vector<double>(measured.table.rows()) : values;  // a deviation that is not known
    };
    const auto speed = column("speed", dim::velocity), speed_sd = column("speed_sd", dim::velocity);
    const auto force = measured.load(), force_sd = column("force_sd", dim::force);
    for (std::size_t i = 0; i < force.size(); ++i) out.runs.push_back({speed[i], speed_sd[i], force[i], force_sd[i]});
  }
  return out;
}

Remedy remedy_of(const scene::FitScene& scene, const ::fit::towing::Problem&, const ::fit::towing::Solution&) {
  return {scene.model_place,
          "cd may depend on speed: fit fewer runs, or state the deviations that they have; to have their mean all the "
          "same: [ask] accept = [\"residuals\"]"};
}

Panels panels_of(const ::fit::towing::Problem& problem, const ::fit::towing::Solution& solution) {
  if (solution.report.refused) return {};
  const auto& fit = solution.fit;
  plot::Series points{"runs", {}, {}, false, true};
  for (std::size_t i = 0; i < problem.runs.size(); ++i) {
    points.x.push_back(problem.runs[i].speed);
    points.y.push_back(fit.points[i].cd);
  }
  const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
  const std::vector<double> ends{*low, *high};
  return {{.x = {"speed", "m/s"},
           .y = {"C_D"},
           .series = {points, {"together", ends, {*fit.cd.value, *fit.cd.value}}},
           .bands = {{fmt::format("{:g} %", 100 * fit.confidence),
                      ends,
                      {fit.cd.interval.low, fit.cd.interval.low},
                      {fit.cd.interval.high, fit.cd.interval.high}}}}};
}

}  // namespace froude
