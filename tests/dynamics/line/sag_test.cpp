#include "sag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/line/catenary.hpp"
#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/stepper.hpp"
#include "support/line_models.hpp"

namespace sag_test {
namespace {

using namespace support;

dynamics::line::Span span(double g0, double g1) {
  return {.length = 45, .weight = 700, .height = {g0, g1}, .level = 0.9, .rounding = 0.005};
}

TEST(Sag, DerivativesAreItsOwn) {
  constexpr double T = 7e5;
  for (const auto& [g0, g1] : {std::pair{0.0, 0.5}, {0.3, 0.05}, {-0.1, 0.8}, {5.0, 30.0}, {0.0, 0.0}}) {
    const auto at = [&](double t, double a, double b, double level) {
      auto s = span(a, b);
      s.level = level;
      return sag_of(s, t);
    };
    const Sag s = at(T, g0, g1, 0.9);
    constexpr double e = 1e-7;
    const auto slope = [&](auto member, double t, double a, double b, double level) {
      return (member(at(T + t * e, g0 + a * e, g1 + b * e, 0.9 + level * e)) -
              member(at(T - t * e, g0 - a * e, g1 - b * e, 0.9 - level * e))) /
             (2 * e);
    };
    const auto shortening = [](const Sag& x) { return x.shortening; };
    EXPECT_NEAR(s.by_tension, slope(shortening, 1e6, 0, 0, 0) / 1e6, 1e-12);
    EXPECT_NEAR(s.by_height[0], slope(shortening, 0, 1, 0, 0), 1e-7);
    EXPECT_NEAR(s.by_height[1], slope(shortening, 0, 0, 1, 0), 1e-7);
    EXPECT_NEAR(s.by_level, slope(shortening, 0, 0, 0, 1), 1e-7);
    for (int i = 0; i < 2; ++i) {
      const auto relief = [i](const Sag& x) { return x.relief[i]; };
      EXPECT_NEAR(s.relief_by_tension[i], slope(relief, 1e6, 0, 0, 0) / 1e6, 1e-7);
      EXPECT_NEAR(s.relief_by_height[i][0], slope(relief, 0, 1, 0, 0), 1);  // of some 1e5 N/m
      EXPECT_NEAR(s.relief_by_height[i][1], slope(relief, 0, 0, 1, 0), 1);
    }
  }
}

// Forces and shortening come from one potential: ∂s/∂g = −∂(relief)/∂T, and S is that potential.
TEST(Sag, HasAPotential) {
  for (const auto& [g0, g1] : {std::pair{0.0, 0.5}, {0.3, 0.05}, {0.01, 0.02}}) {
    auto s = span(g0, g1);
    s.level = 1;
    const Sag at = sag_of(s, 7e5);
    constexpr double e = 1e-6;
    for (int i = 0; i < 2; ++i) {
      const double slope = (1 + s.height[i] / std::hypot(s.height[i], s.rounding)) / 2;
      EXPECT_NEAR(at.by_height[i], -at.relief_by_tension[i] * slope, 1e-12);
      auto up = s, down = s;
      up.height[i] += e;
      down.height[i] -= e;
      EXPECT_NEAR(-(sag_of(up, 7e5).stored - sag_of(down, 7e5).stored) / (2 * e), at.relief[i] * slope, 1e-2);
    }
    EXPECT_NEAR((sag_of(s, 7e5 + 1).stored - sag_of(s, 7e5 - 1).stored) / 2, at.shortening, 1e-8);
  }
}

TEST(Sag, IsContinuousWhereTheWholeSegmentLifts) {
  // q₀ + q₁ = ℓ
  const double T = 7e5, w = 700, l = 45, q0 = 12, g0 = w * q0 * q0 / (2 * T), g1 = w * (l - q0) * (l - q0) / (2 * T);
  dynamics::line::Span s{.length = l, .weight = w, .height = {g0 * (1 - 1e-9), g1}, .level = 0.9, .rounding = 0};
  const Sag resting = sag_of(s, T);
  s.height[0] = g0 * (1 + 1e-9);
  const Sag hanging = sag_of(s, T);
  EXPECT_NEAR(resting.shortening, hanging.shortening, 1e-10);
  EXPECT_NEAR(resting.relief[0], 0, 1e-4);
  EXPECT_NEAR(resting.relief[1], 0, 1e-4);
}

Description mooring(int n) {
  constexpr double length = 902.2, diameter = 0.09;
  const double mass = 77.7066 - 1025 * std::numbers::pi / 4 * diameter * diameter;  // as it weighs in water
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{});
  Segment s = Segment::rod(length / n, mass * length / n);
  s.axial_stiffness = 384.243e6;
  s.diameter = diameter;
  s.catenary = true;
  d.segments.assign(static_cast<std::size_t>(n), s);
  d.held = {{.node = 0}, {.node = n}};
  d.gravity = 9.80665;
  d.bed = {{.z = -320, .stiffness = 3e6, .damping = 3e5}};
  return d;
}

State moored(const Line& line) {
  State s = ends_at(line, {5.2, 0, -70});
  s.position.col(0) = Eigen::Vector3d(853.87, 0, -320);
  return equilibrium(line, hanging_shape(line, s));
}

// Twenty segments within 1e-4 of the closed form; straight chords are off by 1.3e-3.
TEST(Sag, GivesAMooringItsTensionWithTwentySegments) {
  const auto exact =
      dynamics::catenary({902.2, mooring(1).segments[0].mass / 902.2 * 9.80665, 384.243e6, true}, 848.67, 250);
  for (const int n : {20, 50, 200}) {
    const Line line(mooring(n));
    const State s = moored(line);
    Stepper stepper(line, {.scheme = Scheme::generalised_alpha});
    EXPECT_NEAR(stepper.balance(s)->holding.col(n).norm() / exact.fairlead(), 1, 1e-4) << n;
  }
}

TEST(Sag, StoresWhatItTakes) {
  double residual[2];
  for (int k = 0; k < 2; ++k) {
    const Line line(mooring(20));
    State s = moored(line);
    for (int i = 1; i < 20; ++i) s.velocity(1, i) = 2 * std::sin(std::numbers::pi * i / 20);
    Stepper stepper(line, {.scheme = Scheme::generalised_alpha, .rho_infinity = 0.9});
    stepper.start(s);
    const double lively = stepper.energies().kinetic;
    for (int i = 0; i < 400 << k; ++i) stepper.step(s, 0.02 / (1 << k));
    residual[k] = std::abs(stepper.energies().residual()) / lively;
  }
  EXPECT_LT(residual[1], 0.02);  // the couple that is left out, and the scheme's own damping
}

}  // namespace
}  // namespace sag_test
