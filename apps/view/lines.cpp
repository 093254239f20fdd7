// Lines, catenaries and connectors of a run, in space.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>
#include <limits>

#include "dynamics/line/catenary.hpp"
#include "hydro/base/error.hpp"
#include "view/parts.hpp"

namespace froude::view {
namespace {

using Eigen::Vector3d;

constexpr int pieces_of_catenary = 16;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
const Vector3d unknown = Vector3d::Constant(not_known);

/// A signal at a sample, if the result keeps it.
double recorded_at(const Recorded& recorded, const std::string& name, std::size_t sample) {
  const auto* values = recorded.find(name);
  return values == nullptr ? not_known : (*values)[sample];
}

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
               const std::vector<BodyMotion>& bodies, std::vector<Line>& out, std::vector<std::string>& notes) {
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
                   },
                   [&, &line = line](std::size_t piece, std::size_t frame) {
                     return recorded_at(recorded, fmt::format("{}.link{}.tension", line.name, piece + 1),
                                        frames.samples[frame]);
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

/// How a mooring hangs from where its fairlead is. \throws hydro::NumericsError
struct Hanging {
  Hanging(const scene::CatenaryLine& of, const Vector3d& fairlead)
      : mooring(of),
        away(fairlead - of.anchor),
        reach(std::hypot(away.x(), away.y())),
        tension(dynamics::catenary(of.line, reach, away.z())) {}
  Vector3d place(double s) const {
    const Eigen::Vector2d at = on_catenary(mooring.line, tension, s);
    const Vector3d along = reach > 0 ? Vector3d(away.x() / reach, away.y() / reach, 0) : Vector3d::Zero();
    return mooring.anchor + at.x() * along + at.y() * Vector3d::UnitZ();
  }
  double tension_at(double s) const {
    const double hanging = std::max(s - tension.resting, 0.0);
    return std::hypot(tension.horizontal, tension.anchor_vertical + mooring.line.weight * hanging);
  }
  const scene::CatenaryLine& mooring;
  Vector3d away;
  double reach;
  dynamics::LineTension tension;
};

void add_catenaries(const scene::Scene& scene, const std::vector<BodyMotion>& bodies, std::vector<Line>& out) {
  for (const scene::CatenaryLine& mooring : scene.catenaries) {
    // `read` of the mooring at the unstretched length of so many pieces, or what stands for what is not known.
    const auto read = [&](double pieces, std::size_t frame, auto tell, auto otherwise) {
      const Pose& pose = bodies[static_cast<std::size_t>(mooring.body)].poses[frame];
      try {
        return tell(Hanging(mooring, pose.of(mooring.fairlead)), mooring.line.length * pieces / pieces_of_catenary);
      } catch (const hydro::NumericsError&) {
        return otherwise;
      }
    };
    out.push_back({mooring.name, "catenary", pieces_of_catenary + 1,
                   [read](std::size_t point, std::size_t frame) {
                     return read(
                         static_cast<double>(point), frame, [](const Hanging& h, double s) { return h.place(s); },
                         unknown);
                   },
                   [read](std::size_t piece, std::size_t frame) {
                     return read(
                         static_cast<double>(piece) + 0.5, frame,
                         [](const Hanging& h, double s) { return h.tension_at(s); }, not_known);
                   }});
  }
}

void add_connectors(const scene::Scene& scene, const Recorded& recorded, const Frames& frames,
                    const std::vector<BodyMotion>& bodies, std::vector<Line>& out) {
  for (const scene::Connector& c : scene.connectors)
    out.push_back({c.name, "connector", 2,
                   [&](std::size_t point, std::size_t frame) -> Vector3d {
                     if (point == 0) return bodies[static_cast<std::size_t>(c.first)].poses[frame].of(c.first_end);
                     if (!c.second) return c.second_end;
                     return bodies[static_cast<std::size_t>(*c.second)].poses[frame].of(c.second_end);
                   },
                   [&](std::size_t, std::size_t frame) {
                     return recorded_at(recorded, c.name + ".force", frames.samples[frame]);
                   }});
}

}  // namespace

std::vector<Line> lines_of(const scene::Scene& scene, const Recorded& recorded, const Frames& frames,
                           const std::vector<BodyMotion>& bodies, std::vector<std::string>& notes) {
  std::vector<Line> out;
  add_lines(scene, recorded, frames, bodies, out, notes);
  add_catenaries(scene, bodies, out);
  add_connectors(scene, recorded, frames, bodies, out);
  return out;
}

}  // namespace froude::view
