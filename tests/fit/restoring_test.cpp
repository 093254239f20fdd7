// Stiffness from loads that were held. (F80)
#include "fit/problem/restoring.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/problem/any.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace restoring_test {
namespace {

using fit::restoring::Problem;
using Pull = fit::restoring::Run;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

constexpr double k = 500, k3 = 120, noise = 4;

/// Points from −1 m to 1 m with a preload, and noise from this stream.
Pull pulled(int points, double preload, double cubic, double deviation, std::uint64_t stream) {
  const hydro::RandomStream random(7, stream);
  Pull out{{"/rig/pull.csv"}, {}, {}};
  for (int i = 0; i < points; ++i) {
    const double x = -1 + 2.0 * i / (points - 1);
    out.motion.push_back(x);
    out.load.push_back(preload + k * x + cubic * x * x * x + deviation * random.normal(static_cast<std::uint64_t>(i)));
  }
  return out;
}

Problem problem(std::vector<Pull> runs, bool cubic) {
  return {.turns = false, .runs = std::move(runs), .options = {.cubic = cubic}};
}

TEST(Restoring, OfPointsOnTheCurveIsTheCurve) {
  const auto fit = solve(problem({pulled(9, 20, k3, 0, 1), pulled(7, -5, k3, 0, 2)}, true));
  EXPECT_NEAR(fit.stiffness, k, 1e-9 * k);
  EXPECT_NEAR(fit.cubic, k3, 1e-8 * k3);
  EXPECT_NEAR(fit.preload[0], 20, 1e-9);
  EXPECT_NEAR(fit.preload[1], -5, 1e-9);
  EXPECT_NEAR(fit.fitted[1][6], -5 + k + k3, 1e-9);
}

TEST(Restoring, HoldsTheTruthAsOftenAsItSays) {
  int held = 0, held_cubic = 0;
  constexpr int seeds = 1000;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto report = solve(problem({pulled(11, 20, k3, noise, seed)}, true)).report;
    const auto holds = [&](const char* name, double truth) {
      const auto& i = report.find(name)->coefficient.interval;
      return i.low < truth && truth < i.high;
    };
    held += holds("stiffness", k);
    held_cubic += holds("cubic", k3);
  }
  // 950 of 1000, whose standard deviation is 7: within three of them.
  EXPECT_NEAR(held, 950, 21);
  EXPECT_NEAR(held_cubic, 950, 21);
}

TEST(Restoring, OfACubicTermThatIsNotThereTellsNoValue) {
  const auto report = fit::solve(problem({pulled(11, 0, 0, noise, 5)}, true));
  EXPECT_TRUE(report.find("stiffness")->coefficient.value);
  EXPECT_FALSE(report.find("cubic")->coefficient.value);
  EXPECT_THAT(report.find("cubic")->coefficient.why_not, HasSubstr("cannot be told from zero"));
}

TEST(Restoring, WarnsWhereTheCurveHasAnotherForm) {
  EXPECT_THAT(solve(problem({pulled(41, 0, 10 * k3, noise, 5)}, false)).report.cautions,
              testing::ElementsAre(HasSubstr("the curve has another form")));
  EXPECT_THAT(solve(problem({pulled(41, 0, 10 * k3, noise, 5)}, true)).report.cautions, IsEmpty());
}

TEST(Restoring, RefusesWhatTellsNoStiffness) {
  const auto refused = [](std::vector<Pull> runs, bool cubic, const char* why) {
    EXPECT_THAT([&] { solve(problem(runs, cubic)); }, ThrowsMessage<hydro::InputError>(HasSubstr(why))) << why;
  };
  refused({}, false, "one test at least");
  refused({{{"a.csv"}, {1, 2}, {3}}}, false, "a.csv: error: there are 2 motions and 1 loads");
  refused({{{"a.csv"}, {1, 2, std::nan("")}, {1, 2, 3}}}, false, "point 3 is not finite");
  refused({{{"a.csv"}, {0, 1}, {0, 500}}}, false, "2 points for 2 coefficients");
  refused({{{"a.csv"}, {1, 1, 1, 1}, {1, 2, 3, 4}}}, false, "too few different places");
  refused({{{"a.csv"}, {0, 1, -1, 1, -1}, {0, 1, 2, 3, 4}}}, true, "too few different places");
  refused({{{"a.csv"}, {0, 0, 0}, {0, 1, 2}}}, false, "nothing moves");
}

}  // namespace
}  // namespace restoring_test
