#include "answers/overlay.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

using hydro::io::CsvTable;
using scene::text;

CsvTable table_of(const Overlay& over) {
  return scene::placed(over.file.place, [&] { return CsvTable::read(over.file.value); });
}

/// A column in the unit of an axis.
std::vector<double> in_unit(const CsvTable& table, const std::string& name, const std::string& of_axis) {
  const hydro::Unit unit = of_axis.empty() ? hydro::Unit() : hydro::parse_unit(of_axis);
  std::vector<double> out = table.column(name, unit.dimension);
  for (double& value : out) value /= unit.factor;
  return out;
}

/// What the legend calls each row.
std::vector<std::string> names_of_rows(const CsvTable& table, const Overlay& over) {
  if (!over.by) return std::vector<std::string>(table.rows(), over.file.value.stem().string());
  if (table.is_text(*over.by)) return table.text_column(*over.by);
  std::vector<std::string> out;
  for (const double value : table.column(*over.by)) out.push_back(fmt::format("{} {:.6g}", *over.by, value));
  return out;
}

std::string name_of(const plot::Panel& panel) { return panel.y.label + " over " + panel.x.label; }

/// A range that is set takes the new points in, with the room beside them that it had.
void widen(plot::Axis& axis, const std::vector<double>& values) {
  if (!axis.range) return;
  auto& [low, high] = *axis.range;
  const double room = 0.05 * (high - low);
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value - room);
    high = std::max(high, value + room);
  }
}

plot::Panel& panel_of(const Overlay& over, std::vector<plot::Panel>& panels) {
  std::vector<std::string> names;
  for (plot::Panel& panel : panels) {
    if (name_of(panel) == over.panel.value) return panel;
    names.push_back(fmt::format("\"{}\"", name_of(panel)));
  }
  throw hydro::InputError(fmt::format("the picture of this fit has no panel \"{}\"", over.panel.value),
                          over.panel.place, fmt::format("its panels are {}", fmt::join(names, ", ")));
}

}  // namespace

scene::Binding<Overlay> overlay_binding(const std::string& title, const std::string& meaning) {
  return scene::Binding<Overlay>(title, meaning)
      .key(text("file", "CSV, its columns headed by name and unit, beside this one"), &Overlay::file)
      .key(text("x", "its column along the axis x of the picture"), &Overlay::x)
      .key(text("y", "its column along the other"), &Overlay::y)
      .optional(text("by",
                     "its column of which each text or number has a curve, and stands in the legend; left out: "
                     "one curve, under the name of the file"),
                &Overlay::by)
      .words(text("as", "\"marks\", or \"line\" from row to row").or_default("marks", "as points are published"),
             scene::Words<bool>{{"marks", false}, {"line", true}}, &Overlay::line);
}

scene::Binding<Overlay> panel_overlay_binding(const std::string& title, const std::string& meaning) {
  return overlay_binding(title, meaning)
      .key(text("panel", "upon which panel, as its axes have it: \"cd over KC\""), &Overlay::panel);
}

void check_overlay(const Overlay& over) {
  const CsvTable table = table_of(over);
  for (const auto* name : {&over.x, &over.y}) table.column(*name);
  names_of_rows(table, over);
}

std::vector<plot::Series> series_of(const Overlay& over, const std::string& x_unit, const std::string& y_unit,
                                    bool on_map) {
  const CsvTable table = table_of(over);
  const std::vector<double> xs = in_unit(table, over.x, x_unit), ys = in_unit(table, over.y, y_unit);
  const std::vector<std::string> names = names_of_rows(table, over);
  std::vector<plot::Series> out;
  std::vector<std::string> known;  // of this table, in the order of the legend
  for (std::size_t row = 0; row < names.size(); ++row) {
    if (row == 0 || names[row] != names[row - 1]) {
      const auto at = std::find(known.begin(), known.end(), names[row]);
      const bool dashed = on_map && (at - known.begin()) % 2 == 1, first = at == known.end();
      if (first) known.push_back(names[row]);
      out.push_back({.name = first ? names[row] : "",
                     .x = {},
                     .y = {},
                     .line = over.line,
                     .marks = !over.line,
                     .dashed = dashed,
                     .colour = on_map ? "#e00000" : ""});
    }
    out.back().x.push_back(xs[row]);
    out.back().y.push_back(ys[row]);
  }
  return out;
}

void draw_upon(const std::vector<Overlay>& overlays, std::vector<plot::Panel>& panels) {
  for (const Overlay& over : overlays) {
    plot::Panel& panel = panel_of(over, panels);
    for (plot::Series& series : series_of(over, panel.x.unit, panel.y.unit, false)) {
      widen(panel.x, series.x);
      widen(panel.y, series.y);
      panel.series.push_back(std::move(series));
    }
  }
}

}  // namespace froude
