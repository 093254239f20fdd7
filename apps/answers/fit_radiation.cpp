#include "answers/fit_kinds.hpp"

namespace froude {
namespace {

/// Points with their intervals, and the curve of the poles.
plot::Panel panel_of(const ::fit::radiation::Solution& solution, bool damping, const char* unit, double confidence) {
  std::vector<double> omega;
  std::vector<const ::fit::Coefficient*> told;
  for (const auto& [source, point] : solution.points) {
    omega.push_back(point.omega);
    told.push_back(damping ? &point.damping : &point.added_mass);
  }
  plot::Panel panel{.x = {"frequency", "rad/s"},
                    .y = {damping ? "damping" : "added mass", unit},
                    .series = with_bars("measured", confidence, omega, told)};
  const auto& memory = solution.memory;
  if (!memory || !memory->refused.empty()) return panel;
  plot::Series curve{"poles", {}, {}, true, false, true};
  for (int k = 1; k <= 200; ++k) {
    const double at = 1.2 * omega.back() * k / 200;  // points are in the order of their frequencies
    const auto value = memory->poles.model.transform(at)(0, 0);
    curve.x.push_back(at);
    curve.y.push_back(damping ? value.real() : memory->poles.A_inf(0, 0) + value.imag() / at);
  }
  panel.series.push_back(curve);
  return panel;
}

}  // namespace

::fit::radiation::Problem problem_of(const scene::FitScene& scene, const scene::RadiationModel& model) {
  ::fit::radiation::Problem out{
      .turns = scene.turns(), .runs = {}, .body = model.body, .options = {.confidence = scene.confidence}};
  for (const auto& [source, row] : runs_of(scene)) {
    const Measurements measured(scene, source.file);
    out.runs.push_back({source, measured.time(), measured.motion(), measured.load()});
  }
  return out;
}

std::string table_of(const ::fit::radiation::Problem& problem, const ::fit::radiation::Solution& solution) {
  const auto unit = ::fit::radiation::units_of(problem.turns);
  std::string out = fmt::format(
      "file,omega [rad/s],amplitude [{0}],added_mass [{1}],added_mass_low [{1}],added_mass_high [{1}],damping "
      "[{2}],damping_low [{2}],damping_high [{2}]\n",
      unit.motion, unit.added_mass, unit.damping);
  for (const auto& [source, p] : solution.points)
    out += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", source.name(), p.omega,
                       p.amplitude, *p.added_mass.value, p.added_mass.interval.low, p.added_mass.interval.high,
                       *p.damping.value, p.damping.interval.low, p.damping.interval.high);
  return out;
}

Panels panels_of(const ::fit::radiation::Problem& problem, const ::fit::radiation::Solution& solution) {
  const auto unit = ::fit::radiation::units_of(problem.turns);
  return {panel_of(solution, false, unit.added_mass, problem.options.confidence),
          panel_of(solution, true, unit.damping, problem.options.confidence)};
}

}  // namespace froude
