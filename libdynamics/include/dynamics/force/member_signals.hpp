#pragma once
/// \file  The load of one effect on one slender member, as signals of a run. (D154)
#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

#include "dynamics/state/signal.hpp"

namespace dynamics {

/// A member that tells its loads.
struct ToldLoad {
  std::string name;
  Eigen::Vector3d centre_of_gravity;  ///< of its body, from the body's origin, body axes, m
};

/// "brace.slamming_force_x" … "brace.slamming_moment_z", N and N m: what `effect` exerts on the body through this
/// member, about the body's origin along global axes, as net_load_signals() has them. `load`: the same about the centre
/// of gravity. Such loads are of runs: they have no variation.
std::vector<Signal> member_load_signals(const ToldLoad& member, const std::string& effect, int body,
                                        const std::function<Vector6(const Reading&)>& load);

}  // namespace dynamics
