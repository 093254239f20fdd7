#pragma once
/// \file  The tables [[mooring]] and [[connector]] of the grammar.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& mooring_table();
const Table& connector_table();

}  // namespace froude::scene
