#pragma once
/// \file  Rigid bodies and where they are.
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <string>
#include <vector>

#include "dynamics/spatial/frame.hpp"
#include "hydro/base/state_bytes.hpp"

namespace dynamics {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

/// A rigid body. Constructed means usable: the constructor refuses what physics forbids.
class RigidBody {
 public:
  struct Properties {
    std::string name;
    double mass = 0;                                               ///< kg, > 0
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();             ///< about the centre of gravity, body axes, kg m²
    Vec3<World> rest_position = {Eigen::Vector3d::Zero()};         ///< of the body's origin
    Vec3<BodyAxes> centre_of_gravity = {Eigen::Vector3d::Zero()};  ///< from the origin
    std::array<bool, 6> free = {true, true, true, true, true, true};  ///< modes that may move, global axes
  };
  /// \throws hydro::InputError if the mass is not positive, or the inertia is not positive definite in the free
  /// rotations
  explicit RigidBody(Properties properties);

  const Properties& properties() const { return p_; }
  const std::string& name() const { return p_.name; }
  double mass() const { return p_.mass; }
  const Eigen::Matrix3d& inertia() const { return p_.inertia; }
  /// Centre of gravity at rest, global.
  Eigen::Vector3d rest_centre() const { return p_.rest_position.xyz + p_.centre_of_gravity.xyz; }
  bool is_free(int mode) const { return p_.free[static_cast<std::size_t>(mode)]; }

 private:
  Properties p_;
};

/// Where a body is: its centre of gravity in global axes, and its attitude.
struct Pose {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  /// Roll, pitch and yaw where they were counted last, by JointSet::count_turns(), rad.
  Eigen::Vector3d counted = Eigen::Vector3d::Zero();

  /// Roll, pitch and yaw, the nearest to those counted last: they run on through half and whole turns (D133).
  Eigen::Vector3d roll_pitch_yaw() const;
  /// Displacement from rest: translation of the centre of gravity from where it rests, and the rotation vector (global
  /// axes).
  Vector6 displacement(const Eigen::Vector3d& rest_centre) const;
  /// Global position of a point given from the body's origin in body axes.
  Vec3<World> point(const RigidBody& body, const Vec3<BodyAxes>& from_origin) const;
  void keep_state(hydro::StateBytes& bytes) { bytes.pass(centre, attitude.coeffs(), counted); }
};

/// Poses, velocities and time of all bodies. Velocity of body i: rows 6i…6i+5, the centre's velocity and the angular
/// velocity, both in global axes.
struct State {
  double time = 0;
  std::vector<Pose> pose;
  Eigen::VectorXd velocity;
  /// Angles of hinges where they were counted last, by JointSet::count_turns(), rad; one a joint of the model, of
  /// others 0. Empty: none was.
  std::vector<double> hinge_angle = {};

  auto twist(int body) const { return velocity.segment<6>(6 * body); }
  void keep_state(hydro::StateBytes& bytes) { bytes.pass(time, pose, velocity, hinge_angle); }
};

/// The state after every body has moved by `displacement` (translation and small global rotation), all else as it was.
State moved(const State& state, const Eigen::VectorXd& displacement);
/// The same, into a state that has room: of the size of `from` it asks for no memory.
void move(const State& from, const Eigen::VectorXd& displacement, State& to);

/// Every body at rest where the model places it.
State rest_state(const std::vector<RigidBody>& bodies);

/// Motion (or velocity) of the body's origin from that of its centre of gravity, small rotations: displacement or
/// twist, each 6 numbers. Exact for velocities when `offset` is the origin seen from the centre in global axes.
Matrix6 shift_from_centre(const Eigen::Vector3d& offset);

}  // namespace dynamics
