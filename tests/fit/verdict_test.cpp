#include "fit/verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/coloured_noise.hpp"

namespace verdict_test {
namespace {

using fit::SearchReport;
using testing::HasSubstr;

Eigen::VectorXd noise(std::size_t n, double phi, double sigma, std::uint64_t stream) {
  const auto e = froude_test::ar1_noise(n, phi, sigma, stream);
  return Eigen::Map<const Eigen::VectorXd>(e.data(), std::ssize(e));
}

TEST(StatedResiduals, AreAllowedWhatChanceLeavesInOneOfAThousandAndADigitMayMean) {
  // χ² of 4 and of 100 squares: 18.467 and 149.449 at 0.999 (tables).
  EXPECT_NEAR(fit::allowed_ratio(4), 1.25 * std::sqrt(18.467 / 4), 1e-4);
  EXPECT_NEAR(fit::allowed_ratio(100), 1.25 * std::sqrt(149.449 / 100), 1e-5);
  EXPECT_NEAR(fit::allowed_ratio(1e6), 1.25, 0.004);
}

TEST(StatedResiduals, OfANoiseAsStatedHold) {
  for (const double phi : {0.0, 0.9}) {
    int beyond_chance = 0;
    for (std::uint64_t stream = 0; stream < 300; ++stream) {
      const auto s = fit::against_stated(noise(400, phi, 0.02, stream), 0.02, 0);
      EXPECT_TRUE(s.hold()) << phi << ' ' << s.rms << ' ' << s.allowed;
      beyond_chance += s.rms > s.allowed / 1.25;  // without what the digit allows
    }
    EXPECT_LE(beyond_chance, 5) << phi;  // 0.3 expected; of correlated noise the number of squares is itself estimated
  }
}

TEST(StatedResiduals, CountCorrelatedSquares) {
  // Σρ_k² = φ²/(1 − φ²) = 4.26 for φ = 0.9: n/9.5 squares, estimated from a record of 4000 samples.
  const auto s = fit::against_stated(noise(4000, 0.9, 1, 7), 1, 0);
  EXPECT_NEAR(s.squares, 4000 / 9.53, 0.25 * 4000 / 9.53);
  const auto white = fit::against_stated(noise(4000, 0, 1, 7), 1, 0);
  EXPECT_NEAR(white.squares, 4000, 80);
}

TEST(StatedResiduals, BeyondTheStatementDoNotHold) {
  EXPECT_FALSE(fit::against_stated(noise(400, 0, 0.03, 3), 0.02, 0).hold());
  EXPECT_TRUE(fit::against_stated(noise(400, 0, 0.024, 3), 0.02, 0).hold());  // written with one digit
  EXPECT_TRUE(fit::against_stated(noise(400, 0, 0.001, 3), 0.02, 0).hold());  // less is no contradiction
  EXPECT_FALSE(fit::against_stated(Eigen::VectorXd::Constant(400, 0.1), 0.02, 0).hold());
  EXPECT_TRUE(fit::against_stated(Eigen::VectorXd::Zero(400), 0.02, 0).hold());
}

TEST(StatedResiduals, GetBackWhatTheFitTookOutOfThem) {
  const Eigen::VectorXd r = noise(40, 0, 1, 5);
  EXPECT_NEAR(fit::against_stated(r, 1, 0.75).rms, 2 * r.norm() / std::sqrt(40), 1e-12);
}

TEST(Verdict, NamesHowASearchFailed) {
  SearchReport report{};
  report.outcome = SearchReport::Outcome::out_of_iterations;
  report.iterations = 60;
  report.promised = 0.42;
  EXPECT_THAT(fit::why_unended(report), testing::AllOf(HasSubstr("all 60 of its iterations"), HasSubstr("42 %")));
  EXPECT_THAT([&] { fit::require_ended(report, "the damping"); },
              testing::ThrowsMessage<hydro::NumericsError>(HasSubstr("the search for the damping has no end")));
  report.outcome = SearchReport::Outcome::converged;
  EXPECT_EQ(fit::why_unended(report), "");
  EXPECT_NO_THROW(fit::require_ended(report, "the damping"));
}

TEST(Verdict, LeavesNothingOfACoefficientThatIsWithheld) {
  fit::Coefficient c;
  c.value = 1.2;
  c.interval = {1, 1.4};
  fit::withhold(c, "there is no end");
  EXPECT_FALSE(c.value);
  EXPECT_EQ(c.interval.low, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(c.interval.high, std::numeric_limits<double>::infinity());
  EXPECT_EQ(c.why_not, "there is no end");
}

}  // namespace
}  // namespace verdict_test
