/// \file  Names of things, and what tables say by the names of bodies.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scene/build.hpp"

namespace froude::scene {
namespace {

constexpr std::string_view neighbours = "neighbours of ";

/// "m1" and "m2", "m2" and "m3" … of the copies of one body: of n one less than n, so that a study may count from one.
std::vector<Between> neighbour_pairs(const Record& record, const Located<std::string>& text,
                                     const std::vector<Body>& bodies) {
  const std::string family = text.value.substr(neighbours.size());
  std::vector<Between> pairs;
  std::vector<std::string> families;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].copy > 0) families.push_back(bodies[i].family);
    if (bodies[i].family == family && bodies[i].copy > 1 && !begins_a_row(bodies[i]))
      pairs.push_back({static_cast<int>(i) - 1, static_cast<int>(i)});
  }
  if (std::find(families.begin(), families.end(), family) != families.end()) return pairs;
  const std::string near = hydro::nearest(family, families);
  throw record.wrong("between", fmt::format("names no neighbours: \"{}\" is not a body with copies", family),
                     near.empty() ? "give the body copies = { count = 2, step = \"(13, 0, 0) m\" }"
                                  : fmt::format("did you mean \"{}{}\"?", neighbours, near));
}

bool is_pattern(const std::string& name) { return name.find('*') != std::string::npos; }

/// The first body of one pattern with the first of the other, and so on, in the order of the scene.
std::vector<Between> pairs_of_rows(const Record& record, const std::vector<Located<std::string>>& patterns,
                                   const std::vector<Body>& bodies) {
  if (patterns[0].value == "ground" || patterns[1].value == "ground")
    throw record.wrong("between", "pairs a row with the ground", "write one entry for each body");
  std::array<std::vector<int>, 2> rows;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (matches(patterns[k].value, bodies[i].name)) rows[k].push_back(static_cast<int>(i));
    if (rows[k].empty()) body_named(record, patterns[k], bodies);  // throws with the nearest name
  }
  const auto named = [&](int body) { return bodies[static_cast<std::size_t>(body)].name; };
  const std::string how = fmt::format("\"{}\" names {} and \"{}\" names {}", patterns[0].value, rows[0].size(),
                                      patterns[1].value, rows[1].size());
  if (rows[0].size() != rows[1].size())
    throw record.wrong("between", fmt::format("pairs rows of different length: {}", how),
                       "name as many bodies with one as with the other");
  std::vector<Between> out;
  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    if (rows[0][i] == rows[1][i])
      throw record.wrong("between", fmt::format("pairs \"{}\" with itself", named(rows[0][i])),
                         "let the patterns name different bodies");
    out.push_back({rows[0][i], rows[1][i]});
  }
  return out;
}

}  // namespace

std::string grid_name(const std::string& family, int row, int in_row) {
  return fmt::format("{}{}_{}", family, row, in_row);
}

bool begins_a_row(const Body& body) {
  return body.copy > 0 && body.name != fmt::format("{}{}", body.family, body.copy) && body.name.ends_with("_1");
}

Key between_key() {
  return texts(
      "between",
      "[\"a\", \"b\"], [\"a\", \"ground\"], [\"a*\", \"b*\"]: the first a with the first b and so on, or "
      "\"neighbours of m\": m1–m2, m2–m3, … of the copies m (of a single one there are none), of a grid within "
      "each row");
}

void Names::add(const std::string& name, const Place& place) {
  const auto [at, fresh] = taken_.try_emplace(name, place);
  if (fresh) return;
  throw hydro::InputError(fmt::format("the name \"{}\" is taken at {}", name, at->second.str()), place,
                          "choose another name");
}

std::vector<std::string> Names::of(const Record& record, std::size_t count) {
  const std::string& base = record.text("name");
  std::vector<std::string> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (record["name"].defaulted)
      out.push_back(fmt::format("{}{}", base, ++unnamed_[base]));
    else
      out.push_back(count == 1 ? base : fmt::format("{}{}", base, i + 1));
    add(out.back(), record["name"].place);
  }
  return out;
}

std::vector<Between> read_between(const Record& record, const std::vector<Body>& bodies, GroundFirst ground_first) {
  const auto& texts = record["between"].texts;
  if (texts.size() == 1 && texts[0].value.starts_with(neighbours)) return neighbour_pairs(record, texts[0], bodies);
  if (texts.size() != 2)
    throw record.wrong("between", "does not name two ends",
                       "write [\"a\", \"b\"], [\"a\", \"ground\"] or \"neighbours of m\"");
  if (texts[0].value == "ground" && ground_first == GroundFirst::refused)
    throw record.wrong("between", "begins with the ground", "write the body first, then \"ground\"");
  if (is_pattern(texts[0].value) || is_pattern(texts[1].value)) return pairs_of_rows(record, texts, bodies);
  const auto end = [&](const Located<std::string>& name) {
    return name.value == "ground" ? std::nullopt : std::optional<int>(body_named(record, name, bodies));
  };
  return {{end(texts[0]), end(texts[1])}};
}

int body_named(const Record& record, const Located<std::string>& name, const std::vector<Body>& bodies) {
  std::vector<std::string> known{"ground"};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name.value) return static_cast<int>(i);
    known.push_back(bodies[i].name);
  }
  const std::string near = hydro::nearest(name.value, known);
  throw hydro::InputError(fmt::format("{} refers to \"{}\", but there is no such body", record.title(), name.value),
                          name.place,
                          near.empty() ? "give a [[body]] this name" : fmt::format("did you mean \"{}\"?", near));
}

std::vector<int> bodies_on(const Record& record, std::string_view key, const std::vector<Body>& bodies) {
  std::vector<bool> chosen(bodies.size());
  for (const auto& pattern : record[key].texts) {
    bool any = false;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (matches(pattern.value, bodies[i].name)) any = chosen[i] = true;
    if (!any) body_named(record, pattern, bodies);  // throws with the nearest name
  }
  std::vector<int> out;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (chosen[i]) out.push_back(static_cast<int>(i));
  return out;
}

std::vector<PointPair> read_point_pairs(const Record& record, Names& names, const std::vector<Body>& bodies) {
  const auto pairs = read_between(record, bodies, GroundFirst::refused);
  const auto& ends = record["ends"].points;
  const auto name = names.of(record, pairs.size() * ends[0].size());
  std::vector<PointPair> out;
  for (const Between& pair : pairs)
    for (std::size_t k = 0; k < ends[0].size(); ++k)
      out.push_back({name[out.size()], *pair.first, pair.second, ends[0][k], ends[1][k]});
  return out;
}

}  // namespace froude::scene
