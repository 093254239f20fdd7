#pragma once
/// \file  Paths through given places, along which nodes of lines move. (D87)
#include <vector>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// The natural cubic spline through places at increasing times: velocity and acceleration are continuous. Before the
/// first time and after the last it stays where it is.
class SplinePath final : public Path {
 public:
  /// \throws hydro::InputError for fewer than two places, times that do not increase, or values that are not finite
  SplinePath(std::vector<double> time, const std::vector<Eigen::Vector3d>& places);
  Place at(double t_s) const override;

 private:
  std::vector<double> time_;
  Places place_, bend_;  // and second derivatives
};

}  // namespace dynamics::line
