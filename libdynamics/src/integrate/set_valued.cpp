#include "dynamics/integrate/set_valued.hpp"

#include <cmath>
#include <functional>

#include "hydro/base/error.hpp"

namespace dynamics {

// Speeds below it are rounding of those at hand, or of what accelerations add in a step.
double SetValuedLaws::slow(const Workspace& workspace) const {
  return closed *
         std::max(workspace.state.velocity.cwiseAbs().maxCoeff(), step_ * workspace.acceleration.cwiseAbs().maxCoeff());
}

// What accelerations, and loads per mass, are known to, m/s².
double SetValuedLaws::rounding(const Eigen::VectorXd& acceleration, const Eigen::VectorXd& multipliers) const {
  const auto by_mass = multipliers.cwiseQuotient(active_.constraint_scale().cwiseAbs2());
  const double heaviest = multipliers.size() > 0 ? by_mass.cwiseAbs().maxCoeff() : 0;
  return 1e-8 * std::max({acceleration.cwiseAbs().maxCoeff(), heaviest, 1e-3});
}

// Second rate of the gap, m/s².
double SetValuedLaws::pull(std::size_t element, const Workspace& workspace) const {
  const Constraint c = active_.contact()->closed(element);
  const Gradient row = model_.joints().gradient_of(c, workspace.state);
  const auto of_body = [&](const Vector6& part, int body) {
    return part.dot(workspace.acceleration.segment<6>(6 * body));
  };
  return of_body(row.first, c.first) + (c.second ? of_body(row.second, *c.second) : 0) +
         model_.joints().convective_of(c, workspace.state);
}

void SetValuedLaws::classify_friction(Workspace& workspace) const {
  if (active_.friction() == nullptr) return;
  FrictionMemory& memory = active_.friction_memory(workspace);
  for (std::size_t i = 0; i < memory.direction.size(); ++i) {
    const double rate = active_.friction()->rate(i, workspace.state);
    memory.turn(i, std::abs(rate) <= slow(workspace) ? 0 : (rate > 0 ? 1 : -1), workspace.state.time);
  }
}

// A contact without gap and without speed along the normal is closed, until its load says otherwise.
void SetValuedLaws::classify_contacts(Workspace& workspace) const {
  if (active_.contact() == nullptr) return;
  const double slow = this->slow(workspace);
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    ContactState& c = active_.contact_memory(workspace).contact[i];
    const auto [m, parting, slip] = active_.contact()->motion(i, workspace.state);
    const bool touches = m.gap <= closed && std::abs(parting) <= slow;
    const bool holds = active_.contact()->element(i).friction > 0 && slip.norm() <= slow;
    c.is = !touches ? ContactState::open : holds ? ContactState::sticks : ContactState::slides;
    if (slip.norm() > 0) c.slip = slip.normalized();
  }
}

void SetValuedLaws::begin(Workspace& workspace) {
  if (active_.contact() != nullptr) {
    for (std::size_t i = 0; i < active_.contact()->elements(); ++i)
      if (const double gap = active_.contact()->gap(i, workspace.state); gap < -closed)
        throw hydro::InputError(fmt::format("contact \"{}\": the shapes overlap by {:.3g} m where the run starts",
                                            active_.contact()->element(i).name, -gap),
                                {}, "move the bodies apart, or make the shapes smaller");
    collide(workspace);
    classify_contacts(workspace);
  }
  classify_friction(workspace);
  settle(workspace);
}

// The least change of velocities, in the metric of the masses, that takes the speeds of those contacts: it can only
// take energy.
void SetValuedLaws::still(Workspace& workspace, double step) {
  bounces_spent_ = true;
  if (active_.contact() == nullptr) return;
  JointSet rows = model_.joints();
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    const double fall = std::abs(pull(i, workspace)) * step;
    const ContactLaw::Motion motion = active_.contact()->motion(i, workspace.state);
    if (motion.closest_points.gap > fall * step / 2 || std::abs(motion.parting) > fall) continue;
    rows.add(active_.contact()->closed(i));
    near.push_back(i);
  }
  if (near.empty()) return;
  const double before = model_.kinetic_energy(workspace.state);
  const auto G = rows.gradients(workspace.state);
  KktSolver solver(model_.pattern(), rows);
  Eigen::VectorXd compliance = Eigen::VectorXd::Zero(rows.count());
  compliance.tail(static_cast<Eigen::Index>(near.size())).setConstant(1e-9 / active_.scale().cwiseAbs2().maxCoeff());
  model_.tangent(workspace.state, 1, 0, 0, workspace, workspace.matrix);
  if (!solver.factorise(workspace.matrix, G, G, compliance)) return;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model_.modes());
  const KktSolver::Solution change =
      solver.solve(none, rows.prescribed_rates(workspace.state.time) - rows.times(G, workspace.state.velocity));
  workspace.state.velocity += change.x;
  const double supplied = -model_.joints().prescribed_power(change.lambda, workspace.state.time);
  active_.contact_memory(workspace).supplied_by_joints += supplied;
  const double lost = before + supplied - model_.kinetic_energy(workspace.state);
  for (const std::size_t i : near)
    active_.contact_memory(workspace).contact[i].dissipated += lost / static_cast<double>(near.size());
  classify_contacts(workspace);
  classify_friction(workspace);
  settle(workspace);
}

std::vector<SetValuedLaws::Seen> SetValuedLaws::situation(Workspace& workspace) const {
  std::vector<Seen> out;
  if (active_.friction() != nullptr)
    for (const int direction : active_.friction_memory(workspace).direction) out.push_back({direction, 0});
  if (active_.contact() != nullptr)
    for (const ContactState& c : active_.contact_memory(workspace).contact) out.push_back({c.is, c.impacts});
  return out;
}

// What has reached its level is let go at once; settle() then looks at what follows for the others.
void SetValuedLaws::take_up(Workspace& workspace, const Margin& at) {
  if (at.law == Event::Law::friction) {
    active_.friction_memory(workspace).turn(at.element, at.becomes, workspace.state.time);
    return;
  }
  if (at.together) return;  // settle() sees which
  ContactState& c = active_.contact_memory(workspace).contact[at.element];
  if (at.becomes == ContactState::sticks) {  // others may touch or stop with it
    const bool slid = c.is == ContactState::slides;
    classify_contacts(workspace);
    if (slid && c.is != ContactState::open) c.is = ContactState::sticks;
    return;
  }
  if (at.becomes == ContactState::slides) c.slip = direction_of_slip(at.element, workspace.multipliers, workspace);
  c.is = static_cast<ContactState::Is>(at.becomes);
}

// Against the load that it holds with.
Eigen::Vector3d SetValuedLaws::direction_of_slip(std::size_t element, const Eigen::VectorXd& multipliers,
                                                 Workspace& workspace) const {
  const ContactState& c = active_.contact_memory(workspace).contact[element];
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (int k = 1; k <= c.held; ++k) {
    const Constraint& along = active_.constraints().constraints()[static_cast<std::size_t>(c.row + k)];
    direction += multipliers[c.row + k] * std::get<StickConstraint>(along.what).direction;
  }
  return direction.normalized();
}

std::vector<Event> SetValuedLaws::change(Workspace& workspace, const Margin& at, double step) {
  step_ = step;
  const std::vector<Seen> was = situation(workspace);
  if (collide(workspace)) {
    classify_contacts(workspace);
    classify_friction(workspace);
  } else {
    take_up(workspace, at);
  }
  settle(workspace);
  return events_since(was, workspace);
}

std::vector<Event> SetValuedLaws::events_since(const std::vector<Seen>& was, Workspace& workspace) const {
  const std::vector<Seen> is = situation(workspace);
  const std::size_t frictions = active_.friction() == nullptr ? 0 : active_.friction()->elements();
  std::vector<Event> events;
  for (std::size_t i = 0; i < is.size(); ++i)
    if (is[i] != was[i])
      events.push_back({i < frictions ? Event::Law::friction : Event::Law::contact, workspace.state.time,
                        i < frictions ? i : i - frictions, is[i].is});
  return events;
}

SetValuedLaws::Margin SetValuedLaws::least_margin(Workspace& workspace) {
  Margin least;
  const auto consider = [&](Event::Law law, std::size_t element, double value, int becomes) {
    if (value < least.value) least = {law, element, value, becomes};
  };
  const bool holds = active_.constraints().count() > model_.joints().count();
  if (holds && !active_.find_balance(workspace, loads_.acceleration, loads_.multipliers))
    throw hydro::NumericsError(fmt::format(
        "no loads can be found at t = {} s: they are not finite or the mass is singular", workspace.state.time));
  if (active_.friction() != nullptr) {
    const FrictionMemory& memory = active_.friction_memory(workspace);
    Eigen::Index row = model_.joints().count();
    for (std::size_t i = 0; i < memory.direction.size(); ++i) {
      if (memory.direction[i] != 0) {
        consider(Event::Law::friction, i, memory.direction[i] * active_.friction()->rate(i, workspace.state), 0);
        continue;
      }
      const double load = loads_.multipliers[row++];
      consider(Event::Law::friction, i, 1 - active_.friction()->utilisation(i, load, memory, workspace.state.time),
               load > 0 ? 1 : -1);
    }
  }
  if (active_.contact() == nullptr) return least;
  const double rounding = holds ? this->rounding(loads_.acceleration, loads_.multipliers) : 0;
  Margin borne;  // of the loads of contacts
  const auto bears = [&](std::size_t element, double value, int becomes) {
    if (value < borne.value) borne = {Event::Law::contact, element, value, becomes};
  };
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    const ContactState& c = active_.contact_memory(workspace).contact[i];
    const auto contact = [&](double value, int becomes) { consider(Event::Law::contact, i, value, becomes); };
    if (c.is == ContactState::open)
      contact(active_.contact()->gap(i, workspace.state) + active_.rounding(), ContactState::sticks);
    if (c.row < 0) continue;
    const double mass = active_.constraint_scale()[c.row] * active_.constraint_scale()[c.row];
    const double load = -loads_.multipliers[c.row], friction = active_.contact()->element(i).friction;
    bears(i, load / mass + rounding, ContactState::open);
    if (c.is == ContactState::sticks)
      bears(i, (friction * load - loads_.multipliers.segment(c.row + 1, c.held).norm()) / mass + rounding,
            ContactState::slides);
    else if (friction > 0)
      contact(c.slip.dot(active_.contact()->motion(i, workspace.state).slip), ContactState::sticks);
  }
  if (borne.value < 0) borne = margin_of_share(borne, loads_.multipliers, rounding, workspace);
  if (borne.value < least.value) least = borne;
  return least;
}

std::optional<double> SetValuedLaws::passing(const State& before, Workspace& workspace) const {
  std::optional<double> first;
  for (std::size_t i = 0; active_.contact() != nullptr && i < active_.contact()->elements(); ++i) {
    if (active_.contact_memory(workspace).contact[i].is != ContactState::open) continue;
    const auto share = active_.contact()->passing(i, before, workspace.state);
    if (share && (!first || *share < *first)) first = share;
  }
  return first;
}

// What holds with more than it can is let go, the most loaded first: the others may then hold. Half of the rounding
// that least_margin() grants, so that what it found is let go.
bool SetValuedLaws::release(Workspace& workspace) {
  const double rounding = this->rounding(workspace);
  double most = 0;
  std::function<void()> let_go;
  if (active_.friction() != nullptr) {
    FrictionMemory& memory = active_.friction_memory(workspace);
    Eigen::Index row = model_.joints().count();
    for (std::size_t i = 0; i < memory.direction.size(); ++i) {
      if (memory.direction[i] != 0) continue;
      const double load = workspace.multipliers[row++];
      const double over = active_.friction()->utilisation(i, load, memory, workspace.state.time) - 1;
      if (over <= most) continue;
      most = over;
      let_go = [&memory, &workspace, i, load] { memory.turn(i, load > 0 ? 1 : -1, workspace.state.time); };
    }
  }
  const std::function<void()> joint_slips = let_go;
  bool contact = false;
  const auto exceeds = [&](double over) {
    if (over <= most) return false;
    most = over;
    return contact = true;
  };
  for (std::size_t i = 0; active_.contact() != nullptr && i < active_.contact()->elements(); ++i) {
    ContactState& c = active_.contact_memory(workspace).contact[i];
    if (c.row < 0) continue;
    const double mass = active_.constraint_scale()[c.row] * active_.constraint_scale()[c.row];
    const double load = -workspace.multipliers[c.row] / mass;
    if (exceeds(-load - rounding / 2)) let_go = [&c] { c.is = ContactState::open; };
    if (c.is != ContactState::sticks) continue;
    const double held = workspace.multipliers.segment(c.row + 1, c.held).norm() / mass;
    if (exceeds(held - active_.contact()->element(i).friction * std::max(load, 0.0) - rounding / 2))
      let_go = [this, &c, &workspace, i] {
        c.slip = direction_of_slip(i, workspace.multipliers, workspace);
        c.is = ContactState::slides;
      };
  }
  if (contact)
    if (const auto together = release_together(rounding / 2, workspace)) {
      if (*together) return true;
      let_go = joint_slips;
    }
  if (let_go) let_go();
  return static_cast<bool>(let_go);
}

bool SetValuedLaws::close_what_would_overlap(Workspace& workspace) {
  if (active_.contact() == nullptr) return false;
  bool any = false;
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    ContactState& c = active_.contact_memory(workspace).contact[i];
    if (c.is != ContactState::open) continue;
    const ContactLaw::Motion motion = active_.contact()->motion(i, workspace.state);
    if (motion.closest_points.gap > closed || std::abs(motion.parting) > slow(workspace)) continue;
    if (pull(i, workspace) >= -rounding(workspace)) continue;
    c.is = active_.contact()->element(i).friction > 0 ? ContactState::sticks : ContactState::slides;
    any = true;
  }
  return any;
}

void SetValuedLaws::settle(Workspace& workspace) {
  const std::size_t tries = 10 + 4 * situation(workspace).size();
  for (std::size_t n = 0; n < tries; ++n) {
    active_.rebuild(workspace);
    active_.require_accelerations(workspace);
    if (!release(workspace) && !close_what_would_overlap(workspace)) return;
  }
  throw hydro::NumericsError(
      fmt::format("at t = {:.6g} s no set of frictions that stick and contacts that are closed agrees with its loads",
                  workspace.state.time));
}

/// Power of the slip of each contact, W.
void SetValuedLaws::find_slip_power(Workspace& workspace, Eigen::VectorXd& power) const {
  if (active_.contact() == nullptr) return;
  power.setZero(static_cast<Eigen::Index>(active_.contact()->elements()));
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    const ContactState& c = active_.contact_memory(workspace).contact[i];
    if (c.is != ContactState::slides || c.row < 0) continue;
    power[static_cast<Eigen::Index>(i)] = active_.contact()->element(i).friction * -workspace.multipliers[c.row] *
                                          active_.contact()->motion(i, workspace.state).slip.norm();
  }
}

void SetValuedLaws::begin_work(Workspace& workspace) {
  before_ = workspace.state;
  find_slip_power(workspace, slip_power_before_);
}

void SetValuedLaws::note_work_of_joints(Workspace& workspace) const {
  if (active_.friction() != nullptr)
    active_.friction()->note_work(before_, workspace.state, active_.friction_memory(workspace));
}

void SetValuedLaws::note_work(Workspace& workspace) {
  note_work_of_joints(workspace);
  if (active_.contact() == nullptr) return;
  find_slip_power(workspace, slip_power_);
  auto& contacts = active_.contact_memory(workspace).contact;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    contacts[i].dissipated += (workspace.state.time - before_.time) * (slip_power_before_[at] + slip_power_[at]) / 2;
  }
}

bool SetValuedLaws::follow_rolling(Workspace& workspace) {
  if (active_.contact() == nullptr) return false;
  bool any = false;
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    ContactState& c = active_.contact_memory(workspace).contact[i];
    if (c.is == ContactState::slides) {  // later steps begin with the direction that slip has now
      const Eigen::Vector3d slip = active_.contact()->motion(i, workspace.state).slip;
      if (slip.norm() > slow(workspace)) c.slip = slip.normalized();
    }
    any = any || (c.is != ContactState::open && active_.contact()->element(i).friction > 0);
  }
  if (!any) return false;
  active_.rebuild(workspace);
  if (workspace.multipliers.size() == active_.constraints().count()) return false;
  settle(workspace);
  return true;
}

}  // namespace dynamics
