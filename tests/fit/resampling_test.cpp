#include "fit/resampling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/morison.hpp"
#include "hydro/base/error.hpp"
#include "support/morison_records.hpp"

namespace resampling_test {
namespace {

using fit::IntervalMethod;
const fit::Cylinder& cylinder = froude_test::held_cylinder;

/// Fourteen cycles of 4 s at 20 Hz, C_D = 1.2 and C_M = 1.8, with AR(1) noise of 3 N.
fit::ForceRecord record(double phi, std::uint64_t stream) {
  return froude_test::swinging_water(1120, 0.05, phi, stream);
}

struct Coverage {
  double cd, inertia, width;  // shares of sets whose interval holds the truth; mean half width of C_D
};
Coverage coverage(IntervalMethod method, double phi, int sets) {
  Coverage c{0, 0, 0};
  for (int i = 0; i < sets; ++i) {
    const auto f = fit::fit_morison(cylinder, record(phi, 1000 + static_cast<std::uint64_t>(i)), {.method = method});
    c.cd += (f.cd.interval.low < 1.2 && 1.2 < f.cd.interval.high) / static_cast<double>(sets);
    c.inertia += (f.inertia.interval.low < 1.8 && 1.8 < f.inertia.interval.high) / static_cast<double>(sets);
    c.width += (f.cd.interval.high - f.cd.interval.low) / 2 / sets;
  }
  return c;
}

// A share of N sets with p = 0.95 has the deviation √(0.95·0.05/N): 0.0049 for 2000, so 0.92 to 0.98 is six of them,
// and 0.011 for 400.
TEST(Coverage, Of2000SetsIsWithin92And98PercentForWhiteAndCorrelatedNoise) {
  for (const double phi : {0.0, 0.85}) {
    const Coverage c = coverage(IntervalMethod::effective_samples, phi, 2000);
    for (const double share : {c.cd, c.inertia}) {
      EXPECT_GE(share, 0.92) << "φ = " << phi;
      EXPECT_LE(share, 0.98) << "φ = " << phi;
    }
  }
}

TEST(Coverage, OfCycleClustersAndOfTheBootstrapHoldsToo) {
  for (const auto method : {IntervalMethod::cycle_clusters, IntervalMethod::block_bootstrap})
    for (const double phi : {0.0, 0.85}) {
      const Coverage c = coverage(method, phi, 400);
      for (const double share : {c.cd, c.inertia}) {
        EXPECT_GE(share, 0.91) << "φ = " << phi;  // 0.92 and one deviation
        EXPECT_LE(share, 0.99) << "φ = " << phi;
      }
    }
}

TEST(Resampling, AgreesWithTheAutoregressionWhereThatHolds) {
  const auto r = record(0.85, 5);
  const auto a = fit::fit_morison(cylinder, r).cd,
             b = fit::fit_morison(cylinder, r, {.method = IntervalMethod::block_bootstrap}).cd,
             c = fit::fit_morison(cylinder, r, {.method = IntervalMethod::cycle_clusters}).cd;
  EXPECT_DOUBLE_EQ(*a.value, *b.value);
  EXPECT_NEAR(b.standard_error / a.standard_error, 1, 0.25);  // eight memories to a block lose some 6 % of the variance
  EXPECT_NEAR(c.standard_error / a.standard_error, 1, 0.6);   // 14 cycles: the variance is known to √(2/12) = 40 %
}

TEST(Resampling, GivesTheSameNumbersForTheSameSeed) {
  const auto r = record(0.5, 6);
  const fit::MorisonOptions options{.method = IntervalMethod::block_bootstrap};
  EXPECT_EQ(fit::fit_morison(cylinder, r, options).cd.interval.low,
            fit::fit_morison(cylinder, r, options).cd.interval.low);
}

TEST(Resampling, NeedsCyclesAndBlocks) {
  auto r = record(0.5, 7);
  for (auto* column : {&r.time, &r.force, &r.velocity, &r.acceleration}) column->resize(400);  // five cycles
  EXPECT_THAT([&] { fit::fit_morison(cylinder, r, {.method = IntervalMethod::cycle_clusters}); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("six of them")));
}

}  // namespace
}  // namespace resampling_test
