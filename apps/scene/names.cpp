/// \file  Names of things, and what tables say by the names of bodies.
#include <fmt/format.h>

#include <algorithm>

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
    if (bodies[i].family == family && bodies[i].copy > 1)
      pairs.push_back({static_cast<int>(i) - 1, static_cast<int>(i)});
  }
  if (std::find(families.begin(), families.end(), family) != families.end()) return pairs;
  const std::string near = hydro::nearest(family, families);
  throw record.wrong("between", fmt::format("names no neighbours: \"{}\" is not a body with copies", family),
                     near.empty() ? "give the body copies = { count = 2, step = \"(13, 0, 0) m\" }"
                                  : fmt::format("did you mean \"{}{}\"?", neighbours, near));
}

}  // namespace

Key between_key() {
  return texts(
      "between",
      "[\"a\", \"b\"], [\"a\", \"ground\"], or \"neighbours of m\": m1–m2, m2–m3, … of the copies m (of a single "
      "one there are none)");
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
