#include "report/view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"
#include "report/contents.hpp"

namespace froude::html {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_frames = 2400, most_numbers_of_poses = 500'000;

Frames frames_of(const RunResult& run, std::size_t bodies) {
  const std::size_t most =
      std::clamp<std::size_t>(most_numbers_of_poses / (7 * std::max<std::size_t>(bodies, 1)), 200, most_frames);
  const std::size_t stride = (run.time.size() + most - 1) / most;
  Frames out;
  for (std::size_t i = 0; i < run.time.size(); i += stride) out.samples.push_back(i);
  return out;
}

Json poses_told(const std::vector<Pose>& poses) {
  std::vector<double> flat;
  for (const Pose& p : poses)
    for (const double v :
         {p.origin.x(), p.origin.y(), p.origin.z(), p.attitude.x(), p.attitude.y(), p.attitude.z(), p.attitude.w()})
      flat.push_back(v);
  return single_array(flat);
}

Json bodies_told(const scene::Scene& scene, const std::vector<BodyMotion>& motions, std::vector<std::string>& notes) {
  Json out = Json::array();
  std::vector<std::string> still;
  std::map<std::string, std::vector<std::string>> without;  // names by the motions that are not kept
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyMotion& m = motions[i];
    Json one{{"name", scene.bodies[i].name}, {"moves", m.moves}, {"poses", poses_told(m.poses)}};
    one.update(shapes_of(scene, i));
    if (one.contains("note")) notes.push_back(one["note"]);
    if (!m.moves && !m.missing.empty())
      still.push_back(scene.bodies[i].name);
    else if (!m.missing.empty())
      without[fmt::format("{}", fmt::join(m.missing, ", "))].push_back(scene.bodies[i].name);
    out.push_back(std::move(one));
  }
  for (const auto& [motions_missing, names] : without)
    notes.push_back(fmt::format("The result does not keep the {} of {}, shown as if there were none.", motions_missing,
                                fmt::join(names, ", ")));
  if (!still.empty())
    notes.push_back(
        fmt::format("The result keeps no motion of {}, shown pale where it is at rest; [ask] run = {{ of = "
                    "[\"{}.*\"] }} would keep it.",
                    fmt::join(still, ", "), still.front()));
  return out;
}

/// Notes of copies differ in a name: more than a few of one beginning are one.
std::vector<std::string> few(const std::vector<std::string>& notes) {
  constexpr std::size_t most = 12;
  std::vector<std::string> out(notes.begin(),
                               notes.begin() + static_cast<std::ptrdiff_t>(std::min(most, notes.size())));
  if (notes.size() > most) out.push_back(fmt::format("The same is true of {} more.", notes.size() - most));
  return out;
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

Json view_of(const RunResult& run, const std::string& scene_text, const std::filesystem::path& scene_file) {
  try {
    const scene::Scene scene = scene::parse(scene_text, scene_file);
    const Recorded recorded(run);
    const Frames frames = frames_of(run, scene.bodies.size());
    std::vector<double> time;
    for (const std::size_t sample : frames.samples) time.push_back(run.time[sample]);
    std::vector<BodyMotion> motions;
    for (const scene::Body& body : scene.bodies) motions.push_back(motion_of(body, recorded, frames));
    std::vector<std::string> of_bodies, notes;
    Json out{{"time", double_array(time)}};
    out["bodies"] = bodies_told(scene, motions, of_bodies);
    out["lines"] = lines_of(scene, recorded, frames, motions, notes);
    out["surface"] = surface_of(scene, run, recorded, notes);
    if (!scene.water.depth.is_infinite()) out["depth"] = scene.water.depth.metres();
    notes.insert(notes.begin(), of_bodies.begin(), of_bodies.end());
    out["notes"] = few(notes);
    if (scene.bodies.empty() && out["lines"].empty()) return {{"missing", "The scene has neither bodies nor lines."}};
    return out;
  } catch (const hydro::InputError& e) {
    return {{"missing", fmt::format("The scene cannot be read where it is now ({}), so nothing can be drawn in space; "
                                    "--scene-folder names the folder where it stood.",
                                    e.rule())}};
  }
}

}  // namespace froude::html
