// What a body looks like, by what its scene says of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/mesh.hpp"
#include "report/view.hpp"

namespace froude::html {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_triangles = 20'000;

Json vector_told(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json cylinder_told(const Vector3d& from, const Vector3d& to, double radius) {
  return {{"kind", "cylinder"}, {"from", vector_told(from)}, {"to", vector_told(to)}, {"radius", radius}};
}

/// A hull as its file has it, in body axes. \throws hydro::InputError if the file is not there, or too large to draw
Json mesh_told(const std::filesystem::path& file, const std::optional<double>& unit, bool reverse,
               const std::optional<double>& freeboard) {
  auto mesh = hydro::hydrostatics::read_mesh(file, {.unit = unit, .reverse = reverse});
  if (freeboard) mesh = with_freeboard(std::move(mesh), *freeboard);
  if (mesh.triangles.size() > most_triangles)
    throw hydro::InputError(
        fmt::format("it has {} triangles, of which a report draws {} at most", mesh.triangles.size(), most_triangles));
  std::vector<double> vertices;
  Json triangles = Json::array();
  for (const Vector3d& v : mesh.vertices) vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
  for (const auto& t : mesh.triangles)
    for (const int corner : t) triangles.push_back(corner);
  return {{"kind", "mesh"}, {"vertices", single_array(vertices)}, {"triangles", triangles}};
}

void add_buoyancy(const scene::Buoyancy& buoyancy, Json& shapes) {
  if (buoyancy.mesh)
    shapes.push_back(mesh_told(buoyancy.mesh->value, buoyancy.unit, buoyancy.reverse, buoyancy.freeboard));
  for (const auto& c : buoyancy.cylinders) shapes.push_back(cylinder_told(c.from, c.to, c.radius));
  for (const auto& s : buoyancy.spheres)
    shapes.push_back({{"kind", "sphere"}, {"centre", vector_told(s.centre)}, {"radius", s.radius}});
}

/// Vertical cylinders reach from their draught to the still water, or as high above it as they are wide.
void add_hydrodynamics(const scene::Scene& scene, const scene::Body& body, Json& shapes) {
  const scene::Hydrodynamics& h = *body.hydrodynamics;
  if (h.mesh) shapes.push_back(mesh_told(h.mesh->file, h.mesh->unit, h.mesh->reverse, {}));
  if (!h.cylinders) return;
  for (const auto& c : h.cylinders->all) {
    const double bed = !scene.water.depth.is_infinite() ? -scene.water.depth.metres() : -10 * c.radius;
    const double bottom = c.draught ? -*c.draught : bed, top = c.top ? -*c.top : c.radius / 2;
    const auto end = [&](double z) { return Vector3d(c.centre.x(), c.centre.y(), z - body.position.z()); };
    shapes.push_back(cylinder_told(end(bottom), end(top), c.radius));
  }
}

/// A box of uniform density with the body's moments of inertia, or a cube that floats half under water.
Json box_told(const scene::Scene& scene, const scene::Body& body) {
  const Vector3d k2 = body.inertia.diagonal() / body.mass;
  Vector3d size2(6 * (k2.y() + k2.z() - k2.x()), 6 * (k2.x() + k2.z() - k2.y()), 6 * (k2.x() + k2.y() - k2.z()));
  const double cube = std::cbrt(2 * body.mass / scene.water.density);
  const bool turns = body.free[3] || body.free[4] || body.free[5];
  for (double& side : size2) side = turns ? std::max(side, 0.01 * size2.maxCoeff()) : cube * cube;
  const Vector3d half = size2.cwiseSqrt() / 2;
  return {{"kind", "box"},
          {"low", vector_told(body.centre_of_gravity - half)},
          {"high", vector_told(body.centre_of_gravity + half)}};
}

}  // namespace

Json shapes_of(const scene::Scene& scene, std::size_t index) {
  const scene::Body& body = scene.bodies[index];
  Json shapes = Json::array(), out;
  std::string why;
  try {
    if (body.buoyancy) add_buoyancy(*body.buoyancy, shapes);
    if (shapes.empty() && body.hydrodynamics) add_hydrodynamics(scene, body, shapes);
  } catch (const hydro::InputError& e) {
    why = fmt::format(" (its mesh is not drawn: {})", e.rule());
  }
  for (const scene::Member& m : scene.members)
    if (m.body == static_cast<int>(index)) shapes.push_back(cylinder_told(m.from, m.to, m.diameter / 2));
  if (shapes.empty()) {
    shapes.push_back(box_told(scene, body));
    out["note"] =
        fmt::format("The scene gives {} no shape{}: it is drawn as a box with its mass and inertia.", body.name, why);
  } else if (!why.empty()) {
    out["note"] = fmt::format("Of {} only a part is drawn{}.", body.name, why);
  }
  out["shapes"] = shapes;
  return out;
}

}  // namespace froude::html
