#pragma once
/// \file  The tables of lines and of where they meet, declared in schema_line.cpp. Private to apps/scene.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& line_table();
const Table& junction_table();

}  // namespace froude::scene
