#pragma once
/// \file  Private to apps: a run that controllers of the caller's rule.
#include <functional>
#include <memory>
#include <vector>

#include "compile/compile.hpp"
#include "froude/joint_control.hpp"

namespace froude {

/// As simulate(), but once and without an estimate of the error: controllers have a memory of their own, and are not
/// asked twice of the same time. \throws hydro::InputError, also where the run takes no step
Run simulate_controlled(const scene::Scene& scene, const std::function<void(double)>& done,
                        const std::vector<Control>& controls, const std::vector<JointControl>& of_joints,
                        const std::shared_ptr<compile::Kept>& kept);

}  // namespace froude
