#pragma once
/// \file  Regular waves of finite height that run without change of form over a flat bed: Stokes' expansions of second
///        and fifth order and the stream function method. Equations (W50)-(W57), docs/theory/waves-nonlinear.md.
///
///   η = Σ E_j cos jθ,   φ = Ū_E x + Σ B_j cosh jk(z+h)/cosh jkh · sin(−jθ),   θ = ωt − kx      (W50)
#include <variant>
#include <vector>

#include "hydro/base/types.hpp"
#include "hydro/waves/kinematics/field.hpp"

namespace hydro::waves {

/// Crest to crest, m.
class Wavelength {
 public:
  static Wavelength from_metres(double length);  ///< \throws InputError unless finite and > 0
  double metres() const noexcept { return length_; }

 private:
  explicit Wavelength(double length) : length_(length) {}
  double length_;
};

/// What is known of the water's mean motion along the wave, m/s; positive with the wave.
struct EulerianCurrent {
  double velocity = 0;  ///< mean over time at a fixed point that is always wet
};
struct TransportVelocity {
  double velocity = 0;  ///< mean volume flux through a fixed section, over the depth; zero in a closed tank
};

/// A wave as it is asked for. The frequency is that at a fixed point.
struct SteadyWaveInput {
  double height_m;  ///< crest to trough
  std::variant<AngularFrequency, Wavelength> length;
  Water water = {};
  std::variant<EulerianCurrent, TransportVelocity> mean_flow = EulerianCurrent{};
};

/// A regular wave of finite height. z = 0 is the mean of the elevation over a length.
struct SteadyWave {
  Water water;
  double height;                  ///< H, m
  double k;                       ///< rad/m
  double omega;                   ///< rad/s at a fixed point
  double phase_velocity;          ///< c = ω/k, m/s
  double eulerian_current;        ///< Ū_E, m/s
  double transport_velocity;      ///< Ū_S, m/s; equal to Ū_E in infinite depth
  double wave_flux;               ///< h (Ū_S − Ū_E), m²/s: volume that the waves themselves carry
  double bernoulli;               ///< K of (W53), m²/s²
  std::vector<double> elevation;  ///< E_j, j = 1 … N, m
  std::vector<double> potential;  ///< B_j, j = 1 … N, m²/s
  double kinematic_residual;      ///< (W54), relative
  double dynamic_residual;        ///< (W55), relative

  double crest() const;   ///< m above z = 0
  double trough() const;  ///< m, negative

  /// The wave as a field, going towards `heading`, a crest at the origin when ωt + phase = 0. No stretching; its
  /// pressure is zero on the surface but for dynamic_residual.
  HarmonicField field(Angle heading = Angle::from_radians(0), double phase_rad = 0) const;
};

/// Stokes' second order. \throws InputError for a height, length, current or water that no wave can have: not finite,
/// not positive, running against a current as fast as itself, a transport velocity in infinite depth (it is the
/// current)
SteadyWave stokes_second(const SteadyWaveInput& input);

/// Stokes' fifth order (Fenton 1985). Error O((kH/2)⁶) in deep water; useless where Hλ²/h³ is large, see limits.hpp.
/// \throws InputError as stokes_second(). \throws NumericsError if no length belongs to this period
SteadyWave stokes_fifth(const SteadyWaveInput& input);

struct StreamFunctionOptions {
  int harmonics = 0;         ///< N; 0: 16, 32, 64, 128 or 256, the first that meets the tolerance
  double tolerance = 1e-11;  ///< greatest residual of (W54) and (W55); if N is given it is only reported
};

/// Stream function of N harmonics (Rienecker & Fenton 1981; Fenton 1988), right at any depth and for heights up to
/// about 95 % of the highest. Solved by Gauss–Newton with the height raised in steps, (W56), (W57). Cost O(N³). \throws
/// InputError as stokes_second(), and for a wave above the highest one (W60). \throws NumericsError if the tolerance is
/// not met with 256 harmonics (says what was reached)
SteadyWave stream_function(const SteadyWaveInput& input, const StreamFunctionOptions& options = {});

}  // namespace hydro::waves
