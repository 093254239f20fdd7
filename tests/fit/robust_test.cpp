// Robust linear fits against medians, roots found by bisection, and the spread of many fits.
#include "fit/robust.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hydro/base/random.hpp"

namespace robust_test {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;
using fit::RobustLoss;

enum class Noise { gaussian, laplace };

VectorXd noise(Noise kind, int n, std::uint64_t seed) {
  const hydro::RandomStream random(seed, 0);
  VectorXd out(n);
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::uint64_t>(3 * i);
    const double a = random.normal(at), b = random.normal(at + 1), c = random.normal(at + 2);
    // Half of a χ² of two is an exponential; with a sign it is Laplace's.
    out[i] = kind == Noise::gaussian ? a : std::copysign((a * a + b * b) / 2, c);
  }
  return out;
}

// A mean is the simplest fit: that of least absolute residuals is a median, to the band that counts as squares.
TEST(Robust, LeastAbsoluteResidualsOfAConstantIsTheMedian) {
  for (const int n : {101, 1001, 10001}) {
    VectorXd y = noise(Noise::laplace, n, 3);
    const auto found = fit::fit_robust(MatrixXd::Ones(n, 1), y, RobustLoss::least_absolute);
    std::vector<double> sorted(y.begin(), y.end());
    std::sort(sorted.begin(), sorted.end());
    const double median = sorted[static_cast<std::size_t>(n / 2)], error = 1 / std::sqrt(n);
    EXPECT_NEAR(found.x[0], median, std::min(found.deviation * std::pow(n, -1.0 / 3), error)) << n;
    // Fisher's 1/(4 f(0)² n), f(0) = ½: the band holds 2 f(0) n^(2/3) samples or so, and as many errors.
    const double told = found.influence.norm() / found.slope / n;
    EXPECT_NEAR(told, error, 4 * error / std::pow(n, 1.0 / 3)) << n;
  }
}

// The bisquare against the root of Σψ(y − m) next to the median, by bisection with the same deviation.
TEST(Robust, BisquareOfAConstantIsTheRootOfItsSum) {
  constexpr int n = 400;
  VectorXd y = noise(Noise::gaussian, n, 5);
  y.head(40).array() += 30;  // a tenth far off to one side
  const auto found = fit::fit_robust(MatrixXd::Ones(n, 1), y, RobustLoss::bisquare);
  const double c = 4.685 * found.deviation;
  const auto sum = [&](double m) {
    double out = 0;
    for (const double v : y)
      if (const double t = (v - m) / c; std::abs(t) < 1) out += (v - m) * std::pow(1 - t * t, 2);
    return out;
  };
  double low = -1, high = 1;  // Σψ falls through zero there
  ASSERT_GT(sum(low), 0);
  ASSERT_LT(sum(high), 0);
  for (int i = 0; i < 60; ++i) (sum((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  EXPECT_NEAR(found.x[0], low, 1e-8);  // the search ends at 1e-8 of an error
  EXPECT_NEAR(found.share_inside, 0.9, 1e-12);
  const auto huber = fit::fit_robust(MatrixXd::Ones(n, 1), y, RobustLoss::huber);
  EXPECT_GT(std::abs(huber.x[0]), 2 * std::abs(found.x[0])) << "what counts for nothing does not pull";
}

struct Spread {
  double seen, told;  // standard deviation of the slope of many fits, and the mean of what they say
};

Spread spread_of(Noise kind, RobustLoss loss) {
  constexpr int n = 500, sets = 400;
  MatrixXd J(n, 2);
  for (int i = 0; i < n; ++i) J.row(i) << 1, std::sin(0.1 * i);
  const double inverse = (J.transpose() * J).inverse()(1, 1);
  double square = 0, told = 0;
  for (int k = 0; k < sets; ++k) {
    const VectorXd y = 3 * J.col(1) + noise(kind, n, 100 + static_cast<std::uint64_t>(k));
    const auto found = fit::fit_robust(J, y, loss);
    square += std::pow(found.x[1] - 3, 2) / sets;
    told += std::sqrt(found.influence.squaredNorm() / n * inverse) / found.slope / sets;
  }
  return {std::sqrt(square / inverse), told / std::sqrt(inverse)};
}

// Asymptotic deviations of one sample: of Gaussian noise 1/√0.95 by Huber and the bisquare, √(π/2) by least absolute
// residuals; of Laplace's, whose deviation is √2, 1 by the last. 400 sets know them to 3.5 %, and 500 samples are near
// the limit of many.
TEST(Robust, DeviationsAreThoseOfTheory) {
  constexpr double known = 0.11;
  for (const RobustLoss loss : {RobustLoss::huber, RobustLoss::bisquare}) {
    const Spread s = spread_of(Noise::gaussian, loss);
    EXPECT_NEAR(s.seen, 1 / std::sqrt(0.95), known);
    EXPECT_NEAR(s.told, 1 / std::sqrt(0.95), 0.03);
  }
  const Spread gaussian = spread_of(Noise::gaussian, RobustLoss::least_absolute),
               laplace = spread_of(Noise::laplace, RobustLoss::least_absolute);
  EXPECT_NEAR(gaussian.seen, std::sqrt(std::acos(-1.0) / 2), 1.25 * known);
  EXPECT_NEAR(laplace.seen, 1, known);
  // f(0) is that of a band of ±n^(−1/3) deviations, in which Laplace's density falls by a tenth on average.
  EXPECT_NEAR(gaussian.told, gaussian.seen, 0.15 * gaussian.seen);
  EXPECT_NEAR(laplace.told, laplace.seen, 0.15 * laplace.seen);
}

}  // namespace
}  // namespace robust_test
