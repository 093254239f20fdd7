#include "explicit_step.hpp"

#include "dynamics/joint/assemble.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

void refuse_contacts(const ActiveSet& active) {
  if (active.contact() == nullptr) return;
  throw hydro::InputError("this integrator has no contacts", {}, "take generalized_alpha or implicit_euler");
}

bool arrive(const Model& model, const ActiveSet& active, State end, Workspace& workspace) {
  const std::vector<bool> all_move(model.bodies().size(), false);
  close_joints(model, all_move, end);
  close_joint_velocities(model, all_move, end);
  std::swap(workspace.state, end);
  if (active.solve_accelerations(workspace)) return true;
  std::swap(workspace.state, end);
  return false;
}

}  // namespace dynamics
