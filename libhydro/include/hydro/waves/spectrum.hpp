#pragma once
/// \file  How the energy of a sea is spread over frequency: one-sided spectra S(ω) of the elevation, m² s/rad.
///
///   m_n = ∫₀^∞ ω^n S(ω) dω,   variance of the elevation = m_0,   Hs = 4 √m_0        (W5)
///
/// "One-sided" means that the integral over positive ω alone is the variance; a spectrum in hertz is 2π times this one.
#include "hydro/base/types.hpp"

namespace hydro::waves {

/// A spectrum that knows its energy in any band, so that a sea made of N components can carry exactly that energy.
class Spectrum {
 public:
  virtual ~Spectrum() = default;
  /// S(ω), m² s/rad; 0 at ω = 0. \throws InputError if omega is negative or not finite
  virtual double density(double omega) const = 0;
  /// ∫ S dω from `from` to `to` (rad/s; `to` may be +∞), m². \throws InputError unless 0 <= from <= to
  virtual double energy(double from, double to) const = 0;
  /// m_n, m² (rad/s)^n. \throws InputError for an n whose integral diverges
  virtual double moment(int n) const = 0;

  double hs() const;  ///< significant height 4 √m_0, m
  double tz() const;  ///< mean period of up-crossings of a Gaussian sea 2π √(m_0/m_2), s (Rice 1944)
};

/// JONSWAP in terms of Hs, Tp and γ (W6); for γ = 1 it is the Pierson–Moskowitz spectrum.
///
/// The factor that makes m_0 = Hs²/16 is integrated, not approximated: error of density(), energy() and moment() below
/// 1e-13 relative for 1 <= γ <= 20 (a band narrower than 1e-3 ω_p: below 1e-12). Widths are σ = 0.07 below the peak and
/// 0.09 above. Moments exist for n <= 3: the tail falls as ω^-5, so m_4 (and the mean crest rate made of it) diverges.
/// Source: Hasselmann et al. 1973, Deutsche Hydrographische Zeitschrift A8 no. 12; Pierson & Moskowitz 1964, J.
/// Geophys. Res. 69.
class Jonswap final : public Spectrum {
 public:
  /// \throws InputError unless hs_m and tp_s are finite and > 0 and 1 <= gamma <= 20
  Jonswap(double hs_m, double tp_s, double gamma);

  double density(double omega) const override;
  double energy(double from, double to) const override;
  double moment(int n) const override;

  double tp() const noexcept;  ///< period of the highest density, s
  double gamma() const noexcept { return gamma_; }

 private:
  double hs_, omega_p_, gamma_;
  double scale_;  ///< density(ω) = scale_/ω_p · shape(ω/ω_p), m²
};

/// The spectrum of a fully developed sea in its (Hs, Tp) form, all moments closed (W7). \throws InputError as Jonswap
inline Jonswap pierson_moskowitz(double hs_m, double tp_s) { return {hs_m, tp_s, 1.0}; }

}  // namespace hydro::waves
