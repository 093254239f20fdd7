#include "fit/shooting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace shooting_test {
namespace {

using fit::MotionLaw;
using fit::ShootingProblem;

// Published estimates of a real arm (Kaheman et al. 2022), over M₁₁ = 5.649e-3 kg m².
const std::vector<double> arm{0.4913, 0.5569, 60.99, 27.9, 0.042, 0.0018};

fit::Window noisy(fit::Window w, double noise, std::uint64_t stream) {
  for (Eigen::Index c = 0; c < w.values.cols(); ++c) {
    const auto e = froude_test::ar1_noise(static_cast<std::size_t>(w.values.rows()), 0, noise, stream + 1000 * c);
    for (Eigen::Index j = 0; j < w.values.rows(); ++j) w.values(j, c) += e[static_cast<std::size_t>(j)];
  }
  return w;
}

TEST(Shooting, FollowsABallToItsTerminalSpeed) {
  const double k = 0.02, g = 9.81, terminal = std::sqrt(g / k);
  const auto h = fit::follow(MotionLaw::fall, std::vector{k, g}, Eigen::Vector2d(50, 0), 0.05, 60, 4);
  for (int j = 0; j < 60; ++j)  // h = h₀ − ln cosh(gt/v_t)/k
    ASSERT_NEAR(h(j, 0), 50 - std::log(std::cosh(g * 0.05 * j / terminal)) / k, 1e-6);
}

TEST(Shooting, KeepsTheEnergyOfADoublePendulumWithoutFriction) {
  auto theta = arm;
  theta[4] = theta[5] = 0;
  const Eigen::Vector4d start(2.6, 3.5, 1, -1);
  const auto fine = fit::follow(MotionLaw::double_pendulum, theta, start, 0.001, 2000, 4);
  // Energy over M₁₁ with rates by central differences: their error, (ωΔt)²/6 of the speeds, is 1e-4 at 20 rad/s.
  const auto energy = [&](Eigen::Index j) {
    const double a = fine(j, 0), b = fine(j, 1), u = (fine(j + 1, 0) - fine(j - 1, 0)) / 0.002,
                 v = (fine(j + 1, 1) - fine(j - 1, 1)) / 0.002;
    return u * u / 2 + theta[1] * v * v / 2 + theta[0] * std::cos(a - b) * u * v + theta[2] * std::cos(a) +
           theta[3] * std::cos(b);
  };
  for (Eigen::Index j = 1; j < 1999; j += 50) EXPECT_NEAR(energy(j), energy(1), 0.02);
}

/// A pendulum with all damping terms, released, in two windows.
ShootingProblem pendulum(double noise) {
  ShootingProblem p{.law = MotionLaw::pendulum,
                    .windows = {},
                    .deviations = {0.01},
                    .start = {2.1, 0.05, 0.3, 0.0, 0.01, 0.0},
                    .fitted = {true, true, true, false, true, false}};
  const std::vector<double> truth{2, 0.03, 0.4, 0, 0.02, 0};
  for (int w = 0; w < 2; ++w)
    p.windows.push_back(
        noisy({0.04, fit::follow(MotionLaw::pendulum, truth, Eigen::Vector2d(1.0 - 0.3 * w, 0.2), 0.04, 300, 8)}, noise,
              static_cast<std::uint64_t>(7 + w)));
  return p;
}

TEST(Shooting, SharesParametersAmongWindowsThatBeginDifferently) {
  const auto f = fit::fit_motion(pendulum(0));
  EXPECT_NEAR(*f.parameters[0].value, 2, 1e-6);
  EXPECT_NEAR(*f.parameters[1].value, 0.03, 1e-5);
  EXPECT_NEAR(*f.parameters[2].value, 0.4, 1e-5);
  EXPECT_NEAR(*f.parameters[4].value, 0.02, 1e-5);
  EXPECT_NEAR(f.initial[0][0], 1.0, 1e-6);
  EXPECT_NEAR(f.initial[1][1], 0.2, 1e-5);
  EXPECT_LT(f.integration_error, 1e-3);
}

TEST(Shooting, HasTheDerivativesOfDifferencesEvenThroughTurningPoints) {
  // The gradient at the minimum vanishes only if every derivative is right; friction turns the sign in each swing.
  const auto p = pendulum(0.01);
  const auto f = fit::fit_motion(p);
  const auto cost = [&](std::size_t k, double change) {
    double sum = 0;
    for (std::size_t w = 0; w < 2; ++w) {
      std::vector<double> theta;
      for (const auto& c : f.parameters) theta.push_back(*c.value);
      theta[k] += change;
      sum += (fit::follow(p.law, theta, f.initial[w], 0.04, 300, p.substeps) - p.windows[w].values).squaredNorm();
    }
    return sum;
  };
  for (const std::size_t k : {0u, 1u, 2u, 4u}) {
    const double h = 0.02 * f.parameters[k].standard_error, slope = (cost(k, h) - cost(k, -h)) / (2 * h),
                 bend = (cost(k, h) - 2 * cost(k, 0) + cost(k, -h)) / (h * h);
    EXPECT_LT(std::abs(slope / bend), 1e-3 * f.parameters[k].standard_error) << f.parameters[k].name;
  }
}

TEST(Shooting, GivesAProfileThatAgreesWithTheIntervalWhereTheModelIsNearlyLinear) {
  const auto p = pendulum(0.01);
  const auto f = fit::fit_motion(p);
  const auto profile = fit::profile_interval(p, f, 1);
  const auto& c = f.parameters[1];
  EXPECT_NEAR(profile.low, c.interval.low, 0.15 * (c.interval.high - c.interval.low));
  EXPECT_NEAR(profile.high, c.interval.high, 0.15 * (c.interval.high - c.interval.low));
  EXPECT_THROW(fit::profile_interval(p, f, 3), hydro::InputError);
}

TEST(Shooting, IdentifiesADoublePendulumFromShortWindows) {
  ShootingProblem p{.law = MotionLaw::double_pendulum,
                    .windows = {},
                    .deviations = {0.001, 0.001},
                    .start = {0.45, 0.6, 58, 30, 0.06, 0.01},
                    .fitted = std::vector<bool>(6, true)};
  for (int w = 0; w < 4; ++w) {
    const Eigen::Vector4d start(2.6 - 0.4 * w, 3.5 - 0.3 * w, 1.0 * w, -1.0);
    p.windows.push_back(noisy({0.002, fit::follow(MotionLaw::double_pendulum, arm, start, 0.002, 250, 4)}, 0.001,
                              static_cast<std::uint64_t>(20 + w)));
  }
  const auto f = fit::fit_motion(p);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto& c = f.parameters[k];
    EXPECT_LT(c.interval.low, arm[k]) << c.name;
    EXPECT_GT(c.interval.high, arm[k]) << c.name;
  }
  EXPECT_NEAR(f.rms[0], 0.001, 1e-4);  // the noise that went in, known to 1/√2000
}

TEST(Shooting, SaysWhichParametersADirectionHides) {
  // A ball that has fallen for a moment only: drag and gravity pull alike as long as the speed hardly changes.
  ShootingProblem p{.law = MotionLaw::double_pendulum,
                    .windows = {},
                    .deviations = {0.001, 0.001},
                    .start = arm,
                    .fitted = std::vector<bool>(6, true)};
  // Hanging at rest: nothing moves, and nothing is seen of inertia and friction.
  p.windows.push_back({0.002, Eigen::MatrixXd::Constant(100, 2, 3.141592653589793)});
  const auto f = fit::fit_motion(p);
  EXPECT_FALSE(f.search.all_identifiable());
  EXPECT_FALSE(f.parameters[4].value);
}

}  // namespace
}  // namespace shooting_test
