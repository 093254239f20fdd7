#include "self_overlap.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace hydro::hydrostatics {
namespace {

using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;
using Facet = std::array<Vector3d, 3>;

/// A tree of boxes about triangles, each cut at the median along its longest side.
class FacetTree {
 public:
  explicit FacetTree(const std::vector<Facet>& facets) : facets_(facets), order_(facets.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    build(0, order_.size());
  }

  /// Calls `use(index)` for the triangles in boxes that `touches(box)` accepts, until it returns true.
  template <class Touches, class Use>
  bool any(Touches touches, Use use) const {
    std::vector<std::size_t> open{0};
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      if (!touches(node.box)) continue;
      if (node.right > 0) {
        open.push_back(node.right);
        open.push_back(static_cast<std::size_t>(&node - nodes_.data()) + 1);
        continue;
      }
      for (std::size_t i = node.first; i < node.last; ++i)
        if (use(order_[i])) return true;
    }
    return false;
  }

 private:
  struct Node {
    Box box;
    std::size_t first, last;
    std::size_t right;  // the left one follows; 0: a leaf
  };

  std::size_t build(std::size_t first, std::size_t last) {
    constexpr std::size_t in_leaf = 4;
    const std::size_t self = nodes_.size();
    Box box;
    for (std::size_t i = first; i < last; ++i)
      for (const Vector3d& p : facets_[order_[i]]) box.extend(p);
    nodes_.push_back({box, first, last, 0});
    if (last - first <= in_leaf) return self;
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const auto place = [&](std::size_t f) { return facets_[f][0][axis] + facets_[f][1][axis] + facets_[f][2][axis]; };
    const auto begin = order_.begin();
    const std::size_t middle = (first + last) / 2;
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last),
                     [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    build(first, middle);
    const std::size_t right = build(middle, last);
    nodes_[self].right = right;
    return self;
  }

  const std::vector<Facet>& facets_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

Vector3d normal_of(const Facet& f) { return (f[1] - f[0]).cross(f[2] - f[0]).stableNormalized(); }
Vector3d centre_of(const Facet& f) { return (f[0] + f[1] + f[2]) / 3; }

/// Where the line from p to q goes through the triangle, deeper than `depth` on either side and within its edges.
std::optional<Vector3d> crossing_of(const Vector3d& p, const Vector3d& q, const Facet& f, double depth) {
  const Vector3d n = normal_of(f);
  const double above = n.dot(p - f[0]), below = n.dot(q - f[0]);
  if (std::min(std::abs(above), std::abs(below)) <= depth || (above > 0) == (below > 0)) return {};
  const Vector3d at = p + (q - p) * (above / (above - below));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d inward = n.cross(f[(i + 1) % 3] - f[i]).stableNormalized();
    if (inward.dot(at - f[i]) <= depth) return {};
  }
  return at;
}

std::optional<SelfOverlap> faces_that_cross(const std::vector<Facet>& facets, std::size_t faces, const FacetTree& tree,
                                            double depth) {
  std::optional<SelfOverlap> out;
  for (std::size_t t = 0; t < faces && !out; ++t)
    for (std::size_t i = 0; i < 3 && !out; ++i) {
      const Vector3d &p = facets[t][i], &q = facets[t][(i + 1) % 3];
      const Box around = Box(p).extend(q);
      tree.any([&](const Box& box) { return box.intersects(around); },
               [&](std::size_t other) {
                 if (other >= faces) return false;  // a lid over an opening is no face
                 if (const auto at = crossing_of(p, q, facets[other], depth))
                   out = SelfOverlap{*at, static_cast<int>(other), static_cast<int>(t)};
                 return out.has_value();
               });
    }
  return out;
}

bool is_hit(const Box& box, const Vector3d& from, const Vector3d& inverse) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double a = (box.min()[i] - from[i]) * inverse[i], b = (box.max()[i] - from[i]) * inverse[i];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

/// How often the surface encloses a point: the triangles by which a ray leaves it, less those by which it enters. Empty
/// if the ray runs into an edge, where rounding might count it with both neighbours or none.
std::optional<int> enclosures(const std::vector<Facet>& facets, const FacetTree& tree, const Vector3d& from,
                              const Vector3d& ray) {
  constexpr double rounding = 1e-9;  // of the triangle
  const Vector3d inverse = ray.cwiseInverse();
  int count = 0;
  const bool at_edge = tree.any([&](const Box& box) { return is_hit(box, from, inverse); },
                                [&](std::size_t i) {
                                  const Vector3d u = facets[i][1] - facets[i][0], v = facets[i][2] - facets[i][0];
                                  const Vector3d n = u.cross(v), w = from - facets[i][0], m = w.cross(ray);
                                  const double through = n.dot(ray);
                                  if (through == 0 || -n.dot(w) / through <= 0) return false;
                                  const double a = -v.dot(m) / through, b = u.dot(m) / through;
                                  const double least = std::min({a, b, 1 - a - b});
                                  if (least > rounding) count += through > 0 ? 1 : -1;
                                  return std::abs(least) <= rounding;
                                });
  return at_edge ? std::nullopt : std::optional(count);
}

/// Rays in no direction that meshes are drawn along.
int enclosures(const std::vector<Facet>& facets, const FacetTree& tree, const Vector3d& from) {
  for (const Vector3d& ray : {Vector3d(0.2711, 0.1637, -0.9485), Vector3d(-0.3313, 0.6871, 0.6467),
                              Vector3d(0.5531, -0.2917, 0.7803), Vector3d(-0.1279, -0.8237, -0.5524)})
    if (const auto count = enclosures(facets, tree, from, ray)) return *count;
  return 1;  // not seen; its neighbours tell
}

std::optional<SelfOverlap> face_inside(const std::vector<Facet>& facets, std::size_t faces, const FacetTree& tree,
                                       double depth) {
  for (std::size_t t = 0; t < faces; ++t) {
    const Vector3d at = centre_of(facets[t]) - depth * normal_of(facets[t]);
    if (enclosures(facets, tree, at) > 1) return SelfOverlap{centre_of(facets[t]), static_cast<int>(t), -1};
  }
  return {};
}

/// A triangle from each open edge to the mean of all edges that hang together with it.
void add_lids(const TriangleMesh& mesh, const std::vector<std::array<int, 2>>& open_edges, std::vector<Facet>& out) {
  const auto vertex = [&](int v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
  std::map<int, int> parent;
  for (const auto& edge : open_edges)
    for (const int v : edge) parent[v] = v;
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b] : open_edges) parent[root(a)] = root(b);
  std::map<int, std::pair<Vector3d, int>> sum;
  for (const auto& [a, b] : open_edges) {
    auto& [total, count] = sum.try_emplace(root(a), Vector3d::Zero(), 0).first->second;
    total += (vertex(a) + vertex(b)) / 2;
    ++count;
  }
  for (const auto& [a, b] : open_edges) {
    const auto& [total, count] = sum.at(root(a));
    out.push_back({vertex(b), vertex(a), total / count});
  }
}

}  // namespace

std::optional<SelfOverlap> self_overlap(const TriangleMesh& mesh, const std::vector<std::array<int, 2>>& open_edges,
                                        double depth) {
  std::vector<Facet> facets;
  for (const auto& t : mesh.triangles)
    facets.push_back({mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
                      mesh.vertices[static_cast<std::size_t>(t[2])]});
  const std::size_t faces = facets.size();
  add_lids(mesh, open_edges, facets);
  const FacetTree tree(facets);
  const auto crossed = faces_that_cross(facets, faces, tree, depth);
  return crossed ? crossed : face_inside(facets, faces, tree, depth);
}

}  // namespace hydro::hydrostatics
