#include "dynamics/force/friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/force/coordinate_force.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

FrictionKind::FrictionKind(std::vector<Friction> elements) : elements_(std::move(elements)) {
  for (const Friction& f : elements_) {
    if (f.hold) {
      hydro::require(*f.hold > 0, "latch of joint \"{}\": the time it holds must be positive", f.name);
      continue;
    }
    hydro::require(std::isfinite(f.breakaway) && f.sliding > 0,
                   "friction of joint \"{}\": both levels must be positive", f.name);
    hydro::require(f.breakaway >= f.sliding, "friction of joint \"{}\": the static level is below the dynamic one",
                   f.name);
    hydro::require(!f.stribeck || *f.stribeck > 0, "friction of joint \"{}\": the Stribeck rate must be positive",
                   f.name);
  }
}

// (D32)
double Friction::level(double rate) const {
  if (!stribeck) return sliding;
  const double r = rate / *stribeck;
  return sliding + (breakaway - sliding) * std::exp(-r * r);
}

double Friction::slope(double rate) const {
  return stribeck ? -2 * rate / (*stribeck * *stribeck) * (level(rate) - sliding) : 0;
}

std::string FrictionKind::effect() const {
  const bool latches = std::all_of(elements_.begin(), elements_.end(), [](const Friction& f) { return f.hold; });
  return latches ? "latch" : "friction";
}

double FrictionKind::utilisation(std::size_t element, double load, const FrictionMemory& memory, double time) const {
  const Friction& f = elements_[element];
  return f.hold ? (time - memory.since[element]) / *f.hold : std::abs(load) / f.breakaway;
}

void FrictionKind::couple(BlockPattern& pattern) const {
  for (const Friction& f : elements_)
    if (f.coordinate.second()) pattern.couple(f.coordinate.first(), *f.coordinate.second());
}

std::unique_ptr<Memory> FrictionKind::make_memory(const State&) const {
  return std::make_unique<FrictionMemory>(elements_.size());
}

// d T against the coordinate of both bodies (D19).
void FrictionKind::add_load(const Instant& now, LoadSink& out) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const Friction& f = elements_[i];
    const auto m = detail::motion_of(f.coordinate, now.state, 1);
    detail::add_load(f.coordinate, m, memory.direction[i] * f.level(m.rate), out);
  }
}

void FrictionKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const Friction& f = elements_[i];
    const auto m = detail::motion_of(f.coordinate, now.state, 1);
    const double d = memory.direction[i];
    detail::add_jacobian(f.coordinate, m, now.state, {d * f.level(m.rate), 0, d * f.slope(m.rate)}, out);
  }
}

EnergyFlow FrictionKind::energy(const Instant& now) const {
  const auto& memory = static_cast<const FrictionMemory&>(*now.memory);
  EnergyFlow flow;
  double done = 0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const double rate = elements_[i].coordinate.rate(now.state);
    flow.dissipated += memory.direction[i] * elements_[i].level(rate) * rate;
    done += memory.work[i];
  }
  flow.dissipated_so_far = done;
  return flow;
}

double FrictionKind::load(std::size_t element, const State& state, const Memory* memory,
                          const Eigen::VectorXd& multipliers, Eigen::Index joints) const {
  const auto& direction = static_cast<const FrictionMemory*>(memory)->direction;
  const Friction& f = elements_[element];
  if (direction[element] != 0) return -direction[element] * f.level(f.coordinate.rate(state));
  return -multipliers[joints +
                      std::count(direction.begin(), direction.begin() + static_cast<std::ptrdiff_t>(element), 0)];
}

std::vector<Signal> FrictionKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Friction& f = elements_[i];
    const char* what = f.hold ? "latch" : "friction";
    out.push_back({.name = fmt::format("{}.{}", f.name, what),
                   .unit = f.coordinate.turns() ? "N m" : "N",
                   .meaning = fmt::format("load of the {} of {} on its second body along the axis", what, f.name),
                   .value =
                       [this, i](const Reading& r) {
                         return elements_[i].sign * load(i, r.state, r.memory, r.multipliers, r.of_joints);
                       },
                   .no_variation = "friction and latches are left out of small motions: their joints move freely"});
  }
  return out;
}

void FrictionKind::note_work(const State& before, const State& after, FrictionMemory& memory) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (memory.direction[i] == 0) continue;
    const JointCoordinate& s = elements_[i].coordinate;
    double way = s.value(after) - s.value(before);
    if (s.turns()) way = std::remainder(way, 2 * std::numbers::pi);
    // Exact where the level is constant.
    const double level = (elements_[i].level(s.rate(before)) + elements_[i].level(s.rate(after))) / 2;
    memory.work[i] += memory.direction[i] * level * way;
  }
}

}  // namespace dynamics
