#include "dynamics/line/equilibrium.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "dynamics/line/catenary.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "support/line_models.hpp"

namespace equilibrium_test {
namespace {

using namespace support;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// The largest force that a state leaves over at free nodes, by adding up what acts.
double unbalanced(const Line& line, const State& s) {
  Places sum = line.constant_load();
  for (int j = 0; j < line.segments(); ++j) {
    const Vector3d pull = s.tension[j] * (s.position.col(j + 1) - s.position.col(j)).normalized();
    sum.col(j) += pull;
    sum.col(j + 1) -= pull;
  }
  double worst = 0;
  for (int i = 0; i < line.nodes(); ++i)
    if (line.held(i) == nullptr) worst = std::max(worst, sum.col(i).norm());
  return worst;
}

// An even loop of ten equal links: tan of the j-th from the middle is (2j − 1) w/2H, and widths add up to the gap.
TEST(HangingShape, IsTheDiscreteCatenary) {
  const Line line(loop(10));
  const double width = 2.5, link = 1.7, weight = 14 * 1.7 * 9.81;
  double low = 1e-3, high = 1e5;  // bisection for H: slow, plain, nobody else's
  const auto spread = [&](double H) {
    double sum = 0;
    for (int j = 1; j <= 5; ++j) sum += 2 * link * H / std::hypot(H, (j - 0.5) * weight);
    return sum;
  };
  for (int i = 0; i < 200; ++i) (spread((low + high) / 2) < width ? low : high) = (low + high) / 2;
  const State s = hanging_shape(line, ends_at(line, {width, 0, 0}));
  EXPECT_LT(worst_length(line, s), 1e-14);
  double x = 0, z = 0;
  for (int j = 0; j < 10; ++j) {
    const double V = (4.5 - j) * weight, T = std::hypot(low, V);
    EXPECT_NEAR(s.tension[j], T, 1e-10 * T);
    x += link * low / T;
    z -= link * V / T;
    EXPECT_NEAR(s.position(0, j + 1), x, 1e-11);
    EXPECT_NEAR(s.position(2, j + 1), z, 1e-11);
  }
}

TEST(HangingShape, IsAtRestAlready) {
  for (const Vector3d& end : {Vector3d(2.5, 0, 0), Vector3d(16.9, 0, 0), Vector3d(10, 3, -9), Vector3d(1.5, 0, 3)})
    for (const int n : {18, 1000}) {
      const Line line(loop(n));
      const State hung = hanging_shape(line, ends_at(line, end)), rest = equilibrium(line, hung);
      // Weight 2 335 N; rounding of n sums, and of a line that is almost straight
      EXPECT_LT((hung.position - rest.position).cwiseAbs().maxCoeff(), 1e-10) << end.transpose() << ' ' << n;
      EXPECT_LT(unbalanced(line, rest), 1e-7) << end.transpose() << ' ' << n;
    }
}

TEST(HangingShape, OfManyElasticLinksIsTheElasticCatenary) {
  double error[2];
  for (int k = 0; k < 2; ++k) {
    Description d = loop(100 << k);
    for (Segment& s : d.segments) s.axial_stiffness = 2e4;
    const Line line(d);
    const State s = hanging_shape(line, ends_at(line, {8, 0, 5}));
    const auto exact = dynamics::catenary({17, 14 * 9.81, 2e4, false}, 8, 5);
    const int last = line.segments() - 1;
    const Vector3d at_end = s.tension[last] * (s.position.col(last + 1) - s.position.col(last)).normalized() -
                            line.constant_load().col(last + 1);
    error[k] = std::hypot(at_end.x() - exact.horizontal, at_end.z() - exact.vertical) / exact.fairlead();
  }
  EXPECT_LT(error[0], 2e-4);
  EXPECT_NEAR(error[0] / error[1], 4, 0.1);  // second order
}

TEST(HangingShape, HangsStraightWhereOneEndIsFree) {
  Description d = loop(5);
  d.held.pop_back();
  const Line line(d);
  const State s = equilibrium(line, hanging_shape(line, ends_at(line, {0, 0, 0})));
  for (int j = 0; j < 5; ++j) {
    EXPECT_NEAR(s.position(2, j + 1), -3.4 * (j + 1), 1e-12);
    EXPECT_NEAR(s.tension[j], 14 * 9.81 * (17 - 3.4 * (j + 0.5)), 1e-9);
  }
}

TEST(HangingShape, RefusesEndsFartherThanTheLineSayingByHowMuch) {
  const Line line(loop(18));
  EXPECT_THAT(
      [&] {
        hanging_shape(line, ends_at(line, {18.25, 0, 0}));
      },
      ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("1.25 m more"), HasSubstr("18.25 m apart"))));
}

// With an odd number of rigid links and ends closer than one of them, the lowest link is pressed.
TEST(Equilibrium, OfEndsCloserThanALinkPressesTheLowest) {
  const Line line(loop(17));
  for (const double gap : {0.0, 0.2, 0.5, 0.9}) {
    const State s = equilibrium(line, hanging_shape(line, ends_at(line, {gap, 0, 0})));
    EXPECT_LT(worst_length(line, s), 1e-13) << gap;
    EXPECT_LT(unbalanced(line, s), 1e-7) << gap;
    EXPECT_LT(s.tension[8], 0) << gap;
    EXPECT_NEAR(s.position(2, 8), s.position(2, 9), 1e-9) << gap;
  }
}

TEST(Equilibrium, OfASlackStringLeavesItsLowestPartWithoutTension) {
  Description d = loop(17);
  for (Segment& s : d.segments) {
    s.axial_stiffness = 1e8;
    s.tension_only = true;
  }
  const Line line(d);
  const State s = equilibrium(line, hanging_shape(line, ends_at(line, {0.4, 0, 0})));
  EXPECT_NEAR(s.tension[8], 0, 1e-9);
  EXPECT_GT(s.tension[7], 0);
  EXPECT_LT(unbalanced(line, s), 1e-7);
}

TEST(Equilibrium, HoldsFromVerySoftToVeryStiff) {
  for (const double stiffness : {1e3, 1e6, 1e9, 1e12}) {
    Description d = loop(18);
    for (Segment& s : d.segments) s.axial_stiffness = stiffness;
    const Line line(d);
    for (const double width : {2.5, 18.0}) {
      const State s = equilibrium(line, hanging_shape(line, ends_at(line, {width, 0, 0})));
      EXPECT_LT(unbalanced(line, s), 1e-9 * s.tension.maxCoeff() + 1e-7) << stiffness << ' ' << width;
    }
  }
}

// Of a steady current alone: a weightless line between two points across a current is a parabola to second order in
// the sag, with H from the load and the sag's own geometry: slack L − d = q²d³/(24H²).
TEST(Equilibrium, OfALightTautLineInACurrentIsAParabola) {
  const double U = 0.5, d_line = 0.05, gap = 20, slack = 0.002;
  const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(50)};
  const auto field = std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, water,
                                                                   hydro::waves::HarmonicField::Options{},
                                                                   hydro::waves::Current::uniform({0, U}));
  constexpr int n = 80;
  Description d;
  d.nodes.assign(n + 1, Node{});
  d.segments.assign(n, {.length = (gap + slack) / n, .mass = 0.1, .diameter = d_line, .cd = 1.2});
  d.held = {{.node = 0}, {.node = n}};
  d.gravity = 0;
  d.water = {.field = field, .wet = Wet::all};
  const Line line(d);
  State guess = ends_at(line, {gap, 0, -10});
  for (int i = 0; i <= n; ++i) guess.position.col(i) = Vector3d(gap * i / n, 0.01 * std::sin(3.14159 * i / n), -10);
  const State s = equilibrium(line, guess);
  const double q = 0.5 * 1000 * 1.2 * d_line * U * U, H = q * gap * std::sqrt(gap / (24 * slack));
  EXPECT_NEAR(s.tension[n / 2], H, 2e-3 * H);  // (sag/gap)² = 4e-5, and 1/n² of the polygon
  EXPECT_NEAR(s.position(1, n / 2), q * gap * gap / (8 * H), 2e-3 * q * gap * gap / (8 * H));
}

const hydro::Water sea{.density = 1025, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(8)};
std::shared_ptr<const hydro::waves::WaveField> at_sea(double current = 0) {
  return std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, sea,
                                                       hydro::waves::HarmonicField::Options{},
                                                       hydro::waves::Current::uniform({current, 0}));
}

/// A hose that floats, 1 kg/m and 50 mm thick, from an anchor at 8 m; in water it is lifted by 10.1 N/m.
Description hose(double length, int n, double current = 0) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{});
  Segment s = Segment::rod(length / n, length / n);
  s.diameter = 0.05;
  s.cd = 1.2;
  s.cd_tangential = 0.02;
  d.segments.assign(static_cast<std::size_t>(n), s);
  d.held = {{.node = 0}};
  d.water = {.field = at_sea(current), .wet = Wet::below_surface, .buoyancy = true};
  return d;
}
const double hose_lift = (1025 * 3.141592653589793 / 4 * 0.05 * 0.05 - 1) * 9.81;  // N/m
State anchored(const Line& line) {
  State s = ends_at(line, {0, 0, 0});
  s.position.row(2).setConstant(-8);
  return hanging_shape(line, s);
}

// Its guess hangs from the anchor through the bed: in balance, as a pressed pole that would fall upwards.
TEST(Equilibrium, LetsWhatStandsOnItsHeadTurnOver) {
  const Line line(hose(5, 40));
  const State s = equilibrium(line, anchored(line));
  EXPECT_NEAR(s.position(2, 40), -3, 1e-9);  // of rounding
  EXPECT_NEAR(s.tension[0], hose_lift * (5 - 5.0 / 80), 1e-9);
  EXPECT_GE(s.tension.minCoeff(), 0);
}

// Longer than the water is deep it rises to the surface and floats there with half of its section wet, as heavy as it
// is: near the middle the wet share of a circle is ½ + 4/π depth/D. Up to where it leaves the anchor it hangs straight.
TEST(Equilibrium, LetsALongHoseFloatAtTheSurface) {
  for (const double current : {0.0, 0.2}) {
    const Line line(hose(20, 40, current));
    const State s = equilibrium(line, anchored(line));
    EXPECT_GE(s.tension.minCoeff(), -1e-6) << current;  // N: what floats without current has none
    const double share = 9.81 / (hose_lift + 9.81);
    for (int i = 36; i <= 40; ++i)
      EXPECT_NEAR(s.position(2, i), std::numbers::pi / 4 * (0.5 - share) * 0.05, 1e-5) << current << ' ' << i;
    EXPECT_GT(s.position(0, 40), 11.9) << current;
    // The links that rise through the surface are turned by as much as they are stiff: a link of 0.5 m in 8 m.
    EXPECT_NEAR(s.tension[0], hose_lift * 8, 0.07 * hose_lift * 8) << current;
  }
}

// 12 m of rope in 8 m of water: its float lies at the surface and carries half of the slack rope at least.
TEST(Equilibrium, LetsAFloatDownToTheSurface) {
  Description d;
  d.nodes.assign(21, Node{});
  d.segments.assign(20, Segment::rod(0.6, 0.3));
  d.nodes[20] = {.mass = 5, .bob = {.diameter = 0.4, .wet = Wet::below_surface, .buoyancy = true}};
  d.held = {{.node = 0}};
  d.water = {.field = at_sea(), .wet = Wet::nothing};
  const Line line(d);
  const State s = equilibrium(line, anchored(line));
  // What hangs on the float is 10 m less half of a link: it is wet by the share that lifts that, within that half.
  const double height = 0.2 - s.position(2, 20), share = height * height * (0.6 - height) / (4 * 0.008);
  EXPECT_NEAR(share * 1025 * 9.81 * 3.141592653589793 / 6 * 0.064, (5 + 10 * 0.5) * 9.81, 0.4 * 0.5 * 9.81);
  EXPECT_GE(s.tension.minCoeff(), -1e-6);  // N: next to none in the lowest link
}

// A chain that is longer than its way down and along the bed hangs straight and lies on the bed: wh at its top.
TEST(Equilibrium, LaysASlackChainOnItsBed) {
  for (const double stiffness : {3e8, std::numeric_limits<double>::infinity()}) {
    Description d;
    d.nodes.assign(41, Node{});
    Segment link = Segment::rod(2, 160);
    link.diameter = 0.1;
    link.axial_stiffness = stiffness;
    d.segments.assign(40, link);
    d.held = {{.node = 0}, {.node = 40}};
    d.water = {.field = at_sea(), .wet = Wet::all, .buoyancy = true};
    d.bed = {{.z = -60, .stiffness = 1e6, .damping = 1e5}};
    const Line line(d);
    State ends = ends_at(line, {0, 0, -60});
    ends.position.col(0) = Vector3d(2, 0, -3);
    const State s = equilibrium(line, hanging_shape(line, ends));
    const double weight = (80 - 1025 * 3.141592653589793 / 4 * 0.01) * 9.81;
    // The lowest link that hangs is carried by the bed in part; it sinks by 7 mm.
    EXPECT_NEAR(s.tension[0], weight * 56, weight) << stiffness;
    EXPECT_GT(s.position.row(2).minCoeff(), -60.05) << stiffness;
    EXPECT_GE(s.tension.minCoeff(), -1e-3 * weight) << stiffness;
  }
}

TEST(Equilibrium, SaysWhatFalls) {
  Description d = loop(3);
  d.held.clear();
  const Line line(d);
  EXPECT_THAT(
      [&] {
        hanging_shape(line, ends_at(line, {1, 0, 0}));
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("nothing holds the line")));
}

}  // namespace
}  // namespace equilibrium_test
