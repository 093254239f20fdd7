#include "hydro/signal/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "hydro/base/error.hpp"

namespace hydro::signal {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out(values.size());
  std::transform(values.begin(), values.end(), out.begin(), [&](double v) { return v * factor; });
  return out;
}

struct IndexRange {
  std::size_t first, last;  // both take part
};

// Half a part in 1e9 of the spectrum's step keeps points that sit on the band's ends in spite of rounding.
IndexRange points_in(const SpectrumPerHz& s, const Band& band) {
  require(s.frequency_hz.size() == s.density.size(), "a spectrum has {} frequencies but {} densities",
          s.frequency_hz.size(), s.density.size());
  require(s.frequency_hz.size() >= 2, "a spectrum needs at least two frequencies");
  const auto& f = s.frequency_hz;
  require(f.front() >= 0 && std::adjacent_find(f.begin(), f.end(), std::greater_equal<>()) == f.end(),
          "the frequencies of a spectrum must increase, from 0 or above");
  for (std::size_t k = 0; k < f.size(); ++k)
    require(std::isfinite(f[k]) && std::isfinite(s.density[k]) && s.density[k] >= 0,
            "the density at {} Hz is {}: it must be finite and not negative", f[k], s.density[k]);
  const double slack = 5e-10 * (f[1] - f[0]);
  const auto first = std::lower_bound(f.begin(), f.end(), band.from_hz - slack);
  const auto last = std::upper_bound(f.begin(), f.end(), band.to_hz + slack);
  require(last - first >= 2, "the band {} Hz to {} Hz holds fewer than two points of the spectrum ({} Hz to {} Hz)",
          band.from_hz, band.to_hz, f.front(), f.back());
  return {static_cast<std::size_t>(first - f.begin()), static_cast<std::size_t>(last - f.begin()) - 1};
}

// (S4)
double moment(const SpectrumPerHz& s, IndexRange range, int order) {
  const auto integrand = [&](std::size_t k) { return std::pow(s.frequency_hz[k], order) * s.density[k]; };
  if (order < 0 && s.frequency_hz[range.first] == 0) ++range.first;
  double sum = 0;
  for (std::size_t k = range.first; k < range.last; ++k)
    sum += (integrand(k) + integrand(k + 1)) / 2 * (s.frequency_hz[k + 1] - s.frequency_hz[k]);
  return sum;
}

}  // namespace

SpectrumPerRadS per_rad_s(const SpectrumPerHz& s) {
  return {scaled(s.frequency_hz, two_pi), scaled(s.density, 1 / two_pi)};
}
SpectrumPerHz per_hz(const SpectrumPerRadS& s) { return {scaled(s.omega, 1 / two_pi), scaled(s.density, two_pi)}; }

Band whole(const SpectrumPerHz& spectrum) {
  require(!spectrum.frequency_hz.empty(), "a spectrum needs at least two frequencies");
  return {spectrum.frequency_hz.front(), spectrum.frequency_hz.back()};
}

double Moments::hs() const { return 4 * std::sqrt(m0); }
double Moments::te() const { return m_minus1 / m0; }
double Moments::tm01() const { return m0 / m1; }
double Moments::tm02() const { return std::sqrt(m0 / m2); }
// Both are zero for a line spectrum, where rounding may leave a negative difference of order 1e-16.
double Moments::epsilon() const { return std::sqrt(std::max(0.0, 1 - m2 * m2 / (m0 * m4))); }
double Moments::nu() const { return std::sqrt(std::max(0.0, m0 * m2 / (m1 * m1) - 1)); }

Moments moments(const SpectrumPerHz& spectrum, const Band& band) {
  const IndexRange range = points_in(spectrum, band);
  Moments m{moment(spectrum, range, -1), moment(spectrum, range, 0),
            moment(spectrum, range, 1),  moment(spectrum, range, 2),
            moment(spectrum, range, 4),  {spectrum.frequency_hz[range.first], spectrum.frequency_hz[range.last]}};
  require(m.m0 > 0, "the spectrum is zero from {} Hz to {} Hz: it has no height or period", m.band.from_hz,
          m.band.to_hz);
  return m;
}

Peak peak(const SpectrumPerHz& s, const Band& band, PeakReading reading) {
  IndexRange range = points_in(s, band);
  if (s.frequency_hz[range.first] == 0) ++range.first;
  const auto begin = s.density.begin();
  const auto top = std::max_element(begin + static_cast<std::ptrdiff_t>(range.first),
                                    begin + static_cast<std::ptrdiff_t>(range.last) + 1);
  const auto k = static_cast<std::size_t>(top - begin);
  require(*top > 0, "the spectrum is zero from {} Hz to {} Hz: it has no peak", s.frequency_hz[range.first],
          s.frequency_hz[range.last]);
  Peak p{s.frequency_hz[k], *top, k == range.first || k == range.last};
  if (reading == PeakReading::nearest_point || p.at_edge) return p;
  // Newton's form through three points that need not be evenly spaced: S = S₋ + a (f − f₋) + b (f − f₋)(f − f₀).
  const double below = s.frequency_hz[k] - s.frequency_hz[k - 1], above = s.frequency_hz[k + 1] - s.frequency_hz[k];
  const double a = (s.density[k] - s.density[k - 1]) / below;
  const double b = ((s.density[k + 1] - s.density[k]) / above - a) / (below + above);
  if (b >= 0) return p;  // three equal values: no vertex
  const double from_middle = -(a + b * below) / (2 * b);
  p.frequency_hz += from_middle;
  p.density += from_middle * (a + b * below) + b * from_middle * from_middle;
  return p;
}

}  // namespace hydro::signal
