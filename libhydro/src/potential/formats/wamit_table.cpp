#include "wamit_table.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace hydro::potential {
namespace {

/// WAMIT's header line (NUMHDR = 1) is prose with a date: it starts with a word, and most of it is words.
bool is_header(const std::vector<std::string_view>& words) {
  const auto numbers = std::count_if(words.begin(), words.end(), [](auto w) { return fortran_number(w).has_value(); });
  return !words.empty() && !fortran_number(words.front()) && 2 * static_cast<std::size_t>(numbers) < words.size();
}

}  // namespace

WamitTable WamitTable::read(const std::filesystem::path& path, const std::vector<std::size_t>& columns,
                            const std::string& layout) {
  WamitTable table;
  table.text_ = TextLines::read(path);
  for (int line = 1; line <= table.text_.count(); ++line) table.add(line, columns, layout);
  if (table.rows_.empty())
    throw InputError("the file has no rows of numbers", {.file = path.string()},
                     fmt::format("its rows should be: {}", layout));
  return table;
}

void WamitTable::add(int line, const std::vector<std::size_t>& columns, const std::string& layout) {
  const auto words = text_.words(line);
  if (words.empty() || (line == 1 && is_header(words))) return;
  Row row{.line = line, .value = {}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = fortran_number(words[i]);
    if (!value)
      throw InputError(fmt::format("\"{}\" is no number", words[i]), text_.place(line, i),
                       fmt::format("a row is: {}", layout));
    if (!std::isfinite(*value))
      throw InputError(fmt::format("\"{}\" is not finite", words[i]), text_.place(line, i),
                       "run this frequency again, or take its rows out");
    row.value.push_back(*value);
  }
  if (std::find(columns.begin(), columns.end(), words.size()) == columns.end())
    throw InputError(fmt::format("the row has {} numbers; {} are needed", words.size(), fmt::join(columns, " or ")),
                     place(row), fmt::format("a row is: {}", layout));
  rows_.push_back(std::move(row));
}

int WamitTable::mode(const Row& row, std::size_t column) const {
  const double value = row.value[column];
  constexpr double most = 1e5;
  if (!(value >= 1 && value <= most) || value != std::floor(value))
    throw InputError(fmt::format("{} is no mode number", value), place(row, column),
                     "modes count from 1: six for each body");
  return static_cast<int>(value);
}

Place WamitTable::place(const Row& row) const { return text_.place(row.line); }

Place WamitTable::place(const Row& row, std::size_t column) const { return text_.place(row.line, column); }

}  // namespace hydro::potential
