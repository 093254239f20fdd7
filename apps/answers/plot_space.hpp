#pragma once
/// \file  Paths in space, drawn in perspective in a box with ticks, as SVG.
#include <Eigen/Core>

#include <numbers>
#include <string>
#include <vector>

#include "answers/plot.hpp"

namespace froude::plot {

/// From where the box is seen.
struct Eye {
  double azimuth_rad = -std::numbers::pi / 3;   ///< of the eye about z, from +x towards +y
  double elevation_rad = std::numbers::pi / 9;  ///< above the level of the box
};

struct SpacePath {
  std::string name;             ///< in the legend; "" keeps it out
  std::vector<double> x, y, z;  ///< of equal length; points that are not finite break the line
};

struct Space {
  std::string title;
  Axis x, y, z;  ///< linear; with one unit for all three a metre is as long along each
  std::vector<SpacePath> paths;
  Eye eye = {};
  int width = 860, height = 720;  ///< px
};

/// Perspective: the picture of a point of the unit box, |coordinates| ≤ ½, to the right and up, as seen by an eye at
/// eye_distance times the box's half diagonal that looks at its middle. What is nearer is larger.
inline constexpr double eye_distance = 4;
Eigen::Vector2d seen(const Eigen::Vector3d& point, const Eye& eye);

/// The figure as a complete SVG document.
std::string svg(const Space& space);

}  // namespace froude::plot
