#include "harness/accept.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hydro/base/units.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/document.hpp"

namespace froude::validation {
namespace {

using hydro::InputError;
using scene::Node;
using Type = Node::Type;

constexpr std::array<std::string_view, 10> known_keys{"number",         "unit",    "expected", "limit",
                                                      "limit_relative", "at_most", "at_least", "reference_uncertainty",
                                                      "because",        "fails"};

void require_known_keys(const Node& check) {
  for (const Node::Entry& entry : check.entries)
    if (std::find(known_keys.begin(), known_keys.end(), entry.key) == known_keys.end()) {
      const std::string near = hydro::nearest(entry.key, known_keys);
      throw InputError(fmt::format("[[check]] has no key \"{}\"", entry.key), entry.place,
                       near.empty() ? fmt::format("keys are {}", fmt::join(known_keys, ", "))
                                    : fmt::format("did you mean \"{}\"?", near));
    }
}

std::optional<std::string> text(const Node& check, std::string_view key) {
  const Node::Entry* entry = check.find(key);
  if (entry == nullptr) return {};
  if (!entry->value.is(Type::text) || hydro::trimmed(entry->value.text).empty())
    throw InputError(fmt::format("{} must be a text that says something", key), entry->value.place,
                     fmt::format("write {} = \"…\"", key));
  return entry->value.text;
}

std::optional<double> number(const Node& check, std::string_view key, bool may_be_negative) {
  const Node::Entry* entry = check.find(key);
  if (entry == nullptr) return {};
  const Node& value = entry->value;
  if (!value.is(Type::number) && !value.is(Type::integer))
    throw InputError(fmt::format("{} must be a number", key), value.place, "numbers stand without quotes");
  if (!std::isfinite(value.number) || (value.number < 0 && !may_be_negative))
    throw InputError(fmt::format("{} must be finite{}", key, may_be_negative ? "" : " and not negative"), value.place);
  return value.number;
}

// Exactly one kind of limit; those around an expected value need one, the others cannot use one.
void read_rule(const Node& node, Check& check) {
  using Rule = Check::Rule;
  struct Kind {
    std::string_view key;
    Rule rule;
  };
  constexpr std::array<Kind, 4> kinds{{{"limit", Rule::absolute},
                                       {"limit_relative", Rule::relative},
                                       {"at_most", Rule::at_most},
                                       {"at_least", Rule::at_least}}};
  int given = 0;
  for (const Kind& kind : kinds) {
    const bool is_bound = kind.rule == Rule::at_most || kind.rule == Rule::at_least;
    if (const auto value = number(node, kind.key, is_bound)) {
      check.rule = kind.rule;
      check.limit = *value;
      ++given;
    }
  }
  if (given != 1)
    throw InputError(fmt::format("a check needs exactly one limit, {} are given", given), node.place,
                     "give one of limit, limit_relative, at_most, at_least");
  const auto expected = number(node, "expected", true);
  const bool around_expected = check.rule == Rule::absolute || check.rule == Rule::relative;
  if (around_expected != expected.has_value())
    throw InputError(around_expected ? "limit and limit_relative need an expected value"
                                     : "at_most and at_least stand without an expected value",
                     node.place, around_expected ? "add expected = …" : "remove expected");
  if (check.rule == Rule::relative && *expected == 0)
    throw InputError("a relative limit around zero admits nothing but zero", node.place, "give limit or at_most");
  check.expected = expected.value_or(0);
}

Check read_check(const Node& node) {
  require_known_keys(node);
  Check check{};
  check.place = node.place;
  const auto name = text(node, "number");
  if (!name) throw InputError("a check needs the name of its number", node.place, "add number = \"…\"");
  check.number = *name;
  check.unit = text(node, "unit").value_or("");
  read_rule(node, check);
  const auto because = text(node, "because");
  if (!because)
    throw InputError(fmt::format("the limit of \"{}\" has no reason", check.number), node.place,
                     "add because = \"…\": where the limit comes from");
  check.because = *because;
  check.reference_uncertainty = number(node, "reference_uncertainty", false);
  check.fails = text(node, "fails");
  return check;
}

bool within(const Check& check, double value) {
  switch (check.rule) {
    case Check::Rule::absolute:
      return std::abs(value - check.expected) <= check.limit;
    case Check::Rule::relative:
      return std::abs(value - check.expected) <= check.limit * std::abs(check.expected);
    case Check::Rule::at_most:
      return value <= check.limit;
    case Check::Rule::at_least:
      return value >= check.limit;
  }
  return false;
}

}  // namespace

std::vector<Check> parse_checks(std::string_view text_of_file, const std::string& file) {
  const Node root = scene::parse_document(text_of_file, file);
  for (const Node::Entry& entry : root.entries)
    if (entry.key != "check")
      throw InputError(fmt::format("\"{}\" is no part of a pass rule", entry.key), entry.place,
                       "accept.toml holds [[check]] tables only");
  const Node::Entry* list = root.find("check");
  if (list == nullptr || !list->value.is(Type::list) || list->value.items.empty())
    throw InputError("a case without a check accepts everything", {.file = file}, "add a [[check]]");
  std::vector<Check> checks;
  for (const Node& item : list->value.items) {
    Check check = read_check(item);
    for (const Check& other : checks)
      if (other.number == check.number)
        throw InputError(fmt::format("\"{}\" is checked twice", check.number), check.place,
                         fmt::format("the first check of it is at {}", other.place.str()));
    checks.push_back(std::move(check));
  }
  return checks;
}

std::vector<Check> read_checks(const std::filesystem::path& file) {
  return parse_checks(hydro::io::read_text(file), file.string());
}

Verdict judge(const Check& check, const Number& number) {
  if (number.unit != check.unit)
    throw InputError(fmt::format("\"{}\" is in \"{}\", the check in \"{}\"", number.name, number.unit, check.unit),
                     check.place, "state the unit that the case gives");
  const bool good = std::isfinite(number.value) && within(check, number.value);
  if (check.fails) return good ? Verdict::unexpected_pass : Verdict::known_failure;
  return good ? Verdict::pass : Verdict::fail;
}

std::string rule_text(const Check& check) {
  switch (check.rule) {
    case Check::Rule::absolute:
      return fmt::format("{:g} ± {:g}", check.expected, check.limit);
    case Check::Rule::relative:
      return fmt::format("{:g} ± {:g} %", check.expected, 100 * check.limit);
    case Check::Rule::at_most:
      return fmt::format("at most {:g}", check.limit);
    case Check::Rule::at_least:
      return fmt::format("at least {:g}", check.limit);
  }
  return {};
}

}  // namespace froude::validation
