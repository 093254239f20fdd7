#pragma once
/// \file  What the fast fields have in common with HarmonicField: stretching, current and pressure.
#include "hydro/waves/kinematics/field.hpp"

namespace hydro::waves {

/// Sums over harmonics of (W17) at one point, read at the stretched height.
struct Flow {
  double ux, uy, uz, ax, ay, az, potential_rate, xx, yy, xy, xz, yz;
};

/// The options of a field, apart from its harmonics.
struct Surroundings {
  Water water;
  HarmonicField::Options options;
  Current current;

  /// \throws InputError for a point below the bed
  StretchedHeight stretched(double z, double elevation) const;
  Kinematics kinematics(const Flow& flow, double z, double elevation) const;
};

}  // namespace hydro::waves
