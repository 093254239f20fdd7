// The curve behind a record in steps. (F111)
#include "fit/levels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/differentiate.hpp"
#include "fit/prepare_channels.hpp"
#include "hydro/base/random.hpp"

namespace levels_test {
namespace {

constexpr double pi = std::numbers::pi, dt = 0.01, step = 0.3;
constexpr int samples = 3000;

/// A swing in degrees that dies out from 4 of them, in steps of the size of those of a coarse potentiometer; and its
/// rate.
double swing(double t) { return 4 * std::exp(-0.06 * t) * std::sin(2 * pi * t / 1.7 + 0.3); }
double rate(double t) {
  const double w = 2 * pi / 1.7;
  return 4 * std::exp(-0.06 * t) * (w * std::cos(w * t + 0.3) - 0.06 * std::sin(w * t + 0.3));
}

double to_level(double x) { return step * std::round(x / step); }

template <class Signal>
std::vector<double> sampled(Signal signal) {
  std::vector<double> out;
  for (int i = 0; i < samples; ++i) out.push_back(signal(dt * i));
  return out;
}
double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}
double largest(const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, std::abs(a[i] - b[i]));
  return out;
}

// A level leaves half a step open; what is known besides, the instants of the jumps and the middles, is worth more than
// a factor of three, as was found here: crests and troughs are what is left.
TEST(Levels, GiveASmoothAngleBack) {
  const auto truth = sampled(swing), raw = sampled([](double t) { return to_level(swing(t)); });
  const auto curve = fit::through_levels(raw);
  ASSERT_TRUE(curve);
  EXPECT_NEAR(curve->step, step, 1e-12);
  EXPECT_GT(curve->flat_parts, 200u);
  EXPECT_LT(largest(curve->values, truth), step / 2);
  EXPECT_NEAR(rms(raw, truth), step / std::sqrt(12), 0.1 * step);
  EXPECT_LT(rms(curve->values, truth), rms(raw, truth) / 3);
  EXPECT_LE(curve->largest_change, 0.5 + 1e-9);
}

// By the same weights, right to 1 % up to 2 Hz.
TEST(Levels, GiveItsVelocityBack) {
  const auto raw = sampled([](double t) { return to_level(swing(t)); });
  const auto of = [&](const std::vector<double>& values) {
    const fit::Motion m = fit::from_position(values, dt, 2);
    std::vector<double> truth;
    for (std::size_t i = 0; i < m.velocity.size(); ++i) truth.push_back(rate(dt * static_cast<double>(m.first + i)));
    return rms(m.velocity, truth);
  };
  const double before = of(raw), after = of(fit::through_levels(raw)->values);
  EXPECT_LT(after, 0.5 * before);
  EXPECT_LT(after, 0.02 * 4 * 2 * pi / 1.7);
}

// A spline through jumps alone would swing far out over a long rest.
TEST(Levels, StayWhereTheRecordRests) {
  const auto ramp = [](double t) { return t < 5 ? 1.2 * t : t < 25 ? 6.0 : 6 - 1.2 * (t - 25); };
  const auto raw = sampled([&](double t) { return to_level(ramp(t)); });
  const auto curve = fit::through_levels(raw);
  ASSERT_TRUE(curve);
  for (int i = 0; i < samples; ++i)
    ASSERT_NEAR(curve->values[static_cast<std::size_t>(i)], raw[static_cast<std::size_t>(i)], step / 2 * (1 + 1e-9))
        << dt * i;
  EXPECT_NEAR(curve->values[1500], 6, step / 10);
}

// Noise has the sensor go to and fro between two levels near each jump.
TEST(Levels, HoldWithNoiseOfATenthOfAStep) {
  const hydro::RandomStream random(3, 1);
  std::uint64_t k = 0;
  const auto truth = sampled(swing);
  const auto raw = sampled([&](double t) { return to_level(swing(t) + 0.1 * step * random.normal(k++)); });
  const auto curve = fit::through_levels(raw);
  ASSERT_TRUE(curve);
  EXPECT_LT(rms(curve->values, truth), 0.6 * rms(raw, truth));
}

TEST(Levels, AreNotMadeWhereThereAreNone) {
  EXPECT_FALSE(fit::through_levels(sampled(swing)));
  EXPECT_FALSE(fit::through_levels(std::vector<double>(100, 1.5)));
}

TEST(Levels, AreAStepOfARecord) {
  fit::PrepareOptions options;
  options.through_levels = true;
  std::vector<double> time;
  for (int i = 0; i < samples; ++i) time.push_back(dt * i);
  const auto raw = sampled([](double t) { return to_level(swing(t)); });
  const auto done = fit::prepare_channels(time, {{"angle", raw}, {"smooth", sampled(swing)}}, options);
  EXPECT_EQ(done.channels[0].values, fit::through_levels(raw)->values);
  EXPECT_EQ(done.channels[1].values, sampled(swing));
  std::string told;
  for (const auto& s : done.steps) told += s + "\n";
  EXPECT_NE(told.find("levels: angle goes on a spline"), std::string::npos) << told;
  EXPECT_NE(told.find("levels: smooth knows more than a thousand"), std::string::npos) << told;
}

}  // namespace
}  // namespace levels_test
