#pragma once
/// \file  Measurement tables as people keep them: CSV with a header that names columns and units.
///
///   # towing run 12                       comments and blank lines anywhere
///   time [s]; force [N]; speed [m/s]      units in [] or (); any column order; "," ";" or tab
///   0,000; 1,25; 0,843                    decimal comma where the separator is not a comma
///
/// Title lines may come before the header, a row of units may follow on it, cells may be quoted (RFC 4180), and empty
/// cells may end each line. Numbers have no thousands marks.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/base/units.hpp"

namespace hydro::io {

/// One table, numbers already in SI. Cells of a column whose first cell is no number are kept as text.
class CsvTable {
 public:
  /// \throws InputError with line and column: unreadable file, another encoding than UTF-8, no header, ragged row, a
  /// cell that is empty, NaN, infinite or no number, decimal points beside decimal commas, two columns of one name.
  static CsvTable read(const std::filesystem::path& path);
  static CsvTable parse(std::string_view text, const std::string& file_name);

  std::size_t rows() const { return rows_; }
  const std::string& file() const { return file_; }
  std::vector<std::string> names() const;
  bool has(std::string_view name) const;

  /// Values in SI. \throws InputError naming the nearest column if there is none, if the column is text, or its unit
  /// is missing, of another dimension, not known, or means two things ("g": grams or gravity).
  const std::vector<double>& column(std::string_view name, const Dimension& needed) const;
  /// Values in SI with the dimension that the header states (a number where it states none).
  const std::vector<double>& column(std::string_view name) const;
  /// As column(name), but as they are written where the unit is not known.
  const std::vector<double>& values(std::string_view name) const;
  bool has_known_unit(std::string_view name) const;
  const std::vector<std::string>& text_column(std::string_view name) const;
  bool is_text(std::string_view name) const { return find(name).is_text; }
  Dimension dimension(std::string_view name) const;
  /// The unit as the header has it, "" for none.
  const std::string& unit_text(std::string_view name) const;

  /// The place of a data cell, for errors that a caller finds later; the file is read again for its line.
  Place place_of(std::string_view name, std::size_t row) const;

 private:
  struct Column {
    std::string name, unit_text;
    Unit unit;
    int header_column = 0;
    bool is_text = false;
    std::vector<double> values;
    std::vector<std::string> texts;
  };
  struct Reader;
  const Column& find(std::string_view name) const;
  const Column& with_unit(std::string_view name) const;
  Place place_in_header(const Column& column) const;

  std::string file_;
  std::string header_text_;
  int header_line_ = 0;
  std::size_t rows_ = 0;
  std::vector<Column> columns_;
  std::vector<int> line_of_row_;
};

/// One column to write: values in SI, divided by the unit that the header states.
struct CsvColumn {
  std::string name;
  std::string unit;  ///< e.g. "m/s"; "" for a number
  const std::vector<double>* values;
};

/// Writes columns of equal length with 17 significant digits at most, atomically. \throws InputError
void write_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& columns,
               const std::vector<std::string>& comments = {});

}  // namespace hydro::io
