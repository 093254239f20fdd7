#pragma once
/// \file  Slender members at their true position in waves: where they are wet, and how that changes. (D42), (D43)
#include <Eigen/Core>

#include <vector>

#include "dynamics/state/body.hpp"
#include "hydro/waves/kinematics/field.hpp"

namespace dynamics {

/// Which part of a member is taken as wet.
enum class Immersion {
  whole,        ///< all of it, always: members that stay under water
  still_water,  ///< what is below z = 0
  surface       ///< what is below the waves, at each instant
};

/// Where loads are taken: at Gauss' two points of a piece that is wet throughout, else at the middle of its wet part.
constexpr int points_per_piece(Immersion immersion) { return immersion == Immersion::whole ? 2 : 1; }

/// A straight circular cylinder fixed to a body, cut into pieces of equal length.
struct SlenderMember {
  int body;
  Eigen::Vector3d from, to;  ///< its ends from the body's centre of gravity, body axes, m
  double diameter;           ///< m
  int pieces;                ///< at least 1
  Immersion immersion;
};

/// A member where its body has it now, global axes.
struct PlacedMember {
  Eigen::Vector3d centre;       ///< the body's centre of gravity
  Eigen::Vector3d from, along;  ///< arm of the first end, and from there to the second
  Eigen::Vector3d axis;         ///< unit vector along it
  Eigen::Vector3d velocity, omega;
  double length;
  double
      rise;  ///< h: height of the cylinder's own surface across its axis, from lowest to highest point of a section, m

  Eigen::Vector3d arm(double fraction) const { return from + fraction * along; }
};
PlacedMember placed(const SlenderMember& member, const State& state);

/// Height of the water above the axis at the ends of its pieces, (pieces + 1), m; negative where the axis is dry.
/// Without a surface (Immersion::whole): +∞.
std::vector<double> heights(const SlenderMember& member, const PlacedMember& at, const hydro::waves::WaveField& water,
                            double t_s);
/// The same, into a vector that has room.
void find_heights(const SlenderMember& member, const PlacedMember& at, const hydro::waves::WaveField& water, double t_s,
                  std::vector<double>& out);

/// The share of a section that is wet, its height below the surface over the diameter, 0 … 1, (W80) for any slope.
double wetness(double height_m, double rise_m);

/// The wet length for which one point stands (sections half wet count half), and that point.
struct WetPiece {
  using Row = Eigen::Matrix<double, 1, 6>;
  double length;                ///< m
  Eigen::Vector3d arm;          ///< from the centre of gravity to the point, global
  Row length_by = Row::Zero();  ///< how the length and the place along the axis change with translation and small
  Row place_by = Row::Zero();   ///  global rotation of the body
};

/// All pieces that are wet at all, points_per_piece() of each. Their derivatives only where asked; slopes of the
/// surface are differences over a millionth of the diameter.
std::vector<WetPiece> wet_pieces(const SlenderMember& member, const PlacedMember& at,
                                 const hydro::waves::WaveField& water, double t_s, bool derivatives);
/// The same, into a vector that has room.
void find_wet_pieces(const SlenderMember& member, const PlacedMember& at, const hydro::waves::WaveField& water,
                     double t_s, bool derivatives, std::vector<WetPiece>& out);

/// ∫β dσ over 0 … 1 and the mean place ∫βσ dσ/∫β dσ, β = wetness of a height that runs straight from g₀ to g₁, with
/// derivatives by (g₀, g₁, h). The place is ½ where nothing is wet. (D42)
struct WetShare {
  double share, place;
  Eigen::Vector3d share_by, place_by;
};
WetShare wet_share(double g0, double g1, double h);

}  // namespace dynamics
