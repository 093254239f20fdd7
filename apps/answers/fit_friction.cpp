#include "answers/fit_kinds.hpp"

namespace froude {

::fit::friction::Problem problem_of(const scene::FitScene& scene, const scene::FrictionRampModel& model) {
  ::fit::friction::Problem out{.slides = !scene.turns(), .runs = {}, .options = model.options};
  for (const auto& [source, row] : runs_of(scene)) {
    const Measurements measured(scene, source.file);
    out.runs.push_back({source, measured.time(), measured.load()});
  }
  return out;
}

Panels panels_of(const ::fit::friction::Problem& problem, const ::fit::friction::Solution& solution) {
  Panels out;
  for (std::size_t i = 0; i < problem.runs.size(); ++i) {
    const auto& [source, time, load] = problem.runs[i];
    const ::fit::FrictionRamp& fit = solution.fits[i];
    out.push_back({.x = {"time", "s"},
                   .y = {problem.slides ? "force" : "torque", unit_of_load(problem)},
                   .series = {{source.name() + ": measured", time, load},
                              {"growing", fit.line_time, fit.line, true, false, true},
                              {"sliding", fit.slide_time, fit.slide, true, false, true}}});
  }
  return out;
}

}  // namespace froude
