#pragma once
/// \file  Cylinders and spheres in still water without a mesh: exact to rounding at any pose.
#include <Eigen/Core>

#include "hydro/hydrostatics/immersion.hpp"

namespace hydro::hydrostatics {

/// A circular cylinder with flat ends. Any direction of its axis.
struct CircularCylinder {
  Eigen::Vector3d from, to;  ///< middles of the ends, m
  double radius;             ///< m
};

struct Sphere {
  Eigen::Vector3d centre;  ///< m
  double radius;           ///< m
};

/// \throws InputError unless all is finite, the radius positive and the ends apart
void check(const CircularCylinder& cylinder);
void check(const Sphere& sphere);

/// What of the shape is under water, as of a hull (P80), (P81). `pose` carries the shape as drawn to where it is, and
/// must be a finite rigid motion. Relative error 1e-13 of the shape's volume and moments.
Immersion immersion(const CircularCylinder& cylinder, const Pose& pose);
Immersion immersion(const Sphere& sphere, const Pose& pose);

}  // namespace hydro::hydrostatics
