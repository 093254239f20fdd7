#pragma once
/// \file  The tables of signals that a scene names, declared in schema_signals.cpp. Private to apps/scene.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& point_table();
const Table& relative_motion_table();

}  // namespace froude::scene
