#pragma once
/// \file  Bright discs in a picture, such as reflecting circles, to a part of a pixel; (V13), (V14),
/// docs/theory/camera.md.
#include <cstddef>
#include <vector>

#include "fit/camera/picture.hpp"
#include "fit/camera/track.hpp"

namespace fit::camera {

struct DetectOptions {
  double smallest_px = 3, largest_px = 30;  ///< radius of a disc; 1.5 px at least
  double contrast = 40;                     ///< grey levels above its surroundings, at least
  double roundness = 0.4;  ///< short over long axis, at least: a moving disc is drawn out by the exposure
  bool dark = false;       ///< discs are darker than their surroundings
};

struct Disc {
  Sighting centre;    ///< px, with the covariance of its errors from the noise of the picture around it
  double radius_px;   ///< of a circle of its area
  double contrast;    ///< grey levels, of its middle above its surroundings
  double axis_ratio;  ///< short over long
};

struct Detection {
  std::vector<Disc> discs = {};
  std::size_t small = 0, large = 0, drawn_out = 0;  ///< bright places that are no discs of this size
  std::size_t at_edge = 0;  ///< cut by the edge of the picture, or with another so near that light mixes
};

/// Places that are brighter by half the contrast than the median of their neighbourhood, of the size and roundness
/// asked for; of each the centroid of its light over a plane through its surroundings, whatever the light and its
/// gradient. Exposure and blur draw a disc out evenly about its mean place, which is told. \throws hydro::InputError
/// for an empty picture, radii that are not in order, a contrast or roundness out of range
Detection detect(const Picture& picture, const DetectOptions& options);

}  // namespace fit::camera
