#pragma once
/// \file  The spectra that practice knows by name, and what is asked to find their parameters; sources and derivations
/// in docs/theory/waves-spectra.md. All carry m_0 = Hs²/16 exactly.
#include <memory>
#include <variant>

#include "hydro/waves/spectra/spectrum.hpp"

namespace hydro::waves {

/// One period of a sea, s; a caller must say which of the four he holds.
struct PeakPeriod {
  double s;  ///< Tp, of the highest density
};
struct ZeroCrossingPeriod {
  double s;  ///< Tz = 2π √(m_0/m_2)
};
struct MeanPeriod {
  double s;  ///< T1 = T_m01 = 2π m_0/m_1
};
struct EnergyPeriod {
  double s;  ///< Te = 2π m_−1/m_0
};
using SeaPeriod = std::variant<PeakPeriod, ZeroCrossingPeriod, MeanPeriod, EnergyPeriod>;

/// Tp of a sea of this shape with that period, s: the ratio of the two is a number of the shape alone (W32).
/// \throws InputError for a period that is not finite and positive, and as PeakedSpectrum; Tz needs p > 3
double peak_period_s(const SeaPeriod& period, const PeakShape& shape);

/// Bretschneider, also named after the ITTC and the ISSC: the shape of Pierson–Moskowitz with both parameters free.
PeakedSpectrum bretschneider(double hs_m, const SeaPeriod& period);

/// JONSWAP for a given γ from any period.
Jonswap jonswap(double hs_m, const SeaPeriod& period, double gamma);

/// γ that DNV-RP-C205 (3.5.5) relates to Tp/√Hs (W34), 1 … 5: e^{5.75 − 1.15 Tp/√Hs} with Tp in s and Hs in m, 1 from
/// Tp = 5√Hs on, and no more than 5, reached at 3.6√Hs. \throws InputError unless both are finite and > 0
double dnv_gamma(double hs_m, double tp_s);

/// JONSWAP with γ by dnv_gamma(); from another period than Tp, Tp and γ are found together (W34).
Jonswap jonswap_dnv(double hs_m, const SeaPeriod& period);

/// The γ of JONSWAP that has this Tz/Tp, 1 … 20. \throws InputError outside the ratios of that range, naming it
double jonswap_gamma(PeakPeriod peak, ZeroCrossingPeriod crossing);

/// Fully developed sea under a steady wind, Pierson & Moskowitz 1964 (W33): α g² ω^−5 e^{−0.74 (g/Uω)^4}, α = 8.1e-3.
/// \param u_19_5 wind speed 19.5 m above the sea, m/s. \throws InputError unless finite and > 0
Jonswap pierson_moskowitz_of_wind(double u_19_5, double gravity = 9.81);
/// The wind speed at 19.5 m, m/s, whose fully developed sea has this Hs.
double wind_of_pierson_moskowitz(double hs_m, double gravity = 9.81);

/// Wallops (W37): p = N by the significant steepness √m_0/λ_p, q = 4. Huang, Long, Tung, Yuen & Bliven 1981, J. Fluid
/// Mech. 112. λ_p is that of deep water. \throws InputError if the steepness leaves an N outside 3.05 … 60
PeakedSpectrum wallops(double hs_m, double tp_s, double gravity = 9.81);
/// N = |ln(2π² m_0/λ_p²)| / ln 2.
double wallops_exponent(double hs_m, double tp_s, double gravity = 9.81);

/// Several seas at once that do not know of each other: densities and moments add.
class SumSpectrum : public Spectrum {
 public:
  /// \throws InputError if there is none or a null one
  explicit SumSpectrum(std::vector<std::shared_ptr<const Spectrum>> parts);

  double density(double omega) const override;
  double band_moment(int n, double from, double to) const override;
  double tail_power() const override;  ///< the least of the parts'
  double peak_omega() const override { return peak_omega_; }
  const std::vector<std::shared_ptr<const Spectrum>>& parts() const noexcept { return parts_; }

 private:
  std::vector<std::shared_ptr<const Spectrum>> parts_;
  double peak_omega_;
};

/// Wind sea and swell, for example: sum(Jonswap{…}, GaussianSwell{…}).
template <class... Parts>
SumSpectrum sum(Parts... parts) {
  return SumSpectrum({std::make_shared<const Parts>(std::move(parts))...});
}

/// One of the two parts of Ochi & Hubble: p = 4λ + 1, q = 4.
struct OchiHubblePart {
  double hs_m;
  double tp_s;
  double lambda;  ///< > 0.125; 1 is Pierson–Moskowitz
};
/// Six-parameter spectrum of Ochi & Hubble 1976, 15th Coastal Engineering Conference (W36).
SumSpectrum ochi_hubble(const OchiHubblePart& swell, const OchiHubblePart& wind_sea);
/// The most probable member of their family for a given Hs in the North Atlantic (W36). Its six parameters were fitted
/// with parts whose sum is 0.14 % short of Hs; both heights are raised by that, so that Hs is what was asked for.
SumSpectrum ochi_hubble_most_probable(double hs_m);

/// What Torsethaugen's relations make of Hs and Tp (W38).
struct TorsethaugenSystems {
  double fully_developed_tp_s;      ///< 6.6 Hs^{1/3}: a sea with a longer Tp is swell with some wind sea
  double primary_hs, primary_tp_s;  ///< the system that Tp belongs to
  double relation_gamma;            ///< γ of the primary system as the relation gives it; below 1 in low seas
  double gamma;                     ///< what is used: the larger of that and 1
  double secondary_hs, secondary_tp_s;
  bool wind_dominated() const { return primary_tp_s <= fully_developed_tp_s; }
};
/// \throws InputError unless Hs > 0 and 2√Hs <= Tp <= 25 s (in s and m): beyond, the relations have no meaning
TorsethaugenSystems torsethaugen_systems(double hs_m, double tp_s, double gravity = 9.81);

/// Two-peaked sea of the Norwegian shelf from Hs and Tp alone, in the simplified form of Torsethaugen & Haver 2004
/// (ISOPE, paper 2004-JSC-193): both systems with p = q = 4, the primary one enhanced. Fitted to seas of some metres;
/// for Hs below about 1 m mind TorsethaugenSystems::relation_gamma. \throws InputError as torsethaugen_systems()
SumSpectrum torsethaugen(double hs_m, double tp_s, double gravity = 9.81);

/// Swell as a Gaussian hump (W39): e^{−(ω−ω_p)²/(2σ²)}, cut off 8σ from the peak (1e-15 of the energy) and at ω = 0.
class GaussianSwell final : public PanelSpectrum {
 public:
  /// \param sigma_omega  σ, rad/s. \throws InputError unless hs_m and tp_s are finite and > 0 and 0 < σ <= ω_p/3; m_−1
  /// exists for σ < ω_p/8 only
  GaussianSwell(double hs_m, double tp_s, double sigma_omega);
  double peak_omega() const override { return unit(); }

 private:
  double shape(double u) const override;
  double width_;  ///< σ/ω_p
};

/// TMA (W35): JONSWAP times Kitaigorodskii's depth factor tanh²kh/(1 + 2kh/sinh 2kh), evaluated with the k of the exact
/// dispersion relation at every depth; in infinitely deep water it is JONSWAP. Bouws, Günther, Rosenthal & Vincent
/// 1985, J. Geophys. Res. 90.
class Tma final : public PanelSpectrum {
 public:
  /// \param hs_m  of this sea, with its depth: m_0 = Hs²/16
  /// \param tp_s  of the JONSWAP factor. The depth factor rises with ω and moves the peak of the product up by a few
  ///              per cent at most (14 % for γ = 1 in very shallow water); tp() is that of the product
  /// \throws InputError as Jonswap
  Tma(double hs_m, double tp_s, double gamma, const Water& water);
  /// With the peak of the product itself at tp_s. \throws InputError as above
  static Tma with_peak(double hs_m, double tp_s, double gamma, const Water& water);

  double peak_omega() const override { return peak_omega_; }
  double jonswap_tp() const;     ///< Tp of the JONSWAP factor, s
  double deep_water_hs() const;  ///< Hs of the JONSWAP factor alone, m: the sea that the same wind raises in deep water

 private:
  double shape(double u) const override;
  PeakShape shape_;
  Water water_;
  double peak_omega_;
};

/// tanh²kh/(1 + 2kh/sinh 2kh), 0 … 1: Kitaigorodskii's factor at ω. \throws InputError as wavenumber()
double depth_factor(double omega, const Water& water);

}  // namespace hydro::waves
