#pragma once
/// \file  Hulls of the tests, and plain slow references for them.
#include <cmath>
#include <numbers>
#include <random>

#include "hydro/hydrostatics/immersion.hpp"
#include "support/hull_meshes.hpp"

namespace hydro::hydrostatics {

using support::box_mesh, support::cylinder_mesh, support::joined, support::sphere_mesh;

inline constexpr double degree = std::numbers::pi / 180;
inline const Water water{.density = 1000, .gravity = 9.81};
inline constexpr double rho_g = 9810;

inline Hull box(double length, double beam, double depth, double draught) {
  return Hull(box_mesh({-length / 2, -beam / 2, -draught}, {length / 2, beam / 2, depth - draught}));
}

/// Without any symmetry: a tetrahedron, a box and a sphere side by side.
inline Hull odd_hull() {
  const TriangleMesh wedge{.source = "wedge",
                           .vertices = {{6, 1, -2}, {9, -1, 1.5}, {6.5, 3, 1}, {5, -2, 2}},
                           .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  return Hull(joined({wedge, box_mesh({-2, -1.5, -1.1}, {3, 2, 0.8}), sphere_mesh({-6, 1, -0.2}, 1.4, 3)}));
}

inline Pose moved(const Pose& pose, const Eigen::Vector3d& about, const Vector6& motion) {
  const Eigen::Vector3d phi = motion.tail<3>();
  const double angle = phi.norm();
  const Eigen::Matrix3d turn = angle > 0 ? Eigen::AngleAxisd(angle, phi / angle).toRotationMatrix()
                                         : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  return {turn * pose.attitude, about + turn * (pose.position - about) + motion.head<3>()};
}

inline Pose some_pose(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vector6 motion;
  for (int i = 0; i < 6; ++i) motion[i] = (i < 3 ? 0.4 : 0.3) * normal(random);
  return moved({}, Eigen::Vector3d::Zero(), motion);
}

}  // namespace hydro::hydrostatics
