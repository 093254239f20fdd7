#include "dynamics/model/assemble.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

#include "dynamics/joint/coordinate.hpp"
#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

/// The smallest x, in the metric of the bodies' masses, with G x = −open and nothing of the bodies that are `held`.
Eigen::VectorXd smallest_closing(const Model& model, const std::vector<bool>& held, const State& state,
                                 const Eigen::VectorXd& open) {
  const JointSet& joints = model.joints();
  const auto G = joints.gradients(state);
  Eigen::VectorXd root = model.dry_mass_at_rest().diagonal().cwiseSqrt().cwiseInverse();
  for (std::size_t b = 0; b < held.size(); ++b)
    if (held[b]) root.segment<6>(6 * static_cast<Eigen::Index>(b)).setZero();
  const Eigen::MatrixXd scaled = joints.dense(G) * root.asDiagonal();
  return root.cwiseProduct(scaled.completeOrthogonalDecomposition().solve(-open));
}

}  // namespace

void close_joints(const Model& model, const std::vector<bool>& placed, State& state) {
  constexpr int steps = 50;  // quadratic once near; far away each step takes a part of a turn
  double extent = 1;         // m
  for (const Pose& pose : state.pose) extent = std::max(extent, pose.centre.cwiseAbs().maxCoeff());
  for (int i = 0; i < steps && model.joints().count() > 0; ++i) {
    const Eigen::VectorXd open = model.joints().values(state);
    if (open.cwiseAbs().maxCoeff() < 1e-14 * extent) return;
    const Eigen::VectorXd x = smallest_closing(model, placed, state, open);
    for (std::size_t b = 0; b < state.pose.size(); ++b) {
      const auto row = 6 * static_cast<Eigen::Index>(b);
      state.pose[b].centre += x.segment<3>(row);
      state.pose[b].attitude = (rotation_exp(x.segment<3>(row + 3)) * state.pose[b].attitude).normalized();
    }
  }
}

void close_joint_velocities(const Model& model, const std::vector<bool>& given, State& state) {
  if (model.joints().count() == 0) return;
  const Eigen::VectorXd apart = model.joints().times(model.joints().gradients(state), state.velocity) -
                                model.joints().prescribed_rates(state.time);
  if (apart.cwiseAbs().maxCoeff() > 0) state.velocity += smallest_closing(model, given, state, apart);
}

namespace {

constexpr double digits = 1e-6;  // six significant ones of a place, an angle or a speed are not taken for a mistake

/// The farthest that a constraint on places lies from the centres of its bodies, m.
double reach(const ConstraintLaw& what) {
  const auto* point = std::get_if<PointConstraint>(&what);
  return point ? std::max(point->first_arm.norm(), point->second_arm.norm()) : 0;
}

bool is_of_angle(const ConstraintLaw& what) {
  if (const auto* prescribed = std::get_if<PrescribedConstraint>(&what)) return prescribed->coordinate->turns();
  return std::holds_alternative<AxesConstraint>(what);
}

/// `off` and what is allowed of it, one for each constraint.
std::optional<Misfit> worst(const JointSet& joints, const Eigen::VectorXd& off, const Eigen::VectorXd& allowed) {
  if (joints.count() == 0) return std::nullopt;
  Eigen::Index i = 0;
  off.cwiseAbs().cwiseQuotient(allowed).maxCoeff(&i);
  const Constraint& c = joints.constraints()[static_cast<std::size_t>(i)];
  return Misfit{c.joint, std::abs(off[i]), is_of_angle(c.what), allowed[i]};
}

}  // namespace

std::optional<Misfit> worst_misfit(const Model& model, const State& state) {
  const JointSet& joints = model.joints();
  Eigen::VectorXd allowed(joints.count());
  for (Eigen::Index i = 0; i < joints.count(); ++i)
    allowed[i] = digits * std::max(1.0, reach(joints.constraints()[static_cast<std::size_t>(i)].what));
  return worst(joints, joints.values(state), allowed);
}

std::optional<Misfit> worst_misfit_of_velocities(const Model& model, const State& state) {
  constexpr double least = 1e-12;  // per second: bodies that stand still leave no speed to compare with
  const JointSet& joints = model.joints();
  const auto G = joints.gradients(state);
  const Eigen::VectorXd prescribed = joints.prescribed_rates(state.time);
  const Eigen::VectorXd speeds = joints.dense(G).cwiseAbs() * state.velocity.cwiseAbs() + prescribed.cwiseAbs();
  return worst(joints, joints.times(G, state.velocity) - prescribed, (digits * speeds).cwiseMax(least));
}

}  // namespace dynamics
