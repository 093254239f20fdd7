#include "hydro/hydrostatics/mesh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "self_overlap.hpp"

namespace hydro::hydrostatics {
namespace {

using Eigen::Vector3d;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::string text(const Vector3d& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p.x(), p.y(), p.z()); }

/// Cells of a grid as wide as the welding distance: what is nearer than that lies in a cell or its neighbours.
class Cells {
 public:
  explicit Cells(double width) : width_(width) {}

  /// The first vertex put in that is nearer to p than the width, or -1.
  int find(const Vector3d& p, const std::vector<Vector3d>& vertices) const {
    int best = -1;
    const auto [i, j, k] = cell(p);
    for (std::int64_t di = -1; di <= 1; ++di)
      for (std::int64_t dj = -1; dj <= 1; ++dj)
        for (std::int64_t dk = -1; dk <= 1; ++dk) {
          const auto found = held_.find(key({i + di, j + dj, k + dk}));
          if (found == held_.end()) continue;
          for (const int v : found->second)
            if ((vertices[at(v)] - p).norm() <= width_ && (best < 0 || v < best)) best = v;
        }
    return best;
  }
  void put(int vertex, const Vector3d& p) { held_[key(cell(p))].push_back(vertex); }

 private:
  using Index = std::array<std::int64_t, 3>;
  Index cell(const Vector3d& p) const {
    return {std::llround(p.x() / width_), std::llround(p.y() / width_), std::llround(p.z() / width_)};
  }
  // Two cells of one key only cost time: distances are compared.
  static std::uint64_t key(const Index& c) {
    std::uint64_t h = 0;
    for (const std::int64_t i : c) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ULL;
    return h;
  }
  double width_;
  std::unordered_map<std::uint64_t, std::vector<int>> held_;
};

/// How often an edge runs from its lower-numbered vertex to the other, and back.
struct EdgeUse {
  int forward = 0, back = 0;
  int triangle = 0;  // one of those at the edge
};

std::map<std::array<int, 2>, EdgeUse> edges_of(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::array<int, 2>, EdgeUse> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const int a = triangles[t][c], b = triangles[t][(c + 1) % 3];
      EdgeUse& use = edges[{std::min(a, b), std::max(a, b)}];
      ++(a < b ? use.forward : use.back);
      use.triangle = static_cast<int>(t);
    }
  return edges;
}

/// Six times the volume of the cone from p over the triangle.
double cone(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return (a - p).dot((b - p).cross(c - p));
}

/// (H1): water that is enclosed twice would be displaced twice. What is shallower than ten times the usual distance of
/// welding is a matter of rounding: shells may touch.
void require_no_overlap(const TriangleMesh& mesh, const std::vector<std::array<int, 2>>& open_edges, double diagonal) {
  constexpr double rounding = 1e-5;
  const std::optional<SelfOverlap> found = self_overlap(mesh, open_edges, rounding * diagonal);
  if (!found) return;
  throw InputError(
      found->other >= 0 ? fmt::format("{}: the mesh pierces itself at {}, where triangles {} and {} cross", mesh.source,
                                      text(found->at), found->triangle + 1, found->other + 1)
                        : fmt::format("{}: the mesh encloses the place {} twice: triangle {} lies inside the hull",
                                      mesh.source, text(found->at), found->triangle + 1),
      {}, "unite the overlapping shells (a union of solids) in the program that made the mesh; they may touch");
}

}  // namespace

TriangleMesh welded(TriangleMesh mesh, double distance) {
  require(distance > 0 && std::isfinite(distance), "vertices are made one within a positive distance, got {} m",
          distance);
  Cells cells(distance);
  std::vector<Vector3d> kept;
  std::vector<int> now(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3d& p = mesh.vertices[v];
    require(p.allFinite(), "{}: vertex {} is not finite", mesh.source, v + 1);
    now[v] = cells.find(p, kept);
    if (now[v] >= 0) continue;
    now[v] = static_cast<int>(kept.size());
    kept.push_back(p);
    cells.put(now[v], p);
  }
  const std::size_t before = mesh.triangles.size();
  for (auto& t : mesh.triangles)
    for (int& v : t) v = now[at(v)];
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  mesh.vertices = std::move(kept);
  if (before > mesh.triangles.size())
    mesh.notes.push_back(
        fmt::format("{} of {} triangles have two corners within {:.3g} m of each other and are left out",
                    before - mesh.triangles.size(), before, distance));
  return mesh;
}

Hull::Hull(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  require(mesh_.triangles.size() >= 4, "{}: {} triangles enclose nothing; a hull has four at least", mesh_.source,
          mesh_.triangles.size());
  for (const auto& t : mesh_.triangles)
    for (const int v : t)
      require(v >= 0 && v < static_cast<int>(mesh_.vertices.size()), "{}: a triangle has the vertex {} of {}",
              mesh_.source, v + 1, mesh_.vertices.size());
  measure();
  check_edges();
  check_doubled();
  check_parts();
  require_no_overlap(mesh_, open_edges_, diagonal_);
}

void Hull::measure() {
  Vector3d low = mesh_.vertices.front(), high = low;
  for (const Vector3d& p : mesh_.vertices) {
    require(p.allFinite(), "{}: a vertex is not finite", mesh_.source);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  middle_ = (low + high) / 2;
  diagonal_ = (high - low).norm();
  if (!(diagonal_ >= 1e-3 && diagonal_ <= 5000))
    throw InputError(
        fmt::format("{}: the hull is {:.4g} m from corner to corner of its box; a hull is between 1 mm and "
                    "5 km",
                    mesh_.source, diagonal_),
        {}, "say what the numbers of the file are in: unit mm, cm, in or ft");
  for (const auto& t : mesh_.triangles) {
    const Vector3d &a = mesh_.vertices[at(t[0])], &b = mesh_.vertices[at(t[1])], &c = mesh_.vertices[at(t[2])];
    const double area = (b - a).cross(c - a).norm() / 2;
    area_ += area;
    // Thinner than round-off of the coordinates: no direction of its own.
    if (area <= 1e-14 * diagonal_ * diagonal_) ++slivers_;
  }
}

/// A face twice would displace its water twice, and all edges would still agree.
void Hull::check_doubled() const {
  std::map<std::array<int, 3>, std::size_t> first;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    std::array<int, 3> corners = mesh_.triangles[t];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const auto [there, is_new] = first.emplace(corners, t);
    if (!is_new)
      throw InputError(fmt::format("{}: triangles {} and {} have the same corners, from {} on: a face is there twice",
                                   mesh_.source, there->second + 1, t + 1, text(mesh_.vertices[at(corners[0])])),
                       {}, "remove doubled faces in the program that made the mesh");
  }
}

/// (H1): along every edge as many triangles run one way as the other; a single triangle there is an opening.
void Hull::check_edges() {
  std::vector<bool> at_rim(mesh_.vertices.size(), false);
  for (const auto& [edge, use] : edges_of(mesh_.triangles)) {
    if (use.forward == use.back) continue;
    const Vector3d &a = mesh_.vertices[at(edge[0])], &b = mesh_.vertices[at(edge[1])];
    if (use.forward + use.back > 1)
      throw InputError(
          fmt::format(
              "{}: {} triangles meet at the edge from {} to {} and do not agree on what is outside (triangle {} "
              "is one)",
              mesh_.source, use.forward + use.back, text(a), text(b), use.triangle + 1),
          {}, "orient the faces alike, and remove doubled or inner faces, in the program that made the mesh");
    open_edges_.push_back(use.forward == 1 ? edge : std::array<int, 2>{edge[1], edge[0]});
    at_rim[at(edge[0])] = at_rim[at(edge[1])] = true;
  }
  for (std::size_t v = 0; v < at_rim.size(); ++v)
    if (at_rim[v]) rim_.push_back(static_cast<int>(v));
}

/// Volumes of the connected parts, each positive.
void Hull::check_parts() {
  std::vector<int> parent(mesh_.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  for (const auto& t : mesh_.triangles)
    for (const int v : {t[1], t[2]}) parent[at(root(v))] = root(t[0]);
  struct Part {
    double six_volumes = 0;
    Vector3d apex = Vector3d::Zero();  // mean of the rim: openings are closed by the cone to it
    int rim = 0;
    Vector3d somewhere = Vector3d::Zero();
  };
  std::map<int, Part> parts;
  for (const int v : rim_) {
    Part& p = parts[root(v)];
    p.apex += mesh_.vertices[at(v)];
    ++p.rim;
  }
  for (auto& [r, p] : parts) p.apex /= p.rim;
  for (const auto& t : mesh_.triangles) {
    Part& p = parts[root(t[0])];
    if (p.rim == 0) p.apex = middle_;
    p.somewhere = mesh_.vertices[at(t[0])];
    // From the apex itself the closing cone has no volume.
    p.six_volumes += cone(p.apex, mesh_.vertices[at(t[0])], mesh_.vertices[at(t[1])], mesh_.vertices[at(t[2])]);
  }
  parts_ = static_cast<int>(parts.size());
  for (const auto& [r, p] : parts) {
    if (!(p.six_volumes > 0))
      throw InputError(
          fmt::format(
              "{}: {} inside out or encloses nothing: its volume is {:.6g} m³", mesh_.source,
              parts_ == 1 ? "the hull is" : fmt::format("the part at {} (of {} parts) is", text(p.somewhere), parts_),
              p.six_volumes / 6),
          {}, "reverse the faces: their corners run anticlockwise seen from the water");
    volume_ += p.six_volumes / 6;
  }
}

TriangleMesh with_freeboard(TriangleMesh mesh, double height) {
  require(height > 0 && std::isfinite(height), "the freeboard must be positive, got {} m", height);
  std::map<int, int> next;  // along the rims, as the new walls run: against the triangles there
  for (const auto& [edge, use] : edges_of(mesh.triangles)) {
    if (use.forward + use.back != 1) continue;
    const auto [from, to] = use.forward == 1 ? std::array<int, 2>{edge[1], edge[0]} : edge;
    require(next.emplace(from, to).second, "{}: two openings share the point {}; no deck can be drawn", mesh.source,
            text(mesh.vertices[at(from)]));
  }
  require(!next.empty(), "{} is closed: there is no opening above which a freeboard could be drawn", mesh.source);
  double low = mesh.vertices[at(next.begin()->first)].z(), high = low, size = 0;
  for (const auto& [v, to] : next) {
    const Vector3d& p = mesh.vertices[at(v)];
    low = std::min(low, p.z());
    high = std::max(high, p.z());
    size = std::max(size, (p - mesh.vertices[at(next.begin()->first)]).norm());
  }
  require(high - low <= 1e-6 * size,
          "{}: the openings reach from z = {:.6g} m to {:.6g} m; a freeboard needs one level", mesh.source, low, high);
  while (!next.empty()) {
    std::vector<int> loop{next.begin()->first};
    for (auto step = next.begin(); step != next.end(); step = next.find(loop.back())) {
      loop.push_back(step->second);
      next.erase(step);
    }
    require(loop.front() == loop.back(), "{}: the edge of an opening does not close at {}", mesh.source,
            text(mesh.vertices[at(loop.back())]));
    loop.pop_back();
    const int n = static_cast<int>(loop.size()), first = static_cast<int>(mesh.vertices.size()), centre = first + n;
    Vector3d mean = Vector3d::Zero();
    for (const int v : loop) {
      const Vector3d up = mesh.vertices[at(v)] + Vector3d(0, 0, height);
      mesh.vertices.push_back(up);
      mean += up / n;
    }
    mesh.vertices.push_back(mean);
    for (int i = 0; i < n; ++i) {
      const int j = (i + 1) % n, a = loop[at(i)], b = loop[at(j)];
      mesh.triangles.push_back({a, b, first + j});
      mesh.triangles.push_back({a, first + j, first + i});
      mesh.triangles.push_back({first + i, first + j, centre});
    }
  }
  mesh.notes.push_back(fmt::format("walls and a flat deck are drawn {:.6g} m above the edge of the openings", height));
  return mesh;
}

double chord_volume(const Hull& hull) {
  const auto& x = hull.vertices();
  const auto& triangles = hull.triangles();
  const double smooth = std::cos(std::numbers::pi / 6);
  struct Corner {
    std::size_t triangle;
    double angle;
  };
  std::vector<std::vector<Corner>> around(x.size());
  std::vector<Vector3d> twice(triangles.size());  // area · normal, twice
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3d u = x[at(triangles[t][(c + 1) % 3])] - x[at(triangles[t][c])];
      const Vector3d v = x[at(triangles[t][(c + 2) % 3])] - x[at(triangles[t][c])];
      twice[t] = u.cross(v);
      around[at(triangles[t][c])].push_back({t, std::atan2(twice[t].norm(), u.dot(v))});
    }
  double volume = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<Vector3d, 3> n;  // of the smooth surface at the corners: from the neighbours this side of a knuckle
    for (std::size_t c = 0; c < 3; ++c) {
      n[c] = Vector3d::Zero();
      for (const Corner& other : around[at(triangles[t][c])]) {
        const Vector3d m = twice[other.triangle].stableNormalized();
        if (m.dot(twice[t].stableNormalized()) > smooth) n[c] += other.angle * m;
      }
      n[c].stableNormalize();
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3;
      volume += twice[t].norm() / 48 * (n[d] - n[c]).dot(x[at(triangles[t][d])] - x[at(triangles[t][c])]);  // (H2)
    }
  }
  return volume;
}

}  // namespace hydro::hydrostatics
