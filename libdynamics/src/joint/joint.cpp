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

/// Of a joint's place in the frame of one of its two.
const Eigen::Vector3d& arm_of(const JointArms& arms, End end) { return end == End::first ? arms.first : arms.second; }

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
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Constraint& c = constraints_[i];
    G[i] = std::visit([&](const auto& what) { return gradient(what, ends_of(c, state)); }, c.what);
    keep_free(c.first, c.second, G[i]);
  }
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
  Eigen::VectorXd out(count());
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Constraint& c = constraints_[i];
    Vector12 v = Vector12::Zero();
    v.head<6>() = state.twist(c.first);
    if (c.second) v.tail<6>() = state.twist(*c.second);
    const Matrix12 H = std::visit([&](const auto& what) { return curvature(what, ends_of(c, state)); }, c.what);
    out[static_cast<Eigen::Index>(i)] = v.dot(H * v);
    if (const auto* prescribed = std::get_if<PrescribedConstraint>(&c.what))
      out[static_cast<Eigen::Index>(i)] -= prescribed->motion(state.time).acceleration;
  }
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

namespace {

/// Rows of one end in the gradient or curvature of a constraint: the first six or the last.
constexpr int row_of(End end) { return end == End::first ? 0 : 6; }

Vector6 part_of(const Gradient& g, End end) { return end == End::first ? g.first : g.second; }

/// A load about the centre of gravity, carried to a point `arm` from there.
void carry(const Eigen::Vector3d& arm, Eigen::Ref<Eigen::MatrixXd> load) {
  load.bottomRows<3>() -= cross_matrix(arm) * load.topRows<3>();
}

}  // namespace

Vector6 JointSet::load_on(int joint, End end, const State& state, const Eigen::VectorXd& lambda) const {
  const Joint& j = joints_[static_cast<std::size_t>(joint)];
  const auto body = static_cast<std::size_t>(end == End::first ? j.first : j.second.value());
  const Eigen::Matrix3d to_body = state.pose[body].attitude.toRotationMatrix().transpose();
  Vector6 load = Vector6::Zero();
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Constraint& c = constraints_[i];
    if (c.joint != joint) continue;
    const Gradient g = std::visit([&](const auto& what) { return gradient(what, ends_of(c, state)); }, c.what);
    load -= lambda[static_cast<Eigen::Index>(i)] * part_of(g, end);
  }
  Eigen::MatrixXd out(6, 1);
  out << to_body * load.head<3>(), to_body * load.tail<3>();
  carry(arm_of(arms_[static_cast<std::size_t>(joint)], end), out);
  return out;
}

// Body axes turn with the body: δ(Rᵀf) = δf − θ × f where R is one (D17).
std::vector<Variation> JointSet::load_variations(int joint, End end, const State& still,
                                                 const Eigen::VectorXd& lambda) const {
  const Joint& j = joints_[static_cast<std::size_t>(joint)];
  const auto body = static_cast<std::size_t>(end == End::first ? j.first : j.second.value());
  Eigen::MatrixXd told = Eigen::MatrixXd::Zero(6, 6);  // of a load about the centre of gravity, global axes
  told.topLeftCorner<3, 3>() = still.pose[body].attitude.toRotationMatrix().transpose();
  told.bottomRightCorner<3, 3>() = told.topLeftCorner<3, 3>();
  carry(arm_of(arms_[static_cast<std::size_t>(joint)], end), told);
  Eigen::Matrix<double, 6, 12> by_motion = Eigen::Matrix<double, 6, 12>::Zero();
  std::vector<std::pair<Eigen::Index, Vector6>> by_multiplier;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Constraint& c = constraints_[i];
    if (c.joint != joint) continue;
    const auto index = static_cast<Eigen::Index>(i);
    const ConstraintEnds at = ends_of(c, still);
    const Vector6 p = part_of(std::visit([&](const auto& what) { return gradient(what, at); }, c.what), end);
    const Matrix12 H = std::visit([&](const auto& what) { return curvature(what, at); }, c.what);
    by_motion -= lambda[index] * told * H.middleRows<6>(row_of(end));
    by_motion.middleCols<3>(row_of(end) + 3) -= lambda[index] * (told.leftCols<3>() * cross_matrix(p.head<3>()) +
                                                                 told.rightCols<3>() * cross_matrix(p.tail<3>()));
    by_multiplier.emplace_back(index, -told * p);
  }
  std::vector<Variation> out;
  for (int component = 0; component < 6; ++component) {
    out.push_back(variation_of_two(j.first, j.second, by_motion.row(component)));
    for (const auto& [index, column] : by_multiplier) out.back().by_multiplier.emplace_back(index, column[component]);
  }
  return out;
}

Signal JointSet::coordinate_signal(int joint) const {
  const Joint& j = joints_[static_cast<std::size_t>(joint)];
  const bool turns = j.kind == JointKind::hinge;
  return {
      .name = j.name + (turns ? ".angle" : ".stroke"),
      .unit = turns ? "rad" : "m",
      .meaning = fmt::format("{} of {}, the second against the first", turns ? "angle" : "stroke", j.name),
      .value = [along = coordinate_of(joint), sign = j.sign](const Reading& r) { return sign * along.value(r.state); },
      .variation =
          [along = coordinate_of(joint), sign = j.sign](const Still& still) {
            return variation_of_two(along.first(), along.second(),
                                    sign * joined(along.gradient(still.state)).transpose());
          }};
}

std::vector<Signal> JointSet::load_signals(int joint, End end, const std::string& body) const {
  constexpr const char* component[] = {"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"};
  const std::string on = joints_[static_cast<std::size_t>(joint)].name + "." + body;
  std::vector<Signal> out;
  for (int i = 0; i < 6; ++i)
    out.push_back(
        {.name = fmt::format("{}.{}", on, component[i]),
         .unit = load_unit(i),
         .meaning = fmt::format("load of the joint on {}, about the joint, body axes", on),
         .value = [this, joint, end, i](const Reading& r) { return load_on(joint, end, r.state, r.multipliers)[i]; },
         .variation =
             [this, joint, end, i](const Still& still) {
               const auto all = [&] { return load_variations(joint, end, still.state, still.multipliers); };
               return still.once(&arm_of(arms_[static_cast<std::size_t>(joint)], end),
                                 all)[static_cast<std::size_t>(i)];
             }});
  return out;
}

std::vector<Signal> JointSet::signals(const std::vector<RigidBody>& bodies) const {
  std::vector<Signal> out;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    const int index = static_cast<int>(j);
    if (joint.kind == JointKind::hinge || joint.kind == JointKind::slider) out.push_back(coordinate_signal(index));
    const auto add_loads = [&](End end, int body) {
      for (Signal& s : load_signals(index, end, bodies[static_cast<std::size_t>(body)].name()))
        out.push_back(std::move(s));
    };
    add_loads(End::first, joint.first);
    if (joint.second) add_loads(End::second, *joint.second);
  }
  return out;
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
