#include "fit/camera/detect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "fit/camera/render.hpp"
#include "hydro/base/error.hpp"

namespace camera_detect_test {
namespace {

using fit::camera::detect;
using fit::camera::Detection;
using fit::camera::DetectOptions;
using fit::camera::Disc;
using fit::camera::Filming;
using fit::camera::Picture;
using testing::HasSubstr;

/// A lens as wide as Huijgen's (2024, table 7.2), at a quarter of his pixels, with ten times his distortion.
Filming camera() {
  Filming out;
  out.view.lens = fit::camera::Lens{.focal = {635.75, 636.9},
                                    .principal = {393, 253},
                                    .radial = {-0.2, 0.12, 0},
                                    .tangential = {0.002, -0.001},
                                    .size = {756, 504}};
  out.view.metres_per_pixel = 1.25e-3;
  out.view.pivot = {100, 80};
  out.size = {756, 504};
  return out;
}

/// Eight discs on a circle that turns once in two seconds.
std::vector<Eigen::Vector2d> turning(double t) {
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < 8; ++k) {
    const double a = 3.14 * t + 0.785 * k;
    out.emplace_back(0.37 + 0.19 * std::cos(a), -0.2 + 0.19 * std::sin(a));
  }
  return out;
}

/// Errors of all discs in some frames against where they are, px, with what their covariances say of them.
struct Errors {
  double squares = 0, distance = 0;  // px²; over the covariance: χ² of 2
  int discs = 0, missed = 0, inside = 0;
  double rms() const { return std::sqrt(squares / discs); }  // of both coordinates together
};

Errors errors_of(const Filming& filming, const DetectOptions& options, int frames) {
  Errors out;
  for (int i = 0; i < frames; ++i) {
    const double t = 0.0371 * i;
    const Picture picture = exposed(filming, light_of(filming, turning, t), static_cast<std::uint64_t>(i));
    const Detection found = detect(picture, options);
    for (const Eigen::Vector2d& place : turning(t)) {
      const Eigen::Vector2d truth = pixel_of(filming.view, place);
      const Disc* nearest = nullptr;
      for (const Disc& d : found.discs)
        if ((d.centre.at - truth).norm() < 3) nearest = &d;
      if (nearest == nullptr) {
        ++out.missed;
        continue;
      }
      const Eigen::Vector2d e = nearest->centre.at - truth;
      out.squares += e.squaredNorm();
      const double chi = e.dot(nearest->centre.covariance.inverse() * e);
      out.distance += chi;
      out.inside += chi < 5.99;  // 95 % of χ² of 2
      ++out.discs;
    }
  }
  return out;
}

TEST(Detection, OfACleanFilmIsWithinATenthOfAPixel) {
  const Errors e = errors_of(camera(), {.smallest_px = 4, .largest_px = 12}, 12);
  EXPECT_EQ(e.missed, 0);
  EXPECT_LT(e.rms(), 0.1) << "asked of clean films";
  // Rounding to levels moves a centroid of this size by 0.003 px, and the lens the centre of a disc against that of its
  // picture by r² k₁ρ/f, 0.004 px: a fiftieth leaves room for both.
  EXPECT_LT(e.rms(), 0.02);
}

TEST(Detection, OfANoisyBlurredMovingFilmIsWithinHalfAPixelAndKnowsItsErrors) {
  Filming film = camera();
  film.noise = 12;
  film.blur_px = 1.5;
  film.exposure_s = 0.008;
  film.fall_of_light = 0.4;
  film.flicker = 0.05;
  film.sticker_radius = 0.024;  // a rim of two radii
  film.sticker = 70;            // noise on black would be cut off at zero, and hidden
  film.bar_width = 0.006;
  film.bars = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 7}};
  const Errors e = errors_of(film, {.smallest_px = 4, .largest_px = 12}, 30);
  EXPECT_EQ(e.missed, 0);
  EXPECT_LT(e.rms(), 0.5) << "asked of noisy films";
  EXPECT_LT(e.rms(), 0.2);
  // 240 discs: the mean of χ² of 2 has the deviation 0.13; light that falls over a disc moves it a little besides.
  EXPECT_NEAR(e.distance / e.discs, 2, 0.5);
  EXPECT_NEAR(e.inside / static_cast<double>(e.discs), 0.95, 0.04);
}

TEST(Detection, OfDarkDiscsIsThatOfBrightOnesTurnedRound) {
  const Filming film = camera();
  Picture picture = exposed(film, light_of(film, turning, 0.4), 0);
  const Detection bright = detect(picture, {.smallest_px = 4, .largest_px = 12});
  for (auto& g : picture.grey) g = static_cast<std::uint8_t>(255 - g);
  const Detection dark = detect(picture, {.smallest_px = 4, .largest_px = 12, .dark = true});
  ASSERT_EQ(bright.discs.size(), 8u);
  ASSERT_EQ(dark.discs.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_LT((bright.discs[k].centre.at - dark.discs[k].centre.at).norm(), 1e-9);
}

/// One frame of discs at these pixels, radius 6.4 px.
Detection of(const std::vector<Eigen::Vector2d>& pixels,
             const DetectOptions& options = {.smallest_px = 4, .largest_px = 12}) {
  Filming film;
  film.view.metres_per_pixel = 1.25e-3;
  film.sticker_radius = 0;
  const auto places = [&](double) {
    std::vector<Eigen::Vector2d> out;
    for (const auto& p : pixels) out.push_back(point_of(film.view, p));
    return out;
  };
  return detect(exposed(film, light_of(film, places, 0), 0), options);
}

TEST(Detection, CountsWhatItLeavesOut) {
  EXPECT_EQ(of({{100, 100}}).discs.size(), 1u);
  EXPECT_EQ(of({{100, 100}}, {.smallest_px = 8, .largest_px = 12}).small, 1u);
  EXPECT_EQ(of({{100, 100}}, {.smallest_px = 2, .largest_px = 5}).large, 1u);
  EXPECT_EQ(of({{4, 100}}).at_edge, 1u) << "cut by the edge";
  EXPECT_EQ(of({{100, 100}, {116, 100}}).at_edge, 2u) << "their light mixes";
  const Detection merged = of({{100, 100}, {107, 100}, {114, 100}, {121, 100}, {128, 100}});
  EXPECT_EQ(merged.drawn_out, 1u);
  EXPECT_TRUE(merged.discs.empty());
}

TEST(Detection, TellsRadiusContrastAndRoundness) {
  const Disc d = of({{100.3, 99.6}}).discs.at(0);
  EXPECT_NEAR(d.radius_px, 6.4, 0.1);
  EXPECT_NEAR(d.contrast, 120, 2);
  EXPECT_NEAR(d.axis_ratio, 1, 0.05);
  EXPECT_LT((d.centre.at - Eigen::Vector2d(100.3, 99.6)).norm(), 0.005);
}

TEST(Detection, RefusesOptionsThatMeanNothing) {
  const Picture grey(10, 10);
  EXPECT_THAT([&] { detect(grey, {.smallest_px = 8, .largest_px = 4}); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("radii")));
  EXPECT_THAT([&] { detect(Picture(), {}); }, testing::ThrowsMessage<hydro::InputError>(HasSubstr("shows nothing")));
  EXPECT_THAT([&] { detect(grey, {.contrast = 300}); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("contrast")));
}

TEST(Render, LightOfADiscIsItsAreaWherePixelsAreSquaresOfThePlane) {
  Filming film;
  film.view.metres_per_pixel = 1e-3;
  film.background = 0;
  film.disc = 1;
  film.sticker_radius = 0;
  film.disc_radius = 0.0085;
  for (const double blur : {0.0, 1.0}) {
    film.blur_px = blur;
    const auto light = light_of(
        film,
        [](double) {
          return std::vector<Eigen::Vector2d>{{0.1003, -0.0812}};
        },
        0);
    // Blur of a curved edge by its distance alone adds π s² to the area.
    EXPECT_NEAR(light.cast<double>().sum(), 3.14159265 * (8.5 * 8.5 + blur * blur), 0.15) << blur;
    double x = 0;
    for (Eigen::Index i = 0; i < light.cols(); ++i) x += static_cast<double>(i) * light.col(i).cast<double>().sum();
    EXPECT_NEAR(x / light.cast<double>().sum(), 100.3, 0.002);
  }
}

TEST(Render, NoiseHasItsDeviationAndLossesTheirShare) {
  Filming film;
  film.noise = 6;
  film.lost = 0.1;
  const auto light = light_of(
      film, [](double) { return std::vector<Eigen::Vector2d>{}; }, 0);
  const Picture a = exposed(film, light, 0), b = exposed(film, light, 1);
  double squares = 0, product = 0;
  for (std::size_t i = 0; i < a.grey.size(); ++i) {
    squares += std::pow(a.grey[i] - 90.0, 2);
    product += (a.grey[i] - 90.0) * (b.grey[i] - 90.0);
  }
  const auto n = static_cast<double>(a.grey.size());
  EXPECT_NEAR(squares / n, 36 + 1.0 / 12, 0.3);  // deviation of the mean of 3e5 squares: 36 √(2/n) = 0.09
  EXPECT_NEAR(product / n, 0, 0.3) << "frames have noise of their own";
  EXPECT_EQ(a.grey, exposed(film, light, 0).grey) << "and the same each time";
  int lost = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) lost += is_lost(film, i);
  EXPECT_NEAR(lost, 200, 40);
}

}  // namespace
}  // namespace camera_detect_test
