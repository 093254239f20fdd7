#include "scene/override.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <type_traits>

#include "scene/build.hpp"
#include "scene/document.hpp"

namespace froude::scene {
namespace {

using hydro::InputError;

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    out.push_back(path.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

/// A number at the beginning of a text, and what comes after it.
bool split(std::string_view text, double& value, std::string& rest) {
  text = hydro::trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  rest = hydro::trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return true;
}

/// The pieces of "(0, 0, 1.31) m".
struct Written3 {
  std::vector<std::string> components;
  std::string unit;
};
Written3 split_vector(const std::string& text) {
  Written3 out;
  const std::size_t open = text.find('('), close = text.find(')');
  if (open == std::string::npos || close == std::string::npos || close < open) return out;
  for (std::size_t from = open + 1; from <= close;) {
    const std::size_t to = std::min(text.find(',', from), close);
    out.components.emplace_back(hydro::trimmed(text.substr(from, to - from)));
    from = to + 1;
  }
  out.unit = hydro::trimmed(text.substr(close + 1));
  return out;
}

/// Where a path leads: a value, and of a vector which component.
struct Found {
  Node* node;
  int component = -1;
};

class Finder {
 public:
  Finder(const std::string& path, const Place& asked) : path_(path), parts_(parts_of(path)), asked_(asked) {}

  Found find(Node& root) {
    Node* at = &root;
    while (next_ < parts_.size()) {
      const int component = component_of(*at);
      if (component >= 0) return {at, component};
      at = step(*at);
    }
    return {at};
  }
  /// The same; a key that its table does not have is put there, with nothing in it.
  Found find_or_add(Node& root) {
    may_add_ = true;
    return find(root);
  }

 private:
  [[noreturn]] void refuse(const std::string& why, const std::string& remedy) const {
    throw InputError(fmt::format("\"{}\" {}", path_, why), asked_, remedy);
  }
  int component_of(const Node& at) const {
    const std::string& part = parts_[next_];
    const bool last = next_ + 1 == parts_.size();
    if (!last || part.size() != 1 || part[0] < 'x' || part[0] > 'z' || !at.is(Node::Type::text)) return -1;
    return split_vector(at.text).components.size() == 3 ? part[0] - 'x' : -1;
  }
  Node* step(Node& at) {
    std::string key = parts_[next_++];
    std::size_t index = 0;
    if (const std::size_t open = key.find('['); open != std::string::npos) {
      const auto* first = key.data() + open + 1;
      const auto* last = key.data() + key.size() - 1;
      if (key.back() != ']' || std::from_chars(first, last, index).ptr != last || index == 0)
        refuse(fmt::format("has \"{}\" in it", key), "count tables from 1: line[1].damping.linear");
      key.resize(open);
    }
    std::vector<std::string> known;
    for (auto& entry : at.entries) {
      known.push_back(entry.key);
      if (entry.key == key) return entry.value.is(Node::Type::list) ? item(entry.value, key, index) : &entry.value;
    }
    if (may_add_ && index == 0 && next_ == parts_.size() && at.is(Node::Type::table)) {
      Node& made = at.entries.emplace_back().value;
      at.entries.back().key = key;
      made.type = Node::Type::text;
      made.place = at.entries.back().place = at.place;
      return &made;
    }
    if (!at.is(Node::Type::table)) refuse(fmt::format("goes on after a value, with \"{}\"", key), "end it there");
    const std::string near = hydro::nearest(key, known);
    refuse(fmt::format("is not written in the scene: there is no \"{}\"", key),
           near.empty() ? fmt::format("write the key there; the keys at hand are {}", fmt::join(known, ", "))
                        : fmt::format("did you mean \"{}\"?", near));
  }
  Node* item(Node& list, const std::string& key, std::size_t index) {
    if (index > 0 && index <= list.items.size()) return &list.items[index - 1];
    if (index > 0) refuse(fmt::format("asks for {} {}, of {}", key, index, list.items.size()), "count from 1");
    if (next_ < parts_.size())
      for (auto& table : list.items)
        if (const auto* name = table.find("name"); name != nullptr && name->value.text == parts_[next_])
          return ++next_, &table;
    if (list.items.size() == 1) return &list.items.front();
    refuse(fmt::format("does not say which {} of {}", key, list.items.size()),
           fmt::format("write {}[1], or its name after {}", key, key));
  }

  const std::string& path_;
  std::vector<std::string> parts_;
  const Place& asked_;
  std::size_t next_ = 0;
  bool may_add_ = false;
};

WrittenNumber read_number(const Found& found, const std::string& path, const Place& asked) {
  WrittenNumber out{};
  const Node& node = *found.node;
  if (found.component >= 0) {
    const auto written = split_vector(node.text);
    std::string rest;
    if (split(written.components[static_cast<std::size_t>(found.component)], out.value, rest) && rest.empty())
      return out.unit = written.unit, out;
  } else if (node.is(Node::Type::number) || node.is(Node::Type::integer)) {
    return {node.number, ""};
  } else if (node.is(Node::Type::text) && split(node.text, out.value, out.unit) && !out.unit.starts_with("..")) {
    return out;
  }
  throw InputError(fmt::format("\"{}\" is {} in the scene; a single number is needed", path,
                               node.is(Node::Type::text) ? "\"" + node.text + "\"" : std::string(type_name(node.type))),
                   asked, "of a vector name one component: load.at.x");
}

/// Into the unit, the vector or the number that is there.
void write_number(const Found& found, double value, const std::string& unit) {
  Node& node = *found.node;
  if (found.component >= 0) {
    auto written = split_vector(node.text);
    written.components[static_cast<std::size_t>(found.component)] = fmt::format("{:.17g}", value);
    node.text = fmt::format("({}) {}", fmt::join(written.components, ", "), written.unit);
  } else if (node.is(Node::Type::text)) {
    node.text = fmt::format("{:.17g} {}", value, unit);
  } else {
    constexpr double exact = 9007199254740992;  // 2^53: up to there a double holds every integer
    const bool whole = node.is(Node::Type::integer) && value == std::floor(value) && std::abs(value) <= exact;
    node.type = whole ? Node::Type::integer : Node::Type::number;
    node.number = value;
    node.integer = whole ? static_cast<std::int64_t>(value) : 0;
  }
  node.raw = node.is(Node::Type::text) ? '"' + node.text + '"' : fmt::format("{}", value);
}

/// As TOML would have it, whatever stood there.
void write_as_toml(bool value, Node& node) {
  node.type = Node::Type::boolean;
  node.boolean = value;
  node.raw = value ? "true" : "false";
}
void write_as_toml(std::int64_t value, Node& node) {
  node.type = Node::Type::integer;
  node.integer = value;
  node.number = static_cast<double>(value);
  node.raw = fmt::format("{}", value);
}
void write_as_toml(double value, Node& node) {
  node.type = Node::Type::number;
  node.number = value;
  node.raw = fmt::format("{}", value);
}
void write_as_toml(const std::string& value, Node& node) {
  node.type = Node::Type::text;
  node.text = value;
  node.raw = '"' + value + '"';
}

/// A key that was not there holds an empty text, which no scene writes.
bool is_new(const Node& node) { return node.is(Node::Type::text) && node.raw.empty(); }

void write_value(const Found& found, const OverriddenValue& one, const Place& asked) {
  Node& node = *found.node;
  if (node.is(Node::Type::table) || node.is(Node::Type::list))
    throw InputError(fmt::format("\"{}\" is {} in the scene; a single value is needed", one.path, type_name(node.type)),
                     asked, "name a key of it, or write it into the scene");
  std::visit(
      [&](const auto& value) {
        using V = std::decay_t<decltype(value)>;
        constexpr bool is_number = std::is_same_v<V, double> || std::is_same_v<V, std::int64_t>;
        if constexpr (is_number) {
          const bool exact = std::is_same_v<V, std::int64_t> && node.is(Node::Type::integer);
          if (!exact && !is_new(node))
            return write_number(found, static_cast<double>(value), read_number(found, one.path, asked).unit);
        } else if (found.component >= 0) {
          throw InputError(fmt::format("\"{}\" is a component of a vector; a number is needed", one.path), asked,
                           "leave out the component to write the whole vector");
        }
        write_as_toml(value, node);
      },
      one.value);
}

}  // namespace

WrittenNumber number_at(std::string_view text, const std::filesystem::path& file, const std::string& path,
                        const Place& asked) {
  Node root = parse_document(text, file.string());
  resolve_includes(root, file);
  return read_number(Finder(path, asked).find(root), path, asked);
}

namespace {

using Form = WrittenValue::Form;

Form form_of(const Node& node) {
  switch (node.type) {
    case Node::Type::text:
      return Form::text;
    case Node::Type::integer:
      return Form::integer;
    case Node::Type::number:
      return Form::number;
    default:
      return Form::other;
  }
}

/// The bytes of a component within those of its vector, "(0, 0, 1.31) m".
void narrow(std::string_view text, int component, WrittenValue& to) {
  std::size_t begin = text.find('(', to.begin) + 1;
  for (int i = 0; i < component; ++i) begin = text.find(',', begin) + 1;
  to.end = text.find_first_of(",)", begin);
  to.begin = text.find_first_not_of(' ', begin);
}

}  // namespace

WrittenValue value_at(std::string_view text, const std::filesystem::path& file, const std::string& path,
                      const Place& asked) {
  Node root = parse_document(text, file.string());
  const Found found = Finder(path, asked).find(root);
  const Node& node = *found.node;
  if (node.is(Node::Type::table))
    throw InputError(fmt::format("\"{}\" is a table in the scene; a value is needed", path), asked, "name a key of it");
  const bool list_goes_on = node.is(Node::Type::list) && !node.raw.ends_with(']');
  if (list_goes_on || node.raw.starts_with("\"\"\"") || node.raw.starts_with("'''"))
    throw InputError(fmt::format("\"{}\" goes over several lines of the scene", path), asked,
                     "write its value on one line");
  const std::size_t begin = byte_at(text, node.place);
  WrittenValue out{begin, begin + node.raw.size(), form_of(node), {}};
  if (found.component < 0) return out;
  out.form = Form::component;
  out.unit = split_vector(node.text).unit;
  narrow(text, found.component, out);
  return out;
}

WrittenNumber ChangeableScene::number(const std::string& path, const std::vector<OverriddenValue>& values) const {
  Node document = *document_;
  override_values(document, values);
  return read_number(Finder(path, document.place).find(document), path, document.place);
}

void override_values(Node& root, const std::vector<OverriddenValue>& values) {
  for (const auto& one : values) write_value(Finder(one.path, root.place).find_or_add(root), one, root.place);
}

}  // namespace froude::scene
