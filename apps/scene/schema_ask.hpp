#pragma once
/// \file  The tables [ask] and [solve] of the grammar.
#include "scene/schema.hpp"

namespace froude::scene {

const Table& ask_table();
const Table& solve_table();

}  // namespace froude::scene
