#include "dynamics/state/signal.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/types.hpp"

namespace dynamics {
namespace {

using Eigen::Vector3d;

/// How roll, pitch and yaw change with a small global rotation: ω = ψ̇ z + θ̇ Rz y + φ̇ Rz Ry x, turned round.
Eigen::Matrix3d angles_by_rotation(const RigidBody& body, const Pose& pose) {
  const Eigen::AngleAxisd yaw(motion_from_rest(body, pose, 5), Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(motion_from_rest(body, pose, 4), Vector3d::UnitY());
  Eigen::Matrix3d axes;
  axes << yaw * (pitch * Vector3d::UnitX()), yaw * Vector3d::UnitY(), Vector3d::UnitZ();
  return axes.inverse();
}

}  // namespace

Variation variation_of_two(int first, const std::optional<int>& second, const RowOfTwo& by_motion,
                           const RowOfTwo& by_velocity) {
  Variation out{.parts = {{.body = first, .by_motion = by_motion.head<6>(), .by_velocity = by_velocity.head<6>()}}};
  if (second)
    out.parts.push_back({.body = *second, .by_motion = by_motion.tail<6>(), .by_velocity = by_velocity.tail<6>()});
  return out;
}

// (Q7)
std::complex<double> amplitude(const Variation& variation, const Eigen::Ref<const Eigen::VectorXcd>& xi,
                               const Eigen::Ref<const Eigen::VectorXcd>& lambda, double omega, double heading) {
  std::complex<double> out = variation.by_wave ? variation.by_wave(omega, heading) : 0.0;
  for (const Variation::Part& part : variation.parts)
    for (int mode = 0; mode < 6; ++mode) {
      const double in_phase = part.by_motion[mode] - omega * omega * part.by_acceleration[mode],
                   ahead = omega * part.by_velocity[mode];
      if (in_phase == 0 && ahead == 0) continue;  // most: a signal is of a few motions
      const std::complex<double>& x = xi[6 * part.body + mode];
      out += std::complex<double>(in_phase * x.real() - ahead * x.imag(), in_phase * x.imag() + ahead * x.real());
    }
  for (const auto& [row, factor] : variation.by_multiplier) out += factor * lambda[row];
  if (!variation.by_radiation) return out;
  const Eigen::RowVectorXcd row = variation.by_radiation->row(omega);
  for (std::size_t b = 0; b < variation.by_radiation->bodies.size(); ++b)
    for (int mode = 0; mode < 6; ++mode)
      out += row[6 * static_cast<Eigen::Index>(b) + mode] * xi[6 * variation.by_radiation->bodies[b] + mode];
  return out;
}

double motion_from_rest(const RigidBody& body, const Pose& pose, int mode) {
  if (mode >= 3) return pose.roll_pitch_yaw()[mode - 3];
  return (pose.point(body, {Vector3d::Zero()}).xyz - body.properties().rest_position.xyz)[mode];
}

Matrix6 motions_by_displacement(const RigidBody& body, const Pose& pose) {
  Matrix6 T = shift_from_centre(pose.attitude * Vector3d(-body.properties().centre_of_gravity.xyz));
  T.bottomRightCorner<3, 3>() = angles_by_rotation(body, pose);
  return T;
}

std::vector<Signal> motion_signals(const std::vector<RigidBody>& bodies) {
  std::vector<Signal> out;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int mode = 0; mode < 6; ++mode) {
      if (!bodies[b].is_free(mode)) continue;
      const std::string name(hydro::mode_names[static_cast<std::size_t>(mode)]);
      out.push_back({.name = bodies[b].name() + "." + name,
                     .unit = motion_unit(mode),
                     .meaning = fmt::format("{} of {} from rest", name, bodies[b].name()),
                     .value = [body = bodies[b], b,
                               mode](const Reading& r) { return motion_from_rest(body, r.state.pose[b], mode); },
                     .variation =
                         [body = bodies[b], b, mode](const Still& still) {
                           const Matrix6 T = motions_by_displacement(body, still.state.pose[b]);
                           return Variation{.parts = {{.body = static_cast<int>(b), .by_motion = T.row(mode)}}};
                         }});
    }
  return out;
}

namespace {

/// Three signals of a point, one an axis, that vary as its place does by motion, velocity or acceleration.
template <class Read>
std::vector<Signal> along_axes(const std::string& name, const char* prefix, const char* unit, const char* what,
                               const PointOnBody& p, Read read, Variation::Row Variation::Part::*by) {
  std::vector<Signal> out;
  for (int axis = 0; axis < 3; ++axis)
    out.push_back({.name = fmt::format("{}.{}{}", name, prefix, "xyz"[axis]),
                   .unit = unit,
                   .meaning = fmt::format("{} of {} along global {}", what, name, "xyz"[axis]),
                   .value = [read, axis](const Reading& r) -> double { return read(r)[axis]; },
                   .variation =
                       [p, axis, by](const Still& still) {
                         Variation::Part part{.body = p.body};
                         part.*by = place_by_displacement(arm_of(p, still.state)).row(axis);
                         return Variation{.parts = {part}};
                       }});
  return out;
}

/// Of the body's own mass and inertia, about its origin: m a, and dL/dt + arm × m a.
Vector6 net_load(const RigidBody& body, int index, const Reading& r) {
  const Eigen::Matrix3d R = r.state.pose[static_cast<std::size_t>(index)].attitude.toRotationMatrix();
  const Eigen::Matrix3d inertia = R * body.inertia() * R.transpose();
  const Vector6 a = r.acceleration.segment<6>(6 * index);
  const Vector3d omega = r.state.twist(index).tail<3>(), arm = R * body.properties().centre_of_gravity.xyz;
  const Vector3d force = body.mass() * a.head<3>();
  Vector6 out;
  out << force, inertia * a.tail<3>() + omega.cross(inertia * omega) + arm.cross(force);
  return out;
}

Matrix6 net_load_by_acceleration(const RigidBody& body, const Pose& pose) {
  const Eigen::Matrix3d R = pose.attitude.toRotationMatrix();
  Matrix6 out = Matrix6::Zero();
  out.topLeftCorner<3, 3>().diagonal().setConstant(body.mass());
  out.bottomLeftCorner<3, 3>() = body.mass() * cross_matrix(R * body.properties().centre_of_gravity.xyz);
  out.bottomRightCorner<3, 3>() = R * body.inertia() * R.transpose();
  return out;
}

}  // namespace

std::vector<Signal> place_signals(const std::string& name, const PointOnBody& point) {
  return along_axes(
      name, "", "m", "place", point, [point](const Reading& r) { return place_of(point, r.state); },
      &Variation::Part::by_motion);
}

std::vector<Signal> velocity_signals(const std::string& name, const PointOnBody& point) {
  return along_axes(
      name, "velocity_", "m/s", "velocity", point, [point](const Reading& r) { return velocity_of(point, r.state); },
      &Variation::Part::by_velocity);
}

std::vector<Signal> acceleration_signals(const std::string& name, const PointOnBody& point) {
  return along_axes(
      name, "acceleration_", "m/s^2", "acceleration", point,
      [point](const Reading& r) { return acceleration_of(point, r.state, r.acceleration); },
      &Variation::Part::by_acceleration);
}

std::vector<Signal> net_load_signals(const RigidBody& body, int index) {
  std::vector<Signal> out;
  for (int i = 0; i < 6; ++i)
    out.push_back({.name = fmt::format("{}.net_{}_{}", body.name(), i < 3 ? "force" : "moment", "xyz"[i % 3]),
                   .unit = load_unit(i),
                   .meaning = fmt::format("all loads on {} together, about its origin, along global {}", body.name(),
                                          "xyz"[i % 3]),
                   .value = [body, index, i](const Reading& r) { return net_load(body, index, r)[i]; },
                   .variation =
                       [body, index, i](const Still& still) {
                         const Pose& pose = still.state.pose[static_cast<std::size_t>(index)];
                         return Variation{.parts = {{.body = index,
                                                     .by_acceleration = net_load_by_acceleration(body, pose).row(i)}}};
                       }});
  return out;
}

}  // namespace dynamics
