#include "hydro/hydrostatics/shape_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hydro::hydrostatics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double same_place = 1e-9;  // of the size: points that are one but for rounding

/// Points of a length from 0 to 1.
std::vector<double> divided(int parts, Spacing spacing) {
  std::vector<double> out;
  for (int i = 0; i <= parts; ++i) {
    const double t = static_cast<double>(i) / parts;
    out.push_back(spacing == Spacing::equal ? t : (1 - std::cos(pi * t)) / 2);
  }
  return out;
}

void require_counts(double radius, int rows, int columns) {
  require(std::isfinite(radius) && radius > 0, "a radius must be positive, got {} m", radius);
  require(rows >= 1, "a mesh needs a row of panels at least, got {}", rows);
  require(columns >= 3, "a mesh needs three panels around at least, got {}", columns);
}

/// A flat face from `corner` along u and v, divided; its normal is u × v.
void add_face(const Vector3d& corner, const Vector3d& u, const Vector3d& v, const std::vector<double>& along_u,
              const std::vector<double>& along_v, TriangleMesh& out) {
  for (std::size_t i = 0; i + 1 < along_u.size(); ++i)
    for (std::size_t j = 0; j + 1 < along_v.size(); ++j) {
      const int first = static_cast<int>(out.vertices.size());
      for (const auto& [a, b] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
        out.vertices.emplace_back(corner + along_u[a] * u + along_v[b] * v);
      out.triangles.push_back({first, first + 1, first + 2});
      out.triangles.push_back({first, first + 2, first + 3});
    }
}

}  // namespace

double polygon_radius(int corners) {
  const double angle = 2 * pi / corners;
  return std::sqrt(angle / std::sin(angle));
}

TriangleMesh revolved(const std::vector<Vector2d>& profile, int columns, const Vector2d& centre) {
  require(profile.size() >= 2, "a profile needs two points at least, got {}", profile.size());
  TriangleMesh mesh{.source = "body of revolution", .vertices = {}, .triangles = {}};
  double size = 0;
  for (const Vector2d& p : profile) {
    require(p.allFinite() && p.x() >= 0, "a profile needs finite points of no negative radius, got ({}, {}) m", p.x(),
            p.y());
    size = std::max(size, p.cwiseAbs().maxCoeff());
    require_counts(std::max(p.x(), size), 1, columns);
    for (int j = 0; j < columns; ++j) {
      const double angle = 2 * pi * j / columns;
      mesh.vertices.emplace_back(centre.x() + p.x() * std::cos(angle), centre.y() + p.x() * std::sin(angle), p.y());
    }
  }
  for (int i = 0; i + 1 < static_cast<int>(profile.size()); ++i)
    for (int j = 0; j < columns; ++j) {
      const int a = i * columns + j, b = i * columns + (j + 1) % columns, c = a + columns, d = b + columns;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  return welded(std::move(mesh), same_place * size);
}

TriangleMesh hemisphere_mesh(double radius, int rows, int columns) {
  require_counts(radius, rows, columns);
  const auto of = [&](double a) {
    std::vector<Vector2d> profile;
    for (int i = 0; i <= rows; ++i) {
      const double polar = pi / 2 * (1 + static_cast<double>(i) / rows);
      profile.emplace_back(i == rows ? 0 : a * std::sin(polar), i == 0 ? 0 : a * std::cos(polar));
    }
    return revolved(profile, columns);
  };
  const double exact = 2 * pi / 3 * std::pow(radius, 3);
  return of(radius * std::cbrt(exact / Hull(of(radius)).volume()));
}

TriangleMesh cylinder_mesh(double radius, double draught, int side, int bottom, int columns, const Vector2d& centre) {
  require_counts(radius, std::min(side, bottom), columns);
  require(std::isfinite(draught) && draught > 0, "a draught must be positive, got {} m", draught);
  const double a = radius * polygon_radius(columns);
  std::vector<Vector2d> profile;
  for (const double t : divided(side, Spacing::cosine)) profile.emplace_back(a, -draught * t);
  for (int i = 1; i <= bottom; ++i) profile.emplace_back(i == bottom ? 0 : a * std::cos(pi / 2 * i / bottom), -draught);
  return revolved(profile, columns, centre);
}

TriangleMesh box_mesh(const Vector3d& low, const Vector3d& high, const std::array<int, 3>& panels, Spacing spacing) {
  const Vector3d size = high - low;
  require(size.allFinite() && size.minCoeff() > 0, "a box must have a positive length, breadth and height");
  std::array<std::vector<double>, 3> along;
  for (std::size_t i = 0; i < 3; ++i) {
    require(panels[i] >= 1, "a box needs a panel at least in each direction, got {}", panels[i]);
    along[i] = divided(panels[i], spacing);
  }
  TriangleMesh mesh{.source = "box", .vertices = {}, .triangles = {}};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;  // e_u × e_v = e_axis
    const Vector3d along_u = size(u) * Vector3d::Unit(u), along_v = size(v) * Vector3d::Unit(v);
    const auto &parts_u = along[static_cast<std::size_t>(u)], &parts_v = along[static_cast<std::size_t>(v)];
    add_face(low, along_v, along_u, parts_v, parts_u, mesh);
    const bool lid = axis < 2 || high.z() != 0;
    if (lid) add_face(low + size(axis) * Vector3d::Unit(axis), along_u, along_v, parts_u, parts_v, mesh);
  }
  return welded(std::move(mesh), same_place * size.norm());
}

}  // namespace hydro::hydrostatics
