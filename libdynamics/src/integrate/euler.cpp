#include "dynamics/integrate/euler.hpp"

#include "explicit_step.hpp"

namespace dynamics {

SemiImplicitEuler::SemiImplicitEuler(const Model& model) : Integrator(model) { refuse_contacts(active()); }

bool SemiImplicitEuler::try_step(Workspace& workspace, double h, StepReport&) {
  const auto now = active().balance(workspace);
  if (!now) return fail("the loads are not finite or the mass is singular");
  const Eigen::VectorXd v = workspace.state.velocity + h * now->acceleration;
  return arrive(model(), active(), displaced(workspace.state, h * v, v, h), workspace) ||
         fail("the loads are not finite or the mass is singular");
}

}  // namespace dynamics
