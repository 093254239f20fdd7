// What a body looks like, by what its scene says of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/mesh.hpp"
#include "view/parts.hpp"

namespace froude::view {
namespace {

using Eigen::Vector3d;

/// A hull as its file has it. \throws hydro::InputError if the file is not there, or too large to draw
hydro::hydrostatics::TriangleMesh hull(const std::filesystem::path& file, const std::optional<double>& unit,
                                       bool reverse, const std::optional<double>& freeboard, std::size_t most) {
  auto mesh = hydro::hydrostatics::read_mesh(file, {.unit = unit, .reverse = reverse});
  if (freeboard) mesh = with_freeboard(std::move(mesh), *freeboard);
  if (mesh.triangles.size() > most)
    throw hydro::InputError(
        fmt::format("it has {} triangles, of which a report draws {} at most", mesh.triangles.size(), most));
  return mesh;
}

void add_buoyancy(const scene::Buoyancy& buoyancy, std::size_t most, std::vector<Shape>& shapes) {
  if (buoyancy.mesh)
    shapes.push_back(hull(buoyancy.mesh->value, buoyancy.unit, buoyancy.reverse, buoyancy.freeboard, most));
  for (const auto& c : buoyancy.cylinders) shapes.push_back(Cylinder{c.from, c.to, c.radius});
  for (const auto& s : buoyancy.spheres) shapes.push_back(Sphere{s.centre, s.radius});
}

/// Vertical cylinders reach from their draught to the still water, or as high above it as they are wide.
void add_hydrodynamics(const scene::Scene& scene, const scene::Body& body, std::size_t most,
                       std::vector<Shape>& shapes) {
  const scene::Hydrodynamics& h = *body.hydrodynamics;
  if (h.mesh) shapes.push_back(hull(h.mesh->file, h.mesh->unit, h.mesh->reverse, {}, most));
  if (!h.cylinders) return;
  for (const auto& c : h.cylinders->all) {
    const double bed = !scene.water.depth.is_infinite() ? -scene.water.depth.metres() : -10 * c.radius;
    const double bottom = c.draught ? -*c.draught : bed, top = c.top ? -*c.top : c.radius / 2;
    const auto end = [&](double z) { return Vector3d(c.centre.x(), c.centre.y(), z - body.position.z()); };
    shapes.push_back(Cylinder{end(bottom), end(top), c.radius});
  }
}

/// A box of uniform density with the body's moments of inertia, or a cube that floats half under water.
Box box_of(const scene::Scene& scene, const scene::Body& body) {
  const Vector3d k2 = body.inertia.diagonal() / body.mass;
  Vector3d size2(6 * (k2.y() + k2.z() - k2.x()), 6 * (k2.x() + k2.z() - k2.y()), 6 * (k2.x() + k2.y() - k2.z()));
  const double cube = std::cbrt(2 * body.mass / scene.water.density);
  const bool turns = body.free[3] || body.free[4] || body.free[5];
  for (double& side : size2) side = turns ? std::max(side, 0.01 * size2.maxCoeff()) : cube * cube;
  const Vector3d half = size2.cwiseSqrt() / 2;
  return {body.centre_of_gravity - half, body.centre_of_gravity + half};
}

}  // namespace

Shapes shapes_of(const scene::Scene& scene, std::size_t index, std::size_t most_triangles) {
  const scene::Body& body = scene.bodies[index];
  Shapes out;
  std::string why;
  try {
    if (body.buoyancy) add_buoyancy(*body.buoyancy, most_triangles, out.all);
    if (out.all.empty() && body.hydrodynamics) add_hydrodynamics(scene, body, most_triangles, out.all);
  } catch (const hydro::InputError& e) {
    why = fmt::format(" (its mesh is not drawn: {})", e.rule());
  }
  for (const scene::Member& m : scene.members)
    if (m.body == static_cast<int>(index)) out.all.push_back(Cylinder{m.from, m.to, m.diameter / 2});
  if (out.all.empty()) {
    out.all.push_back(box_of(scene, body));
    out.note =
        fmt::format("The scene gives {} no shape{}: it is drawn as a box with its mass and inertia.", body.name, why);
  } else if (!why.empty()) {
    out.note = fmt::format("Of {} only a part is drawn{}.", body.name, why);
  }
  return out;
}

}  // namespace froude::view
