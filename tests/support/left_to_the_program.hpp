#pragma once
/// \file  A scene with nothing left of what the program may choose itself, and finer ones to judge it by.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "scene/finer.hpp"
#include "scene/scene.hpp"

namespace support {

namespace left {

inline std::string without(std::string line, std::string_view begin, std::string_view end, std::string_view instead) {
  const auto from = line.find(begin);
  if (from == std::string::npos) return line;
  const auto to = line.find(end, from);
  return to == std::string::npos ? line : line.replace(from, to + end.size() - from, instead);
}

/// The number between `key` and ` s"` in a line.
inline std::optional<double> seconds(const std::string& line, std::string_view key) {
  const auto at = line.find(key);
  return at == std::string::npos ? std::nullopt : std::optional(std::stod(line.substr(at + key.size())));
}

inline std::string shortened(std::string line, double longest) {
  constexpr std::string_view duration = "duration = \"", every = "every = \"";
  const auto lasts = seconds(line, duration), sampled = seconds(line, every);
  if (!line.starts_with("run = ") || !lasts || !sampled || *lasts <= longest) return line;
  const double kept = *sampled * std::floor(longest / *sampled + 1e-9);
  return without(std::move(line), duration, " s\"", fmt::format("{}{:.10g} s\"", duration, kept));
}

inline bool is_chosen_by_the_program(const std::string& line) {
  const std::string key = line.substr(0, line.find_first_of(" ="));
  return key == "step" || key == "accept_error" || key == "accuracy" || key == "rao" || key == "modes";
}

}  // namespace left

/// The text of a scene that asks for a run alone, `longest` s at most, to an accuracy; step, memory and pieces of
/// members are the program's to choose, whatever error its memory makes against the data.
inline std::string left_to_the_program(const std::string& text, double accuracy, double longest) {
  constexpr std::string_view pieces = ", pieces = ";
  std::string out, inside, line;
  for (std::istringstream in(text); std::getline(in, line);) {
    if (line.starts_with("[")) inside = line;
    const bool asks = inside.starts_with("[ask]");
    if ((asks || inside.starts_with("[solve]")) && left::is_chosen_by_the_program(line)) continue;
    line = left::without(line, "radiation = {", "}", "radiation = { accept_error = 10 }");
    if (const auto at = line.find(pieces); at != std::string::npos)
      line.erase(at, line.find_first_not_of("0123456789", at + pieces.size()) - at);
    out += left::shortened(line, longest) + "\n";
    if (line.starts_with("[ask]")) out += fmt::format("accuracy = {}\n", accuracy);
  }
  return out;
}

/// What is finer in a reference than in the run that it judges.
struct Finer {
  std::optional<double> step = {};             ///< s, at most
  std::optional<std::string> integrator = {};  ///< of bodies; of lines generalized_alpha, where it can
  bool memory = false;                         ///< as near to the data as a method comes, 1e-4 if one can
  bool links = false;                          ///< each segment of a line in three
};
constexpr int three = 3;

inline froude::scene::Scene refined(froude::scene::Scene scene, const Finer& finer) {
  if (finer.step) {
    const double every = scene.run->every;
    scene.solve.step = froude::scene::Located<double>{every / std::ceil(every / *finer.step - 1e-9), {}};
  }
  if (finer.integrator) {
    scene.solve.integrator = *finer.integrator;
    const bool neighbours =
        std::any_of(scene.lines.begin(), scene.lines.end(), [](const auto& l) { return l.lyapunov.has_value(); });
    if (!neighbours) scene.solve.line_scheme = "generalized_alpha";
  }
  for (auto& body : scene.bodies)
    if (finer.memory && body.hydrodynamics) {
      body.hydrodynamics->memory.tolerance = 1e-4;
      body.hydrodynamics->memory.method = froude::scene::Memory::Method::automatic;
    }
  if (!finer.links || !froude::scene::approximates_lines(scene)) return scene;
  scene.run->of.clear();
  scene.run->of_places.clear();
  return froude::scene::with_finer_lines(std::move(scene), three);
}

/// The name that a signal of `scene` has where each segment is three: of node 4 that of node 12, of link 4 that of link
/// 11.
inline std::string name_where_cut(const froude::scene::Scene& scene, const std::string& name) {
  const auto names = froude::scene::names_where_finer(scene, three, name);
  return names[names.size() / 2];
}

}  // namespace support
