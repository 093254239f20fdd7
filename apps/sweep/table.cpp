#include "sweep/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "answers/picture.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "sweep/overlay.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

/// A field of a CSV, in quotes where it needs them.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}
std::string field(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "" : field(*text);
}
std::string header(const Column& column) {
  return field(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
}

/// Columns of the store by name.
class Columns {
 public:
  explicit Columns(const Store& store) : axes_(store.identity().axes), outputs_(store.columns()) {}

  std::size_t axis(const std::string& name) const { return static_cast<std::size_t>(at(axes_, name) - axes_.begin()); }
  const Column& of_axis(const std::string& name) const { return *at(axes_, name); }
  /// \throws hydro::InputError where no output is called so
  std::size_t output(const Located<std::string>& name) const {
    const auto found = at(outputs_, name.value);
    if (found != outputs_.end()) return static_cast<std::size_t>(found - outputs_.begin());
    std::vector<std::string> known;
    for (const Column& c : outputs_) known.push_back(c.name);
    const std::string near = hydro::nearest(name.value, known);
    throw InputError(fmt::format("[[picture]] of = \"{}\" is no column of an output", name.value), name.place,
                     near.empty() ? fmt::format("the columns are {}", fmt::join(known, ", "))
                                  : fmt::format("did you mean \"{}\"?", near));
  }
  const Column& of_output(std::size_t index) const { return outputs_[index]; }

 private:
  static std::vector<Column>::const_iterator at(const std::vector<Column>& all, const std::string& name) {
    return std::find_if(all.begin(), all.end(), [&](const Column& c) { return c.name == name; });
  }
  const std::vector<Column>& axes_;
  const std::vector<Column>& outputs_;
};

/// Means of an output over the cases at each value of one axis, or each pair of two.
struct Grid {
  std::vector<Cell> xs, ys;             ///< rising; of curves that nothing tells apart one empty y
  std::vector<std::vector<double>> of;  ///< [y][x]; NaN where no case is done
  std::size_t most = 0;                 ///< cases at one point
};

Grid grid_of(const Picture& picture, const std::vector<Row>& rows, const Columns& columns) {
  const std::size_t output = columns.output(picture.of), x = columns.axis(picture.x.value);
  const auto& second = picture.y ? picture.y : picture.by;
  std::map<Cell, std::map<Cell, std::pair<double, std::size_t>>> sums;  // by y and x
  std::map<Cell, std::size_t> xs;
  for (const Row& row : rows) {
    auto& sum = sums[second ? row.axes[columns.axis(second->value)] : Cell()][row.axes[x]];
    xs.emplace(row.axes[x], 0);
    if (row.state != State::done) continue;
    if (const auto* value = std::get_if<double>(&row.numbers[output])) sum.first += *value, ++sum.second;
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

double number(const Cell& cell) {
  const auto* value = std::get_if<double>(&cell);
  return value == nullptr ? std::numeric_limits<double>::quiet_NaN() : *value;
}
std::vector<double> numbers(const std::vector<Cell>& cells) {
  std::vector<double> out;
  for (const Cell& cell : cells) out.push_back(number(cell));
  return out;
}

/// The first column holds x; the others are headed by the second axis.
std::string csv_of(const Picture& picture, const Grid& grid, const Columns& columns) {
  const auto& second = picture.y ? picture.y : picture.by;
  const Column& of = columns.of_output(columns.output(picture.of));
  std::string out = header(columns.of_axis(picture.x.value));
  for (const Cell& y : grid.ys)
    out += "," + header({second ? fmt::format("{} at {} {}", of.name, second->value, field(y)) : of.name, of.unit});
  out += '\n';
  for (std::size_t i = 0; i < grid.xs.size(); ++i) {
    out += field(grid.xs[i]);
    for (const auto& along : grid.of) out += std::isnan(along[i]) ? "," : fmt::format(",{}", along[i]);
    out += '\n';
  }
  return out;
}

plot::Axis axis_of(const Column& column) { return {.label = column.name, .unit = column.unit}; }

std::string title_of(const Study& study, const Grid& grid) {
  const std::string name = study.title.empty() ? study.file.stem().string() : study.title;
  return grid.most < 2 ? name : fmt::format("{}: means of up to {} cases", name, grid.most);
}

plot::Figure map_of(const Study& study, const Picture& picture, const Grid& grid, const Columns& columns) {
  const Column& of = columns.of_output(columns.output(picture.of));
  const Column &x = columns.of_axis(picture.x.value), &y = columns.of_axis(picture.y->value);
  plot::Panel panel{.x = axis_of(x),
                    .y = axis_of(y),
                    .series = overlays_of(picture, x, y),
                    .field = plot::Field{axis_of(of), numbers(grid.xs), numbers(grid.ys), grid.of}};
  return {.title = title_of(study, grid), .panels = {panel}, .panel_height = 420};
}

plot::Figure curves_of(const Study& study, const Picture& picture, const Grid& grid, const Columns& columns) {
  const Column &x = columns.of_axis(picture.x.value), &y = columns.of_output(columns.output(picture.of));
  plot::Panel panel{.x = axis_of(x), .y = axis_of(y), .series = {}};
  for (std::size_t k = 0; k < grid.ys.size(); ++k) {
    std::string name;
    if (picture.by) {
      const Column& by = columns.of_axis(picture.by->value);
      const auto* value = std::get_if<double>(&grid.ys[k]);
      name = value == nullptr ? field(grid.ys[k]) : fmt::format("{} {:.6g} {}", by.name, *value, by.unit);
    }
    panel.series.push_back({.name = name, .x = numbers(grid.xs), .y = grid.of[k], .marks = true});
  }
  for (plot::Series& upon : overlays_of(picture, x, y)) panel.series.push_back(std::move(upon));
  return {.title = title_of(study, grid), .panels = {panel}};
}

/// A map of cases that are all in one row or column, as of a part of a sweep or of its first cases, is nothing to look
/// at.
bool can_be_drawn(const Picture& picture, const Grid& grid) {
  constexpr std::size_t least = 2;
  return !picture.y || (grid.xs.size() >= least && grid.ys.size() >= least);
}

}  // namespace

fs::path write_table(const Store& store) {
  std::string out = "case";
  for (const auto* all : {&store.identity().axes, &store.columns()})
    for (const Column& column : *all) out += "," + header(column);
  out += ",state,reason,warnings\n";
  for (const Row& row : store.rows()) {
    out += fmt::format("{}", row.number);
    for (const Cell& cell : row.axes) out += "," + field(cell);
    for (std::size_t i = 0; i < store.columns().size(); ++i)
      out += "," + (row.numbers.empty() ? std::string() : field(row.numbers[i]));
    out += fmt::format(",{},{},{}\n", name_of(row.state), field(row.reason), field(row.warnings));
  }
  const fs::path file = store.folder() / "table.csv";
  hydro::io::write_atomically(file, out);
  return file;
}

Pictures write_pictures(const Study& study, const Store& store) {
  Pictures out;
  if (store.columns().empty()) return out;  // no case is done, and nothing to be drawn
  const std::vector<Row> rows = store.rows();
  const Columns columns(store);
  for (const Picture& picture : study.pictures) {
    const Grid grid = grid_of(picture, rows, columns);
    if (!can_be_drawn(picture, grid)) {
      out.waiting.push_back(picture.file.value);
      continue;
    }
    const fs::path file = store.folder() / picture.file.value;
    plot::write_picture(file,
                        picture.y ? map_of(study, picture, grid, columns) : curves_of(study, picture, grid, columns));
    hydro::io::write_atomically(fs::path(file).replace_extension(".csv"), csv_of(picture, grid, columns));
    out.written.push_back(file);
  }
  return out;
}

}  // namespace froude::sweep
