#pragma once
/// \file  Layouts that several tests share.
#include <vector>

#include "hydro/cylinders/solve.hpp"

namespace hydro::cylinders {

/// Fresh water, h = 14 m.
inline Water tank(double depth = 14) {
  return {.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(depth)};
}

inline CylinderBody single(double radius, double draught, double x = 0, double y = 0) {
  return {"buoy", {x, y, 0}, Eigen::Vector3d(x, y, -draught / 2), {{{x, y}, radius, draught}}};
}

/// Module of four cylinders, D = 1.6 m, draught 1.13 m, spacing 10.4 m (Fagerbakke 2023, table 3.1).
inline CylinderBody pontoon(double x) {
  CylinderBody module{"module", {x, 0, 0}, Eigen::Vector3d(x, 0, 1.31), {}};
  for (const double dx : {-5.2, 5.2})
    for (const double y : {-5.2, 5.2}) module.cylinders.push_back({{x + dx, y}, 0.8, 1.13});
  return module;
}

/// Two bodies of unequal cylinders, without symmetry.
inline std::vector<CylinderBody> uneven() {
  CylinderBody first{"first", {0.5, -0.3, 0.4}, Eigen::Vector3d(0.2, 0.1, -0.5), {}};
  first.cylinders = {{{0, 0}, 1.0, 2.0}, {{3.1, 0.7}, 0.6, 0.9}};
  CylinderBody second{"second", {-2, 4, 0}, Eigen::Vector3d(-2, 4, -1), {}};
  second.cylinders = {{{-2, 4}, 1.3, 1.5}};
  return {first, second};
}

}  // namespace hydro::cylinders
