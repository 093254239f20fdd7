#include "dynamics/integrate/active_set.hpp"

#include <cmath>
#include <limits>

#include "hydro/base/error.hpp"

namespace dynamics {

ActiveSet::ActiveSet(const Model& model)
    : model_(model),
      constraints_(model.joints()),
      compliance_(Eigen::VectorXd::Zero(constraints_.count())),
      balancer_(std::make_unique<KktSolver>(model.pattern(), constraints_)) {
  const State rest = rest_state(model.bodies());
  BlockMatrix mass(model.pattern());
  model.add_mass(rest, 1, mass);
  scale_ = mass.dense().diagonal().cwiseSqrt();
  find_constraint_scale(rest);
  for (std::size_t k = 0; k < model.forces().size(); ++k) {
    if (const FrictionLaw* kind = model.forces()[k]->friction()) {
      hydro::ensure(friction_ == nullptr, "all friction of a model is one kind");
      friction_ = kind, friction_index_ = k;
    }
    if (const ContactLaw* kind = model.forces()[k]->contact()) {
      hydro::ensure(contact_ == nullptr, "all contacts of a model are one kind");
      contact_ = kind, contact_index_ = k;
    }
  }
  find_pairs();
  double farthest = 1;  // what positions and arms are rounded against, m; and directions, unit vectors
  for (const RigidBody& body : model.bodies()) farthest = std::max(farthest, body.rest_centre().norm());
  for (const Joint& joint : model.joints().joints()) farthest = std::max(farthest, joint.place.norm());
  constexpr double roundings = 32;  // sums and products between a state and how far a joint is open
  rounding_ = roundings * std::numeric_limits<double>::epsilon() * farthest;
}

void ActiveSet::find_pairs() {
  for (std::size_t i = 0; contact_ != nullptr && i < contact_->elements(); ++i) {
    const Contact& c = contact_->element(i);
    std::size_t first = 0;
    while (contact_->element(first).first != c.first || contact_->element(first).second != c.second) ++first;
    first_of_pair_.push_back(first);
  }
}

ActiveSet::ActiveSet(const ActiveSet& other) : ActiveSet(other.model_) {
  constraints_ = other.constraints_;
  slides_ = other.slides_;
  constraint_scale_ = other.constraint_scale_;
  compliance_ = other.compliance_;
  mass_of_loads_ = other.mass_of_loads_;
  balancer_->take(model_.pattern(), constraints_);
}

FrictionMemory& ActiveSet::friction_memory(Workspace& workspace) const {
  return static_cast<FrictionMemory&>(*workspace.memory[friction_index_]);
}

ContactMemory& ActiveSet::contact_memory(Workspace& workspace) const {
  return static_cast<ContactMemory&>(*workspace.memory[contact_index_]);
}

void ActiveSet::find_constraint_scale(const State& state) {
  constraint_scale_.resize(constraints_.count());
  for (Eigen::Index i = 0; i < constraint_scale_.size(); ++i) {
    const Constraint& c = constraints_.constraints()[static_cast<std::size_t>(i)];
    Gradient row = constraints_.gradient_of(c, state);
    row.first.array() /= scale_.segment<6>(6 * c.first).array();
    if (c.second)
      row.second.array() /= scale_.segment<6>(6 * *c.second).array();
    else
      row.second.setZero();
    constraint_scale_[i] = 1 / norm(row);
  }
}

/// False if its bodies cannot move that way at all.
bool ActiveSet::moves(const Constraint& constraint, const State& state) const {
  const Gradient g = model_.joints().gradient_of(constraint, state);
  return g.first.norm() + (constraint.second ? g.second.norm() : 0) > 0;
}

void ActiveSet::close(std::size_t element, Workspace& workspace) {
  ContactState& c = contact_memory(workspace).contact[element];
  c.row = -1, c.held = 0;
  const Constraint normal = contact_->closed(element);
  if (c.is == ContactState::open || !moves(normal, workspace.state)) return;
  c.row = constraints_.count();
  constraints_.add(normal);
  if (c.is == ContactState::slides) {
    if (contact_->element(element).friction > 0) slides_.push_back({c.row, element, c.slip});
    return;
  }
  for (const Constraint& along : contact_->sticking(element, workspace.state))
    if (moves(along, workspace.state)) {
      constraints_.add(along);
      ++c.held;
    }
}

// Pads between two bodies are equally soft wherever they are: they take the least mass of any of them.
void ActiveSet::find_mass_of_loads(Workspace& workspace) {
  mass_of_loads_ = constraint_scale_.cwiseAbs2();
  if (contact_ == nullptr) return;
  least_of_pair_.setConstant(static_cast<Eigen::Index>(contact_->elements()), std::numeric_limits<double>::infinity());
  const auto each_closed = [&](auto use) {
    for (std::size_t i = 0; i < contact_->elements(); ++i) {
      const ContactState& c = contact_memory(workspace).contact[i];
      if (c.row < 0) continue;
      use(least_of_pair_[static_cast<Eigen::Index>(first_of_pair_[i])],
          mass_of_loads_.segment(c.row, 1 + (c.is == ContactState::sticks ? c.held : 0)));
    }
  };
  each_closed([](double& of_pair, const auto& rows) { of_pair = std::min(of_pair, rows.minCoeff()); });
  each_closed([](double of_pair, auto rows) { rows.setConstant(of_pair); });
}

void ActiveSet::rebuild(Workspace& workspace) {
  constraints_.cut(model_.joints().count());
  slides_.clear();
  if (friction_ != nullptr) {
    const FrictionMemory& memory = friction_memory(workspace);
    for (std::size_t i = 0; i < memory.direction.size(); ++i)
      if (memory.direction[i] == 0) constraints_.add(friction_->holding(i, workspace.state));
  }
  const Eigen::Index exact = constraints_.count();
  if (contact_ != nullptr)
    for (std::size_t i = 0; i < contact_->elements(); ++i) close(i, workspace);
  find_constraint_scale(workspace.state);
  find_mass_of_loads(workspace);
  constexpr double share = 1e-7;  // of the inverse mass: an iteration more, and loads to 1e-9
  compliance_ = share * mass_of_loads_.cwiseInverse();
  compliance_.head(exact).setZero();
  workspace.solver.take(model_.pattern(), constraints_);
  balancer_->take(model_.pattern(), constraints_);
}

// What has stopped or come back keeps the direction that it had: the step is cut there.
Eigen::Vector3d ActiveSet::direction(const Slide& slide, const State& state) const {
  constexpr double still = 1e-12;  // m/s, below which it is rounding that has a direction
  const Eigen::Vector3d slip = contact_->motion(slide.element, state).slip;
  return slip.dot(slide.start) > still ? slip.normalized() : slide.start;
}

void ActiveSet::add_sliding(const State& state, std::vector<Gradient>& G) const {
  for (const Slide& slide : slides_) {
    const Contact& c = contact_->element(slide.element);
    const Eigen::Vector3d n = contact_->closest_points(slide.element, state).normal, to = direction(slide, state);
    const Eigen::Vector3d along = (to - to.dot(n) * n).normalized();
    Gradient slip = contact_->along(slide.element, along, state);
    constraints_.keep_free(c.first, c.second, slip);
    Gradient& column = G[static_cast<std::size_t>(slide.row)];
    column.first -= c.friction * slip.first;
    column.second -= c.friction * slip.second;
  }
}

// Across the slip u friction resists as a damper of μp/|u|: the slower the slip, the easier it turns.
void ActiveSet::add_turning(const State& state, const Eigen::VectorXd& multipliers, double by_speed,
                            BlockMatrix& out) const {
  for (const Slide& slide : slides_) {
    const Contact& c = contact_->element(slide.element);
    const ContactLaw::Motion motion = contact_->motion(slide.element, state);
    const double load = -multipliers[slide.row];
    if (load <= 0 || motion.slip.dot(slide.start) <= 0) continue;
    const Eigen::Vector3d across = motion.closest_points.normal.cross(motion.slip).normalized();
    Gradient g = contact_->along(slide.element, across, state);
    constraints_.keep_free(c.first, c.second, g);
    const double damping = by_speed * c.friction * load / motion.slip.norm();
    out.block(c.first, c.first) += damping * g.first * g.first.transpose();
    if (!c.second) continue;
    out.block(*c.second, *c.second) += damping * g.second * g.second.transpose();
    out.block(c.first, *c.second) += damping * g.first * g.second.transpose();
    out.block(*c.second, c.first) += damping * g.second * g.first.transpose();
  }
}

std::optional<ActiveSet::Balance> ActiveSet::balance(Workspace& workspace) const {
  Balance out;
  if (!find_balance(workspace, out.acceleration, out.multipliers)) return {};
  return out;
}

/// By the factors that there are, what is left over of the balance. \returns whether it has become next to nothing
bool ActiveSet::add_correction(Workspace& workspace, Eigen::VectorXd& acceleration,
                               Eigen::VectorXd& multipliers) const {
  constexpr double next_to_nothing = 1e-12;  // what is left after it is smaller by as much as it fell
  Workspace::Balancing& room = workspace.balancing;
  workspace.matrix.multiply(acceleration, room.left);
  room.left = -room.residual - room.left;
  room.minus_multipliers = -multipliers;
  constraints_.add_transposed(room.columns, room.minus_multipliers, room.left);
  room.open = -room.convective;
  for (Eigen::Index i = 0; i < room.open.size(); ++i)
    room.open[i] -= constraints_.times(i, room.gradients[static_cast<std::size_t>(i)], acceleration);
  balancer_->solve(room.left, room.open, room.found);
  acceleration += room.found.x;
  multipliers += room.found.lambda;
  const auto size = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& lambda) {
    return std::hypot(a.cwiseProduct(scale_).norm(), lambda.cwiseQuotient(constraint_scale_).norm());
  };
  return size(room.found.x, room.found.lambda) <= next_to_nothing * size(acceleration, multipliers);
}

/// By factors of an earlier state, which are near those of this one: each correction leaves a small share.
bool ActiveSet::balanced_by_kept(Workspace& workspace, Eigen::VectorXd& acceleration,
                                 Eigen::VectorXd& multipliers) const {
  constexpr int most = 8;
  if (balancer_->of_step == 0) return false;
  for (int pass = 0; pass < most; ++pass)
    if (add_correction(workspace, acceleration, multipliers)) return true;
  return false;
}

// Contacts share a load by their compliance: two more corrections take out what it has left, and more might not end.
bool ActiveSet::find_balance(Workspace& workspace, Eigen::VectorXd& acceleration, Eigen::VectorXd& multipliers) const {
  Workspace::Balancing& room = workspace.balancing;
  constraints_.find_gradients(workspace.state, room.gradients);
  room.columns = room.gradients;
  add_sliding(workspace.state, room.columns);
  room.still.setZero(model_.modes());
  model_.residual(workspace.state, room.still, workspace, room.residual);
  constraints_.find_convective(workspace.state, room.convective);
  model_.tangent(workspace.state, 1, 0, 0, workspace, workspace.matrix);
  if (!room.residual.allFinite()) return false;
  acceleration.setZero(model_.modes());
  multipliers.setZero(constraints_.count());
  const bool shares = compliance_.size() > 0 && compliance_.maxCoeff() > 0;
  if (!shares && balanced_by_kept(workspace, acceleration, multipliers)) return true;
  if (!balancer_->factorise(workspace.matrix, room.columns, room.gradients, compliance_)) return false;
  balancer_->of_step = 1;
  acceleration.setZero();
  multipliers.setZero();
  for (int pass = 0; pass < (shares ? 3 : 1); ++pass) add_correction(workspace, acceleration, multipliers);
  return true;
}

bool ActiveSet::solve_accelerations(Workspace& workspace) const {
  Workspace::Balancing& room = workspace.balancing;
  if (!find_balance(workspace, room.acceleration, room.multipliers)) return false;
  workspace.acceleration = room.acceleration;
  workspace.multipliers = room.multipliers;
  return true;
}

void ActiveSet::require_accelerations(Workspace& workspace) const {
  if (!solve_accelerations(workspace))
    throw hydro::NumericsError(fmt::format(
        "no accelerations can be found at t = {} s: the loads or the mass matrix are not finite or singular",
        workspace.state.time));
}

}  // namespace dynamics
