// Channels by themselves: each step against what is put into a made record, and all of them against those of a fit.
#include "fit/prepare_channels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/band_pass.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/harmonics.hpp"

namespace prepare_channels_test {
namespace {

using fit::prepare_channels;
using testing::Contains;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double sample_step = 0.1, two_pi = 2 * std::numbers::pi;

std::vector<double> times(std::size_t n) {
  std::vector<double> t(n);
  for (std::size_t j = 0; j < n; ++j) t[j] = sample_step * static_cast<double>(j);
  return t;
}

template <class Function>
std::vector<double> values_of(const std::vector<double>& t, Function f) {
  std::vector<double> out;
  for (const double at : t) out.push_back(f(at));
  return out;
}

fit::WindowChoice span(double from, double to) {
  return {.kind = fit::WindowChoice::Kind::span, .from = from, .to = to};
}

// A cosine about the middle is even, so that its own line is level: the line put in is all that goes. Its mean over the
// record stays.
TEST(PrepareChannels, TakesALineOffAndLeavesTheWaveAndTheMean) {
  const auto t = times(4001);  // 400 s
  const auto wave = [](double at) { return 5 + 1.5 * std::cos(two_pi / 8 * (at - 200)); };
  const auto p = prepare_channels(t, {{"heave", values_of(t, [&](double at) { return wave(at) + 0.03 * (at - 200); })}},
                                  {.detrend = true});
  for (std::size_t j = 0; j < t.size(); ++j) ASSERT_NEAR(p.channels[0].values[j], wave(t[j]), 1e-11);  // rounding
  EXPECT_THAT(p.steps, Contains(HasSubstr("heave changes by 12 from 0 s to 400 s")));
}

// What comes before the window does not bend its line: here the body was let go from 30 m off.
TEST(PrepareChannels, TakesTheLineOfTheWindow) {
  const auto t = times(4001);
  const auto wave = [](double at) { return std::cos(two_pi / 8 * (at - 300)); };
  const auto p = prepare_channels(
      t, {{"surge", values_of(t, [&](double at) { return at < 150 ? 30 - at : wave(at) + 0.03 * (at - 300); })}},
      {.detrend = true, .window = span(200, 400)});
  ASSERT_EQ(p.time.size(), 2001u);
  for (std::size_t j = 0; j < p.time.size(); ++j) ASSERT_NEAR(p.channels[0].values[j], wave(p.time[j]), 1e-11);
}

TEST(PrepareChannels, FindsOutliersPutInByHandAndBridgesThem) {
  const auto t = times(3000);
  const auto wave = [](double at) { return std::cos(two_pi / 8 * at); };
  auto x = values_of(t, wave), other = values_of(t, [](double at) { return std::sin(two_pi / 8 * at); });
  const std::vector<std::size_t> spoilt{17, 400, 401, 1733};
  for (const std::size_t j : spoilt) x[j] += j % 2 == 0 ? 3 : -2;
  const auto p = prepare_channels(t, {{"x", x}, {"other", other}}, {.outlier_window_s = 2.05});
  EXPECT_EQ(p.channels[0].outliers, spoilt.size());
  EXPECT_EQ(p.channels[1].outliers, 0u);
  // (F22): a straight line over a gap of three steps loses (ωτ)²/8 = 0.0069 of a harmonic.
  const double lost = std::pow(two_pi / 8 * 0.3, 2) / 8;
  for (std::size_t j = 0; j < t.size(); ++j) ASSERT_NEAR(p.channels[0].values[j], wave(t[j]), lost) << j;
}

// 8 s lie where the band is flat, within 1 % as it states; 60 s and 1.5 s outside lose what the gain of the closed form
// says (F108).
TEST(PrepareChannels, PassesTheWavesAndTakesOthersByTheGainOfTheBand) {
  const auto t = times(8001);
  const std::vector<double> hz{1.0 / 60, 0.125, 1 / 1.5};
  const auto p = prepare_channels(t,
                                  {{"x", values_of(t,
                                                   [&](double at) {
                                                     double sum = 0;
                                                     for (const double f : hz) sum += std::cos(two_pi * f * at);
                                                     return sum;
                                                   })}},
                                  {.band_pass = fit::BandEdges{0.025, 0.5}});
  const auto h = hydro::signal::fit_harmonics(p.time, p.channels[0].values,
                                              std::vector{two_pi * hz[0], two_pi * hz[1], two_pi * hz[2]});
  const auto G = [](double f) {
    const auto low = [&](double cutoff) {
      return 1 / (1 + std::pow(std::tan(std::numbers::pi * f * sample_step) /
                                   std::tan(std::numbers::pi * cutoff * sample_step),
                               8));
    };
    return low(0.5) - low(0.025);
  };
  for (std::size_t i = 0; i < 3; ++i)  // 1e-4 of the filter's memory at the ends
    EXPECT_NEAR(std::abs(h.amplitude[i]), G(hz[i]), 2e-4) << hz[i] << " Hz";
  EXPECT_NEAR(std::abs(h.amplitude[1]), 1, 0.01);
  EXPECT_LT(std::abs(h.amplitude[0]), 0.05);
}

// What happened before and after a record does not matter within the window that is told as steady: 1e-4 of the
// filter's memory for each of four sections of two passes, beside waves of 1 m.
TEST(PrepareChannels, LeavesOnlyWhatDoesNotLeanOnWhatLiesBeyondTheRecord) {
  const auto all = times(12001);
  const auto sea =
      values_of(all, [](double at) { return std::cos(0.7 * at) + std::cos(0.31 * at + 1) + 0.4 * std::sin(1.3 * at); });
  const fit::PrepareOptions steps{.band_pass = fit::BandEdges{0.025, 0.5}};
  const auto whole = prepare_channels(all, {{"x", sea}}, steps);
  const std::vector<double> part_time(all.begin() + 3000, all.begin() + 9001),
      part_sea(sea.begin() + 3000, sea.begin() + 9001);
  const auto part = prepare_channels(part_time, {{"x", part_sea}}, steps);
  EXPECT_EQ(part.steady_from_s, part.time.front());
  EXPECT_EQ(part.steady_to_s, part.time.back());
  EXPECT_NEAR(part.steady_from_s - 300, 600 + 300 - part.steady_to_s, 1e-6) << "both ends lose as much";
  const auto offset = static_cast<std::size_t>(std::lround((part.time.front() - whole.time.front()) / sample_step));
  for (std::size_t j = 0; j < part.time.size(); ++j)
    ASSERT_NEAR(part.channels[0].values[j], whole.channels[0].values[j + offset], 2e-3) << part.time[j];
}

/// A record with rows missing and spikes, of which both channels have their own.
struct Spoilt {
  std::vector<double> time, speed, force;
  Spoilt() {
    for (std::size_t j = 0; j < 6000; ++j) {
      if (j % 1201 == 300 || j % 1201 == 301) continue;
      const double at = sample_step * static_cast<double>(j);
      time.push_back(at);
      speed.push_back(std::cos(two_pi / 8 * at) + (j == 2500 ? 4 : 0));
      force.push_back(3 * std::cos(two_pi / 8 * at + 0.4) + 0.2 * std::sin(two_pi * 2.1 * at) + (j == 777 ? -9 : 0));
    }
  }
};

TEST(PrepareChannels, GivesAMotionAsAFitSeesIt) {
  const Spoilt s;
  const fit::PrepareOptions options{.longest_gap_s = 0.35, .outlier_window_s = 2.05, .window = span(100, 500)};
  const auto as_fit = fit::prepare_motion("speed", s.time, s.speed, options);
  const auto p = prepare_channels(s.time, {{"speed", s.speed}}, options);
  EXPECT_EQ(p.time, as_fit.time);
  EXPECT_EQ(p.channels[0].values, as_fit.values);
  EXPECT_EQ(p.step, as_fit.step);
  EXPECT_EQ(p.steps, as_fit.steps);
  EXPECT_EQ(p.filled, 10u);
}

TEST(PrepareChannels, GivesAFilteredForceAsAFitSeesIt) {
  const Spoilt s;
  using enum fit::FilterChoice::Kind;
  const fit::PrepareOptions options{
      .longest_gap_s = 0.35,
      .outlier_window_s = 2.05,
      .resample_hz = 8,
      .filters = {{.kind = notch, .hz = 2.1, .width = 0.3}, {.kind = butterworth, .hz = 1}}};
  const auto as_fit = fit::prepare_towing({.time = s.time, .speed = s.speed, .force = {{"F", s.force, {}}}}, options);
  const auto p = prepare_channels(s.time, {{"F", s.force}}, options);
  EXPECT_EQ(p.time, as_fit.time);
  EXPECT_EQ(p.channels[0].values, as_fit.force);
}

TEST(PrepareChannels, RefusesWhatCannotBeDone) {
  const auto t = times(1000);
  const auto x = values_of(t, [](double at) { return std::cos(at); });
  const auto refused = [&](const fit::PrepareOptions& steps) {
    return [&, steps] { prepare_channels(t, {{"x", x}}, steps); };
  };
  using hydro::InputError;
  EXPECT_THAT(refused({.window = span(200, 300)}), ThrowsMessage<InputError>(HasSubstr("lies outside")));
  EXPECT_THAT(refused({.delay_s = 1}), ThrowsMessage<InputError>(HasSubstr("not moved in time")));
  EXPECT_THAT(refused({.band_pass = fit::BandEdges{0.02, 0.5}}), ThrowsMessage<InputError>(HasSubstr("nothing would")));
  EXPECT_THAT(refused({.outlier_window_s = 0.2}), ThrowsMessage<InputError>(HasSubstr("ten samples")));
  EXPECT_THAT([&] { fit::prepare_motion("x", t, x, {.detrend = true}); },
              ThrowsMessage<InputError>(HasSubstr("not filtered, straightened")));
  EXPECT_THAT(
      [&] {
        fit::prepare_towing({.time = t, .speed = x, .force = {{"F", x, {}}}}, {.band_pass = fit::BandEdges{0.1, 1}});
      },
      ThrowsMessage<InputError>(HasSubstr("what a force does on average")));
  EXPECT_THAT([&] { prepare_channels(t, {}, {}); }, ThrowsMessage<InputError>(HasSubstr("needs a channel")));
  EXPECT_THAT([&] { prepare_channels(t, {{"x", {1, 2}}}, {}); }, ThrowsMessage<InputError>(HasSubstr("x has 2")));
  auto gap = t;
  gap.erase(gap.begin() + 500, gap.begin() + 503);
  EXPECT_THAT(
      [&] {
        prepare_channels(gap, {{"x", {x.begin(), x.end() - 3}}}, {});
      },
      ThrowsMessage<InputError>(
          testing::AllOf(HasSubstr("0.4 s are missing after 49.9 s"), HasSubstr("a longest gap of 0.4 s bridges it"))));
}

}  // namespace
}  // namespace prepare_channels_test
