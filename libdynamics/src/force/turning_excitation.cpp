#include "dynamics/force/turning_excitation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

// Where a state has no memory, as when a model is looked at, the body's yaw itself counts.
double slow_yaw(const TurningExcitation& e, std::size_t i, const Instant& now) {
  if (now.memory != nullptr) return static_cast<const SlowYaw*>(now.memory)->yaw[i];
  return yaw_of(now.state.pose[static_cast<std::size_t>(e.body)]);
}

Vector6 load_of(const TurningExcitation& e, double yaw, double t) {
  const double place = (yaw - e.first_yaw) / e.spacing;
  const int k = std::clamp(static_cast<int>(std::floor(place)), 0, e.yaws - 2);
  const double share = place - k;
  Vector6 out;
  e.load.use_at(t, [&](const auto& all) {
    out = (1 - share) * all.template segment<6>(6 * k) + share * all.template segment<6>(6 * (k + 1));
  });
  return out;
}

}  // namespace

double yaw_of(const Pose& pose) {
  const Eigen::Vector3d ahead = pose.attitude * Eigen::Vector3d::UnitX();
  return nearest_turn(std::atan2(ahead.y(), ahead.x()), pose.counted.z());
}

SlowYaw::SlowYaw(const std::vector<TurningExcitation>& elements, const State& start)
    : elements_(elements), time_(start.time) {
  for (const auto& e : elements) yaw.push_back(yaw_of(start.pose[static_cast<std::size_t>(e.body)]));
  check();
}

void SlowYaw::accept(const State& state) {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const auto& e = elements_[i];
    const double now = yaw_of(state.pose[static_cast<std::size_t>(e.body)]);
    yaw[i] += -std::expm1(-(state.time - time_) / e.time_constant) * (now - yaw[i]);
  }
  time_ = state.time;
  check();
}

void SlowYaw::check() const {
  constexpr double degree = std::numbers::pi / 180;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const auto& e = elements_[i];
    const double last_yaw = e.first_yaw + e.spacing * (e.yaws - 1);
    if (yaw[i] < e.first_yaw - 1e-9 || yaw[i] > last_yaw + 1e-9)
      throw hydro::NumericsError(
          fmt::format("{} has turned by {:.4g} deg at {:.6g} s, and its excitation is given from {:.4g} to {:.4g} deg",
                      e.name, yaw[i] / degree, time_, e.first_yaw / degree, last_yaw / degree));
  }
}

std::string TurningExcitationKind::method() const {
  return fmt::format("sum over {} wave components at {} yaws, straight between them, by the slow yaw",
                     elements_.front().load.components(), elements_.front().yaws);
}

void TurningExcitationKind::add_load(const Instant& now, LoadSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i)
    out.add(elements_[i].body, load_of(elements_[i], slow_yaw(elements_[i], i, now), now.state.time));
}

EnergyFlow TurningExcitationKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const auto& e = elements_[i];
    flow.supplied += load_of(e, slow_yaw(e, i, now), now.state.time).dot(now.state.twist(e.body));
  }
  return flow;
}

}  // namespace dynamics
