/// \file  The reference of all keys, written from the declarations that the reader uses.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/scene.hpp"
#include "scene/schema.hpp"

namespace froude::scene {
namespace {

std::string form_of(const Key& key) {
  const std::string unit = si_unit(key.dimension);
  std::vector<std::string> words;
  for (const auto& word : key.words) words.push_back(fmt::format("`\"{}\"`", word));
  const std::string listed = fmt::format("{}", fmt::join(words, ", "));
  switch (key.holds) {
    case Holds::text:
      return words.empty() ? "text" : listed;
    case Holds::name:
      return "name";
    case Holds::texts:
      return words.empty() ? "text, or list of texts" : "one or a list of " + listed;
    case Holds::number:
      return "number";
    case Holds::integer:
      return "integer";
    case Holds::effect:
      return "`true`";
    case Holds::quantity: {
      const std::string name = key.dimension.name();
      return fmt::format("{}, {}{}", name.substr(name.find(' ') + 1), unit, words.empty() ? "" : ", or " + listed);
    }
    case Holds::vector:
      return "vector, " + unit;
    case Holds::points:
      return "vector with ±, " + unit;
    case Holds::ends:
      return "list of two vectors with ±, " + unit;
    case Holds::direction:
      return listed + ", or a vector without unit";
    case Holds::range:
      return "range, " + unit;
    case Holds::values:
      return "range, or list of quantities, " + unit;
    case Holds::scalars:
      return "what the key of the scene may hold, one or a list";
    case Holds::table:
    case Holds::tables:
      return fmt::format("table `{}`", key.inner->title);
  }
  return "";
}

/// A * in running text would begin emphasis.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '*' ? std::string("\\*") : std::string(1, c);
  return out;
}

std::string presence_of(const Key& key) {
  std::string out = "optional";
  if (key.need == Need::required) out = "needed";
  if (key.need == Need::defaulted && key.inner == nullptr) out = fmt::format("`{}`: {}", key.fallback, key.because);
  if (!key.beside.empty()) out += fmt::format("; only beside `{}`", fmt::join(key.beside, "` or `"));
  return out;
}

std::string rows(const std::vector<Key>& keys, const Table& table) {
  std::string out = "| key | holds | meaning | default |\n|---|---|---|---|\n";
  for (const Key& key : keys) {
    Key shown = key;
    if (key.name == table.chosen_by)
      for (const auto& variant : table.variants) shown.words.push_back(variant.word);
    std::string meaning = escaped(key.meaning);
    if (const auto rule = rule_of(key.limit); !rule.empty()) meaning += fmt::format("; {}", rule);
    out += fmt::format("| `{}` | {} | {} | {} |\n", key.name, form_of(shown), meaning, presence_of(key));
  }
  return out;
}

std::string groups_of(const std::vector<Group>& groups, const std::vector<Key>& keys) {
  std::string out;
  for (const Group& group : groups) {
    const char* count = group.count == Group::Count::exactly_one   ? "Exactly one"
                        : group.count == Group::Count::at_most_one ? "At most one"
                                                                   : "At least one";
    out += group.keys.size() == keys.size() ? fmt::format("\n{} of these keys.\n", count)
                                            : fmt::format("\n{} of `{}`.\n", count, fmt::join(group.keys, "`, `"));
  }
  return out;
}

std::string section_of(const Table& table, int depth) {
  const bool root = !table.title.starts_with('[');
  std::string out = fmt::format("\n{} {}\n\n{}.\n\n", std::string(static_cast<std::size_t>(depth), '#'),
                                root ? "Top of the file" : "`" + table.title + "`", table.meaning);
  out += rows(table.keys, table) + groups_of(table.groups, table.keys);
  for (const auto& variant : table.variants) {
    out += fmt::format("\nWith `{} = \"{}\"`, {}{}\n", table.chosen_by, variant.word, variant.meaning,
                       variant.keys.empty() ? "." : ":\n");
    if (!variant.keys.empty()) out += rows(variant.keys, table) + groups_of(variant.groups, variant.keys);
  }
  return out;
}

/// A table that several hold, such as the spreading of each spectrum, once: keys name it by its title.
void append_table(const Table& table, int depth, std::string& out) {
  if (const std::string section = section_of(table, depth); out.find(section) == std::string::npos) out += section;
  const auto inner = [&](const std::vector<Key>& keys) {
    for (const Key& key : keys)
      if (key.inner != nullptr) append_table(*key.inner, 3, out);
  };
  inner(table.keys);
  for (const auto& variant : table.variants) inner(variant.keys);
}

}  // namespace

std::string reference_of(const Table& root) {
  std::string out;
  append_table(root, 3, out);
  return out;
}

}  // namespace froude::scene
