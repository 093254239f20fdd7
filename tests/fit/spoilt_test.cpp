// Fits that cannot come right tell nothing, or the truth: begun far away, with models that lack what acted, with
// channels exchanged or turned round. The long version is validation/spoilt-fits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/spoilt_fits.hpp"

namespace spoilt_test {
namespace {

using fit::Refusal;
using testing::AllOf;
using testing::HasSubstr;
namespace spoilt = froude_test::spoilt;

TEST(SpoiltFits, TellNoValueThatIsWrongByMoreThanTwiceItsInterval) {
  int told = 0;
  for (const auto& way : froude_test::ways_to_spoil())
    for (const std::uint64_t seed : {1, 2}) {
      const auto fit = way(seed);
      const auto wrong = froude_test::wrong_by(fit);
      told += wrong.has_value();
      EXPECT_LE(wrong.value_or(0), 2) << fit.how << ", seed " << seed;
    }
  EXPECT_GE(told, 4);  // those begun a little away come right: a fit that refuses everything would pass the rest
}

fit::motion::Problem pair_begun_at(double factor, const Eigen::MatrixXd& record) {
  return spoilt::pair_problem(record, factor * spoilt::pair_truth.head(4));
}

TEST(SpoiltMotion, IsBegunElsewhereWhereItsFirstStartFails) {
  auto problem = pair_begun_at(1, spoilt::pair_record(spoilt::pair_truth, 3));
  problem.parameters[0].number.first = 12;  // the truth is 4: the first swing is lost
  problem.options.starts = 1;
  ASSERT_TRUE(fit::motion::solve(problem).report.refused);  // from there alone it fails
  problem.options.starts.reset();
  const auto found = fit::motion::solve(problem);
  ASSERT_FALSE(found.report.refused) << found.report.refused->why;
  EXPECT_NEAR(*found.fit.parameters[0].value, 4, 5 * found.fit.parameters[0].standard_error);
  const auto& starts = std::get<fit::Facts>(*find(found.report.facts, "starts"));
  EXPECT_EQ(std::get<std::int64_t>(*find(starts, "tried")), 1 + fit::motion::starts_after_failure);
  EXPECT_NE(find(found.report.facts, "other_ends"), nullptr);  // where the first came to is told
}

TEST(SpoiltMotion, TellsItsBestPointAsNotAccepted) {
  auto truth = spoilt::pair_truth;
  truth[4] = 0.3;  // a quadratic damping that is not fitted
  const auto refused = fit::motion::solve(pair_begun_at(1.1, spoilt::pair_record(truth, 4))).report;
  ASSERT_TRUE(refused.refused);
  EXPECT_EQ(refused.refused->reason, Refusal::Reason::residuals_too_large);
  ASSERT_EQ(refused.refused->best_point.size(), 4u);
  EXPECT_THAT(refused.refused->best_point[0], AllOf(HasSubstr("k1 4."), HasSubstr("1/s")));
  EXPECT_EQ(refused.find("k1"), nullptr);
}

TEST(SpoiltMotion, NamesChannelsThatAreExchanged) {
  const Eigen::MatrixXd exchanged = spoilt::pair_record(spoilt::pair_truth, 5).rowwise().reverse();
  const auto report = fit::motion::solve(pair_begun_at(1.1, exchanged)).report;
  ASSERT_TRUE(report.refused);
  EXPECT_THAT(report.refused->why, HasSubstr("x1 and x2 are exchanged: with that put right the fit ends where"));
}

TEST(SpoiltMotion, NamesAChannelOfTheWrongSign) {
  Eigen::MatrixXd turned = spoilt::pair_record(spoilt::pair_truth, 6);
  turned.col(1) *= -1;
  const auto report = fit::motion::solve(pair_begun_at(1.1, turned)).report;
  ASSERT_TRUE(report.refused);
  EXPECT_THAT(report.refused->why, HasSubstr("x2 has the wrong sign"));
}

TEST(SpoiltMotion, NamesAChannelThatIsRecordedLate) {
  Eigen::MatrixXd late = spoilt::pair_record(spoilt::pair_truth, 7);
  constexpr Eigen::Index samples = 4;  // of 0.05 s
  const Eigen::VectorXd x = late.col(1);
  late.col(1).tail(x.size() - samples) = x.head(x.size() - samples);
  const auto report = fit::motion::solve(pair_begun_at(1.1, late)).report;
  ASSERT_TRUE(report.refused);
  EXPECT_THAT(report.refused->why, testing::ContainsRegex("x2 is recorded 0.(19|2|21) s late"));
}

TEST(SpoiltMotion, BlamesNoChannelForWhatItsModelLacks) {
  auto truth = spoilt::pair_truth;
  truth[4] = 0.3;
  const auto solution = fit::motion::solve(pair_begun_at(1.1, spoilt::pair_record(truth, 8)));
  ASSERT_TRUE(solution.report.refused);
  EXPECT_EQ(solution.trouble, "");
}

/// A body that comes to rest in one of two wells, ẍ = k(x − x³) − cẋ. With a stiffness that is two and three times too
/// large it goes to the other well, and what is handed on from window to window lies there: from that alone the search
/// has no end.
TEST(SpoiltMotion, InWindowsBeginsWhereTheSamplesAre) {
  const auto wells = [](const Eigen::VectorXd& y, const Eigen::VectorXd& p) {
    return spoilt::with({y[1], p[0] * (y[0] - y[0] * y[0] * y[0]) - p[1] * y[1]});
  };
  const Eigen::VectorXd truth = spoilt::with({2, 0.1}), begin = spoilt::with({0, 2});
  const auto e = froude_test::ar1_noise(400, 0, 0.01, 9);
  const Eigen::MatrixXd record = froude_test::MeasuredFlow(wells, begin, 0.05, {400}, 1).follow(0, truth, {}) +
                                 Eigen::Map<const Eigen::VectorXd>(e.data(), 400);
  for (const double off : {2.5, 3.0}) {
    fit::SimulationProblem problem{
        .parameters = {{"k", 2 * off}, {"c", 0.1 * off}}, .measured = {}, .deviations = {0.01}};
    for (Eigen::Index w = 0; w < 4; ++w) problem.measured.emplace_back(record.middleRows(100 * w, 100));
    froude_test::MeasuredFlow flow(wells, begin, 0.05, std::vector<Eigen::Index>(4, 100), 1);
    const auto f = fit::fit_simulation(flow, problem);
    ASSERT_EQ(f.refused, "") << off;
    for (std::size_t k = 0; k < 2; ++k)  // an interval of 95 % holds the truth of one record or not: five errors
      EXPECT_NEAR(*f.parameters[k].value, truth[static_cast<Eigen::Index>(k)], 5 * f.parameters[k].standard_error);
  }
}

fit::Report decayed(const std::function<double(double, double)>& f, const fit::DampingTerms& terms, double noise,
                    bool accept = false) {
  auto fit = spoilt::decay("", spoilt::let_go(f, 0.5, noise, 1), terms, {});
  fit.problem.as<fit::decay::Problem>()->options.accept_residuals = accept;
  return fit::solve(fit.problem);
}

TEST(SpoiltDecay, WhoseHalvesContradictEachOtherIsRefused) {
  const auto quadratic = [](double x, double v) { return -x - 0.3 * std::abs(v) * v; };
  const auto refused = decayed(quadratic, {.linear = true}, 0.002);
  ASSERT_TRUE(refused.refused);
  EXPECT_EQ(refused.refused->reason, Refusal::Reason::halves_differ);
  EXPECT_THAT(refused.refused->why,
              AllOf(HasSubstr("the first and the second half of decay.csv"), HasSubstr("linear")));
  EXPECT_THAT(refused.refused->best_point, testing::Contains(HasSubstr("period 6.2")));
  EXPECT_EQ(refused.find("linear"), nullptr);
  const auto accepted = decayed(quadratic, {.linear = true}, 0.002, true);
  EXPECT_FALSE(accepted.refused);
  EXPECT_NE(accepted.find("linear"), nullptr);
  // With the term that acts both halves agree.
  const auto right = decayed(quadratic, {.linear = false, .quadratic = true}, 0.002);
  ASSERT_FALSE(right.refused) << right.refused->why;
  EXPECT_LT(std::get<double>(*find(right.parts.at(0).facts, "halves_apart")), 1);
}

TEST(SpoiltDecay, TermThatDrivesTheMotionIsNamed) {
  // Coulomb friction loses the same in each swing: a quadratic term has to give back what a linear one takes of large
  // swings too much. Both halves of the record agree in that.
  const auto friction = [](double x, double v) { return -x - 0.01 * std::tanh(v / 1e-3); };
  const auto accepted = decayed(friction, {.linear = true, .quadratic = true}, 0.002, true);
  ASSERT_FALSE(accepted.refused);
  EXPECT_THAT(accepted.parts.at(0).cautions,
              testing::Contains(AllOf(HasSubstr("quadratic ("), HasSubstr("comes out negative"))));
  const auto quadratic = [](double x, double v) { return -x - 0.3 * std::abs(v) * v; };
  const auto right = decayed(quadratic, {.linear = false, .quadratic = true}, 0.002);
  EXPECT_THAT(right.parts.at(0).cautions, testing::Not(testing::Contains(HasSubstr("comes out negative"))));
}

TEST(SpoiltDecay, IsNotRefusedForItsNoise) {
  // One right record in a thousand is refused: of twelve, with a memory of ten samples, none.
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    auto x = spoilt::let_go([](double at, double v) { return -at - 0.05 * v; }, 0.5, 0, seed);
    const auto e = froude_test::ar1_noise(x.size(), 0.9, 0.02, seed);
    for (std::size_t j = 0; j < x.size(); ++j) x[j] += e[j];
    const auto report = fit::solve(spoilt::decay("", x, {.linear = true}, {}).problem);
    EXPECT_FALSE(report.refused) << seed << ": " << report.refused->why;
  }
}

// Coulomb friction stops this body within the second half, whose search then ends at a motion of the noise: it told
// nan, and the right terms were refused for it.
TEST(SpoiltDecay, IsNotRefusedForAHalfThatTellsNothing) {
  const auto rubbed = [](double x, double v) { return -x - 0.02 * v - 0.02 * std::tanh(v / 1e-3); };
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto x = spoilt::let_go(rubbed, 0.5, 0.004, seed);
    const auto report = fit::solve(spoilt::decay("", x, {.linear = true, .coulomb = true}, {}).problem);
    EXPECT_FALSE(report.refused) << seed << ": " << report.refused->why;
  }
}

TEST(SpoiltRadiation, WhoseDampingIsNegativeIsRefused) {
  const auto report = fit::solve(spoilt::heaved("", 1, -1).problem);
  ASSERT_TRUE(report.refused);
  EXPECT_EQ(report.refused->reason, Refusal::Reason::wrong_sign);
  EXPECT_EQ(report.refused->source, "heave.csv");
  EXPECT_TRUE(report.parts.empty());
}

/// x = a e^{−t/s}: where the noise is as large as the motion, s has no parabola about its least cost.
class DyingOut final : public fit::Simulation {
 public:
  Eigen::Index coordinates(std::size_t) override { return 0; }
  Eigen::MatrixXd follow(std::size_t, const Eigen::VectorXd& p, const Eigen::VectorXd&) override {
    return (-Eigen::ArrayXd::LinSpaced(100, 0, 9.9) / p[0]).exp().matrix();
  }
  void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}
};

TEST(SpoiltMotion, HasTheIntervalOfItsLikelihoodWhereThatIsBent) {
  DyingOut motion;
  const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, 30);
  const auto e = froude_test::ar1_noise(100, 0, 0.5, 11);
  const Eigen::MatrixXd measured = motion.follow(0, at, {}) + Eigen::Map<const Eigen::VectorXd>(e.data(), 100);
  fit::SimulationProblem problem{.parameters = {{"time", 20, 0.1, 1e3}}, .measured = {measured}, .deviations = {0.5}};
  const auto f = fit::fit_simulation(motion, problem);
  ASSERT_TRUE(f.parameters[0].value) << f.parameters[0].why_not;
  EXPECT_TRUE(f.by_likelihood[0]);
  const auto& [low, high] = f.parameters[0].interval;
  const double value = *f.parameters[0].value;
  EXPECT_GT(high - value, 1.5 * (value - low));  // slow decays are hard to tell from each other, fast ones are not
  EXPECT_LT(low, 30);
  EXPECT_GT(high, 30);
  // A motion that is told well has the parabola's.
  const Eigen::MatrixXd clear = motion.follow(0, at, {}) + 0.01 * Eigen::Map<const Eigen::VectorXd>(e.data(), 100);
  problem.measured = {clear};
  problem.deviations = {0.005};
  EXPECT_FALSE(fit::fit_simulation(motion, problem).by_likelihood[0]);
}

}  // namespace
}  // namespace spoilt_test
