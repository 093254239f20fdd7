#pragma once
/// \file  The table [[joint]]. Private to apps/scene.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& joint_table();

}  // namespace froude::scene
