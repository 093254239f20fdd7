#include "dynamics/joint/assemble.hpp"

#include <Eigen/QR>

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
  for (int i = 0; i < steps && model.joints().count() > 0; ++i) {
    const Eigen::VectorXd open = model.joints().values(state);
    if (open.cwiseAbs().maxCoeff() < 1e-14) return;
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
  const Eigen::VectorXd apart =
      model.joints().times(model.joints().gradients(state), state.velocity) - model.joints().lead_rates(state.time);
  if (apart.cwiseAbs().maxCoeff() > 0) state.velocity += smallest_closing(model, given, state, apart);
}

}  // namespace dynamics
