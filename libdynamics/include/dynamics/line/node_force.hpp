#pragma once
/// \file  A force on nodes of a line by where each is and how it moves: damping, a spring to a place, wind.
#include <Eigen/Core>

namespace dynamics::line {

/// Immutable and pure, so that nodes and lines may share one. Its power is booked with the damping of the line.
class NodeForce {
 public:
  /// One node at one instant: s, m, m/s, global.
  struct At {
    double time;
    Eigen::Vector3d place, velocity;
  };
  /// What it is added to, N/m and N s/m.
  struct Derivatives {
    Eigen::Matrix3d by_place = Eigen::Matrix3d::Zero(), by_velocity = Eigen::Matrix3d::Zero();
  };
  virtual ~NodeForce() = default;
  /// The force, N; its derivatives are added to `derivatives` unless that is null.
  virtual Eigen::Vector3d force(const At& at, Derivatives* derivatives) const = 0;
};

}  // namespace dynamics::line
