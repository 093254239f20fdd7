#pragma once
/// \file  A steady current, and what it does to the length of waves. Equations (W20)-(W22), docs/theory/waves.md.
#include <Eigen/Core>

#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::waves {

/// Horizontal velocity of the water without waves, uniform or varying with depth. Immutable.
class Current {
 public:
  /// Still water.
  static Current none() { return Current({}, {}); }
  static Current uniform(const Eigen::Vector2d& velocity);

  /// Straight between heights; below the lowest and above the highest of them as there.
  /// `z_m`: at least two, strictly increasing, the last <= 0; `velocity`: as many.
  /// \throws InputError if a value is not finite, heights do not increase or the sizes differ
  static Current profile(std::vector<double> z_m, std::vector<Eigen::Vector2d> velocity);

  bool operator==(const Current&) const = default;

  bool is_none() const noexcept { return velocity_.empty(); }
  bool is_uniform() const noexcept { return velocity_.size() == 1; }
  Eigen::Vector2d at(double z_m) const;        ///< m/s; that at z = 0 above still water
  Eigen::Vector2d gradient(double z_m) const;  ///< dU/dz, 1/s; zero above still water and in a uniform current

  /// The speed that a wave of wavenumber k going towards `heading` feels, m/s (W21):
  ///   Ũ = 2k/sinh 2kh ∫ U(z)·n cosh 2k(z+h) dz,
  /// exact in a uniform current; in a shear of first order in U/c (Stewart & Joy 1974; Skop 1987 for finite depth).
  double felt_by(double k, Angle heading, double depth_m) const;

 private:
  Current(std::vector<double> z, std::vector<Eigen::Vector2d> velocity)
      : z_(std::move(z)), velocity_(std::move(velocity)) {}
  std::vector<double> z_;
  std::vector<Eigen::Vector2d> velocity_;  // empty: none; one: uniform
};

/// A wave on a current: its wavenumber and the frequency σ that somebody drifting along sees.
struct DopplerWave {
  double k;      ///< rad/m
  double sigma;  ///< rad/s, σ² = gk tanh kh
};

/// Solves ω = σ(k) + k Ũ(k) (W20) for the wave that travels towards `heading`, the shorter ones left aside.
/// Error 1e-14 relative. \throws InputError if the current stops waves of this frequency (says at which speed)
DopplerWave doppler(double omega, Angle heading, const Current& current, const Water& water);

}  // namespace hydro::waves
