#include "dynamics/integrate/explicit_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "explicit_step.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

constexpr std::size_t stages = 7;
/// Dormand & Prince (1980), table 2: nodes, stages, weights of order 5, and those less the weights of order 4.
constexpr std::array<double, stages> node{0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
constexpr double stage_weight[stages][stages - 1] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
constexpr std::array<double, stages> difference{71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                                -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

}  // namespace

ExplicitPair::ExplicitPair(const Model& model, const Settings& settings) : Integrator(model), settings_(settings) {
  hydro::require(settings.tolerance > 0, "the tolerance of a step must be positive, got {}", settings.tolerance);
  refuse_contacts(active());
}

/// From `start_` on; the workspace ends in the state of the last stage, which is the end by order 5.
bool ExplicitPair::find_stages(Workspace& workspace, double h) {
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    move_.setZero(start_.velocity.size()), gain_.setZero(start_.velocity.size());
    for (std::size_t j = 0; j < i; ++j) {
      move_ += h * stage_weight[i][j] * moving_[j];
      gain_ += h * stage_weight[i][j] * gaining_[j];
    }
    velocity_ = start_.velocity + gain_;
    displace(start_, move_, velocity_, node[i] * h, workspace.state);
    if (!active().find_balance(workspace, gaining_[i], multipliers_) || !gaining_[i].allFinite()) return false;
    find_displacement_rate(move_, workspace.state.velocity, moving_[i]);
  }
  return true;
}

std::optional<double> ExplicitPair::attempt(Workspace& workspace, double h) {
  start_ = workspace.state;
  const bool all = find_stages(workspace, h);
  end_ = workspace.state;
  workspace.state = start_;
  if (!all) return {};
  off_.setZero(start_.velocity.size()), off_speed_.setZero(start_.velocity.size());
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    off_ += difference[i] * moving_[i];
    off_speed_ += h * difference[i] * gaining_[i];
  }
  const auto size = [&](const Eigen::VectorXd& x) { return x.cwiseProduct(active().scale()).norm(); };
  const double allowed = settings_.tolerance * (size(start_.velocity) + h * size(gaining_[0]) + 1e-300);
  return std::max(size(off_), size(off_speed_)) / allowed;
}

bool ExplicitPair::try_step(Workspace& workspace, double h, StepReport& report) {
  constexpr double shortest = 1e-7;  // of the step asked for
  begin_ = workspace.state;
  begin_acceleration_ = workspace.acceleration;
  begin_multipliers_ = workspace.multipliers;
  double step = std::isinf(settings_.tolerance) || last_ == 0 ? h : std::min(h, last_);
  for (double done = 0; done < h * (1 - 1e-12);) {
    step = std::min(step, h - done);
    const double error = attempt(workspace, step).value_or(1e10);
    const bool good = error <= 1 && arrive(model(), active(), end_, workspace);
    if (good) done += step, last_ = step;
    if (!good) ++report.halvings;
    step *= good && error == 0 ? 5 : std::clamp(0.9 * std::pow(error, -0.2), 0.2, 5.0);
    if (step > shortest * h) continue;
    workspace.state = begin_;
    workspace.acceleration = begin_acceleration_;
    workspace.multipliers = begin_multipliers_;
    return fail("the explicit pair cannot meet its tolerance: something is too stiff for it");
  }
  return true;
}

}  // namespace dynamics
