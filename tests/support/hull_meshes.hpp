#pragma once
/// \file  Simple hulls as closed meshes, whose flat triangles displace less than the shapes they stand for. (H3)
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <numbers>

#include "hydro/hydrostatics/mesh.hpp"

namespace support {

using Eigen::Vector3d;
using hydro::hydrostatics::TriangleMesh;

/// A box between two opposite corners, 12 triangles, exact.
inline TriangleMesh box_mesh(const Vector3d& low, const Vector3d& high) {
  TriangleMesh mesh{.source = "box", .vertices = {}, .triangles = {}};
  for (int i = 0; i < 8; ++i)  // bits of i: x, y, z
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

/// A cylinder about a vertical axis from z = bottom to z = top, `segments` (>= 3) flat walls whose edges are on the
/// true surface. Its volume and areas of section are short by the factor sin(α)/α, α = 2π/segments (H3).
inline TriangleMesh cylinder_mesh(const Eigen::Vector2d& centre, double radius, double bottom, double top,
                                  int segments) {
  TriangleMesh mesh{.source = "cylinder", .vertices = {}, .triangles = {}};
  for (const double z : {bottom, top})
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      mesh.vertices.emplace_back(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle), z);
    }
  const int n = segments, low = 2 * n, high = 2 * n + 1;
  mesh.vertices.emplace_back(centre.x(), centre.y(), bottom);
  mesh.vertices.emplace_back(centre.x(), centre.y(), top);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
    mesh.triangles.push_back({low, j, i});
    mesh.triangles.push_back({high, n + i, n + j});
  }
  return mesh;
}

/// A sphere with vertices on the true surface: an octahedron whose edges are cut `cuts` (>= 0) times in halves;
/// 8·4^cuts triangles. Volume is short by O(4^−cuts) (H3).
inline TriangleMesh sphere_mesh(const Vector3d& centre, double radius, int cuts) {
  TriangleMesh mesh{.source = "sphere", .vertices = {}, .triangles = {}};
  const int n = 1 << cuts;
  // Each face of the octahedron |x| + |y| + |z| = 1 as a triangular grid, thrown onto the sphere.
  for (const double sx : {1.0, -1.0})
    for (const double sy : {1.0, -1.0})
      for (const double sz : {1.0, -1.0}) {
        const auto at = [&](int i, int j) {
          return Vector3d(centre + radius * Vector3d(sx * i, sy * j, sz * (n - i - j)).normalized());
        };
        const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
          const int first = static_cast<int>(mesh.vertices.size());
          mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
          if (sx * sy * sz > 0)
            mesh.triangles.push_back({first, first + 1, first + 2});
          else
            mesh.triangles.push_back({first, first + 2, first + 1});
        };
        for (int i = 0; i < n; ++i)
          for (int j = 0; i + j < n; ++j) {
            add(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
          }
      }
  return welded(std::move(mesh), 1e-3 * radius / n);
}

/// Several meshes as one hull; no attempt is made to merge what overlaps.
inline TriangleMesh joined(std::vector<TriangleMesh> meshes) {
  TriangleMesh all{.source = {}, .vertices = {}, .triangles = {}};
  for (TriangleMesh& mesh : meshes) {
    const int first = static_cast<int>(all.vertices.size());
    all.source += (all.source.empty() ? "" : " + ") + mesh.source;
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    all.notes.insert(all.notes.end(), mesh.notes.begin(), mesh.notes.end());
    for (const auto& t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

}  // namespace support
