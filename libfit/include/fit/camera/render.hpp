#pragma once
/// \file  Films of motions that are known: discs on stickers in a plane, seen through a lens, with exposure, blur,
/// noise
///        and uneven light; and boards for calibration. (V15), docs/theory/camera.md.
#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "fit/camera/picture.hpp"
#include "fit/camera/view.hpp"

namespace fit::camera {

/// A camera that films. Places in the plane of motion are m, along the axis and up.
struct Filming {
  View view = {};
  Eigen::Vector2i size = {640, 480};                   ///< px
  double disc_radius = 0.008, sticker_radius = 0.016;  ///< m
  std::vector<Picture> patterns = {};  ///< one a marker, in place of discs: grey levels of its cells, upright
  double cell = 0;                     ///< m, side of a cell
  double exposure_s = 0;               ///< a frame shows the mean of this time, about its own
  double blur_px = 0.5;                ///< standard deviation of the optics' blur
  double background = 90, disc = 210, sticker = 20, bar = 140;  ///< grey levels
  double bar_width = 0;                                         ///< m, of the bars that are drawn between `bars`
  std::vector<std::pair<std::size_t, std::size_t>> bars = {};   ///< markers that a bar joins
  double noise = 0;                                             ///< standard deviation of each pixel, grey levels
  double fall_of_light = 0;  ///< share by which the right edge is darker than the left one
  double flicker = 0;        ///< standard deviation of the light from frame to frame, as a share
  double lost = 0;           ///< share of the frames that are lost
  std::uint64_t seed = 1;    ///< of noise, flicker and losses
};

/// Where all markers are at a time.
using Places = std::function<std::vector<Eigen::Vector2d>(double time_s)>;

/// Grey levels without noise and rounding, shape (height, width): whoever films one motion with many noises draws it
/// once.
using Light = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
Light light_of(const Filming& filming, const Places& places, double time_s);
/// With the noise and the flicker of this frame, rounded to whole levels from 0 to 255.
Picture exposed(const Filming& filming, const Light& light, std::uint64_t frame);
bool is_lost(const Filming& filming, std::uint64_t frame);

/// A board of squares, the upper left one black, before a grey wall.
struct Board {
  int columns = 9, rows = 6;  ///< of corners between squares
  double square = 0.025;      ///< m
};
/// The board at this pose: its first inner corner is the origin of its axes. \throws hydro::InputError for a board that
/// is not all before the camera
Light light_of_board(const Filming& filming, const Board& board, const PlanePose& pose);

}  // namespace fit::camera
