#pragma once
/// \file  The tables of waves and current, declared in schema_waves.cpp. Private to apps/scene.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& waves_table();
const Table& current_table();
const Table& ask_waves_table();

}  // namespace froude::scene
