#include "sweep/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "scene/placed.hpp"

namespace froude::sweep {
namespace {

using hydro::io::CsvTable;

CsvTable table_of(const Overlay& over) {
  return scene::placed(over.file.place, [&] { return CsvTable::read(over.file.value); });
}

/// A column in the unit of an axis.
std::vector<double> in_unit(const CsvTable& table, const std::string& name, const Column& axis) {
  const hydro::Unit unit = axis.unit.empty() ? hydro::Unit() : hydro::parse_unit(axis.unit);
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

void add_overlay(const Overlay& over, const Column& x, const Column& y, bool on_map, std::vector<plot::Series>& out) {
  const CsvTable table = table_of(over);
  const std::vector<double> xs = in_unit(table, over.x, x), ys = in_unit(table, over.y, y);
  const std::vector<std::string> names = names_of_rows(table, over);
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
}

}  // namespace

void check_overlays(const Picture& picture) {
  for (const Overlay& over : picture.overlays) {
    const CsvTable table = table_of(over);
    for (const auto* name : {&over.x, &over.y}) table.column(*name);
    names_of_rows(table, over);
  }
}

std::vector<plot::Series> overlays_of(const Picture& picture, const Column& x, const Column& y) {
  std::vector<plot::Series> out;
  for (const Overlay& over : picture.overlays) add_overlay(over, x, y, picture.y.has_value(), out);
  return out;
}

}  // namespace froude::sweep
