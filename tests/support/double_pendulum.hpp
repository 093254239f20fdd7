#pragma once
/// \file  Two slender rods on hinges under gravity, let go level: a motion that is smooth, large and not linear.
#include "dynamics/force/gravity.hpp"
#include "dynamics/model/model.hpp"

namespace support {

constexpr double rod_length = 1, rod_mass = 2, rod_gravity = 9.81;

inline dynamics::RigidBody rod(const std::string& name, double middle) {
  const double across = rod_mass * rod_length * rod_length / 12;
  return dynamics::RigidBody({.name = name,
                              .mass = rod_mass,
                              .inertia = Eigen::Vector3d(across / 50, across, across).asDiagonal(),
                              .rest_position = {Eigen::Vector3d(middle, 0, 0)}});
}

/// Hinges at x = 0 and x = 1 m; the second turned by `twist` about the rods, so that motion leaves the plane.
inline dynamics::Model double_pendulum(double twist = 0) {
  std::vector<dynamics::RigidBody> bodies{rod("upper", 0.5 * rod_length), rod("lower", 1.5 * rod_length)};
  const auto hinge = [](const char* name, int first, std::optional<int> second, double at, double angle) {
    return dynamics::Joint{.name = name,
                           .kind = dynamics::JointKind::hinge,
                           .first = first,
                           .second = second,
                           .place = {at, 0, 0},
                           .axis = {0, std::cos(angle), std::sin(angle)}};
  };
  std::vector<dynamics::Joint> joints{hinge("top", 0, {}, 0, 0), hinge("middle", 0, 1, rod_length, twist)};
  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  forces.push_back(std::make_unique<dynamics::GravityKind>(bodies, rod_gravity));
  return {std::move(bodies), {}, std::move(forces), std::move(joints)};
}

inline double height_energy(const dynamics::State& state) {
  return rod_mass * rod_gravity * (state.pose[0].centre.z() + state.pose[1].centre.z());
}

}  // namespace support
