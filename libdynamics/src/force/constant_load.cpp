#include "dynamics/force/constant_load.hpp"

#include <algorithm>
#include <limits>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

Vector6 load_of(const ConstantLoad& e, const State& state) {
  Vector6 load;
  load << e.force, e.moment + arm_of(e.at, state).cross(e.force);
  return e.history.share(state.time) * load;
}

}  // namespace

bool ConstantLoadKind::linear_at_rest() const {
  return std::all_of(elements_.begin(), elements_.end(), [](const auto& e) { return e.history.is_constant(); });
}

std::string ConstantLoadKind::method() const {
  return linear_at_rest() ? "constant force and moment" : "force and moment that rise and fall straight";
}

double ConstantLoadKind::shortest_ramp() const {
  double out = std::numeric_limits<double>::infinity();
  for (const ConstantLoad& e : elements_)
    for (const double ramp : {e.history.ramp_up, e.history.ramp_down})
      if (ramp > 0) out = std::min(out, ramp);
  return out;
}

void ConstantLoadKind::add_load(const Instant& now, LoadSink& out) const {
  for (const ConstantLoad& e : elements_) out.add(e.at.body, load_of(e, now.state));
}

void ConstantLoadKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const ConstantLoad& e : elements_) {
    Matrix6 by_q = Matrix6::Zero();
    by_q.bottomRightCorner<3, 3>() =
        e.history.share(now.state.time) * cross_matrix(e.force) * cross_matrix(arm_of(e.at, now.state));
    out.add(e.at.body, e.at.body, by_q, Matrix6::Zero());
  }
}

EnergyFlow ConstantLoadKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const ConstantLoad& e : elements_) flow.supplied += load_of(e, now.state).dot(now.state.twist(e.at.body));
  return flow;
}

}  // namespace dynamics
