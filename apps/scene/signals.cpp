/// \file  Signals that a scene names.
#include "scene/build.hpp"

namespace froude::scene {
namespace {

void build_points(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("point")) {
    const auto on = bodies_on(record, "on", scene.bodies);
    const auto name = names.of(record, on.size());
    for (std::size_t b = 0; b < on.size(); ++b) {
      Point point{.name = name[b], .body = on[b], .at = record.vector("at")};
      for (const auto& what : record["gives"].texts) {
        if (what.value == "position") point.position = true;
        if (what.value == "velocity") point.velocity = true;
        if (what.value == "acceleration") point.acceleration = true;
        if (what.value == "air_gap") point.air_gap = true;
      }
      scene.points.push_back(std::move(point));
    }
  }
}

void build_relative_motions(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("relative_motion")) {
    const auto pairs = read_between(record, scene.bodies, GroundFirst::refused);
    if (pairs.front().second == pairs.front().first)
      throw record.wrong("between", "names one body twice: its points do not move against each other",
                         "name two bodies, or a body and the ground");
    const auto& ends = record["ends"].points;
    const auto name = names.of(record, pairs.size() * ends[0].size());
    for (std::size_t p = 0, n = 0; p < pairs.size(); ++p)
      for (std::size_t k = 0; k < ends[0].size(); ++k, ++n)
        scene.relative_motions.push_back({name[n], *pairs[p].first, pairs[p].second, ends[0][k], ends[1][k]});
  }
}

}  // namespace

void build_signals(const Record& root, Names& names, Scene& scene) {
  build_points(root, names, scene);
  build_relative_motions(root, names, scene);
}

}  // namespace froude::scene
