#include "scene/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

namespace froude::scene {
namespace {

using hydro::Place;

/// The lines of the file, to quote from.
class Lines {
 public:
  Lines(std::string_view text, std::string file) : file_(std::move(file)) {
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t to = std::min(text.find('\n', from), text.size());
      std::string_view line = text.substr(from, to - from);
      if (line.ends_with('\r')) line.remove_suffix(1);
      lines_.emplace_back(line);
      from = to + 1;
    }
  }

  /// The TOML library counts lines and columns from 1, columns in code points: what a person counts in an editor.
  Place place(const toml::source_region& region) const {
    const int line = std::clamp(static_cast<int>(region.begin.line), 1, static_cast<int>(lines_.size()));
    const std::string& text = lines_[static_cast<std::size_t>(line - 1)];
    const int column = std::max(1, static_cast<int>(region.begin.column));
    const int end = region.end.line == region.begin.line ? static_cast<int>(region.end.column) : characters(text) + 1;
    return {.file = file_, .line = line, .column = column, .text = text, .width = std::max(1, end - column)};
  }

  /// The characters that a place marks.
  static std::string marked(const Place& place) {
    const std::size_t from = byte_of(place.text, place.column - 1);
    return place.text.substr(from, byte_of(place.text, place.column - 1 + place.width) - from);
  }

 private:
  static bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }
  static int characters(std::string_view text) {
    return static_cast<int>(std::count_if(text.begin(), text.end(), begins_character));
  }
  static std::size_t byte_of(std::string_view text, int character) {
    std::size_t i = 0;
    for (int seen = -1; i < text.size(); ++i)
      if (begins_character(text[i]) && ++seen == character) break;
    return i;
  }

  std::string file_;
  std::vector<std::string> lines_;
};

/// Looks over a text before it is parsed: what follows works by recursion, one call a level, and keeps of every value
/// the line in which it stands.
class TextLayout {
 public:
  TextLayout(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  /// \throws InputError for a line that is too long, or a key or value that is nested too deeply
  void check() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'')) skip_string();
      if (at_ < text_.size()) count(text_[at_++]);
    }
    require_line(text_.size());
  }

 private:
  /// Scenes use five levels, [body.hydrodynamics.radiation] and a table in it.
  static constexpr int deepest = 64;
  /// A list in one line of this length, a few thousand values each with its line, takes some ten megabytes.
  static constexpr std::size_t longest = 10'000;

  void count(char c) {
    if (c == '\n') {
      require_line(at_ - 1);
      line_from_ = at_;
      ++line_;
      dots_ = 0;
    }
    if (c == '.') ++dots_;
    if (c == '=' || c == ',') dots_ = 0;  // a key has ended, whose tables are those of the value
    if (c == '[' || c == '{') ++open_, dots_ = 0;
    if (c == ']' || c == '}') open_ = std::max(0, open_ - 1);
    if (dots_ + open_ > deepest)
      throw hydro::InputError(fmt::format("a key or a value is nested more than {} levels deep", deepest), here(),
                              "scenes need five at most: [body.hydrodynamics] and tables in it");
  }
  void require_line(std::size_t to) const {
    if (to - line_from_ <= longest) return;
    throw hydro::InputError(fmt::format("a line is {} characters long; {} are the limit", to - line_from_, longest),
                            here(), "write a list over several lines");
  }
  /// Of a line that may be endless its beginning is quoted.
  Place here() const {
    constexpr std::size_t quoted = 100;
    const std::string_view line = text_.substr(line_from_, quoted);
    return {
        .file = file_, .line = line_, .column = 1, .text = std::string(line.substr(0, line.find('\n'))), .width = 0};
  }
  /// Over a string in quotes of either kind, of one line or of several; one that does not end is left to the parser.
  void skip_string() {
    const char quote = text_[at_];
    const std::string thrice(3, quote);
    const bool is_long = text_.substr(at_, 3) == thrice;
    const std::size_t width = is_long ? 3 : 1;
    for (at_ += width; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"') {
        ++at_;
      } else if (text_.substr(at_, width) == std::string_view(thrice).substr(0, width)) {
        at_ += width;
        return;
      } else if (text_[at_] == '\n') {
        if (!is_long) return;
        require_line(at_);
        line_from_ = at_ + 1;
        ++line_;
      }
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_from_ = 0;
  int line_ = 1, dots_ = 0, open_ = 0;
};

Node converted(const toml::node& from, const Lines& lines);

void convert_entries(const toml::table& from, const Lines& lines, Node& to) {
  for (const auto& [key, value] : from)
    to.entries.push_back({std::string(key.str()), lines.place(key.source()), converted(value, lines)});
  // The library keeps keys in alphabetical order; errors and results follow the file.
  std::sort(to.entries.begin(), to.entries.end(), [](const Node::Entry& a, const Node::Entry& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
}

Node converted(const toml::node& from, const Lines& lines) {
  Node to;
  to.place = lines.place(from.source());
  to.raw = Lines::marked(to.place);
  if (const auto* table = from.as_table()) {
    to.type = Node::Type::table;
    convert_entries(*table, lines, to);
  } else if (const auto* array = from.as_array()) {
    to.type = Node::Type::list;
    for (const auto& item : *array) to.items.push_back(converted(item, lines));
  } else if (const auto* text = from.as_string()) {
    to.type = Node::Type::text;
    to.text = text->get();
  } else if (const auto* integer = from.as_integer()) {
    to.type = Node::Type::integer;
    to.integer = integer->get();
    to.number = static_cast<double>(integer->get());
  } else if (const auto* number = from.as_floating_point()) {
    to.type = Node::Type::number;
    to.number = number->get();
  } else if (const auto* boolean = from.as_boolean()) {
    to.type = Node::Type::boolean;
    to.boolean = boolean->get();
  } else {
    to.type = Node::Type::date;
  }
  return to;
}

/// The library points behind the second of two equal keys; people look for the key itself.
Place of_whole_key(Place place) {
  const auto first = place.text.find_first_not_of(" \t");
  if (first == std::string::npos) return place;
  const auto last = std::min(place.text.find('=', first), place.text.size());
  place.column = static_cast<int>(first) + 1;
  place.width = static_cast<int>(place.text.find_last_not_of(" \t", last - 1) - first) + 1;
  return place;
}

[[noreturn]] void throw_syntax_error(const toml::parse_error& error, const Lines& lines) {
  const std::string what(error.description());
  const Place place = lines.place(error.source());
  if (what.find("redefine") != std::string::npos)
    throw hydro::InputError(
        what, of_whole_key(place),
        "a key stands once in its table, a [table] once in the file; what may repeat is a [[table]]");
  throw hydro::InputError("this is not TOML: " + what, place, "every text value needs quotes, every list its brackets");
}

}  // namespace

const Node::Entry* Node::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

std::string_view type_name(Node::Type type) {
  switch (type) {
    case Node::Type::table:
      return "a table";
    case Node::Type::list:
      return "a list";
    case Node::Type::text:
      return "text";
    case Node::Type::integer:
      return "an integer";
    case Node::Type::number:
      return "a number";
    case Node::Type::boolean:
      return "a boolean";
    case Node::Type::date:
      return "a date or time of day";
  }
  return "";
}

Node parse_document(std::string_view text, const std::string& file) {
  TextLayout(text, file).check();
  const Lines lines(text, file);
  try {
    const toml::table root = toml::parse(text);
    Node node;
    convert_entries(root, lines, node);
    node.place = lines.place({.begin = {1, 1}, .end = {1, 1}, .path = nullptr});
    return node;
  } catch (const toml::parse_error& error) {
    throw_syntax_error(error, lines);
  }
}

std::size_t byte_at(std::string_view text, const hydro::Place& place) {
  const auto begins_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  std::size_t at = 0;
  for (int n = 1; n < place.line; ++n) at = text.find('\n', at) + 1;
  for (int column = 0; at < text.size(); ++at)
    if (begins_character(text[at]) && ++column == place.column) break;
  return at;
}

}  // namespace froude::scene
