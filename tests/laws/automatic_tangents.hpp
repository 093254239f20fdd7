#pragma once
/// \file  L5 without differences: a law written a second time from its formula, in numbers that carry their
/// derivatives.
#include <Eigen/Core>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <vector>

#include "laws/force_kind_laws.hpp"

namespace laws {

/// A value with its derivatives by the displacements (12) and then the velocities (12) of two bodies.
using Jet = ceres::Jet<double, 24>;
using JetVector = Eigen::Matrix<Jet, 3, 1>;
using JetMatrix = Eigen::Matrix<Jet, 3, 3>;

inline JetVector jets(const Eigen::Vector3d& v) { return v.cast<Jet>(); }
inline Jet length(const JetVector& v) { return sqrt(v.dot(v)); }

/// A body's pose and motion; displacements are translations and small global rotations.
struct JetBody {
  JetVector centre, velocity, omega;
  JetMatrix attitude;

  JetVector arm(const Eigen::Vector3d& in_body) const { return attitude * in_body.cast<Jet>(); }
  JetVector point(const Eigen::Vector3d& in_body) const { return centre + arm(in_body); }
  JetVector velocity_at(const JetVector& arm) const { return velocity + omega.cross(arm); }
};

/// Body `b` of the state. R(θ) = (1 + [θ]×)R to first order, which is all that a first derivative asks for.
inline JetBody jet_body(const State& state, int b) {
  JetBody out;
  const auto& pose = state.pose[static_cast<std::size_t>(b)];
  const Eigen::Matrix3d R = pose.attitude.toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    out.centre[i] = Jet(pose.centre[i], 6 * b + i);
    out.velocity[i] = Jet(state.velocity[6 * b + i], 12 + 6 * b + i);
    out.omega[i] = Jet(state.velocity[6 * b + 3 + i], 12 + 6 * b + 3 + i);
    for (int j = 0; j < 3; ++j) out.attitude(i, j) = Jet(R(i, j));
  }
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix3d turned = dynamics::cross_matrix(Eigen::Vector3d::Unit(k)) * R;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) out.attitude(i, j).v[6 * b + 3 + k] = turned(i, j);
  }
  return out;
}

/// Loads on two bodies: force, and moment about the centre.
struct JetLoads {
  Eigen::Matrix<Jet, 12, 1> all = Eigen::Matrix<Jet, 12, 1>::Constant(Jet(0));

  void moment(int body, const JetVector& m) { all.segment<3>(6 * body + 3) += m; }
  /// A force that acts an arm (global axes) away from the centre.
  void force(int body, const JetVector& arm, const JetVector& f) {
    all.segment<3>(6 * body) += f;
    moment(body, arm.cross(f));
  }
};

struct TangentTolerance {
  double load = 1e-12;     ///< relative to the largest of the load: round-off; 2e-14 is seen
  double tangent = 1e-11;  ///< relative to the largest of the derivatives: 2e-15 is seen, 5e-13 of friction
};

/// Load and both Jacobians of `kind` against those of `law`(bodies a and b, time), on two bodies.
template <class Law>
void expect_automatic_tangents(const ForceKind& kind, const State& state, dynamics::Memory* memory, Law law,
                               const TangentTolerance& tolerance = {}) {
  const JetLoads expected = law(jet_body(state, 0), jet_body(state, 1), state.time);
  Eigen::VectorXd F(12);
  Eigen::MatrixXd by_q(12, 12), by_v(12, 12);
  for (Eigen::Index i = 0; i < 12; ++i) {
    F[i] = expected.all[i].a;
    by_q.row(i) = expected.all[i].v.head<12>();
    by_v.row(i) = expected.all[i].v.tail<12>();
  }
  ASSERT_TRUE(F.allFinite() && by_q.allFinite() && by_v.allFinite());
  const auto apart = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); };
  EXPECT_LE(apart(load(kind, state, memory), F), tolerance.load * F.cwiseAbs().maxCoeff()) << "load";
  EXPECT_LE(apart(jacobian(kind, state, memory, 1, 0), by_q), tolerance.tangent * by_q.cwiseAbs().maxCoeff())
      << "by displacement";
  EXPECT_LE(apart(jacobian(kind, state, memory, 0, 1), by_v), tolerance.tangent * by_v.cwiseAbs().maxCoeff())
      << "by velocity";
}

/// At several states, bodies turned by half a radian and by one and a half.
template <class Law>
void expect_automatic_tangents_everywhere(const ForceKind& kind, const std::vector<dynamics::RigidBody>& bodies,
                                          Law law, const TangentTolerance& tolerance = {}) {
  const auto memory = kind.make_memory(dynamics::rest_state(bodies));
  for (const double angle : {0.3, 0.9})  // of each component: the length is 1.7 times as much
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(testing::Message() << kind.effect() << ", angle " << angle << ", seed " << seed);
      expect_automatic_tangents(kind, support::random_state(bodies, seed, angle), memory.get(), law, tolerance);
    }
}

}  // namespace laws
