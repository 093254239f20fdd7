#include "hydro/io/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <tuple>

#include "hydro/base/measurable.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv_cells.hpp"

namespace hydro::io {
namespace {

constexpr std::string_view comment_marks = "#";

/// Accelerometers are read in multiples of gravity, balances in grams, and both write g.
bool is_ambiguous(const std::string& unit) { return unit == "g" || unit == "mg"; }

/// \throws InputError
void refuse_ambiguous(const std::string& unit, const Place& place) {
  if (is_ambiguous(unit))
    throw InputError(fmt::format("the unit \"{0}\" may be {1} or {2}the standard gravity", unit,
                                 unit == "g" ? "grams" : "milligrams", unit == "g" ? "" : "thousandths of "),
                     place,
                     unit == "g" ? "write [gn] for an acceleration in multiples of 9.80665 m/s^2, or a mass in [kg]"
                                 : "write an acceleration in [m/s^2] or [gn], or a mass in [kg]");
}

/// \throws InputError for a unit that is not known, or that means two things
void judge_unit(const std::string& text, const Place& place) {
  refuse_ambiguous(text, place);
  if (text.find_first_of("[(") != std::string::npos) throw InputError("the unit has no closing bracket", place);
  try {
    parse_unit(text);
  } catch (const InputError& e) {
    throw e.at(place);
  }
}

Place place_in(const std::string& file, const TableLine& line, const TableCell& cell) {
  return {file, line.number, cell.column, std::string(line.text), static_cast<int>(cell.text.size())};
}

/// "force [N]" as a name and a unit, whose opening bracket stays where none closes it.
std::pair<std::string, std::string> name_and_unit(const TableCell& cell) {
  const std::string text = cell.plain();
  const auto open = text.find_first_of("[(");
  std::pair<std::string, std::string> out{trimmed(std::string_view(text).substr(0, open)), ""};
  if (open == std::string::npos) return out;
  const auto close = text.find_first_of("])", open);
  out.second = close == std::string::npos ? text.substr(open)
                                          : trimmed(std::string_view(text).substr(open + 1, close - open - 1));
  return out;
}

using Cells = std::vector<TableCell>;

std::size_t named(const Cells& cells) {
  std::size_t n = cells.size();
  while (n > 0 && cells[n - 1].text.empty()) --n;
  return n;
}

/// Which of the first lines names the columns, and whether units follow on it.
struct Header {
  std::size_t line = 0;
  bool units_follow = false;
};

/// Looks for the header among the first lines of a table: what comes before it are titles.
class HeaderSearch {
 public:
  HeaderSearch(const std::vector<TableLine>& lines, char separator, const std::string& file) : notation_(separator) {
    constexpr std::size_t most_titles = 50;
    for (std::size_t i = 0; i < std::min(most_titles, lines.size()); ++i)
      first_.push_back(table_cells(lines[i], separator, file));
    last_ = table_cells(lines.back(), separator, file);
  }

  /// The first line, unless those after it tell otherwise.
  Header found() const {
    std::size_t row = 0;
    while (row < first_.size() && !(is_full(first_[row]) && has_number(first_[row]))) ++row;
    if (row == 0 || row == first_.size()) return {};
    if (row >= 2 && is_units_row(first_[row - 1]) && is_full(first_[row - 2]) && !has_units(first_[row - 2]))
      return {row - 2, true};
    const auto end = first_.begin() + static_cast<std::ptrdiff_t>(row) - 1;
    const bool titles = std::none_of(first_.begin(), end, [&](const Cells& c) { return is_full(c); }) ||
                        (has_units(*end) && std::none_of(first_.begin(), end, has_units));
    return {titles && is_full(*end) ? row - 1 : 0, false};
  }

 private:
  bool is_full(const Cells& cells) const { return cells.size() == last_.size() || named(cells) == named(last_); }
  bool has_number(const Cells& cells) const {
    return std::any_of(cells.begin(), cells.end(), [&](const TableCell& c) { return notation_.number(c).has_value(); });
  }
  static bool has_units(const Cells& cells) {
    return std::any_of(cells.begin(), cells.end(), [](const TableCell& c) {
      const std::string unit = name_and_unit(c).second;
      return !unit.empty() && is_units_row({{unit, 1, false}});
    });
  }

  NumberNotation notation_;
  std::vector<Cells> first_;
  Cells last_;
};

/// What separates cells in the last line as in the first one, where that is no title.
char separator_of(const std::vector<TableLine>& lines) {
  if (lines.empty()) return ',';
  const char first = separator_in(lines.front().text), last = separator_in(lines.back().text);
  if (first != '\0' && (last == '\0' || lines.back().text.find(first) != std::string_view::npos)) return first;
  return last == '\0' ? ',' : last;
}

}  // namespace

/// Reads one table, line by line.
struct CsvTable::Reader {
  CsvTable& table;
  char separator;
  NumberNotation notation;
  std::vector<GroupedIntegers> grouped;

  void name_columns(const TableLine& line) {
    auto cells = table_cells(line, separator, table.file_);
    if (const std::size_t n = named(cells); n > 0) cells.resize(n);
    for (const TableCell& cell : cells) {
      Column column;
      column.header_column = cell.column;
      std::tie(column.name, column.unit_text) = name_and_unit(cell);
      if (notation.number(cell) || column.name.empty())
        throw InputError(fmt::format("\"{}\" is no column name", cell.text), place_in(table.file_, line, cell),
                         "the first line must name the columns: time [s], force [N]");
      if (table.has(column.name))
        throw InputError(fmt::format("two columns have the name \"{}\"", column.name),
                         place_in(table.file_, line, cell));
      table.columns_.push_back(std::move(column));
    }
    grouped.resize(table.columns_.size());
  }

  void take_units(const TableLine& line) {
    const auto cells = table_cells(line, separator, table.file_);
    for (std::size_t i = 0; i < std::min(cells.size(), table.columns_.size()); ++i) {
      std::string_view unit = cells[i].text;
      if (unit.starts_with('[') || unit.starts_with('(')) unit = trimmed(unit.substr(1, unit.size() - 2));
      table.columns_[i].unit_text = unit == "-" ? "" : unit;
    }
  }

  /// Units of columns that nobody asks for may be what they are.
  void judge_units() {
    for (Column& c : table.columns_)
      if (table.has_known_unit(c.name)) c.unit = parse_unit(c.unit_text);
  }

  /// Cells beyond the last column are empty where a separator ends each line, as spreadsheets write them.
  void require_width(const Cells& cells, const TableLine& line) const {
    const std::size_t columns = table.columns_.size();
    if (cells.size() >= columns && named(cells) <= columns) return;
    const bool commas = separator == ',' && columns > 1 && cells.size() == 2 * columns;
    throw InputError(fmt::format("the row has {} {}, the header names {} {}", cells.size(),
                                 cells.size() == 1 ? "cell" : "cells", columns, columns == 1 ? "column" : "columns"),
                     {table.file_, line.number, 0, std::string(line.text), 0},
                     commas ? "numbers with a decimal comma need \";\" or tabs between them, or quotes" : "");
  }

  void take_row(const TableLine& line, std::size_t index) {
    const auto cells = table_cells(line, separator, table.file_);
    if (cells.size() > 1 && named(cells) == 0) return;  // a blank row of a spreadsheet
    require_width(cells, line);
    for (std::size_t i = 0; i < table.columns_.size(); ++i) {
      Column& column = table.columns_[i];
      if (table.rows_ == 0) column.is_text = !cells[i].text.empty() && !notation.number(cells[i]);
      if (column.is_text)
        column.texts.push_back(cells[i].plain());
      else
        column.values.push_back(value(column, grouped[i], index, line, cells[i]));
    }
    table.line_of_row_.push_back(line.number);
    ++table.rows_;
  }

  /// In SI.
  double value(const Column& column, GroupedIntegers& integers, std::size_t index, const TableLine& line,
               const TableCell& cell) {
    const auto place = [&] { return place_in(table.file_, line, cell); };
    const auto number = notation.number(cell);
    if (!number && has_thousands_marks(cell.text)) throw thousands_marks_refused(cell.text, column.name).at(place());
    if (!number)
      throw InputError(cell.text.empty()
                           ? fmt::format("a value of \"{}\" is missing", column.name)
                           : fmt::format("\"{}\" in column \"{}\" is not a number", cell.text, column.name),
                       place(), "every row needs a number here; leave out rows without data");
    if (!std::isfinite(*number))
      throw InputError(fmt::format("\"{}\" in column \"{}\" is not a finite number", cell.text, column.name), place(),
                       "leave out rows without data");
    if (const auto wrong = notation.objection(cell, column.name, line.number)) throw wrong->at(place());
    if (separator != ',' || cell.quoted) integers.add(cell, index);
    const double si = *number * column.unit.factor;
    // What is too small is rounding of somebody's sums, and as good as zero.
    if (std::abs(si) > 1 && !is_measurable(si))
      throw InputError(fmt::format("\"{}\" in column \"{}\" is beyond what is computed with: sizes reach to 1e30 in SI",
                                   cell.text, column.name),
                       place(), "look at the exponent and at the unit");
    return si;
  }

  /// "900" and "1.036" where no other number says what a mark means.
  void refuse_grouped(const std::vector<TableLine>& rows) const {
    for (std::size_t i = 0; i < grouped.size() && !notation.is_settled(); ++i)
      if (const auto row = grouped[i].row())
        throw InputError(
            fmt::format(
                "column \"{}\" has integers of three digits, and here three digits after a mark, which may mark "
                "decimals or thousands",
                table.columns_[i].name),
            place_in(table.file_, rows[*row], table_cells(rows[*row], separator, table.file_)[i]),
            "write numbers without thousands marks, and decimals of the others too: 900.000 beside 1.036");
  }
};

CsvTable CsvTable::read(const std::filesystem::path& path) { return parse(read_text(path), path.string()); }

CsvTable CsvTable::parse(std::string_view text, const std::string& file_name) {
  const auto lines = table_lines(table_text(text, file_name), comment_marks);
  if (lines.empty())
    throw InputError("the table is empty", {.file = file_name},
                     "the first line names the columns: time [s], force [N]");
  CsvTable table;
  table.file_ = file_name;
  const char separator = separator_of(lines);
  const Header header = HeaderSearch(lines, separator, file_name).found();
  table.header_line_ = lines[header.line].number;
  table.header_text_ = lines[header.line].text;
  Reader reader{table, separator, NumberNotation(separator), {}};
  reader.name_columns(lines[header.line]);
  if (header.units_follow) reader.take_units(lines[header.line + 1]);
  reader.judge_units();
  for (std::size_t i = header.line + (header.units_follow ? 2 : 1); i < lines.size(); ++i) reader.take_row(lines[i], i);
  reader.refuse_grouped(lines);
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

const CsvTable::Column& CsvTable::with_unit(std::string_view name) const {
  const Column& c = find(name);
  if (!has_known_unit(name)) judge_unit(c.unit_text, place_in_header(c));
  return c;
}

bool CsvTable::has_known_unit(std::string_view name) const {
  const std::string& unit = find(name).unit_text;
  return unit.empty() || (!is_ambiguous(unit) && is_unit(unit));
}

Place CsvTable::place_in_header(const Column& column) const {
  return {file_, header_line_, column.header_column, header_text_, static_cast<int>(column.name.size())};
}

const std::vector<double>& CsvTable::values(std::string_view name) const {
  const Column& c = find(name);
  if (c.is_text && has_thousands_marks(c.texts.front()))
    throw thousands_marks_refused(c.texts.front(), name).at(place_of(name, 0));
  if (c.is_text)
    throw InputError(fmt::format("column \"{}\" holds text; numbers are needed", name), place_of(name, 0),
                     columns_.size() == 1 ? "separate columns by commas, semicolons or tabs, not by blanks" : "");
  return c.values;
}

const std::vector<double>& CsvTable::column(std::string_view name) const {
  with_unit(name);
  return values(name);
}

const std::vector<double>& CsvTable::column(std::string_view name, const Dimension& needed) const {
  const Column& c = with_unit(name);
  if (!compatible(c.unit.dimension, needed))
    throw InputError(c.unit_text.empty() ? fmt::format("column \"{}\" has no unit; {} is needed", name, needed.name())
                                         : fmt::format("column \"{}\" is {}; {} is needed", name,
                                                       c.unit.dimension.name(), needed.name()),
                     place_in_header(c), fmt::format("name the unit in the header: {} [{}]", name, needed.si()));
  return values(name);
}

const std::vector<std::string>& CsvTable::text_column(std::string_view name) const {
  const Column& c = find(name);
  if (!c.is_text) throw InputError(fmt::format("column \"{}\" holds numbers; text is needed", name), place_of(name, 0));
  return c.texts;
}

Dimension CsvTable::dimension(std::string_view name) const { return with_unit(name).unit.dimension; }
const std::string& CsvTable::unit_text(std::string_view name) const { return find(name).unit_text; }

Place CsvTable::place_of(std::string_view name, std::size_t row) const {
  const Column& c = find(name);
  if (row >= rows_) return place_in_header(c);
  const int number = line_of_row_[row];
  // Tables keep numbers, not their text; the file may be no longer there, or never was.
  std::error_code none;
  const std::string text = std::filesystem::is_regular_file(file_, none) ? read_text(file_) : std::string();
  const TableLine line{table_line(text, number), number};
  if (line.text.empty()) return {file_, number, 0, {}, 0};
  const auto index = static_cast<std::size_t>(&c - columns_.data());
  const auto cells = table_cells(line, separator_of(table_lines(text, comment_marks)), file_);
  if (index >= cells.size()) return {file_, number, 0, {}, 0};
  return place_in(file_, line, cells[index]);
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
