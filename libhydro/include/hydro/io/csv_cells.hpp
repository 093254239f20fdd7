#pragma once
/// \file  What all tables of text have in common: encoding, lines, cells and how numbers are written.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/base/error.hpp"

namespace hydro::io {

/// One line of a table, without its line end.
struct TableLine {
  std::string_view text;
  int number = 0;  ///< in the file, from 1
};

/// One cell, without the blanks about it and without its quotes.
struct TableCell {
  std::string_view text;  ///< quotes within a quoted cell are still doubled
  int column = 1;         ///< of its first character in the line
  bool quoted = false;

  /// The text with doubled quotes made single (RFC 4180).
  std::string plain() const;
};

/// The text without a byte order mark. \throws InputError for UTF-16 and for what is no text
std::string_view table_text(std::string_view text, const std::string& file);

/// Lines that are neither blank nor comments. Lines end with LF or CR LF; in a file without any LF, with CR.
std::vector<TableLine> table_lines(std::string_view text, std::string_view comment_marks);
/// The line of this number as it stands in `text`; "" if there is none.
std::string_view table_line(std::string_view text, int number);

/// Cells between separators; separators within quotes are part of a cell. ' ' takes any blanks as one separator.
/// \throws InputError for a quote that is not closed in its line
std::vector<TableCell> table_cells(const TableLine& line, char separator, const std::string& file);

/// ';', tab or ',', the first of these that the line has outside of quotes; '\0' for none.
char separator_in(std::string_view line);

bool is_unit(std::string_view text);

/// Whether cells under the names of columns are their units: all in brackets, known, "-" or empty, and one known.
bool is_units_row(const std::vector<TableCell>& cells);

/// Whether digits are grouped in thousands, as in "1.234.567", "1,234.5" or "1 234,5".
bool has_thousands_marks(std::string_view number);
/// The refusal of such a number.
InputError thousands_marks_refused(std::string_view number, std::string_view column);

/// How the numbers of one table are written. A decimal comma is read where a comma does not separate; what marks
/// decimals in one cell may not mark anything else in another: "0,5" beside "2.200" may be 2.2 or 2200.
class NumberNotation {
 public:
  explicit NumberNotation(char separator) : separator_(separator) {}

  /// The number in a cell, or nothing.
  std::optional<double> number(const TableCell& cell) const;
  /// Takes note of how a number is written. What is wrong with it beside those before, without a place.
  std::optional<InputError> objection(const TableCell& cell, std::string_view column, int line);
  /// Whether some number has its mark where no group of thousands could have it, as in "0.5".
  bool is_settled() const { return settled_; }

 private:
  char separator_;
  char mark_ = '\0';   ///< '.' or ',', whichever came first
  std::string first_;  ///< the number that had it
  int first_line_ = 0;
  bool settled_ = false;
};

/// Whether a column of integers seems to be grouped in thousands: "900", then "1.036", and nothing against it.
class GroupedIntegers {
 public:
  void add(const TableCell& cell, std::size_t row);
  /// A row with such a number, if the column looks like that.
  std::optional<std::size_t> row() const { return against_ || !has_hundreds_ ? std::nullopt : row_; }

 private:
  bool against_ = false, has_hundreds_ = false;
  std::optional<std::size_t> row_;
};

}  // namespace hydro::io
