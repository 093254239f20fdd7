#pragma once
/// \file  What may be said of a line in a table of its own, `[line.NAME]`, and needs nothing of the other tables: each
///        is one file, lines/NAME.cpp, named in CMakeLists.txt, which defines
///
///          LineProperty NAME_of_lines();
///
///        A line by itself, lines that meet, and lines with other numbers in a fit are made of the Line that it fills.
///        Private to apps/scene.
#include <functional>
#include <string>
#include <vector>

#include "scene/binding.hpp"

namespace froude::scene {

struct LineProperty {
  Key key;  ///< of the table, in [[line]]
  /// Called with that table, or with each of them, and its line, whose ends and segments are there. \throws
  /// hydro::InputError
  std::function<void(const Record& own, const Record& whole, Line& line)> read;
};

/// \throws hydro::InputError unless the node that `own` names is one of the line that nothing holds
void require_free_node(const Record& own, const Line& line);

/// All that are listed, in the order of the reference.
const std::vector<LineProperty>& line_properties();

}  // namespace froude::scene
