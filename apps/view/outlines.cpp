#include "view/outlines.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace froude::view {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using hydro::hydrostatics::TriangleMesh;

/// A circle as a polygon: its sides lie within 0.2 % of the radius of it.
void add_circle(const Vector2d& centre, double radius, std::vector<Segment>& out) {
  constexpr int sides = 48;
  const auto corner = [&](int i) -> Vector2d {
    const double angle = 2 * std::numbers::pi * i / sides;
    return centre + radius * Vector2d(std::cos(angle), std::sin(angle));
  };
  for (int i = 0; i < sides; ++i) out.push_back({corner(i), corner(i + 1)});
}

double diagonal_of(const TriangleMesh& mesh) {
  Vector3d low = mesh.vertices.front(), high = low;
  for (const Vector3d& v : mesh.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  return (high - low).norm();
}

/// The two points at which a triangle of these heights meets z = 0: corners in it, and sides that go through it.
void cut(const std::array<Vector3d, 3>& corner, std::vector<Segment>& out) {
  std::vector<Vector2d> met;
  bool under = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &a = corner[i], &b = corner[(i + 1) % 3];
    if (a.z() == 0) met.emplace_back(a.head<2>());
    if (a.z() * b.z() < 0) met.emplace_back((a + a.z() / (a.z() - b.z()) * (b - a)).head<2>());
    under |= a.z() < 0;
  }
  // A side that lies in z = 0 belongs to two triangles: the one under water tells it.
  if (met.size() == 2 && under) out.push_back({met[0], met[1]});
}

/// Copies share a file, which is read once.
class Meshes {
 public:
  TriangleMesh at(const scene::HullMesh& hull, const Vector3d& place) {
    const auto key = std::tuple(hull.file, hull.unit, hull.reverse);
    if (!known_.contains(key))
      known_.emplace(key, hydro::hydrostatics::read_mesh(hull.file, {.unit = hull.unit, .reverse = hull.reverse}));
    TriangleMesh out = known_.at(key);
    for (Vector3d& v : out.vertices) v += place;
    return out;
  }

 private:
  std::map<std::tuple<std::filesystem::path, std::optional<double>, bool>, TriangleMesh> known_;
};

}  // namespace

std::vector<Segment> waterline_of(const TriangleMesh& mesh) {
  std::vector<Segment> out;
  if (mesh.vertices.empty()) return out;
  const double nothing = 1e-6 * diagonal_of(mesh);
  for (const auto& triangle : mesh.triangles) {
    std::array<Vector3d, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = mesh.vertices[static_cast<std::size_t>(triangle[i])];
      if (std::abs(corner[i].z()) < nothing) corner[i].z() = 0;
    }
    cut(corner, out);
  }
  return out;
}

std::vector<Segment> plan_of(const TriangleMesh& mesh) {
  const auto at = [&](int i) -> const Vector3d& { return mesh.vertices[static_cast<std::size_t>(i)]; };
  std::map<std::pair<int, int>, int> seen;  // of each edge: faces that look up, less those that do not
  for (const auto& t : mesh.triangles) {
    const bool up = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).z() > 0;
    for (std::size_t i = 0; i < 3; ++i) seen[std::minmax(t[i], t[(i + 1) % 3])] += up ? 1 : -1;
  }
  std::vector<Segment> out;
  for (const auto& [edge, balance] : seen)
    if (std::abs(balance) < 2) out.push_back({at(edge.first).head<2>(), at(edge.second).head<2>()});
  return out;
}

std::vector<Outline> outlines_of(const scene::Scene& scene) {
  std::vector<Outline> out;
  Meshes meshes;
  for (const scene::Body& body : scene.bodies) {
    if (!body.hydrodynamics || (!body.hydrodynamics->cylinders && !body.hydrodynamics->mesh)) continue;
    Outline one{body.name, {}, {}};
    if (const auto& cylinders = body.hydrodynamics->cylinders)
      for (const auto& c : cylinders->all)
        add_circle(body.position.head<2>() + c.centre, c.radius, c.top ? one.submerged : one.pierced);
    if (const auto& hull = body.hydrodynamics->mesh) {
      const TriangleMesh mesh = meshes.at(*hull, body.position);
      one.pierced = waterline_of(mesh);
      if (one.pierced.empty()) one.submerged = plan_of(mesh);
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace froude::view
