#pragma once
/// \file  What accuracy costs in a scene. Private to apps.
#include <functional>

#include "froude/cost.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Measures error and time of every setting of the scene's own approximations. Each answer is that of the scene's text
/// with the setting written into it, so that what was measured is what cost() may write. `progress` is told the share
/// that is done. \throws hydro::InputError for a scene that asks for neither run nor RAO, or that has no answer as it
/// is; hydro::NumericsError if no reference can be computed
Cost cost(const scene::Scene& scene, const CostOptions& options = {}, const std::function<void(double)>& progress = {});

}  // namespace froude
