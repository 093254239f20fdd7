// Steady parts of records: found where they were put, with means whose intervals hold the truth.
#include "fit/steady.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "support/coloured_noise.hpp"

namespace steady_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Rest, a ramp, `speed`, a ramp, rest and a way back, 100 samples a second.
std::vector<double> carriage(double speed, double back) {
  std::vector<double> out(10'00, 0.0);
  for (int i = 0; i < 2'00; ++i) out.push_back(speed * i / 200);
  out.insert(out.end(), 40'00, speed);
  for (int i = 0; i < 2'00; ++i) out.push_back(speed - speed * i / 200);
  out.insert(out.end(), 3'00, 0.0);
  out.insert(out.end(), 60'00, back);
  return out;
}

TEST(Tow, IsFoundWhereItWasPut) {
  const auto speed = carriage(0.8, 0.25);
  const auto tow = fit::find_tow(speed, 0.02);
  const std::size_t block = speed.size() / 500;
  // Above a tenth from a tenth of a ramp on, until as long before its end; each known to one block.
  EXPECT_NEAR(static_cast<double>(tow.motion.from), 1000 + 20, static_cast<double>(block));
  EXPECT_NEAR(static_cast<double>(tow.motion.to), 5200 + 180, static_cast<double>(block));
  EXPECT_GE(tow.even_speed.from, 1200u);
  EXPECT_LE(tow.even_speed.from, 1200u + 2 * block);
  EXPECT_LE(tow.even_speed.to, 5200u);
  EXPECT_GE(tow.even_speed.to, 5200u - 2 * block);
  EXPECT_DOUBLE_EQ(tow.speed, 0.8);
  EXPECT_FALSE(tow.moves_again);
}

TEST(Tow, IsTheFirstOfSeveralAndSaysSo) {
  EXPECT_TRUE(fit::find_tow(carriage(0.8, 0.7), 0.02).moves_again);
  EXPECT_DOUBLE_EQ(fit::find_tow(carriage(0.8, 0.7), 0.02).speed, 0.8);
  // A speed told with its sign goes back below zero.
  EXPECT_FALSE(fit::find_tow(carriage(0.8, -0.8), 0.02).moves_again);
}

TEST(Tow, OfARecordThatWasCutAlreadyIsAllOfIt) {
  const std::vector<double> speed(1000, 0.5);
  const auto tow = fit::find_tow(speed, 0.02);
  EXPECT_EQ(tow.even_speed.from, 0u);
  EXPECT_EQ(tow.even_speed.to, 1000u);
}

TEST(Tow, RefusesWhatIsNone) {
  std::vector<double> ramp(1000);
  std::iota(ramp.begin(), ramp.end(), 0.0);
  EXPECT_THAT([&] { fit::find_tow(ramp, 0.005); },
              ThrowsMessage<hydro::InputError>(HasSubstr("a steady part needs 64")));
  EXPECT_THAT([] { fit::find_tow(std::vector<double>(100, -1.0), 0.02); },
              ThrowsMessage<hydro::InputError>(HasSubstr("nowhere positive")));
  EXPECT_THAT([] { fit::find_tow(std::vector<double>(10, 1.0), 0.02); },
              ThrowsMessage<hydro::InputError>(HasSubstr("64 samples at least")));
  std::vector<double> spoilt(100, 1.0);
  spoilt[41] = std::nan("");
  EXPECT_THAT([&] { fit::find_tow(spoilt, 0.02); }, ThrowsMessage<hydro::InputError>(HasSubstr("sample 42")));
  EXPECT_THROW(fit::find_tow(ramp, 0), hydro::InputError);
}

// Closed form: x = 1 before d, 0 after, without noise: any cut before d leaves a share of ones, at d nothing is left.
TEST(Settling, BeginsWhereAStepEnds) {
  std::vector<double> values(2000, 0.0);
  std::fill(values.begin(), values.begin() + 600, 1.0);
  ASSERT_TRUE(fit::settled_from(values));
  EXPECT_EQ(*fit::settled_from(values), 600u);
}

TEST(Settling, OfAConstantRecordIsAtOnce) {
  EXPECT_EQ(fit::settled_from(std::vector<double>(500, 3.0)), std::optional<std::size_t>(0));
}

TEST(Settling, IsNotSaidOfARecordThatGoesOnChanging) {
  std::vector<double> ramp(1000);
  std::iota(ramp.begin(), ramp.end(), 0.0);
  EXPECT_FALSE(fit::settled_from(ramp));
}

TEST(Settling, LeavesLittleOfAStartThatDiesOut) {
  // e^{−t/τ} of ten deviations: at the cut what is left of it is no larger than the noise of a block.
  int settled = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    auto values = froude_test::ar1_noise(4000, 0.9, 1, 700 + seed);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += 10 * std::exp(-static_cast<double>(i) / 200);
    const auto from = fit::settled_from(values);
    settled += from && *from > 200 && *from < 2000 ? 1 : 0;
  }
  EXPECT_GE(settled, 48);
}

TEST(Settling, CostsASteadyRecordLittle) {
  double lost = 0;
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto from = fit::settled_from(froude_test::ar1_noise(2000, 0.9, 1, 900 + seed));
    refused += from ? 0 : 1;
    lost += from ? static_cast<double>(*from) / 2000 / 200 : 0;
  }
  EXPECT_LT(lost, 0.15);  // of the record, on average: the mean's error grows by 8 %
  EXPECT_LE(refused, 4);  // 2 % of steady records
}

TEST(SteadyMean, HoldsTheTruthAsOftenAsItSays) {
  for (const double phi : {0.0, 0.9, 0.98}) {
    int held = 0;
    constexpr int runs = 200;
    for (std::uint64_t seed = 0; seed < runs; ++seed) {
      const auto mean = fit::steady_mean(froude_test::ar1_noise(4000, phi, 1, 3000 + seed));
      const double t = hydro::signal::student_t_quantile(0.975, mean.dof);
      held += std::abs(mean.value) < t * mean.error ? 1 : 0;
    }
    // 190 of 200 expected with a deviation of 3.1; what correlated.hpp says of its coverage: 0.92 to 0.98.
    EXPECT_GE(held, 0.90 * runs) << phi;
    EXPECT_LE(held, 0.99 * runs) << phi;
  }
}

// Var x̄ = σ²/n · (1 + φ)/(1 − φ) of a long AR(1) record.
TEST(SteadyMean, HasTheErrorOfItsMemory) {
  constexpr double phi = 0.95;
  double squares = 0;
  constexpr int runs = 60;
  for (std::uint64_t seed = 0; seed < runs; ++seed)
    squares += std::pow(fit::steady_mean(froude_test::ar1_noise(20000, phi, 2, 5000 + seed)).error, 2) / runs;
  const double expected = 4.0 / 20000 * (1 + phi) / (1 - phi);
  EXPECT_NEAR(squares, expected,
              0.1 * expected);  // an error of 20 % in each, 60 of them: 3 %, and the bias of order 1/n
}

TEST(SteadyMean, TellsADriftWithItsError) {
  auto values = froude_test::ar1_noise(4000, 0.5, 1, 8000);
  const auto before = fit::steady_mean(values);
  EXPECT_LT(std::abs(before.drift), 3 * before.drift_error);
  // σ² 12/n · (1 + φ)/(1 − φ): a line from −1/2 to 1/2 has the square n/12.
  EXPECT_NEAR(before.drift_error, std::sqrt(12.0 / 4000 * 3), 0.25 * before.drift_error);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 1e-3 * static_cast<double>(i);
  const auto after = fit::steady_mean(values);
  EXPECT_NEAR(after.drift - before.drift, 3.999, 1e-9);
  EXPECT_NEAR(after.drift_error, before.drift_error, 1e-9);  // the line takes all of it out
}

TEST(SteadyMean, OfAConstantIsExact) {
  const auto mean = fit::steady_mean(std::vector<double>(100, 1234.5));
  EXPECT_DOUBLE_EQ(mean.value, 1234.5);
  EXPECT_EQ(mean.error, 0);
  EXPECT_EQ(mean.drift, 0);
}

}  // namespace
}  // namespace steady_test
