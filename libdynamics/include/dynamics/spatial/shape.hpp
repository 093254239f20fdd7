#pragma once
/// \file  Simple solid shapes and how far they are from each other.
#include <Eigen/Core>

#include <variant>

namespace dynamics {

struct Ball {
  Eigen::Vector3d centre;
  double radius;  ///< m, >= 0
};
/// A cylinder with round ends.
struct Rod {
  Eigen::Vector3d from, to;
  double radius;  ///< m, >= 0
};
/// Everything behind the plane through `point`.
struct HalfSpace {
  Eigen::Vector3d point, outward;  ///< unit
};
struct Box {
  Eigen::Vector3d centre, half;  ///< half: of its sides, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};
using Shape = std::variant<Ball, Rod, HalfSpace, Box>;

/// The shape after it has turned about the origin and then moved.
Shape moved(const Shape& shape, const Eigen::Matrix3d& turn, const Eigen::Vector3d& way);

/// How far into the shape its middle is from its surface, m: half the thinnest of it; infinite for a half-space.
double half_thickness(const Shape& shape);
/// Of the farthest point of the shape from the origin, m; infinite for a half-space.
double reach(const Shape& shape);

/// The shortest way between two shapes.
struct ClosestPoints {
  double gap;                           ///< m; negative where they overlap
  Eigen::Vector3d normal;               ///< from the first to the second, unit
  Eigen::Vector3d on_first, on_second;  ///< the points it joins, gap · normal apart
};
/// Of a ball with any shape, and of two rods; the arguments in either order (D22). Where axes cross or a ball's centre
/// is inside a box or on its surface, the way out is that of least depth. \throws hydro::InputError for other pairs
ClosestPoints closest_points(const Shape& first, const Shape& second);

}  // namespace dynamics
