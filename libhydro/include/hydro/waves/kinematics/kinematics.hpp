#pragma once
/// \file  How the water itself moves under a linear wave; equations (W11)-(W13), docs/theory/waves.md.
#include <Eigen/Core>

#include "hydro/waves/kinematics/sea.hpp"

namespace hydro::waves {

/// Velocity of the water at `point` (x, y, z; m, z up from still water) under `wave`, (m/s) per metre of amplitude, as
/// Re(V e^{iωt}) with the phase of (P2): V holds e^{−ik(x cos β + y sin β)}, but not the component's own amplitude and
/// phase.
///
/// The acceleration of linear theory is iωV. Above the still water (z > 0) linear theory has no water; there the value
/// at z = 0 is used, which continues the profile upwards without growth. Neither overflows nor cancels for any kh.
/// \throws InputError for a point below the bed
Eigen::Vector3cd velocity_transfer(const Component& wave, const Water& water, const Eigen::Vector3d& point);

}  // namespace hydro::waves
