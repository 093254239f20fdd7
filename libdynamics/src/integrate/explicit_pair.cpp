#include "dynamics/integrate/explicit_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "explicit_step.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

constexpr int stages = 7;
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

std::optional<ExplicitPair::Attempt> ExplicitPair::attempt(Workspace& workspace, double h) const {
  const State start = workspace.state;
  std::array<Eigen::VectorXd, stages> moving, gaining;
  Eigen::VectorXd move = Eigen::VectorXd::Zero(start.velocity.size()), gain = move;
  bool all = true;
  for (std::size_t i = 0; i < stages && all; ++i) {
    move.setZero(), gain.setZero();
    for (std::size_t j = 0; j < i; ++j) {
      move += h * stage_weight[i][j] * moving[j];
      gain += h * stage_weight[i][j] * gaining[j];
    }
    workspace.state = displaced(start, move, start.velocity + gain, node[i] * h);
    const auto there = active().balance(workspace);
    all = there && there->acceleration.allFinite();
    if (!all) break;
    moving[i] = displacement_rate(move, workspace.state.velocity);
    gaining[i] = there->acceleration;
  }
  Attempt out{workspace.state, 0};  // the last stage is the end by order 5
  workspace.state = start;
  if (!all) return {};
  Eigen::VectorXd off = Eigen::VectorXd::Zero(move.size()), off_speed = off;
  for (std::size_t i = 0; i < stages; ++i) {
    off += difference[i] * moving[i];
    off_speed += h * difference[i] * gaining[i];
  }
  const auto size = [&](const Eigen::VectorXd& x) { return x.cwiseProduct(active().scale()).norm(); };
  const double allowed = settings_.tolerance * (size(start.velocity) + h * size(gaining[0]) + 1e-300);
  out.error = std::max(size(off), size(off_speed)) / allowed;
  return out;
}

bool ExplicitPair::try_step(Workspace& workspace, double h, StepReport& report) {
  constexpr double shortest = 1e-7;  // of the step asked for
  const State start = workspace.state;
  const Eigen::VectorXd acceleration = workspace.acceleration, multipliers = workspace.multipliers;
  double step = std::isinf(settings_.tolerance) || last_ == 0 ? h : std::min(h, last_);
  for (double done = 0; done < h * (1 - 1e-12);) {
    step = std::min(step, h - done);
    const auto tried = attempt(workspace, step);
    const double error = tried ? tried->error : 1e10;
    const bool good = tried && error <= 1 && arrive(model(), active(), tried->end, workspace);
    if (good) done += step, last_ = step;
    if (!good) ++report.halvings;
    step *= good && error == 0 ? 5 : std::clamp(0.9 * std::pow(error, -0.2), 0.2, 5.0);
    if (step > shortest * h) continue;
    workspace.state = start;
    workspace.acceleration = acceleration;
    workspace.multipliers = multipliers;
    return fail("the explicit pair cannot meet its tolerance: something is too stiff for it");
  }
  return true;
}

}  // namespace dynamics
