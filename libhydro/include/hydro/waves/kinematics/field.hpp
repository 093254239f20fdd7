#pragma once
/// \file  How the water moves anywhere under waves: elevation, velocity, acceleration and pressure at (t, x, y, z).
///
/// A WaveField answers for one instant and any points, in any order: it is a pure function of (t, point). Fields made
/// of harmonics (seas, steady nonlinear waves, bound waves) are HarmonicField; others derive from WaveField as well.
/// Equations (W11)-(W19), docs/theory/waves.md.
#include <Eigen/Core>

#include <complex>
#include <limits>
#include <span>
#include <vector>

#include "hydro/base/types.hpp"
#include "hydro/waves/kinematics/current.hpp"

namespace hydro::waves {

/// What the water does at one point and instant; SI, global axes, z up from still water.
struct Kinematics {
  double elevation;              ///< ζ above this point (x, y), m
  Eigen::Vector3d velocity;      ///< u, current included, m/s
  Eigen::Vector3d acceleration;  ///< ∂u/∂t at a fixed point, m/s²
  Eigen::Matrix3d gradient;      ///< ∂u_i/∂x_j, 1/s
  double dynamic_pressure;       ///< p + ρgz (atmosphere: p = 0), Pa

  /// Acceleration of the water itself, ∂u/∂t + (u·∇)u, m/s².
  Eigen::Vector3d material_acceleration() const { return acceleration + gradient * velocity; }
};

/// What is taken for the flow between z = 0, where linear theory ends, and the surface. Each maps z to the height z′ at
/// which the linear profile is read, (W13)-(W15).
enum class Stretching {
  none,      ///< the exponential profile goes on above z = 0: short waves on long crests are far too fast
  vertical,  ///< z′ = min(z, 0): the value at z = 0 goes up to the surface
  wheeler,   ///< z′ = (z − ζ)/(1 + ζ/h): the whole column is stretched, so the crest gets the value of z = 0
  linear,    ///< below z = 0 unchanged, above it the tangent at z = 0 goes on
  delta      ///< between Wheeler and linear, over a layer of Hs/2 (Rodenbusch & Forristall 1986)
};

/// Which form of Bernoulli's equation gives the pressure.
enum class PressureLaw {
  linear,  ///< −ρ (∂φ/∂t + U·∇φ): of first order in the waves
  full     ///< −ρ (∂φ/∂t + ½|∇φ|²) + constant: for steady nonlinear waves, exact at any height
};

/// Interface of all fields. Implementations are const and may be shared between threads.
class WaveField {
 public:
  virtual ~WaveField() = default;
  virtual const Water& water() const noexcept = 0;
  /// Whether the water is known to rest everywhere, at any time: no waves, no current.
  virtual bool is_still() const noexcept { return false; }
  /// ζ(x, y, t), m.
  virtual double elevation(double t_s, double x_m, double y_m) const = 0;
  /// All of Kinematics. Above the surface the value is that of the stretching, continued: whether a point is wet is
  /// told by z and `elevation`. \throws InputError for a point below the bed
  virtual Kinematics at(double t_s, const Eigen::Vector3d& point) const = 0;
  /// The same for many points at one instant; `out` has as many places as `points`.
  virtual void at(double t_s, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const;
};

/// One travelling harmonic of a potential flow:
///   ζ = Re(E e^{i(ωt − k·x)}),   φ = Re(Φ cosh κ(z+h)/cosh κh · e^{i(ωt − k·x)}),   κ = |k|      (W16)
/// A free linear wave has Φ = i (g/σ) E; a bound one has what the nonlinear theory gives. Plain numbers: it lives in
/// kernels.
struct Harmonic {
  double omega;                    ///< rad/s at a fixed point; zero or negative only for bound waves
  double kx, ky;                   ///< wave vector, rad/m
  std::complex<double> elevation;  ///< E, m, phase included
  std::complex<double> potential;  ///< Φ at z = 0, m²/s, phase included
};

/// Velocity potential of a profile: cosh κ(z+h)/cosh κh, sinh κ(z+h)/cosh κh, with the growing exponentials divided out
/// (W12); right from κh → 0 to infinite depth.
struct DepthProfile {
  double cosh, sinh;
};
/// κ > 0 rad/m, z >= −h in m. Both grow as e^{κz} for z > 0.
DepthProfile depth_profile(double kappa, double depth_m, double z_m);

/// A sum of harmonics, with what is above still water and a current.
class HarmonicField final : public WaveField {
 public:
  struct Options {
    Stretching stretching = Stretching::wheeler;
    PressureLaw pressure = PressureLaw::linear;
    double bernoulli_constant = 0;  ///< m²/s², added to −(∂φ/∂t + ½|∇φ|²) of PressureLaw::full
    double hs_m = std::numeric_limits<double>::quiet_NaN();  ///< of the sea; needed by Stretching::delta only
  };

  /// Nonlinear waves are given with Stretching::none, since their potential holds up to the surface.
  /// \throws InputError for a value that is not finite, and for Stretching::delta without Hs
  HarmonicField(std::vector<Harmonic> harmonics, const Water& water, const Options& options,
                Current current = Current::none());

  const Water& water() const noexcept override { return water_; }
  const std::vector<Harmonic>& harmonics() const noexcept { return harmonics_; }
  const Options& options() const noexcept { return options_; }
  const Current& current() const noexcept { return current_; }
  using WaveField::at;
  bool is_still() const noexcept override { return harmonics_.empty() && current_.is_none(); }
  double elevation(double t_s, double x_m, double y_m) const override;
  Kinematics at(double t_s, const Eigen::Vector3d& point) const override;

 private:
  std::vector<Harmonic> harmonics_;
  Water water_;
  Options options_;
  Current current_;
};

/// The height at which the linear profile is read for a point at z under an elevation ζ, and how far beyond z = 0 the
/// tangent goes on from there (zero but for Stretching::linear and delta), m. (W13)-(W15)
struct StretchedHeight {
  double z, tangent;
};
StretchedHeight stretched_height(Stretching stretching, double z_m, double elevation_m, double depth_m, double hs_m);

}  // namespace hydro::waves
