#include "dynamics/integrate/sundials_bdf.hpp"

#include <fmt/format.h>

#include "explicit_step.hpp"
#include "hydro/base/error.hpp"
#include "time/cvode.hpp"

namespace dynamics {

SundialsBdf::SundialsBdf(const Model& model, const Settings& settings)
    : Integrator(model),
      settings_(settings),
      solver_(std::make_unique<detail::Cvode>(12 * static_cast<Eigen::Index>(model.bodies().size()))) {
  hydro::require(settings.tolerance > 0, "the tolerance of a step must be positive, got {}", settings.tolerance);
  refuse_contacts(active());
}

SundialsBdf::~SundialsBdf() = default;

// Displacements since the start of the step, then changes of velocity.
bool SundialsBdf::try_step(Workspace& workspace, double h, StepReport& report) {
  const State start = workspace.state;
  const Eigen::Index n = start.velocity.size();
  const auto state_of = [&](const auto& y, double t) {
    return displaced(start, y.head(n), start.velocity + y.tail(n), t);
  };
  const auto rates = [&](double t, Eigen::Map<Eigen::VectorXd> y, Eigen::Map<Eigen::VectorXd> dy) {
    workspace.state = state_of(y, t);
    const auto there = active().balance(workspace);
    if (!there || !there->acceleration.allFinite()) return false;
    dy << displacement_rate(y.head(n), workspace.state.velocity), there->acceleration;
    return true;
  };
  const auto size = [&](const Eigen::VectorXd& x) { return x.cwiseProduct(active().scale()).norm(); };
  const double error = settings_.tolerance * (size(start.velocity) + h * size(workspace.acceleration) + 1e-300);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * n), allowed(2 * n);
  allowed << h * error * active().scale().cwiseInverse(), error * active().scale().cwiseInverse();
  const auto outcome = solver_->run(rates, y, allowed, h);
  workspace.state = start;
  report.newton_iterations += static_cast<int>(outcome.iterations);
  State end = state_of(y, h);
  if (!outcome.good || !arrive(model(), active(), end, workspace))
    return fail(fmt::format("CVODE gives up after {:.3g} s of the step", outcome.reached));
  return true;
}

}  // namespace dynamics
