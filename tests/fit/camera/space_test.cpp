#include "fit/camera/space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "dynamics/spatial/rotation.hpp"
#include "fit/camera/meeting.hpp"
#include "hydro/base/random.hpp"
#include "support/refused.hpp"

namespace camera_space_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using fit::camera::Eye;
using fit::camera::joined;
using fit::camera::Lens;
using fit::camera::MarkerInSpace;
using fit::camera::Sighting;
using fit::camera::Track;
using fit::camera::View;
using support::refused;
using testing::HasSubstr;

const Lens lens{.focal = {1200, 1210},
                .principal = {640, 360},
                .radial = {-0.1, 0.03, 0},
                .tangential = {0.001, -0.0005},
                .size = {1280, 720}};

View view_of_board(bool leftwards) {
  return {.lens = lens,
          .pose = fit::camera::PlanePose{{0.05, -0.3, 0.02}, {-0.2, -0.1, 3}},
          .leftwards = leftwards,
          .rotation = 0.1,
          .pivot = {600, 300},
          .pivot_at = {0.4, 1.1}};
}

TEST(Eye, ShowsPointsOfThePlaneOfMotionWhereTheViewDoes) {
  for (const bool leftwards : {false, true})
    for (const int along : {0, 1}) {
      const View view = view_of_board(leftwards);
      const Eye eye = eye_of(view, along, 0.7);
      // Right-handed, and without scale: a mirrored scene would be seen, too, in the plane.
      EXPECT_NEAR(eye.rotation.determinant(), 1, 1e-14);
      EXPECT_LT((eye.rotation.transpose() * eye.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-14);
      for (const Vector2d& q : {Vector2d(0.4, 1.1), Vector2d(0.1, 0.8), Vector2d(0.6, 1.3)}) {
        Vector3d point(0.7, 0.7, q.y());
        point[along] = q.x();
        EXPECT_LT((pixel_of(eye, point) - pixel_of(view, q)).norm(), 1e-8)
            << leftwards << along;  // of ray_of(): 1e-12 f
      }
    }
}

TEST(Eye, LooksAlongTheAxisThatPointsAwayFromIt) {
  View view = view_of_board(false);
  view.pose->rotation.setZero();
  view.rotation = 0;
  // Seen from starboard, x to the right and z up: y points away.
  EXPECT_LT((eye_of(view, 0, 0).rotation * Vector3d::UnitY() - Vector3d::UnitZ()).norm(), 1e-14);
  // y to the right: x points to the camera.
  EXPECT_LT((eye_of(view, 1, 0).rotation * Vector3d::UnitX() + Vector3d::UnitZ()).norm(), 1e-14);
}

TEST(Eye, SlopesAreThoseOfPixels) {
  const Eye eye = eye_of(view_of_board(false), 0, 0);
  const Vector3d point(0.5, 0.3, 1.2);
  const auto slope = pixel_slope(eye, point);
  for (int k = 0; k < 3; ++k) {
    const Vector3d h = 1e-5 * Vector3d::Unit(k);
    // h² of third derivatives, some hundred pixels a cubic metre, and rounding over h.
    EXPECT_LT(((pixel_of(eye, point + h) - pixel_of(eye, point - h)) / 2e-5 - slope.col(k)).norm(), 1e-6);
  }
}

TEST(Eye, WithoutABoardIsRefused) {
  EXPECT_THAT(refused([] { fit::camera::eye_of({.metres_per_pixel = 1e-3}, 0, 0); }), HasSubstr("--plane"));
}

const std::vector<MarkerInSpace> on_body{
    {"bow", {0.5, 0, 0.1}}, {"stern", {-0.5, 0, 0.1}}, {"port", {0, 0.2, 0.1}}, {"mast", {0.1, 0, 0.45}}};

struct Truth {
  Vector3d place;
  Eigen::Quaterniond attitude;
};
Truth at_time(double t) {
  return {{0.4 + 0.1 * std::sin(t), 0.05 * std::cos(2 * t), 1.0 + 0.05 * std::sin(3 * t)},
          dynamics::attitude_of({0.2 * std::sin(2 * t), 0.15 * std::cos(3 * t), 0.3 + 0.1 * std::sin(t)})};
}

Track filmed(const Eye& eye, const std::vector<MarkerInSpace>& markers, int frames, double sd, std::uint64_t seed) {
  const hydro::RandomStream random(seed, 33);
  std::uint64_t n = 0;
  Track out;
  out.size = lens.size;
  for (const auto& m : markers) out.markers.push_back({m.marker, {}});
  for (int i = 0; i < frames; ++i) {
    out.time.push_back(0.02 * i);
    const Truth now = at_time(out.time.back());
    for (std::size_t m = 0; m < markers.size(); ++m) {
      const Vector2d error(random.normal(n), random.normal(n + 1));
      n += 2;
      out.markers[m].seen.push_back(Sighting{pixel_of(eye, now.place + now.attitude * markers[m].at) + sd * error});
    }
  }
  return out;
}

Eigen::VectorXd missed(const fit::camera::SpacePose& pose, const Truth& truth) {
  Eigen::VectorXd out(6);
  out << pose.place - truth.place, dynamics::rotation_log(pose.attitude * truth.attitude.conjugate());
  return out;
}

TEST(PosesInSpace, AreThoseOfTheBody) {
  const Eye eye = eye_of(view_of_board(false), 0, 0);
  const auto poses = poses_in_space(filmed(eye, on_body, 100, 0, 1), eye, on_body, {0.4, 0, 1}, 0.3);
  for (std::size_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(poses.pose[i]) << i;
    // Settled to 1e-6 of a deviation, which is below a centimetre; the next of Newton's steps is its square.
    EXPECT_LT(missed(*poses.pose[i], at_time(0.02 * static_cast<double>(i))).norm(), 1e-8) << i;
  }
}

TEST(PosesInSpace, AreNotToldWherePixelsFitNone) {
  const Eye eye = eye_of(view_of_board(false), 0, 0);
  const double sd = 0.3;
  Track track = filmed(eye, on_body, 100, sd, 6);
  // One in a hundred clean films has such a frame; this one has none.
  EXPECT_EQ(poses_in_space(track, eye, on_body, {0.4, 0, 1}, sd).misfits.size(), 0U);
  std::swap(track.markers[0].seen[40], track.markers[2].seen[40]);
  track.markers[3].seen[70]->at.x() += 20;
  const auto poses = poses_in_space(track, eye, on_body, {0.4, 0, 1}, sd);
  EXPECT_THAT(poses.misfits, testing::ElementsAre(40, 70));
  EXPECT_EQ(poses.lost, 2);
  for (const std::size_t i : {40U, 70U}) {
    EXPECT_FALSE(poses.pose[i]) << i;
    EXPECT_GT(poses.stray[i], 4) << i;  // of two numbers left over, sqrt(2 ln 1e4 / 2) is 3.0
  }
  EXPECT_TRUE(poses.pose[41]);
  EXPECT_TRUE(poses.pose[71]);
}

TEST(PosesInSpace, KnowTheirErrors) {
  const Eye eye = eye_of(view_of_board(false), 0, 0);
  const double sd = 0.3;
  const auto poses = poses_in_space(filmed(eye, on_body, 600, sd, 2), eye, on_body, {0.4, 0, 1}, sd);
  double squares = 0, stray = 0;
  int of = 0, inside = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    if (!poses.pose[i]) continue;
    const Eigen::VectorXd off = missed(*poses.pose[i], at_time(0.02 * static_cast<double>(i)));
    squares += off.dot(poses.pose[i]->covariance.inverse() * off);
    for (int k = 0; k < 6; ++k) inside += std::abs(off[k]) < 1.96 * std::sqrt(poses.pose[i]->covariance(k, k));
    stray += poses.pose[i]->stray * poses.pose[i]->stray;
    ++of;
  }
  ASSERT_GT(of, 590);
  // χ² of 6: its mean over 600 scatters by √12/√600 = 0.14; three of them. 95 % of 3600 that belong together in sixes:
  // 0.9 % at most; three. The stray's square is χ² of 2 over 2, scatter 1/√600.
  EXPECT_NEAR(squares / of, 6, 0.43);
  EXPECT_NEAR(static_cast<double>(inside) / (6 * of), 0.95, 0.027);
  EXPECT_NEAR(stray / of, 1, 0.13);
}

TEST(PosesInSpace, OfFlatMarkersFromAfarAreToldToBeAmbiguousNotWrong) {
  View view = view_of_board(false);
  view.pose->translation = {-0.2, -0.1, 20};
  const Eye eye = eye_of(view, 0, 0);
  const std::vector<MarkerInSpace> flat{
      {"a", {0.3, 0.02, 0.3}}, {"b", {-0.3, 0.02, 0.3}}, {"c", {0.3, 0.02, -0.3}}, {"d", {-0.3, 0.02, -0.3}}};
  const double sd = 0.3;
  const auto poses = poses_in_space(filmed(eye, flat, 300, sd, 3), eye, flat, {0.4, 0, 1}, sd);
  EXPECT_GT(poses.ambiguous, 100);
  int wrong = 0, told = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    if (!poses.pose[i]) continue;
    const Eigen::VectorXd off = missed(*poses.pose[i], at_time(0.02 * static_cast<double>(i)));
    wrong += off.dot(poses.pose[i]->covariance.inverse() * off) > 40;  // χ² of 6 exceeds it once in two million
    ++told;
  }
  EXPECT_LE(wrong, told / 20) << told;
}

TEST(PosesInSpace, LeaveGapsWhereMarkersAreHidden) {
  const Eye eye = eye_of(view_of_board(false), 0, 0);
  Track track = filmed(eye, on_body, 10, 0, 1);
  track.markers[2].seen[4].reset();
  const auto poses = poses_in_space(track, eye, on_body, {0.4, 0, 1}, 0.3);
  EXPECT_EQ(poses.too_few, 1);
  EXPECT_FALSE(poses.pose[4]);
  EXPECT_TRUE(poses.pose[5]);
}

TEST(PosesInSpace, RefuseWhatTellsNone) {
  const Eye eye = eye_of(view_of_board(false), 0, 0);
  Track track = filmed(eye, on_body, 10, 0, 1);
  const Vector3d place(0.4, 0, 1);
  EXPECT_THAT(refused([&] {
                poses_in_space(track, eye, {on_body[0], on_body[1], on_body[2]}, place, 0.3);
              }),
              HasSubstr("four markers"));
  const std::vector<MarkerInSpace> line{
      {"bow", {0, 0, 0}}, {"stern", {1, 0, 0}}, {"port", {2, 0, 0}}, {"mast", {3, 0, 0}}};
  EXPECT_THAT(refused([&] { poses_in_space(track, eye, line, place, 0.3); }), HasSubstr("on one line"));
  EXPECT_THAT(refused([&] { poses_in_space(track, eye, on_body, place, 0); }), HasSubstr("no errors"));
  track.size = {640, 360};
  EXPECT_THAT(refused([&] { poses_in_space(track, eye, on_body, place, 0.3); }), HasSubstr("calibrated with"));
}

/// Two cameras side by side, which look along +y.
Eye beside(double x) {
  Eye out{{.focal = {1000, 1000}, .principal = {640, 360}, .size = {1280, 720}}, {}, {}};
  out.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  out.translation = -out.rotation * Vector3d(x, 0, 0);
  return out;
}

Sighting seen_by(const Eye& eye, const Vector3d& point, double sd) {
  return {pixel_of(eye, point), sd * sd * Matrix2d::Identity()};
}

TEST(Triangulated, HasTheDepthErrorOfAStereoPair) {
  const double base = 0.4, depth = 3, sd = 0.2;
  const Eye left = beside(-base / 2), right = beside(base / 2);
  const auto p = triangulated(left, seen_by(left, {0, depth, 0}, sd), right, seen_by(right, {0, depth, 0}, sd));
  ASSERT_TRUE(p);
  EXPECT_LT((p->at - Vector3d(0, depth, 0)).norm(), 1e-9);
  // σ_z = z²/(f b) σ of the disparity, which is that of two pixels; across, of the mean of both: z/f σ/√2.
  EXPECT_NEAR(std::sqrt(p->covariance(1, 1)) / (depth * depth / (1000 * base) * std::sqrt(2) * sd), 1, 1e-9);
  EXPECT_NEAR(std::sqrt(p->covariance(2, 2)) / (depth / 1000 * sd / std::sqrt(2)), 1, 1e-9);
}

TEST(Triangulated, KnowsItsErrors) {
  const double sd = 0.4;
  const Eye left = eye_of(view_of_board(false), 0, 0);
  View turned = view_of_board(false);
  turned.pose->rotation = {0.1, 0.5, 0};
  turned.pose->translation = {0.3, -0.2, 2.5};
  const Eye right = eye_of(turned, 0, 0);
  const hydro::RandomStream random(4, 34);
  double squares = 0, stray = 0;
  constexpr int of = 1000;
  for (std::uint64_t i = 0; i < of; ++i) {
    const Vector3d truth(0.4 + 0.1 * random.normal(7 * i), 0.2 * random.normal(7 * i + 1),
                         1 + 0.1 * random.normal(7 * i + 2));
    Sighting a = seen_by(left, truth, sd), b = seen_by(right, truth, sd);
    a.at += sd * Vector2d(random.normal(7 * i + 3), random.normal(7 * i + 4));
    b.at += sd * Vector2d(random.normal(7 * i + 5), random.normal(7 * i + 6));
    const auto p = triangulated(left, a, right, b);
    ASSERT_TRUE(p);
    const Vector3d off = p->at - truth;
    squares += off.dot(p->covariance.inverse() * off) / of;
    stray += p->stray * p->stray / of;
  }
  EXPECT_NEAR(squares, 3, 3 * std::sqrt(6.0 / of));  // χ² of 3
  EXPECT_NEAR(stray, 1, 3 * std::sqrt(2.0 / of));    // and of the one number that is left over
}

TEST(Triangulated, OfRaysThatPartIsNothing) {
  const Eye left = beside(-0.2), right = beside(0.2);
  const Sighting far{{740, 360}, Matrix2d::Identity()}, near{{540, 360}, Matrix2d::Identity()};
  EXPECT_TRUE(triangulated(left, far, right, near));
  EXPECT_FALSE(triangulated(left, near, right, far));
}

Vector3d way(double t) { return {0.3 * std::sin(2 * t), 3 + 0.2 * std::cos(3 * t), 0.1 * std::sin(5 * t)}; }

Track by_eye(const Eye& eye, double from, int frames, double every, double uneven) {
  Track out;
  out.size = eye.lens.size;
  out.markers.push_back({"bob", {}});
  for (int i = 0; i < frames; ++i) {
    out.time.push_back(from + every * i + uneven * std::sin(2.7 * i));
    out.markers[0].seen.push_back(Sighting{pixel_of(eye, way(out.time.back()))});
  }
  return out;
}

TEST(Joined, TakesUnevenFramesOfTwoCamerasThatAreNotInStep) {
  const Eye left = beside(-0.3), right = beside(0.3);
  const Track first = by_eye(left, 0, 100, 0.02, 0.002);
  Track second = by_eye(right, 0.031, 90, 0.019, 0.003);
  second.markers[0].seen[40].reset();
  const auto out = joined({first, left, 0.2}, {second, right, 0.2});
  int points = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    if (!out.point[0][i]) continue;
    ++points;
    // The cubic misses 3/128 h⁴ of the fourth derivative, 5⁴ · 0.1 m here: 0.2 µm across, and z/b of it, fivefold,
    // along the cameras' axes; frames a seventh further apart make it twice that.
    EXPECT_LT((out.point[0][i]->at - way(first.time[i])).norm(), 3e-6) << i;
    EXPECT_LT(out.point[0][i]->stray, 0.01);
  }
  EXPECT_EQ(points, out.points);
  // The second camera sees from its second frame to the one before its last: 0.05 s to 1.70 s; four frames about the
  // one that is missing are left out.
  EXPECT_NEAR(points, 83 - 4, 2);
}

TEST(Joined, KnowsWhatItMissesBetweenFramesThatAreFarApart) {
  const Eye left = beside(-0.3), right = beside(0.3);
  // A fifth of a second between frames of a motion of up to 5 rad/s: the cubic misses 3/128 of it, 2 mm or 1 px.
  const auto out = joined({by_eye(left, 0, 200, 0.02, 0), left, 0.2}, {by_eye(right, 0, 20, 0.2, 0), right, 0.2});
  double squares = 0;
  int points = 0;
  for (std::size_t i = 0; i < out.time.size(); ++i) {
    if (!out.point[0][i]) continue;
    const Vector3d off = out.point[0][i]->at - way(out.time[i]);
    squares += off.dot(out.point[0][i]->covariance.inverse() * off) / 3;
    ++points;
  }
  EXPECT_NEAR(out.spacing, 0.2, 1e-12);
  ASSERT_GT(points, 150);
  // Without noise it is below 1; without the error of the cubic it is tens: 1 px over 0.2 px, squared.
  EXPECT_LT(squares / points, 1);
}

TEST(Joined, OfAClockThatIsLateStrays) {
  const Eye left = beside(-0.3), right = beside(0.3);
  Track late = by_eye(right, 0, 100, 0.02, 0);
  for (double& t : late.time) t += 0.02;
  double stray = 0;
  const auto out = joined({by_eye(left, 0, 100, 0.02, 0), left, 0.2}, {late, right, 0.2});
  for (const auto& p : out.point[0])
    if (p) stray = std::max(stray, p->stray);
  EXPECT_GT(stray, 10);  // 0.02 s of 0.5 m/s upwards are 3 px, between two of 0.2 px
}

Track noisy(Track track, double deviation, std::uint64_t stream) {
  const hydro::RandomStream random(stream, 8);
  std::uint64_t n = 0;
  for (auto& marker : track.markers)
    for (auto& s : marker.seen) {
      const Vector2d error(random.normal(n), random.normal(n + 1));
      n += 2;
      s->at += deviation * error;
    }
  return track;
}

TEST(Meeting, LeavesOutWhatPassesByMoreThanErrorsAllow) {
  const Eye left = beside(-0.3), right = beside(0.3);
  const Track first = noisy(by_eye(left, 0, 200, 0.02, 0), 0.2, 1);
  Track second = noisy(by_eye(right, 0, 200, 0.02, 0), 0.2, 2);
  auto clean = joined({first, left, 0.2}, {second, right, 0.2});
  EXPECT_TRUE(fit::camera::leave_out_apart(clean).empty());
  EXPECT_EQ(fit::camera::widening_of(clean), 1);
  EXPECT_FALSE(fit::camera::clock_of_second({first, left, 0.2}, {second, right, 0.2}));
  for (std::size_t i = 100; i < 106; ++i) second.markers[0].seen[i]->at.y() += 20;  // another marker's place
  auto wrong = joined({first, left, 0.2}, {second, right, 0.2});
  const auto apart = fit::camera::leave_out_apart(wrong);
  ASSERT_EQ(apart.size(), 6u);
  EXPECT_EQ(apart.front(), std::pair(std::size_t{0}, std::size_t{100}));
  EXPECT_FALSE(wrong.point[0][103]);
  EXPECT_EQ(fit::camera::widening_of(wrong), 1);
}

TEST(Meeting, KnowsNoiseThatIsLargerThanStated) {
  const Eye left = beside(-0.3), right = beside(0.3);
  const auto track = joined({noisy(by_eye(left, 0, 400, 0.02, 0), 0.3, 1), left, 0.2},
                            {noisy(by_eye(right, 0, 400, 0.02, 0), 0.3, 2), right, 0.2});
  EXPECT_NEAR(fit::camera::widening_of(track), 1.5, 0.15);  // of some 400 numbers: a deviation of 0.05
}

TEST(Meeting, FindsTheClockThatIsLate) {
  const Eye left = beside(-0.3), right = beside(0.3);
  for (const double late : {0.03, -0.11}) {
    Track second = noisy(by_eye(right, 0, 200, 0.02, 0), 0.2, 2);
    for (double& t : second.time) t += late;
    const auto found =
        fit::camera::clock_of_second({noisy(by_eye(left, 0, 200, 0.02, 0), 0.2, 1), left, 0.2}, {second, right, 0.2});
    ASSERT_TRUE(found) << late;
    EXPECT_NEAR(*found, -late, 0.001);  // 0.2 px of 200 places against 500 px/s: a deviation of 0.04 ms
  }
}

TEST(PosesInSpace, KnowNoiseThatIsLargerThanStated) {
  const Eye eye = eye_of(view_of_board(false), 0, 0);
  const auto widened = [&](double noise) {
    return fit::camera::widening_of(
        poses_in_space(filmed(eye, on_body, 200, noise, 4), eye, on_body, {0.4, 0, 1}, 0.3));
  };
  EXPECT_EQ(widened(0.3), 1);
  // Frames beyond the gate (V33) are left out, which takes little of noise that is 1.3 times as large.
  EXPECT_NEAR(widened(0.39), 1.3, 0.1);
}

TEST(Joined, RefusesTracksWithNothingInCommon) {
  const Eye left = beside(-0.3), right = beside(0.3);
  Track other = by_eye(right, 10, 50, 0.02, 0);
  EXPECT_THAT(refused([&] {
                joined({by_eye(left, 0, 50, 0.02, 0), left, 0.2}, {other, right, 0.2});
              }),
              HasSubstr("no time"));
  other.markers[0].name = "tip";
  EXPECT_THAT(refused([&] {
                joined({by_eye(left, 10, 50, 0.02, 0), left, 0.2}, {other, right, 0.2});
              }),
              HasSubstr("no marker"));
}

}  // namespace
}  // namespace camera_space_test
