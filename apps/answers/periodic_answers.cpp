#include "answers/periodic_answers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "answers/stability_check.hpp"

namespace froude {

using namespace dynamics::frequency;

PeriodicAnswers::PeriodicAnswers(const scene::Scene& scene, const compile::Prepared& prepared)
    : scene_(scene), prepared_(prepared) {
  options_.accuracy = scene.accuracy / 10;  // of the motion: harmonics above the last go on falling
}

std::unique_ptr<PeriodicScene> PeriodicAnswers::at(double period, double height) const {
  return std::make_unique<PeriodicScene>(in_waves(scene_, period, height), prepared_, period);
}
Family PeriodicAnswers::by_height(double period) const {
  return [this, period](double height) { return at(period, height); };
}
Family PeriodicAnswers::by_period(double height) const {
  return [this, height](double period) { return at(period, height); };
}

Balance PeriodicAnswers::balance(PeriodicScene& system, PeriodicMotion start) const {
  start.omega = system.omega();
  return dynamics::frequency::balance(system, std::move(start), options_);
}

Balance PeriodicAnswers::grown(double period, double height) const {
  constexpr int steps = 8;
  Balance out;
  for (int i = 1; i <= steps; ++i) {
    const auto system = at(period, height * i / steps);
    PeriodicMotion near = i > 1 ? std::move(out.motion) : at_rest(*system);
    if (i > 1) near.coefficients *= i / (i - 1.0);
    out = balance(*system, std::move(near));
    if (!out.found) return out;
  }
  return out;
}

std::vector<Signal> PeriodicAnswers::signals() const {
  std::vector<Signal> out;
  const auto system = at(scene_.stability->periods.front(), scene_.stability->heights.front());
  for (const auto& s : signals_of_map(*scene_.stability, system->model()))
    out.push_back({s.name, s.unit, "standard deviation of " + s.meaning, {}});
  return out;
}

StabilityMap::Motion PeriodicAnswers::told(PeriodicScene& system, const PeriodicMotion& motion) const {
  const Eigen::VectorXcd mu = floquet_multipliers(system, motion);
  return {.fate = fate_of(mu),
          .multiplier = std::abs(mu[0]),
          .harmonics = static_cast<int>(motion.harmonics()),
          .motion = motion};
}

std::vector<double> PeriodicAnswers::deviations(PeriodicScene& system, const PeriodicMotion& motion) const {
  std::vector<double> times;
  for (int i = 0; i < 32; ++i) times.push_back(i / 32.0 * 2 * std::numbers::pi / motion.omega);
  const Eigen::MatrixXd values = system.values(signals_of_map(*scene_.stability, system.model()), motion, times);
  std::vector<double> out;
  for (const auto& signal : values.colwise()) out.push_back(standard_deviation(signal));
  return out;
}

StabilityMap::Branch followed(const PeriodicAnswers& answers, const scene::AskStability& ask,
                              const scene::AskStability::Branch& branch) {
  StabilityMap::Branch out{.over_periods = branch.height.has_value(),
                           .held = branch.height ? *branch.height : *branch.period,
                           .points = {},
                           .signals = answers.signals(),
                           .end = {}};
  const std::vector<double>& range = out.over_periods ? ask.periods : ask.heights;
  const double from = range.front(), to = range.back();
  const auto period = [&](double parameter) { return branch.period.value_or(parameter); };
  const auto height = [&](double parameter) { return branch.height.value_or(parameter); };
  Balance first = answers.grown(period(from), height(from));
  if (!first.found) {
    out.end = fmt::format("no motion is found where it begins: {}", first.why);
    return out;
  }
  const Family family = out.over_periods ? answers.by_period(*branch.height) : answers.by_height(*branch.period);
  FollowedBranch found = follow(family, from, to, std::move(first.motion),
                                {.step = 0.01, .largest_step = 0.05, .balance = answers.options()});
  out.end = std::move(found.end);
  for (const BranchPoint& p : found.points) {
    const auto system = answers.at(period(p.parameter), height(p.parameter));
    out.points.push_back({answers.told(*system, p.motion), period(p.parameter), height(p.parameter), p.forwards});
    const std::vector<double> deviations = answers.deviations(*system, p.motion);
    for (std::size_t s = 0; s < deviations.size(); ++s) out.signals[s].values.push_back(deviations[s]);
  }
  return out;
}

}  // namespace froude
