#pragma once
/// \file  The run that a linear answer is held against. Private to apps.
#include "scene/scene.hpp"

namespace froude {

/// The scene asked for a run of the signals of its [ask] rao, from rest, whatever its error: one that misses its
/// accuracy still shows what a linear answer ignores. Waves, and over how much of it they grow, are the caller's.
inline scene::Scene asked_to_run(scene::Scene scene, double duration, double every) {
  scene.run = {.duration = duration,
               .every = every,
               .from_equilibrium = scene.rao->about.equilibrium,
               .of = scene.rao->of,
               .of_places = scene.rao->of_places,
               .place = scene.rao->place};
  for (auto& body : scene.bodies) {
    body.initial.clear();
    body.initial_velocity.clear();
  }
  scene.solve.accept_error = true;
  return scene;
}

}  // namespace froude
