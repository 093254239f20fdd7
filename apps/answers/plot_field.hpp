#pragma once
/// \file  The geometry of a plot's field: tiles, contours, colours. Private to apps.
#include <string>
#include <vector>

#include "answers/plot.hpp"

namespace froude::plot {

/// What is nearer to one point of the grid than to others.
struct Tile {
  double x0, x1, y0, y1;
  double value;
};
/// Of points whose value is finite.
std::vector<Tile> tiles_of(const Field& field);
/// From the first tile to the last. \throws std::logic_error in audit builds for fewer than two points
std::pair<double, double> extent(const std::vector<double>& at);

/// A straight piece of a contour.
struct ContourPiece {
  double x1, y1, x2, y2;
};
/// Where the field is a level, if it is linear on the two triangles into which a diagonal cuts four neighbours. Nothing
/// near points whose value is not finite.
std::vector<ContourPiece> contour(const Field& field, double level);

/// A line from point to point.
struct ContourLine {
  std::vector<double> x, y;
};
/// Pieces whose ends meet, to the bit as those of contour() do, one after the other; a line that closes ends where it
/// begins. One through a point of the grid may be cut there. Quadratic in the number of pieces.
std::vector<ContourLine> joined(std::vector<ContourPiece> pieces);

/// From dark and low, 0, to light and high, 1, with even steps of lightness: "#2a788e".
std::string colour_at(double share);

}  // namespace froude::plot
