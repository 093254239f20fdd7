#include "dynamics/integrate/integrator.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {
constexpr double closed = 1e-9;              // m, and sine of an angle: what rounding of a placed body leaves
constexpr double change_resolution = 1e-12;  // of a step, and of a level of friction: what rounding leaves of both
constexpr int deepest_halving = 10;          // a step is cut into 2¹⁰ pieces at most

/// Halving is of no use.
struct NoSmoothStep : hydro::NumericsError {
  using NumericsError::NumericsError;
};
}  // namespace

void Integrator::require_closed_joints(const State& state) const {
  const JointSet& joints = model_.joints();
  if (joints.count() == 0) return;
  const Eigen::VectorXd g = joints.values(state), speed = joints.times(joints.gradients(state), state.velocity) -
                                                          joints.prescribed_rates(state.time);
  const auto name = [&](Eigen::Index i) {
    return joints.joints()[static_cast<std::size_t>(joints.constraints()[static_cast<std::size_t>(i)].joint)].name;
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

void Integrator::start(Workspace& workspace) {
  require_closed_joints(workspace.state);
  if (active_.may_change()) {
    laws_.begin(workspace);
    begin(workspace);
  } else {
    loads_jumped(workspace);
  }
}

void Integrator::loads_jumped(Workspace& workspace) {
  active_.require_accelerations(workspace);
  begin(workspace);
}

void Integrator::displace(const State& now, const Eigen::VectorXd& move, const Eigen::VectorXd& velocity, double h,
                          State& out) const {
  dynamics::move(now, move, out);
  out.time += h;
  out.velocity = velocity;
}

State Integrator::displaced(const State& now, const Eigen::VectorXd& move, const Eigen::VectorXd& velocity,
                            double h) const {
  State out;
  displace(now, move, velocity, h, out);
  return out;
}

// Between two changes that all but coincide: constraints on places would leave their rounding, divided by the time, in
// the velocities; a straight way is exact to rounding there.
void Integrator::go_straight(Workspace& workspace, double h) const {
  const Eigen::VectorXd &v = workspace.state.velocity, &a = workspace.acceleration;
  workspace.state = displaced(workspace.state, h * v + h * h / 2 * a, v + h * a, h);
  model_.joints().count_turns(workspace.state);
}

// Angles are counted on where a part of a step is done; what turns by half a turn or more in it cannot be.
bool Integrator::try_counted_step(Workspace& workspace, double h, StepReport& report) {
  save(workspace, before_step_);
  if (!try_step(workspace, h, report)) return false;
  if (const auto hinge = model_.joints().turns_too_fast(workspace.state, h)) {
    restore(workspace, before_step_);
    return fail(
        fmt::format("hinge \"{}\" turns by more than half a turn in the step, so that its angle cannot be counted",
                    model_.joints().joints()[static_cast<std::size_t>(*hinge)].name));
  }
  for (const auto& kind : model_.forces())
    if (const std::string why = kind->breaks_off(before_step_.state, workspace.state); !why.empty()) {
      restore(workspace, before_step_);
      throw hydro::NumericsError(
          fmt::format("the run cannot go on from t = {:.6g} s: {}", before_step_.state.time, why));
    }
  model_.joints().count_turns(workspace.state);
  return true;
}

void Integrator::advance(Workspace& workspace, double h, StepReport& report) {
  if (tolerance_)
    advance_within(workspace, h, report);
  else
    advance_halving(workspace, h, 0, report);
}

void Integrator::advance_halving(Workspace& workspace, double h, int depth, StepReport& report) {
  if (h < 1e-6 * step_) return go_straight(workspace, h);
  if (try_counted_step(workspace, h, report)) return;
  if (depth == deepest_halving)
    throw NoSmoothStep(fmt::format("the run cannot go on from t = {:.6g} s, even with a step of {:.3g} s: {}",
                                   workspace.state.time, h, failure_));
  ++report.halvings;
  advance_halving(workspace, h / 2, depth + 1, report);
  advance_halving(workspace, h / 2, depth + 1, report);
}

void Integrator::cut_steps(double tolerance) {
  hydro::require(tolerance > 0, "the tolerance of a step must be positive, got {}", tolerance);
  if (const char* why = steps_stay_whole())
    throw hydro::InputError(fmt::format("steps cannot be cut to a tolerance: {}", why));
  tolerance_ = tolerance;
}

void Integrator::note_speeds(const Workspace& workspace, double h) {
  const auto size = [&](const Eigen::VectorXd& x) { return x.cwiseProduct(active_.scale()).norm(); };
  speeds_ = std::max(speeds_, size(workspace.state.velocity) + h * size(workspace.acceleration));
}

// (D96) From `before_part_`; the workspace ends where two halves lead.
double Integrator::local_error(Workspace& workspace, double h, StepReport& report) {
  advance_halving(workspace, h, 0, report);
  whole_ = workspace.state;
  if (speeds_ == 0) note_speeds(workspace, h);  // bodies that begin at rest tell nothing of what is to come
  restore(workspace, before_part_);
  for (int half = 0; half < 2; ++half) advance_halving(workspace, h / 2, 0, report);
  off_.resize(model_.modes());
  for (std::size_t i = 0; i < whole_.pose.size(); ++i) {
    const Pose &one = whole_.pose[i], &two = workspace.state.pose[i];
    off_.segment<6>(6 * static_cast<Eigen::Index>(i)) << one.centre - two.centre,
        rotation_log(one.attitude * two.attitude.conjugate());
  }
  const double of_places = off_.cwiseProduct(active_.scale()).norm() / h;
  off_ = whole_.velocity - workspace.state.velocity;
  return std::max(of_places, off_.cwiseProduct(active_.scale()).norm()) / (std::pow(2, order()) - 1);
}

void Integrator::advance_within(Workspace& workspace, double h, StepReport& report) {
  constexpr double shortest = 1e-5;  // of the step asked for
  if (part_ == 0) part_ = h;
  for (double left = h; left > h * change_resolution;) {
    const double part = std::min(part_, left);
    save(workspace, before_part_);
    const double error = local_error(workspace, part, report), allowed = tolerance_.value() * speeds_;
    const double better = part * (error > 0 ? std::clamp(0.9 * std::pow(allowed / error, 1.0 / order()), 0.2, 5.0) : 5);
    if (error <= allowed) {
      left -= part;
      ++report.parts;
      note_speeds(workspace, part);
      // A part that the end of the step has cut tells only that longer ones may do.
      part_ = part < part_ ? std::max(part_, better) : better;
      continue;
    }
    restore(workspace, before_part_);
    part_ = better;
    if (part_ < shortest * step_)
      throw hydro::NumericsError(
          fmt::format("the run cannot go on from t = {:.6g} s: its tolerance of {:.3g} asks for steps below {:.3g} s",
                      workspace.state.time, *tolerance_, part_));
  }
}

void Integrator::save(const Workspace& workspace, Snapshot& out) const {
  out.state = workspace.state;
  out.acceleration = workspace.acceleration;
  out.multipliers = workspace.multipliers;
  save_history(out.history);
}

void Integrator::restore(Workspace& workspace, const Snapshot& before) {
  workspace.state = before.state;
  workspace.acceleration = before.acceleration;
  workspace.multipliers = before.multipliers;
  set_history(before.history);
}

void Integrator::keep_state(Workspace& workspace, hydro::StateBytes& bytes) {
  Snapshot now;
  save(workspace, now);
  bytes.pass(now.state, now.acceleration, now.multipliers, now.history, part_, speeds_);
  if (bytes.gives_back()) {
    workspace.state = now.state;
    // What sticks and what touches is in the memories.
    if (active_.may_change()) active_.rebuild(workspace);
    restore(workspace, now);
  }
  keep_own_state(bytes);
}

Integrator::Way Integrator::go_to_change(Workspace& workspace, double h, StepReport& report) {
  const Snapshot& before = before_change_;
  save(workspace, before_change_);
  const auto margin_after = [&](double way) {
    restore(workspace, before);
    advance(workspace, way, report);
    return laws_.least_margin(workspace).value;
  };
  double high = h, at_high = margin_after(h);
  if (at_high >= 0) {
    const auto passing = laws_.passing(before.state, workspace);
    if (!passing) return {h, false};
    high = *passing * h, at_high = margin_after(high);
    if (at_high >= 0) return {high, false};  // it goes by closely: from here on its course is known better
  }
  restore(workspace, before);
  double low = 0, at_low = laws_.least_margin(workspace).value;
  // Right after it began, a slip or a bounce has gone no way yet: go back until it has.
  if (at_low <= change_resolution)
    for (double way = high / 2; way > h * change_resolution; way /= 2) {
      const double value = margin_after(way);
      if (value > 0) {
        low = way, at_low = value;
        break;
      }
      high = way, at_high = value;
    }
  // False position by Illinois' rule: both ends move.
  double at = high;
  for (int i = 0; i < 100 && high - low > h * change_resolution; ++i) {
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
  return {at, true};
}

// (D149) What no smooth step leads through, and what changes on and on, is done by leaps where rough contacts touch.
void Integrator::advance_to_changes(Workspace& workspace, double h, StepReport& report) {
  constexpr std::size_t most = 1000;  // in one step: more is no motion but a mistake
  constexpr std::size_t many = 20;    // in one step: what goes on faster and faster is at its end
  double longest = h / 128;  // a leap: its error is of second order in this, and where one is not enough it doubles
  std::size_t changes = 0;
  double reach = h;
  laws_.begin_step();
  const auto happened = [&](const std::vector<Event>& events) {
    report.events.insert(report.events.end(), events.begin(), events.end());
  };
  const auto leap = [&](double left) {
    const double way = std::min(left, longest);
    happened(laws_.leap(workspace, way));
    begin(workspace);
    ++report.leaps;
    reach = longest;
    longest *= 2;
    return way;
  };
  for (double left = h; left > h * change_resolution;) {
    const double begin_of_way = workspace.state.time;
    laws_.begin_work(workspace);
    Way way;
    try {
      way = go_to_change(workspace, std::min(left, reach), report);
    } catch (const NoSmoothStep&) {
      if (!laws_.rubs(workspace)) throw;
      restore(workspace, before_change_);
      reach = std::min(left, reach) / 2;
      if (reach < longest) left -= leap(left);
      continue;
    }
    reach *= 2;
    laws_.share_loads(workspace);
    laws_.note_work(workspace);
    left -= way.time;
    if (!way.changes) continue;
    if (++changes > most)
      throw hydro::NumericsError(fmt::format(
          "friction or contacts change more than {} times in the step from t = {:.6g} s", most, begin_of_way));
    happened(laws_.change(workspace, laws_.least_margin(workspace), h));
    if (changes % many == 0) laws_.still(workspace, h);
    begin(workspace);
    if (changes % many == 0 && laws_.slides(workspace)) left -= leap(left);
  }
}

StepReport Integrator::step(Workspace& workspace, double h) {
  StepReport report;
  step_ = h;
  if (active_.may_change()) {
    if (laws_.follow_rolling(workspace)) begin(workspace);
    advance_to_changes(workspace, h, report);
  } else {
    advance(workspace, h, report);
  }
  workspace.accept();
  return report;
}

}  // namespace dynamics
