#include "hydro/io/csv_cells.hpp"

#include <algorithm>
#include <charconv>

#include "hydro/base/units.hpp"

namespace hydro::io {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view without_sign(std::string_view number) {
  if (!number.empty() && (number.front() == '+' || number.front() == '-')) number.remove_prefix(1);
  return number;
}

std::size_t digits_at(std::string_view text, std::size_t from) {
  std::size_t n = 0;
  while (from + n < text.size() && is_digit(text[from + n])) ++n;
  return n;
}

/// The blanks of UTF-8 that group digits (no-break, narrow no-break and thin) as a plain blank.
std::string with_plain_blanks(std::string_view text) {
  std::string out(text);
  for (const std::string_view blank : {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89"})
    for (std::size_t at = 0; (at = out.find(blank, at)) != std::string::npos;) out.replace(at, blank.size(), " ");
  return out;
}

/// "2.112": a number that is the same digits with three decimals and with a group of thousands.
bool may_be_grouped(std::string_view number, std::size_t mark) {
  const std::string_view n = without_sign(number);
  const std::size_t lead = mark - (number.size() - n.size());
  return lead >= 1 && lead <= 3 && n.front() != '0' && digits_at(n, 0) == lead && digits_at(n, lead + 1) == 3 &&
         n.size() == lead + 4;
}

/// The quote that closes a cell whose text begins at `from`; npos for none.
std::size_t closing_quote(std::string_view line, std::size_t from) {
  for (std::size_t at = from; (at = line.find('"', at)) != std::string_view::npos; at += 2)
    if (at + 1 >= line.size() || line[at + 1] != '"') return at;
  return std::string_view::npos;
}

bool is_blank(char c, char separator) { return c != separator && (c == ' ' || c == '\t' || c == '\r'); }

/// Where the cell ends that begins at `from`: its separator, or the end of the line.
std::size_t end_of_cell(std::string_view line, std::size_t from, char separator) {
  if (separator == ' ') return std::min(line.find_first_of(" \t\r", from), line.size());
  return std::min(line.find(separator, from), line.size());
}

TableCell quoted_cell(const TableLine& line, std::size_t open, char separator, const std::string& file,
                      std::size_t& end) {
  const std::size_t close = closing_quote(line.text, open + 1);
  const Place place{file, line.number, static_cast<int>(open) + 1, std::string(line.text), 1};
  if (close == std::string_view::npos)
    throw InputError("the quote is not closed in its line", place,
                     "close it, or write the cell in one line; a quote within quotes is doubled");
  end = close + 1;
  while (end < line.text.size() && is_blank(line.text[end], separator)) ++end;
  if (separator != ' ' && end < line.text.size() && line.text[end] != separator)
    throw InputError("text follows on the closing quote of a cell", place,
                     "quote the whole cell; a quote within quotes is doubled");
  return {trimmed(line.text.substr(open + 1, close - open - 1)), static_cast<int>(open) + 1, true};
}

}  // namespace

std::string TableCell::plain() const {
  std::string out(text);
  if (quoted)
    for (std::size_t at = 0; (at = out.find("\"\"", at)) != std::string::npos; ++at) out.erase(at, 1);
  return out;
}

std::string_view table_text(std::string_view text, const std::string& file) {
  constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
  if (text.starts_with(utf8_mark)) text.remove_prefix(utf8_mark.size());
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw InputError("the table is encoded in UTF-16; tables are read in UTF-8", {.file = file},
                     "save it anew as \"CSV UTF-8\", or convert it: iconv -f UTF-16 -t UTF-8");
  if (const auto zero = text.substr(0, 4096).find('\0'); zero != std::string_view::npos)
    throw InputError(fmt::format("byte {} of the table is zero: it is not text in UTF-8", zero + 1), {.file = file},
                     "save it anew as \"CSV UTF-8\"; text in UTF-16 is converted by iconv -f UTF-16LE -t UTF-8");
  return text;
}

namespace {

/// Takes the next line off `rest`, whatever it holds.
std::string_view take_line(std::string_view& rest, char line_end) {
  const auto end = std::min(rest.find(line_end), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  while (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

char line_end_of(std::string_view text) { return text.find('\n') == std::string_view::npos ? '\r' : '\n'; }

}  // namespace

std::vector<TableLine> table_lines(std::string_view text, std::string_view comment_marks) {
  const char line_end = line_end_of(text);
  std::vector<TableLine> out;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text, line_end);
    const std::string_view body = trimmed(line);
    if (!body.empty() && comment_marks.find(body.front()) == std::string_view::npos) out.push_back({line, number});
  }
  return out;
}

std::string_view table_line(std::string_view text, int number) {
  const char line_end = line_end_of(text);
  std::string_view line;
  for (int i = 0; i < number; ++i) {
    if (text.empty()) return {};
    line = take_line(text, line_end);
  }
  return line;
}

std::vector<TableCell> table_cells(const TableLine& line, char separator, const std::string& file) {
  std::vector<TableCell> cells;
  const std::string_view text = line.text;
  for (std::size_t from = 0;;) {
    while (from < text.size() && is_blank(text[from], separator == ' ' ? '\0' : separator)) ++from;
    if (separator == ' ' && from == text.size()) return cells;
    std::size_t end = 0;
    if (from < text.size() && text[from] == '"') {
      cells.push_back(quoted_cell(line, from, separator, file, end));
    } else {
      end = end_of_cell(text, from, separator);
      cells.push_back({trimmed(text.substr(from, end - from)), static_cast<int>(from) + 1, false});
    }
    if (end == text.size()) return cells;
    from = end + (separator == ' ' ? 0 : 1);
  }
}

char separator_in(std::string_view line) {
  bool quoted = false;
  char best = '\0';
  constexpr std::string_view order = ",\t;";
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (!quoted && order.find(c) != std::string_view::npos && (best == '\0' || order.find(c) > order.find(best)))
      best = c;
  }
  return best;
}

bool is_unit(std::string_view text) {
  if (text.empty()) return false;
  try {
    parse_unit(text);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool is_units_row(const std::vector<TableCell>& cells) {
  bool any = false;
  for (const TableCell& cell : cells) {
    std::string_view unit = cell.text;
    const bool in_brackets =
        unit.size() > 2 && (unit.front() == '[' || unit.front() == '(') && (unit.back() == ']' || unit.back() == ')');
    if (in_brackets) unit = trimmed(unit.substr(1, unit.size() - 2));
    const bool known = unit == "px" || is_unit(unit);
    if (!known && !in_brackets && !unit.empty() && unit != "-") return false;
    any = any || known;
  }
  return any;
}

bool has_thousands_marks(std::string_view number) {
  const std::string text = with_plain_blanks(number);
  const std::string_view n = without_sign(text);
  std::size_t at = digits_at(n, 0), groups = 0;
  if (at < 1 || at > 3 || at == n.size()) return false;
  const char mark = n[at];
  if (std::string_view(".,' ").find(mark) == std::string_view::npos) return false;
  for (; at < n.size() && n[at] == mark && digits_at(n, at + 1) == 3; at += 4) ++groups;
  if (groups == 0) return false;
  if (at == n.size()) return groups > 1 || mark == '\'' || mark == ' ';
  return (n[at] == '.' || n[at] == ',') && n[at] != mark && at + 1 + digits_at(n, at + 1) == n.size();
}

InputError thousands_marks_refused(std::string_view number, std::string_view column) {
  return InputError(
      fmt::format("\"{}\" in column \"{}\" marks thousands: numbers have a decimal mark only", number, column), {},
      "write numbers without thousands marks: 1234567.8, or 1234567,8 where \";\" or tabs separate");
}

std::optional<double> NumberNotation::number(const TableCell& cell) const {
  std::string_view text = cell.text;
  std::string with_point;
  if ((separator_ != ',' || cell.quoted) && text.find('.') == std::string_view::npos)
    if (const auto comma = text.find(','); comma != std::string_view::npos) {
      with_point.assign(text);
      with_point[comma] = '.';
      text = with_point;
    }
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<InputError> NumberNotation::objection(const TableCell& cell, std::string_view column, int line) {
  const auto at = cell.text.find_first_of(".,");
  if (at == std::string_view::npos) return std::nullopt;
  const char mark = cell.text[at];
  settled_ = settled_ || !may_be_grouped(cell.text, at);
  if (mark_ == '\0') {
    mark_ = mark, first_ = cell.text, first_line_ = line;
    return std::nullopt;
  }
  if (mark == mark_) return std::nullopt;
  return InputError(
      fmt::format("\"{}\" in column \"{}\" has a {}, \"{}\" in line {} a {}: one of them may mark thousands, and the "
                  "table does not say which",
                  cell.text, column, mark == '.' ? "point" : "comma", first_, first_line_,
                  mark == '.' ? "comma" : "point"),
      {}, "write numbers without thousands marks, and all with the same decimal mark");
}

void GroupedIntegers::add(const TableCell& cell, std::size_t row) {
  const auto mark = cell.text.find_first_of(".,");
  if (mark != std::string_view::npos) {
    against_ = against_ || !may_be_grouped(cell.text, mark);
    if (!row_) row_ = row;
    return;
  }
  const std::string_view digits = without_sign(cell.text);
  const std::size_t n = digits_at(digits, 0);
  against_ = against_ || n != digits.size() || n > 3;
  has_hundreds_ = has_hundreds_ || n == 3;
}

}  // namespace hydro::io
