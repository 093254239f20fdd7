#include "dynamics/force/member.hpp"

#include <gtest/gtest.h>

#include <array>

#include "dynamics/force/ramped_field.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "support/force_law_models.hpp"
#include "support/small_seas.hpp"

namespace member_test {
namespace {

using namespace dynamics;

/// Heights at both ends, and the rise: dry, wet, through the underside, the axis, the top, all of them, level.
constexpr std::array<std::array<double, 3>, 8> cases{{{-2, -1, 0.5},
                                                      {1, 2, 0.5},
                                                      {-1, 0.1, 0.5},
                                                      {-1, 1, 0.5},
                                                      {1.3, -0.6, 0.5},
                                                      {0.1, -0.1, 0.5},
                                                      {0.1, 0.1, 0.5},
                                                      {-1, 1, 1e-6}}};

TEST(WetShare, IsTheIntegralOfTheWetness) {
  for (const auto& [g0, g1, h] : cases) {
    const int n = 200'000;
    double share = 0, moment = 0;
    for (int i = 0; i < n; ++i) {
      const double s = (i + 0.5) / n, wet = wetness(g0 + (g1 - g0) * s, h);
      share += wet / n;
      moment += wet * s / n;
    }
    const WetShare w = wet_share(g0, g1, h);
    EXPECT_NEAR(w.share, share, 5e-6) << g0;  // a step of the integrand within one of n intervals
    EXPECT_NEAR(w.share * w.place, moment, 5e-6) << g0;
  }
}

TEST(WetShare, KnowsItsDerivatives) {
  for (const auto& c : cases) {
    const Eigen::Vector3d x(c[0], c[1], c[2]);
    const WetShare w = wet_share(x[0], x[1], x[2]);
    for (int i = 0; i < 3; ++i) {
      const double e = 1e-5 * c[2];
      const Eigen::Vector3d up = x + e * Eigen::Vector3d::Unit(i), down = x - e * Eigen::Vector3d::Unit(i);
      const WetShare a = wet_share(up[0], up[1], up[2]), b = wet_share(down[0], down[1], down[2]);
      // Round-off of a difference of about 1 over 2e.
      EXPECT_NEAR(w.share_by[i], (a.share - b.share) / (2 * e), 1e-8 + 1e-15 / e) << c[0] << ' ' << i;
      EXPECT_NEAR(w.place_by[i], (a.place - b.place) / (2 * e), 1e-8 + 1e-15 / e) << c[0] << ' ' << i;
    }
  }
}

TEST(Member, IsWetBelowTheSurfaceWhateverItsSlope) {
  const auto bodies = support::two_bodies();
  const auto water = support::still_water();
  const auto length = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d c = bodies[0].rest_centre();
    const SlenderMember m{0, from - c, to - c, 0.2, 7, Immersion::surface};
    const PlacedMember at = placed(m, rest_state(bodies));
    double sum = 0;
    for (const WetPiece& p : wet_pieces(m, at, *water, 0, false)) sum += p.length;
    return sum;
  };
  EXPECT_NEAR(length({0, 0, -3}, {0, 0, 1}), 3, 1e-6);                 // upright: to the surface
  EXPECT_NEAR(length({0, 0, -3}, {4, 0, 1}), 3 * std::sqrt(2), 1e-6);  // sloping: half wet sections on both sides
  EXPECT_NEAR(length({0, 0, 0}, {4, 0, 0}), 2, 1e-6);                  // afloat with half of its height
  EXPECT_NEAR(length({0, 0, 0.05}, {4, 0, 0.05}), 1, 1e-6);
  EXPECT_EQ(length({0, 0, 0.2}, {4, 0, 1}), 0);
}

// Gauss' points on both sides of still water, where what linear theory continues upwards has a kink.
TEST(Member, PointsOfOneThatIsAlwaysWetSumCubicsBelowAndAboveStillWater) {
  const auto bodies = support::two_bodies();
  const Eigen::Vector3d c = bodies[0].rest_centre();
  const auto cubic = [](double z) { return z < 0 ? 1 + z - 2 * z * z + 3 * z * z * z : 1.0; };
  const auto below = [](double z) { return z + z * z / 2 - 2 * z * z * z / 3 + 3 * z * z * z * z / 4; };
  for (const auto& [low, high] : {std::array{-1.3, 0.4}, {-0.3, 0.9}, {-2.0, -0.5}}) {
    const SlenderMember m{0, Eigen::Vector3d(0, 0, low) - c, Eigen::Vector3d(1, 0, high) - c, 0.2, 3, Immersion::whole};
    double sum = 0;
    for (const WetPiece& p : wet_pieces(m, placed(m, rest_state(bodies)), *support::still_water(), 0, false))
      sum += p.length * cubic(c.z() + p.arm.z());
    const double exact = below(std::min(high, 0.0)) - below(low) + std::max(high, 0.0);
    EXPECT_NEAR(sum, std::hypot(1, high - low) / (high - low) * exact, 1e-13) << low;
  }
}

TEST(Member, IsWetToTheWaveThatPasses) {
  const auto bodies = support::two_bodies();
  const auto sea = support::steep_wave(hydro::waves::Stretching::vertical);
  const Eigen::Vector3d c = bodies[0].rest_centre();
  const SlenderMember m{0, Eigen::Vector3d(0, 0, -3) - c, Eigen::Vector3d(0, 0, 3) - c, 0.2, 7, Immersion::surface};
  const double t = 0.4;
  double sum = 0;
  for (const WetPiece& p : wet_pieces(m, placed(m, rest_state(bodies)), *sea, t, false)) sum += p.length;
  EXPECT_NEAR(sum, 3 + sea->elevation(t, 0, 0), 1e-6);
}

// (D41): the velocity's own derivatives by time and place, whatever the ramp does.
TEST(RampedField, TellsTheDerivativesOfItsOwnVelocity) {
  const auto current = hydro::waves::Current::profile({-20, 0}, {{0.1, 0}, {0.8, 0.2}});
  const auto sea = support::steep_wave(hydro::waves::Stretching::vertical, current);
  const RampedField grown(sea, 5, current);
  const Eigen::Vector3d p(1, 2, -1.5);
  for (const double t : {0.0, 1.7, 4.9, 6.0}) {
    const auto here = grown.at(t + 1e-9, p);  // just past the corner at t = 0
    const double e = 1e-6;
    const Eigen::Vector3d by_t = (grown.at(t + 1e-9 + e, p).velocity - here.velocity) / e;
    EXPECT_LT((here.acceleration - by_t).norm(), 1e-5) << t;  // e/2 of the next derivative, some m/s³
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d d = e * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d by_x = (grown.at(t, p + d).velocity - grown.at(t, p - d).velocity) / (2 * e);
      EXPECT_LT((grown.at(t, p).gradient.col(i) - by_x).norm(), 1e-8) << t;
    }
  }
  EXPECT_EQ(grown.elevation(0, 1, 2), 0);
  EXPECT_NEAR(grown.at(0, p).velocity.x(), current.at(p.z()).x(), 1e-12);
  EXPECT_EQ(grown.elevation(7, 1, 2), sea->elevation(7, 1, 2));
}

}  // namespace
}  // namespace member_test
