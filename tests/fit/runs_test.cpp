#include "fit/runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace runs_test {
namespace {

using fit::Law;
using fit::RunEstimate;

/// Runs whose coefficient is c0 + c1 ln(KC/15) + N(0, between²) + N(0, own²).
std::vector<RunEstimate> runs(int n, double c1, double between, std::uint64_t stream) {
  const hydro::RandomStream random(17, stream);
  std::vector<RunEstimate> out;
  for (int i = 0; i < n; ++i) {
    const auto k = 3 * static_cast<std::uint64_t>(i);
    const double kc = 8 * std::pow(30.0 / 8, i / (n - 1.0)), own = 0.02 * (1 + i % 3);
    const double value = 2.5 + c1 * std::log(kc / 15) + between * random.normal(k) + own * random.normal(k + 1);
    const double re = 3e4 + 7e4 * random.uniform(k + 2);
    out.push_back({value, own, kc, re, re / kc});
  }
  return out;
}

TEST(Runs, WithoutErrorFollowTheirLawExactly) {
  auto all = runs(12, -0.8, 0, 1);
  for (RunEstimate& r : all) {
    r.value = 2.5 - 0.8 * std::log(r.kc / 15);
    r.standard_error = 1e-6;
  }
  const auto f = fit::fit_runs(all, Law::kc);
  const double middle = std::sqrt(8.0 * 30);  // geometric mean of an even ladder
  EXPECT_NEAR(f.coefficients[0], 2.5 - 0.8 * std::log(middle / 15), 1e-9);
  EXPECT_NEAR(f.coefficients[1], -0.8, 1e-9);
  EXPECT_NEAR(f.between, 0, 1e-6);
}

TEST(Runs, OfEqualErrorGiveTheFamiliarMeanAndScatter) {
  // With equal own errors σ, REML has τ² + σ² = s², the ordinary variance.
  std::vector<RunEstimate> all;
  for (const double v : {1.0, 1.4, 0.7, 1.9, 1.1}) all.push_back({v, 0.1, 1, 1, 1});
  const auto f = fit::fit_runs(all, Law::constant);
  const double mean = 1.22, s2 = (0.0484 + 0.0324 + 0.2704 + 0.4624 + 0.0144) / 4;
  EXPECT_NEAR(f.coefficients[0], mean, 1e-12);
  EXPECT_NEAR(f.between * f.between, s2 - 0.01, 1e-9);
  EXPECT_NEAR(f.covariance(0, 0), s2 / 5, 1e-9);
  EXPECT_NEAR(f.intervals[0].high - mean, 2.776445 * std::sqrt(s2 / 5), 1e-6);  // t of 4 degrees of freedom
}

// Fisher's steps go to and fro for ever between these three, of which one is known two hundred times better.
TEST(Runs, OfVeryDifferentErrorsHaveTheLargestLikelihood) {
  const std::vector<double> y{1.19995, 1.17744, 1.1757}, own{0.00012, 0.02949, 0.028};
  std::vector<RunEstimate> all;
  for (std::size_t i = 0; i < 3; ++i) all.push_back({y[i], own[i], 1, 1, 1});
  const auto likelihood = [&](double squared) {
    double weights = 0, mean = 0, logarithms = 0, squares = 0;
    for (std::size_t i = 0; i < 3; ++i) weights += 1 / (own[i] * own[i] + squared);
    for (std::size_t i = 0; i < 3; ++i) mean += y[i] / (own[i] * own[i] + squared) / weights;
    for (std::size_t i = 0; i < 3; ++i) {
      logarithms += std::log(own[i] * own[i] + squared);
      squares += (y[i] - mean) * (y[i] - mean) / (own[i] * own[i] + squared);
    }
    return -0.5 * (logarithms + std::log(weights) + squares);
  };
  const double between = fit::fit_runs(all, Law::constant).between, told = likelihood(between * between);
  for (double squared = 1e-9; squared < 1e-2; squared *= 1.1)
    EXPECT_GT(told, likelihood(squared) - 1e-9) << squared;  // 1e-9: rounding of logarithms
}

TEST(Runs, CoverTheirLawInMostSets) {
  int slope = 0, level = 0, next = 0;
  constexpr int sets = 500;
  double between = 0;
  for (int i = 0; i < sets; ++i) {
    auto all = runs(21, -0.8, 0.15, 100 + static_cast<std::uint64_t>(i));
    const RunEstimate held = all[10];  // the middle one, KC = 15.5: predicted from the others
    all.erase(all.begin() + 10);
    const auto f = fit::fit_runs(all, Law::kc);
    const double centre = 2.5 - 0.8 * std::log(std::sqrt(240.0) / 15);
    level += f.intervals[0].low < centre && centre < f.intervals[0].high;
    slope += f.intervals[1].low < -0.8 && -0.8 < f.intervals[1].high;
    next += f.prediction.low < held.value && held.value < f.prediction.high;
    between += f.between / sets;
  }
  // 0.95 of 500 is 475 ± 4.9; four deviations either side.
  for (const int count : {slope, level}) {
    EXPECT_GE(count, 455);
    EXPECT_LE(count, 495);
  }
  EXPECT_GE(next, 450);  // the held run's own error comes on top of the prediction
  EXPECT_NEAR(between, 0.15, 0.01);
}

TEST(Runs, PreferTheLawTheyWereMadeWith) {
  int with_trend = 0, without = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    with_trend += fit::compare_laws(runs(21, -0.8, 0.15, 700 + i)).front().law == Law::kc;
    const auto flat = fit::compare_laws(runs(21, 0, 0.15, 900 + i));
    without += flat.front().law == Law::constant;
  }
  EXPECT_GE(with_trend, 70);  // AICc adds a needless term in about one set of six
  EXPECT_GE(without, 55);     // three other laws to be misled by
}

TEST(Runs, PredictBetterWithTheRightLaw) {
  const auto all = runs(21, -0.8, 0.05, 3);
  EXPECT_LT(fit::fit_runs(all, Law::kc).cross_validation, 0.5 * fit::fit_runs(all, Law::constant).cross_validation);
}

TEST(Runs, RefuseWhatTheyCannotTell) {
  auto all = runs(6, 0, 0.1, 4);
  for (RunEstimate& r : all) r.kc = 12;
  EXPECT_THAT([&] { fit::fit_runs(all, Law::kc); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("do not differ in KC")));
  EXPECT_THROW(fit::fit_runs(std::span(all).first(3), Law::kc), hydro::InputError);
  all[2].standard_error = 0;
  EXPECT_THAT([&] { fit::fit_runs(all, Law::constant); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("run 3: its value is")));
  all[2].file = "third.csv";
  EXPECT_THAT([&] { fit::fit_runs(all, Law::constant); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("third.csv: error: of runs that are put")));
}

}  // namespace
}  // namespace runs_test
