#pragma once
/// \file  The water's surface about bodies in a regular wave, to first order.
///
/// All elevations are complex amplitudes per metre of the amplitude of the incident wave, Re(η e^{iωt}), of a wave that
/// has its crest at the global origin at t = 0 (P1), (P2): η = −(iω/g) φ at z = 0.
#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

#include "hydro/potential/body_drift.hpp"
#include "hydro/potential/far_field.hpp"
#include "hydro/potential/hull_pressure.hpp"

namespace hydro::potential {

/// One wave, what the bodies do in it, and where the surface is asked for.
struct FieldQuestion {
  double omega;             ///< rad/s, finite and positive
  double heading;           ///< rad, where the wave goes
  Eigen::VectorXcd motion;  ///< (6N), of the bodies about their reference points, m/m and rad/m; zeros: held still
  Eigen::MatrixX2d point;   ///< x and y, global, m
  bool pressure = false;    ///< on hulls too; only of panels that are solved together
  bool drift = false;       ///< of each body by itself too
};

/// The surface at these points.
struct WaveField {
  Eigen::VectorXcd incident;   ///< without any body
  Eigen::VectorXcd scattered;  ///< added by the bodies if they are held still
  Eigen::VectorXcd radiated;   ///< added by their motion
  /// False where nothing is told, and scattered and radiated are 0: inside a body, where there is no surface, and where
  /// the method does not reach, as it says.
  std::vector<bool> known;
  /// How far the surface is off by what the method truncates: the largest difference at a known point that a finer
  /// computation makes, over the largest elevation.
  double estimate = 0;
  FarField far = {};                          ///< the same waves far away
  std::optional<HullPressure> on_hulls = {};  ///< where it is asked for
  std::optional<BodyDrift> on_bodies = {};    ///< where it is asked for

  Eigen::VectorXcd total() const { return incident + scattered + radiated; }
};

/// e^{−ik(x cos β + y sin β)} at each point, `wavenumber` k.
Eigen::VectorXcd incident_elevation(const Eigen::MatrixX2d& point, double wavenumber, double heading);

/// The largest difference between two fields of the same points, where both are known, over the largest elevation of
/// `finer`. 0 where none is known.
double difference(const WaveField& coarser, const WaveField& finer);

/// \throws InputError unless omega is finite and positive, the heading finite, the points finite and at least one, and
/// `motion` has 6 finite entries a body
void check(const FieldQuestion& question, std::size_t bodies);

}  // namespace hydro::potential
