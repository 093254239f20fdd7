#include "dynamics/line/line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "dynamics/line/path.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"
#include "support/line_models.hpp"

namespace line_test {
namespace {

using namespace support;
using testing::HasSubstr;
using testing::ThrowsMessage;

// (D71) against the integrals over a rod of ten thousand points.
TEST(Line, MassOfALinkIsThatOfItsPoints) {
  constexpr int n = 10000;
  constexpr double mass = 3, length = 2, centre = 0.4;
  double m00 = 0, m01 = 0, m11 = 0, inertia = 0;
  // Density 1 + c s with its centre at 0.4: ∫s(1 + cs)/∫(1 + cs) = (1/2 + c/3)/(1 + c/2).
  const double c = (0.5 - centre) / (centre / 2 - 1.0 / 3);
  for (int i = 0; i < n; ++i) {
    const double s = (i + 0.5) / n, dm = mass / n * (1 + c * s) / (1 + c / 2);
    m00 += (1 - s) * (1 - s) * dm;
    m01 += s * (1 - s) * dm;
    m11 += s * s * dm;
    inertia += (s - centre) * (s - centre) * length * length * dm;
  }
  Description d;
  d.nodes.assign(2, Node{});
  d.segments = {{.length = length, .mass = mass, .centre = centre, .inertia = inertia}};
  const Line line(d);
  constexpr double quadrature = 1e-8;  // midpoint rule with 10 000 points
  EXPECT_NEAR(line.mass(0), m00, quadrature);
  EXPECT_NEAR(line.mass_between(0), m01, quadrature);
  EXPECT_NEAR(line.mass(1), m11, quadrature);
}

TEST(Line, ARodAndTwoBobsHaveTheirTextbookMasses) {
  Description d;
  d.nodes.assign(3, Node{});
  d.segments = {Segment::rod(2, 6), Segment::bobs(3, 8)};
  const Line line(d);
  EXPECT_DOUBLE_EQ(line.mass(0), 2);
  EXPECT_DOUBLE_EQ(line.mass_between(0), 1);
  EXPECT_DOUBLE_EQ(line.mass(2), 4);
  EXPECT_NEAR(line.mass_between(1), 0, 1e-15);
}

TEST(Line, SaysWhatCannotBe) {
  const auto with = [](Segment s) {
    Description d;
    d.nodes.assign(2, Node{});
    d.segments = {s};
    return d;
  };
  EXPECT_THAT([&] { Line(with({.length = 0})); }, ThrowsMessage<hydro::InputError>(HasSubstr("segment 1")));
  EXPECT_THAT([&] { Line(with({.length = 1, .tension_only = true})); },
              ThrowsMessage<hydro::InputError>(HasSubstr("cannot go slack")));
  Description held = with({.length = 1});
  held.held = {{.node = 2}};
  EXPECT_THAT([&] { Line{held}; }, ThrowsMessage<hydro::InputError>(HasSubstr("no node 2")));
  held.held = {{.node = 1}, {.node = 1}};
  EXPECT_THAT([&] { Line{held}; }, ThrowsMessage<hydro::InputError>(HasSubstr("held twice")));
}

// Huijgen 2024, eqs. 4.3-4.5.
TEST(LinkAngles, AreThoseOfTheSource) {
  const Line line(pendulums(1, 2));
  State s = in_plane(line, {0});
  for (const double theta : {-1.2, 0.0, 0.7, 1.5})
    for (const double phi : {-3.0, 0.0, 2.0}) {
      s.position.col(1) =
          2 * Eigen::Vector3d(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta));
      EXPECT_NEAR(link_angles(s, 0).polar, theta, 1e-15);
      EXPECT_NEAR(link_angles(s, 0).azimuth, phi, 1e-15);
    }
}

TEST(LinkAngles, FollowALinkOverThePoleWithoutAJump) {
  const Line line(pendulums(1));
  State s = in_plane(line, {0});
  LinkAngles last{0, 0};
  for (int i = 1; i <= 700; ++i) {
    s = in_plane(line, {0.02 * i});
    const LinkAngles now = link_angles(s, 0, last);
    EXPECT_NEAR(now.polar, 0.02 * i, 1e-13);
    EXPECT_NEAR(now.azimuth, 0, 1e-13);
    last = now;
  }
}

// A link in the plane of x and z has one angle all the way round: 0 towards +x, π/2 straight down, π towards −x.
TEST(LinkAngles, BeginAlikeForLinksOfOnePlane) {
  constexpr double pi = std::numbers::pi;
  const Line line(pendulums(1));
  for (const double polar : {-3.0, -1.6, -0.5, 0.0, 0.5, 1.5, pi / 2, 1.6, 3.0, pi}) {
    const LinkAngles found = first_link_angles(in_plane(line, {polar}), 0);
    EXPECT_NEAR(found.polar, polar, 1e-13);
    EXPECT_NEAR(found.azimuth, 0, 1e-13) << polar;
  }
  State s = in_plane(line, {0});
  for (const double side : {1.0, -1.0})
    for (const double noise : {1e-17, -1e-17}) {
      s.position.col(1) = s.position.col(0) + Eigen::Vector3d(noise, side, -0.2);
      EXPECT_NEAR(first_link_angles(s, 0).azimuth, side * pi / 2, 1e-13) << "across the plane";
    }
}

TEST(LinkAngles, KeepTheAzimuthAndThePolarRateWhereTheLinkIsVertical) {
  const Line line(pendulums(1));
  State s = in_plane(line, {std::numbers::pi / 2});
  const Eigen::Vector3d aside(std::cos(1.0), std::sin(1.0), 0);
  s.position.col(1) = s.position.col(0) + Eigen::Vector3d(1e-17, 0, -2);
  s.velocity.col(1) = s.velocity.col(0) - 3 * aside;  // 2 m and 3 m/s: 1.5 rad/s beyond straight down
  const LinkAngles now = link_angles(s, 0, {1.5, 1.0});
  EXPECT_EQ(now.azimuth, 1.0);
  EXPECT_NEAR(link_rates(s, 0, now).polar, 1.5, 1e-12);
}

TEST(LinkAngles, HaveTheRatesOfTheirChange) {
  const Line line(pendulums(1));
  State s = in_plane(line, {0});
  const Eigen::Vector3d d(0.3, -0.5, 0.7), v(0.2, 0.9, -0.4);
  constexpr double e = 1e-6;
  for (const double before : {0.0, 3.1}) {  // either branch
    s.position.col(1) = d;
    s.velocity.col(1) = v;
    const LinkAngles now = link_angles(s, 0, {before, 0}), rates = link_rates(s, 0, now);
    s.position.col(1) = d + e * v;
    const LinkAngles later = link_angles(s, 0, now);
    EXPECT_NEAR(rates.polar, (later.polar - now.polar) / e, 1e-5);
    EXPECT_NEAR(rates.azimuth, (later.azimuth - now.azimuth) / e, 1e-5);
  }
}

TEST(SplinePath, ConvergesToAPathThatEndsStraight) {
  double error[2];
  for (int k = 0; k < 2; ++k) {
    std::vector<double> time;
    std::vector<Eigen::Vector3d> places;
    for (int i = 0; i <= 10 << k; ++i) {
      time.push_back(std::numbers::pi * i / (10 << k));
      places.push_back({std::sin(time.back()), 2 * time.back(), 1});  // bends nowhere at either end
    }
    const SplinePath path(time, places);
    error[k] = 0;
    for (double t = 0; t < 3.14; t += 0.01)
      error[k] = std::max(error[k], std::abs(path.at(t).position.x() - std::sin(t)));
    EXPECT_NEAR(path.at(1).position.y(), 2, 1e-14);
    EXPECT_EQ(path.at(-1).position, places.front());
    EXPECT_EQ(path.at(4).position, places.back());
    EXPECT_EQ(path.at(4).velocity.norm(), 0);
  }
  EXPECT_NEAR(error[0] / error[1], 16, 2);  // fourth order
}

TEST(SplinePath, HasVelocityAndAccelerationThatAreItsOwnDerivatives) {
  std::vector<double> time{0, 0.4, 1, 1.3, 2};
  std::vector<Eigen::Vector3d> places{{0, 0, 0}, {1, 0, 1}, {0, 2, 1}, {0, 1, 3}, {1, 1, 1}};
  const SplinePath path(time, places);
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_LT((path.at(time[i]).position - places[i]).norm(), 1e-14);
  constexpr double e = 1e-5;
  for (const double t : {0.1, 0.4, 0.9, 1.0, 1.7}) {
    EXPECT_LT(((path.at(t + e).position - path.at(t - e).position) / (2 * e) - path.at(t).velocity).norm(), 1e-7);
    EXPECT_LT(((path.at(t + e).velocity - path.at(t - e).velocity) / (2 * e) - path.at(t).acceleration).norm(), 1e-3);
  }
  EXPECT_THROW(SplinePath({0, 0}, {places[0], places[1]}), hydro::InputError);
}

TEST(Stepper, RefusesSettingsAndStartsThatCannotBe) {
  const Line line(pendulums(2));
  EXPECT_THAT([&] { Stepper(line, {.gamma = 0}); }, ThrowsMessage<hydro::InputError>(HasSubstr("gamma")));
  EXPECT_THAT([] { parse_scheme("energy_momentun"); }, ThrowsMessage<hydro::InputError>(HasSubstr("energy_momentum")));
  State s = in_plane(line, {0, 0});
  s.position(0, 2) += 0.1;
  Stepper stepper(line, {});
  EXPECT_THAT([&] { stepper.start(s); }, ThrowsMessage<hydro::InputError>(HasSubstr("segment 2")));
  s = in_plane(line, {0, 0});
  s.velocity(0, 2) = 1;
  EXPECT_THAT([&] { stepper.start(s); }, ThrowsMessage<hydro::InputError>(HasSubstr("segment 2")));
  Description light = pendulums(2);
  light.nodes[1].mass = 0;
  const Line massless(light);
  EXPECT_THAT([&] { Stepper(massless, {.scheme = Scheme::generalised_alpha}); },
              ThrowsMessage<hydro::InputError>(HasSubstr("energy_momentum")));
}

}  // namespace
}  // namespace line_test
