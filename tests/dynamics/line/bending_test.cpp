// Bending stiffness. (D106), (D107)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"
#include "support/line_models.hpp"

namespace bending_test {
namespace {

using namespace support;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double pi = std::numbers::pi;

/// `n` segments of a rod of length 2 m and EI = 5 N m² along `axis` from the origin, clamped there, without weight.
constexpr double length = 2, stiffness = 5;
Description cantilever(int n, const Vector3d& axis) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{});
  Segment s = Segment::bobs(length / n, 1.0 / n);
  s.bending_stiffness = stiffness;
  d.segments.assign(static_cast<std::size_t>(n), s);
  d.held = {{.node = 0, .clamp = axis}};
  d.gravity = 0;
  return d;
}

State straight(const Line& line, const Vector3d& axis) {
  State s{.position = Places::Zero(3, line.nodes()),
          .velocity = Places::Zero(3, line.nodes()),
          .tension = Eigen::VectorXd::Zero(line.segments())};
  for (int i = 1; i < line.nodes(); ++i) s.position.col(i) = s.position.col(i - 1) + line.segment(i - 1).length * axis;
  return s;
}

/// Where the tip of a level cantilever rests under a load P down at the tip or w per length.
Vector3d tip(int n, double P, double w) {
  Description d = cantilever(n, {1, 0, 0});
  const double l = length / n;
  for (int i = 1; i <= n; ++i) d.nodes[static_cast<std::size_t>(i)].force.z() = -w * l * (i == n ? 0.5 : 1);
  d.nodes.back().force.z() -= P;
  const Line line(d);
  return equilibrium(line, straight(line, {1, 0, 0})).position.rightCols<1>();
}

/// P L³/3EI, and by sums over nodes: the slope gains M_i ℓ/EI at each, half of that at the clamp.
TEST(Bending, OfACantileverIsThatOfTheBeam) {
  const double P = 1e-4;
  const auto sums = [&](int n) {
    double slope = 0, down = 0;
    for (int i = 0; i < n; ++i) {
      slope += P * (length - i * length / n) * length / n / stiffness * (i == 0 ? 0.5 : 1);
      down += slope * length / n;
    }
    return down;
  };
  const double exact = P * std::pow(length, 3) / 3 / stiffness;
  for (const int n : {4, 20, 40}) EXPECT_NEAR(-tip(n, P, 0).z() / sums(n), 1, 1e-7) << n;  // squares of the slope
  EXPECT_NEAR((sums(40) / exact - 1) / (sums(20) / exact - 1), 0.25, 1e-3);
  EXPECT_NEAR(-tip(40, P, 0).z() / exact, 1, 4e-4);
  EXPECT_NEAR(-tip(40, 0, P).z() / (P * std::pow(length, 4) / 8 / stiffness), 1, 2e-3);
}

/// φ'' = −(P/EI) cos φ with φ(0) = 0 and φ'(L) = 0, by shooting: the elastica.
Vector3d elastica(double P) {
  const int steps = 2000;
  const double h = length / steps;
  const auto shoot = [&](double bend, double& x, double& down) {
    double phi = 0, rate = bend;
    x = down = 0;
    for (int i = 0; i < steps; ++i) {  // the middle of each step by half of it
      const double middle = phi + h / 2 * rate, middle_rate = rate - h / 2 * P / stiffness * std::cos(phi);
      x += h * std::cos(middle);
      down += h * std::sin(middle);
      phi += h * middle_rate;
      rate -= h * P / stiffness * std::cos(middle);
    }
    return rate;
  };
  double low = 0, high = P * length / stiffness, x = 0, down = 0;
  for (int i = 0; i < 60; ++i) (shoot((low + high) / 2, x, down) > 0 ? high : low) = (low + high) / 2;
  return {x, 0, -down};
}

TEST(Bending, OfACantileverThatHangsFarOverIsTheElastica) {
  const double P = 5;  // P L²/EI = 4
  const Vector3d exact = elastica(P), coarse = tip(20, P, 0), fine = tip(40, P, 0);
  EXPECT_GT(-exact.z(), 0.6 * length);
  EXPECT_LT((fine - exact).norm(), 2e-3 * length);
  EXPECT_LT(((4 * fine - coarse) / 3 - exact).norm(), 2e-5 * length);  // what of second order is, taken off
}

// Clamped below, free above: the chain buckles at (4EI/ℓ²) sin²(π/4n), as n → ∞ at π²EI/4L².
TEST(Bending, HoldsAColumnUpToTheLoadOfEuler) {
  const int n = 10;
  const double l = length / n, critical = 4 * stiffness / (l * l) * std::pow(std::sin(pi / (4 * n)), 2);
  EXPECT_NEAR(critical / (pi * pi * stiffness / (4 * length * length)), 1, 1e-2);
  const auto aside = [&](double P) {
    Description d = cantilever(n, {0, 0, 1});
    d.nodes.back().force.z() = -P;
    const Line line(d);
    State s = straight(line, {0, 0, 1});
    for (int i = 1; i <= n; ++i) {
      const double slope = 1e-3 * i / n;
      s.position.col(i) = s.position.col(i - 1) + l * Vector3d(std::sin(slope), 0, std::cos(slope));
    }
    return std::abs(equilibrium(line, s).position(0, n));
  };
  EXPECT_LT(aside(0.99 * critical), 1e-6);
  EXPECT_GT(aside(1.01 * critical), 0.1 * length);
}

// Between two pins under a tension: ω² m = 4T/ℓ sin²(κℓ/2) + 16 EI/ℓ³ sin⁴(κℓ/2) with κ = kπ/L, which is that of the
// beam, (Tκ² + EIκ⁴)/μ, as ℓ → 0. The midpoint rule makes (2/h) atan(ωh/2) of ω.
TEST(Bending, OfATightLineHasTheFrequenciesOfABeam) {
  const int n = 20;
  const double l = length / n, T = 30, EA = 1e9, mass = 0.02, h = 1e-3;
  for (const int k : {1, 3}) {
    Description d = cantilever(n, Vector3d::Zero());
    for (Segment& s : d.segments) {
      s = Segment::bobs(l, mass);
      s.axial_stiffness = EA;
      s.bending_stiffness = stiffness;
    }
    d.held = {{.node = 0}, {.node = n}};
    const Line line(d);
    State s = straight(line, {1, 0, 0});
    s.position *= 1 + T / EA;
    const double size = 1e-7, half = std::sin(k * pi / (2 * n));
    for (int i = 1; i < n; ++i) s.position(1, i) = size * std::sin(k * pi * i / n);
    const double omega = std::sqrt((4 * T / l * half * half + 16 * stiffness / (l * l * l) * std::pow(half, 4)) / mass);
    const double kappa = k * pi / length;
    EXPECT_NEAR(omega / std::sqrt((T * kappa * kappa + stiffness * std::pow(kappa, 4)) * l / mass), 1, 0.01 * k * k);
    Stepper stepper(line, {});
    stepper.start(s);
    for (int i = 0; i < 500; ++i) stepper.step(s, h);
    const double phase = 500 * 2 * std::atan(omega * h / 2);
    // What is left: the tension that the swing itself adds, EA (κ size)²/4.
    EXPECT_NEAR(s.position(1, 7), size * std::sin(k * pi * 7 / n) * std::cos(phase), 1e-4 * size) << k;
  }
}

TEST(Bending, KeepsItsEnergyInLargeMotion) {
  for (const bool stretches : {false, true}) {
    Description d = cantilever(8, {1, 0, 0});
    d.gravity = 9.81;
    if (stretches)
      for (Segment& s : d.segments) s.axial_stiffness = 1e4;
    const Line line(d);
    State s = straight(line, {1, 0, 0});
    Stepper stepper(line, {});
    stepper.start(s);
    double liveliest = 0, bent = 0;
    int iterations = 0;
    for (int i = 0; i < 1000; ++i) {
      iterations += stepper.step(s, 5e-3).newton_iterations;
      liveliest = std::max(liveliest, stepper.energies().kinetic);
      bent = std::max(bent, stepper.energies().bending);
      ASSERT_LT(std::abs(stepper.energies().residual()), 1e-9 * (1 + liveliest));
    }
    EXPECT_GT(bent, 1);
    EXPECT_LT(iterations, 5500);  // Newton's derivative is right
  }
}

TEST(Bending, GoesOnAsOneLineWhereStiffnessChanges) {
  // Half the rod twice as stiff: half of the slopes' gains there; the node between has the mean compliance.
  const int n = 20;
  const double P = 1e-4, l = length / n;
  Description d = cantilever(n, {1, 0, 0});
  for (int j = 0; j < n / 2; ++j) d.segments[static_cast<std::size_t>(j)].bending_stiffness = 2 * stiffness;
  d.nodes.back().force.z() = -P;
  const Line line(d);
  double slope = 0, down = 0;
  for (int i = 0; i < n; ++i) {
    const double give = i == 0 ? 0.25 : i < n / 2 ? 0.5 : i == n / 2 ? 0.75 : 1;
    slope += P * (length - i * l) * l / stiffness * give;
    down += slope * l;
  }
  EXPECT_NEAR(-equilibrium(line, straight(line, {1, 0, 0})).position(2, n) / down, 1, 1e-7);
}

TEST(Bending, RefusesWhatCannotBend) {
  const auto refuses = [](Description d, const char* why) {
    EXPECT_THAT([&] { const Line line(d); }, ThrowsMessage<hydro::InputError>(HasSubstr(why)));
  };
  Description d = cantilever(3, {1, 0, 0});
  d.segments[1].bending_stiffness = -1;
  refuses(d, "segment 2 must not have the bending stiffness -1");
  d = cantilever(3, {2, 0, 0});
  refuses(d, "not of length 1");
  d = cantilever(3, {1, 0, 0});
  d.segments[0].bending_stiffness = 0;
  refuses(d, "node 0 is clamped");
  d = cantilever(3, {1, 0, 0});
  d.held.push_back({.node = 2, .clamp = {1, 0, 0}});
  refuses(d, "node 2 is clamped, but is no end");
  d = cantilever(3, {1, 0, 0});
  for (Segment& s : d.segments) {
    s.axial_stiffness = 1e6;
    s.catenary = true;
  }
  refuses(d, "bends");
}

}  // namespace
}  // namespace bending_test
