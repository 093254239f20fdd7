#pragma once
/// \file  A force at a point of a body by how the point moves: of such a kind only the law is left to be written.
#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "dynamics/state/point.hpp"

namespace dynamics {

/// The law says by the velocity v of the point, m/s, global axes: law.force(v), N, and law.by_velocity(v), (3, 3).
template <class Law>
struct AtPoint {
  PointOnBody point;
  Law law;
  std::string name;  ///< of the element
};

/// What a kind of force at points is called.
struct PointForceWords {
  std::string effect;  ///< "wind"
  std::string method;  ///< how it is computed
};

/// All forces of one kind of law. With J = (1, −[r]×) of the point at r from the centre of gravity, v is J times the
/// velocity of the body, and the load Jᵀ F. What it gives to bodies is counted as supplied.
template <class Law>
class PointForceKind final : public ForceKind {
 public:
  using Element = AtPoint<Law>;
  PointForceKind(std::vector<Element> elements, PointForceWords words)
      : elements_(std::move(elements)), words_(std::move(words)) {}
  std::string effect() const override { return words_.effect; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return words_.method; }
  bool linear_at_rest() const override { return true; }

  void add_load(const Instant& now, LoadSink& out) const override {
    for (const Element& e : elements_)
      out.add(e.point.body, place_by_displacement(arm_of(e.point, now.state)).transpose() * force_of(e, now.state));
  }
  /// The arm turns with the body, and with it its moment and, where the body spins, the velocity of the point.
  void add_jacobian(const Instant& now, JacobianSink& out) const override {
    for (const Element& e : elements_) {
      const Eigen::Vector3d r = arm_of(e.point, now.state), v = velocity_of(e.point, now.state),
                            spin = now.state.twist(e.point.body).template tail<3>();
      const Eigen::Matrix<double, 3, 6> J = place_by_displacement(r);
      const Eigen::Matrix3d by_v = e.law.by_velocity(v);
      Matrix6 by_q = Matrix6::Zero();
      by_q.rightCols<3>() = -J.transpose() * by_v * cross_matrix(spin) * cross_matrix(r);
      by_q.bottomRightCorner<3, 3>() += cross_matrix(e.law.force(v)) * cross_matrix(r);
      out.add(e.point.body, e.point.body, by_q, J.transpose() * by_v * J);
    }
  }
  EnergyFlow energy(const Instant& now) const override {
    EnergyFlow flow;
    for (const Element& e : elements_) flow.supplied += force_of(e, now.state).dot(velocity_of(e.point, now.state));
    return flow;
  }
  std::vector<Signal> signals() const override {
    std::vector<Signal> out;
    for (const Element& e : elements_)
      for (int axis = 0; axis < 3; ++axis) {
        const char letter = "xyz"[axis];
        out.push_back({.name = e.name + ".force_" + letter,
                       .unit = "N",
                       .meaning = "force of " + e.name + " along " + letter,
                       .value = [e, axis](const Reading& r) { return force_of(e, r.state)[axis]; },
                       .variation = [e, axis](const Still& still) { return variation(e, axis, still.state); }});
      }
    return out;
  }

 private:
  static Eigen::Vector3d force_of(const Element& e, const State& state) {
    return e.law.force(velocity_of(e.point, state));
  }
  static Variation variation(const Element& e, int axis, const State& still) {
    const Variation::Row by_velocity =
        e.law.by_velocity(Eigen::Vector3d::Zero()).row(axis) * place_by_displacement(arm_of(e.point, still));
    return {.parts = {{.body = e.point.body, .by_velocity = by_velocity}}};
  }

  std::vector<Element> elements_;
  PointForceWords words_;
};

}  // namespace dynamics
