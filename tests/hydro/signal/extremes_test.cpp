#include "hydro/signal/extremes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/gaussian_record.hpp"

namespace extremes_test {
namespace {

using namespace hydro::signal;
using froude_test::box_spectrum;
using testing::HasSubstr;
using testing::ThrowsMessage;

Moments of_box(double from_hz, double to_hz) {
  const auto s = box_spectrum(from_hz, to_hz);
  return moments(s, whole(s));
}

TEST(GaussianPeaks, OfANarrowBandAreRayleighs) {
  const GaussianPeaks peaks(of_box(0.099, 0.101), PeakLaw::rayleigh);
  const double sigma = std::sqrt(0.002);
  EXPECT_NEAR(peaks.rate_hz(), 0.1, 1e-5);  // √(m2/m0) is 0.1 √(1 + 1e-4/3)
  EXPECT_DOUBLE_EQ(peaks.share_above(0), 1);
  EXPECT_NEAR(peaks.share_above(3 * sigma), std::exp(-4.5), 1e-13);
  EXPECT_NEAR(peaks.level_exceeded_by(std::exp(-8.0)), 4 * sigma, 1e-12);
}

TEST(GaussianPeaks, OfABoxFromZeroHaveTheClosedForms) {
  // m_n = f^{n+1}/(n + 1): ε² = 1 − 5/9, peaks come √(3/5) f a second.
  const GaussianPeaks peaks(of_box(0, 0.2), PeakLaw::rice);
  EXPECT_NEAR(peaks.rate_hz(), std::sqrt(0.6) * 0.2, 1e-7);
  // Of all maxima (1 + √(1 − ε²))/2 are above the mean (Cartwright & Longuet-Higgins 1956).
  EXPECT_NEAR(peaks.share_above(0), (1 + std::sqrt(5.0 / 9)) / 2, 1e-7);
}

/// Rice's integral: maxima above a level are those instants at which the slope is zero and falling. x and its second
/// derivative are Gaussian with correlation −√(1 − ε²); by plain quadrature over both.
double share_by_rice(double eta, double epsilon) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const double c = std::sqrt(1 - epsilon * epsilon);
  const auto joint = [&](double x, double a) {
    return a * std::exp(-(x * x - 2 * c * x * a + a * a) / (2 * epsilon * epsilon));
  };
  const auto at = [&](double x) {
    double sum = 0;
    for (double a = 0; a < 12; a += 0.5)
      sum += Gauss::integrate([&](double down) { return joint(x, down); }, a, a + 0.5);
    return sum;
  };
  const auto over = [&](double from) {
    double sum = 0;
    for (double x = from; x < 12; x += 0.5) sum += Gauss::integrate(at, x, x + 0.5);
    return sum;
  };
  return over(eta) / over(-12);
}

TEST(GaussianPeaks, AreWhatRicesIntegralGives) {
  const GaussianPeaks peaks(of_box(0.05, 0.2), PeakLaw::rice);
  const auto m = of_box(0.05, 0.2);
  // 1e-10: quadrature of 30 points on panels of half a standard deviation leaves less.
  for (const double eta : {-2.0, -0.5, 0.0, 1.0, 3.0})
    EXPECT_NEAR(peaks.share_above(eta * std::sqrt(m.m0)), share_by_rice(eta, m.epsilon()), 1e-10) << eta;
}

TEST(GaussianPeaks, LevelIsTheInverseOfTheShare) {
  const GaussianPeaks peaks(of_box(0.05, 0.2), PeakLaw::rice);
  for (const double share : {0.999, 0.5, 0.1, 1e-6})
    EXPECT_NEAR(peaks.share_above(peaks.level_exceeded_by(share)) / share, 1, 1e-10) << share;
}

TEST(LargestPeak, OfAFewRayleighPeaksHasItsClosedForm) {
  // E max of N is √(π/2) Σ_k (−1)^{k+1} C(N, k)/√k.
  const auto m = of_box(0.099, 0.101);
  const GaussianPeaks peaks(m, PeakLaw::rayleigh);
  double sum = 0, choose = 1;
  for (int k = 1; k <= 10; ++k) {
    choose *= (11.0 - k) / k;
    sum += (k % 2 == 1 ? 1 : -1) * choose / std::sqrt(k);
  }
  const double closed = std::sqrt(std::numbers::pi / 2 * m.m0) * sum;
  EXPECT_NEAR(peaks.expected_largest(10 / peaks.rate_hz()), closed, 1e-9 * closed);
  EXPECT_NEAR(peaks.largest_not_exceeded(10 / peaks.rate_hz(), 0.5),
              std::sqrt(-2 * m.m0 * std::log(1 - std::pow(0.5, 0.1))), 1e-12);
}

TEST(LargestPeak, OfManyTendsToRicesAsymptoticForm) {
  // √(2 ln N) + γ_E/√(2 ln N); what is left is of order (2 ln N)^{−3/2}, 0.005 for N⁺ = 1e5, times a factor below 2.
  const GaussianPeaks peaks(of_box(0, 0.2), PeakLaw::rice);
  const auto m = of_box(0, 0.2);
  const double duration = 1e5 / std::sqrt(m.m2 / m.m0), most_probable = std::sqrt(2 * std::log(1e5));
  EXPECT_NEAR(peaks.most_probable_largest(duration), most_probable * std::sqrt(m.m0), 1e-9);
  EXPECT_NEAR(peaks.expected_largest(duration) / std::sqrt(m.m0), most_probable + std::numbers::egamma / most_probable,
              0.01);
}

TEST(LargestOfALife, IsThatOfItsOnlySeaAndOfTheWorstOfTwo) {
  const GaussianPeaks low(of_box(0.099, 0.101), PeakLaw::rayleigh), high(of_box(0.095, 0.105), PeakLaw::rayleigh);
  const double year = 3.15576e7, sigma = high.deviation();
  // P(largest < x) = e^{−N e^{−η²/2}}.
  const std::vector<StationaryPart> one{{1, high}}, both{{0.9, low}, {0.1, high}};
  const double n = high.rate_hz() * year;
  EXPECT_NEAR(largest_of_life(one, year, 0.9), sigma * std::sqrt(2 * std::log(n / -std::log(0.9))), 1e-11);
  // Five times the variance: what the calm sea adds at that level is e^{−64} of its peaks.
  EXPECT_NEAR(largest_of_life(both, year, 0.9), sigma * std::sqrt(2 * std::log(0.1 * n / -std::log(0.9))), 1e-11);
  EXPECT_NEAR(expected_peaks_above(both, 0, 10), 10 * (0.9 * low.rate_hz() + 0.1 * high.rate_hz()), 1e-12);
  EXPECT_THAT([&] { largest_of_life({}, year, 0.9); }, ThrowsMessage<hydro::InputError>(HasSubstr("needs a part")));
  EXPECT_THAT([&] { largest_of_life(one, 1, 0.5); }, ThrowsMessage<hydro::InputError>(HasSubstr("0.1 peaks: too few")));
}

/// Means over many records, each with its standard error.
struct Seen {
  double largest = 0, largest_error = 0, crossings = 0, crossings_error = 0, maxima = 0, maxima_error = 0;
};

Seen seen_in(double from_hz, double to_hz, std::size_t n, double step) {
  constexpr int seeds = 1000;
  std::vector<double> largest, crossings, maxima;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto x = froude_test::gaussian_record([&](double f) { return f >= from_hz && f <= to_hz ? 1.0 : 0.0; }, n,
                                                step, static_cast<std::uint64_t>(seed));
    largest.push_back(*std::max_element(x.begin(), x.end()));
    double ups = 0, tops = 0;
    for (std::size_t j = 0; j < n; ++j) {  // the record is cyclic
      const double before = x[j], here = x[(j + 1) % n], after = x[(j + 2) % n];
      if (before < 0 && here >= 0) ++ups;
      if (before < here && here >= after) ++tops;
    }
    crossings.push_back(ups);
    maxima.push_back(tops);
  }
  const auto mean = [](const std::vector<double>& v, double& error) {
    double sum = 0, squares = 0;
    for (const double value : v) sum += value;
    const double middle = sum / seeds;
    for (const double value : v) squares += (value - middle) * (value - middle);
    error = std::sqrt(squares / seeds / seeds);
    return middle;
  };
  Seen out;
  out.largest = mean(largest, out.largest_error);
  out.crossings = mean(crossings, out.crossings_error);
  out.maxima = mean(maxima, out.maxima_error);
  return out;
}

// Five standard errors: a right law fails one time in a million, and these seeds are fixed.
constexpr double errors = 5;

TEST(ThousandSeeds, HaveRicesRatesAndTheLargestPeakOfTheirBandwidth) {
  constexpr std::size_t n = 16384;
  constexpr double step = 0.25, from = 0.05, to = 0.15;
  const auto m = of_box(from, to);
  const Seen seen = seen_in(from, to, n, step);
  const double duration = n * step, sigma = std::sqrt(m.m0);
  const GaussianPeaks narrow(m, PeakLaw::rayleigh), broad(m, PeakLaw::rice);
  EXPECT_NEAR(seen.crossings, narrow.rate_hz() * duration, errors * seen.crossings_error);
  EXPECT_NEAR(seen.maxima, broad.rate_hz() * duration, errors * seen.maxima_error);
  // 27 samples of the shortest wave: a crest is missed by less than 1 − cos(π/27), 0.7 % of 3.5 σ, on average a third.
  const double missed = 0.008 * sigma;
  EXPECT_NEAR(seen.largest, broad.expected_largest(duration), errors * seen.largest_error + missed);
  EXPECT_NEAR(seen.largest, narrow.expected_largest(duration), errors * seen.largest_error + missed);
}

TEST(GaussianPeaks, NameWhatIsWrong) {
  EXPECT_THAT(
      [] {
        GaussianPeaks(Moments{1, 1, 1, 0, 1, {0, 1}}, PeakLaw::rice);
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("m2 = 0")));
  const GaussianPeaks peaks(of_box(0.05, 0.2), PeakLaw::rice);
  EXPECT_THAT([&] { peaks.expected_largest(1); },
              ThrowsMessage<hydro::InputError>(HasSubstr("at least one is needed")));
  EXPECT_THAT([&] { peaks.largest_not_exceeded(1000, 1); },
              ThrowsMessage<hydro::InputError>(HasSubstr("between 0 and 1, got 1")));
}

}  // namespace
}  // namespace extremes_test
