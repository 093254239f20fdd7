#pragma once
/// \file  How a hull of given weight floats: draught, equilibrium, metacentre and righting arms at any heel.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "hydro/hydrostatics/immersion.hpp"

namespace hydro::hydrostatics {

/// Mass and its centre in the axes of the mesh.
struct MassPoint {
  double mass;             ///< kg
  Eigen::Vector3d centre;  ///< G as drawn, m
};

/// The pose with this attitude, x and y of the mesh's origin unmoved, that displaces `volume`: V falls with heave, so
/// there is one; found to 1e-14 of the hull's area times its diagonal by Newton steps inside a bracket (H10).
/// \throws InputError if volume is not positive, or more than the hull can displace before it sinks or floods
Pose floating_at(const Hull& hull, const Eigen::Matrix3d& attitude, double volume);

/// Metacentric heights at a pose, m (H11): positive is stable.
struct Metacentre {
  double bm_transverse, bm_longitudinal;  ///< I/V
  double gm_transverse, gm_longitudinal;  ///< BM + z_B − z_G
  double gm_least;                        ///< over all axes in the waterplane; that of the principal axis
};
/// \throws InputError unless the hull pierces the surface
Metacentre metacentre(const Immersion& immersion, const Eigen::Vector3d& centre_of_gravity);

/// A pose of equilibrium, or how far the search came.
struct Equilibrium {
  Pose pose;
  bool converged = false;
  bool stable = false;        ///< K of heave, roll and pitch about G is positive definite
  int iterations = 0;         ///< of roll and pitch; heave is balanced in each
  double arm = 0;             ///< what is left: horizontal distance between G and the centre of buoyancy, m
  double heel = 0, trim = 0;  ///< of the pose, rad (H8)
  std::string why;            ///< one sentence
};

/// Newton steps in roll and pitch, heave balanced in each, downhill in energy (H12); stops when the arm is below 1e-10
/// of the hull's diagonal, or after 100 iterations. A hull put exactly upright on a hump of energy stays there and is
/// reported unstable. Yaw and the x and y of the mesh's origin stay.
/// \throws InputError as floating_at(), and unless mass is positive and the centre finite
Equilibrium equilibrium(const Hull& hull, const MassPoint& body, const Water& water,
                        const Eigen::Matrix3d& start = Eigen::Matrix3d::Identity());

/// One point of a curve of righting arms.
struct RightingArm {
  double heel;    ///< rad
  double trim;    ///< rad
  double gz;      ///< m; positive turns a positive heel back
  double energy;  ///< (E(heel) − E(first))/W = ∫ GZ cos(trim) d(heel), m (H13)
  Pose pose;
};

enum class Trim { fixed, free };

struct RightingCurve {
  std::vector<RightingArm> arms;  ///< one a heel, as far as the hull keeps the water out
  std::string ended;              ///< why it ends before the last heel that was asked for; "" if it does not
};

/// GZ(heel) at constant displacement, trim kept at `trim`, or free: the pitching moment is then zero at each heel
/// (from the trim of the heel before), found as in (H12).
/// \throws InputError if the hull sinks or floods at the first heel; NumericsError if no trim of equilibrium is found
RightingCurve righting_arms(const Hull& hull, const MassPoint& body, const Water& water,
                            const std::vector<double>& heel, Trim trim = Trim::fixed,
                            Angle start_trim = Angle::from_radians(0));

}  // namespace hydro::hydrostatics
