#include "fit/camera/smooth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace camera_smooth_test {
namespace {

using fit::camera::smooth;
using fit::camera::SmoothTrack;
using fit::camera::Track;
using std::numbers::pi;
using testing::HasSubstr;

constexpr double step = 0.005, sd = 0.3;

/// Markers that move by `place(marker, time)`, with white noise.
template <class Place>
Track filmed(int markers, int frames, double noise, std::uint64_t seed, Place place) {
  const hydro::RandomStream random(seed, 31);
  Track out;
  for (int m = 0; m < markers; ++m) out.markers.push_back({std::string(1, static_cast<char>('a' + m)), {}});
  std::uint64_t i = 0;
  for (int k = 0; k < frames; ++k) {
    out.time.push_back(step * k);
    for (int m = 0; m < markers; ++m) {
      const Eigen::Vector2d error(random.normal(i), random.normal(i + 1));
      i += 2;
      out.markers[static_cast<std::size_t>(m)].seen.push_back(
          fit::camera::Sighting{place(m, out.time.back()) + noise * error, sd * sd * Eigen::Matrix2d::Identity()});
    }
  }
  return out;
}

template <class Call>
std::string refused(Call call) {
  try {
    call();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "nothing was refused";
}

TEST(Smoother, HasTheVariancesOfWienersFilterFarFromTheEnds) {
  const SmoothTrack s =
      smooth(filmed(1, 801, 0, 1, [](int, double) { return Eigen::Vector2d(0, 0); }), {.bandwidth_hz = 3});
  const double omega = 2 * pi * s.cutoff_hz, level = sd * sd * step;
  const auto middle = s.marker(0, 400);
  // Integrals of N H/2π, N H ω²/2π and N H ω⁴/2π with H = 1/(1 + (ω/ω_c)⁶). Sampling at ω_c Δt = 0.2 changes them by
  // terms of that squared over twelve, as found with half and a quarter of the step.
  EXPECT_NEAR(middle.place_sd.x() / std::sqrt(level * omega / 3), 1, 5e-3);
  EXPECT_NEAR(middle.velocity_sd.y() / std::sqrt(level * std::pow(omega, 3) / 6), 1, 5e-3);
  EXPECT_NEAR(middle.acceleration_sd.x() / std::sqrt(level * std::pow(omega, 5) / 3), 1, 1e-2);
}

TEST(Smoother, KeepsAndLosesSinesAsItsGainSays) {
  for (const double hertz : {1.0, 3.0, 6.0, 9.0}) {
    const double omega = 2 * pi * hertz;
    const SmoothTrack s = smooth(
        filmed(1, 1201, 0, 1, [&](int, double t) { return Eigen::Vector2d(std::sin(omega * t), std::cos(omega * t)); }),
        {.bandwidth_hz = 3});
    const double gain = 1 / (1 + std::pow(hertz / s.cutoff_hz, 6));
    const auto now = s.marker(0, 600);
    const double t = s.time[600];
    // The ends are five time constants of the slowest pole and more away; sampling as above.
    EXPECT_NEAR(now.place.x(), gain * std::sin(omega * t), 3e-3) << hertz;
    EXPECT_NEAR(now.velocity.x() / omega, gain * std::cos(omega * t), 3e-3) << hertz;
    EXPECT_NEAR(now.acceleration.y() / (omega * omega), -gain * std::cos(omega * t), 3e-3) << hertz;
  }
}

/// A slow swing of two markers about each other and of both.
Eigen::Vector2d swinging(int m, double t) {
  const double angle = 0.8 * std::sin(2 * pi * 0.7 * t);
  const Eigen::Vector2d middle(20 * std::sin(2 * pi * 0.4 * t), 5 * std::cos(2 * pi * 0.5 * t));
  return middle + (m == 0 ? -1 : 1) * 50 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

TEST(Smoother, CoversPlacesRatesAndAnglesAtEverySeed) {
  double inside[4] = {}, n = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SmoothTrack s = smooth(filmed(2, 300, sd, seed, swinging), {.bandwidth_hz = 3});
    for (std::size_t i = 10; i < 290; i += 20, ++n) {
      const double t = s.time[i], h = 1e-4;
      const auto now = s.marker(1, i);
      const Eigen::Vector2d velocity = (swinging(1, t + h) - swinging(1, t - h)) / (2 * h);
      const auto angle = s.angle(0, 1, i);
      inside[0] += std::abs(now.place.x() - swinging(1, t).x()) < 1.96 * now.place_sd.x();
      inside[1] += std::abs(now.velocity.y() - velocity.y()) < 1.96 * now.velocity_sd.y();
      inside[2] += std::abs(angle.angle - 0.8 * std::sin(2 * pi * 0.7 * t)) < 1.96 * angle.angle_sd;
      inside[3] += std::abs(angle.rate - 0.8 * 2 * pi * 0.7 * std::cos(2 * pi * 0.7 * t)) < 1.96 * angle.rate_sd;
    }
  }
  // 280 nearly independent instants: 0.95 less four deviations of a share. Intervals are wider than noise by √(6/5) in
  // places and √2 in rates, so nearly all may lie inside.
  for (const double share : inside) EXPECT_GT(share / n, 0.90);
  EXPECT_LT(inside[0] / n, 0.995) << "an interval that nothing leaves is none";
}

TEST(Smoother, CrossesAGapWithGrowingUncertainty) {
  Track t = filmed(1, 200, sd, 3, swinging);
  for (std::size_t i = 90; i < 110; ++i) t.markers[0].seen[i].reset();
  const SmoothTrack s = smooth(t, {.bandwidth_hz = 3});
  const auto inside = s.marker(0, 100), outside = s.marker(0, 50);
  EXPECT_GT(inside.place_sd.x(), 1.5 * outside.place_sd.x());
  EXPECT_LT((inside.place - swinging(0, s.time[100])).norm(), 4 * inside.place_sd.norm());
}

TEST(Smoother, KnownLengthTellsWhereAHiddenMarkerIs) {
  Track t = filmed(2, 200, sd, 5, swinging);
  for (std::size_t i = 90; i < 110; ++i) t.markers[1].seen[i].reset();
  const SmoothTrack free = smooth(t, {.bandwidth_hz = 3}),
                    held = smooth(t, {.bandwidth_hz = 3, .lengths = {{"a", "b", 100, 0.05}}});
  EXPECT_GT(held.rounds, 0);
  const auto with = held.marker(1, 100);
  // Along the line it is known as well as the marker that is seen.
  const Eigen::Vector2d line = (with.place - held.marker(0, 100).place).normalized();
  const auto along = [&](const SmoothTrack& s, Eigen::Index marker) {
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(12);
    slope[6 * marker] = line.x();
    slope[6 * marker + 3] = line.y();
    return std::sqrt(slope.dot(s.covariance[100] * slope));
  };
  EXPECT_LT(along(held, 1), 1.1 * along(free, 0));
  EXPECT_GT(along(free, 1), 1.4 * along(free, 0));
  EXPECT_LT((with.place - swinging(1, held.time[100])).norm(), 4 * with.place_sd.norm());
  for (std::size_t i = 0; i < 200; i += 10)
    EXPECT_NEAR((held.marker(1, i).place - held.marker(0, i).place).norm(), 100, 0.2);
}

TEST(Smoother, AnglesSlopesAreThoseOfTheirFormulas) {
  SmoothTrack s = smooth(filmed(2, 100, sd, 7, swinging), {.bandwidth_hz = 3});
  // One number uncertain at a time: the deviation is the slope along it.
  for (Eigen::Index k = 0; k < 12; ++k) {
    SmoothTrack one = s;
    one.covariance[50].setZero();
    one.covariance[50](k, k) = 1;
    const double h = 1e-4;
    SmoothTrack up = s, down = s;
    up.state[50][k] += h;
    down.state[50][k] -= h;
    const auto a = up.angle(0, 1, 50), b = down.angle(0, 1, 50), told = one.angle(0, 1, 50);
    EXPECT_NEAR(std::abs(a.angle - b.angle) / (2 * h), told.angle_sd, 1e-8) << k;
    EXPECT_NEAR(std::abs(a.rate - b.rate) / (2 * h), told.rate_sd, 1e-7) << k;
    EXPECT_NEAR(std::abs(a.acceleration - b.acceleration) / (2 * h), told.acceleration_sd, 1e-6) << k;
  }
}

TEST(Smoother, SaysWhatItLacks) {
  Track t = filmed(2, 20, sd, 1, swinging);
  EXPECT_THAT(refused([&] { smooth(t, {}); }), HasSubstr("bandwidth"));
  EXPECT_THAT(refused([&] {
                smooth(t, {.bandwidth_hz = 3, .lengths = {{"a", "c", 1, 0.1}}});
              }),
              HasSubstr("no marker \"c\""));
  EXPECT_THAT(refused([&] { smooth(t, {.bandwidth_hz = 400}); }), HasSubstr("no motion up to 400 Hz"));
  EXPECT_THAT(refused([&] {
                smooth(t, {.bandwidth_hz = 3, .lengths = {{"a", "b", 90, 1}}});
              }),
              HasSubstr("\"a\" and \"b\" are 100 apart in the track, and 90"));
  t.markers[0].seen.assign(20, std::nullopt);
  EXPECT_THAT(refused([&] { smooth(t, {.bandwidth_hz = 3}); }), HasSubstr("\"a\" is in no frame"));
}

}  // namespace
}  // namespace camera_smooth_test
