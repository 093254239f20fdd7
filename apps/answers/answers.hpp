#pragma once
/// \file  Private to apps: the answers to what a scene asks, one function each.
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/kept.hpp"
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Free motions of a scene that asks for them. \throws hydro::InputError, hydro::NumericsError
Modes free_modes(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = nullptr);

/// Whether periodic motions last, for a scene that asks for it; `done` is told the share of the map that is made.
/// \throws hydro::InputError, hydro::NumericsError
StabilityMap stability(const scene::Scene& scene, const std::function<void(double)>& done = {},
                       const std::shared_ptr<compile::Kept>& kept = nullptr);

/// The free surface of a scene that asks for it. \throws hydro::InputError where what makes waves has no shape that is
/// known here, and where the estimate misses the accuracy asked; hydro::NumericsError
FreeSurface free_surface(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = nullptr);

/// "m1.surge 1, m2.surge 0.81": the motions that matter in a shape.
std::string largest_motions(const std::vector<std::string>& motions, std::span<const double> shape);

/// What the answers that a scene asks for will take. \throws hydro::InputError
Plan plan(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = nullptr);

/// What the water does at the probes of a scene that asks for it. \throws hydro::InputError
WaterSeries water_series(const scene::Scene& scene, const std::function<void(double)>& progress = {});

/// True if [ask.waves] is answered by whole series at once, instead of asking the field at each instant.
bool is_synthesised(const scene::Scene& scene);

}  // namespace froude
