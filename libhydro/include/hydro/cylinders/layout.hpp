#pragma once
/// \file  Rigid bodies made of vertical circular cylinders, and what still water does to them.
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::cylinders {

/// A circular cylinder with a vertical axis and flat ends.
struct Cylinder {
  Eigen::Vector2d centre;          ///< x, y of the axis, global, m
  double radius;                   ///< a, m
  std::optional<double> draught;   ///< d, of its bottom, m; empty: it stands on the sea bed
  std::optional<double> top = {};  ///< t, depth of its top, m; empty: it pierces the surface, its top above all water
};

/// Cylinders that move as one. What joins them does not touch the water.
struct CylinderBody {
  std::string name;
  Eigen::Vector3d reference_point;                   ///< of motions and moments, global, m
  std::optional<Eigen::Vector3d> centre_of_gravity;  ///< global, m; without it there is no restoring matrix
  std::vector<Cylinder> cylinders;
};

/// \throws InputError naming body and cylinder: a radius, draught or position that is not finite, a radius or draught
/// that is not positive, a draught that reaches the bottom, a top that is not under water or not above the bottom of
/// its cylinder, cylinders (of any bodies) that overlap or touch, a body without cylinders, no body
void check(const std::vector<CylinderBody>& bodies, const WaterDepth& depth);

/// What a body displaces at rest.
struct Displacement {
  double volume;                       ///< m³
  Eigen::Vector3d centre_of_buoyancy;  ///< global, m
};
Displacement displacement(const CylinderBody& body, const WaterDepth& depth);

/// C of one body about its reference point, in balance: its weight is that of the water it displaces (P12).
/// \throws InputError unless the centre of gravity is given and no cylinder stands on the bottom
Eigen::Matrix<double, 6, 6> restoring(const CylinderBody& body, const Water& water);

}  // namespace hydro::cylinders
