#pragma once
/// \file  Numbers that the elements of a model tell: in a run, and for small motions about rest.
///
/// An element publishes each of its signals once: what it is called, its unit and meaning, how it is read off a run,
/// and how it varies with small motions. Runs read values, responses per metre of wave take variations. Laws, run by
/// tests/laws/signal_laws.hpp: a variation is the derivative of the value; a signal without one says why.
#include <Eigen/Core>

#include <complex>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/state/body.hpp"
#include "dynamics/state/point.hpp"

namespace dynamics {

class Memory;

/// What a signal of a model is read off: one instant of a run.
struct Reading {
  const State& state;
  const Eigen::VectorXd& acceleration;  ///< (6N), m/s² and rad/s², of the centres of gravity
  const Eigen::VectorXd& multipliers;   ///< λ of the joints, then of what an integrator has closed
  Eigen::Index of_joints;               ///< how many of them are the joints' own
  Memory* memory;                       ///< of the kind of force whose signal it is; null if it has none
};

/// How a signal varies with small motions about a still state: rows by the displacement (translation and small global
/// rotation), velocity and acceleration of the centres of gravity of single bodies; by multipliers of joints; by waves,
/// those that come in and those that motions make.
struct Variation {
  using Row = Eigen::Matrix<double, 1, 6>;
  struct Part {
    int body;
    Row by_motion = Row::Zero(), by_velocity = Row::Zero(), by_acceleration = Row::Zero();
  };
  std::vector<Part> parts = {};
  std::vector<std::pair<Eigen::Index, double>> by_multiplier = {};
  /// Per metre of a wave η = Re(e^{iωt}) at the origin that goes along `heading`, rad; empty: none.
  std::function<std::complex<double>(double omega, double heading)> by_wave = {};
  /// A row by displacements that depends on the frequency, as loads of radiated waves do; empty: none.
  struct Radiated {
    std::vector<int> bodies;                               ///< six entries of the row each, in this order
    std::function<Eigen::RowVectorXcd(double omega)> row;  ///< per m and rad of Re(ξ e^{iωt})
  };
  std::optional<Radiated> by_radiation = {};
};

/// A state without velocities, and the multipliers of the joints that carry what the loads ask of them there; both must
/// stay as they are.
class Still {
 public:
  Still(const State& still, const Eigen::VectorXd& lambda) : state(still), multipliers(lambda) {}
  const State& state;
  const Eigen::VectorXd& multipliers;

  /// Variations that an element tells several signals of at once: make() is called when the first of them asks.
  template <class Make>
  const std::vector<Variation>& once(const void* element, Make make) const {
    const auto [at, fresh] = made_.try_emplace(element);
    if (fresh) at->second = make();
    return at->second;
  }

 private:
  mutable std::map<const void*, std::vector<Variation>> made_;
};

/// Rows by the twelve displacements, velocities or accelerations of two bodies, (first, second).
using RowOfTwo = Eigen::Matrix<double, 1, 12>;
/// The variation of a number between two bodies; without a second the ground is there, which stays.
Variation variation_of_two(int first, const std::optional<int>& second, const RowOfTwo& by_motion,
                           const RowOfTwo& by_velocity = RowOfTwo::Zero());

/// The amplitude that a variation tells, of displacements ξ (6N), multipliers λ and a wave, Re(… e^{iωt}) per metre.
std::complex<double> amplitude(const Variation& variation, const Eigen::Ref<const Eigen::VectorXcd>& xi,
                               const Eigen::Ref<const Eigen::VectorXcd>& lambda, double omega, double heading);

/// A signal of an element. Units are SI, words those of results: "hinge.angle", "rad", "angle of hinge, …".
struct Signal {
  std::string name, unit, meaning;
  std::function<double(const Reading&)> value;
  std::function<Variation(const Still&)> variation = {};  ///< empty where there is none, and then
  std::string no_variation = {};                          ///< why
  std::optional<std::size_t> kind = {};  ///< place of the force kind in its model, set by Model::signals()
};

inline const char* motion_unit(int mode) { return mode < 3 ? "m" : "rad"; }
inline const char* load_unit(int mode) { return mode < 3 ? "N" : "N m"; }

/// Motion of a body's origin from rest, m or rad: rotations are yaw about z, then pitch about the new y, then roll
/// about the newest x, and run on from those that the pose has counted (D133).
double motion_from_rest(const RigidBody& body, const Pose& pose, int mode);

/// How the motions of a body's origin, as motion_from_rest() tells them, vary with displacement of its centre of
/// gravity: row by mode.
Matrix6 motions_by_displacement(const RigidBody& body, const Pose& pose);

/// Motions of the free modes of all bodies, called like "m1.heave".
std::vector<Signal> motion_signals(const std::vector<RigidBody>& bodies);

/// Where a point is, how fast it goes and how its velocity changes, along global axes: "bow.x", "bow.velocity_x",
/// "bow.acceleration_x".
std::vector<Signal> place_signals(const std::string& name, const PointOnBody& point);
std::vector<Signal> velocity_signals(const std::string& name, const PointOnBody& point);
std::vector<Signal> acceleration_signals(const std::string& name, const PointOnBody& point);

/// All loads on a body together, its weight among them, about its origin along global axes: what its own mass answers
/// with m a and d(I ω)/dt. Called "m1.net_force_x" … "m1.net_moment_z".
std::vector<Signal> net_load_signals(const RigidBody& body, int index);

}  // namespace dynamics
