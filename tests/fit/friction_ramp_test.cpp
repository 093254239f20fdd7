// A torque that grows until a brake slips: levels that are known because they are put in here.
#include "fit/friction_ramp.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace friction_ramp_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double step = 0.01, rate = 0.8, rest = 0.6;

struct Test {
  std::vector<double> time, torque;
};
/// Rest, a ramp to `held`, a slide of three seconds at `slides`, and the load taken off; noise of a memory of 0.05 s.
Test brake(double held, double slides, double noise, std::uint64_t stream, double sign = 1, double drift = 0) {
  Test out;
  const double slips = rest + held / rate;
  const auto n = static_cast<std::size_t>((slips + 4) / step);
  const auto e = froude_test::ar1_noise(n, 0.8, noise, stream);
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j);
    const double m = t < slips ? std::max(0.0, rate * (t - rest)) : t < slips + 3 ? slides + drift * (t - slips) : 0.0;
    out.time.push_back(t);
    out.torque.push_back(sign * m + e[j]);
  }
  return out;
}
const fit::FrictionRampOptions usual{.ramp_s = 2, .slide_s = 2.5};

TEST(FrictionRamp, GivesBothLevelsOfACleanTestBack) {
  for (const double sign : {1.0, -1.0}) {
    const auto b = brake(3.7, 3.0, 0, 1, sign);
    const auto f = fit::fit_friction_ramp(b.time, b.torque, usual);
    // The slip is known to half a sample, in which the torque grows by 0.004.
    EXPECT_NEAR(*f.static_level.value, sign * 3.7, rate * step / 2 + 1e-9);
    EXPECT_NEAR(*f.dynamic_level.value, sign * 3.0, 1e-9);
    EXPECT_NEAR(*f.drop.value, 0.7, rate * step / 2 + 1e-9);
    EXPECT_NEAR(f.slip_s, rest + 3.7 / rate, step);
    EXPECT_NEAR(f.rate, sign * rate, 1e-9);
    EXPECT_GT(f.static_level.interval.high, f.static_level.interval.low);  // the instant alone is not known better
    EXPECT_TRUE(f.caution.empty());
  }
}

TEST(FrictionRamp, IsNotTakenInByTheEndOfTheTest) {
  const auto b = brake(3.2, 3.1, 0.02, 2);  // slips by 0.1; the load that is taken off falls by 3.1
  const auto f = fit::fit_friction_ramp(b.time, b.torque, usual);
  EXPECT_NEAR(f.slip_s, rest + 3.2 / rate, 0.1);
}

TEST(FrictionRamp, HasIntervalsThatHold) {
  int held = 0, slid = 0, fell = 0;
  constexpr int sets = 300;
  for (int k = 0; k < sets; ++k) {
    const auto b = brake(3.7, 3.0, 0.05, static_cast<std::uint64_t>(10 + k));
    const auto f = fit::fit_friction_ramp(b.time, b.torque, usual);
    const auto holds = [](const fit::Coefficient& c, double truth) {
      return c.interval.low < truth && truth < c.interval.high;
    };
    held += holds(f.static_level, 3.7);
    slid += holds(f.dynamic_level, 3.0);
    fell += holds(f.drop, 0.7);
  }
  // 95 % of 300 is 285 with a binomial deviation of 3.8; records of forty memories lose some of it (F4).
  for (const int covered : {held, slid, fell}) EXPECT_GE(covered, 270);
}

TEST(FrictionRamp, LeavesWhatAFilterSpoiltOut) {
  auto b = brake(3.7, 3.0, 0.0, 3);
  const auto raw = b.torque;
  for (std::size_t j = 12; j + 12 < raw.size(); ++j) {  // a moving average over 25 samples, as Van Zanten's
    double sum = 0;
    for (std::size_t i = j - 12; i <= j + 12; ++i) sum += raw[i] / 25;
    b.torque[j] = sum;
  }
  fit::FrictionRampOptions wide = usual;
  wide.drop_s = 0.26;
  const auto f = fit::fit_friction_ramp(b.time, b.torque, wide);
  // A line stays a line under an average; 24 of the 26 samples left out are spoilt, so the corner is known to one.
  EXPECT_NEAR(*f.static_level.value, 3.7, 1.01 * rate * step);
  EXPECT_NEAR(*f.dynamic_level.value, 3.0, 1e-9);
  const auto g = fit::fit_friction_ramp(b.time, b.torque, usual);
  EXPECT_LT(*g.static_level.value, *f.static_level.value - 0.02);  // taken as it is, the corner is rounded off
}

TEST(FrictionRamp, SaysWhereTheSlideIsNoLevel) {
  const auto b = brake(3.7, 3.0, 0.02, 4, 1, -0.2);
  const auto f = fit::fit_friction_ramp(b.time, b.torque, usual);
  EXPECT_THAT(f.caution, HasSubstr("no constant"));
  EXPECT_NEAR(f.slide_rate, -0.2, 0.02);
}

TEST(FrictionRamp, RefusesATestThatDidNotSlip) {
  auto b = brake(3.7, 3.0, 0.02, 5);
  const auto whole = static_cast<std::size_t>((rest + 3.7 / rate) / step) - 5;
  const std::span<const double> time(b.time), torque(b.torque);
  EXPECT_THAT([&] { fit::fit_friction_ramp(time.first(whole), torque.first(whole), usual); },
              ThrowsMessage<hydro::InputError>(HasSubstr("has not slipped")));
  EXPECT_THAT([&] { fit::fit_friction_ramp(time.first(whole), torque.first(whole - 1), usual); },
              ThrowsMessage<hydro::InputError>(HasSubstr("torques")));
  EXPECT_THROW(fit::fit_friction_ramp(time, torque, {.ramp_s = 0.1, .slide_s = 2}), hydro::InputError);
  EXPECT_THROW(fit::fit_friction_ramp(time, torque, {.ramp_s = 5, .slide_s = 8}), hydro::InputError);
}

}  // namespace
}  // namespace friction_ramp_test
