#pragma once
/// \file  The wave part of the Green function of one frequency: what Rankine's images leave. (G3), (G7), (G8) in
/// docs/theory/panels.md. Not installed.
#include <complex>
#include <optional>

#include "finite_wave.hpp"
#include "hydro/base/types.hpp"

namespace hydro::panels {

/// G less 1/r, less ±1/r of the image in the surface, less 1/r of that in a bed; slopes to the place of the source.
struct WavePart {
  std::complex<double> G;       ///< 1/m
  std::complex<double> G_R;     ///< along R, 1/m²
  std::complex<double> G_zeta;  ///< to the depth of the source, 1/m²
};

/// What waves have at one height: many pairs share it.
struct WaveHeight {
  double z;        ///< m, <= 0
  double decay;    ///< e^{Kz}
  double profile;  ///< of waves over a bed, FiniteWave::profile(); 0 without one
  double rise;     ///< tanh k(z + h) over a bed
};

class WaveGreen {
 public:
  /// K = ω²/g: 0 (deep water only), positive, or +∞. `reach`: the greatest R that will be asked for.
  WaveGreen(double K, const WaterDepth& depth, double reach);

  WaveHeight height(double z) const;
  /// P and Q at heights P and Q, R apart along the water; not both at one point of the surface.
  WavePart operator()(double R, const WaveHeight& P, const WaveHeight& Q) const;
  WavePart operator()(double R, double z, double zeta) const { return (*this)(R, height(z), height(zeta)); }
  /// Of the image in the surface: −1 if K = ∞, otherwise 1.
  double image_sign() const;
  double K() const { return K_; }
  double k() const { return bed_ ? bed_->k() : K_; }  ///< wavenumber
  /// True if G is Rankine's images alone: deep water with K = 0 or ∞.
  bool none() const { return !bed_ && (K_ == 0 || image_sign() < 0); }

 private:
  WavePart deep(double R, const WaveHeight& P, const WaveHeight& Q) const;
  WavePart over_bed(double R, const WaveHeight& P, const WaveHeight& Q) const;

  double K_, h_;
  std::optional<FiniteWave> bed_;
};

}  // namespace hydro::panels
