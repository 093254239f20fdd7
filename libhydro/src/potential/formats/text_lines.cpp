#include "text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hydro/io/atomic_file.hpp"

namespace hydro::potential {
namespace {

constexpr std::string_view blanks = " \t\r";

int as_whole(double value, const Place& place, const std::string& what, int least) {
  constexpr double most = 1e6;
  if (!(value >= least && value <= most) || value != std::floor(value))
    throw InputError(fmt::format("{} must be a whole number of at least {}, got {}", what, least, value), place);
  return static_cast<int>(value);
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.size(), line.find_first_of(blanks, at));
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

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

TextLines TextLines::read(const std::filesystem::path& path) {
  TextLines out;
  out.path_ = path;
  const std::string text = io::read_text(path);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.size(), text.find('\n', at));
    std::string line = text.substr(at, end - at);
    while (!line.empty() && line.back() == '\r') line.pop_back();
    out.lines_.push_back(std::move(line));
    at = end + 1;
  }
  return out;
}

int TextLines::find(std::string_view text, int from) const {
  for (int n = from; n <= count(); ++n)
    if (contains(n, text)) return n;
  return 0;
}

double TextLines::number(int number, std::size_t word, const std::string& what) const {
  if (number > count()) refuse_end(what);
  const auto all = words(number);
  if (word >= all.size())
    throw InputError(fmt::format("{} is missing at the end of the line", what), place(number),
                     "the file may be cut short");
  const auto value = fortran_number(all[word]);
  if (!value) throw InputError(fmt::format("\"{}\" is no number; {} is needed", all[word], what), place(number, word));
  if (!std::isfinite(*value))
    throw InputError(fmt::format("{} is \"{}\", which is not finite", what, all[word]), place(number, word),
                     "run this case again, or take it out");
  return *value;
}

int TextLines::whole(int number, std::size_t word, const std::string& what, int least) const {
  const double value = this->number(number, word, what);  // before the place, which a line beyond the end has none of
  return as_whole(value, place(number, word), what, least);
}

std::vector<double> TextLines::numbers(int number, std::size_t count, const std::string& what) const {
  std::vector<double> out;
  for (std::size_t word = 0; word < count; ++word) out.push_back(this->number(number, word, what));
  return out;
}

Place TextLines::place(int number) const { return {.file = path_.string(), .line = number, .text = line(number)}; }

Place TextLines::place(int number, std::size_t word) const {
  const std::string& text = line(number);
  const auto all = words_of(text);
  Place where{.file = path_.string(), .line = number, .text = text};
  if (word < all.size()) {
    where.column = static_cast<int>(all[word].data() - text.data()) + 1;
    where.width = static_cast<int>(all[word].size());
  }
  return where;
}

void TextLines::refuse(int number, const std::string& rule, const std::string& remedy) const {
  throw InputError(rule, place(number), remedy);
}

void TextLines::refuse_end(const std::string& what) const {
  throw InputError(fmt::format("the file ends before {}", what), {.file = path_.string(), .line = count()},
                   "the file may be cut short");
}

void NumberStream::skip_to_word() {
  while (line_ <= text_.count() && word_ >= text_.words(line_).size()) {
    ++line_;
    word_ = 0;
  }
}

double NumberStream::next(const std::string& what) {
  skip_to_word();
  if (line_ > text_.count()) text_.refuse_end(what);
  last_line_ = line_;
  last_word_ = word_++;
  return text_.number(last_line_, last_word_, what);
}

int NumberStream::next_whole(const std::string& what, int least) {
  const double value = next(what);
  return as_whole(value, place_of_last(), what, least);
}

bool NumberStream::at_end_of_numbers() {
  skip_to_word();
  return line_ > text_.count() || !fortran_number(text_.words(line_)[word_]);
}

int NumberStream::line() {
  skip_to_word();
  return line_;
}

}  // namespace hydro::potential
