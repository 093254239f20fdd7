// What moves in a run, as the page's animation takes it.
#include "view/view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hydro/base/error.hpp"
#include "report/contents.hpp"

namespace froude::html {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_frames = 2400, most_numbers_of_poses = 500'000, most_numbers_of_lines = 400'000;
constexpr std::size_t most_triangles_shown = 20'000;

view::Frames frames_of(const RunResult& run, std::size_t bodies) {
  const std::size_t most =
      std::clamp<std::size_t>(most_numbers_of_poses / (7 * std::max<std::size_t>(bodies, 1)), 200, most_frames);
  const std::size_t stride = (run.time.size() + most - 1) / most;
  view::Frames out;
  for (std::size_t i = 0; i < run.time.size(); i += stride) out.samples.push_back(i);
  return out;
}

/// Every so many frames of the animation have the places of lines; between them they are on straight lines.
std::size_t line_stride(std::size_t frames, std::size_t points) {
  const std::size_t most = std::max<std::size_t>(most_numbers_of_lines / (3 * std::max<std::size_t>(points, 1)), 50);
  return (frames + most - 1) / most;
}

Json poses_told(const std::vector<view::Pose>& poses) {
  std::vector<double> flat;
  for (const view::Pose& p : poses)
    for (const double v :
         {p.origin.x(), p.origin.y(), p.origin.z(), p.attitude.x(), p.attitude.y(), p.attitude.z(), p.attitude.w()})
      flat.push_back(v);
  return single_array(flat);
}

Json vector_told(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json shape_told(const view::Cylinder& c) {
  return {{"kind", "cylinder"}, {"from", vector_told(c.from)}, {"to", vector_told(c.to)}, {"radius", c.radius}};
}
Json shape_told(const view::Sphere& s) {
  return {{"kind", "sphere"}, {"centre", vector_told(s.centre)}, {"radius", s.radius}};
}
Json shape_told(const view::Box& b) {
  return {{"kind", "box"}, {"low", vector_told(b.low)}, {"high", vector_told(b.high)}};
}
Json shape_told(const hydro::hydrostatics::TriangleMesh& mesh) {
  std::vector<double> vertices;
  Json triangles = Json::array();
  for (const Vector3d& v : mesh.vertices) vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
  for (const auto& t : mesh.triangles)
    for (const int corner : t) triangles.push_back(corner);
  return {{"kind", "mesh"}, {"vertices", single_array(vertices)}, {"triangles", triangles}};
}

Json bodies_told(const view::View& v) {
  Json out = Json::array();
  for (std::size_t i = 0; i < v.scene().bodies.size(); ++i) {
    const view::BodyMotion& m = v.motions()[i];
    Json shapes = Json::array();
    for (const view::Shape& shape : v.shapes()[i].all)
      shapes.push_back(std::visit([](const auto& of_kind) { return shape_told(of_kind); }, shape));
    Json one{{"name", v.scene().bodies[i].name}, {"moves", m.moves}, {"poses", poses_told(m.poses)}};
    if (!v.shapes()[i].note.empty()) one["note"] = v.shapes()[i].note;
    one["shapes"] = shapes;
    out.push_back(std::move(one));
  }
  return out;
}

Json lines_told(const view::View& v) {
  std::size_t points = 0;
  for (const view::Line& line : v.lines()) points += line.points;
  const std::size_t frames = v.frames().count(), stride = line_stride(frames, points);
  Json out = Json::array();
  for (const view::Line& line : v.lines()) {
    std::vector<double> flat;
    for (std::size_t f = 0; f < frames; f += stride)
      for (std::size_t p = 0; p < line.points; ++p) {
        const Vector3d at = line.place(p, f);
        flat.insert(flat.end(), {at.x(), at.y(), at.z()});
      }
    out.push_back({{"name", line.name},
                   {"kind", line.kind},
                   {"points", line.points},
                   {"places", single_array(flat)},
                   {"stride", stride}});
  }
  return out;
}

Json surface_told(const std::optional<view::Surface>& surface) {
  if (!surface) return {};
  Json out{{"ramp", surface->ramp},      {"omega", Json::array()}, {"k", Json::array()},
           {"amplitude", Json::array()}, {"phase", Json::array()}, {"heading", Json::array()}};
  for (const auto& w : surface->components) {
    out["omega"].push_back(w.omega), out["k"].push_back(w.k), out["amplitude"].push_back(w.amplitude);
    out["phase"].push_back(w.phase), out["heading"].push_back(w.heading);
  }
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

Json view_of(const RunResult& run, const std::string& scene_text, const std::filesystem::path& scene_file) {
  try {
    scene::Scene scene = scene::parse(scene_text, scene_file);
    const view::Frames frames = frames_of(run, scene.bodies.size());
    std::vector<double> time;
    for (const std::size_t sample : frames.samples) time.push_back(run.time[sample]);
    const view::View v(run, std::move(scene), frames, most_triangles_shown);
    if (v.scene().bodies.empty() && v.lines().empty()) return {{"missing", "The scene has neither bodies nor lines."}};
    Json out{{"time", double_array(time)}};
    out["bodies"] = bodies_told(v);
    out["lines"] = lines_told(v);
    out["surface"] = surface_told(v.surface());
    if (!v.scene().water.depth.is_infinite()) out["depth"] = v.scene().water.depth.metres();
    out["notes"] = few(v.notes());
    return out;
  } catch (const hydro::InputError& e) {
    return {{"missing", fmt::format("The scene cannot be read where it is now ({}), so nothing can be drawn in space; "
                                    "--scene-folder names the folder where it stood.",
                                    e.rule())}};
  }
}

}  // namespace froude::html
