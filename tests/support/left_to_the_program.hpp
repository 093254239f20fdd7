#pragma once
/// \file  A scene with nothing left of what the program may choose itself, and finer ones to judge it by.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace support {

/// The text of a scene that asks for a run alone, `longest` s at most, to an accuracy; step, memory and pieces of
/// members are the program's to choose, whatever error its memory makes against the data.
inline std::string left_to_the_program(const std::string& text, double accuracy, double longest) {
  static const std::regex chosen(R"(^\s*(step|accept_error|accuracy|rao|modes)\s*=.*)"),
      radiation(R"(radiation = \{.*\})"), pieces(R"(, pieces = \d+)"), table(R"(^\s*\[.*)"), ask(R"(^\s*\[ask\].*)"),
      duration(R"((run = .*duration = ")([0-9.]+)( s", every = ")([0-9.]+)( s".*))");
  std::string out, inside, line;
  for (std::istringstream in(text); std::getline(in, line);) {
    std::smatch found;
    if (std::regex_match(line, table)) inside = line;
    const bool may_be_chosen = inside.starts_with("[ask]") || inside.starts_with("[solve]");
    if (may_be_chosen && std::regex_match(line, chosen)) continue;
    line = std::regex_replace(line, radiation, "radiation = { accept_error = 10 }");
    line = std::regex_replace(line, pieces, "");
    if (std::regex_match(line, found, duration) && std::stod(found[2]) > longest) {
      const double every = std::stod(found[4]);
      line = fmt::format("{}{:.10g}{}{}{}", found[1].str(), every * std::floor(longest / every + 1e-9), found[3].str(),
                         found[4].str(), found[5].str());
    }
    out += line + "\n";
    if (std::regex_match(line, ask)) out += fmt::format("accuracy = {}\n", accuracy);
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

/// Segments of lines that the scene cuts into equal ones; links that it lists are bodies by themselves.
inline bool has_segments(const froude::scene::Scene& scene) {
  return !scene.lines.empty() && scene.text.find("segments = ") != std::string::npos;
}

inline void cut_in_three(froude::scene::Line& line) {
  std::vector<dynamics::line::Segment> all;
  for (dynamics::line::Segment s : line.segments) {
    s.length /= 3;
    s.mass /= 3;
    s.inertia /= 27;
    all.insert(all.end(), 3, s);
  }
  line.segments = std::move(all);
  line.node.mass /= 3;
  line.node.damping /= 3;
  line.node.quadratic_damping /= 3;
  line.node.force /= 3;
  for (auto* end : {&line.from, &line.to})
    if (end->meets) end->meets->node *= 3;
  if (line.release) line.release->node *= 3;
}

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
  if (finer.links && has_segments(scene)) {
    for (auto& line : scene.lines) cut_in_three(line);
    scene.run->of.clear();
    scene.run->of_places.clear();
  }
  return scene;
}

/// The name that a signal has where each segment is three: of node 4 that of node 12, of link 4 that of link 11.
inline std::string name_where_cut(const std::string& name) {
  static const std::regex numbered(R"((.*\.)(node|link)(\d+)(.*))");
  std::smatch found;
  if (!std::regex_match(name, found, numbered)) return name;
  const int number = 3 * std::stoi(found[3]) - (found[2] == "link" ? 1 : 0);
  return fmt::format("{}{}{}{}", found[1].str(), found[2].str(), number, found[4].str());
}

}  // namespace support
