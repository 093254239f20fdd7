#include "fit/camera/shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "hydro/base/random.hpp"

namespace camera_shapes_test {
namespace {

using fit::camera::Picture;

/// Grey levels from light, each the mean over its pixel, with noise.
template <class Shade>
Picture picture_of(Shade shade, double noise, std::uint64_t seed) {
  const hydro::RandomStream random(seed, 61);
  constexpr int across = 8;
  const auto level_of = [&](const Eigen::Vector2d& pixel) {
    const auto at = [&](double right, double down) { return shade(pixel + Eigen::Vector2d(right, down)); };
    const double middle = at(0, 0);
    if (at(-0.5, -0.5) == middle && at(0.5, -0.5) == middle && at(0.5, 0.5) == middle && at(-0.5, 0.5) == middle)
      return middle;  // no edge goes through it
    double sum = 0;
    for (int a = 0; a < across; ++a)
      for (int b = 0; b < across; ++b) sum += at((a + 0.5) / across - 0.5, (b + 0.5) / across - 0.5);
    return sum / (across * across);
  };
  Picture out(120, 100);
  std::uint64_t i = 0;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const double level = level_of(Eigen::Vector2d(x, y)) + noise * random.normal(i++);
      out.row(y)[x] = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  return out;
}

/// A dark square of 8 cells with white ones within, on a light ground, as a camera sees it that looks along a slant.
struct SlantedTag {
  Eigen::Matrix3d to_picture, to_tag;  // the tag goes from -1 to 1
  SlantedTag(const Eigen::Vector2d& centre, double half, double turn) {
    to_picture << half * std::cos(turn), -half * std::sin(turn), centre.x(), half * std::sin(turn),
        0.9 * half * std::cos(turn), centre.y(), 0, 0, 1;
    Eigen::Matrix3d slant = Eigen::Matrix3d::Identity();
    slant(2, 0) = 0.12;  // a perspective in which the mean of the corners is no middle
    to_picture = to_picture * slant;
    to_tag = to_picture.inverse();
  }
  Eigen::Vector2d at(double u, double v) const { return (to_picture * Eigen::Vector3d(u, v, 1)).hnormalized(); }
  double operator()(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d p = (to_tag * Eigen::Vector3d(pixel.x(), pixel.y(), 1)).hnormalized();
    if (p.cwiseAbs().maxCoeff() > 1) return 200;
    if (p.cwiseAbs().maxCoeff() > 0.75) return 30;
    const int cell = static_cast<int>(std::floor((p.x() + 1) * 4)) + static_cast<int>(std::floor((p.y() + 1) * 4));
    return cell % 3 == 0 ? 200 : 30;
  }
};

TEST(Squares, MiddleIsWhereDiagonalsCrossAndKnowsItsErrors) {
  double squares = 0, weighed = 0, of_corners = 0;
  constexpr int trials = 60;
  for (std::uint64_t k = 0; k < trials; ++k) {
    const hydro::RandomStream random(k, 5);
    const SlantedTag tag({60 + random.uniform(0), 50 + random.uniform(1)}, 24, random.uniform(2) - 0.5);
    const Picture picture = picture_of(tag, 6, k);
    std::array<Eigen::Vector2d, 4> corners{tag.at(-1, -1), tag.at(1, -1), tag.at(1, 1), tag.at(-1, 1)};
    const Eigen::Vector2d mean = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    for (std::size_t c = 0; c < 4; ++c)
      corners[c] +=
          0.8 * Eigen::Vector2d(random.normal(10 + 2 * c), random.normal(11 + 2 * c)).cwiseMax(-1.5).cwiseMin(1.5);
    const auto found = middle_of_square(picture, corners);
    ASSERT_TRUE(found) << k;
    const Eigen::Vector2d e = found->at - tag.at(0, 0);
    squares += e.squaredNorm() / trials;
    weighed += e.dot(found->covariance.inverse() * e) / 2 / trials;
    of_corners += (mean - tag.at(0, 0)).squaredNorm() / trials;
  }
  EXPECT_LT(std::sqrt(squares), 0.1) << "asked of clean films, and these are not";
  EXPECT_GT(std::sqrt(of_corners), 1) << "or the perspective would not be seen";
  // 120 squares have a deviation of 0.13; bilinear samples half a pixel apart share noise.
  EXPECT_GT(weighed, 0.6);
  EXPECT_LT(weighed, 1.8);
}

TEST(Squares, WithoutAnEdgeAreNone) {
  const auto grey = picture_of([](const Eigen::Vector2d&) { return 128.0; }, 5, 1);
  EXPECT_FALSE(middle_of_square(grey, {{{30, 30}, {70, 30}, {70, 70}, {30, 70}}}));
  const SlantedTag tag({3, 50}, 24, 0);
  EXPECT_FALSE(middle_of_square(picture_of(tag, 0, 1), {tag.at(-1, -1), tag.at(1, -1), tag.at(1, 1), tag.at(-1, 1)}));
}

/// A ring with a quadrant, whose middle no disc tells.
double ring(const Eigen::Vector2d& from_middle) {
  const double r = from_middle.norm();
  if (r > 7 || (r < 3.5 && from_middle.x() * from_middle.y() < 0)) return 60;
  return 190;
}

TEST(Patterns, MiddleIsFoundWhateverTheLightAndKnowsItsErrors) {
  const Picture whole = picture_of([](const Eigen::Vector2d& p) { return ring(p - Eigen::Vector2d(60, 50)); }, 0, 1);
  Picture pattern(23, 23);
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 23; ++x) pattern.row(y)[x] = whole.at(49 + x, 39 + y);
  double squares = 0, weighed = 0;
  constexpr int trials = 60;
  for (std::uint64_t k = 0; k < trials; ++k) {
    const hydro::RandomStream random(k, 6);
    const Eigen::Vector2d middle(60 + random.uniform(0), 50 + random.uniform(1));
    const Picture picture =
        picture_of([&](const Eigen::Vector2d& p) { return 20 + 0.6 * ring(p - middle); }, 5, k);  // in the evening
    const auto found = middle_of_pattern(picture, pattern, middle.array().round());
    ASSERT_TRUE(found) << k;
    const Eigen::Vector2d e = found->at - middle;
    squares += e.squaredNorm() / trials;
    weighed += e.dot(found->covariance.inverse() * e) / 2 / trials;
  }
  EXPECT_LT(std::sqrt(squares), 0.1);
  EXPECT_GT(weighed, 0.6);
  EXPECT_LT(weighed, 1.8);
  EXPECT_FALSE(middle_of_pattern(picture_of([](const Eigen::Vector2d&) { return 90.0; }, 3, 1), pattern, {60, 50}));
  EXPECT_FALSE(middle_of_pattern(whole, pattern, {5, 50})) << "the picture's edge is in the way";
}

}  // namespace
}  // namespace camera_shapes_test
