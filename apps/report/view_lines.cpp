// Lines, catenaries and connectors of an animation.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>
#include <limits>

#include "dynamics/line/catenary.hpp"
#include "hydro/base/error.hpp"
#include "report/view.hpp"

namespace froude::html {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_numbers_of_lines = 400'000;
constexpr int pieces_of_catenary = 16;

/// Every so many frames of the animation have the places of lines; between them they are on straight lines.
std::size_t line_stride(std::size_t frames, std::size_t points) {
  const std::size_t most = std::max<std::size_t>(most_numbers_of_lines / (3 * std::max<std::size_t>(points, 1)), 50);
  return (frames + most - 1) / most;
}

struct DrawnLine {
  std::string name, kind;  ///< "line", "catenary", "connector"
  std::size_t points;
  std::function<Vector3d(std::size_t point, std::size_t frame)> place;  ///< not finite where nothing is known
};

Json told(const DrawnLine& line, std::size_t frames, std::size_t stride) {
  std::vector<double> flat;
  for (std::size_t f = 0; f < frames; f += stride)
    for (std::size_t p = 0; p < line.points; ++p) {
      const Vector3d at = line.place(p, f);
      flat.insert(flat.end(), {at.x(), at.y(), at.z()});
    }
  return {{"name", line.name}, {"kind", line.kind}, {"points", line.points}, {"places", single_array(flat)}};
}

const Vector3d unknown = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

/// A node as it is recorded; an end also by what holds it.
Vector3d node_place(const scene::Scene& scene, const Recorded& recorded, const Frames& frames,
                    const std::vector<BodyMotion>& bodies, const scene::Line& line, int node, std::size_t frame) {
  const std::size_t sample = frames.samples[frame];
  if (const auto at = recorded.place(fmt::format("{}.node{}", line.name, node), sample)) return *at;
  const bool first = node == 0;
  if (!first && node != line.last_node()) return unknown;
  const scene::Line::End& end = line.end(first);
  if (end.body) return end.at ? bodies[static_cast<std::size_t>(*end.body)].poses[frame].of(*end.at) : unknown;
  if (end.at) return *end.at;
  if (!end.meets) return unknown;
  if (end.meets->junction) return recorded.place(scene.junctions[*end.meets->junction].name, sample).value_or(unknown);
  const scene::Line& other = scene.lines[end.meets->line];
  return recorded.place(fmt::format("{}.node{}", other.name, end.meets->node), sample).value_or(unknown);
}

void add_lines(const scene::Scene& scene, const Recorded& recorded, const Frames& frames,
               const std::vector<BodyMotion>& bodies, std::vector<DrawnLine>& out, std::vector<std::string>& notes) {
  std::vector<std::string> sparse, to_keep;
  for (const scene::Line& line : scene.lines) {
    int known = 0;
    for (int i = 0; i <= line.last_node(); ++i)
      known += node_place(scene, recorded, frames, bodies, line, i, 0).allFinite() ? 1 : 0;
    if (known <= line.last_node()) {
      sparse.push_back(fmt::format("{} of {} nodes of {}", known, line.last_node() + 1, line.name));
      to_keep.push_back(fmt::format("\"{}.node*\"", line.name));
    }
    if (known == 0) continue;
    out.push_back({line.name, "line", static_cast<std::size_t>(line.last_node()) + 1,
                   [&, &line = line](std::size_t point, std::size_t frame) {
                     return node_place(scene, recorded, frames, bodies, line, static_cast<int>(point), frame);
                   }});
  }
  if (!sparse.empty())
    notes.push_back(
        fmt::format("The result keeps the places of {}; only pieces between known neighbours are drawn. "
                    "[ask] run = {{ of = [{}] }} would keep all.",
                    fmt::join(sparse, ", "), fmt::join(to_keep, ", ")));
}

/// Along the line from the anchor, (x, z) from it, at the unstretched length s; (D60), (D61).
Eigen::Vector2d on_catenary(const dynamics::LineProperties& line, const dynamics::LineTension& t, double s) {
  const double H = std::max(t.horizontal, 1e-9 * line.weight * line.length), w = line.weight;
  const double resting = std::min(s, t.resting);
  const double from = t.anchor_vertical, to = from + w * (s - resting);
  const double hanging = s - resting;
  const double x = resting * (1 + H / line.axial_stiffness) + H / w * (std::asinh(to / H) - std::asinh(from / H)) +
                   H * hanging / line.axial_stiffness;
  const double z =
      (std::hypot(H, to) - std::hypot(H, from)) / w + (to * to - from * from) / (2 * w * line.axial_stiffness);
  return {x, z};
}

Vector3d catenary_place(const scene::CatenaryLine& mooring, const Vector3d& fairlead, std::size_t point) {
  const Vector3d away = fairlead - mooring.anchor;
  const double reach = std::hypot(away.x(), away.y());
  const dynamics::LineTension t = dynamics::catenary(mooring.line, reach, away.z());
  const double s = mooring.line.length * static_cast<double>(point) / pieces_of_catenary;
  const Eigen::Vector2d at = on_catenary(mooring.line, t, s);
  const Vector3d along = reach > 0 ? Vector3d(away.x() / reach, away.y() / reach, 0) : Vector3d::Zero();
  return mooring.anchor + at.x() * along + at.y() * Vector3d::UnitZ();
}

void add_catenaries(const scene::Scene& scene, const std::vector<BodyMotion>& bodies, std::vector<DrawnLine>& out) {
  for (const scene::CatenaryLine& mooring : scene.catenaries)
    out.push_back(
        {mooring.name, "catenary", pieces_of_catenary + 1, [&](std::size_t point, std::size_t frame) -> Vector3d {
           const Pose& pose = bodies[static_cast<std::size_t>(mooring.body)].poses[frame];
           try {
             return catenary_place(mooring, pose.of(mooring.fairlead), point);
           } catch (const hydro::NumericsError&) {
             return unknown;
           }
         }});
}

void add_connectors(const scene::Scene& scene, const std::vector<BodyMotion>& bodies, std::vector<DrawnLine>& out) {
  for (const scene::Connector& c : scene.connectors)
    out.push_back({c.name, "connector", 2, [&](std::size_t point, std::size_t frame) -> Vector3d {
                     if (point == 0) return bodies[static_cast<std::size_t>(c.first)].poses[frame].of(c.first_end);
                     if (!c.second) return c.second_end;
                     return bodies[static_cast<std::size_t>(*c.second)].poses[frame].of(c.second_end);
                   }});
}

}  // namespace

Json lines_of(const scene::Scene& scene, const Recorded& recorded, const Frames& frames,
              const std::vector<BodyMotion>& bodies, std::vector<std::string>& notes) {
  std::vector<DrawnLine> drawn;
  add_lines(scene, recorded, frames, bodies, drawn, notes);
  add_catenaries(scene, bodies, drawn);
  add_connectors(scene, bodies, drawn);
  std::size_t points = 0;
  for (const DrawnLine& line : drawn) points += line.points;
  const std::size_t stride = line_stride(frames.count(), points);
  Json out = Json::array();
  for (const DrawnLine& line : drawn) {
    out.push_back(told(line, frames.count(), stride));
    out.back()["stride"] = stride;
  }
  return out;
}

}  // namespace froude::html
