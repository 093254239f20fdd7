#pragma once
/// \file  Coefficients of other bodies made from those of given ones by exact laws: turned, scaled, mirrored, repeated,
/// put together. Laws and their limits are in docs/theory/conventions.md, (P28)-(P32).
///
/// Each function returns new coefficients; notes say what was done.
#include <span>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// The array turned by `angle` (from +x towards +y) about the vertical through the origin, the sea staying: headings
/// β + angle, points, A, B, C and X turned with it (P28). Headings are moved as a whole by full circles so that the
/// first is in [−180°, 180°); a table that spans a full circle keeps its ends, both being one direction.
/// The same bodies in axes turned by α are turned(c, −α). \throws InputError if the angle is not finite
Coefficients turned(Coefficients c, double angle);

/// The geometrically similar array `length_ratio` times as large, in water `density_ratio` times as dense, by Froude's
/// law: depth and all points grow too, gravity stays (P29). \throws InputError unless both are finite and positive
Coefficients scaled(Coefficients c, double length_ratio, double density_ratio = 1);

/// A vertical plane through the origin in which every body is its own image.
enum class MirrorPlane {
  y0,  ///< port and starboard are alike
  x0   ///< fore and aft are alike
};

/// Excitation for the mirrored headings too, β → −β or β → 180° − β, from that for the given ones (P30). Given headings
/// stay as they are. \throws InputError if there is no excitation, a reference point or centre of gravity is off the
/// plane, A, B or C couple modes that symmetry separates by more than `tolerance` of their size (P11), or loads at
/// given headings that are each other's image differ by more than `tolerance` of the largest
Coefficients completed_by_symmetry(Coefficients c, MirrorPlane plane, double tolerance = 0.02);

/// Copies of one body at places (x, y), relative to where its data stand, without interaction: A, B and C in blocks,
/// excitation with the wave's way to each place (P31). Names get numbers. What is neglected grows with the bodies' size
/// over their distance and with kh; a panel code or `froude bem solve` tells. \throws InputError unless there is
/// exactly one body and at least one place, all finite, and no two the same
Coefficients repeated(const Coefficients& one, std::span<const Eigen::Vector2d> place);

/// Runs of the same bodies at different frequencies as one. Where two have the same frequency or limit the numbers must
/// agree to `tolerance` of their size (P11), and those of the first stay. Headings must be the same.
/// \throws InputError for runs that differ in water, bodies, points, headings or C, or disagree at a common frequency
Coefficients merged(std::span<const Coefficients> run, double tolerance = 1e-3);

}  // namespace hydro::potential
