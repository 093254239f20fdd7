#include "fit/camera/channels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/simulated.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "support/refused.hpp"

namespace camera_channels_test {
namespace {

using fit::camera::Channel;
using fit::camera::Channels;
using fit::camera::Sighting;
using fit::camera::Track;
using std::numbers::pi;
using support::refused;
using testing::HasSubstr;

const Eigen::Matrix2d errors = (Eigen::Matrix2d() << 4e-6, 1e-6, 1e-6, 2e-6).finished();

/// Markers a, b, c of two links of 0.3 m and 0.2 m that hang from a at these angles below the x axis.
Track links(const std::vector<double>& upper, const std::vector<double>& lower) {
  Track out{.time = {}, .markers = {{"a", {}}, {"b", {}}, {"c", {}}}, .in_metres = true};
  for (std::size_t i = 0; i < upper.size(); ++i) {
    out.time.push_back(0.05 * static_cast<double>(i));
    const Eigen::Vector2d b(0.3 * std::cos(upper[i]), -0.3 * std::sin(upper[i]));
    out.markers[0].seen.push_back(Sighting{{0, 0}, errors});
    out.markers[1].seen.push_back(Sighting{b, errors});
    out.markers[2].seen.push_back(Sighting{b + 0.2 * Eigen::Vector2d(std::cos(lower[i]), -std::sin(lower[i])), errors});
  }
  return out;
}
Channel below(const char* from, const char* to) { return {Channel::Kind::angle, from, to, true}; }

TEST(Channels, AnglesGoOnOverWholeTurns) {
  std::vector<double> upper, lower;
  for (int i = 0; i < 200; ++i) {
    upper.push_back(0.2 * i - 1);  // six turns
    lower.push_back(1.4);
  }
  Track t = links(upper, lower);
  for (std::size_t i = 100; i < 112; ++i) t.markers[1].seen[i].reset();
  const Channels c = channels_of(t, {below("a", "b")}),
                 up = channels_of(t, {{Channel::Kind::angle, "a", "b", false, 0.3}});
  for (std::size_t i = 0; i < 200; ++i) {
    if (i >= 100 && i < 112) {
      EXPECT_TRUE(std::isnan(c.values(static_cast<Eigen::Index>(i), 0)));
      continue;
    }
    EXPECT_NEAR(c.values(static_cast<Eigen::Index>(i), 0), upper[i], 1e-12);
    EXPECT_NEAR(up.values(static_cast<Eigen::Index>(i), 0), -upper[i] - 0.3, 1e-12);
  }
}

TEST(Channels, RefusesATurnWhoseWayRoundIsNotKnown) {
  std::vector<double> upper{0, 0.1, 0.2, 3.3, 0.3}, lower(5, 0.0);
  EXPECT_THAT(refused([&] { channels_of(links(upper, lower), {below("a", "b")}); }), HasSubstr("which way round"));
}

TEST(Channels, WhitenedErrorsOfAnglesThatShareAMarkerAreIndependent) {
  const hydro::RandomStream random(3, 5);
  const std::vector<double> upper(4, 1.1), lower(4, 0.4);
  const Track exact = links(upper, lower);
  const std::vector<Channel> both{below("a", "b"), below("b", "c")};
  const Channels truth = channels_of(exact, both);
  const Eigen::Matrix2d root = errors.llt().matrixL();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero(), raw = covariance;
  constexpr int trials = 4000;
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    Track noisy = exact;
    for (std::uint64_t m = 0; m < 3; ++m)
      noisy.markers[m].seen[0]->at +=
          root * Eigen::Vector2d(random.normal(6 * trial + 2 * m), random.normal(6 * trial + 2 * m + 1));
    const Channels c = channels_of(noisy, both);
    Eigen::Vector2d e = (c.values.row(0) - truth.values.row(0)).transpose();
    for (int k = 0; k < 2; ++k) e[k] /= truth.deviations[static_cast<std::size_t>(k)];
    raw += e * e.transpose() / trials;
    const Eigen::Vector2d white = truth.whitening[0] * e;
    covariance += white * white.transpose() / trials;
  }
  EXPECT_LT(raw(0, 1), -0.2) << "the shared marker turns them against each other";
  EXPECT_NEAR(raw(0, 0), 1, 0.09);  // four deviations √(2/4000)
  EXPECT_LT((covariance - Eigen::Matrix2d::Identity()).norm(), 0.13);
}

TEST(Channels, WithoutAMarkerWeighOnlyWhatIsLeft) {
  Track t = links({1, 1, 1}, {0.5, 0.5, 0.5});
  t.markers[2].seen[1].reset();
  const Channels c = channels_of(t, {below("a", "b"), below("b", "c"), {Channel::Kind::up, "a"}});
  EXPECT_TRUE(c.whitening[1].row(1).isZero(0) && c.whitening[1].col(1).isZero(0));
  EXPECT_GT(c.whitening[1](0, 0), 0);
  EXPECT_NEAR(c.deviations[2], std::sqrt(2e-6), 1e-12);
  EXPECT_NEAR(c.values(0, 2), 0, 1e-15);
}

TEST(Channels, SayWhatIsWrong) {
  Track t = links({1, 1, 1}, {0.5, 0.5, 0.5});
  EXPECT_THAT(refused([&] { channels_of(t, {below("a", "d")}); }), HasSubstr("no marker \"d\""));
  EXPECT_THAT(refused([&] { channels_of(t, {below("a", "a")}); }), HasSubstr("to itself"));
  EXPECT_THAT(refused([&] { channels_of(t, {below("a", "b"), below("b", "a")}); }), HasSubstr("tell the same"));
  t.markers[1].seen.assign(3, std::nullopt);
  EXPECT_THAT(refused([&] { channels_of(t, {below("a", "b")}); }), HasSubstr("is in no frame"));
  t.in_metres = false;
  EXPECT_THAT(refused([&] { channels_of(t, {below("a", "c")}); }), HasSubstr("pixels"));
}

/// Two channels, each a parameter times a known shape.
class Shapes final : public fit::Simulation {
 public:
  static Eigen::MatrixXd shapes() {
    Eigen::MatrixXd out(60, 2);
    for (Eigen::Index i = 0; i < 60; ++i)
      out.row(i) << std::sin(0.2 * static_cast<double>(i)), std::cos(0.13 * static_cast<double>(i)) + 1;
    return out;
  }
  Eigen::Index coordinates(std::size_t) override { return 0; }
  Eigen::MatrixXd follow(std::size_t, const Eigen::VectorXd& p, const Eigen::VectorXd&) override {
    return shapes() * p.asDiagonal();
  }
  void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}
};

/// A record of Shapes whose channels share errors by half, in which every third sample of the second is missing.
fit::SimulationProblem weighted(std::uint64_t seed, const Eigen::Vector2d& truth) {
  const hydro::RandomStream random(seed, 77);
  fit::SimulationProblem p{.parameters = {{"first", 1}, {"second", 1}},
                           .measured = {Shapes().follow(0, truth, {})},
                           .deviations = {0.1, 0.2}};
  Eigen::Matrix2d correlation;
  correlation << 1, 0.5, 0.5, 1;
  const Eigen::Matrix2d root = correlation.llt().matrixL(), whitening = root.inverse();
  p.whitening.emplace_back();
  for (Eigen::Index i = 0; i < 60; ++i) {
    const auto k = static_cast<std::uint64_t>(2 * i);
    const Eigen::Vector2d e = root * Eigen::Vector2d(random.normal(k), random.normal(k + 1));
    p.measured[0].row(i) += Eigen::RowVector2d(0.1 * e[0], 0.2 * e[1]);
    p.whitening[0].push_back(whitening);
    if (i % 3 != 0) continue;
    p.measured[0](i, 1) = std::numeric_limits<double>::quiet_NaN();
    p.whitening[0].back() = Eigen::Vector2d(1, 0).asDiagonal();
  }
  return p;
}

TEST(WeightedFit, IsThatOfGeneralisedLeastSquares) {
  const fit::SimulationProblem p = weighted(1, {1.3, 0.7});
  Shapes shapes;
  const fit::SimulationFit f = fit_simulation(shapes, p);
  // By hand: normal equations with the inverse covariance of each sample.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  const Eigen::MatrixXd shape = Shapes::shapes();
  for (Eigen::Index i = 0; i < 60; ++i) {
    Eigen::Matrix2d weight;
    weight << 1 / 0.01, -0.5 / 0.02, -0.5 / 0.02, 1 / 0.04;
    weight /= 0.75;
    if (i % 3 == 0) weight = Eigen::Vector2d(100, 0).asDiagonal();
    const Eigen::Matrix2d slope = shape.row(i).asDiagonal();
    const Eigen::Vector2d y = p.measured[0].row(i).array().isNaN().select(0, p.measured[0].row(i)).transpose();
    normal += slope.transpose() * weight * slope;
    right += slope.transpose() * weight * y;
  }
  const Eigen::Vector2d by_hand = normal.inverse() * right;
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(*f.parameters[static_cast<std::size_t>(k)].value, by_hand[k], 1e-6);  // the search ends at 1e-3 of σ/n
    EXPECT_NEAR(f.parameters[static_cast<std::size_t>(k)].standard_error, std::sqrt(normal.inverse()(k, k)),
                0.35 * std::sqrt(normal.inverse()(k, k)));  // from 100 residuals, whose memory is found by chance too
  }
  EXPECT_EQ(f.motion[0].rows(), 60);
  EXPECT_TRUE(f.motion[0].allFinite()) << "the motion is told where nothing was measured, too";
  EXPECT_TRUE(std::isnan(f.sample_band[0](0, 1)));
  EXPECT_NEAR(f.rms[1], 0.2, 0.08);
  EXPECT_GT(f.inside, 0.88);
}

TEST(WeightedFit, OfAnglesThatWereMeasuredUpToWholeTurnsIsThatOfTheAngles) {
  constexpr double turn = 2 * std::numbers::pi;
  fit::SimulationProblem p = weighted(1, {8.0, 5.0});
  p.parameters = {{"first", 7}, {"second", 6}};
  Shapes shapes;
  const fit::SimulationFit whole = fit_simulation(shapes, p);
  for (double& angle : p.measured[0].reshaped()) angle = std::remainder(angle, turn);
  p.periods = {turn, turn};
  const fit::SimulationFit f = fit_simulation(shapes, p);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(*f.parameters[k].value, *whole.parameters[k].value, 1e-6);
  const Eigen::ArrayXXd left = (f.motion[0] - p.measured[0]).array();
  EXPECT_LT(left.isNaN().select(0, left).abs().maxCoeff(), 1) << "the motion is told where it was measured";
  p.periods = {turn, 0};
  EXPECT_FALSE(fit_simulation(shapes, p).refused.empty()) << "as they are, the residuals of the second are turns";
  p.periods = {turn};
  EXPECT_THAT(refused([&] { fit_simulation(shapes, p); }), HasSubstr("2 channels have 1 periods"));
}

TEST(WeightedFit, CoversTheTruth) {
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Shapes shapes;
    const fit::SimulationFit f = fit_simulation(shapes, weighted(seed, {1.3, 0.7}));
    inside += f.parameters[0].interval.low < 1.3 && 1.3 < f.parameters[0].interval.high;
    inside += f.parameters[1].interval.low < 0.7 && 0.7 < f.parameters[1].interval.high;
  }
  // 400 intervals of 95 %: three deviations of a share are 0.033.
  EXPECT_NEAR(inside / 400.0, 0.95, 0.035);
}

TEST(WeightedFit, RefusesWhatIsMissingWithoutAWeightOfZero) {
  fit::SimulationProblem p = weighted(1, {1.3, 0.7});
  p.measured[0](5, 0) = std::numeric_limits<double>::quiet_NaN();
  Shapes shapes;
  EXPECT_THAT(refused([&] { fit_simulation(shapes, p); }), HasSubstr("all finite"));
  p.whitening[0].pop_back();
  EXPECT_THAT(refused([&] { fit_simulation(shapes, p); }), HasSubstr("8 samples"));
}

}  // namespace
}  // namespace camera_channels_test
