// Poses of a floating body from a film of it in a file; and the solver of poses in space against OpenCV's.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "dynamics/spatial/rotation.hpp"
#include "fit/camera/pose.hpp"
#include "fit/camera/render.hpp"
#include "fit/camera/space.hpp"
#include "fit/camera/track_file.hpp"
#include "froude/film/commands.hpp"
#include "hydro/base/random.hpp"
#include "support/scratch.hpp"

namespace poses_test {
namespace {

namespace fc = fit::camera;
namespace ff = froude::film;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int frames = 80;
constexpr double rate = 25;  // Hz

fc::Filming camera() {
  fc::Filming out;
  out.size = {640, 480};
  out.view.lens = fc::Lens{.focal = {700, 705},
                           .principal = {322, 243},
                           .radial = {-0.12, 0.05, 0},
                           .tangential = {0.001, -0.0005},
                           .size = {640, 480}};
  out.view.pose = fc::PlanePose{{0.05, -0.2, 0.02}, {-0.3, -0.2, 2}};
  out.view.pivot = {320, 260};
  out.disc_radius = 0.018;
  out.sticker_radius = 0.054;
  out.sticker = 60;  // noise on black would be cut off at zero
  out.exposure_s = 0.004;
  out.blur_px = 0.7;
  out.noise = 6;
  return out;
}

struct Pose {
  Vector3d place;
  Vector3d angles;  // roll, pitch, yaw
  Vector3d of(const Vector3d& on_body) const { return place + dynamics::attitude_of(angles) * on_body; }
};

Pose in_space(double t) {
  return {{0.08 * std::sin(2 * t), 0.04 * std::cos(1.5 * t), 0.05 * std::sin(3 * t)},
          {0.12 * std::sin(2.5 * t), 0.1 * std::cos(3 * t), 0.15 * std::sin(t)}};
}
Pose in_plane_of_motion(double t) {
  const Pose all = in_space(t);
  return {{all.place.x(), 0, all.place.z()}, {0, all.angles.y(), 0}};
}

const std::vector<fc::MarkerInSpace> on_body{{"bow", {0.45, 0, 0.1}},
                                             {"stern", {-0.45, 0, 0.1}},
                                             {"port", {-0.15, 0.25, 0.25}},
                                             {"starboard", {0.15, -0.25, 0.1}},
                                             {"mast", {0.1, 0, 0.45}}};

/// The track that `froude track` makes of a film in a file. A disc that faces the camera is seen where its middle is,
/// whatever its distance: each is drawn in the plane of motion where the line of sight to its marker meets it.
fc::Track filmed(const std::string& name, const std::vector<fc::MarkerInSpace>& markers, Pose (*pose)(double)) {
  const fc::Filming filming = camera();
  const fc::Eye eye = eye_of(filming.view, 0, 0);
  const auto places = [&](double t) {
    std::vector<Vector2d> out;
    for (const auto& m : markers) out.push_back(point_of(filming.view, pixel_of(eye, pose(t).of(m.at))));
    return out;
  };
  const auto film = support::scratch_folder() / (name + ".avi"), track = support::scratch_folder() / (name + ".csv");
  {
    ff::FilmWriter writer(film, filming.size, rate);
    for (int i = 0; i < frames; ++i)
      writer.add(exposed(filming, light_of(filming, places, i / rate), static_cast<std::uint64_t>(i)));
  }
  std::string names, first;
  for (const auto& m : markers) {
    const Vector2d at = pixel_of(eye, pose(0).of(m.at));
    names += (names.empty() ? "" : ", ") + m.marker;
    first += fmt::format("{}({:.0f}, {:.0f})", first.empty() ? "" : ", ", at.x(), at.y());
  }
  std::ostringstream out, err;
  froude::track({.film = film, .markers = names, .radius = "4 px .. 10 px", .first = first, .output = track},
                {out, err});
  return fc::read_track(track, {.time = "t"});
}

TEST(FilmedPoses, InSpaceAreThoseOfTheBodyWithinTheirErrors) {
  const fc::Track track = filmed("space", on_body, in_space);
  const auto poses = poses_in_space(track, eye_of(camera().view, 0, 0), on_body, Vector3d::Zero(), 0);
  double squares = 0, stray = 0, farthest = 0;
  int inside = 0;
  ASSERT_EQ(poses.pose.size(), static_cast<std::size_t>(frames));
  for (std::size_t i = 0; i < poses.pose.size(); ++i) {
    ASSERT_TRUE(poses.pose[i]) << i;
    const fc::SpacePose& found = *poses.pose[i];
    const Pose truth = in_space(track.time[i]);
    Eigen::Matrix<double, 6, 1> off;
    off << found.place - truth.place,
        dynamics::rotation_log(found.attitude * dynamics::attitude_of(truth.angles).conjugate());
    squares += off.dot(found.covariance.inverse() * off) / frames;
    stray += found.stray * found.stray / frames;
    farthest = std::max(farthest, off.head<3>().norm());
    for (int k = 0; k < 6; ++k) inside += std::abs(off[k]) < 1.96 * std::sqrt(found.covariance(k, k));
  }
  // χ² of 6, and of 4 over 4, each over 80 frames: deviations of the means 0.39 and 0.08; three of them. Of 480 numbers
  // that belong together in sixes 95 % scatter by 2.4 % at most; two of that.
  EXPECT_NEAR(squares, 6, 1.2);
  EXPECT_NEAR(stray, 1, 0.24);
  EXPECT_NEAR(inside / (6.0 * frames), 0.95, 0.048);
  EXPECT_LT(farthest, 0.002) << "0.03 px of 700 px a radian at 2 m, a few times as much along the line of sight";
}

TEST(FilmedPoses, InThePlaneOfMotionAreThoseOfTheBodyWithinTheirErrors) {
  const std::vector<fc::MarkerInSpace> flat{on_body[0], on_body[1], on_body[4]};
  std::vector<fc::MarkerOnBody> markers;
  for (const auto& m : flat) markers.push_back({m.marker, {m.at.x(), m.at.z()}});
  const fc::Track track = in_plane(filmed("plane", flat, in_plane_of_motion), camera().view, 0);
  const auto motion = planar_motion(smooth(track, {.bandwidth_hz = 4}), markers, true);
  const auto place = [](double t) {
    const Pose p = in_plane_of_motion(t);
    return Vector3d(p.place.x(), p.place.z(), p.angles.y());
  };
  double squares = 0;
  int slow_enough = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const fc::PlanarMotion& now = motion[i];
    constexpr double h = 1e-4;
    const Vector3d off = now.place - place(track.time[i]),
                   rates = now.velocity - (place(track.time[i] + h) - place(track.time[i] - h)) / (2 * h);
    squares += off.dot(now.covariance.topLeftCorner<3, 3>().inverse() * off) / (3 * frames);
    for (int k = 0; k < 3; ++k) slow_enough += std::abs(rates[k]) < 1.96 * std::sqrt(now.covariance(3 + k, 3 + k));
  }
  // Deviations of a smoother count what its band may cut off: squares over them are 5/6 of 1. What is smoothed with
  // half of the gain at 8.6 Hz tells some 55 independent instants of 80: √(2/3/55) = 0.11; three of them. Rates are
  // inside at least as often as 95 %, less 3 %.
  EXPECT_NEAR(squares, 0.83, 0.33);
  EXPECT_GT(slow_enough / (3.0 * frames), 0.92);
}

struct ByOpenCv {
  Eigen::Matrix3d rotation;  // body to camera
  Vector3d translation;      // of the body's origin, camera axes
  Eigen::Matrix3d translation_covariance;
};

/// By OpenCV's solvePnP and its Levenberg–Marquardt, with the covariance of its own slopes.
ByOpenCv by_opencv(const fc::Lens& lens, const std::vector<Vector2d>& pixels, double sd) {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (const auto& m : on_body) object.emplace_back(m.at.x(), m.at.y(), m.at.z());
  for (const Vector2d& p : pixels) image.emplace_back(p.x(), p.y());
  const cv::Matx33d matrix(lens.focal.x(), 0, lens.principal.x(), 0, lens.focal.y(), lens.principal.y(), 0, 0, 1);
  const cv::Vec<double, 5> distortion(lens.radial[0], lens.radial[1], lens.tangential[0], lens.tangential[1],
                                      lens.radial[2]);
  cv::Vec3d turn, shift;
  cv::solvePnP(object, image, matrix, distortion, turn, shift, false, cv::SOLVEPNP_SQPNP);
  cv::solvePnPRefineLM(object, image, matrix, distortion, turn, shift,
                       {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 200, 1e-14});
  cv::Matx33d rotation;
  cv::Rodrigues(turn, rotation);
  std::vector<cv::Point2d> shown;
  cv::Mat slopes;
  cv::projectPoints(object, turn, shift, matrix, distortion, shown, slopes);
  const cv::Mat by_pose = slopes.colRange(0, 6), inverse = (by_pose.t() * by_pose).inv();  // turn, then translation
  ByOpenCv out;
  for (int i = 0; i < 3; ++i) {
    out.translation[i] = shift[i];
    for (int j = 0; j < 3; ++j) {
      out.rotation(i, j) = rotation(i, j);
      out.translation_covariance(i, j) = sd * sd * inverse.at<double>(3 + i, 3 + j);
    }
  }
  return out;
}

TEST(PosesInSpace, AreThoseOfOpenCvAndSoAreTheirErrors) {
  const fc::Eye eye = eye_of(camera().view, 0, 0);
  constexpr double sd = 0.5;  // px
  const hydro::RandomStream random(7, 71);
  fc::Track track{.time = {}, .markers = {}, .in_metres = false, .size = camera().size};
  for (const auto& m : on_body) track.markers.push_back({m.marker, {}});
  std::vector<std::vector<Vector2d>> pixels;
  std::uint64_t n = 0;
  for (int i = 0; i < 200; ++i) {
    track.time.push_back(i / rate);
    pixels.emplace_back();
    for (std::size_t m = 0; m < on_body.size(); ++m, n += 2) {
      pixels.back().push_back(pixel_of(eye, in_space(i / rate).of(on_body[m].at)) +
                              sd * Vector2d(random.normal(n), random.normal(n + 1)));
      track.markers[m].seen.push_back(fc::Sighting{pixels.back().back()});
    }
  }
  const auto poses = poses_in_space(track, eye, on_body, Vector3d::Zero(), sd);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    ASSERT_TRUE(poses.pose[i]) << i;
    const fc::SpacePose& ours = *poses.pose[i];
    const ByOpenCv theirs = by_opencv(eye.lens, pixels[i], sd);
    const Eigen::Quaterniond turned(theirs.rotation.transpose() * eye.rotation * ours.attitude.toRotationMatrix());
    Eigen::Matrix<double, 6, 1> off;
    off << eye.rotation.transpose() * (theirs.translation - eye.translation) - ours.place,
        ours.attitude * dynamics::rotation_log(turned);
    // Both are the least of the same sum of squares: they differ by where their searches end, a thousandth of an error.
    EXPECT_LT(off.dot(ours.covariance.inverse() * off), 1e-6) << i;
    const Eigen::Matrix3d errors = eye.rotation * ours.covariance.topLeftCorner<3, 3>() * eye.rotation.transpose();
    EXPECT_LT((errors - theirs.translation_covariance).norm(), 1e-4 * errors.norm()) << i;
  }
}

}  // namespace
}  // namespace poses_test
