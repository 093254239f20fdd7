#pragma once
/// \file  Values written into the text of a scene: comments, order and all that is not named stay as they are.
#include <string>
#include <string_view>
#include <vector>

namespace froude::scene {

/// A key and the value that it shall have.
struct TextEdit {
  /// Keys from the root, "solve.integrator.name"; of several tables with one heading the number counts from 1,
  /// "body[2].hydrodynamics.radiation.method".
  std::string path;
  std::string value;  ///< as TOML writes it, "\"0.05 s\""; empty: the key is taken out
};

/// The text with other values at these keys, written one after the other. A key that was not there stands first in its
/// table, or last between the braces of an inline one; a [table] that was not there stands at the end, a key of the
/// root at the beginning. `file` only names the text in errors. \throws hydro::InputError if the text is not TOML, if a
/// path names a table of a list that there is not, and for tables written with dotted keys, `integrator.name = …`,
/// which get no further keys
std::string edited(std::string text, const std::string& file, const std::vector<TextEdit>& edits);

}  // namespace froude::scene
