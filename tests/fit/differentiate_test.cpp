#include "fit/differentiate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace differentiate_test {
namespace {

using fit::LocalPolynomial;

TEST(LocalPolynomial, IsExactForPolynomialsOfItsDegree) {
  std::vector<double> x;
  const double h = 0.1;
  for (int j = -10; j <= 10; ++j) {
    const double t = j * h;
    x.push_back(1 - 2 * t + 3 * t * t - 4 * t * t * t + 5 * t * t * t * t);
  }
  // At the middle: value 1, first derivative −2, second 6. Rounding grows as h⁻² times values of order 10.
  EXPECT_NEAR(LocalPolynomial(0, 10, h).apply(x).front(), 1, 1e-12);
  EXPECT_NEAR(LocalPolynomial(1, 10, h).apply(x).front(), -2, 1e-12);
  EXPECT_NEAR(LocalPolynomial(2, 10, h).apply(x).front(), 6, 1e-11);
}

TEST(LocalPolynomial, DoesToASinusoidWhatItsGainSaysAndDelaysNothing) {
  const double h = 0.02, omega = 9;
  std::vector<double> x;
  for (int j = 0; j < 200; ++j) x.push_back(std::cos(omega * j * h));
  const LocalPolynomial first(1, 12, h), second(2, 12, h);
  const auto v = first.apply(x), a = second.apply(x);
  for (std::size_t j = 0; j < v.size(); ++j) {
    const double t = static_cast<double>(j + 12) * h;
    EXPECT_NEAR(v[j], -omega * first.gain(omega) * std::sin(omega * t), 1e-11);  // (F6) is exact for sinusoids
    EXPECT_NEAR(a[j], -omega * omega * second.gain(omega) * std::cos(omega * t), 1e-10);
  }
}

TEST(LocalPolynomial, LosesGainWithTheFourthPowerOfFrequency) {
  for (const int order : {1, 2}) {
    const LocalPolynomial filter(order, 20, 0.01);
    const double coarse = 1 - filter.gain(4), fine = 1 - filter.gain(2);
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.1);  // next term of the expansion is of sixth order
  }
}

TEST(LocalPolynomial, PassesWhiteNoiseWithItsNoiseGain) {
  const hydro::RandomStream random(71, 0);
  std::vector<double> x(200000);
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = random.normal(j);
  for (const int order : {0, 1, 2}) {
    const LocalPolynomial filter(order, 8, 0.1);
    double variance = 0;
    const auto y = filter.apply(x);
    for (const double v : y) variance += v * v / static_cast<double>(y.size());
    // 200 000 samples of which some 17 count as one: relative error of the deviation 1/√(2·12000) = 0.6 %; five of
    // them.
    EXPECT_NEAR(std::sqrt(variance) / filter.noise_gain(), 1, 0.03);
  }
}

TEST(SmoothingSpline, DoesToASinusoidWhatItsGainSaysAndWhatItsFormulaSays) {
  const double h = 0.02, omega = 9, w = omega * h, stiffness = 200;
  std::vector<double> x;
  for (int j = 0; j < 600; ++j) x.push_back(std::cos(omega * j * h));
  const double b = (66 + 52 * std::cos(w) + 2 * std::cos(2 * w)) / 120;
  const fit::SmoothingSpline value(0, stiffness, h), first(1, stiffness, h), second(2, stiffness, h);
  // Weights end where 1e-8 of them is left.
  EXPECT_NEAR(value.gain(omega), b / (b + stiffness * std::pow(2 * std::sin(w / 2), 6)), 1e-7);
  const auto v = first.apply(x), a = second.apply(x);
  for (std::size_t j = 0; j < v.size(); ++j) {
    const double t = static_cast<double>(j + static_cast<std::size_t>(first.half_width())) * h;
    EXPECT_NEAR(v[j], -omega * first.gain(omega) * std::sin(omega * t), 1e-10);
    EXPECT_NEAR(a[j], -omega * omega * second.gain(omega) * std::cos(omega * t), 1e-9);
  }
  for (const fit::SmoothingSpline* s : {&value, &first, &second})  // 1 - G is about stiffness w^6 for every order
    EXPECT_NEAR((1 - s->gain(omega)) / (stiffness * std::pow(w, 6)), 1, 0.03);
}

TEST(SmoothingSpline, IsTheLeastOfItsSumOfSquaresAndBending) {
  // The same spline as a dense least-squares problem over B-splines, in the middle of a record much longer than
  // weights.
  const double stiffness = 3;
  const int n = 301;
  const hydro::RandomStream random(75, 0);
  Eigen::VectorXd x(n);
  for (int j = 0; j < n; ++j) x[j] = random.normal(static_cast<std::uint64_t>(j));
  const std::array<double, 3> values{66 / 120.0, 26 / 120.0, 1 / 120.0};
  const std::array<double, 3> slopes{0, -5 / 12.0, -1 / 24.0};
  const std::array<double, 6> bending{552, -330, 0, 75, -20, -1};  // ∫B‴B‴ at distances 0 … 5, times 120
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(n, n), penalty = at;
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < n; ++k) {
      const auto d = static_cast<std::size_t>(std::abs(j - k));
      if (d < 3) at(j, k) = values[d];
      if (d < 6) penalty(j, k) = bending[d] / 120;
    }
  const Eigen::VectorXd c = (at.transpose() * at + stiffness * penalty).ldlt().solve(at.transpose() * x);
  double slope = 0;
  for (int k = n / 2 - 2; k <= n / 2 + 2; ++k)
    slope += c[k] * slopes[static_cast<std::size_t>(std::abs(n / 2 - k))] * (n / 2 < k ? -1 : 1);
  const fit::SmoothingSpline first(1, stiffness, 1);
  const auto v = first.apply({x.data(), static_cast<std::size_t>(n)});
  EXPECT_NEAR(v[static_cast<std::size_t>(n / 2 - first.half_width())], slope, 1e-7);
}

TEST(SmoothingSpline, PassesLessNoiseThanAPolynomialOfTheSameBandwidth) {
  const double h = 0.01;
  std::vector<double> x;
  const hydro::RandomStream random(76, 0);
  for (std::size_t j = 0; j < 4000; ++j)
    x.push_back(0.5 * std::sin(1.5 * static_cast<double>(j) * h) + 1e-3 * random.normal(j));
  const auto polynomial = fit::from_position(x, h),
             spline = fit::from_position(x, h, 0, fit::Derivative::smoothing_spline);
  EXPECT_NEAR(spline.bandwidth_hz / polynomial.bandwidth_hz, 1, 0.02);
  EXPECT_LT(spline.noise_acceleration, polynomial.noise_acceleration);
  double error = 0;
  for (std::size_t j = 0; j < spline.velocity.size(); ++j)
    error +=
        std::pow(spline.acceleration[j] + 0.5 * 2.25 * std::sin(1.5 * static_cast<double>(j + spline.first) * h), 2);
  error = std::sqrt(error / static_cast<double>(spline.velocity.size()));
  EXPECT_NEAR(error / spline.noise_acceleration, 1, 0.3);  // as for polynomials above
  EXPECT_LT(spline.gain_error_main, 2e-6);                 // sixth power of 1/5, and what is cut off the weights
}

TEST(FourierSeries, GivesDerivativesOfAMotionThatRepeatsUpToTheEnds) {
  const double h = 0.013, omega = 2.2, noise = 1e-3;  // no whole number of periods
  const hydro::RandomStream random(77, 0);
  std::vector<double> x;
  for (std::size_t j = 0; j < 3000; ++j) {
    const double t = static_cast<double>(j) * h;
    x.push_back(0.3 + std::sin(omega * t) + 0.1 * std::cos(3 * omega * t) + noise * random.normal(j));
  }
  const auto m = fit::from_position(x, h, 0, fit::Derivative::fourier_series);
  ASSERT_EQ(m.velocity.size(), x.size());
  EXPECT_NEAR(m.main_period_s, 2 * std::numbers::pi / omega, 1e-4);
  EXPECT_NEAR(m.bandwidth_hz * m.main_period_s, 5, 1e-9);
  double error = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double t = static_cast<double>(j) * h;
    error += std::pow(m.acceleration[j] + omega * omega * (std::sin(omega * t) + 0.9 * std::cos(3 * omega * t)), 2);
  }
  error = std::sqrt(error / static_cast<double>(x.size()));
  EXPECT_NEAR(error / m.noise_acceleration, 1, 0.5);  // ten amplitudes and a frequency: chi of 11, a fifth; 2.5 of them
  EXPECT_LT(m.noise_acceleration, fit::from_position(x, h).noise_acceleration / 3);
  EXPECT_NEAR(m.left, noise / std::sqrt(0.505), 0.05 * noise);
}

TEST(FourierSeries, RefusesAMotionThatDoesNotRepeat) {
  std::vector<double> x;
  for (int j = 0; j < 2000; ++j) x.push_back(std::sin(0.05 * j) * std::min(1.0, 0.002 * j));
  EXPECT_THAT([&] { fit::from_position(x, 0.01, 0, fit::Derivative::fourier_series); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("does not repeat")));
}

// Near the Nyquist frequency the numbers fit as well as anywhere, and say nothing of what was between the samples.
TEST(FourierSeries, RefusesFewSamplesAPeriodOfItsHighestHarmonic) {
  const double h = 0.1, f = 1;  // ten samples a period
  std::vector<double> x;
  for (int j = 0; j < 400; ++j) x.push_back(std::sin(2 * std::numbers::pi * f * j * h));
  EXPECT_THAT([&] { fit::from_position(x, h, 5 * f, fit::Derivative::fourier_series); },
              testing::ThrowsMessage<hydro::InputError>(
                  testing::AllOf(testing::HasSubstr("samples a period"), testing::HasSubstr("derivative_bandwidth"))));
  const auto m = fit::from_position(x, h, 3 * f, fit::Derivative::fourier_series);
  EXPECT_NEAR(m.acceleration[2], -std::pow(2 * std::numbers::pi, 2) * std::sin(0.4 * std::numbers::pi), 1e-3);
}

TEST(Differentiate, GivesVelocityAndAccelerationOfANoisyPositionWithinTheErrorsItStates) {
  const double h = 0.01, omega = 2 * std::numbers::pi / 4, amplitude = 0.5, noise = 1e-3;
  const hydro::RandomStream random(72, 0);
  std::vector<double> x;
  for (std::size_t j = 0; j < 4000; ++j)
    x.push_back(amplitude * std::sin(omega * static_cast<double>(j) * h) + noise * random.normal(j));
  const auto motion = fit::from_position(x, h);
  EXPECT_NEAR(motion.main_period_s, 4, 0.05);
  EXPECT_LT(motion.gain_error_fifth, 0.011);
  EXPECT_LT(motion.gain_error_main, 0.011 / 400);  // fourth power of 1/5, about
  EXPECT_GT(motion.bandwidth_hz, 5 * 0.25 * 0.98);
  double v_error = 0, a_error = 0;
  const auto n = static_cast<double>(motion.velocity.size());
  ASSERT_EQ(motion.velocity.size(), x.size() - 2 * motion.first);
  for (std::size_t j = 0; j < motion.velocity.size(); ++j) {
    const double t = static_cast<double>(j + motion.first) * h;
    v_error += std::pow(motion.velocity[j] - amplitude * omega * std::cos(omega * t), 2) / n;
    a_error += std::pow(motion.acceleration[j] + amplitude * omega * omega * std::sin(omega * t), 2) / n;
  }
  // Noise of the output: some 50 independent windows in the record, 10 % standard error; 30 % asked.
  EXPECT_NEAR(std::sqrt(v_error) / motion.noise_velocity, 1, 0.3);
  EXPECT_NEAR(std::sqrt(a_error) / motion.noise_acceleration, 1, 0.3);
}

TEST(Differentiate, PassesAVelocityThrough) {
  const double h = 0.02, omega = 3;
  std::vector<double> v;
  for (int j = 0; j < 600; ++j) v.push_back(std::cos(omega * j * h));
  const auto motion = fit::from_velocity(v, h);
  EXPECT_EQ(motion.velocity.front(), v[motion.first]);
  EXPECT_EQ(motion.velocity.size(), motion.acceleration.size());
  for (std::size_t j = 0; j < motion.acceleration.size(); ++j)
    EXPECT_NEAR(motion.acceleration[j], -omega * std::sin(omega * static_cast<double>(j + motion.first) * h),
                3 * (motion.gain_error_main + 1e-9));
}

TEST(Differentiate, RefusesRecordsThatAreTooShortOrTooCoarse) {
  std::vector<double> coarse, slow;
  for (int j = 0; j < 200; ++j) {
    coarse.push_back(std::sin(2 * std::numbers::pi * j / 6.0));
    slow.push_back(std::sin(2 * std::numbers::pi * j / 190.0));
  }
  EXPECT_THAT([&] { fit::from_position(coarse, 1); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("cannot be differentiated")));
  EXPECT_THROW(fit::from_position(slow, 1), hydro::InputError);
  EXPECT_THROW(fit::from_position(std::vector<double>(10, 1.0), 1), hydro::InputError);
  EXPECT_THROW(LocalPolynomial(3, 5, 1), hydro::InputError);
  EXPECT_THROW(LocalPolynomial(1, 2, 1), hydro::InputError);
}

}  // namespace
}  // namespace differentiate_test
