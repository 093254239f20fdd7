#include "dynamics/integrate/generalized_alpha.hpp"

#include <cmath>
#include <limits>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {
constexpr double closed = 1e-9;             // m, and sine of an angle: what rounding of a placed body leaves
constexpr double event_resolution = 1e-12;  // of a step, and of a level of friction: what rounding leaves of both
}  // namespace

GeneralizedAlpha::GeneralizedAlpha(const Model& model, const Settings& settings) : model_(model), settings_(settings) {
  const double rho = settings.rho_infinity;
  hydro::require(rho >= 0 && rho <= 1, "rho_infinity must lie between 0 and 1, got {}", rho);
  alpha_m_ = (2 * rho - 1) / (rho + 1);  // (D11)
  alpha_f_ = rho / (rho + 1);
  gamma_ = 0.5 + alpha_f_ - alpha_m_;
  beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
  BlockMatrix mass(model.pattern());
  model.add_mass(rest_state(model.bodies()), 1, mass);
  scale_ = mass.dense().diagonal().cwiseSqrt();
  active_ = model.joints();
  find_joint_scale(rest_state(model.bodies()));
  for (std::size_t k = 0; k < model.forces().size(); ++k)
    if (const FrictionKind* kind = model.forces()[k]->friction()) {
      hydro::ensure(friction_ == nullptr, "all friction of a model is one kind");
      friction_ = kind;
      friction_index_ = k;
    }
  double farthest = 0;  // what positions and arms are rounded against
  for (const Joint& joint : model.joints().joints()) {
    farthest = std::max(farthest, joint.place.norm());
    for (const std::optional<int> body : {std::optional(joint.first), joint.second})
      if (body) farthest = std::max(farthest, model.bodies()[static_cast<std::size_t>(*body)].rest_centre().norm());
  }
  constexpr double roundings = 32;  // sums and products between a state and how far a joint is open
  rounding_ = roundings * std::numeric_limits<double>::epsilon() * farthest;
}

// The root of the mass that a condition moves.
void GeneralizedAlpha::find_joint_scale(const State& state) {
  const auto G = active_.gradients(state);
  joint_scale_.resize(active_.count());
  for (Eigen::Index i = 0; i < joint_scale_.size(); ++i) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(model_.modes());
    active_.add_transposed(G, Eigen::VectorXd::Unit(joint_scale_.size(), i), row);
    joint_scale_[i] = 1 / row.cwiseQuotient(scale_).norm();
  }
}

// How far a joint is open is known to rounding only; divided by ∂q/∂a that is an acceleration, the larger the shorter
// the step, and corrections below it mean nothing.
double GeneralizedAlpha::unresolved(double h) const {
  const double s = (1 - alpha_f_) / (1 - alpha_m_);
  return rounding_ / (s * beta_ * h * h) * scale_.norm();
}

void GeneralizedAlpha::require_closed_joints(const State& state, const std::vector<Gradient>& G) const {
  const JointSet& joints = model_.joints();
  if (joints.count() == 0) return;
  const Eigen::VectorXd g = joints.values(state), speed = joints.times(G, state.velocity);
  const auto name = [&](Eigen::Index i) {
    return joints.joints()[static_cast<std::size_t>(joints.conditions()[static_cast<std::size_t>(i)].joint)].name;
  };
  Eigen::Index worst = 0;
  if (g.cwiseAbs().maxCoeff(&worst) > closed)
    throw hydro::InputError(fmt::format("joint \"{}\" does not fit where the run starts: it is off by {:.3g}",
                                        name(worst), std::abs(g[worst])),
                            {}, "start both its bodies where the joint is closed");
  if (speed.cwiseAbs().maxCoeff(&worst) > closed * std::max(1.0, state.velocity.cwiseAbs().maxCoeff()))
    throw hydro::InputError(fmt::format("the velocities at the start pull joint \"{}\" apart by {:.3g} per second",
                                        name(worst), std::abs(speed[worst])),
                            {}, "start both its bodies with velocities that the joint allows");
}

void GeneralizedAlpha::start(Workspace& workspace) {
  require_closed_joints(workspace.state, model_.joints().gradients(workspace.state));
  if (friction_ != nullptr) {
    FrictionMemory& memory = friction_memory(workspace);
    const double rounding = closed * workspace.state.velocity.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < memory.direction.size(); ++i) {
      const double rate = friction_->rate(i, workspace.state);
      memory.direction[i] = std::abs(rate) <= rounding ? 0 : (rate > 0 ? 1 : -1);
    }
    settle_friction(workspace);
    return;
  }
  if (!solve_accelerations(workspace))
    throw hydro::NumericsError(fmt::format(
        "no accelerations can be found at the start, t = {} s: the loads or the mass matrix are not finite or singular",
        workspace.state.time));
}

// G a = −Ġ v keeps the joints closed (D16).
bool GeneralizedAlpha::solve_accelerations(Workspace& workspace) {
  const auto G = active_.gradients(workspace.state);
  const Eigen::VectorXd r = model_.residual(workspace.state, Eigen::VectorXd::Zero(model_.modes()), workspace);
  model_.tangent(workspace.state, 1, 0, 0, workspace, workspace.matrix);
  if (!r.allFinite() || !workspace.solver.factorise(workspace.matrix, G, G)) return false;
  auto [a, lambda] = workspace.solver.solve(-r, -active_.convective(workspace.state));
  workspace.acceleration = std::move(a);
  workspace.multipliers = std::move(lambda);
  algorithmic_ = workspace.acceleration;
  return true;
}

void GeneralizedAlpha::predict(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration,
                               State& next) const {
  const State& now = workspace.state;
  const Eigen::VectorXd algorithmic =
      ((1 - alpha_f_) * acceleration + alpha_f_ * workspace.acceleration - alpha_m_ * algorithmic_) / (1 - alpha_m_);
  const Eigen::VectorXd move = h * now.velocity + h * h * ((0.5 - beta_) * algorithmic_ + beta_ * algorithmic);  // (D9)
  next.time = now.time + h;
  next.velocity = now.velocity + h * ((1 - gamma_) * algorithmic_ + gamma_ * algorithmic);
  next.pose.resize(now.pose.size());
  for (std::size_t i = 0; i < now.pose.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    next.pose[i].centre = now.pose[i].centre + move.segment<3>(row);
    next.pose[i].attitude = (rotation_exp(move.segment<3>(row + 3)) * now.pose[i].attitude).normalized();
  }
}

GeneralizedAlpha::Trial GeneralizedAlpha::evaluate(Workspace& workspace, double h, Eigen::VectorXd acceleration,
                                                   Eigen::VectorXd multipliers) const {
  Trial out{std::move(acceleration), std::move(multipliers), {}, {}, {}, {}, 0};
  predict(workspace, h, out.acceleration, out.state);
  out.residual = model_.residual(out.state, out.acceleration, workspace);
  if (active_.count() > 0) {
    out.gradients = active_.gradients(out.state);
    active_.add_transposed(out.gradients, out.multipliers, out.residual);
    // Divided by ∂q/∂a, the distance by which a joint is open is an acceleration, as large as what closes it.
    const double s = (1 - alpha_f_) / (1 - alpha_m_);
    out.open = active_.values(out.state) / (s * beta_ * h * h);
  }
  // Without joints `open` is empty and its norm zero.
  out.size = std::hypot(out.residual.cwiseQuotient(scale_).norm(), out.open.cwiseProduct(joint_scale_).norm());
  return out;
}

// The step turns body i by exp(Δθ), which varies by J(Δθ) δΔθ.
std::vector<Gradient> GeneralizedAlpha::by_step(const std::vector<Gradient>& G, const State& before,
                                                const State& after) const {
  std::vector<Gradient> out = G;
  const auto turned = [&](int body, Vector6& row) {
    const auto i = static_cast<std::size_t>(body);
    const Eigen::Vector3d turn = rotation_log(after.pose[i].attitude * before.pose[i].attitude.conjugate());
    row.tail<3>() = left_jacobian(turn).transpose() * row.tail<3>();
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Condition& c = active_.conditions()[i];
    turned(c.first, out[i].first);
    if (c.second) turned(*c.second, out[i].second);
  }
  return out;
}

bool GeneralizedAlpha::try_step(Workspace& workspace, double h, StepReport& report) {
  const double s = (1 - alpha_f_) / (1 - alpha_m_);
  Trial now = evaluate(workspace, h, workspace.acceleration, workspace.multipliers);
  const auto settled = [&](double move, double reach) {
    return move <= settings_.newton_tolerance * reach || move <= unresolved(h);
  };
  for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
    if (!std::isfinite(now.size)) {
      failure_ = "the loads are not finite";
      return false;
    }
    ++report.newton_iterations;
    // Leaving J out of the loads' derivatives costs Newton some speed, not the solution; joints have it, to close
    // fully.
    model_.tangent(now.state, 1, s * gamma_ * h, s * beta_ * h * h, workspace, workspace.matrix);
    active_.add_curvature(now.state, now.multipliers, s * beta_ * h * h, workspace.matrix);
    if (!workspace.solver.factorise(workspace.matrix, now.gradients,
                                    by_step(now.gradients, workspace.state, now.state))) {
      failure_ = "the iteration matrix is singular";
      return false;
    }
    const auto [correction, more] = workspace.solver.solve(-now.residual, -now.open);
    const double move = correction.cwiseProduct(scale_).norm();
    Trial trial;
    double factor = 1;
    for (; factor > 1e-3; factor /= 2) {
      trial = evaluate(workspace, h, now.acceleration + factor * correction, now.multipliers + factor * more);
      if (trial.size <= now.size) break;
      // At round-off the residual cannot fall any more: the full correction is as good as it gets.
      if (factor == 1 && settled(move, trial.acceleration.cwiseProduct(scale_).norm())) break;
    }
    if (!std::isfinite(trial.size)) {
      failure_ = "the loads are not finite";
      return false;
    }
    now = std::move(trial);
    const double reach =
        now.acceleration.cwiseProduct(scale_).norm() + now.state.velocity.cwiseProduct(scale_).norm() / h;
    if (factor == 1 && settled(move, reach)) {
      algorithmic_ = ((1 - alpha_f_) * now.acceleration + alpha_f_ * workspace.acceleration - alpha_m_ * algorithmic_) /
                     (1 - alpha_m_);  // (D10)
      workspace.state = std::move(now.state);
      workspace.acceleration = std::move(now.acceleration);
      workspace.multipliers = std::move(now.multipliers);
      return true;
    }
  }
  Eigen::Index worst = 0;
  now.residual.cwiseQuotient(scale_).cwiseAbs().maxCoeff(&worst);
  failure_ = fmt::format("Newton did not converge in {} iterations; worst equation: {}", settings_.iterations,
                         model_.mode_name(static_cast<int>(worst)));
  return false;
}

void GeneralizedAlpha::advance(Workspace& workspace, double h, int depth, StepReport& report) {
  if (try_step(workspace, h, report)) return;
  if (depth == settings_.deepest_halving)
    throw hydro::NumericsError(fmt::format("the run cannot go on from t = {:.6g} s, even with a step of {:.3g} s: {}",
                                           workspace.state.time, h, failure_));
  ++report.halvings;
  advance(workspace, h / 2, depth + 1, report);
  advance(workspace, h / 2, depth + 1, report);
}

GeneralizedAlpha::Snapshot GeneralizedAlpha::snapshot(const Workspace& workspace) const {
  return {workspace.state, workspace.acceleration, workspace.multipliers, algorithmic_};
}

void GeneralizedAlpha::restore(Workspace& workspace, const Snapshot& before) {
  workspace.state = before.state;
  workspace.acceleration = before.acceleration;
  workspace.multipliers = before.multipliers;
  algorithmic_ = before.algorithmic;
}

FrictionMemory& GeneralizedAlpha::friction_memory(Workspace& workspace) const {
  return static_cast<FrictionMemory&>(*workspace.memory[friction_index_]);
}

// The joints' conditions come first, then one for each friction that sticks, in the order of the elements.
void GeneralizedAlpha::set_conditions(Workspace& workspace) {
  active_ = model_.joints();
  const FrictionMemory& memory = friction_memory(workspace);
  for (std::size_t i = 0; i < memory.direction.size(); ++i)
    if (memory.direction[i] == 0) active_.add(friction_->condition(i, workspace.state));
  find_joint_scale(workspace.state);
  workspace.solver = KktSolver(model_.pattern(), active_);
}

GeneralizedAlpha::Margin GeneralizedAlpha::friction_margin(Workspace& workspace) const {
  const FrictionMemory& memory = friction_memory(workspace);
  Margin least;
  Eigen::Index row = model_.joints().count();
  for (std::size_t i = 0; i < memory.direction.size(); ++i) {
    Margin of{i, memory.direction[i] * friction_->rate(i, workspace.state), 0};
    if (memory.direction[i] == 0) {
      const double load = workspace.multipliers[row++];
      of.value = 1 - std::abs(load) / friction_->all()[i].breakaway;
      of.changes_to = load > 0 ? 1 : -1;
    }
    if (of.value < least.value) least = of;
  }
  return least;
}

// What sticks with more than its static level is let go, the most loaded first: the others may then hold.
void GeneralizedAlpha::settle_friction(Workspace& workspace) {
  FrictionMemory& memory = friction_memory(workspace);
  for (std::size_t tries = 0; tries <= memory.direction.size(); ++tries) {
    set_conditions(workspace);
    if (!solve_accelerations(workspace))
      throw hydro::NumericsError(fmt::format(
          "no accelerations can be found at t = {} s: the loads or the mass matrix are not finite or singular",
          workspace.state.time));
    std::size_t worst = 0;
    double load = 0, most = 1;
    Eigen::Index row = model_.joints().count();
    for (std::size_t i = 0; i < memory.direction.size(); ++i) {
      if (memory.direction[i] != 0) continue;
      const double lambda = workspace.multipliers[row++], share = std::abs(lambda) / friction_->all()[i].breakaway;
      if (share > most) worst = i, load = lambda, most = share;
    }
    if (load == 0) return;
    memory.direction[worst] = load > 0 ? 1 : -1;
  }
}

double GeneralizedAlpha::step_to_event(Workspace& workspace, double h, StepReport& report) {
  const Snapshot before = snapshot(workspace);
  const auto margin_after = [&](double way) {
    restore(workspace, before);
    advance(workspace, way, 0, report);
    return friction_margin(workspace).value;
  };
  double low = 0, high = h, at_low = friction_margin(workspace).value, at_high = margin_after(h);
  if (at_high >= 0) return h;
  // Right after it began, a slip has no rate yet: go back until it has.
  if (at_low <= event_resolution)
    for (double way = h / 2; way > h * event_resolution; way /= 2) {
      const double value = margin_after(way);
      if (value > 0) {
        low = way, at_low = value;
        break;
      }
      high = way, at_high = value;
    }
  // False position by Illinois' rule: both ends move.
  double at = high;
  for (int i = 0; i < 100 && high - low > h * event_resolution; ++i) {
    at = at_low > 0 ? (low * at_high - high * at_low) / (at_high - at_low) : (low + high) / 2;
    const double value = margin_after(at);
    if (value == 0) break;
    if (value < 0) {
      high = at, at_high = value;
      at_low /= 2;
    } else {
      low = at, at_low = value;
      at_high /= 2;
    }
  }
  margin_after(at);
  return at;
}

void GeneralizedAlpha::advance_to_events(Workspace& workspace, double h, StepReport& report) {
  constexpr int most = 1000;  // in one step: more is no motion but a mistake
  FrictionMemory& memory = friction_memory(workspace);
  for (double left = h; left > h * event_resolution;) {
    const State before = workspace.state;
    const double way = step_to_event(workspace, left, report);
    friction_->note_work(before, workspace.state, memory);
    if (way == left) return;
    left -= way;
    const Margin next = friction_margin(workspace);
    if (++report.events > most)
      throw hydro::NumericsError(
          fmt::format("friction changes more than {} times in the step from t = {:.6g} s", most, before.time));
    memory.direction[next.element] = next.changes_to;
    settle_friction(workspace);
  }
}

StepReport GeneralizedAlpha::step(Workspace& workspace, double h) {
  StepReport report;
  if (friction_ != nullptr)
    advance_to_events(workspace, h, report);
  else
    advance(workspace, h, 0, report);
  workspace.accept();
  return report;
}

}  // namespace dynamics
