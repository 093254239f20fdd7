#include "answers/periodic_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "answers/stability_check.hpp"
#include "compile/waves.hpp"

namespace froude {

using namespace dynamics::frequency;

PeriodicAnswers::PeriodicAnswers(const scene::Scene& scene, const compile::Prepared& prepared)
    : scene_(scene), prepared_(prepared) {
  options_.accuracy = scene.accuracy / 10;  // of the motion: harmonics above the last go on falling
}

std::shared_ptr<PeriodicScene> PeriodicAnswers::at(double period, double height) const {
  if (last_.system == nullptr || last_.period != period || last_.height != height)
    last_ = {period, height, std::make_shared<PeriodicScene>(in_waves(scene_, period, height), prepared_, period)};
  return last_.system;
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

PeriodicAnswers::Arrival PeriodicAnswers::reached(double period, const MotionAt& before, const MotionAt& from,
                                                  double height) const {
  using enum StabilityMap::Reached;
  const Family family = by_height(period);
  auto [end, joined] = carry(family, before, from, height, options_);
  if (joined) return {std::move(end), grown};
  // Where motions grow no further they turn back; what comes after is where a run goes.
  // The fold that follows may lie below where the branch comes from, down to waves of next to no height.
  FollowedBranch branch = follow(family, from.parameter, height, from.motion,
                                 {.before = from.parameter - lowest_height(), .balance = options_});
  if (branch.end.empty()) {
    const bool turned =
        std::any_of(branch.points.begin(), branch.points.end(), [](const auto& p) { return !p.forwards; });
    return {{.motion = std::move(branch.points.back().motion), .found = true, .why = {}}, turned ? round_folds : grown};
  }
  if (!end.found) end.why = branch.end;
  return {std::move(end), end.found ? jumped : not_found};
}

MotionAt PeriodicAnswers::still(double period) const { return {0, at_rest(*at(period, lowest_height()))}; }

PeriodicAnswers::Arrival PeriodicAnswers::from_rest(double period, double height) const {
  const auto system = at(period, height / 8);
  Balance low = balance(*system, at_rest(*system));
  if (!low.found) return {std::move(low), StabilityMap::Reached::not_found};
  return reached(period, still(period), {height / 8, std::move(low.motion)}, height);
}

bool PeriodicAnswers::beyond_breaking(double period, double height) const {
  const scene::Scene scene = with_waves(scene_, period, height);
  return compile::is_beyond_breaking(scene, std::get<scene::RegularWave>(scene.waves->kind));
}

std::vector<Signal> PeriodicAnswers::signals() const {
  std::vector<Signal> out;
  // Of the longest and lowest waves: whatever they are, signals are the same.
  const auto system = at(scene_.stability->periods.back(), lowest_height());
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
  // Squares of signals with harmonics up to twice the motion's do not alias.
  const auto count = static_cast<int>(4 * (motion.harmonics() + 1));
  for (int i = 0; i < count; ++i) times.push_back(2 * std::numbers::pi / motion.omega * i / count);
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
  const auto period = [&](double parameter) { return branch.period.value_or(parameter); };
  const auto height = [&](double parameter) { return branch.height.value_or(parameter); };
  std::vector<double> range = out.over_periods ? ask.periods : ask.heights;
  std::erase_if(range, [&](double at) { return answers.beyond_breaking(period(at), height(at)); });
  if (range.size() < 2) {
    out.end = "waves are beyond breaking at all periods and heights of the map along it but one at most";
    return out;
  }
  const double from = range.front(), to = range.back();
  PeriodicAnswers::Arrival first = answers.from_rest(period(from), height(from));
  if (!first.end.found) {
    out.end = fmt::format("no motion is found where it begins: {}", first.end.why);
    return out;
  }
  const Family family = out.over_periods ? answers.by_period(*branch.height) : answers.by_height(*branch.period);
  FollowedBranch found = follow(family, from, to, std::move(first.end.motion),
                                {.step = 0.01,
                                 .largest_step = 0.05,
                                 .before = out.over_periods ? 0 : from - answers.lowest_height(),
                                 .balance = answers.options()});
  out.begin = first.reached;
  out.end = std::move(found.end);
  if (out.end.empty() && to < (out.over_periods ? ask.periods : ask.heights).back())
    out.end = "waves beyond are beyond breaking";
  for (const BranchPoint& p : found.points) {
    const auto system = answers.at(period(p.parameter), height(p.parameter));
    out.points.push_back({answers.told(*system, p.motion), period(p.parameter), height(p.parameter), p.forwards});
    const std::vector<double> deviations = answers.deviations(*system, p.motion);
    for (std::size_t s = 0; s < deviations.size(); ++s) out.signals[s].values.push_back(deviations[s]);
  }
  return out;
}

}  // namespace froude
