#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "answers/picture.hpp"
#include "froude/result.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "sweep/csv_fields.hpp"
#include "sweep/table.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

/// \throws hydro::InputError at a name that none of the known has
void require_known(const Located<std::string>& of, const std::vector<std::string>& known, const char* what) {
  if (std::find(known.begin(), known.end(), of.value) != known.end()) return;
  const std::string near = hydro::nearest(of.value, known);
  throw InputError(
      fmt::format("[[picture]] of = \"{}\" is no {}", of.value, what), of.place,
      near.empty() ? fmt::format("there are {}", fmt::join(known, ", ")) : fmt::format("did you mean \"{}\"?", near));
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> out;
  for (const Named& one : all) out.push_back(one.name);
  return out;
}

/// Columns of the store by name.
class Columns {
 public:
  explicit Columns(const Store& store) : axes_(store.identity().axes), outputs_(store.columns()) {}

  const Column& of_axis(const std::string& name) const { return *at(axes_, name); }
  const Cell& cell(const Row& row, const std::string& axis) const {
    return row.axes[static_cast<std::size_t>(at(axes_, axis) - axes_.begin())];
  }
  /// \throws hydro::InputError where no output is called so
  const Column& of_output(const Located<std::string>& name) const {
    require_known(name, names_of(outputs_), "column of an output");
    return *at(outputs_, name.value);
  }
  const Cell& number(const Row& row, const Located<std::string>& output) const {
    return row.numbers[static_cast<std::size_t>(at(outputs_, output.value) - outputs_.begin())];
  }

 private:
  static std::vector<Column>::const_iterator at(const std::vector<Column>& all, const std::string& name) {
    return std::find_if(all.begin(), all.end(), [&](const Column& c) { return c.name == name; });
  }
  const std::vector<Column>& axes_;
  const std::vector<Column>& outputs_;
};

/// "stiffness 6390 N/m"; without a name the value alone
std::string value_text(const Column& axis, const Cell& cell, bool with_name) {
  const auto* value = std::get_if<double>(&cell);
  if (value == nullptr) return csv_field(cell);
  return fmt::format("{}{:.6g}{}{}", with_name ? axis.name + " " : "", *value, axis.unit.empty() ? "" : " ", axis.unit);
}

/// What one panel shows: an output or a signal, of cases at one value of the axis `panel`.
struct Shown {
  Located<std::string> of;
  std::optional<Cell> at;
  std::string suffix;  ///< of its label: " at 6390 N/m"

  bool has(const Picture& picture, const Row& row, const Columns& columns) const {
    return !at || columns.cell(row, picture.panel->value) == *at;
  }
};

std::vector<Shown> panels_of(const Picture& picture, const std::vector<Row>& rows, const Columns& columns) {
  std::vector<Shown> out;
  std::set<Cell> values;
  if (picture.panel)
    for (const Row& row : rows) values.insert(columns.cell(row, picture.panel->value));
  for (const auto& of : picture.of) {
    if (!picture.panel) out.push_back({of, {}, ""});
    for (const Cell& value : values)
      out.push_back({of, value, " at " + value_text(columns.of_axis(picture.panel->value), value, false)});
  }
  return out;
}

/// Means of an output over the cases at each value of one axis, or each pair of two.
struct Grid {
  std::vector<Cell> xs, ys;             ///< rising, x of all panels; of curves that nothing tells apart one empty y
  std::vector<std::vector<double>> of;  ///< [y][x]; NaN where no case is done
  std::size_t most = 0;                 ///< cases at one point
};

Grid grid_of(const Picture& picture, const Shown& shown, const std::vector<Row>& rows, const Columns& columns) {
  columns.of_output(shown.of);
  const auto& second = picture.y ? picture.y : picture.by;
  std::map<Cell, std::map<Cell, std::pair<double, std::size_t>>> sums;  // by y and x
  std::map<Cell, std::size_t> xs;
  for (const Row& row : rows) {
    const Cell& x = columns.cell(row, picture.x.value);
    xs.emplace(x, 0);
    if (!shown.has(picture, row, columns)) continue;
    auto& sum = sums[second ? columns.cell(row, second->value) : Cell()][x];
    if (row.state != State::done) continue;
    if (const auto* value = std::get_if<double>(&columns.number(row, shown.of))) sum.first += *value, ++sum.second;
  }
  Grid out;
  for (auto& [value, index] : xs) index = out.xs.size(), out.xs.push_back(value);
  for (const auto& [y, along] : sums) {
    out.ys.push_back(y);
    out.of.emplace_back(xs.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& [value, sum] : along) {
      if (sum.second > 0) out.of.back()[xs[value]] = sum.first / static_cast<double>(sum.second);
      out.most = std::max(out.most, sum.second);
    }
  }
  return out;
}

std::vector<double> numbers(const std::vector<Cell>& cells) {
  std::vector<double> out;
  for (const Cell& cell : cells) {
    const auto* value = std::get_if<double>(&cell);
    out.push_back(value == nullptr ? std::numeric_limits<double>::quiet_NaN() : *value);
  }
  return out;
}

/// The first column holds x; the others are headed by the second axis, and by what tells panels apart.
std::string csv_of(const Picture& picture, const std::vector<Shown>& panels, const std::vector<Grid>& grids,
                   const Columns& columns) {
  const auto& second = picture.y ? picture.y : picture.by;
  std::string out = csv_header(columns.of_axis(picture.x.value));
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Column& of = columns.of_output(panels[p].of);
    const std::string panel =
        panels[p].at ? fmt::format(" at {} {}", picture.panel->value, csv_field(*panels[p].at)) : "";
    for (const Cell& y : grids[p].ys)
      out += "," + csv_header({of.name + (second ? fmt::format(" at {} {}", second->value, csv_field(y)) : "") + panel,
                               of.unit});
  }
  out += '\n';
  for (std::size_t i = 0; i < grids[0].xs.size(); ++i) {
    out += csv_field(grids[0].xs[i]);
    for (const Grid& grid : grids)
      for (const auto& along : grid.of) out += std::isnan(along[i]) ? "," : fmt::format(",{}", along[i]);
    out += '\n';
  }
  return out;
}

plot::Axis axis_of(const Column& column, const std::string& suffix = "") {
  return {.label = column.name + suffix, .unit = column.unit};
}

std::string title_of(const Study& study) { return study.title.empty() ? study.file.stem().string() : study.title; }

std::vector<plot::Series> overlays_of(const Picture& picture, const std::string& x_unit, const std::string& y_unit) {
  std::vector<plot::Series> out;
  for (const Overlay& over : picture.overlays)
    for (plot::Series& series : series_of(over, x_unit, y_unit, picture.y.has_value()))
      out.push_back(std::move(series));
  return out;
}

plot::Panel map_of(const Picture& picture, const Shown& shown, const Grid& grid, const Columns& columns) {
  const Column &x = columns.of_axis(picture.x.value), &y = columns.of_axis(picture.y->value);
  return {.x = axis_of(x),
          .y = axis_of(y),
          .series = overlays_of(picture, x.unit, y.unit),
          .field = plot::Field{axis_of(columns.of_output(shown.of), shown.suffix), numbers(grid.xs), numbers(grid.ys),
                               grid.of}};
}

plot::Panel curves_of(const Picture& picture, const Shown& shown, const Grid& grid, const Columns& columns) {
  const Column &x = columns.of_axis(picture.x.value), &y = columns.of_output(shown.of);
  plot::Panel panel{.x = axis_of(x), .y = axis_of(y, shown.suffix), .series = {}};
  for (std::size_t k = 0; k < grid.ys.size(); ++k)
    panel.series.push_back({.name = picture.by ? value_text(columns.of_axis(picture.by->value), grid.ys[k], true) : "",
                            .x = numbers(grid.xs),
                            .y = grid.of[k],
                            .marks = true});
  for (plot::Series& upon : overlays_of(picture, x.unit, y.unit)) panel.series.push_back(std::move(upon));
  return panel;
}

/// A map of cases that are all in one row or column, as of a part of a sweep or of its first cases, is nothing to look
/// at.
bool can_be_drawn(const Picture& picture, const std::vector<Grid>& grids) {
  constexpr std::size_t least = 2;
  return !picture.y || std::all_of(grids.begin(), grids.end(),
                                   [](const Grid& g) { return g.xs.size() >= least && g.ys.size() >= least; });
}

/// Numbers of outputs over an axis. False where it has to wait for more cases.
bool draw_numbers(const Study& study, const Picture& picture, const std::vector<Row>& rows, const Columns& columns,
                  const fs::path& file) {
  const std::vector<Shown> panels = panels_of(picture, rows, columns);
  std::vector<Grid> grids;
  for (const Shown& shown : panels) grids.push_back(grid_of(picture, shown, rows, columns));
  if (!can_be_drawn(picture, grids)) return false;
  plot::Figure figure{.title = title_of(study), .panels = {}, .panel_height = picture.y ? 420 : 300};
  std::size_t most = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    figure.panels.push_back((picture.y ? map_of : curves_of)(picture, panels[p], grids[p], columns));
    most = std::max(most, grids[p].most);
  }
  if (most > 1) figure.title += fmt::format(": means of up to {} cases", most);
  plot::write_picture(file, figure);
  hydro::io::write_atomically(fs::path(file).replace_extension(".csv"), csv_of(picture, panels, grids, columns));
  return true;
}

/// What the legend calls a case; with its number where another case of the panel has that name.
std::string name_of_case(const Picture& picture, const Row& row, const Columns& columns, const plot::Panel& panel) {
  const std::string number = fmt::format("case {}", row.number);
  if (!picture.by) return number;
  const std::string name = value_text(columns.of_axis(picture.by->value), columns.cell(row, picture.by->value), true);
  const bool taken =
      std::any_of(panel.series.begin(), panel.series.end(), [&](const auto& s) { return s.name == name; });
  return taken ? name + ", " + number : name;
}

/// Signals of the runs that are kept, a curve for each case. False where no case has one.
bool draw_series(const Study& study, const Picture& picture, const std::vector<Row>& rows, const Columns& columns,
                 const fs::path& folder, const fs::path& file) {
  const std::vector<Shown> panels = panels_of(picture, rows, columns);
  const Column time{.name = "time", .unit = "s"};
  plot::Figure figure{.title = title_of(study), .panels = {}};
  for (const Shown& shown : panels)
    figure.panels.push_back({.x = axis_of(time), .y = {.label = shown.of.value + shown.suffix}, .series = {}});
  for (const Row& row : rows) {
    if (row.state != State::done || row.series.empty()) continue;
    const RunResult run = read_run(folder / row.series);
    for (std::size_t p = 0; p < panels.size(); ++p) {
      if (!panels[p].has(picture, row, columns)) continue;
      require_known(panels[p].of, names_of(run.signals), "signal of the runs that are kept");
      const Signal& signal = *std::find_if(run.signals.begin(), run.signals.end(),
                                           [&](const Signal& s) { return s.name == panels[p].of.value; });
      plot::Panel& panel = figure.panels[p];
      panel.y.unit = signal.units;
      panel.series.push_back({name_of_case(picture, row, columns, panel), run.time, signal.values});
    }
  }
  const auto is_empty = [](const plot::Panel& p) { return p.series.empty(); };
  if (std::all_of(figure.panels.begin(), figure.panels.end(), is_empty)) return false;
  for (plot::Series& upon : overlays_of(picture, time.unit, figure.panels[0].y.unit))
    figure.panels[0].series.push_back(std::move(upon));
  plot::write_picture(file, figure);
  return true;
}

}  // namespace

Pictures write_pictures(const Study& study, const Store& store) {
  Pictures out;
  if (store.columns().empty()) return out;  // no case is done, and nothing to be drawn
  const std::vector<Row> rows = store.rows();
  const Columns columns(store);
  for (const Picture& picture : study.pictures) {
    const fs::path file = store.folder() / picture.file.value;
    const bool drawn = is_over_time(study, picture) ? draw_series(study, picture, rows, columns, store.folder(), file)
                                                    : draw_numbers(study, picture, rows, columns, file);
    if (drawn)
      out.written.push_back(file);
    else
      out.waiting.push_back(picture.file.value);
  }
  return out;
}

}  // namespace froude::sweep
