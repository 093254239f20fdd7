#include "fit/differentiate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
