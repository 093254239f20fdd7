#include "scene/finer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <variant>

namespace froude::scene {
namespace {

namespace dl = dynamics::line;

/// A layer t around a diameter D adds ρ π t (D + t) per length, spread as the rest is. (D100)
void grow(const Line::Growth& growth, dl::Segment& s) {
  const double before = s.mass, t = growth.thickness;
  s.mass += growth.density * std::numbers::pi * t * (s.diameter + t) * s.length;
  s.inertia *= s.mass / before;
  s.diameter += 2 * t;
}

void add_growth(const Line::Growth& growth, std::vector<dl::Segment>& segments) {
  double along = 0;
  for (dl::Segment& s : segments) {
    if (const double middle = along + s.length / 2; middle > growth.from && middle < growth.to) grow(growth, s);
    along += s.length;
  }
}

/// Between nodes that were given, straight.
std::vector<Eigen::Vector3d> with_nodes_between(const std::vector<Eigen::Vector3d>& given, const Eigen::Vector3d& first,
                                                const std::optional<Eigen::Vector3d>& last, int times) {
  std::vector<Eigen::Vector3d> all{first}, out;
  all.insert(all.end(), given.begin(), given.end());
  if (last) all.push_back(*last);
  for (std::size_t i = 1; i < all.size(); ++i)
    for (int k = 1; k <= times; ++k)
      out.push_back(all[i - 1] + (all[i] - all[i - 1]) * (static_cast<double>(k) / times));
  if (last) out.pop_back();
  return out;
}

/// What acts at each node stands for what acts along the line.
void cut_finer(int times, Line& line) {
  for (Line::EvenPart& part : line.parts) part.segments *= times;
  line.segments = cut(line);
  line.node.share /= times;
  if (line.release) {
    line.release->node *= times;
    for (Line::HeldNode& also : line.release->also) also.node *= times;
  }
  for (Line::NodeLoad& load : line.loads) load.node *= times;
  if (!line.start) return;
  const auto at_rest = line.to.at ? std::optional<Eigen::Vector3d>(Eigen::Vector3d::Zero()) : std::nullopt;
  line.start->at = with_nodes_between(line.start->at, *line.from.at, line.to.at, times);
  line.start->velocity = with_nodes_between(line.start->velocity, Eigen::Vector3d::Zero(), at_rest, times);
}

/// "rope.link12.tension" in its pieces: "rope", "link", 12, ".tension".
struct Numbered {
  const Line* line;
  bool link;
  int number;
  std::string rest;
};

/// Nothing where it is of no node and no link of a line that is cut.
std::optional<Numbered> numbered(const Scene& scene, const std::string& signal) {
  for (const Line& line : scene.lines)
    for (const bool link : {false, true}) {
      const std::string begin = line.name + (link ? ".link" : ".node");
      if (!is_approximated(line) || !signal.starts_with(begin)) continue;
      const std::string tail = signal.substr(begin.size());
      const std::size_t digits = std::min(tail.find_first_not_of("0123456789"), tail.size());
      if (digits > 0) return Numbered{&line, link, std::stoi(tail.substr(0, digits)), tail.substr(digits)};
    }
  return std::nullopt;
}

}  // namespace

std::vector<dl::Segment> cut(const Line& line) {
  std::vector<dl::Segment> out;
  for (const Line::EvenPart& part : line.parts) {
    const double n = part.segments;
    dl::Segment segment = part.whole;
    segment.length /= n;
    segment.mass /= n;
    segment.inertia /= n * n * n;
    out.insert(out.end(), static_cast<std::size_t>(part.segments), segment);
  }
  if (line.growth) add_growth(*line.growth, out);
  return out;
}

bool is_approximated(const Line& line) {
  return !line.parts.empty() && line.node.mass == 0 && line.node.bob.diameter == 0;
}

bool approximates_lines(const Scene& scene) {
  return std::any_of(scene.lines.begin(), scene.lines.end(), is_approximated);
}

Scene with_finer_lines(Scene scene, int times) {
  for (Line& line : scene.lines)
    if (is_approximated(line)) cut_finer(times, line);
  for (Line& line : scene.lines)
    for (auto* end : {&line.from, &line.to})
      if (end->meets && !end->meets->junction && is_approximated(scene.lines[end->meets->line]))
        end->meets->node *= times;
  for (Connector& c : scene.connectors)
    if (auto* axial = std::get_if<AxialConnector>(&c.kind); axial && axial->switching) {
      std::string& watched = axial->switching->watch.value;
      watched = names_where_finer(scene, times, watched).front();
    }
  return scene;
}

std::vector<std::string> names_where_finer(const Scene& scene, int times, const std::string& signal) {
  const auto of = numbered(scene, signal);
  if (!of) return {signal};
  std::vector<std::string> out;
  const char* kind = of->link ? "link" : "node";
  for (int k = of->link ? times - 1 : 0; k >= 0; --k)
    out.push_back(fmt::format("{}.{}{}{}", of->line->name, kind, times * of->number - k, of->rest));
  return out;
}

}  // namespace froude::scene
