#pragma once
/// \file  One value of a scene: its type, unit, dimension and bound, checked against the declaration of its key.
#include <string>

#include "scene/record.hpp"

namespace froude::scene {

/// `title` names the table in errors. Not for tables. \throws hydro::InputError at the value
Value read_value(const Node& node, const Key& key, const std::string& title);

/// \throws hydro::InputError unless the value is a table, or a list of tables
void check_table(const Node& node, const Key& key, const std::string& title);
void check_list_of_tables(const Node& node, const Key& key);

/// The default of a key as if the file held it at `place`.
Node default_node(const Key& key, const hydro::Place& place);

/// `diameter = "1.6 m"`: a line that would satisfy the reader.
std::string example(const Key& key);

/// The value as the echo shows it: text without quotes, lists in brackets.
std::string echo_text(const Node& node);

}  // namespace froude::scene
