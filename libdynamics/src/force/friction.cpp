#include "dynamics/force/friction.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {

FrictionKind::FrictionKind(std::vector<Friction> elements) : elements_(std::move(elements)) {
  for (const Friction& f : elements_) {
    hydro::require(std::isfinite(f.breakaway) && f.sliding > 0,
                   "friction of joint \"{}\": both levels must be positive", f.name);
    hydro::require(f.breakaway >= f.sliding, "friction of joint \"{}\": the static level is below the dynamic one",
                   f.name);
  }
}

void FrictionKind::couple(BlockPattern& pattern) const {
  for (const Friction& f : elements_)
    if (f.travel.second()) pattern.couple(f.travel.first(), *f.travel.second());
}

std::unique_ptr<Memory> FrictionKind::make_memory(const State&) const {
  return std::make_unique<FrictionMemory>(elements_.size());
}

// −d T ∂s on both bodies (D19).
void FrictionKind::add_load(const Instant& now, LoadSink& out) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const Travel& s = elements_[i].travel;
    const Gradient g = s.gradient(now.state);
    const double load = -memory.direction[i] * elements_[i].sliding;
    out.add(s.first(), load * g.first);
    if (s.second()) out.add(*s.second(), load * g.second);
  }
}

void FrictionKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const Travel& s = elements_[i].travel;
    const Matrix12 H = -memory.direction[i] * elements_[i].sliding * s.curvature(now.state);
    const Matrix6 none = Matrix6::Zero();
    out.add(s.first(), s.first(), H.topLeftCorner<6, 6>(), none);
    if (!s.second()) continue;
    out.add(s.first(), *s.second(), H.topRightCorner<6, 6>(), none);
    out.add(*s.second(), s.first(), H.bottomLeftCorner<6, 6>(), none);
    out.add(*s.second(), *s.second(), H.bottomRightCorner<6, 6>(), none);
  }
}

EnergyFlow FrictionKind::energy(const Instant& now) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  EnergyFlow flow;
  double done = 0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    flow.dissipated += memory.direction[i] * elements_[i].sliding * elements_[i].travel.rate(now.state);
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
    const Travel& s = elements_[i].travel;
    double way = s.value(after) - s.value(before);
    if (s.turns()) way = std::remainder(way, 2 * 3.14159265358979323846);
    memory.work[i] += memory.direction[i] * elements_[i].sliding * way;  // the level is constant, so this is exact
  }
}

}  // namespace dynamics
