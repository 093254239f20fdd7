#pragma once
/// \file  The table [[contact]] of the grammar.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& contact_table();

}  // namespace froude::scene
