#include "dynamics/integrate/euler.hpp"

#include "explicit_step.hpp"

namespace dynamics {

SemiImplicitEuler::SemiImplicitEuler(const Model& model) : Integrator(model) { refuse_contacts(active()); }

bool SemiImplicitEuler::try_step(Workspace& workspace, double h, StepReport&) {
  constexpr const char* why = "the loads are not finite or the mass is singular";
  if (!active().find_balance(workspace, acceleration_, multipliers_)) return fail(why);
  velocity_ = workspace.state.velocity + h * acceleration_;
  move_ = h * velocity_;
  displace(workspace.state, move_, velocity_, h, end_);
  return arrive(model(), active(), end_, workspace) || fail(why);
}

}  // namespace dynamics
