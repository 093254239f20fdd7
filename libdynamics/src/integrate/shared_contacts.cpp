/// How contacts that are more than bodies need share what they bear, and what gives way when no share will do. (D130)
#include <algorithm>
#include <cmath>

#include "dynamics/integrate/set_valued.hpp"
#include "share.hpp"

namespace dynamics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The loads of all constraints over the masses that they move, m/s², and the closed contacts among them.
struct SetValuedLaws::Shared {
  VectorXd mass;
  std::vector<Bearing> bearings;
  std::vector<std::size_t> element;  // of each bearing
  MatrixXd idle;                     // loads that do nothing together
};

/// None where loads are unique, or no contact is rough.
std::optional<SetValuedLaws::Shared> SetValuedLaws::shared(Workspace& workspace) const {
  const JointSet& constraints = active_.constraints();
  Shared out{active_.mass_of_loads(), {}, {}, {}};
  bool rough = false;
  for (std::size_t i = 0; i < active_.contact()->elements(); ++i) {
    const ContactState& c = active_.contact_memory(workspace).contact[i];
    if (c.row < 0) continue;
    const double friction = active_.contact()->element(i).friction;
    rough = rough || friction > 0;
    const int held = c.is == ContactState::sticks ? c.held : 0;
    out.bearings.push_back({c.row, held, friction});
    out.element.push_back(i);
  }
  if (!rough || out.bearings.size() < 2) return {};
  const auto columns = active_.columns(constraints.gradients(workspace.state), workspace.state);
  out.idle =
      without_effect(out.mass.asDiagonal() * constraints.dense(columns) * active_.scale().cwiseInverse().asDiagonal());
  if (out.idle.cols() == 0) return {};
  return out;
}

/// As equal pads share them: the least.
VectorXd SetValuedLaws::even_loads(const Shared& shared, const VectorXd& multipliers) const {
  const VectorXd loads = multipliers.cwiseQuotient(shared.mass);
  return loads - shared.idle * (shared.idle.transpose() * loads);
}

SetValuedLaws::Margin SetValuedLaws::margin_of_share(const Margin& even, const VectorXd& multipliers, double rounding,
                                                     Workspace& workspace) const {
  const auto all = shared(workspace);
  if (!all) return even;
  const VectorXd best = best_share(all->idle, even_loads(*all, multipliers), all->bearings);
  Margin out = even;
  out.together = true;
  out.value = least_spare(all->bearings, best) + rounding;
  return out;
}

void SetValuedLaws::share_loads(Workspace& workspace) {
  if (active_.contact() == nullptr) return;
  bool all_bear = !shares_;
  const double granted = rounding(workspace);
  for (std::size_t i = 0; all_bear && i < active_.contact()->elements(); ++i) {
    const ContactState& c = active_.contact_memory(workspace).contact[i];
    if (c.row < 0) continue;
    const int held = c.is == ContactState::sticks ? c.held : 0;
    const double mass = active_.constraint_scale()[c.row] * active_.constraint_scale()[c.row];
    all_bear =
        Bearing{c.row, held, active_.contact()->element(i).friction}.spare(workspace.multipliers) >= -granted * mass;
  }
  if (all_bear) return;
  shares_ = false;
  const auto all = shared(workspace);
  if (!all) return;
  VectorXd loads = even_loads(*all, workspace.multipliers);
  shares_ = least_spare(all->bearings, loads) < 0;
  if (shares_) {
    const VectorXd best = best_share(all->idle, loads, all->bearings);
    loads = least_spare(all->bearings, best) > 0 ? nearest_share(all->idle, loads, all->bearings, best) : best;
  }
  workspace.multipliers = loads.cwiseProduct(all->mass);
}

// While any share is borne by all, nothing moves. Where none is, loads and slips are those that contacts find together;
// at the limit itself nothing moves yet, and what gives way is what has the highest utilisation in the best share.
// \returns true if something was let go; nothing where loads are unique
std::optional<bool> SetValuedLaws::release_together(double rounding, Workspace& workspace) {
  const auto all = shared(workspace);
  if (!all) return {};
  const VectorXd best = best_share(all->idle, even_loads(*all, workspace.multipliers), all->bearings);
  const double spare = least_spare(all->bearings, best);
  if (spare >= -rounding) return false;
  constexpr double limit = 1e-5;  // of the largest load: nearer, accelerations are too small to tell directions
  const bool at_limit = spare > -limit * best.cwiseAbs().maxCoeff();
  return (!at_limit && decide_together(workspace)) || give_way(*all, best, workspace);
}

bool SetValuedLaws::give_way(const Shared& shared, const VectorXd& loads, Workspace& workspace) const {
  const double spare = least_spare(shared.bearings, loads), near = 1e-4 * loads.cwiseAbs().maxCoeff();
  bool any = false;
  for (std::size_t k = 0; k < shared.bearings.size(); ++k) {
    const Bearing& b = shared.bearings[k];
    if (b.spare(loads) > spare + near) continue;
    ContactState& c = active_.contact_memory(workspace).contact[shared.element[k]];
    if (-loads[b.row] <= near) {
      c.is = ContactState::open;
    } else if (c.is == ContactState::sticks) {
      c.slip = direction_of_slip(shared.element[k], loads, workspace);
      c.is = ContactState::slides;
    } else {
      continue;
    }
    any = true;
  }
  return any;
}

}  // namespace dynamics
