#pragma once
/// \file  Forces against the coordinate of a slider or hinge, by the coordinate and its rate, as load on both bodies.
/// (D53)
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/force_law.hpp"
#include "dynamics/joint/coordinate.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace detail {

/// Coordinate with its rate, gradient and curvature, and the velocities of both bodies; counted backwards where sign is
/// −1.
struct CoordinateMotion {
  double sign, x, rate;
  Vector12 gradient, velocity;
};

inline CoordinateMotion motion_of(const JointCoordinate& coordinate, const State& state, double sign) {
  CoordinateMotion m;
  m.sign = sign;
  const Gradient g = coordinate.gradient(state);
  m.gradient = sign * joined(g);
  m.velocity.head<6>() = state.twist(coordinate.first());
  m.velocity.tail<6>().setZero();
  if (coordinate.second()) m.velocity.tail<6>() = state.twist(*coordinate.second());
  m.x = sign * coordinate.value(state);
  m.rate = m.gradient.dot(m.velocity);
  return m;
}

/// A force T(x, ẋ) against the coordinate and its derivatives.
struct CoordinateForce {
  double force, by_x, by_rate;
};

inline void add_load(const JointCoordinate& coordinate, const CoordinateMotion& m, double force, LoadSink& out) {
  const Vector12 load = -force * m.gradient;
  out.add(coordinate.first(), load.head<6>());
  if (coordinate.second()) out.add(*coordinate.second(), load.tail<6>());
}

// F = −T(x, ẋ) ∇x, and ẋ = ∇x·v changes with q by Hᵀv, H = ∂∇x/∂q.
inline void add_jacobian(const JointCoordinate& coordinate, const CoordinateMotion& m, const State& state,
                         const CoordinateForce& law, JacobianSink& out) {
  const Matrix12 H = m.sign * coordinate.curvature(state);
  const Vector12 force_by_q = law.by_x * m.gradient + law.by_rate * H.transpose() * m.velocity;
  const Matrix12 by_q = -law.force * H - m.gradient * force_by_q.transpose();
  const Matrix12 by_v = -law.by_rate * m.gradient * m.gradient.transpose();
  out.add_pair(coordinate.first(), coordinate.second(), by_q, by_v);
}

}  // namespace detail

/// A force against the coordinate of a joint's second body seen from its first, and its opposite. The law says by x and
/// ẋ, in m, m/s, N or rad, rad/s, N m: law.at(x, ẋ) has the members `force`, `by_x`, `by_rate`, `stored` and
/// `dissipated` of SpringDamperForce, and may have `supplied`, W.
template <class Law>
struct OnCoordinate {
  JointCoordinate coordinate;
  Law law;
  double sign = 1;        ///< −1 where the law counts the coordinate the other way
  std::string name = {};  ///< of the joint
};

/// What a kind of force along coordinates is called.
struct CoordinateWords {
  std::string effect;  ///< "pto", of which signals are called too: "hinge.pto_moment"
  std::string method;  ///< how it is computed
  std::string thing;   ///< "the power take-off"
};

/// All forces of one kind of law.
template <class Law>
class CoordinateForceKind : public ForceKind {
 public:
  using Element = OnCoordinate<Law>;
  /// Angles of hinges must be counted: see JointCoordinate.
  CoordinateForceKind(std::vector<Element> elements, CoordinateWords words)
      : elements_(std::move(elements)), words_(std::move(words)) {
    for (const Element& e : elements_)
      hydro::ensure(e.coordinate.is_continuous(),
                    "a force on a hinge whose turns are not counted: it would jump at ±π");
  }
  std::string effect() const override { return words_.effect; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return words_.method; }
  bool linear_at_rest() const override { return true; }
  void couple(BlockPattern& pattern) const override {
    for (const Element& e : elements_)
      if (e.coordinate.second()) pattern.couple(e.coordinate.first(), *e.coordinate.second());
  }
  void add_load(const Instant& now, LoadSink& out) const override {
    for (const Element& e : elements_) {
      const auto m = detail::motion_of(e.coordinate, now.state, e.sign);
      detail::add_load(e.coordinate, m, e.law.at(m.x, m.rate).force, out);
    }
  }
  void add_jacobian(const Instant& now, JacobianSink& out) const override {
    for (const Element& e : elements_) {
      const auto m = detail::motion_of(e.coordinate, now.state, e.sign);
      const auto law = e.law.at(m.x, m.rate);
      detail::add_jacobian(e.coordinate, m, now.state, {law.force, law.by_x, law.by_rate}, out);
    }
  }
  EnergyFlow energy(const Instant& now) const override {
    EnergyFlow flow;
    for (const Element& e : elements_) {
      const auto m = detail::motion_of(e.coordinate, now.state, e.sign);
      const auto law = e.law.at(m.x, m.rate);
      flow.stored += law.stored;
      flow.dissipated += law.dissipated;
      if constexpr (requires { law.supplied; }) flow.supplied += law.supplied;
    }
    return flow;
  }
  std::unique_ptr<const ForceKind> stiffer_than_at(const State& state) const override {
    std::vector<OnCoordinate<PtoLaw>> gains;
    if constexpr (requires(const Law& law) { law.stiffest(); })
      for (const Element& e : elements_) {
        const double x = detail::motion_of(e.coordinate, state, e.sign).x,
                     more = e.law.stiffest() - e.law.at(x, 0).by_x;
        const PtoLaw gain{.line = {.stiffness = more}, .preload = -more * x, .lower = {}, .upper = {}};
        if (more > 0) gains.push_back({e.coordinate, gain, e.sign, e.name});
      }
    return gains.empty() ? nullptr : std::make_unique<CoordinateForceKind<PtoLaw>>(std::move(gains), words_);
  }
  std::vector<Signal> signals() const override {
    std::vector<Signal> out;
    for (const Element& e : elements_) {
      const bool turns = e.coordinate.turns();
      out.push_back({.name = fmt::format("{}.{}_{}", e.name, words_.effect, turns ? "moment" : "force"),
                     .unit = turns ? "N m" : "N",
                     .meaning = fmt::format("{} of {} against the coordinate of {}", turns ? "moment" : "force",
                                            words_.thing, e.name),
                     .value = [e](const Reading& r) { return at(e, r.state).force; },
                     .variation = [e](const Still& still) { return variation(e, still.state); }});
      out.push_back({.name = fmt::format("{}.{}_power", e.name, words_.effect),
                     .unit = "W",
                     .meaning = fmt::format("power that {} takes from {}, springs included", words_.thing, e.name),
                     .value =
                         [e](const Reading& r) {
                           const detail::CoordinateMotion m = detail::motion_of(e.coordinate, r.state, e.sign);
                           return e.law.at(m.x, m.rate).force * m.rate;
                         },
                     .no_variation = "power is of second order in the motions"});
    }
    return out;
  }

 private:
  static auto at(const Element& e, const State& state) {
    const detail::CoordinateMotion m = detail::motion_of(e.coordinate, state, e.sign);
    return e.law.at(m.x, m.rate);
  }
  /// How the force against the coordinate varies where the joint is still.
  static Variation variation(const Element& e, const State& still) {
    const detail::CoordinateMotion m = detail::motion_of(e.coordinate, still, e.sign);
    const auto law = e.law.at(m.x, m.rate);
    return variation_of_two(e.coordinate.first(), e.coordinate.second(), law.by_x * m.gradient.transpose(),
                            law.by_rate * m.gradient.transpose());
  }

  std::vector<Element> elements_;
  CoordinateWords words_;
};

}  // namespace dynamics
