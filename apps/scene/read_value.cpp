#include "scene/read_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "hydro/base/measurable.hpp"

namespace froude::scene {
namespace {

using hydro::InputError;

/// Everything an error needs to say about one value.
struct Site {
  const Node& node;
  const Key& key;
  const std::string& title;

  /// `[waves] hs`; keys of the root stand alone.
  std::string name() const { return title.starts_with('[') ? title + " " + key.name : key.name; }
  std::string subject() const { return fmt::format("{} = {}", name(), node.raw); }
  [[noreturn]] void refuse(const std::string& rule, const std::string& remedy) const {
    throw InputError(fmt::format("{} {}", subject(), rule), node.place, remedy);
  }
  /// An error of the parser of units, told with key and place.
  [[noreturn]] void refuse(const InputError& why, const std::string& remedy) const {
    const bool begins_with_value = why.rule().starts_with(node.raw);
    throw InputError(
        begins_with_value ? fmt::format("{} = {}", name(), why.rule()) : fmt::format("{}: {}", subject(), why.rule()),
        node.place, remedy);
  }
};

std::string what_is_needed(const Key& key) {
  switch (key.holds) {
    case Holds::text:
    case Holds::name:
      return "text";
    case Holds::texts:
      return "text or a list of texts";
    case Holds::number:
      return "a number";
    case Holds::integer:
      return "an integer";
    case Holds::effect:
      return "true";
    case Holds::quantity:
      return key.dimension.name();
    case Holds::vector:
      return "a vector";
    case Holds::points:
      return "a point";
    case Holds::ends:
      return "a list of two points";
    case Holds::direction:
      return "a direction";
    case Holds::range:
      return "a range of values";
    case Holds::values:
      return "a range of values, or a list of quantities,";
    case Holds::scalars:
      return "a text, a number, true or false, or a list of these";
    case Holds::table:
      return "a table";
    case Holds::tables:
      return fmt::format("a list of [[{}]]", key.name);
  }
  return "";
}

[[noreturn]] void refuse_type(const Site& at) {
  at.refuse(fmt::format("is {}; {} is needed", type_name(at.node.type), what_is_needed(at.key)),
            "write " + example(at.key));
}

void check_limit(const Site& at, double value) {
  if (!keeps(at.key.limit, value)) at.refuse(std::string(rule_of(at.key.limit)), "");
}

/// A word out of those allowed.
void check_word(const Site& at, const std::string& word) {
  const auto& words = at.key.words;
  if (words.empty() || std::find(words.begin(), words.end(), word) != words.end()) return;
  const std::string near = hydro::nearest(word, words);
  at.refuse(fmt::format("is not one of {}", fmt::join(words, ", ")),
            near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
}

void check_name(const Site& at) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto other = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
  const std::string& name = at.node.text;
  if (name.empty() || !letter(name.front()) || !std::all_of(name.begin(), name.end(), other))
    at.refuse("is not a name", "a name begins with a letter and goes on with letters, digits, _ and -");
  // Results hold wave.elevation and energy.*; connectors know the ground.
  const std::string reserved[] = {"ground", "wave", "energy", "time"};
  if (std::find(std::begin(reserved), std::end(reserved), name) != std::end(reserved))
    at.refuse("is a word with a meaning of its own in scenes", "choose another name");
}

void read_quantity(const Site& at, Value& value) {
  const auto& words = at.key.words;
  if (at.node.is(Node::Type::integer) || at.node.is(Node::Type::number))
    at.refuse(
        fmt::format("has no unit; {} is needed", at.key.dimension.name()),
        fmt::format("write it with its unit, like {}\"{} {}\"",
                    at.key.dimension == hydro::dim::angular_velocity ? fmt::format("\"{} Hz\" or ", at.node.raw) : "",
                    at.node.raw, si_unit(at.key.dimension)));
  if (!at.node.is(Node::Type::text)) refuse_type(at);
  if (std::find(words.begin(), words.end(), at.node.text) != words.end()) {
    value.text = at.node.text;
    return;
  }
  try {
    value.number = hydro::parse_si(at.node.text, at.key.dimension);
  } catch (const InputError& why) {
    const std::string near = hydro::nearest(at.node.text, words);
    at.refuse(why, near.empty() ? why.remedy() : fmt::format("did you mean \"{}\"?", near));
  }
  check_limit(at, value.number);
}

std::vector<Eigen::Vector3d> read_points(const Site& at, bool one) {
  if (!at.node.is(Node::Type::text)) refuse_type(at);
  try {
    if (one) return {hydro::parse_vector(at.node.text, at.key.dimension)};
    return hydro::parse_vectors(at.node.text, at.key.dimension);
  } catch (const InputError& why) {
    at.refuse(why, fmt::format("write it like \"(0, 0, 1.31) {}\"", si_unit(at.key.dimension)));
  }
}

void read_ends(const Site& at, Value& value) {
  if (!at.node.is(Node::Type::list)) refuse_type(at);
  if (at.node.items.size() != 2)
    at.refuse("is not a list of two points", "write [end on the first, end on the second]");
  Key end = at.key;
  end.holds = Holds::points;
  for (const Node& item : at.node.items) value.points.push_back(read_points({item, end, at.title}, false));
  if (value.points[0].size() != value.points[1].size())
    at.refuse(fmt::format("stands for {} and {} points", value.points[0].size(), value.points[1].size()),
              "use as many ± on one end as on the other");
}

Eigen::Vector3d read_direction(const Site& at) {
  if (!at.node.is(Node::Type::text)) refuse_type(at);
  const auto& words = at.key.words;
  const auto word = std::find(words.begin(), words.end(), at.node.text);
  if (word != words.end()) return Eigen::Vector3d::Unit(word - words.begin());
  Eigen::Vector3d out;
  try {
    out = hydro::parse_vector(at.node.text, hydro::dim::none);
  } catch (const InputError& why) {
    at.refuse(why, "write \"x\", \"y\", \"z\", or a vector like \"(1, 0, 1)\"");
  }
  if (out.norm() == 0) at.refuse("has no direction", "give one component that is not zero");
  return out;
}

void read_range(const Site& at, Value& value) {
  if (!at.node.is(Node::Type::text)) refuse_type(at);
  const bool alone = at.node.text.find("..") == std::string::npos && at.node.text.find(',') == std::string::npos;
  if (alone && at.key.holds == Holds::range) {  // "5 s", as an axis of a study writes it; of several there are lists
    Value one;
    read_quantity(at, one);
    value.range = {one.number};
    return;
  }
  try {
    value.range = hydro::parse_range(at.node.text, at.key.dimension);
  } catch (const InputError& why) {
    const std::string unit = si_unit(at.key.dimension);
    const std::string list =
        at.key.holds == Holds::values ? fmt::format(", or as a list like [\"{}\"]", at.key.dimension.example()) : "";
    at.refuse(why, fmt::format("write it like \"2 {} .. 8 {}, 61 values\"{}", unit, unit, list));
  }
  for (const double v : value.range) check_limit(at, v);
}

/// What a list of quantities may not hold twice: numbers that differ by the rounding of another unit only.
bool are_same(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b)); }

void read_values(const Site& at, Value& value) {
  if (at.node.is(Node::Type::text)) return read_range(at, value);
  if (!at.node.is(Node::Type::list)) refuse_type(at);
  for (std::size_t i = 0; i < at.node.items.size(); ++i) {
    const Site here{at.node.items[i], at.key, at.title};
    Value item;
    read_quantity(here, item);
    for (std::size_t earlier = 0; earlier < i; ++earlier)
      if (are_same(value.range[earlier], item.number))
        here.refuse(fmt::format("stands twice in this list, first as {}", at.node.items[earlier].raw), "keep one");
    value.range.push_back(item.number);
  }
  if (value.range.empty()) at.refuse("is empty", "write at least one, or leave the key out");
}

void read_texts(const Site& at, Value& value) {
  const bool one = at.node.is(Node::Type::text);
  if (!one && !at.node.is(Node::Type::list)) refuse_type(at);
  for (const Node& item : one ? std::vector<Node>{at.node} : at.node.items) {
    const Site here{item, at.key, at.title};
    if (!item.is(Node::Type::text)) refuse_type(here);
    if (item.text.empty()) here.refuse("is empty", "");
    check_word(here, item.text);
    for (const auto& earlier : value.texts)
      if (earlier.value == item.text) here.refuse("stands twice in this list", "keep one");
    value.texts.push_back({item.text, item.place});
  }
  if (value.texts.empty()) at.refuse("is empty", "write at least one, or leave the key out");
}

void read_scalars(const Site& at, Value& value) {
  using enum Node::Type;
  const bool one = !at.node.is(list);
  for (const Node& item : one ? std::vector<Node>{at.node} : at.node.items) {
    const Site here{item, at.key, at.title};
    if (!item.is(text) && !item.is(integer) && !item.is(number) && !item.is(boolean)) refuse_type(here);
    if (item.is(text) && item.text.find('\n') != std::string::npos) here.refuse("goes over several lines", "");
    value.texts.push_back({item.raw, item.place});
  }
  if (value.texts.empty()) at.refuse("is empty", "write at least one, or leave the key out");
}

void read_number(const Site& at, Value& value) {
  const bool integer = at.key.holds == Holds::integer;
  if (!at.node.is(Node::Type::integer) && (integer || !at.node.is(Node::Type::number))) refuse_type(at);
  if (!std::isfinite(at.node.number)) at.refuse("is not finite", "");
  if (!hydro::is_measurable(at.node.number))
    at.refuse("is beyond what is computed with: sizes lie between 1e-30 and 1e30", "look at the exponent");
  value.number = at.node.number;
  value.integer = at.node.integer;
  check_limit(at, value.number);
}

void check_effect(const Site& at) {
  if (at.node.is(Node::Type::boolean) && at.node.boolean) return;
  if (at.node.is(Node::Type::boolean))
    at.refuse("is not needed: what a scene does not name does not act", "leave the key out");
  refuse_type(at);
}

}  // namespace

Value read_value(const Node& node, const Key& key, const std::string& title) {
  const Site at{node, key, title};
  Value value;
  value.place = node.place;
  value.shown = node.raw;
  switch (key.holds) {
    case Holds::text:
    case Holds::name:
      if (!node.is(Node::Type::text)) refuse_type(at);
      value.text = node.text;
      if (key.holds == Holds::name) check_name(at);
      if (node.text.empty()) at.refuse("is empty", key.need == Need::required ? "" : "write it, or leave the key out");
      check_word(at, node.text);
      break;
    case Holds::texts:
      read_texts(at, value);
      break;
    case Holds::number:
    case Holds::integer:
      read_number(at, value);
      break;
    case Holds::effect:
      check_effect(at);
      break;
    case Holds::quantity:
      read_quantity(at, value);
      break;
    case Holds::vector:
      value.points.push_back(read_points(at, true));
      for (const double component : value.points[0][0]) check_limit(at, component);
      break;
    case Holds::points:
      value.points.push_back(read_points(at, false));
      break;
    case Holds::ends:
      read_ends(at, value);
      break;
    case Holds::direction:
      value.points.push_back({read_direction(at)});
      break;
    case Holds::range:
      read_range(at, value);
      break;
    case Holds::values:
      read_values(at, value);
      break;
    case Holds::scalars:
      read_scalars(at, value);
      break;
    case Holds::table:
    case Holds::tables:
      throw std::logic_error("a table is not a value");
  }
  return value;
}

void check_table(const Node& node, const Key& key, const std::string& title) {
  if (node.is(Node::Type::table)) return;
  if (node.is(Node::Type::list) && !node.items.empty() && node.items.front().is(Node::Type::table))
    throw InputError(fmt::format("{} is one table, not a list", key.inner->title), node.items.front().place,
                     fmt::format("write {} once", key.inner->title));
  refuse_type({node, key, title});
}

void check_list_of_tables(const Node& node, const Key& key) {
  if (node.is(Node::Type::table))
    throw InputError(fmt::format("there may be several of {}, so it is a list", key.inner->title), node.place,
                     fmt::format("write {} with two brackets, before its own tables", key.inner->title));
  const std::string title = "a scene";
  if (!node.is(Node::Type::list) || node.items.empty()) refuse_type({node, key, title});
  for (const Node& item : node.items)
    if (!item.is(Node::Type::table)) refuse_type({item, key, title});
}

Node default_node(const Key& key, const hydro::Place& place) {
  Node node;
  node.place = place;
  node.raw = key.fallback;
  switch (key.holds) {
    case Holds::table:
      break;
    case Holds::number:
      node.type = Node::Type::number;
      node.number = hydro::parse_number(key.fallback);
      break;
    case Holds::integer:
      node.type = Node::Type::integer;
      node.number = hydro::parse_number(key.fallback);
      node.integer = static_cast<std::int64_t>(node.number);
      break;
    case Holds::texts:
      node.type = Node::Type::list;
      for (std::size_t from = 0; from <= key.fallback.size();) {
        const std::size_t to = std::min(key.fallback.find(", ", from), key.fallback.size());
        Node item;
        item.type = Node::Type::text;
        item.place = place;
        item.text = key.fallback.substr(from, to - from);
        node.items.push_back(item);
        from = to + 2;
      }
      break;
    default:
      node.type = Node::Type::text;
      node.text = key.fallback;
  }
  return node;
}

std::string example(const Key& key) {
  const std::string unit = si_unit(key.dimension);
  const std::string word = key.words.empty() ? "…" : key.words.front();
  switch (key.holds) {
    case Holds::text:
    case Holds::name:
      return fmt::format("{} = \"{}\"", key.name, word);
    case Holds::texts:
      return fmt::format("{} = [\"{}\"]", key.name, word);
    case Holds::number:
      return fmt::format("{} = {}", key.name, key.fallback.empty() ? "1.0" : key.fallback);
    case Holds::integer:
      return fmt::format("{} = 1", key.name);
    case Holds::effect:
      return fmt::format("{} = true", key.name);
    case Holds::quantity:
      return fmt::format("{} = \"{}\"", key.name, key.dimension.example());
    case Holds::vector:
    case Holds::points:
      return fmt::format("{} = \"(0, 0, 1.31) {}\"", key.name, unit);
    case Holds::direction:
      return fmt::format("{} = \"y\"", key.name);
    case Holds::ends:
      return fmt::format("{} = [\"(6, ±5, 0) m\", \"(-6, ±5, 0) m\"]", key.name);
    case Holds::range:
      return fmt::format("{} = \"2 {} .. 8 {}, 61 values\"", key.name, unit, unit);
    case Holds::values:
      return fmt::format("{} = [\"{}\"]", key.name, key.dimension.example());
    case Holds::scalars:
      return fmt::format("{} = [\"1 m\", \"2 m\"]", key.name);
    case Holds::table: {
      const bool may_be_empty =
          key.inner->groups.empty() || key.inner->groups.front().count == Group::Count::at_most_one;
      const bool needs_nothing = may_be_empty && std::none_of(key.inner->keys.begin(), key.inner->keys.end(),
                                                              [](const Key& k) { return k.need == Need::required; });
      return needs_nothing ? fmt::format("{} = {{}}, or with keys in the braces", key.name)
                           : fmt::format("the table {}", key.inner->title);
    }
    case Holds::tables:
      return fmt::format("at least one {}", key.inner->title);
  }
  return key.name;
}

std::string echo_text(const Node& node) {
  if (node.is(Node::Type::text)) return node.text;
  if (!node.is(Node::Type::list)) return node.raw;
  std::vector<std::string> items;
  for (const Node& item : node.items) items.push_back(echo_text(item));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

}  // namespace froude::scene
