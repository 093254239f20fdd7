// Regular waves that take turns, as sums of linear waves. (W102)
#include "hydro/waves/kinematics/trains.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace trains_test {
namespace {

using namespace hydro::waves;
using hydro::InputError;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double pi = std::numbers::pi, tolerance = 1e-3;
const hydro::Water deep{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::infinite()};

WaveTrain train(double amplitude, double period, double phase, double from, double fade) {
  return {hydro::WaveAmplitude::from_metres(amplitude),
          hydro::AngularFrequency::from_period_s(period),
          phase,
          hydro::Angle::from_radians(0),
          from,
          fade};
}

/// 7.5 s, then 3.5 s from 100 s on, then 5 s; the span begins 60 s before and ends 100 s after.
const std::vector<WaveTrain> three{train(0.3, 7.5, 0.4, -60, 30), train(0.2, 3.5, -1, 100, 20),
                                   train(0.3, 5, 2, 180, 30)};
const TrainCut cut{-60, 350, tolerance};

double share(double t, double from, double fade) {
  const double s = std::clamp((t - from) / fade, 0.0, 1.0);
  return (1 - std::cos(pi * s)) / 2;
}

/// What trains are at their place, put down directly.
double given(double t) {
  double out = 0;
  for (std::size_t i = 0; i < three.size(); ++i) {
    const WaveTrain& w = three[i];
    const double come = share(t, w.from_s, w.fade_s);
    const double gone = i + 1 < three.size() ? share(t, three[i + 1].from_s, three[i + 1].fade_s) : share(t, 320, 30);
    out += (come - gone) * w.amplitude.metres() * std::cos(w.omega.rad_per_s() * t + w.phase);
  }
  return out;
}

// Components below and above the band are two shares of the tolerance, at most; three trains never fade at once.
TEST(WaveTrains, AreAtTheirPlaceWhatTheyAreSaidToBe) {
  const TrainComponents found = components_of(three, cut);
  EXPECT_LT(found.left_out, 3 * tolerance);
  const Sea sea = Sea::of(found.waves, deep);
  double worst = 0;
  for (double t = -60; t < 350; t += 0.37) worst = std::max(worst, std::abs(sea.elevation(t, 0, 0) - given(t)));
  EXPECT_LT(worst, found.left_out * (0.3 + 0.3));
  EXPECT_GT(worst, 0);
}

// More components come nearer, as fast as the bound says.
TEST(WaveTrains, ComeAsNearAsTheirBoundSays) {
  for (const double wanted : {1e-2, 1e-4}) {
    const TrainComponents found = components_of(three, {-60, 350, wanted});
    EXPECT_LT(found.left_out, 3 * wanted);
    const Sea sea = Sea::of(found.waves, deep);
    for (double t = -60; t < 350; t += 1.7)
      EXPECT_NEAR(sea.elevation(t, 0, 0), given(t), found.left_out * 0.6) << wanted << " at " << t;
  }
}

// A long fade goes along at the group velocity g/2ω and keeps its shape but for ½ k″ x e″: with k″ = 2/g, e″ ≤
// (π/w)²/2.
TEST(WaveTrains, TravelAtTheGroupVelocity) {
  const std::vector<WaveTrain> two{train(0.5, 6, 0, -200, 60), train(0.1, 6, 0, 0, 60)};
  const Sea sea = Sea::of(components_of(two, {-200, 400, 1e-4}).waves, deep);
  const double omega = 2 * pi / 6, k = omega * omega / deep.gravity, x = 150, late = x / group_velocity(omega, deep);
  EXPECT_GT(late, 30);
  const double spread = 0.5 / deep.gravity * x * std::pow(pi / 60, 2);
  for (double t = 0; t < 120; t += 1.3) {
    const double size = 0.5 - 0.4 * share(t - late, 0, 60);
    EXPECT_NEAR(sea.elevation(t, x, 0), size * std::cos(omega * t - k * x), 0.4 * spread + 1e-4) << t;
  }
}

// What a band of data cuts off is in the bound.
TEST(WaveTrains, TellWhatABandLeavesOut) {
  TrainCut narrow = cut;
  narrow.lowest = 0.7;
  narrow.highest = 2;
  const TrainComponents found = components_of(three, narrow);
  EXPECT_GT(found.left_out, 5 * tolerance);
  const Sea sea = Sea::of(found.waves, deep);
  double worst = 0;
  for (double t = -60; t < 350; t += 0.37) worst = std::max(worst, std::abs(sea.elevation(t, 0, 0) - given(t)));
  EXPECT_GT(worst, 0.3 * 2 * tolerance);
  EXPECT_LT(worst, found.left_out * 0.6);
  for (const GivenWave& w : found.waves) {
    EXPECT_GE(w.omega.rad_per_s(), 0.7);
    EXPECT_LE(w.omega.rad_per_s(), 2);
  }
}

TEST(WaveTrains, SayWhatCannotBe) {
  const auto refuses = [](std::vector<WaveTrain> trains, TrainCut of, const char* with) {
    EXPECT_THAT([&] { components_of(trains, of); }, ThrowsMessage<InputError>(HasSubstr(with)));
  };
  refuses({}, cut, "no train");
  refuses({train(1, 5, 0, 0, 0)}, cut, "a fade that is longer than nothing");
  refuses({train(1, 5, 0, 0, 30), train(1, 5, 0, 20, 30)}, cut, "train 1 goes at 20 s, before it is whole at 30 s");
  refuses({train(1, 5, 0, 0, 30)}, {-60, 50, tolerance}, "train 1 goes at 20 s");
  refuses({train(1, 5, 0, -70, 30)}, cut, "before the span");
}

}  // namespace
}  // namespace trains_test
