#pragma once
/// \file  How the potential of a wave motion varies over the depth: one propagating and countably many evanescent
/// modes.
///
///   ω²/g = K = k tanh kh = −κ_n tan κ_n h                             (C1)
///   Z_0 = cosh k(z+h)/√N_0,  Z_n = cos κ_n(z+h)/√N_n,  (1/h)∫Z_n Z_l dz = δ_nl    (C2)
#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::cylinders {

/// The n-th evanescent root of (C1), rad/m: the one with (n − ½)π < κh < nπ. n may be any real number >= 1 (the tails
/// of sums need it between integers). Accurate to 4e-16 relative. `K` may be +∞ (no wave: κh = (n − ½)π).
double evanescent_root(double n, double K, double depth);

/// The modes of one frequency in water of one finite depth.
struct VerticalModes {
  double depth;               ///< h, m
  double K;                   ///< ω²/g, 1/m; +∞ for the limit ω → ∞
  double k;                   ///< wavenumber of the propagating mode, rad/m; 0 if there is none (ω → ∞)
  std::vector<double> kappa;  ///< κ_1, κ_2, …, rad/m; index n − 1

  /// \throws InputError unless omega is finite and > 0 and the depth finite
  static VerticalModes at(double omega, const Water& water, int evanescent);
  /// ω → ∞: the surface is a surface of no potential. \throws InputError unless the depth is finite
  static VerticalModes at_infinite_frequency(const WaterDepth& depth, int evanescent);

  bool has_wave() const { return k > 0; }
  double norm(double kappa_n) const;   ///< N_n of an evanescent mode (C2)
  double cos_at_surface(int n) const;  ///< cos κ_n h
  double sin_at_surface(int n) const;  ///< sin κ_n h
  double wave_norm_scaled() const;     ///< N_0 e^{−2kh}, which does not overflow
  double wave_at_surface() const;      ///< Z_0(0)
};

}  // namespace hydro::cylinders
