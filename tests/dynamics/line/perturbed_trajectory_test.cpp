// The largest Lyapunov exponent of lines, and its error. (D101), (D102)
#include "dynamics/line/perturbed_trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "dynamics/line/node_damping.hpp"
#include "hydro/base/error.hpp"
#include "support/line_models.hpp"
#include "support/plain_pendulums.hpp"

namespace perturbed_trajectory_test {
namespace {

using namespace support;
using dynamics::Exponent;
using dynamics::Growth;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81, pi = std::numbers::pi;

Places along_x(const Line& line) {
  Places out = Places::Zero(3, line.nodes());
  out.row(0).setOnes();
  out.row(2).setOnes();
  return out;
}

Exponent exponent(const Line& line, State s, double duration, double h, double from) {
  const Stepper::Settings settings{.tolerance = PerturbedTrajectory::tolerance};
  Stepper stepper(line, settings);
  stepper.start(s);
  PerturbedTrajectory beside(line, settings, s, along_x(line));
  for (int i = 0; i < std::lround(duration / h); ++i) {
    const StepReport took = stepper.step(s, h);
    beside.follow(s, took, h);
  }
  return *beside.growth().exponent(from);
}

TEST(Growth, GivesTheRateOfAnExponentialWithoutError) {
  for (const double rate : {0.7, -1.3}) {
    double distance = 1e-6;
    Growth growth(2, distance);
    for (int i = 1; i <= 1000; ++i) {
      distance *= std::exp(0.01 * rate);
      distance *= growth.note(2 + 0.01 * i, distance);
      ASSERT_LT(distance, 1e-5);  // brought back
      ASSERT_GT(distance, 1e-7);
    }
    const Exponent e = *growth.exponent(4);
    EXPECT_NEAR(e.value, rate, 1e-11);
    EXPECT_LT(e.error, 1e-11);
    EXPECT_NEAR(growth.logarithm(), 10 * rate, 1e-9);
  }
}

// Rates that scatter by chance from step to step: the mean lies within 2.09 standard errors (Student, 19 degrees of
// freedom) 95 times in a hundred; of 400 trials 360 to 394 do in all but one case of 10⁴.
TEST(Growth, StatesAnErrorThatHolds) {
  std::mt19937 random(1);
  std::normal_distribution<double> rate(0.2, 3);
  int inside = 0, lasted = 0;
  for (int trial = 0; trial < 400; ++trial) {
    double distance = 1;
    Growth growth(0, distance);
    for (int i = 1; i <= 400; ++i) {
      distance *= std::exp(0.1 * rate(random));
      distance *= growth.note(0.1 * i, distance);
    }
    const Exponent e = *growth.exponent(0.1);
    inside += std::abs(e.value - 0.2) < 2.09 * e.error ? 1 : 0;
    lasted += e.has_lasted() ? 1 : 0;
  }
  EXPECT_GE(inside, 360);
  EXPECT_LE(inside, 394);
  EXPECT_GE(lasted, 380);  // 2/√20 is about two standard deviations of a correlation of chance
}

TEST(Growth, TellsWhatARegularMotionShows) {
  Growth growth(0, 1);
  double offset = 1;
  for (int i = 1; i <= 5000; ++i) {
    const double distance = (1 + i) * offset;
    offset *= growth.note(i, distance);
  }
  const Exponent e = *growth.exponent(100);
  EXPECT_NEAR(e.value / e.regular, 1, 5e-3);  // 1 + t for t
}

TEST(Growth, RefusesWhatIsNoNeighbour) {
  Growth growth(0, 1e-6);
  EXPECT_EQ(growth.exponent(1), std::nullopt);
  EXPECT_THAT([&] { growth.note(1, 1); },
              ThrowsMessage<hydro::NumericsError>(HasSubstr("at t = 1 s a neighbouring motion is 1e+06 times")));
  EXPECT_THAT([&] { growth.note(1, std::nan("")); }, ThrowsMessage<hydro::NumericsError>(HasSubstr("neighbouring")));
  EXPECT_THAT([&] { growth.exponent(0); }, ThrowsMessage<hydro::InputError>(HasSubstr("from 0 s on")));
}

// ẋ = 10 (y − x), ẏ = x (28 − z) − y, ż = xy − 8z/3 has the exponent 0.9056 (many authors).
TEST(Growth, FindsTheExponentOfLorenz) {
  const auto rate = [](const Vector3d& p) {
    return Vector3d(10 * (p.y() - p.x()), p.x() * (28 - p.z()) - p.y(), p.x() * p.y() - 8.0 / 3 * p.z());
  };
  const auto step = [&](Vector3d& p, double h) {
    const Vector3d a = rate(p), b = rate(p + h / 2 * a), c = rate(p + h / 2 * b), d = rate(p + h * c);
    p += h / 6 * (a + 2 * b + 2 * c + d);
  };
  const double h = 0.005;
  Vector3d p(1, 1, 20), q = p + Vector3d(1e-7, 0, 0);
  Growth growth(0, 1e-7);
  for (int i = 1; i <= 800000; ++i) {
    step(p, h);
    step(q, h);
    q = p + growth.note(i * h, (q - p).norm()) * (q - p);
  }
  const Exponent e = *growth.exponent(50);
  EXPECT_LT(e.error, 0.01);
  EXPECT_TRUE(e.has_lasted());
  EXPECT_NEAR(e.value, 0.9056, 3 * e.error);
}

// A pendulum on its head: ẍ = (g/ℓ) x, of which the midpoint rule makes (1 + σh/2)/(1 − σh/2) a step.
TEST(PerturbedTrajectory, FallsFromAnInvertedPendulumAtItsRate) {
  const Line line(pendulums(1));
  State s = in_plane(line, {0});
  s.position.col(1) = Vector3d(0, 0, 1);
  const double h = 0.01, sigma = std::sqrt(g);
  const Exponent e = exponent(line, s, 8, h, 4);
  EXPECT_NEAR(e.value, 2 / h * std::atanh(sigma * h / 2), 1e-6);
  EXPECT_LT(e.error, 1e-6);
}

// ẍ = −2βẋ − (g/ℓ) x: neighbours of rest come nearer by β, or by the slower root where β is above √(g/ℓ).
TEST(PerturbedTrajectory, ComesBackToADampedPendulumAtItsRate) {
  const double h = 0.01;
  for (const double beta : {0.3, 5.0}) {
    Description d = pendulums(1);
    d.nodes[1].forces = {std::make_shared<NodeDamping>(NodeDamping::Coefficients{2 * beta})};
    const Line line(d);
    const std::complex<double> root = -beta + std::sqrt(std::complex<double>(beta * beta - g)),
                               factor = (1.0 + root * h / 2.0) / (1.0 - root * h / 2.0);
    const Exponent e = exponent(line, in_plane(line, {pi / 2}), 60, h, 6);
    // Underdamped, the distance goes up and down by β/√(g/ℓ) over a swing, at both ends of 54 s.
    EXPECT_NEAR(e.value, std::log(std::abs(factor)) / h, beta < 1 ? 2 * 0.1 / 54 : 1e-5) << beta;
  }
}

TEST(PerturbedTrajectory, StaysBesideSmallSwings) {
  const Line line(pendulums(2));
  const Exponent e = exponent(line, in_plane(line, {pi / 2 - 0.01, pi / 2 + 0.01}), 300, 0.02, 30);
  EXPECT_LT(std::abs(e.value), e.regular);
}

// Against Lagrange's equations in angles, with a perturbed trajectory of their own.
TEST(PerturbedTrajectory, PartsFromAWildDoublePendulumAsThatOfLagrange) {
  const double duration = 400, from = 20;
  const Line line(pendulums(2));
  const Exponent e = exponent(line, in_plane(line, {0, 0}), duration, 0.01, from);

  const PlainPendulums plain{.length = Eigen::Vector2d(1, 1), .mass = Eigen::Vector2d(1, 1)};
  const double h = 0.005, apart = 1e-7;
  Eigen::VectorXd q = Eigen::Vector2d(pi / 2, pi / 2), v = Eigen::Vector2d::Zero();
  Eigen::VectorXd q2 = q, v2 = v + Eigen::VectorXd::Constant(2, apart);
  Growth growth(0, std::sqrt(2) * apart);
  for (int i = 1; i <= std::lround(duration / h); ++i) {
    plain.step(q, v, h);
    plain.step(q2, v2, h);
    const double share = growth.note(i * h, std::hypot((q2 - q).norm(), (v2 - v).norm()));
    q2 = q + share * (q2 - q);
    v2 = v + share * (v2 - v);
  }
  const Exponent theirs = *growth.exponent(from);
  EXPECT_GT(e.value, 10 * e.error);
  EXPECT_NEAR(e.value, theirs.value, 3 * std::hypot(e.error, theirs.error));
}

TEST(PerturbedTrajectory, RefusesWhatHasNoNeighbours) {
  const Line line(pendulums(2));
  const State s = in_plane(line, {0, 0});
  EXPECT_THAT([&] { PerturbedTrajectory(line, {.scheme = Scheme::generalised_alpha}, s); },
              ThrowsMessage<hydro::InputError>(HasSubstr("accelerations of their own")));
  Description massless = pendulums(2);
  massless.nodes[1].mass = 0;
  const Line light(massless);
  EXPECT_THAT([&] { PerturbedTrajectory(light, {}, s); }, ThrowsMessage<hydro::InputError>(HasSubstr("no mass")));
  Description floating = pendulums(2);
  floating.gravity = 0;
  const Line weightless(floating);
  EXPECT_THAT([&] { PerturbedTrajectory(weightless, {}, s); },
              ThrowsMessage<hydro::InputError>(HasSubstr("without gravity")));
}

}  // namespace
}  // namespace perturbed_trajectory_test
