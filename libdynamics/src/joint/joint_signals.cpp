/// What joints tell of themselves: coordinates, and loads on their bodies with how these vary.
#include <fmt/format.h>

#include "dynamics/joint/constraints.hpp"
#include "dynamics/joint/coordinate.hpp"
#include "dynamics/joint/joint.hpp"
#include "dynamics/spatial/rotation.hpp"

namespace dynamics {

namespace {

/// Of a joint's place in the frame of one of its two.
const Eigen::Vector3d& arm_of(const JointArms& arms, End end) { return end == End::first ? arms.first : arms.second; }

/// Rows of one end in the gradient or curvature of a constraint: the first six or the last.
constexpr int row_of(End end) { return end == End::first ? 0 : 6; }

Vector6 part_of(const Gradient& g, End end) { return end == End::first ? g.first : g.second; }

/// A load about the centre of gravity, carried to a point `arm` from there.
template <class Load>
void carry(const Eigen::Vector3d& arm, Load& load) {
  load.template bottomRows<3>() -= cross_matrix(arm) * load.template topRows<3>();
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
  Vector6 out;
  out << to_body * load.head<3>(), to_body * load.tail<3>();
  carry(arm_of(arms_[static_cast<std::size_t>(joint)], end), out);
  return out;
}

// Body axes turn with the body: δ(Rᵀf) = δf − θ × f where R is one (D17).
std::vector<Variation> JointSet::load_variations(int joint, End end, const State& still,
                                                 const Eigen::VectorXd& lambda) const {
  const Joint& j = joints_[static_cast<std::size_t>(joint)];
  const auto body = static_cast<std::size_t>(end == End::first ? j.first : j.second.value());
  Matrix6 told = Matrix6::Zero();  // of a load about the centre of gravity, global axes
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

}  // namespace dynamics
