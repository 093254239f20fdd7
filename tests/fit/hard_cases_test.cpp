// Records at the edges of what a fit can be asked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace hard_cases_test {
namespace {

const fit::Cylinder& cylinder = froude_test::held_cylinder;

/// C_D = 1.2, C_M = 1.8 in a sinusoid, with noise of a memory of ten samples.
fit::ForceRecord made(double amplitude, double period, double periods, double noise, std::size_t per_period = 200) {
  fit::ForceRecord r;
  const double omega = 2 * std::numbers::pi / period, step = period / static_cast<double>(per_period);
  const auto n = static_cast<std::size_t>(periods * static_cast<double>(per_period));
  const auto e = froude_test::ar1_noise(n, 0.9, noise, 3);
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j);
    r.time.push_back(t);
    r.velocity.push_back(amplitude * omega * std::cos(omega * t));
    r.acceleration.push_back(-amplitude * omega * omega * std::sin(omega * t));
    r.force.push_back(fit::morison_force(cylinder, 1.2, 1.8, r.velocity[j], r.acceleration[j]) + e[j]);
  }
  return r;
}

TEST(HardCase, OneCycleAloneGivesAWideInterval) {
  const auto one = fit::fit_morison(cylinder, made(0.4, 4, 1.05, 1)),
             ten = fit::fit_morison(cylinder, made(0.4, 4, 10, 1));
  EXPECT_LT(one.cd.interval.low, 1.2);
  EXPECT_GT(one.cd.interval.high, 1.2);
  EXPECT_GT(one.cd.interval.high - one.cd.interval.low, 2 * (ten.cd.interval.high - ten.cd.interval.low));
  EXPECT_THROW(fit::fit_morison(cylinder, made(0.4, 4, 0.8, 1)), hydro::InputError);  // less than one says so
}

TEST(HardCase, DragIsNotToldWhereKeuleganAndCarpentersNumberGoesToZero) {
  const auto f = fit::fit_morison(cylinder, made(0.002, 1, 50, 0.01));  // KC 0.1
  EXPECT_LT(f.kc, 0.15);
  EXPECT_FALSE(f.cd.value);
  EXPECT_FALSE(f.cd.why_not.empty());
  EXPECT_NEAR(f.inertia.value.value(), 1.8, 0.05);
}

TEST(HardCase, InertiaIsNotToldWhereItGoesToInfinity) {
  const auto f = fit::fit_morison(cylinder, made(60, 600, 20, 1));  // KC 3100: 12 N of drag, 0.07 N of inertia
  EXPECT_GT(f.kc, 3000);
  EXPECT_NEAR(f.cd.value.value(), 1.2, 0.05);
  EXPECT_FALSE(f.inertia.value);
  EXPECT_FALSE(f.inertia.why_not.empty());
}

TEST(HardCase, AMillionSamplesAreFittedLikeAThousand) {
  const auto f = fit::fit_morison(cylinder, made(0.4, 4, 20, 1, 50000));
  EXPECT_NEAR(f.cd.value.value(), 1.2, 0.05);
  EXPECT_LT(f.cd.effective_samples, 1.05e6);
}

TEST(HardCase, ARecordAtRestIsRefusedWithItsReason) {
  fit::RawRun run;
  run.force = {{"F", {}, {}}};
  const auto e = froude_test::ar1_noise(500, 0, 1, 1);
  for (std::size_t j = 0; j < 500; ++j) {
    run.time.push_back(0.01 * static_cast<double>(j));
    run.position.push_back(0.2);
    run.force[0].values.push_back(e[j]);
  }
  EXPECT_THAT([&] { fit::prepare(run, {}); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("position is 0.2 throughout")));
}

}  // namespace
}  // namespace hard_cases_test
