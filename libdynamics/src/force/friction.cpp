#include "dynamics/force/friction.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/joint/conditions.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

FrictionKind::FrictionKind(JointSet joints, std::vector<Friction> elements)
    : joints_(std::move(joints)), elements_(std::move(elements)) {
  for (const Friction& f : elements_) {
    const std::string& name = joints_.joints()[static_cast<std::size_t>(f.joint)].name;
    hydro::require(std::isfinite(f.breakaway) && f.sliding > 0,
                   "friction of joint \"{}\": both levels must be positive", name);
    hydro::require(f.breakaway >= f.sliding, "friction of joint \"{}\": the static level is below the dynamic one",
                   name);
  }
}

std::unique_ptr<Memory> FrictionKind::make_memory(const State&) const {
  return std::make_unique<FrictionMemory>(elements_.size());
}

double FrictionKind::rate(std::size_t element, const State& state) const {
  const int j = elements_[element].joint;
  const Joint& joint = joints_.joints()[static_cast<std::size_t>(j)];
  const Gradient W = joints_.travel_gradient(j, state);
  return W.first.dot(state.twist(joint.first)) + (joint.second ? W.second.dot(state.twist(*joint.second)) : 0);
}

Condition FrictionKind::condition(std::size_t element, const State& state) const {
  return joints_.holding(elements_[element].joint, state);
}

// −s T ∂(travel) on both bodies (D19).
void FrictionKind::add_load(const Instant& now, LoadSink& out) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const Joint& joint = joints_.joints()[static_cast<std::size_t>(elements_[i].joint)];
    const Gradient W = joints_.travel_gradient(elements_[i].joint, now.state);
    const double load = -memory.direction[i] * elements_[i].sliding;
    out.add(joint.first, load * W.first);
    if (joint.second) out.add(*joint.second, load * W.second);
  }
}

void FrictionKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const Joint& joint = joints_.joints()[static_cast<std::size_t>(elements_[i].joint)];
    const Matrix12 H =
        -memory.direction[i] * elements_[i].sliding * joints_.travel_curvature(elements_[i].joint, now.state);
    const Matrix6 none = Matrix6::Zero();
    out.add(joint.first, joint.first, H.topLeftCorner<6, 6>(), none);
    if (!joint.second) continue;
    out.add(joint.first, *joint.second, H.topRightCorner<6, 6>(), none);
    out.add(*joint.second, joint.first, H.bottomLeftCorner<6, 6>(), none);
    out.add(*joint.second, *joint.second, H.bottomRightCorner<6, 6>(), none);
  }
}

EnergyFlow FrictionKind::energy(const Instant& now) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  EnergyFlow flow;
  double done = 0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    flow.dissipated += memory.direction[i] * elements_[i].sliding * rate(i, now.state);
    done += memory.work[i];
  }
  flow.dissipated_so_far = done;
  return flow;
}

double FrictionKind::load(std::size_t element, const Memory* memory, const Eigen::VectorXd& multipliers,
                          Eigen::Index joints) const {
  const auto& direction = static_cast<const FrictionMemory*>(memory)->direction;
  if (direction[element] != 0) return -direction[element] * elements_[element].sliding;
  return -multipliers[joints +
                      std::count(direction.begin(), direction.begin() + static_cast<std::ptrdiff_t>(element), 0)];
}

void FrictionKind::note_work(const State& before, const State& after, FrictionMemory& memory) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const bool turns = joints_.joints()[static_cast<std::size_t>(elements_[i].joint)].kind == JointKind::hinge;
    double way = travel(i, after) - travel(i, before);
    if (turns) way = std::remainder(way, 2 * 3.14159265358979323846);
    memory.work[i] += memory.direction[i] * elements_[i].sliding * way;  // the level is constant, so this is exact
  }
}

}  // namespace dynamics
