#pragma once
/// \file  How the energy of one frequency is spread over directions: D(θ; ω), 1/rad, with ∫ D dθ = 1 over a full turn.
/// Formulas and sources: docs/theory/waves-spectra.md, (W41)-(W46).
#include <optional>
#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::waves {

/// Interface of all spreading functions. θ is measured from the mean heading, −π … π; S(ω, θ) = S(ω) D(θ; ω).
/// Integrals are one to 1e-10, and share_below() is right to 1e-10 absolute, if a class does not say otherwise.
class Spreading {
 public:
  virtual ~Spreading() = default;
  /// D(θ; ω), 1/rad. Periodic in θ. \throws InputError unless omega is finite and > 0
  virtual double density(Angle from_mean, double omega) const = 0;
  /// Share of the energy between −π and θ, 0 … 1. \throws InputError unless −π <= θ <= π, and as density()
  virtual double share_below(Angle from_mean, double omega) const = 0;
  /// The θ with this share of the energy below it, −π … π, to rounding of share_below (W46); some ten evaluations.
  /// \throws InputError unless 0 <= share <= 1
  Angle quantile(double share, double omega) const;
  /// r_1 = |∫ D e^{iθ} dθ|, 0 (no direction) … 1 (one direction).
  virtual double first_harmonic(double omega) const = 0;
  /// Circular standard deviation √(2 (1 − r_1)), the "directional width" of Kuik, van Vledder & Holthuijsen 1988.
  Angle width(double omega) const;
};

/// The s of cos^{2s}(θ/2), for all frequencies alike or falling off on both sides of the peak (W42).
class SpreadingExponent {
 public:
  /// \throws InputError unless 0 <= s <= 5000
  static SpreadingExponent constant(double s);
  /// s_max (ω/ω_p)^5 up to the peak and s_max (ω/ω_p)^−2.5 beyond; Goda gives s_max 10 for wind waves, 25 for swell
  /// that has travelled a short way, 75 a long way. \throws InputError unless 0 < s_max <= 5000 and omega_p is finite
  /// and > 0
  static SpreadingExponent goda(double s_max, double omega_p);
  /// The same with s_max = 11.5 (ω_p U/g)^−2.5, U 10 m above the sea: Mitsuyasu et al. 1975, J. Phys. Oceanogr. 5.
  static SpreadingExponent mitsuyasu(double u_10, double omega_p, double gravity = 9.81);
  double at(double omega) const;

 private:
  SpreadingExponent(double s, std::optional<double> omega_p) : s_(s), omega_p_(omega_p) {}
  double s_;
  std::optional<double> omega_p_;
};

/// D ∝ cos^{2s}(θ/2) (W41). \throws InputError of SpreadingExponent
class Cos2sSpreading final : public Spreading {
 public:
  explicit Cos2sSpreading(const SpreadingExponent& s) : s_(s) {}
  double density(Angle from_mean, double omega) const override;
  double share_below(Angle from_mean, double omega) const override;
  double first_harmonic(double omega) const override;

 private:
  SpreadingExponent s_;
};

/// D ∝ cos^n θ for |θ| < π/2, else 0 (W41).
class CosNSpreading final : public Spreading {
 public:
  /// \throws InputError unless 0 <= n <= 1e4
  explicit CosNSpreading(double n);
  double density(Angle from_mean, double omega) const override;
  double share_below(Angle from_mean, double omega) const override;
  double first_harmonic(double omega) const override;

 private:
  double n_, scale_;
};

/// A normal distribution wound round the circle (W43).
class WrappedNormalSpreading final : public Spreading {
 public:
  /// \throws InputError unless 1e-4 rad <= sigma <= 10 rad (where it is uniform to 1e-21)
  explicit WrappedNormalSpreading(Angle sigma);
  double density(Angle from_mean, double omega) const override;
  double share_below(Angle from_mean, double omega) const override;
  double first_harmonic(double omega) const override;

 private:
  double sigma_;
  int turns_;  ///< either way that count
};

/// D ∝ e^{κ cos θ} (W44), also called Poisson's or the circular normal distribution.
class VonMisesSpreading final : public Spreading {
 public:
  /// \throws InputError unless 0 <= kappa <= 1e8
  explicit VonMisesSpreading(double kappa);
  double density(Angle from_mean, double omega) const override;
  double share_below(Angle from_mean, double omega) const override;
  double first_harmonic(double omega) const override;

 private:
  double from_zero(double theta) const;  ///< ∫_0^θ e^{κ (cos t − 1)} dt
  double kappa_, panel_, reach_, whole_;
};

/// Straight lines between the points of a table, the same for all frequencies (W45); D = 0 outside the table.
class TabulatedSpreading final : public Spreading {
 public:
  /// \param theta    from the mean heading, rad, increasing, −π … π
  /// \param density  1/rad, >= 0
  /// A table whose integral is within 1e-3 of one is divided by it; raw_integral() tells.
  /// \throws InputError for fewer than two points, angles that do not increase, a density that is negative or not
  /// finite, and an integral that is further off, saying by how much
  TabulatedSpreading(std::vector<double> theta, std::vector<double> density);
  double density(Angle from_mean, double omega) const override;
  double share_below(Angle from_mean, double omega) const override;
  double first_harmonic(double omega) const override;
  double raw_integral() const noexcept { return raw_integral_; }  ///< of the table as given

 private:
  std::vector<double> theta_, density_;
  std::vector<double> share_;  ///< below each point
  double raw_integral_;
};

}  // namespace hydro::waves
