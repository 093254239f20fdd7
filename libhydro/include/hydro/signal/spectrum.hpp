#pragma once
/// \file  One-sided variance spectra, their moments, and the heights and periods read from them; (S4),
/// docs/theory/signal.md.
///
/// A density per hertz and one per rad/s differ by 2π: they are two types, and converting is a call.
#include <span>
#include <vector>

namespace hydro::signal {

/// One-sided: ∫₀^∞ density df is the variance. Frequencies increase, from 0 on.
struct SpectrumPerHz {
  std::vector<double> frequency_hz;
  std::vector<double> density;  ///< (unit of the signal)²/Hz
};

/// One-sided: ∫₀^∞ density dω is the variance.
struct SpectrumPerRadS {
  std::vector<double> omega;    ///< rad/s
  std::vector<double> density;  ///< (unit of the signal)²/(rad/s)
};

SpectrumPerRadS per_rad_s(const SpectrumPerHz& spectrum);
SpectrumPerHz per_hz(const SpectrumPerRadS& spectrum);

/// The band over which moments are integrated; m₂ and m₄ of a spectrum with tail f⁻⁵ depend on its upper end.
struct Band {
  double from_hz = 0;
  double to_hz;
};
/// All of the spectrum.
Band whole(const SpectrumPerHz& spectrum);

/// m_n = ∫ fⁿ S(f) df over a band, by the trapezium rule on the spectrum's own points inside it (error O(Δf²) for a
/// smooth spectrum; exact, by Parseval, for m₀ of a Welch estimate). m_minus1 begins at the first positive frequency.
struct Moments {
  double m_minus1, m0, m1, m2, m4;  ///< unit² · Hzⁿ
  Band band;                        ///< first and last point that took part

  double hs() const;       ///< 4 √m₀, also written Hm0
  double te() const;       ///< m₋₁/m₀, energy period, s
  double tm01() const;     ///< m₀/m₁, s
  double tm02() const;     ///< √(m₀/m₂), s: mean up-crossing period of a Gaussian signal (Rice)
  double epsilon() const;  ///< √(1 − m₂²/(m₀m₄)), 0 … 1 (Cartwright & Longuet-Higgins 1956)
  double nu() const;       ///< √(m₀m₂/m₁² − 1) (Longuet-Higgins 1975)
};
/// \throws InputError if frequencies do not increase from 0 or above, a density is negative or not finite, or fewer
/// than two points lie in the band, or all of them are zero
Moments moments(const SpectrumPerHz& spectrum, const Band& band);

/// The highest point of a spectrum.
struct Peak {
  double frequency_hz;
  double density;
  bool at_edge;  ///< the highest value is the band's first or last: the true peak may lie outside
  double period_s() const { return 1 / frequency_hz; }
};
enum class PeakReading {
  nearest_point,  ///< the frequency with the largest density
  parabola        ///< vertex of the parabola through that point and its neighbours, at most half a step off it
};
/// Looks at f > 0 only. The peak of a random signal's spectrum scatters by about the width over which it is flat:
/// prefer Te or Tm01 for comparisons. \throws InputError as moments()
Peak peak(const SpectrumPerHz& spectrum, const Band& band, PeakReading reading = PeakReading::parabola);

}  // namespace hydro::signal
