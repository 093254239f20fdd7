#pragma once
/// \file  When a load acts: keys that loads on bodies and on nodes of lines have alike. (D150) Private to apps/scene.
#include "dynamics/time/load_history.hpp"
#include "scene/binding.hpp"

namespace froude::scene {

/// `from`, `ramp_up`, `until` and `ramp_down`; all left out: the load acts at all times.
const Binding<dynamics::LoadHistory>& load_history();

}  // namespace froude::scene
