#pragma once
/// \file  Tables drawn upon a picture: points of another source, another campaign, or boundaries.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "answers/plot.hpp"
#include "scene/binding.hpp"

namespace froude {

/// A table that is drawn upon a picture.
struct Overlay {
  scene::Located<std::filesystem::path> file;  ///< absolute
  std::string x, y;                            ///< its columns
  std::optional<std::string> by;               ///< a column, each text or number of which has a curve
  bool line = false;                           ///< else marks
  scene::Located<std::string> panel;           ///< of a fit: "cd over KC", as its axes have it; else empty
};

/// The keys of a table upon a picture that has one panel. `file` is beside the text that names it.
scene::Binding<Overlay> overlay_binding(const std::string& title, const std::string& meaning);
/// The same upon one panel of a fit's picture, which `panel` names.
scene::Binding<Overlay> panel_overlay_binding(const std::string& title, const std::string& meaning);

/// The table is there, with its columns. \throws hydro::InputError at the key of a file that is not there, and in the
/// table at a column that is not there or no number
void check_overlay(const Overlay& over);

/// Its curves in the units of the two axes. Rows of the table are points in their order; where the text or number under
/// `by` is another than in the row before, a new curve begins, and only the first of a name stands in the legend. Upon
/// a map they are red, the second and every other name dashed.
/// \throws hydro::InputError where a column is of another dimension than its axis
std::vector<plot::Series> series_of(const Overlay& over, const std::string& x_unit, const std::string& y_unit,
                                    bool on_map);

/// Each upon its panel, whose ranges grow where they have to.
/// \throws hydro::InputError at a name that no panel has, saying which there are, and as series_of()
void draw_upon(const std::vector<Overlay>& overlays, std::vector<plot::Panel>& panels);

}  // namespace froude
