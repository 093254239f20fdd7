#include "dynamics/joint/joint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/joint/constraints.hpp"
#include "dynamics/joint/coordinate.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

std::string name_of(JointKind kind) {
  constexpr std::array<const char*, 6> names{"fixed", "hinge", "universal", "ball", "slider", "planar"};
  return names[static_cast<std::size_t>(kind)];
}

Eigen::Matrix3d frame_of(const Joint& joint) {
  hydro::require(joint.axis.allFinite() && joint.axis.norm() > 0, "the axis of joint \"{}\" has no direction",
                 joint.name);
  Eigen::Matrix3d frame;
  frame.col(0) = joint.axis.normalized();
  if (joint.kind == JointKind::universal) {
    hydro::require(joint.second_axis.norm() > 0 && std::abs(frame.col(0).dot(joint.second_axis.normalized())) < 1e-9,
                   "the axes of the universal joint \"{}\" must be across each other", joint.name);
    frame.col(1) = joint.second_axis.normalized();
  } else {
    frame.col(1) = frame.col(0).unitOrthogonal();
  }
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

JointArms arms_at_rest(const std::vector<RigidBody>& bodies, const Joint& joint) {
  const auto from_centre = [&](int body) {
    return Eigen::Vector3d(joint.place - bodies[static_cast<std::size_t>(body)].rest_centre());
  };
  return {from_centre(joint.first), joint.second ? from_centre(*joint.second) : joint.place};
}

namespace {

void require_bodies(const Joint& joint, int bodies) {
  const auto there = [&](int body) { return body >= 0 && body < bodies; };
  hydro::require(there(joint.first) && (!joint.second || there(*joint.second)),
                 "joint \"{}\" names a body that is not there", joint.name);
  hydro::require(!joint.second || *joint.second != joint.first, "joint \"{}\" joins a body to itself", joint.name);
}

/// Constraints in the frame at rest, where bodies have no attitude: body axes are global there.
std::vector<ConstraintLaw> constraints_of(const Joint& joint, const JointArms& arms) {
  using enum JointKind;
  const Eigen::Matrix3d frame = frame_of(joint);
  const Eigen::Vector3d x = frame.col(0), y = frame.col(1), z = frame.col(2);
  std::vector<ConstraintLaw> out;
  const auto meet = [&](const Eigen::Vector3d& n, bool turns) {
    out.emplace_back(PointConstraint{arms.first, arms.second, n, turns});
  };
  const auto across = [&](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    out.emplace_back(AxesConstraint{u, v});
  };
  switch (joint.kind) {
    case slider:
      meet(y, true);
      meet(z, true);
      break;
    case planar:
      meet(x, true);
      break;
    default:
      for (int i = 0; i < 3; ++i) meet(Eigen::Vector3d::Unit(i), false);
  }
  if (joint.kind == universal) across(x, y);
  if (joint.kind == hinge || joint.kind == planar || joint.kind == fixed || joint.kind == slider) {
    across(y, x);
    across(z, x);
  }
  if (joint.kind == fixed || joint.kind == slider) across(y, z);
  return out;
}

void set_locked_to_zero(Vector6& row, const std::array<bool, 6>& free) {
  for (int i = 0; i < 6; ++i)
    if (!free[static_cast<std::size_t>(i)]) row[i] = 0;
}

}  // namespace

JointSet::JointSet(const std::vector<RigidBody>& bodies, std::vector<Joint> joints) : joints_(std::move(joints)) {
  for (const RigidBody& body : bodies) free_.push_back(body.properties().free);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    require_bodies(joint, static_cast<int>(bodies.size()));
    arms_.push_back(arms_at_rest(bodies, joint));
    for (auto& what : constraints_of(joint, arms_.back()))
      constraints_.push_back({static_cast<int>(j), joint.first, joint.second, std::move(what)});
    if (!joint.prescribed) continue;
    hydro::require(joint.kind == JointKind::slider || joint.kind == JointKind::hinge,
                   "joint \"{}\" has a prescribed motion, but is neither slider nor hinge", joint.name);
    constraints_.push_back({static_cast<int>(j), joint.first, joint.second,
                            PrescribedConstraint{std::make_shared<JointCoordinate>(bodies, joint), joint.prescribed}});
  }
}

void JointSet::reduce(const std::vector<bool>& keep) {
  std::vector<Constraint> kept;
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (keep[i]) kept.push_back(constraints_[i]);
  constraints_ = std::move(kept);
}

JointSet JointSet::with_only(std::optional<Constraint> constraint) const {
  JointSet out = *this;
  out.constraints_.clear();
  if (constraint) out.constraints_.push_back(std::move(*constraint));
  return out;
}

void JointSet::couple(BlockPattern& pattern) const {
  for (const Constraint& c : constraints_)
    if (c.second) pattern.couple(c.first, *c.second);
}

void JointSet::find_values(const State& state, Eigen::VectorXd& g) const {
  g.resize(count());
  for (Eigen::Index i = 0; i < count(); ++i) {
    const Constraint& c = constraints_[static_cast<std::size_t>(i)];
    g[i] = std::visit([&](const auto& what) { return value(what, ends_of(c, state)); }, c.what);
  }
}

Eigen::VectorXd JointSet::values(const State& state) const {
  Eigen::VectorXd g;
  find_values(state, g);
  return g;
}

void JointSet::find_gradients(const State& state, std::vector<Gradient>& G) const {
  G.resize(constraints_.size());
  for (std::size_t i = 0; i < constraints_.size(); ++i) G[i] = gradient_of(constraints_[i], state);
}

Gradient JointSet::gradient_of(const Constraint& c, const State& state) const {
  Gradient row = std::visit([&](const auto& what) { return gradient(what, ends_of(c, state)); }, c.what);
  keep_free(c.first, c.second, row);
  return row;
}

std::vector<Gradient> JointSet::gradients(const State& state) const {
  std::vector<Gradient> G;
  find_gradients(state, G);
  return G;
}

void JointSet::keep_free(int first, std::optional<int> second, Gradient& row) const {
  set_locked_to_zero(row.first, free_[static_cast<std::size_t>(first)]);
  if (second) set_locked_to_zero(row.second, free_[static_cast<std::size_t>(*second)]);
}

Vector12 joined(const Gradient& g) {
  Vector12 out;
  out << g.first, g.second;
  return out;
}

double norm(const Gradient& g) { return std::hypot(g.first.norm(), g.second.norm()); }

std::vector<Gradient> JointSet::over(const std::vector<Gradient>& G, const Eigen::VectorXd& scale) const {
  std::vector<Gradient> out(G.size(), {Vector6::Zero(), Vector6::Zero()});
  for (std::size_t i = 0; i < G.size(); ++i) {
    const Constraint& c = constraints_[i];
    out[i].first = G[i].first.cwiseQuotient(scale.segment<6>(6 * c.first));
    if (c.second) out[i].second = G[i].second.cwiseQuotient(scale.segment<6>(6 * *c.second));
  }
  return out;
}

Eigen::VectorXd JointSet::times(const std::vector<Gradient>& G, const Eigen::VectorXd& x) const {
  Eigen::VectorXd out(count());
  for (Eigen::Index i = 0; i < count(); ++i) out[i] = times(i, G[static_cast<std::size_t>(i)], x);
  return out;
}

double JointSet::times(Eigen::Index constraint, const Gradient& row, const Eigen::VectorXd& x) const {
  const Constraint& c = constraints_[static_cast<std::size_t>(constraint)];
  return row.first.dot(x.segment<6>(6 * c.first)) + (c.second ? row.second.dot(x.segment<6>(6 * *c.second)) : 0);
}

void JointSet::add_transposed(const std::vector<Gradient>& G, const Eigen::VectorXd& lambda,
                              Eigen::VectorXd& out) const {
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Constraint& c = constraints_[i];
    const double l = lambda[static_cast<Eigen::Index>(i)];
    out.segment<6>(6 * c.first) += l * G[i].first;
    if (c.second) out.segment<6>(6 * *c.second) += l * G[i].second;
  }
}

Eigen::MatrixXd JointSet::dense(const std::vector<Gradient>& G) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count(), 6 * static_cast<Eigen::Index>(free_.size()));
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Constraint& c = constraints_[i];
    const auto row = static_cast<Eigen::Index>(i);
    out.row(row).segment<6>(6 * c.first) = G[i].first;
    if (c.second) out.row(row).segment<6>(6 * *c.second) = G[i].second;
  }
  return out;
}

void JointSet::add_curvature(const State& state, const Eigen::VectorXd& lambda, double factor, BlockMatrix& out) const {
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Constraint& c = constraints_[i];
    Matrix12 H = factor * lambda[static_cast<Eigen::Index>(i)] *
                 std::visit([&](const auto& what) { return curvature(what, ends_of(c, state)); }, c.what);
    for (int k = 0; k < 12; ++k) {  // motions that are not free have rows and columns of their own
      const std::optional<int> body = k < 6 ? c.first : c.second;
      if (!body || free_[static_cast<std::size_t>(*body)][static_cast<std::size_t>(k % 6)]) continue;
      H.row(k).setZero();
      H.col(k).setZero();
    }
    out.block(c.first, c.first) += H.topLeftCorner<6, 6>();
    if (!c.second) continue;
    out.block(c.first, *c.second) += H.topRightCorner<6, 6>();
    out.block(*c.second, c.first) += H.bottomLeftCorner<6, 6>();
    out.block(*c.second, *c.second) += H.bottomRightCorner<6, 6>();
  }
}

Eigen::VectorXd JointSet::convective(const State& state) const {
  Eigen::VectorXd out;
  find_convective(state, out);
  return out;
}

void JointSet::find_convective(const State& state, Eigen::VectorXd& out) const {
  out.resize(count());
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    out[static_cast<Eigen::Index>(i)] = convective_of(constraints_[i], state);
}

double JointSet::convective_of(const Constraint& c, const State& state) const {
  Vector12 v = Vector12::Zero();
  v.head<6>() = state.twist(c.first);
  if (c.second) v.tail<6>() = state.twist(*c.second);
  double out = std::visit([&](const auto& what) { return dynamics::convective(what, ends_of(c, state), v); }, c.what);
  if (const auto* prescribed = std::get_if<PrescribedConstraint>(&c.what))
    out -= prescribed->motion(state.time).acceleration;
  return out;
}

bool JointSet::are_prescribed() const {
  return std::any_of(joints_.begin(), joints_.end(), [](const Joint& j) { return static_cast<bool>(j.prescribed); });
}

Eigen::VectorXd JointSet::prescribed_rates(double time) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(count());
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (const auto* prescribed = std::get_if<PrescribedConstraint>(&constraints_[i].what))
      out[static_cast<Eigen::Index>(i)] = prescribed->motion(time).rate;
  return out;
}

double JointSet::prescribed_power(const Eigen::VectorXd& lambda, double time) const {
  double sum = 0;
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (const auto* prescribed = std::get_if<PrescribedConstraint>(&constraints_[i].what))
      sum += lambda[static_cast<Eigen::Index>(i)] * prescribed->motion(time).rate;
  return sum;
}

JointCoordinate JointSet::coordinate_of(int joint) const {
  return {joints_[static_cast<std::size_t>(joint)], arms_[static_cast<std::size_t>(joint)], joint};
}

double JointSet::coordinate(int joint, const State& state) const { return coordinate_of(joint).value(state); }

// (D133)
void JointSet::count_turns(State& state) const {
  for (Pose& pose : state.pose) pose.counted = pose.roll_pitch_yaw();
  state.hinge_angle.resize(joints_.size(), 0);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (joints_[j].kind != JointKind::hinge) continue;
    if (joints_[j].prescribed) state.hinge_angle[j] = joints_[j].prescribed(state.time).coordinate;
    state.hinge_angle[j] = coordinate(static_cast<int>(j), state);
  }
}

std::optional<int> JointSet::turns_too_fast(const State& state, double h) const {
  for (int j = 0; j < std::ssize(joints_); ++j)
    if (joints_[static_cast<std::size_t>(j)].kind == JointKind::hinge &&
        std::abs(coordinate_of(j).rate(state)) * h >= std::numbers::pi)
      return j;
  return std::nullopt;
}

}  // namespace dynamics
