/// \file  Signals of small motions: rows by the displacements and velocities of all bodies where these are still.
#include "compile/probes.hpp"
#include "compile/signal_names.hpp"
#include "dynamics/joint/travel.hpp"
#include "dynamics/spatial/rotation.hpp"

namespace froude::compile {
namespace {

using dynamics::frequency::SmallMotions;
using Eigen::RowVectorXd;
using Eigen::Vector3d;

/// An end of a connector where the bodies are still, and its arm from the centre of gravity, along global axes.
struct StillEnd {
  Vector3d position, arm;
};
StillEnd still_end(const dynamics::State& still, std::optional<int> body, const Vector3d& arm_in_body) {
  if (!body) return {arm_in_body, Vector3d::Zero()};
  const dynamics::Pose& pose = still.pose[static_cast<std::size_t>(*body)];
  const Vector3d arm = pose.attitude * arm_in_body;
  return {pose.centre + arm, arm};
}

/// Row that takes the displacement of a point fixed to a body along `direction` out of all displacements.
void add_point(RowVectorXd& row, int body, const Vector3d& arm, const Vector3d& direction, double sign) {
  row.segment<3>(6 * body) += sign * direction.transpose();
  row.segment<3>(6 * body + 3) += sign * arm.cross(direction).transpose();  // direction · (θ × arm)
}

/// Displacement of the second end less that of the first body at `first_arm`, along `direction`.
RowVectorXd stretch_row(const dynamics::Ends& ends, const Vector3d& first_arm, const Vector3d& second_arm,
                        const Vector3d& direction, Eigen::Index modes) {
  RowVectorXd row = RowVectorXd::Zero(modes);
  add_point(row, ends.first, first_arm, direction, -1);
  if (ends.second) add_point(row, *ends.second, second_arm, direction, 1);
  return row;
}

/// How roll, pitch and yaw, as motion_from_rest() tells them, change with a small global rotation: ω = ψ̇ z + θ̇ Rz y +
/// φ̇ Rz Ry x, turned round.
Eigen::Matrix3d angles_by_rotation(const dynamics::RigidBody& body, const dynamics::Pose& pose) {
  const Eigen::AngleAxisd yaw(motion_from_rest(body, pose, 5), Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(motion_from_rest(body, pose, 4), Vector3d::UnitY());
  Eigen::Matrix3d axes;
  axes << yaw * (pitch * Vector3d::UnitX()), yaw * Vector3d::UnitY(), Vector3d::UnitZ();
  return axes.inverse();
}

/// Motions of the bodies' origins.
void add_motions(const scene::Scene& scene, const Prepared& p, const SmallMotions& about,
                 std::vector<LinearProbe>& out) {
  const RowVectorXd none = RowVectorXd::Zero(about.model.modes());
  for (std::size_t b = 0; b < p.bodies.size(); ++b) {
    const dynamics::Pose& pose = about.still.pose[b];
    dynamics::Matrix6 T =
        dynamics::shift_from_centre(pose.attitude * Vector3d(-p.bodies[b].properties().centre_of_gravity.xyz));
    T.bottomRightCorner<3, 3>() = angles_by_rotation(p.bodies[b], pose);
    for (int mode = 0; mode < 6; ++mode) {
      if (!p.bodies[b].is_free(mode)) continue;
      RowVectorXd row = none;
      row.segment<6>(6 * static_cast<Eigen::Index>(b)) = T.row(mode);
      out.push_back({scene.bodies[b].name + "." + mode_name(mode), std::string(motion_unit(mode)) + "/m",
                     fmt::format("{} of {} per metre of wave amplitude", mode_name(mode), scene.bodies[b].name), row,
                     none});
    }
  }
}

void add_axial(const dynamics::AxialConnector& c, const std::string& name, const SmallMotions& about,
               std::vector<LinearProbe>& out) {
  const StillEnd first = still_end(about.still, c.ends.first, c.ends.first_arm);
  const StillEnd second = still_end(about.still, c.ends.second, c.ends.second_arm);
  const Vector3d d = second.position - first.position;
  const RowVectorXd row = stretch_row(c.ends, first.arm, second.arm, d.normalized(), about.model.modes());
  const dynamics::Answer law = c.law.at(d.norm() - c.rest_length, 0);
  out.push_back({name + ".force", "N/m", fmt::format("tension of {} per metre of wave amplitude", name), law.by_x * row,
                 law.by_rate * row});
}

/// Beyond the tensions while still; the other bodies do not change them.
void add_catenary(const dynamics::CatenaryMooring& m, const std::string& name, const SmallMotions& about,
                  std::vector<LinearProbe>& out) {
  const dynamics::TensionGradient gradient = dynamics::tension_gradient(m, about.still);
  const auto add = [&](const char* signal, const char* where, const Eigen::Matrix<double, 1, 6>& by_body) {
    RowVectorXd row = RowVectorXd::Zero(about.model.modes());
    row.segment<6>(6 * m.body) = by_body;
    out.push_back({fmt::format("{}.{}", name, signal),
                   "N/m",
                   fmt::format("tension of {} at the {} per metre of wave amplitude", name, where),
                   row,
                   {}});
  };
  add("tension", "fairlead", gradient.fairlead);
  add("anchor_tension", "anchor", gradient.anchor);
}

/// Along axes that turn with the first body, on which the second end is seen.
void add_bushing(const dynamics::BushingConnector& c, const std::string& name, const SmallMotions& about,
                 std::vector<LinearProbe>& out) {
  const StillEnd first = still_end(about.still, c.ends.first, Vector3d::Zero());
  const StillEnd second = still_end(about.still, c.ends.second, c.ends.second_arm);
  const Eigen::Quaterniond& attitude = about.still.pose[static_cast<std::size_t>(c.ends.first)].attitude;
  for (int axis = 0; axis < 3; ++axis) {
    const RowVectorXd row = stretch_row(c.ends, second.position - first.position, second.arm,
                                        attitude * Vector3d::Unit(axis), about.model.modes());
    out.push_back({name + ".force_" + "xyz"[axis], "N/m",
                   fmt::format("force of {} along {} per metre of wave amplitude", name, "xyz"[axis]),
                   c.stiffness[axis] * row, c.damping[axis] * row});
  }
}

/// Travel of sliders and hinges, and loads of all joints, beyond those while still.
void add_joints(const Prepared& p, const SmallMotions& about, std::vector<LinearProbe>& out) {
  for (std::size_t j = 0; j < p.joints.size(); ++j) {
    const dynamics::Joint& joint = p.joints[j];
    const bool turns = joint.kind == dynamics::JointKind::hinge;
    if (!turns && joint.kind != dynamics::JointKind::slider) continue;
    RowVectorXd row = RowVectorXd::Zero(about.model.modes());
    const dynamics::Gradient gradient = dynamics::Travel(p.bodies, joint).gradient(about.still);
    row.segment<6>(6 * joint.first) += p.joint_sign[j] * gradient.first.transpose();
    if (joint.second) row.segment<6>(6 * *joint.second) += p.joint_sign[j] * gradient.second.transpose();
    out.push_back({joint.name + (turns ? ".angle" : ".travel"),
                   turns ? "rad/m" : "m/m",
                   fmt::format("{} of {} per metre of wave amplitude", turns ? "angle" : "travel", joint.name),
                   row,
                   {}});
  }
  for_each_end(p, [&](int joint, dynamics::End end, const std::string& name) {
    const auto variation = about.model.joints().load_variation(joint, end, about.still, about.linear.multipliers);
    for (int i = 0; i < 6; ++i)
      out.push_back(
          {fmt::format("{}.{}", name, joint_load(i)),
           std::string(load_unit(i)) + "/m",
           fmt::format("load of the joint on {} per metre of wave amplitude, about the joint, body axes", name),
           variation.by_motion.row(i),
           {},
           variation.by_multiplier.row(i)});
  });
}

}  // namespace

std::vector<LinearProbe> rao_probes(const scene::Scene& scene, const Prepared& p, const SmallMotions& about) {
  std::vector<LinearProbe> out;
  add_motions(scene, p, about, out);
  for (std::size_t i = 0; i < p.axial.size(); ++i) add_axial(p.axial[i], p.axial_names[i], about, out);
  for (std::size_t g = 0; g < p.switched.size(); ++g)
    for (std::size_t i = 0; i < p.switched[g].connectors.size(); ++i)
      add_axial(p.switched[g].connectors[i], p.switched_names[g][i], about, out);
  for (std::size_t i = 0; i < p.bushing.size(); ++i) add_bushing(p.bushing[i], p.bushing_names[i], about, out);
  for (std::size_t i = 0; i < p.lines.size(); ++i) add_catenary(p.lines[i], scene.lines[i].name, about, out);
  add_joints(p, about, out);
  return out;
}

}  // namespace froude::compile
