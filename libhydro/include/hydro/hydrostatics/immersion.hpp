#pragma once
/// \file  What still water does to a hull in any position: exact for the mesh, however far it is heeled or sunk.
///
/// Triangles are cut at z = 0 and integrated exactly, (H4)-(H7) of docs/theory/hydrostatics.md; nothing is linearised
/// and no panel counts as "in" or "out". Errors are those of the mesh, and 1e-12 of the hull's own size.
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>

#include "hydro/base/types.hpp"
#include "hydro/hydrostatics/mesh.hpp"

namespace hydro::hydrostatics {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Of a hull's diagonal: faces that are nearer to the still water lie in it, for waves as for hydrostatics (H6). The
/// 32-bit numbers of STL put a deck that is drawn at the water less far from it.
inline constexpr double in_surface = 1e-6;

/// Where a hull is: the point x of the mesh is at attitude · x + position. The default is as drawn.
struct Pose {
  Eigen::Matrix3d attitude = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const { return attitude * x + position; }
};

/// Heel about the hull's own x axis, then trim about the level y axis (H8): positive heel puts starboard (−y) down,
/// positive trim the bow.
Eigen::Matrix3d attitude_of(Angle heel, Angle trim);

/// The cut of the hull with z = 0.
struct Waterplane {
  double area;                    ///< S, m²
  Eigen::Vector2d centre;         ///< global, m
  Eigen::Matrix2d second_moment;  ///< about `centre`: [∫x², ∫xy; ∫xy, ∫y²] dS, m⁴
};

/// The hull's part under water.
struct Immersion {
  double volume = 0;                                  ///< V, m³
  std::optional<Eigen::Vector3d> centre_of_buoyancy;  ///< global, m; empty if V = 0
  double wetted_area = 0;                             ///< m²; triangles that lie in the surface are dry
  std::optional<Waterplane> waterplane;  ///< empty if the surface is not pierced (S < 1e-12 of the hull's area)
  double area_in_surface = 0;  ///< of triangles within `in_surface`, m²; if positive, derivatives are those of rising
};

/// Cuts and integrates (H4)-(H6). Vertices within 1e-12 of the hull's diagonal from z = 0 lie in it; triangles within
/// `in_surface` displace their water, and are no hole in the waterplane. Cost: O(triangles). \throws InputError if the
/// rim of an opening is under water by more than 1e-6 of the diagonal, saying
/// where; if the pose is not finite or no rotation
Immersion immersion(const Hull& hull, const Pose& pose);

/// Height of the lowest point at the rim of an opening above the water, m; +∞ for a closed hull.
double freeboard_of_openings(const Hull& hull, const Pose& pose);

/// Force and moment of still water about the global point `about`, N and N m (H7).
Vector6 buoyancy(const Immersion& immersion, const Water& water, const Eigen::Vector3d& about);

/// Energy of which buoyancy is the negative gradient, J: −ρ g V z_B (H7).
double buoyancy_energy(const Immersion& immersion, const Water& water);

/// K = −∂(buoyancy about p)/∂(motion of p, small rotation in global axes), p moving with the hull: exact at any pose
/// (H9), N/m … N m. At rest it is the water's part of C of hydro/potential. K − Kᵀ is [M]× of the moment, see (H9).
Matrix6 buoyancy_stiffness(const Immersion& immersion, const Water& water, const Eigen::Vector3d& about);

/// The same of gravity: the weight W [N] at the global point `centre` (P12).
Matrix6 gravity_stiffness(double weight, const Eigen::Vector3d& centre, const Eigen::Vector3d& about);

}  // namespace hydro::hydrostatics
