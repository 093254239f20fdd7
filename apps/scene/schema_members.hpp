#pragma once
/// \file  The table of slender members, declared in schema_members.cpp. Private to apps/scene.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& member_table();

}  // namespace froude::scene
