#pragma once
/// \file  The drag of a steady wind on an area above the water. (D135)
#include <Eigen/Core>

#include <cmath>
#include <string>

#include "hydro/base/error.hpp"

namespace dynamics {

/// F = ½ρCA |U − v| (U − v) with the velocity v of the point, a law of PointForceKind.
struct WindDrag {
  Eigen::Vector3d wind;  ///< U, global, m/s
  double resistance;     ///< ½ρCA, kg/m

  Eigen::Vector3d force(const Eigen::Vector3d& v) const { return resistance * (wind - v).norm() * (wind - v); }
  /// −½ρCA (|u| 1 + u uᵀ/|u|), u = U − v: twice as much along the wind as across it.
  Eigen::Matrix3d by_velocity(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d u = wind - v;
    const double speed = u.norm();
    if (speed == 0) return Eigen::Matrix3d::Zero();  // flat there
    return -resistance * (speed * Eigen::Matrix3d::Identity() + u * u.transpose() / speed);
  }
};

/// Wind speed at a height above still water by a power law, U_H (z/H)^α, m/s, from that at a reference height.
/// \param exponent  α: 0 the same at all heights; some 0.12 over the open sea
/// \throws hydro::InputError unless both heights are above the water and α is 0 … 1
inline double wind_at(double height, double speed_at_reference, double reference, double exponent) {
  hydro::require(height > 0, "the wind acts {:.4g} m below still water, where there is none", -height);
  hydro::require(reference > 0 && exponent >= 0 && exponent <= 1,
                 "a wind profile needs a reference height above the water and an exponent of 0 to 1");
  return speed_at_reference * std::pow(height / reference, exponent);
}

}  // namespace dynamics
