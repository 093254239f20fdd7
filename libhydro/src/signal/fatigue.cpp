#include "hydro/signal/fatigue.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "hydro/base/error.hpp"
#include "hydro/signal/extremes.hpp"

namespace hydro::signal {
namespace {

std::vector<double> turning_points(std::span<const double> values) {
  std::vector<double> out;
  for (const double v : values) {
    require(std::isfinite(v), "a record whose cycles are counted holds the value {}", v);
    if (!out.empty() && v == out.back()) continue;
    const bool goes_on = out.size() >= 2 && (out.back() - out[out.size() - 2] > 0) == (v - out.back() > 0);
    if (goes_on)
      out.back() = v;
    else
      out.push_back(v);
  }
  return out;
}

Cycle between(double a, double b, double count) { return {std::abs(b - a), (a + b) / 2, count}; }

/// E[(S/S_k)^m; S > S_k] + E[(S/S_k)^{m'}; S < S_k] of a density in which (S/scale)^p/c is exponentially distributed:
/// `power` = 1 with c = 1, an exponential density; 2 with c = 2, Rayleigh's.
double mean_of_powers(const SnCurve& curve, double scale, int power) {
  const double unit = power == 2 ? std::sqrt(2.0) * scale : scale, knee = curve.knee_range / unit;
  const double at = std::pow(knee, power);
  const auto part = [&](double slope, auto gamma) { return std::pow(knee, -slope) * gamma(1 + slope / power); };
  const auto whole = [](double a) { return boost::math::tgamma(a); };
  if (!curve.slope_below) return part(curve.slope, whole);
  return part(curve.slope, [&](double a) { return boost::math::tgamma(a, at); }) +
         part(*curve.slope_below, [&](double a) { return boost::math::tgamma_lower(a, at); });
}

/// Dirlik's density of Z = S/(2σ): D₁/Q e^{−Z/Q} + D₂ Z/R² e^{−Z²/2R²} + D₃ Z e^{−Z²/2}. (S18)
struct Dirlik {
  double d1, d2, d3, q, r;
};

std::optional<Dirlik> dirlik(const Moments& m) {
  const double gamma = m.m2 / std::sqrt(m.m0 * m.m4), mean = m.m1 / m.m0 * std::sqrt(m.m2 / m.m4);
  const double d1 = 2 * (mean - gamma * gamma) / (1 + gamma * gamma), left = 1 - gamma - d1 + d1 * d1;
  // All peaks are crests of one frequency: what is left of the other two parts is rounding.
  if (1 - gamma < 1e-9) return Dirlik{0, 0, 1, 1, 1};
  const double r = (gamma - mean - d1 * d1) / left, d2 = left / (1 - r), d3 = 1 - d1 - d2;
  const double q = 1.25 * (gamma - d3 - d2 * r) / d1;
  if (!(d1 > 0 && d2 >= 0 && d3 >= 0 && r > 0 && q > 0)) return std::nullopt;
  return Dirlik{d1, d2, d3, q, r};
}

}  // namespace

// (S15)
std::vector<Cycle> rainflow(std::span<const double> values) {
  std::vector<Cycle> out;
  std::vector<double> open;  // turning points that belong to no cycle yet
  for (const double turn : turning_points(values)) {
    open.push_back(turn);
    while (open.size() >= 3) {
      const std::size_t n = open.size();
      if (std::abs(open[n - 1] - open[n - 2]) < std::abs(open[n - 2] - open[n - 3])) break;
      out.push_back(between(open[n - 3], open[n - 2], n == 3 ? 0.5 : 1));
      if (n == 3)
        open.erase(open.begin());
      else
        open.erase(open.end() - 3, open.end() - 1);
    }
  }
  for (std::size_t i = 1; i < open.size(); ++i) out.push_back(between(open[i - 1], open[i], 0.5));
  return out;
}

void SnCurve::check() const {
  const auto usable = [](double v) { return std::isfinite(v) && v > 0; };
  require(usable(knee_range) && usable(knee_cycles) && usable(slope) && usable(slope_below.value_or(1)),
          "an S-N curve needs a range, cycles and slopes that are positive, got range {}, cycles {}, slope {}{}",
          knee_range, knee_cycles, slope, slope_below ? fmt::format(", below {}", *slope_below) : "");
}

// (S16)
double SnCurve::cycles_to_failure(double range) const {
  if (range == 0) return std::numeric_limits<double>::infinity();
  return knee_cycles * std::pow(range / knee_range, -(range < knee_range ? slope_below.value_or(slope) : slope));
}

double damage(std::span<const Cycle> cycles, const SnCurve& curve) {
  curve.check();
  double sum = 0;
  for (const Cycle& c : cycles) sum += c.count / curve.cycles_to_failure(c.range);
  return sum;
}

double narrow_band_damage_rate(const Moments& m, const SnCurve& curve) {
  curve.check();
  const double rate = GaussianPeaks(m, PeakLaw::rayleigh).rate_hz();
  return rate / curve.knee_cycles * mean_of_powers(curve, 2 * std::sqrt(m.m0), 2);
}

std::optional<double> dirlik_damage_rate(const Moments& m, const SnCurve& curve) {
  curve.check();
  const double rate = GaussianPeaks(m, PeakLaw::rice).rate_hz(), two_sigma = 2 * std::sqrt(m.m0);
  const std::optional<Dirlik> d = dirlik(m);
  if (!d) return std::nullopt;
  const double exponential = d->d1 > 0 ? d->d1 * mean_of_powers(curve, two_sigma * d->q, 1) : 0;
  return rate / curve.knee_cycles *
         (exponential + d->d2 * mean_of_powers(curve, two_sigma * d->r, 2) +
          d->d3 * mean_of_powers(curve, two_sigma, 2));
}

}  // namespace hydro::signal
