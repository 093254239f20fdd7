#include "explicit_step.hpp"

#include <Eigen/LU>

#include "dynamics/model/assemble.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

void refuse_contacts(const ActiveSet& active) {
  if (active.contact() == nullptr) return;
  throw hydro::InputError("this integrator has no contacts", {}, "take generalized_alpha or implicit_euler");
}

Eigen::VectorXd displacement_rate(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) {
  Eigen::VectorXd out;
  find_displacement_rate(displacement, velocity, out);
  return out;
}

void find_displacement_rate(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                            Eigen::VectorXd& out) {
  out = velocity;
  for (Eigen::Index row = 3; row < out.size(); row += 6)
    out.segment<3>(row) = left_jacobian(displacement.segment<3>(row)).inverse() * velocity.segment<3>(row);
}

bool arrive(const Model& model, const ActiveSet& active, State& end, Workspace& workspace) {
  if (model.joints().count() > 0) {
    const std::vector<bool> all_move(model.bodies().size(), false);
    close_joints(model, all_move, end);
    close_joint_velocities(model, all_move, end);
  }
  std::swap(workspace.state, end);
  if (active.solve_accelerations(workspace)) return true;
  std::swap(workspace.state, end);
  return false;
}

}  // namespace dynamics
