#include "hydro/io/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "hydro/base/measurable.hpp"
#include "hydro/io/atomic_file.hpp"

namespace hydro::io {
namespace {

struct Cell {
  std::string_view text;
  int column = 1;  ///< of its first character in the line
};

std::vector<Cell> split(std::string_view line, char separator) {
  std::vector<Cell> cells;
  std::size_t from = 0;
  while (true) {
    const auto to = std::min(line.find(separator, from), line.size());
    const std::string_view raw = line.substr(from, to - from);
    const std::string_view cell = trimmed(raw);
    const auto lead = cell.empty() ? 0 : static_cast<std::size_t>(cell.data() - raw.data());
    cells.push_back({cell, static_cast<int>(from + lead) + 1});
    if (to == line.size()) return cells;
    from = to + 1;
  }
}

char separator_of(std::string_view header) {
  if (header.find(';') != std::string_view::npos) return ';';
  if (header.find('\t') != std::string_view::npos) return '\t';
  return ',';
}

/// The number in a cell, or nothing; a comma is the decimal sign where it cannot separate.
std::optional<double> number(std::string_view cell, char separator) {
  std::string with_point;
  if (separator != ',' && cell.find(',') != std::string_view::npos && cell.find('.') == std::string_view::npos) {
    with_point.assign(cell);
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    cell = with_point;
  }
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (code != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

/// Accelerometers are read in multiples of gravity, balances in grams, and both write g. \throws InputError
void refuse_ambiguous(const std::string& unit, const Place& place) {
  if (unit == "g" || unit == "mg")
    throw InputError(fmt::format("the unit \"{0}\" may be {1} or {2}the standard gravity", unit,
                                 unit == "g" ? "grams" : "milligrams", unit == "g" ? "" : "thousandths of "),
                     place,
                     unit == "g" ? "write [gn] for an acceleration in multiples of 9.80665 m/s^2, or a mass in [kg]"
                                 : "write an acceleration in [m/s^2] or [gn], or a mass in [kg]");
}

struct Line {
  std::string_view text;
  int number = 0;
};

/// Takes the next line that is neither blank nor a comment off `rest`.
std::optional<Line> next_line(std::string_view& rest, int& line_number) {
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++line_number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string_view body = trimmed(line);
    if (!body.empty() && body.front() != '#') return Line{line, line_number};
  }
  return std::nullopt;
}

/// A line of a file that was read before, as errors show it: tables keep numbers, not their text. "" where the file is
/// no longer there, or never was.
std::string line_of_file(const std::string& file, int number) {
  std::ifstream in(file);
  std::string line;
  for (int i = 0; i < number; ++i)
    if (!std::getline(in, line)) return {};
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& path) { return parse(read_text(path), path.string()); }

CsvTable CsvTable::parse(std::string_view text, const std::string& file_name) {
  CsvTable table;
  table.file_ = file_name;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  int line_number = 0;
  const auto header = next_line(text, line_number);
  if (!header)
    throw InputError("the table is empty", {.file = file_name},
                     "the first line names the columns: time [s], force [N]");
  table.header_text_ = header->text;
  table.header_line_ = header->number;
  const char separator = separator_of(header->text);
  const auto place = [&](const Line& line, const Cell& cell) {
    return Place{file_name, line.number, cell.column, std::string(line.text), static_cast<int>(cell.text.size())};
  };
  for (const Cell& cell : split(header->text, separator)) {
    Column column;
    column.header_column = cell.column;
    const auto open = cell.text.find_first_of("[(");
    column.name = trimmed(cell.text.substr(0, open));
    if (open != std::string_view::npos) {
      const auto close = cell.text.find_first_of("])", open);
      if (close == std::string_view::npos) throw InputError("the unit has no closing bracket", place(*header, cell));
      column.unit_text = trimmed(cell.text.substr(open + 1, close - open - 1));
      refuse_ambiguous(column.unit_text, place(*header, cell));
      try {
        column.unit = parse_unit(column.unit_text);
      } catch (const InputError& e) {
        throw e.at(place(*header, cell));
      }
    }
    if (number(column.name, separator) || column.name.empty())
      throw InputError(fmt::format("\"{}\" is no column name", cell.text), place(*header, cell),
                       "the first line must name the columns: time [s], force [N]");
    for (const Column& other : table.columns_)
      if (other.name == column.name)
        throw InputError(fmt::format("two columns have the name \"{}\"", column.name), place(*header, cell));
    table.columns_.push_back(std::move(column));
  }
  while (const auto line = next_line(text, line_number)) {
    const auto cells = split(line->text, separator);
    if (cells.size() != table.columns_.size())
      throw InputError(
          fmt::format("the row has {} {}, the header names {} {}", cells.size(), cells.size() == 1 ? "cell" : "cells",
                      table.columns_.size(), table.columns_.size() == 1 ? "column" : "columns"),
          {file_name, line->number, 0, std::string(line->text), 0});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Column& column = table.columns_[i];
      const auto value = number(cells[i].text, separator);
      if (table.rows_ == 0) column.is_text = !value && !cells[i].text.empty();
      if (column.is_text) {
        column.texts.emplace_back(cells[i].text);
        continue;
      }
      if (!value)
        throw InputError(cells[i].text.empty()
                             ? fmt::format("a value of \"{}\" is missing", column.name)
                             : fmt::format("\"{}\" in column \"{}\" is not a number", cells[i].text, column.name),
                         place(*line, cells[i]), "every row needs a number here; leave out rows without data");
      if (!std::isfinite(*value))
        throw InputError(fmt::format("\"{}\" in column \"{}\" is not a finite number", cells[i].text, column.name),
                         place(*line, cells[i]), "leave out rows without data");
      const double si = *value * column.unit.factor;
      // What is too small is rounding of somebody's sums, and as good as zero.
      if (std::abs(si) > 1 && !is_measurable(si))
        throw InputError(
            fmt::format("\"{}\" in column \"{}\" is beyond what is computed with: sizes reach to 1e30 in SI",
                        cells[i].text, column.name),
            place(*line, cells[i]), "look at the exponent and at the unit");
      column.values.push_back(si);
    }
    table.line_of_row_.push_back(line->number);
    ++table.rows_;
  }
  return table;
}

std::vector<std::string> CsvTable::names() const {
  std::vector<std::string> out;
  std::transform(columns_.begin(), columns_.end(), std::back_inserter(out), [](const Column& c) { return c.name; });
  return out;
}

bool CsvTable::has(std::string_view name) const {
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
}

const CsvTable::Column& CsvTable::find(std::string_view name) const {
  for (const Column& column : columns_)
    if (column.name == name) return column;
  const std::string near = nearest(name, names());
  throw InputError(fmt::format("there is no column \"{}\"", name), {file_, header_line_, 0, header_text_, 0},
                   near.empty() ? fmt::format("columns are: {}", fmt::join(names(), ", "))
                                : fmt::format("did you mean \"{}\"?", near));
}

const std::vector<double>& CsvTable::column(std::string_view name) const {
  const Column& c = find(name);
  if (c.is_text) throw InputError(fmt::format("column \"{}\" holds text; numbers are needed", name), place_of(name, 0));
  return c.values;
}

const std::vector<double>& CsvTable::column(std::string_view name, const Dimension& needed) const {
  const Column& c = find(name);
  if (!compatible(c.unit.dimension, needed))
    throw InputError(c.unit_text.empty() ? fmt::format("column \"{}\" has no unit; {} is needed", name, needed.name())
                                         : fmt::format("column \"{}\" is {}; {} is needed", name,
                                                       c.unit.dimension.name(), needed.name()),
                     {file_, header_line_, c.header_column, header_text_, static_cast<int>(c.name.size())},
                     fmt::format("name the unit in the header: {} [{}]", name, needed.si()));
  return column(name);
}

const std::vector<std::string>& CsvTable::text_column(std::string_view name) const {
  const Column& c = find(name);
  if (!c.is_text) throw InputError(fmt::format("column \"{}\" holds numbers; text is needed", name), place_of(name, 0));
  return c.texts;
}

Dimension CsvTable::dimension(std::string_view name) const { return find(name).unit.dimension; }
const std::string& CsvTable::unit_text(std::string_view name) const { return find(name).unit_text; }

Place CsvTable::place_of(std::string_view name, std::size_t row) const {
  const Column& c = find(name);
  if (row >= rows_) return {file_, header_line_, c.header_column, header_text_, static_cast<int>(c.name.size())};
  const int number = line_of_row_[row];
  const std::string line = line_of_file(file_, number);
  const auto index = static_cast<std::size_t>(&c - columns_.data());
  const auto cells = split(line, separator_of(header_text_));
  if (index >= cells.size()) return {file_, number, 0, {}, 0};
  return {file_, number, cells[index].column, line, static_cast<int>(cells[index].text.size())};
}

void write_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& columns,
               const std::vector<std::string>& comments) {
  fmt::memory_buffer out;
  for (const auto& comment : comments) fmt::format_to(std::back_inserter(out), "# {}\n", comment);
  std::vector<double> factors;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const CsvColumn& c = columns[i];
    if (i > 0) ensure(c.values->size() == rows, "write_csv: columns of unequal length");
    rows = c.values->size();
    factors.push_back(parse_unit(c.unit).factor);
    fmt::format_to(std::back_inserter(out), "{}{}{}", i ? "," : "", c.name, c.unit.empty() ? "" : " [" + c.unit + "]");
  }
  out.push_back('\n');
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      fmt::format_to(std::back_inserter(out), "{}{}", i ? "," : "", (*columns[i].values)[row] / factors[i]);
    out.push_back('\n');
  }
  write_atomically(path, std::string_view(out.data(), out.size()));
}

}  // namespace hydro::io
