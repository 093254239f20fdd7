#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "fit/camera/lens.hpp"
#include "fit/camera/view.hpp"
#include "support/refused.hpp"

namespace camera_view_test {
namespace {

using fit::camera::Lens;
using fit::camera::View;
using support::refused;
using testing::HasSubstr;

/// Huijgen (2024), table 7.2, with the tangential part that it has not.
Lens huijgen() {
  return {.focal = {2543.0, 2547.7},
          .principal = {1572.0, 1013.4},
          .radial = {-0.0494, 0.0301, 0},
          .tangential = {0.001, -0.0005},
          .size = {3024, 2016}};
}

TEST(Lens, IsUndoneByItsInverseOverTheWholePicture) {
  const Lens lens = huijgen();
  for (double x = 0; x < 3024; x += 151)
    for (double y = 0; y < 2016; y += 133) {
      const Eigen::Vector2d pixel(x, y);
      // The inverse is solved to 1e-12 of the focal length.
      EXPECT_LT((pixel_of(lens, ray_of(lens, pixel)) - pixel).norm(), 1e-8) << pixel.transpose();
    }
}

TEST(Lens, DistortsAlongARadiusAsThePolynomialSays) {
  Lens lens = huijgen();
  lens.tangential = {0, 0};
  const Eigen::Vector2d ray(0.3, 0.4);  // radius 0.5
  const double factor = 1 - 0.0494 * 0.25 + 0.0301 * 0.0625;
  EXPECT_LT((distorted(lens, ray) - factor * ray).norm(), 1e-15);
}

TEST(Lens, TangentialPartBendsTheAxesAsBrownHasIt) {
  const Lens lens{.focal = {1, 1}, .principal = {0, 0}, .tangential = {0.01, 0.02}, .size = {1, 1}};
  // On the x axis: 3 p2 x² along it, p1 x² across.
  EXPECT_LT((distorted(lens, {0.5, 0}) - Eigen::Vector2d(0.5 + 3 * 0.02 * 0.25, 0.01 * 0.25)).norm(), 1e-15);
}

TEST(Lens, SlopeIsThatOfTheDistortion) {
  const Lens lens = huijgen();
  const Eigen::Vector2d ray(0.37, -0.21);
  const Eigen::Matrix2d slope = distortion_slope(lens, ray);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d h = 1e-6 * Eigen::Vector2d::Unit(k);
    const Eigen::Vector2d difference = (distorted(lens, ray + h) - distorted(lens, ray - h)) / 2e-6;
    EXPECT_LT((difference - slope.col(k)).norm(), 1e-9);  // h² and rounding over h
  }
}

TEST(Lens, RefusesPixelsBeyondItsFold) {
  Lens lens = huijgen();
  lens.radial = {-1.2, 0, 0};  // r(1 − 1.2 r²) turns back at r = 0.53, the corners are at 0.8
  EXPECT_THAT(refused([&] { check(lens); }), HasSubstr("folds the picture"));
}

TEST(View, ScalesTurnsAndPlacesAPictureWhoseRowsCountDown) {
  const View view{
      .metres_per_pixel = 0.001, .rotation = std::numbers::pi / 6, .pivot = {640, 100}, .pivot_at = {0.5, 1.2}};
  EXPECT_LT((point_of(view, {640, 100}) - Eigen::Vector2d(0.5, 1.2)).norm(), 1e-15);
  // 200 px to the right is turned up by 30 degrees; 200 px down is turned to the right.
  EXPECT_LT((point_of(view, {840, 100}) - Eigen::Vector2d(0.5 + 0.2 * std::cos(std::numbers::pi / 6), 1.3)).norm(),
            1e-12);
  EXPECT_LT((point_of(view, {640, 300}) - Eigen::Vector2d(0.6, 1.2 - 0.2 * std::cos(std::numbers::pi / 6))).norm(),
            1e-12);
}

TEST(View, SeenFromBehindTheAxisPointsToTheLeft) {
  const View view{.metres_per_pixel = 0.001, .leftwards = true};
  EXPECT_LT((point_of(view, {100, 40}) - Eigen::Vector2d(-0.1, -0.04)).norm(), 1e-15);
  EXPECT_LT((pixel_of(view, {-0.1, -0.04}) - Eigen::Vector2d(100, 40)).norm(), 1e-12);
}

TEST(View, TakesATiltedPlaneForWhatItIs) {
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  const Eigen::AngleAxisd turned(R);
  const View view{.lens = huijgen(),
                  .pose = {{.rotation = turned.angle() * turned.axis(), .translation = {-0.1, 0.05, 0.8}}},
                  .metres_per_pixel = 1,
                  .pivot = pixel_of(huijgen(), Eigen::Vector2d(-0.1 / 0.8, 0.05 / 0.8))};  // the board's first corner
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(0.1, -0.05), Eigen::Vector2d(-0.12, 0.2)}) {
    // By hand: up is minus the board's y.
    const Eigen::Vector3d seen = R * Eigen::Vector3d(place.x(), -place.y(), 0) + Eigen::Vector3d(-0.1, 0.05, 0.8);
    const Eigen::Vector2d pixel = pixel_of(huijgen(), Eigen::Vector2d(seen.head<2>() / seen.z()));
    EXPECT_LT((point_of(view, pixel) - place).norm(), 1e-11);
    EXPECT_LT((pixel_of(view, place) - pixel).norm(), 1e-7);
    const Eigen::Matrix2d slope = point_slope(view, pixel);
    EXPECT_LT((point_of(view, pixel + Eigen::Vector2d(0.5, 0.3)) - place - slope * Eigen::Vector2d(0.5, 0.3)).norm(),
              1e-7);  // second order: half a pixel of 2500
  }
}

TEST(View, RefusesAPixelThatLooksPastThePlane) {
  const View view{.lens = huijgen(), .pose = {{.rotation = {0, 1.5, 0}, .translation = {0, 0, 0.8}}}};
  EXPECT_THAT(refused([&] { point_of(view, {3000, 1000}); }), HasSubstr("looks past the plane"));
}

}  // namespace
}  // namespace camera_view_test
