#pragma once
/// \file  The integrator that a scene asks for.
#include <memory>

#include "dynamics/integrate/integrator.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

/// Of integrators with a tolerance of their own, where a scene gives none: far below any other error of a run.
constexpr double tolerance_of_pair = 1e-8;

/// Those that cut their steps by an error of their own.
bool has_own_tolerance(const std::string& integrator);
/// True if a tolerance makes the steps: the integrator's own, or one that the scene gives.
bool has_steps_by_tolerance(const scene::Solve& solve);

/// \throws hydro::InputError, at its place in the scene, if the method cannot step what the scene names
std::unique_ptr<dynamics::Integrator> make_integrator(const scene::Scene& scene, const dynamics::Model& model);

}  // namespace froude::compile
