#include "wamit_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "hydro/io/atomic_file.hpp"

namespace hydro::potential {
namespace {

constexpr std::string_view blanks = " \t\r";

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.size(), line.find_first_of(blanks, at));
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

/// A number as Fortran writes it: a leading plus, and D for the exponent, are allowed; NaN and infinity come through.
std::optional<double> fortran_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  std::string text(word);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // A number too small for a double is an honest zero of a solver's noise; one too large is not a number here.
  const bool is_tiny = text.find("e-") != std::string::npos || text.find("E-") != std::string::npos;
  if (error == std::errc::result_out_of_range && is_tiny) {
    value = 0;
  } else if (error != std::errc()) {
    return std::nullopt;
  }
  if (end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// WAMIT's header line (NUMHDR = 1) is prose with a date: it starts with a word, and most of it is words.
bool is_header(const std::vector<std::string_view>& words) {
  const auto numbers = std::count_if(words.begin(), words.end(), [](auto w) { return fortran_number(w).has_value(); });
  return !words.empty() && !fortran_number(words.front()) && 2 * static_cast<std::size_t>(numbers) < words.size();
}

}  // namespace

WamitTable WamitTable::read(const std::filesystem::path& path, const std::vector<std::size_t>& columns,
                            const std::string& layout) {
  WamitTable table;
  table.path_ = path;
  const std::string text = io::read_text(path);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.size(), text.find('\n', at));
    std::string line = text.substr(at, end - at);
    while (!line.empty() && line.back() == '\r') line.pop_back();
    table.lines_.push_back(std::move(line));
    at = end + 1;
  }
  for (int line = 1; line <= static_cast<int>(table.lines_.size()); ++line) table.add(line, columns, layout);
  if (table.rows_.empty())
    throw InputError("the file has no rows of numbers", {.file = path.string()},
                     fmt::format("its rows should be: {}", layout));
  return table;
}

void WamitTable::add(int line, const std::vector<std::size_t>& columns, const std::string& layout) {
  const auto words = words_of(lines_[static_cast<std::size_t>(line - 1)]);
  if (words.empty() || (line == 1 && is_header(words))) return;
  Row row{.line = line, .value = {}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = fortran_number(words[i]);
    if (!value)
      throw InputError(fmt::format("\"{}\" is no number", words[i]), place_of_word(line, i),
                       fmt::format("a row is: {}", layout));
    if (!std::isfinite(*value))
      throw InputError(fmt::format("\"{}\" is not finite", words[i]), place_of_word(line, i),
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

Place WamitTable::place(const Row& row) const {
  return {.file = path_.string(), .line = row.line, .text = lines_[static_cast<std::size_t>(row.line - 1)]};
}

Place WamitTable::place(const Row& row, std::size_t column) const { return place_of_word(row.line, column); }

Place WamitTable::place_of_word(int line, std::size_t word) const {
  const std::string& text = lines_[static_cast<std::size_t>(line - 1)];
  const auto words = words_of(text);
  Place where{.file = path_.string(), .line = line, .text = text};
  if (word < words.size()) {
    where.column = static_cast<int>(words[word].data() - text.data()) + 1;
    where.width = static_cast<int>(words[word].size());
  }
  return where;
}

}  // namespace hydro::potential
