#pragma once
/// \file  A wave tank by linear potential theory in one horizontal dimension: a paddle at x = 0, a beach or wall at
///        x = L, a flat bed. Equations (W70)-(W77), docs/theory/waves-nonlinear.md.
///
/// Both the travelling mode and the evanescent ones, so the water is right at the paddle itself. Small motion: the
/// paddle is taken at x = 0, the surface at z = 0.
#include <complex>
#include <limits>
#include <span>
#include <vector>

#include "hydro/base/types.hpp"
#include "hydro/waves/kinematics/field.hpp"

namespace hydro::waves {

/// Shape of a paddle's motion over the height, one at the still water.
class Paddle {
 public:
  static Paddle piston() { return Paddle(std::numeric_limits<double>::infinity()); }
  /// Turns about a hinge at this height: above the bed the paddle stands on a sill, which is at rest; below the bed the
  /// motion is partly that of a piston. \throws InputError unless hinge_z_m is finite and < 0
  static Paddle flap(double hinge_z_m);

  /// From the still water down to the hinge, m; +∞ for a piston.
  double arm() const noexcept { return arm_; }
  /// s(z), 0 … 1 for z <= 0.
  double shape(double z_m) const noexcept;

 private:
  explicit Paddle(double arm) : arm_(arm) {}
  double arm_;
};

/// What the paddle does to waves that come back to it.
enum class PaddleMode {
  reflecting,  ///< a moving wall: they are thrown back
  absorbing    ///< active absorption: they leave the tank
};

/// How far waves are followed through the tank.
struct Reflections {
  /// 0 … 1: amplitude of what comes back from the far end as a share of what arrives; 1 is a wall, and right for all
  /// modes; a beach is known by this number alone, with no phase of its own.
  double far_end = 0;
  PaddleMode paddle = PaddleMode::absorbing;
  /// Times that a wave is thrown back by a reflecting paddle. Unlimited: the steady state, which does not exist at an
  /// eigenfrequency of a tank with a wall. Limited: what has arrived until then after a start from rest.
  int round_trips = std::numeric_limits<int>::max();
};

struct Tank {
  double length_m;
  Water water;  ///< of finite depth
  Paddle paddle = Paddle::piston();
  Reflections reflections = {};
  int evanescent_modes = 30;  ///< N: rms of what is left of the paddle's velocity falls like N^−3/2, (W72)
  Stretching stretching = Stretching::vertical;  ///< none, vertical, wheeler or linear
};

/// One harmonic of a record: Re(amplitude e^{iωt}). Of a paddle: its displacement along x at the still water, m.
struct RecordHarmonic {
  double omega;
  std::complex<double> amplitude;
};

/// The tank at one frequency, per metre of paddle displacement at the still water.
class TankMode {
 public:
  /// \throws InputError if the tank or the frequency is not one (also: infinite depth, reflection outside 0 … 1), and
  /// if round trips are unlimited where the tank resonates
  TankMode(const Tank& tank, double omega);

  double omega() const noexcept { return omega_; }
  double k() const noexcept { return k_; }                                ///< of the travelling mode, rad/m
  std::span<const double> evanescent() const noexcept { return kappa_; }  ///< κ_n of (W71), rad/m
  /// Elevation at x, m/m.
  std::complex<double> elevation(double x_m) const;
  /// Elevation amplitude that the paddle sends out, far from it and before any reflection, m/m: Biésel's transfer
  /// (W73).
  std::complex<double> biesel() const;
  /// φ and what is made of it at (x, z): per metre of paddle.
  struct Flow {
    std::complex<double> phi, u, w, u_x, u_z;
  };
  /// Profiles are read at z + tangent as their tangent at z.
  Flow flow(double x_m, double z_m, double tangent_m = 0) const;

 private:
  double omega_, k_, depth_, length_, gravity_;
  std::complex<double> unreflected_, outgoing_, returning_;  // φ of the travelling mode at x = 0, 0 and L
  double far_end_;
  std::vector<double> kappa_;
  std::vector<std::complex<double>> amplitude_;  // of φ in mode n at the paddle
};

/// The tank with a given motion of its paddle. Immutable; a WaveField for 0 <= x <= L, the same for all y.
class WaveTank final : public WaveField {
 public:
  /// \throws InputError as TankMode, for an amplitude that is not finite, and for an empty motion
  WaveTank(const Tank& tank, std::vector<RecordHarmonic> paddle_motion);

  const Water& water() const noexcept override { return tank_.water; }
  const Tank& tank() const noexcept { return tank_; }
  const std::vector<RecordHarmonic>& paddle_motion() const noexcept { return motion_; }
  using WaveField::at;
  double elevation(double t_s, double x_m, double y_m = 0) const override;
  Kinematics at(double t_s, const Eigen::Vector3d& point) const override;
  /// Displacement of the paddle at the still water, m.
  double paddle(double t_s) const;

 private:
  Tank tank_;
  std::vector<RecordHarmonic> motion_;
  std::vector<TankMode> modes_;
};

/// Frequencies that are taken from a record.
struct Band {
  double omega_min, omega_max;  ///< rad/s
};

/// Fourier components of a record inside a band: x(t) = Σ Re(X_j e^{iω_j t}), ω_j = 2πj/(samples · dt). The record is
/// followed by `rest_s` of zeros first, so that waves that are slow to arrive do not run into its repetition; that must
/// be at least the time that the band's slowest wave needs to where it is looked at, arrival_time(). Energy outside the
/// band is dropped, and reported.
/// \throws InputError for an empty record, a value that is not finite, a band that is empty or reaches the Nyquist
/// frequency
struct RecordSpectrum {
  std::vector<RecordHarmonic> harmonics;
  double repetition_s;
  double fraction_left_out;  ///< of Σ x², 0 … 1
};
RecordSpectrum record_spectrum(std::span<const double> samples, double dt_s, double rest_s, const Band& band);

/// Time after which the energy of the slowest wave of the band has come from the paddle to x, straight on, s.
double arrival_time(const Water& water, const Band& band, double x_m);

/// The inverse: the motion of the paddle that gives these harmonics of the elevation at x in the tank, with its
/// reflections. \throws InputError for a frequency at which this paddle makes no wave there (transfer below 1e-6)
std::vector<RecordHarmonic> paddle_motion_for(const Tank& tank, std::span<const RecordHarmonic> elevation, double x_m);

}  // namespace hydro::waves
