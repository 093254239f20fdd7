/// What contacts do together at one instant: impulses of those that close (D25), loads of those that touch (D130).
#include <cmath>

#include "dynamics/integrate/set_valued.hpp"
#include "dynamics/model/assemble.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "impact.hpp"

namespace dynamics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Contacts that touch, and what each of their loads does to all, among bodies that joints hold.
struct SetValuedLaws::Touching {
  std::vector<std::size_t> element;
  std::vector<ImpactLaw> laws;
  JointSet rows;
  MatrixXd R;       // what rows see of velocities
  MatrixXd gained;  // velocities for each impulse
  MatrixXd W;       // what rows see of those
  MatrixXd passed;  // impulses of what holds the bodies for each impulse
  KktSolver held;   // of the bodies with what holds them
  VectorXd own;     // what rows see of accelerations without loads of contacts

  Index size(std::size_t k) const { return laws[k].friction > 0 ? 3 : 1; }
  /// The two directions along the surface of a rough one.
  Eigen::Matrix<double, 3, 2> along(std::size_t k) const {
    const auto direction = [&](Index row) {
      return std::get<StickConstraint>(rows.constraints()[static_cast<std::size_t>(row)].what).direction;
    };
    Eigen::Matrix<double, 3, 2> out;
    out << direction(laws[k].row + 1), direction(laws[k].row + 2);
    return out;
  }
};

SetValuedLaws::Touching SetValuedLaws::touching(const JointSet& held, std::vector<std::size_t> elements,
                                                Workspace& workspace) const {
  const ContactLaw& kind = *active_.contact();
  const State& state = workspace.state;
  Touching out{std::move(elements), {}, held.with_only({}), {}, {}, {}, {}, KktSolver(model_.pattern(), held), {}};
  for (const std::size_t i : out.element) {
    out.laws.push_back({out.rows.count(), bounces_spent_ ? 0 : kind.element(i).restitution, kind.element(i).friction});
    out.rows.add(kind.closed(i));
    if (kind.element(i).friction > 0)
      for (const Constraint& along : kind.sticking(i, state)) out.rows.add(along);
  }
  out.R = out.rows.dense(out.rows.gradients(state));
  const auto G = held.gradients(state);
  const VectorXd nothing = VectorXd::Zero(held.count());
  model_.tangent(state, 1, 0, 0, workspace, workspace.matrix);
  if (!out.held.factorise(workspace.matrix, G, G, nothing))
    throw hydro::NumericsError(
        fmt::format("no impulses can be found at t = {} s: the mass matrix is singular", state.time));
  out.gained.resize(model_.modes(), out.R.rows());
  out.passed.resize(held.count(), out.R.rows());
  for (Index i = 0; i < out.R.rows(); ++i) {
    const KktSolver::Solution all = out.held.solve(out.R.row(i).transpose(), nothing);
    out.gained.col(i) = all.x;
    out.passed.col(i) = all.lambda;
  }
  out.W = hydro::dense::symmetric_part(out.R * out.gained);
  return out;
}

// (D25). Joints hold in an impact; friction of joints does not, since its load is bounded and an impact takes no time.
// \returns true if there was one.
bool SetValuedLaws::collide(Workspace& workspace) {
  if (active_.contact() == nullptr) return false;
  State& state = workspace.state;
  std::vector<std::size_t> elements;
  bool approaching = false;
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    const ContactLaw::Motion motion = active_.contact()->motion(i, state);
    if (motion.closest_points.gap > closed) continue;
    approaching = approaching || motion.parting < -slow(workspace);
    elements.push_back(i);
  }
  if (!approaching) return false;
  const Touching all = touching(model_.joints(), std::move(elements), workspace);
  const VectorXd before = all.R * state.velocity, z = impulses(all.W, before, all.laws);
  state.velocity += all.gained * z;
  // Where a driven table is hit, its drive works in the blow too.
  active_.contact_memory(workspace).supplied_by_joints -= model_.joints().prescribed_power(all.passed * z, state.time);
  const VectorXd after = all.R * state.velocity;
  for (std::size_t k = 0; k < all.element.size(); ++k) {
    ContactState& c = active_.contact_memory(workspace).contact[all.element[k]];
    const Index row = all.laws[k].row, size = all.size(k);
    if (z[row] > 0) ++c.impacts;
    c.dissipated -= z.segment(row, size).dot(before.segment(row, size) + after.segment(row, size)) / 2;
  }
  return true;
}

namespace {

/// What a contact does that has the load and the acceleration `a` along its normal (and along the surface in `slip`),
/// where those below `still` are none.
ContactState::Is becomes(double load, double parting, double slip, bool slides, bool rough, double still) {
  if (load <= 0 && parting > still) return ContactState::open;
  return slides || slip > still || !rough ? ContactState::slides : ContactState::sticks;
}

}  // namespace

/// Joints, and the frictions of joints that stick.
JointSet SetValuedLaws::held_now(Workspace& workspace) const {
  JointSet held = model_.joints();
  for (std::size_t i = 0; active_.friction() != nullptr && i < active_.friction()->elements(); ++i)
    if (active_.friction_memory(workspace).direction[i] == 0) held.add(active_.friction()->holding(i, workspace.state));
  return held;
}

/// Accelerations without loads of contacts.
VectorXd SetValuedLaws::without_contacts(const Touching& all, const JointSet& held, Workspace& workspace) const {
  const VectorXd loads = model_.residual(workspace.state, VectorXd::Zero(model_.modes()), workspace);
  return all.held.solve(-loads, -held.convective(workspace.state)).x;
}

/// What touches and does not part, among bodies that joints and frictions hold. What slips already goes on so.
SetValuedLaws::Touching SetValuedLaws::touching_now(Workspace& workspace) const {
  const ContactLaw& kind = *active_.contact();
  const State& state = workspace.state;
  const JointSet held = held_now(workspace);
  std::vector<std::size_t> elements;
  std::vector<Eigen::Vector3d> slips;
  for (std::size_t i = 0; i < kind.elements(); ++i) {
    const ContactLaw::Motion motion = kind.motion(i, state);
    if (motion.closest_points.gap > closed || std::abs(motion.parting) > slow(workspace)) continue;
    elements.push_back(i);
    slips.push_back(motion.slip);
  }
  Touching out = touching(held, std::move(elements), workspace);
  for (std::size_t k = 0; k < slips.size(); ++k)
    if (out.laws[k].friction > 0 && slips[k].norm() > slow(workspace))
      out.laws[k].slip = out.along(k).transpose() * slips[k].normalized();
  out.own = out.R * without_contacts(out, held, workspace) + out.rows.convective(state);
  return out;
}

// (D130) The law of contact with accelerations in place of velocities. \returns true if that changes what any does
bool SetValuedLaws::decide_together(Workspace& workspace) const {
  const Touching all = touching_now(workspace);
  if (all.element.empty()) return false;  // what was closed parts faster than what counts as touching
  constexpr int enough = 10'000;          // rounds; where more are needed, what gives way at the limit is as near
  VectorXd z;
  if (relax(all.W, all.own, all.laws, z, enough) > 0) return false;
  const VectorXd a = all.own + all.W * z;
  constexpr double rounding = 1e-6;  // of the fastest: what relaxation leaves to those that do not move is far less
  const double still = rounding * a.cwiseAbs().maxCoeff();
  bool any = false;
  for (std::size_t k = 0; k < all.element.size(); ++k) {
    ContactState& c = active_.contact_memory(workspace).contact[all.element[k]];
    const Index row = all.laws[k].row;
    const bool rough = all.laws[k].friction > 0, slides = all.laws[k].slip.has_value();
    const Eigen::Vector3d slip =
        rough ? Eigen::Vector3d(all.along(k) * a.segment<2>(row + 1)) : Eigen::Vector3d::Zero();
    const ContactState::Is is = becomes(z[row], a[row], slip.norm(), slides, rough, still);
    if (is == ContactState::slides && rough && !slides) {
      any = any || c.is != is || (c.slip - slip.normalized()).norm() > rounding;
      c.slip = slip.normalized();
    }
    any = any || c.is != is;
    c.is = is;
  }
  return any;
}

namespace {

/// Whether friction holds with less than it could.
bool holds_with_ease(const ImpactLaw& law, const VectorXd& z) {
  constexpr double rounding = 1e-9;
  return law.friction > 0 && z.segment<2>(law.row + 1).norm() < (1 - rounding) * law.friction * z[law.row];
}

}  // namespace

bool SetValuedLaws::any_rough(Workspace& workspace, bool (*is)(const ContactState&)) const {
  for (std::size_t i = 0; active_.contact() != nullptr && i < active_.contact()->elements(); ++i)
    if (active_.contact()->element(i).friction > 0 && is(active_.contact_memory(workspace).contact[i])) return true;
  return false;
}

bool SetValuedLaws::rubs(Workspace& workspace) const {
  return any_rough(workspace, [](const ContactState& c) { return c.is != ContactState::open; });
}

bool SetValuedLaws::slides(Workspace& workspace) const {
  return any_rough(workspace, [](const ContactState& c) { return c.is == ContactState::slides; });
}

// (D149)
std::vector<Event> SetValuedLaws::leap(Workspace& workspace, double h) {
  const std::vector<Seen> was = situation(workspace);
  const ContactLaw& kind = *active_.contact();
  State& state = workspace.state;
  std::vector<std::size_t> elements;
  std::vector<double> gaps;
  for (std::size_t i = 0; i < kind.elements(); ++i) {
    const ContactLaw::Motion motion = kind.motion(i, state);
    if (motion.closest_points.gap > closed + h * std::abs(motion.parting)) continue;
    elements.push_back(i);
    gaps.push_back(std::max(0.0, motion.closest_points.gap));
  }
  const JointSet held = held_now(workspace);
  Touching all = touching(held, std::move(elements), workspace);
  const VectorXd a = without_contacts(all, held, workspace), before = all.R * state.velocity;
  VectorXd without = before + h * (all.R * a + all.rows.convective(state));
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    all.laws[k].restitution = 0;
    without[all.laws[k].row] += gaps[k] / h;  // a gap may close, and no more
  }
  const VectorXd z = impulses(all.W, without, all.laws);
  state.velocity += h * a + all.gained * z;
  const VectorXd after = all.R * state.velocity;
  before_ = state;
  move(before_, h * state.velocity, state);
  state.time += h;
  if (model_.joints().count() > 0) close_joints(model_, std::vector<bool>(model_.bodies().size(), false), state);
  model_.joints().count_turns(state);
  note_work_of_joints(workspace);
  classify_contacts(workspace);
  classify_friction(workspace);
  for (std::size_t k = 0; k < all.element.size(); ++k) {
    ContactState& c = active_.contact_memory(workspace).contact[all.element[k]];
    const Index row = all.laws[k].row, size = all.size(k);
    c.dissipated -= z.segment(row, size).dot(before.segment(row, size) + after.segment(row, size)) / 2;
    if (c.is == ContactState::slides && holds_with_ease(all.laws[k], z)) c.is = ContactState::sticks;
  }
  settle(workspace);
  return events_since(was, workspace);
}

}  // namespace dynamics
