#include "fit/camera/pose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/random.hpp"
#include "support/refused.hpp"

namespace camera_pose_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using fit::camera::MarkerOnBody;
using fit::camera::PlanarMotion;
using fit::camera::SmoothTrack;
using fit::camera::Track;
using support::refused;
using testing::HasSubstr;

constexpr double step = 0.01, sd = 5e-4;  // s, m

/// Along, up and angle of a body that swings and drifts, with rates; the angle passes half a turn.
void truth(double t, Vector3d& place, Vector3d& velocity, Vector3d& acceleration) {
  const double w = 4;
  place = {0.2 * std::sin(w * t), 0.1 * std::cos(w * t), 3 + 0.5 * std::sin(w * t)};
  velocity = {0.2 * w * std::cos(w * t), -0.1 * w * std::sin(w * t), 0.5 * w * std::cos(w * t)};
  acceleration = {-0.2 * w * w * std::sin(w * t), -0.1 * w * w * std::cos(w * t), -0.5 * w * w * std::sin(w * t)};
}

const std::vector<MarkerOnBody> markers{{"a", {0.3, 0.1}}, {"b", {-0.2, 0.05}}, {"c", {0.1, -0.3}}};

/// A point of the body where its angle turns it down from the axis, as pitch does, or up.
Vector2d shown(const MarkerOnBody& m, double t, bool downwards) {
  Vector3d place, velocity, acceleration;
  truth(t, place, velocity, acceleration);
  const double c = std::cos(place[2]), s = (downwards ? -1 : 1) * std::sin(place[2]);
  return place.head<2>() + Vector2d(c * m.at.x() - s * m.at.y(), s * m.at.x() + c * m.at.y());
}

SmoothTrack filmed(int frames, double noise, std::uint64_t seed, bool downwards) {
  const hydro::RandomStream random(seed, 32);
  Track out;
  out.in_metres = true;
  std::uint64_t n = 0;
  for (const MarkerOnBody& m : markers) out.markers.push_back({m.marker, {}});
  for (int k = 0; k < frames; ++k) {
    out.time.push_back(step * k);
    for (std::size_t m = 0; m < markers.size(); ++m) {
      const Vector2d error(random.normal(n), random.normal(n + 1));
      n += 2;
      out.markers[m].seen.push_back(fit::camera::Sighting{shown(markers[m], out.time.back(), downwards) + noise * error,
                                                          sd * sd * Eigen::Matrix2d::Identity()});
    }
  }
  return fit::camera::smooth(out, {.bandwidth_hz = 4});
}

TEST(PlanarMotion, IsThatOfTheBodyWithRatesAndContinuousAngles) {
  for (const bool downwards : {false, true}) {
    const auto motion = planar_motion(filmed(401, 0, 1, downwards), markers, downwards);
    for (std::size_t i = 100; i < 301; ++i) {
      Vector3d place, velocity, acceleration;
      truth(step * static_cast<double>(i), place, velocity, acceleration);
      if (i == 100) {
        EXPECT_NEAR(std::remainder(motion[i].place[2] - place[2], 2 * std::numbers::pi), 0, 1e-4);
      }
      place[2] += motion[100].place[2] - [] {
        Vector3d p, v, a;
        truth(1, p, v, a);
        return p[2];
      }();
      // The band of the smoother, 0.64 Hz of motion with harmonics below 4 Hz: gain within 1e-5 of the first, 1e-3 of
      // the fourth.
      EXPECT_LT((motion[i].place - place).cwiseAbs().maxCoeff(), 1e-3) << i << " " << downwards;
      EXPECT_LT((motion[i].velocity - velocity).cwiseAbs().maxCoeff(), 1e-2) << i << " " << downwards;
      EXPECT_LT((motion[i].acceleration - acceleration).cwiseAbs().maxCoeff(), 0.2) << i << " " << downwards;
    }
  }
}

TEST(PlanarMotion, KnowsItsErrors) {
  int inside_place = 0, inside_angle = 0, of = 0;
  double stray = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto motion = planar_motion(filmed(61, sd, seed, true), markers, true);
    const PlanarMotion& now = motion[30];
    Vector3d place, velocity, acceleration;
    truth(0.3, place, velocity, acceleration);
    for (int k = 0; k < 2; ++k)
      inside_place += std::abs(now.place[k] - place[k]) < 1.96 * std::sqrt(now.covariance(k, k));
    inside_angle += std::abs(std::remainder(now.place[2] - place[2], 2 * std::numbers::pi)) <
                    1.96 * std::sqrt(now.covariance(2, 2));
    stray += now.stray * now.stray;
    ++of;
  }
  // 95 % and more, since deviations of a smoother count what its band may cut off: √(6/5) of noise makes 96.8 %. Of 200
  // and 400 that is 1.2 % and 0.9 % of scatter; three of them.
  EXPECT_NEAR(static_cast<double>(inside_place) / (2 * of), 0.968, 0.03);
  EXPECT_NEAR(static_cast<double>(inside_angle) / of, 0.968, 0.04);
  EXPECT_LT(std::sqrt(stray / of), 1.1);
}

TEST(PlanarMotion, HasTheDeviationsOfRigidLeastSquares) {
  const SmoothTrack track = filmed(61, 0, 1, false);
  const auto motion = planar_motion(track, markers, false);
  // Far from the ends all markers have one deviation s of a place, whose errors are independent: the mean of places
  // s/√3, the angle s over the root of the sum of squares about it. Velocities and accelerations tell places nothing
  // but for what errors have in common with them (acceleration, −ω_c² times a share): the whole is below.
  const double s = track.marker(0, 30).place_sd.x();
  Vector2d mean = Vector2d::Zero();
  for (const auto& m : markers) mean += m.at / 3;
  double about = 0;
  for (const auto& m : markers) about += (m.at - mean).squaredNorm();
  const double angle = std::sqrt(motion[30].covariance(2, 2));
  EXPECT_LT(angle, 1.001 * s / std::sqrt(about));
  EXPECT_GT(angle, 0.8 * s / std::sqrt(about));
}

TEST(PlanarMotion, OfMarkersThatAreNotWhereTheySitIsSeen) {
  auto wrong = markers;
  wrong[0].at.x() += 20 * sd;
  double stray = 0;
  for (const auto& now : planar_motion(filmed(61, sd, 1, false), wrong, false)) stray += now.stray * now.stray / 61;
  EXPECT_GT(std::sqrt(stray), 3);
}

TEST(PlanarMotion, RefusesWhatTellsNoPose) {
  const SmoothTrack track = filmed(11, 0, 1, false);
  EXPECT_THAT(refused([&] { planar_motion(track, {markers[0]}, false); }), HasSubstr("two markers"));
  EXPECT_THAT(refused([&] { planar_motion(track, {markers[0], {"d", {0, 0}}}, false); }), HasSubstr("no marker \"d\""));
  EXPECT_THAT(refused([&] {
                planar_motion(track, {markers[0], {"b", markers[0].at}}, false);
              }),
              HasSubstr("at one place"));
}

}  // namespace
}  // namespace camera_pose_test
