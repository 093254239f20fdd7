#include "hydro/signal/extremes.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"

namespace hydro::signal {
namespace {

/// P(Z > z).
double normal_above(double z) { return std::erfc(z / std::numbers::sqrt2) / 2; }

constexpr double far = 40;  ///< standard deviations: e^{−far²/2} is below the smallest double

/// Of a function that falls from −far to far.
template <class Function>
double where_zero(const Function& f) {
  std::uintmax_t most = 200;
  const auto [low, high] =
      boost::math::tools::toms748_solve(f, -far, far, boost::math::tools::eps_tolerance<double>(50), most);
  return (low + high) / 2;
}

}  // namespace

GaussianPeaks::GaussianPeaks(const Moments& m, PeakLaw law) {
  const auto usable = [](double moment) { return std::isfinite(moment) && moment > 0; };
  require(usable(m.m0) && usable(m.m2) && (law == PeakLaw::rayleigh || usable(m.m4)),
          "peaks need a spectrum whose moments are positive and finite, got m0 = {}, m2 = {}, m4 = {}", m.m0, m.m2,
          m.m4);
  deviation_ = std::sqrt(m.m0);
  crossing_rate_hz_ = std::sqrt(m.m2 / m.m0);
  rate_hz_ = law == PeakLaw::rayleigh ? crossing_rate_hz_ : std::sqrt(m.m4 / m.m2);
  epsilon_ = law == PeakLaw::rayleigh ? 0 : m.epsilon();
}

// (S12)
double GaussianPeaks::share_above(double level) const {
  const double eta = level / deviation_, narrow = std::sqrt(1 - epsilon_ * epsilon_);
  if (epsilon_ == 0) return eta > 0 ? std::exp(-eta * eta / 2) : 1;
  return normal_above(eta / epsilon_) + narrow * std::exp(-eta * eta / 2) * normal_above(-eta * narrow / epsilon_);
}

double GaussianPeaks::level_exceeded_by(double share) const {
  require(share > 0 && share < 1, "the share of peaks above a level must be between 0 and 1, got {}", share);
  if (epsilon_ == 0) return deviation_ * std::sqrt(-2 * std::log(share));
  const auto excess = [&](double eta) { return share_above(eta * deviation_) - share; };
  return deviation_ * where_zero(excess);
}

double GaussianPeaks::peaks_in(double duration_s) const {
  const double peaks = rate_hz_ * duration_s;
  require(std::isfinite(peaks) && peaks >= 1,
          "a duration of {} s holds {:.3g} peaks of a signal that has one every {:.4g} s: at least one is needed",
          duration_s, peaks, 1 / rate_hz_);
  return peaks;
}

// (S13)
double GaussianPeaks::largest_not_exceeded(double duration_s, double probability) const {
  require(probability > 0 && probability < 1, "a probability must be between 0 and 1, got {}", probability);
  return level_exceeded_by(-std::expm1(std::log(probability) / peaks_in(duration_s)));
}

double GaussianPeaks::expected_largest(double duration_s) const {
  const double peaks = peaks_in(duration_s);
  const auto below = [&](double eta) { return std::exp(peaks * std::log1p(-share_above(eta * deviation_))); };
  // E = ∫₀^∞ (1 − F) dη − ∫_{−∞}^0 F dη, on panels that are narrow against the least width of F, some 1/√(2 ln N).
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  constexpr double panel = 0.125;
  double sum = 0;
  for (double from = 0; from < far; from += panel) {
    sum += Gauss::integrate([&](double eta) { return 1 - below(eta); }, from, from + panel);
    sum -= Gauss::integrate(below, -from - panel, -from);
  }
  return sum * deviation_;
}

double GaussianPeaks::most_probable_largest(double duration_s) const {
  peaks_in(duration_s);
  const double crossings = crossing_rate_hz_ * duration_s;
  require(crossings > 1, "a duration of {} s holds {:.3g} up-crossings: more than one is needed", duration_s,
          crossings);
  return deviation_ * std::sqrt(2 * std::log(crossings));
}

// (S19)
double expected_peaks_above(std::span<const StationaryPart> life, double level, double duration_s) {
  double sum = 0;
  for (const StationaryPart& part : life) sum += part.share * part.peaks.rate_hz() * part.peaks.share_above(level);
  return sum * duration_s;
}

double largest_of_life(std::span<const StationaryPart> life, double duration_s, double probability) {
  require(probability > 0 && probability < 1, "a probability must be between 0 and 1, got {}", probability);
  double deviation = 0;
  for (const StationaryPart& part : life) {
    require(std::isfinite(part.share) && part.share >= 0, "a share of the time must not be negative, got {}",
            part.share);
    if (part.share > 0) deviation = std::max(deviation, part.peaks.deviation());
  }
  require(deviation > 0, "a life needs a part that takes a share of the time");
  const double wanted = -std::log(probability), all = expected_peaks_above(life, -far * deviation, duration_s);
  require(std::isfinite(all) && all > wanted, "in {} s come {:.3g} peaks: too few for a largest one", duration_s, all);
  const auto excess = [&](double eta) {
    return std::log(std::max(expected_peaks_above(life, eta * deviation, duration_s), 1e-300) / wanted);
  };
  return deviation * where_zero(excess);
}

}  // namespace hydro::signal
