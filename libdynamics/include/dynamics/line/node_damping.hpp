#pragma once
/// \file  Damping of nodes against their velocities. (D73)
#include "dynamics/line/node_force.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::line {

/// −b_l v − b_q |v| v, or of each component −b_l v_i − b_q |v_i| v_i, which depends on the axes: Huijgen 2024, eq. 4.14
/// with its sign put right.
class NodeDamping final : public NodeForce {
 public:
  struct Coefficients {
    double linear = 0, quadratic = 0;  ///< b_l, kg/s; b_q, kg/m
    bool componentwise = false;
  };
  /// \throws hydro::InputError for a negative coefficient
  explicit NodeDamping(const Coefficients& of) : of_(of) {
    hydro::require(of.linear >= 0 && of.quadratic >= 0, "the damping of a node must not be negative");
  }
  Eigen::Vector3d force(const At& at, Derivatives* derivatives) const override {
    const Eigen::Vector3d& v = at.velocity;
    const double speed = v.norm();
    if (derivatives != nullptr) derivatives->by_velocity -= resistance(v, speed);
    if (of_.componentwise) return -of_.linear * v - of_.quadratic * v.cwiseAbs().cwiseProduct(v);
    return -(of_.linear + of_.quadratic * speed) * v;
  }

 private:
  Eigen::Matrix3d resistance(const Eigen::Vector3d& v, double speed) const {
    Eigen::Matrix3d out = of_.linear * Eigen::Matrix3d::Identity();
    if (of_.componentwise)
      out.diagonal() += 2 * of_.quadratic * v.cwiseAbs();
    else if (speed > 0)
      out += of_.quadratic * (speed * Eigen::Matrix3d::Identity() + v * v.transpose() / speed);
    return out;
  }
  Coefficients of_;
};

}  // namespace dynamics::line
