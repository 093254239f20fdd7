#pragma once
/// \file  Private to compile/: wave loads of second order that bodies name.
#include "compile/compile.hpp"
#include "compile/signals.hpp"

namespace froude::compile {

/// Adds the loads of `[body.second_order]`; `notes` are told what their files leave open. \throws hydro::InputError, at
/// its place: waves that are no sum of linear ones (`sea` is null), that come from where the file has no data, or more
/// of whose energy than the accuracy asked is at frequencies outside it; Newman's approximation in a spread sea
void add_second_order(const scene::Scene& scene, const std::vector<dynamics::RigidBody>& bodies,
                      const hydro::waves::Sea* sea, const StepGrid& grid, std::vector<std::string>& notes,
                      std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces);

}  // namespace froude::compile
