#pragma once
/// \file  How the energy of a sea is spread over frequency: one-sided spectra S(ω) of the elevation, m² s/rad.
///
///   m_n = ∫₀^∞ ω^n S(ω) dω,   variance of the elevation = m_0,   Hs = 4 √m_0        (W5)
///
/// "One-sided" means that the integral over positive ω alone is the variance; a spectrum in hertz is 2π times this one.
/// Here: what every spectrum can be asked, and the family that JONSWAP and Pierson–Moskowitz belong to. The others are
/// in spectra.hpp and spectrum_tabulated.hpp; docs/theory/waves-spectra.md derives them all.
#include <array>
#include <optional>
#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::waves {

/// A spectrum that knows its moments in any band, so that a sea made of N components can carry exactly that energy.
class Spectrum {
 public:
  virtual ~Spectrum() = default;
  /// S(ω), m² s/rad; 0 at ω = 0. \throws InputError if omega is negative or not finite
  virtual double density(double omega) const = 0;
  /// ∫ ω^n S dω from `from` to `to` (rad/s; `to` may be +∞ where the integral exists), m² (rad/s)^n, n >= −1.
  /// \throws InputError unless 0 <= from <= to, and where it diverges
  virtual double band_moment(int n, double from, double to) const = 0;
  /// The p of S ~ ω^−p at high frequency; +∞ where S falls faster than any power, or is cut off. m_n exists for n < p
  /// − 1.
  virtual double tail_power() const = 0;
  /// Frequency of the highest density, rad/s.
  virtual double peak_omega() const = 0;

  /// ∫ S dω over a band, m².
  double energy(double from, double to) const { return band_moment(0, from, to); }
  /// m_n, m² (rad/s)^n. \throws InputError for an n whose integral diverges
  double moment(int n) const;
  double hs() const;             ///< significant height 4 √m_0, m
  double tp() const;             ///< 2π / peak_omega(), s
  double mean_period() const;    ///< T_m01 = 2π m_0/m_1, s
  double tz() const;             ///< mean period of up-crossings of a Gaussian sea 2π √(m_0/m_2), s (Rice 1944)
  double energy_period() const;  ///< T_e = 2π m_−1/m_0, s

  /// The ω of a finite band from..to at which ∫ S dω from `from` up reaches `energy`; to 1e-15
  /// of the band (W46). Some twenty evaluations. \throws InputError unless 0 <= energy <= the energy of the band
  double omega_at_energy(double energy, double from, double to) const;
};

/// A spectrum given by a formula, integrated by Gauss–Legendre quadrature on panels over which the formula is smooth,
/// and by a series beyond the last panel (W31). Whole panels are integrated once, on construction; a band then costs
/// its two broken panels (16 points each) and additions, and a narrow band keeps its digits, since nothing is
/// subtracted.
class PanelSpectrum : public Spectrum {
 public:
  double density(double omega) const final;
  double band_moment(int n, double from, double to) const final;
  double tail_power() const final;

 protected:
  /// u^−p e^{−w u^−q} times a coefficient, beyond the last panel; w u^−q <= 1e-3 there.
  struct Tail {
    double coefficient, p, w, q;
  };

  /// density(ω) = scale/unit · shape(ω/unit)
  explicit PanelSpectrum(double unit_omega) : unit_(unit_omega) {}
  /// Without dimension, of u = ω/unit; asked between the first and the last panel edge only.
  virtual double shape(double u) const = 0;
  /// To be called once by the constructor that knows shape(). Edges in ω, rad/s, increasing; S = 0 below the first, and
  /// beyond the last unless there is a tail. The scale is 1 until set.
  void tabulate(std::vector<double> edges, std::optional<Tail> tail);
  /// Makes m_0 what it should be, m².
  void set_variance(double m0);

  double unit() const noexcept { return unit_; }
  double scale() const noexcept { return scale_; }

 private:
  double on_panels(int n, double from, double to) const;
  double in_tail(int n, double from, double to) const;
  double piece(int n, double from, double to) const;

  static constexpr int tabulated_orders = 6;  ///< n = −1 … 4
  double unit_;
  double scale_ = 1;
  std::vector<double> edges_;
  std::array<std::vector<double>, tabulated_orders> panels_;  ///< [n + 1][panel]
  std::optional<Tail> tail_;
};

/// u^−p e^{−(p/q) u^−q} γ^r with u = ω/ω_p and r = e^{−(u−1)²/(2σ²)} (W30): a power law, cut off below the peak, which
/// stands at u = 1 for every p and q, and may be enhanced γ-fold there.
struct PeakShape {
  double p = 5;                                   ///< tail ω^−p
  double q = 4;                                   ///< how abruptly the spectrum ends below its peak
  double gamma = 1;                               ///< peak enhancement
  double sigma_below = 0.07, sigma_above = 0.09;  ///< how wide it is either side of the peak, over ω_p: JONSWAP's
};

/// A spectrum of that shape with given Hs and Tp. Moments exist for n < p − 1 and are right to 1e-13 relative; bands,
/// however narrow, to 1e-12. The factor that makes m_0 = Hs²/16 is integrated, not approximated.
class PeakedSpectrum : public PanelSpectrum {
 public:
  /// \throws InputError unless hs_m and tp_s are finite and > 0, 1.5 <= p <= 60, 1 <= q <= 20, 1 <= gamma <= 20 and
  /// 0.01 <= σ <= 1
  PeakedSpectrum(double hs_m, double tp_s, const PeakShape& shape);

  double peak_omega() const final { return unit(); }
  const PeakShape& peak_shape() const noexcept { return shape_; }
  double gamma() const noexcept { return shape_.gamma; }

 protected:
  double shape(double u) const final;

 private:
  PeakShape shape_;
};

/// JONSWAP in terms of Hs, Tp and γ (W6): p = 5, q = 4. For γ = 1 it is the Pierson–Moskowitz spectrum. m_4 (and the
/// mean crest rate made of it) diverges: the tail falls as ω^-5.
/// Source: Hasselmann et al. 1973, Deutsche Hydrographische Zeitschrift A8 no. 12; Pierson & Moskowitz 1964, J.
/// Geophys. Res. 69.
class Jonswap final : public PeakedSpectrum {
 public:
  /// \throws InputError unless hs_m and tp_s are finite and > 0 and 1 <= gamma <= 20
  Jonswap(double hs_m, double tp_s, double gamma) : PeakedSpectrum(hs_m, tp_s, {.p = 5, .q = 4, .gamma = gamma}) {}
};

/// The spectrum of a fully developed sea in its (Hs, Tp) form, all moments closed (W7). \throws InputError as Jonswap
inline Jonswap pierson_moskowitz(double hs_m, double tp_s) { return {hs_m, tp_s, 1.0}; }

}  // namespace hydro::waves
