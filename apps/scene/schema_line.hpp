#pragma once
/// \file  The table of lines, declared in schema_line.cpp. Private to apps/scene.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& line_table();

}  // namespace froude::scene
