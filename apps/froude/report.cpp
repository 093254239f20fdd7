#include "froude/report.hpp"

#include <algorithm>
#include <iterator>
#include <ostream>

#include "froude/commands.hpp"

namespace froude {
namespace {

bool is_list_of_tables(const Json& value) { return value.is_array() && !value.empty() && value[0].is_object(); }

/// Bare where TOML allows it, else in quotes.
std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : Json(key).dump();
}

/// A string of JSON is a basic string of TOML, and a float stays a float.
std::string toml_value(const Json& value) {
  if (value.is_array()) {
    std::vector<std::string> parts;
    for (const auto& part : value) parts.push_back(toml_value(part));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (!value.is_number_float()) return value.dump();
  const std::string text = fmt::format("{}", value.get<double>());
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

void append_toml(std::string& out, const std::string& path, const Json& table) {
  for (const auto& [key, value] : table.items())
    if (!value.is_object() && !value.is_null() && !is_list_of_tables(value))
      out += toml_key(key) + " = " + toml_value(value) + "\n";
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [key, value] : table.items()) {
    const std::string inner = prefix + toml_key(key);
    if (value.is_object()) {
      out += fmt::format("\n[{}]\n", inner);
      append_toml(out, inner, value);
    } else if (is_list_of_tables(value)) {
      for (const auto& entry : value) {
        out += fmt::format("\n[[{}]]\n", inner);
        append_toml(out, inner, entry);
      }
    }
  }
}

}  // namespace

Json& Report::place_of(const std::string& key) {
  Json* place = &tree_;
  std::size_t from = 0;
  for (std::size_t slash = key.find('/'); slash != std::string::npos; slash = key.find('/', from)) {
    place = &(*place)[key.substr(from, slash - from)];
    from = slash + 1;
  }
  return (*place)[key.substr(from)];
}

Report& Report::sentences(const std::string& key, fmt::format_string<const std::string&> line,
                          const std::vector<std::string>& all) {
  Json& list = tree_[key];
  if (list.is_null()) list = Json::array();
  for (const std::string& sentence : all) {
    list.push_back(sentence);
    lines_.push_back(fmt::format(line, sentence));
  }
  return *this;
}

Report& Report::part(const std::string& key, Report inner) {
  std::move(inner.lines_.begin(), inner.lines_.end(), std::back_inserter(lines_));
  Json& place = key.empty() ? tree_ : tree_[key];
  if (place.empty())
    place = std::move(inner.tree_);
  else
    place.update(inner.tree_);
  return *this;
}

Report& Report::one_of(const std::string& key, Report inner) {
  std::move(inner.lines_.begin(), inner.lines_.end(), std::back_inserter(lines_));
  tree_[key].push_back(std::move(inner.tree_));
  return *this;
}

Report& Report::wrote(const std::optional<std::filesystem::path>& file) {
  if (!file) return *this;
  tree_["written"].push_back(file->string());
  return say("wrote {}", file->string());
}

Report Report::untold() const {
  Report out;
  out.tree_ = tree_;
  return out;
}

std::string Report::text() const {
  std::string out;
  for (const std::string& line : lines_) out += line + '\n';
  return out;
}

std::string toml_of(const Json& tree, const std::string& comment) {
  std::string out = "# " + comment + "\n";
  append_toml(out, "", tree);
  return out;
}

const Report& tell_people(const Report& part, const Console& console) {
  if (!console.json) console.out << part.text();
  return part;
}

void tell(const Report& report, const Console& console) {
  tell_people(report, console);
  if (console.json) console.out << report.tree().dump(1) << '\n';
}

}  // namespace froude
