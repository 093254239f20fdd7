#pragma once
/// \file  Private: a WAMIT numeric file as rows of numbers that know where they stand.
#include <filesystem>
#include <string>
#include <vector>

#include "hydro/base/error.hpp"
#include "text_lines.hpp"

namespace hydro::potential {

/// A whitespace-separated table of numbers with at most one header line, which is told from data by its words.
class WamitTable {
 public:
  struct Row {
    int line;
    std::vector<double> value;
  };

  /// `columns`: how many numbers a row may have, e.g. {4, 5}; `layout` names them for messages: "PER I J A B".
  /// \throws InputError with line and column: unreadable file, a word that is no finite number, a row of another
  /// length, no rows at all
  static WamitTable read(const std::filesystem::path& path, const std::vector<std::size_t>& columns,
                         const std::string& layout);

  const std::vector<Row>& rows() const { return rows_; }
  const std::filesystem::path& path() const { return text_.path(); }

  /// A mode number, 1 or more, in this column. \throws InputError
  int mode(const Row& row, std::size_t column) const;

  /// The line of a row, with the word of `column` marked.
  Place place(const Row& row, std::size_t column) const;
  Place text_place(int line) const { return text_.place(line); }
  Place place(const Row& row) const;

 private:
  void add(int line, const std::vector<std::size_t>& columns, const std::string& layout);

  TextLines text_;
  std::vector<Row> rows_;
};

}  // namespace hydro::potential
