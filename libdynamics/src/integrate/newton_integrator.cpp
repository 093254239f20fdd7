#include "dynamics/integrate/newton_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {
constexpr double newton_tolerance = 1e-9;  // of the last correction relative to the acceleration and velocity / step
constexpr double serves = 0.1;             // factors are kept while a correction by them leaves no more of the residual
constexpr int most_iterations = 20;
}  // namespace

NewtonIntegrator::NewtonIntegrator(const Model& model, double residual_tolerance)
    : Integrator(model), residual_tolerance_(residual_tolerance) {
  constexpr double most = 1e-6;
  hydro::require(residual_tolerance >= least_residual_tolerance && residual_tolerance <= most,
                 "the tolerance of Newton's residual must lie between {} and {}, got {}", least_residual_tolerance,
                 most, residual_tolerance);
}

// How far a joint is open is known to rounding only; divided by ∂q/∂a that is an acceleration, the larger the shorter
// the step, and corrections below it mean nothing.
double NewtonIntegrator::unresolved(double h) const {
  return active().rounding() / slopes(h).end_place * active().scale().norm();
}

void NewtonIntegrator::find_loads(Workspace& workspace, double, Trial& trial) const {
  model().residual(trial.state, trial.acceleration, workspace, trial.residual);
  trial.columns = trial.gradients;
  active().add_sliding(trial.state, trial.columns);
}

void NewtonIntegrator::evaluate(Workspace& workspace, double h, Trial& trial) {
  end_of_step(workspace, h, trial.acceleration, trial.state);
  const JointSet& constraints = active().constraints();
  constraints.find_gradients(trial.state, trial.gradients);
  find_loads(workspace, h, trial);
  constraints.add_transposed(trial.columns, trial.multipliers, trial.residual);
  // Divided by ∂q/∂a, the distance by which a joint is open is an acceleration, as large as what closes it; a speed by
  // ∂v/∂a.
  constraints.find_values(trial.state, trial.open);
  trial.open /= slopes(h).end_place;
  for (Eigen::Index i = 0; i < trial.open.size(); ++i)
    if (constraints.is_on_velocity(i))
      trial.open[i] = constraints.times(i, trial.gradients[static_cast<std::size_t>(i)], trial.state.velocity) /
                      slopes(h).end_speed;
  // Without joints `open` is empty and its norm zero.
  trial.size = std::hypot(trial.residual.cwiseQuotient(active().scale()).norm(),
                          trial.open.cwiseProduct(active().constraint_scale()).norm());
}

void NewtonIntegrator::evaluate_corrected(Workspace& workspace, double h, double part) {
  trial_.acceleration = now_.acceleration - part * correction_.x;
  trial_.multipliers = now_.multipliers - part * correction_.lambda;
  evaluate(workspace, h, trial_);
}

// The step turns body i by exp(Δθ), which varies by J(Δθ) δΔθ; velocities vary by their own.
void NewtonIntegrator::find_gradients_by_step(const State& before) {
  const State& after = now_.state;
  std::vector<Gradient>& out = by_step_;
  out = now_.gradients;
  const auto turned = [&](int body, Vector6& row) {
    const auto i = static_cast<std::size_t>(body);
    const Eigen::Vector3d turn = rotation_log(after.pose[i].attitude * before.pose[i].attitude.conjugate());
    row.tail<3>() = left_jacobian(turn).transpose() * row.tail<3>();
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (active().constraints().is_on_velocity(static_cast<Eigen::Index>(i))) continue;
    const Constraint& c = active().constraints().constraints()[i];
    turned(c.first, out[i].first);
    if (c.second) turned(*c.second, out[i].second);
  }
}

// Leaving J out of the loads' derivatives costs Newton some speed, not the solution; joints have it, to close fully.
bool NewtonIntegrator::factorise(Workspace& workspace, double h) {
  const Trial& now = now_;
  const Slopes slope = slopes(h);
  const State& loads_at = now.loads_at ? *now.loads_at : now.state;
  model().tangent(loads_at, 1, slope.load_speed, slope.load_place, workspace, workspace.matrix);
  active().constraints().add_curvature(loads_at, now.multipliers, slope.load_place, workspace.matrix);
  active().add_turning(loads_at, now.multipliers, slope.load_speed, workspace.matrix);
  find_gradients_by_step(workspace.state);
  return workspace.solver.factorise(workspace.matrix, now.columns, by_step_, active().compliance());
}

// The correction is halved until the residual falls. \returns the part that was taken
double NewtonIntegrator::search(Workspace& workspace, double h, double move) {
  double part = 1;
  for (; part > 1e-3; part /= 2) {
    evaluate_corrected(workspace, h, part);
    if (trial_.size <= now_.size) break;
    // At round-off the residual cannot fall any more: the full correction is as good as it gets.
    const double reach = trial_.acceleration.cwiseProduct(active().scale()).norm();
    if (part == 1 && (move <= newton_tolerance * reach || move <= unresolved(h))) break;
  }
  return part;
}

// The polynomial through the accelerations of as many steps as factors served through, and the one before them.
void NewtonIntegrator::foretell(const Workspace& workspace, int went_on) {
  const Eigen::VectorXd& a = workspace.acceleration;
  now_.acceleration = a;
  if (went_on == 1) now_.acceleration = 2 * a - before_[0];
  if (went_on == 2) now_.acceleration = 3 * (a - before_[0]) + before_[1];
  if (went_on == 3) now_.acceleration = 4 * (a + before_[1]) - 6 * before_[0] - before_[2];
}

double NewtonIntegrator::reach(double h) const {
  const Eigen::VectorXd& scale = active().scale();
  return now_.acceleration.cwiseProduct(scale).norm() + now_.state.velocity.cwiseProduct(scale).norm() / h;
}

void NewtonIntegrator::take_unseen(const Workspace& workspace, double h) {
  now_.acceleration -= correction_.x;
  now_.multipliers -= correction_.lambda;
  end_of_step(workspace, h, now_.acceleration, now_.state);
}

void NewtonIntegrator::finish(Workspace& workspace, int goes_on) {
  accepted(workspace, now_.acceleration);
  goes_on_ = std::min<int>(goes_on, before_.size());
  before_[2].swap(before_[1]);
  before_[1].swap(before_[0]);
  before_[0] = workspace.acceleration;
  std::swap(workspace.state, now_.state);
  workspace.acceleration.swap(now_.acceleration);
  workspace.multipliers.swap(now_.multipliers);
}

// (D98) `kept` factors are those of an earlier iterate or step: corrections by them leave a share of the residual,
// and are taken whole or not at all.
bool NewtonIntegrator::try_step(Workspace& workspace, double h, StepReport& report) {
  prepare(workspace, h);
  const Eigen::VectorXd& scale = active().scale();
  // Contacts that share a load by their compliance want it to the last digit.
  const bool keeps = (active().compliance().array() == 0).all();
  const int went_on = std::exchange(goes_on_, 0);
  foretell(workspace, went_on);
  now_.multipliers = workspace.multipliers;
  evaluate(workspace, h, now_);
  bool anew = false;
  double left = serves;  // of the residual, by the last correction
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (!std::isfinite(now_.size)) return fail("the loads are not finite");
    ++report.newton_iterations;
    const bool kept = workspace.solver.of_step == h;
    if (!kept && !factorise(workspace, h)) return fail("the iteration matrix is singular");
    anew = anew || !kept;
    workspace.solver.solve(now_.residual, now_.open, correction_);
    // Joints are to close fully: there no more is trusted than that the factors serve.
    if (kept && keeps && (now_.open.size() > 0 ? serves : left) * now_.size <= residual_tolerance_ * reach(h)) {
      take_unseen(workspace, h);
      finish(workspace, anew ? 0 : went_on + 1);
      return true;
    }
    const double move = correction_.x.cwiseProduct(scale).norm();
    double part = 1;
    if (kept)
      evaluate_corrected(workspace, h, part);
    else
      part = search(workspace, h, move);
    left = trial_.size / now_.size;
    workspace.solver.of_step = keeps && part == 1 && left <= serves ? h : 0;
    if (kept && !(left <= 1 || move <= unresolved(h))) continue;
    if (!std::isfinite(trial_.size)) return fail("the loads are not finite");
    std::swap(now_, trial_);
    const bool settled = keeps && now_.size <= residual_tolerance_ * reach(h);
    if (part == 1 && (settled || (!kept && move <= newton_tolerance * reach(h)) || move <= unresolved(h))) {
      workspace.solver.of_step = keeps ? h : 0;  // rounding, too, leaves much
      finish(workspace, anew ? 0 : went_on + 1);
      return true;
    }
  }
  Eigen::Index worst = 0;
  now_.residual.cwiseQuotient(scale).cwiseAbs().maxCoeff(&worst);
  return fail(fmt::format("Newton did not converge in {} iterations; worst equation: {}", most_iterations,
                          model().mode_name(static_cast<int>(worst))));
}

}  // namespace dynamics
