#include "dynamics/line/equilibrium.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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
