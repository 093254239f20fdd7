#include "view/view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dynamics/spatial/rotation.hpp"
#include "view/parts.hpp"

namespace froude::view {
namespace {

using Eigen::Vector3d;

/// What of bodies is not as it is: one sentence for each motion that is not kept, with all whose it is.
std::vector<std::string> notes_of_bodies(const scene::Scene& scene, const std::vector<BodyMotion>& motions,
                                         const std::vector<Shapes>& shapes) {
  std::vector<std::string> notes, still;
  std::map<std::string, std::vector<std::string>> without;  // names by the motions that are not kept
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyMotion& m = motions[i];
    if (!shapes[i].note.empty()) notes.push_back(shapes[i].note);
    if (!m.moves && !m.missing.empty())
      still.push_back(scene.bodies[i].name);
    else if (!m.missing.empty())
      without[fmt::format("{}", fmt::join(m.missing, ", "))].push_back(scene.bodies[i].name);
  }
  for (const auto& [motions_missing, names] : without)
    notes.push_back(fmt::format("The result does not keep the {} of {}, shown as if there were none.", motions_missing,
                                fmt::join(names, ", ")));
  if (!still.empty())
    notes.push_back(
        fmt::format("The result keeps no motion of {}, shown pale where it is at rest; [ask] run = {{ of = "
                    "[\"{}.*\"] }} would keep it.",
                    fmt::join(still, ", "), still.front()));
  return notes;
}

}  // namespace

Recorded::Recorded(const RunResult& run) {
  for (const Signal& s : run.signals) signals_[s.name] = &s;
}
const std::vector<double>* Recorded::find(const std::string& name) const {
  const auto at = signals_.find(name);
  return at == signals_.end() ? nullptr : &at->second->values;
}
std::optional<Vector3d> Recorded::place(const std::string& name, std::size_t sample) const {
  const auto *x = find(name + ".x"), *y = find(name + ".y"), *z = find(name + ".z");
  if (x == nullptr || y == nullptr || z == nullptr) return std::nullopt;
  return Vector3d((*x)[sample], (*y)[sample], (*z)[sample]);
}

BodyMotion motion_of(const scene::Body& body, const Recorded& recorded, const Frames& frames) {
  BodyMotion out;
  std::array<const std::vector<double>*, 6> motions{};
  for (std::size_t mode = 0; mode < 6; ++mode) {
    const std::string word(hydro::mode_names[mode]);
    motions[mode] = recorded.find(body.name + "." + word);
    if (motions[mode] != nullptr)
      out.moves = true;
    else if (body.free[mode])
      out.missing.push_back(word);
  }
  for (const std::size_t sample : frames.samples) {
    std::array<double, 6> q{};
    for (std::size_t mode = 0; mode < 6; ++mode) q[mode] = motions[mode] == nullptr ? 0 : (*motions[mode])[sample];
    out.poses.push_back({body.position + Vector3d(q[0], q[1], q[2]), dynamics::attitude_of({q[3], q[4], q[5]})});
  }
  return out;
}

View::View(const RunResult& run, scene::Scene scene, Frames frames, std::size_t most_triangles)
    : scene_(std::move(scene)), recorded_(run), frames_(std::move(frames)) {
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    motions_.push_back(motion_of(scene_.bodies[i], recorded_, frames_));
    shapes_.push_back(shapes_of(scene_, i, most_triangles));
  }
  notes_ = notes_of_bodies(scene_, motions_, shapes_);
  lines_ = lines_of(scene_, recorded_, frames_, motions_, notes_);
  surface_ = surface_of(scene_, run, recorded_, notes_);
}

}  // namespace froude::view
