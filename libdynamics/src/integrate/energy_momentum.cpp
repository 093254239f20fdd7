#include "dynamics/integrate/energy_momentum.hpp"

#include "explicit_step.hpp"

namespace dynamics {
namespace {

/// The rotation by θ as Cayley has it: R − 1 = [θ]×(R + 1)/2, so that (D29) is exact.
Eigen::Quaterniond cayley(const Eigen::Vector3d& theta) {
  return Eigen::Quaterniond(1, theta.x() / 2, theta.y() / 2, theta.z() / 2).normalized();
}

State between(const State& a, const State& b) {
  State out = a;
  out.time = (a.time + b.time) / 2;
  out.velocity = (a.velocity + b.velocity) / 2;
  for (std::size_t i = 0; i < out.pose.size(); ++i) {
    out.pose[i].centre = (a.pose[i].centre + b.pose[i].centre) / 2;
    out.pose[i].attitude = a.pose[i].attitude.slerp(0.5, b.pose[i].attitude);
  }
  return out;
}

/// Means of places and of directions: what the difference of a constraint that is bilinear in both is exact with.
ConstraintEnds mean(const ConstraintEnds& a, const ConstraintEnds& b) {
  const auto between = [](const Frame& x, const Frame& y) {
    return Frame{(x.origin + y.origin) / 2, (x.axes + y.axes) / 2};
  };
  return {between(a.first, b.first), between(a.second, b.second), (a.time + b.time) / 2};
}

}  // namespace

EnergyMomentum::EnergyMomentum(const Model& model) : NewtonIntegrator(model) { refuse_contacts(active()); }

// In body axes W₁ = W₀ + h R₀ᵀα, and the body turns by h(W₀ + W₁)/2 about itself.
void EnergyMomentum::end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration,
                                 State& end) {
  const State& now = workspace.state;
  end = now;
  end.time += h;
  end.velocity += h * acceleration;
  for (std::size_t i = 0; i < now.pose.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    const Eigen::Quaterniond& R = now.pose[i].attitude;
    const Eigen::Vector3d before = R.conjugate() * now.velocity.segment<3>(row + 3);
    const Eigen::Vector3d after = R.conjugate() * end.velocity.segment<3>(row + 3);
    end.pose[i].centre += h / 2 * (now.velocity.segment<3>(row) + end.velocity.segment<3>(row));
    end.pose[i].attitude = (R * cayley(h / 2 * (before + after))).normalized();
    end.velocity.segment<3>(row + 3) = end.pose[i].attitude * after;
  }
}

void EnergyMomentum::find_loads(Workspace& workspace, double h, Trial& trial) const {
  const State& now = workspace.state;
  trial.loads_at = between(now, trial.state);
  const State& middle = *trial.loads_at;
  const Eigen::VectorXd mean_acceleration = (trial.state.velocity - now.velocity) / h;
  model().residual(middle, mean_acceleration, workspace, trial.residual);
  // In place of I α + ω × I ω at the midpoint, the gain of angular momentum over the step.
  for (std::size_t i = 0; i < now.pose.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i) + 3;
    const auto momentum = [&](const State& s) {
      const Eigen::Quaterniond& R = s.pose[i].attitude;
      return Eigen::Vector3d(R * (model().bodies()[i].inertia() * (R.conjugate() * s.velocity.segment<3>(row))));
    };
    State turning = middle;
    turning.velocity.segment<3>(row) = mean_acceleration.segment<3>(row);
    const Eigen::Vector3d omega = middle.velocity.segment<3>(row);
    const Eigen::Vector3d at_midpoint = momentum(turning) + omega.cross(momentum(middle));
    const Eigen::Vector3d exact = (momentum(trial.state) - momentum(now)) / h;
    for (int k = 0; k < 3; ++k)
      if (model().is_free(static_cast<int>(row) + k)) trial.residual[row + k] += exact[k] - at_midpoint[k];
  }
  trial.columns = trial.gradients;
  const auto& constraints = active().constraints().constraints();
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const Constraint& c = constraints[i];
    const ConstraintEnds at = mean(ends_of(c, now), ends_of(c, trial.state));
    trial.columns[i] = std::visit([&](const auto& what) { return gradient(what, at); }, c.what);
    active().constraints().keep_free(c.first, c.second, trial.columns[i]);
  }
}

}  // namespace dynamics
