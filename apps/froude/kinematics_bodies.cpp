#include "froude/kinematics_bodies.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "compile/start.hpp"
#include "froude/outputs.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/edit.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace fc = ::fit::camera;
using hydro::InputError;
using hydro::Mode;

/// "body[2]": the table of a body in the text of its scene.
std::string table_of(const scene::Scene& scene, int body) {
  std::size_t table = 0;
  std::string family;
  for (int i = 0; i <= body; ++i) {
    const scene::Body& b = scene.bodies[static_cast<std::size_t>(i)];
    if (b.copy > 1) continue;
    ++table;
    family = b.family;
  }
  if (scene.bodies[static_cast<std::size_t>(body)].copy > 0)
    throw InputError(fmt::format("\"{}\" is one of the copies of \"{}\", which begin alike",
                                 scene.bodies[static_cast<std::size_t>(body)].name, family),
                     scene.bodies[static_cast<std::size_t>(body)].place, "give each its own [[body]]");
  return fmt::format("body[{}]", table);
}

/// What a mode becomes in [body.initial], or in [body.initial_velocity].
std::string written(Mode mode, double value, bool rate) {
  return fmt::format("\"{:.12g} {}{}\"", value, hydro::is_rotation(mode) ? "rad" : "m", rate ? "/s" : "");
}

/// Into the table of these modes, which may be there already.
void write_modes(const std::string& table, bool there, const std::map<Mode, double>& values, bool rate,
                 std::vector<scene::TextEdit>& out) {
  std::vector<std::string> inline_keys;
  for (const auto& [mode, value] : values) {
    const auto name = hydro::mode_names[static_cast<std::size_t>(mode)];
    if (there)
      out.push_back({fmt::format("{}.{}", table, name), written(mode, value, rate)});
    else
      inline_keys.push_back(fmt::format("{} = {}", name, written(mode, value, rate)));
  }
  if (!inline_keys.empty()) out.push_back({table, fmt::format("{{ {} }}", fmt::join(inline_keys, ", "))});
}

}  // namespace

std::vector<fc::MarkerInSpace> markers_on(const scene::Scene& scene, int body,
                                          const std::vector<std::string>& markers) {
  std::vector<fc::MarkerInSpace> out;
  const auto take = [&](const std::string& name, const Eigen::Vector3d& at) {
    if (std::find(markers.begin(), markers.end(), name) != markers.end()) out.push_back({name, at});
  };
  for (const scene::Point& p : scene.points)
    if (p.body == body) take(p.name, p.at);
  for (const scene::Joint& j : scene.joints)
    if (j.first == body || j.second == body) take(j.name, j.at - scene.bodies[static_cast<std::size_t>(body)].position);
  return out;
}

FilmedBodies::FilmedBodies(const std::filesystem::path& scene_of_motion, const scene::CameraTable& camera,
                           const fc::SmoothTrack& track)
    : file_(scene_of_motion), scene_(scene::read(file_)) {
  const int along = camera.along();
  modes_ =
      along == 0 ? std::array{Mode::surge, Mode::heave, Mode::pitch} : std::array{Mode::sway, Mode::heave, Mode::roll};
  for (int b = 0; b < static_cast<int>(scene_.bodies.size()); ++b) {
    Filmed filmed{b, {}, {}, 0};
    for (const fc::MarkerInSpace& m : markers_on(scene_, b, track.markers))
      filmed.markers.push_back({m.marker, {m.at[along], m.at.z()}});
    if (filmed.markers.size() < 2) continue;
    const scene::Body& body = scene_.bodies[static_cast<std::size_t>(b)];
    // About +y the x axis turns down; about +x the y axis turns up.
    filmed.motion = scene::placed(body.place, [&] { return fc::planar_motion(track, filmed.markers, along == 0); });
    double squares = 0;
    for (fc::PlanarMotion& now : filmed.motion) {
      now.place.head<2>() -= Eigen::Vector2d(body.position[along], body.position.z());
      squares += now.stray * now.stray;
    }
    filmed.stray = std::sqrt(squares / static_cast<double>(filmed.motion.size()));
    bodies_.push_back(std::move(filmed));
  }
}

std::string FilmedBodies::named(const Filmed& filmed, int k) const {
  return fmt::format("{}.{}", scene_.bodies[static_cast<std::size_t>(filmed.body)].name,
                     hydro::mode_names[static_cast<std::size_t>(modes_[static_cast<std::size_t>(k)])]);
}

bool FilmedBodies::tells(std::string_view signal) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Filmed& b) {
    return signal == named(b, 0) || signal == named(b, 1) || signal == named(b, 2);
  });
}

std::vector<SmoothedColumn> FilmedBodies::columns() const {
  static constexpr const char* what[] = {"", "_velocity", "_acceleration"};
  static constexpr const char* per[] = {"", "/s", "/s^2"};
  std::vector<SmoothedColumn> out;
  for (const Filmed& b : bodies_)
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 3; ++d) {
        SmoothedColumn column{named(b, k) + what[d], std::string(k == 2 ? "rad" : "m") + per[d], {}, {}};
        for (const fc::PlanarMotion& now : b.motion) {
          column.value.push_back((d == 0 ? now.place : d == 1 ? now.velocity : now.acceleration)[k]);
          column.deviation.push_back(std::sqrt(now.covariance(3 * d + k, 3 * d + k)));
        }
        out.push_back(std::move(column));
      }
  return out;
}

FilmedStart FilmedBodies::start(const NearFrame& at, const std::filesystem::path& beside,
                                const std::string& when) const {
  if (bodies_.size() != scene_.bodies.size() || bodies_.empty())
    throw InputError(
        fmt::format("of {} bodies of the scene {} have two markers on them, named as its points and joints",
                    scene_.bodies.size(), bodies_.size()),
        {.file = "--start"},
        "name markers as [[point]]s and [[joint]]s of the scene, or, for the start of a line, its nodes: "
        "--nodes \"joint, bob\"");
  const auto files = files_of_scene(file_);
  const auto folder_of = [](const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file)).parent_path();
  };
  if (files.size() > 1 && folder_of(beside) != folder_of(file_))
    throw InputError("the scene names files, which a scene in another folder would not find", {.file = "--start"},
                     fmt::format("write it beside {}", file_.string()));
  FilmedStart out{};
  std::vector<compile::BodyStart> measured(scene_.bodies.size());
  for (const Filmed& b : bodies_) {
    const fc::PlanarMotion& now = b.motion[at.frame];
    for (int k = 0; k < 3; ++k) {
      const Mode mode = modes_[static_cast<std::size_t>(k)];
      auto& one = measured[static_cast<std::size_t>(b.body)];
      one.displacement[mode] = now.place[k] + at.since * (now.velocity[k] + at.since / 2 * now.acceleration[k]);
      one.velocity[mode] = now.velocity[k] + at.since * now.acceleration[k];
      for (int d = 0; d < 2; ++d) {
        double& largest = out.deviation[static_cast<std::size_t>(2 * d + (k == 2 ? 1 : 0))];
        largest = std::max(largest, std::sqrt(now.covariance(3 * d + k, 3 * d + k)));
      }
    }
  }
  const compile::ClosedStart closed = compile::closed_start(scene_, measured);
  out.opened = closed.opened;
  std::vector<scene::TextEdit> edits;
  for (int b = 0; b < static_cast<int>(scene_.bodies.size()); ++b) {
    const scene::Body& body = scene_.bodies[static_cast<std::size_t>(b)];
    const auto& start = closed.bodies[static_cast<std::size_t>(b)];
    const std::string table = table_of(scene_, b);
    write_modes(table + ".initial", !body.initial.empty(), start.displacement, false, edits);
    write_modes(table + ".initial_velocity", !body.initial_velocity.empty(), start.velocity, true, edits);
  }
  out.text = fmt::format("# Bodies begin as filmed at {}, smoothed by froude {}.\n", when, FROUDE_VERSION) +
             scene::edited(hydro::io::read_text(file_), file_.string(), edits);
  return out;
}

void FilmedBodies::say(Report& report) const {
  constexpr double doubtful = 3;  // of errors, rms over all frames: no chance makes it
  std::vector<std::string> cautions;
  for (const Filmed& b : bodies_) {
    const std::string& name = scene_.bodies[static_cast<std::size_t>(b.body)].name;
    report.row("body", "  {}: pose of {} markers, which stray from it by {:.2g} of their errors", fact("name", name),
               fact("markers", b.markers.size()), fact("stray", b.stray));
    if (b.stray > doubtful)
      cautions.push_back(
          fmt::format("markers on \"{}\" stray from their places on it by {:.2g} of their errors: the bandwidth "
                      "is too low, they do not sit where the scene has them, or the scale or the lens is wrong",
                      name, b.stray));
  }
  report.sentences("cautions", "note: {}", cautions);
}

}  // namespace froude
