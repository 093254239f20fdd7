#include "panel_mesh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/immersion.hpp"

namespace hydro::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Corners = std::vector<Vector3d>;
using Triangle = std::array<Vector3d, 3>;
using Segment = std::array<Vector2d, 2>;

double twice_area(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return (b - a).cross(c - a).norm(); }

// ---- quadrilaterals

using Key = std::tuple<double, double, double>;
Key key(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// Two triangles of one body that share the longest side of both lie in one plane and make a convex figure: its
/// corners; else empty.
Corners joined(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (key(a[i]) != key(b[(j + 1) % 3]) || key(a[(i + 1) % 3]) != key(b[j])) continue;
      const std::vector<Vector3d> four{a[i], b[(j + 2) % 3], a[(i + 1) % 3], a[(i + 2) % 3]};
      const Vector3d n = (a[1] - a[0]).cross(a[2] - a[0]).normalized();
      const Vector3d m = (b[1] - b[0]).cross(b[2] - b[0]).normalized();
      if (n.cross(m).norm() > 1e-3 || n.dot(m) < 0) return {};  // a milliradian: what 32-bit numbers make of a plane
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector3d before = (four[k] - four[(k + 3) % 4]).normalized(),
                       after = (four[(k + 1) % 4] - four[k]).normalized();
        if (before.cross(after).dot(n) < 0.1) return {};  // nearly straight, or concave
      }
      return four;
    }
  return {};
}

/// A side that two triangles share. The order is from the longest side on, and of equal ones the same on either side of
/// a plane of symmetry.
struct SharedSide {
  std::array<double, 4> rank;  ///< rounded to what is one place: −length, |x|, |y|, z of its middle
  int a, b;                    ///< its triangles
  bool operator<(const SharedSide& o) const { return std::tie(rank, a, b) < std::tie(o.rank, o.a, o.b); }
};

std::vector<SharedSide> shared_sides(const std::vector<Triangle>& all, double near) {
  std::map<std::pair<Key, Key>, int> by_side;
  const int count = static_cast<int>(all.size());
  for (int t = 0; t < count; ++t) {
    const Triangle& c = all[static_cast<std::size_t>(t)];
    for (std::size_t i = 0; i < 3; ++i) by_side[{key(c[i]), key(c[(i + 1) % 3])}] = t;
  }
  std::vector<SharedSide> out;
  for (const auto& [ends, t] : by_side) {
    const auto other = by_side.find({ends.second, ends.first});
    if (other == by_side.end() || t >= other->second) continue;
    const auto [ax, ay, az] = ends.first;
    const auto [bx, by, bz] = ends.second;
    const bool in_plane = (std::abs(ax) < near && std::abs(bx) < near) || (std::abs(ay) < near && std::abs(by) < near);
    if (in_plane) continue;  // no panel across a plane that the mesh may be symmetric in
    const auto rounded = [&](double x) { return std::round(x / near); };
    const double length = std::hypot(ax - bx, ay - by, az - bz);
    out.push_back({{rounded(-length), rounded(std::abs(ax + bx) / 2), rounded(std::abs(ay + by) / 2), rounded(az + bz)},
                   t,
                   other->second});
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// The triangles, two and two joined where they can be, from the longest side that two share.
std::vector<Corners> joined(const std::vector<Triangle>& all, double near) {
  std::vector<bool> used(all.size(), false);
  std::vector<Corners> out;
  for (const SharedSide& side : shared_sides(all, near)) {
    const auto a = static_cast<std::size_t>(side.a), b = static_cast<std::size_t>(side.b);
    if (used[a] || used[b]) continue;
    Corners four = joined(all[a], all[b]);
    if (four.empty()) continue;
    used[a] = used[b] = true;
    out.push_back(std::move(four));
  }
  for (std::size_t t = 0; t < all.size(); ++t)
    if (!used[t]) out.push_back({all[t][0], all[t][1], all[t][2]});
  return out;
}

// ---- water

/// The wet part of a figure of a body.
struct Outline {
  Corners corners;
  int body;
};

struct WetHull {
  std::vector<Outline> outlines;
  std::vector<Segment> waterline;
  double near = 0;  ///< what is nearer is one place, m
};

/// Where the side from a to b meets z = 0; the same point for either order of the two.
Vector3d at_surface(Vector3d a, Vector3d b) {
  if (a.z() > b.z()) std::swap(a, b);
  Vector3d p = a + (b - a) * (a.z() / (a.z() - b.z()));
  p.z() = 0;
  return p;
}

/// The part of a convex figure below z = 0; nothing if it lies in z = 0.
Corners below_surface(const Corners& figure) {
  Corners out;
  for (std::size_t i = 0; i < figure.size(); ++i) {
    const Vector3d &a = figure[i], &b = figure[(i + 1) % figure.size()];
    if (a.z() <= 0) out.push_back(a);
    if ((a.z() < 0 && b.z() > 0) || (a.z() > 0 && b.z() < 0)) out.push_back(at_surface(a, b));
  }
  const bool flat = std::all_of(out.begin(), out.end(), [](const Vector3d& p) { return p.z() == 0; });
  return flat ? Corners{} : out;
}

void add_wet(const Corners& figure, int body, WetHull& out) {
  const Corners part = below_surface(figure);
  double area = 0;
  for (std::size_t i = 1; i + 1 < part.size(); ++i) area += twice_area(part[0], part[i], part[i + 1]);
  if (area > out.near * out.near) out.outlines.push_back({part, body});
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vector3d &a = part[i], &b = part[(i + 1) % part.size()];
    if (a.z() == 0 && b.z() == 0) out.waterline.push_back({a.head<2>(), b.head<2>()});
  }
}

/// Vertices with those next to the surface and to the bed put there. \throws InputError as solve()
std::vector<Vector3d> vertices_of(const HullBody& body, double near, double depth) {
  std::vector<Vector3d> v = body.hull.vertices();
  for (Vector3d& p : v) {
    if (std::abs(p.z()) < near) p.z() = 0;
    if (std::abs(p.z() + depth) < near) p.z() = -depth;
    require(p.z() >= -depth, "\"{}\" reaches {:.6g} m below the water, whose depth is {:.6g} m", body.name, -p.z(),
            depth);
  }
  for (const int i : body.hull.rim()) {
    const Vector3d& p = v[static_cast<std::size_t>(i)];
    require(
        p.z() >= 0,
        "\"{}\" has an opening {:.4g} m under water, at x = {:.4g} m, y = {:.4g} m; close the mesh, or raise the hull",
        body.name, -p.z(), p.x(), p.y());
  }
  return v;
}

double nearness(const HullBody& body) { return hydrostatics::in_surface * body.hull.diagonal(); }

/// All of a hull's, with vertices_of().
std::vector<Triangle> triangles_of(const HullBody& body, double depth) {
  const std::vector<Vector3d> v = vertices_of(body, nearness(body), depth);
  std::vector<Triangle> out;
  for (const auto& t : body.hull.triangles())
    out.push_back(
        {v[static_cast<std::size_t>(t[0])], v[static_cast<std::size_t>(t[1])], v[static_cast<std::size_t>(t[2])]});
  return out;
}

bool is_on_bed(const Triangle& triangle, double depth) {
  return std::all_of(triangle.begin(), triangle.end(), [&](const Vector3d& p) { return p.z() == -depth; });
}

WetHull wet_hull(const HullBody& body, int index, double depth) {
  WetHull out;
  out.near = nearness(body);
  std::vector<Triangle> triangles = triangles_of(body, depth);
  std::erase_if(triangles, [&](const Triangle& t) { return is_on_bed(t, depth); });
  for (const Corners& figure : joined(triangles, out.near)) add_wet(figure, index, out);
  require(!out.outlines.empty(), "{}: nothing of \"{}\" is under water (z < 0)", body.hull.source(), body.name);
  return out;
}

// ---- symmetry

Vector3d mean(const Corners& corners) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : corners) sum += p;
  return sum / static_cast<double>(corners.size());
}

/// The index of the outline with these corners, in any order; −1 if there is none. `order` sorts means by z.
int find_outline(const std::vector<Outline>& all, const std::vector<int>& order, const Corners& wanted, double near) {
  const Vector3d centre = mean(wanted);
  const auto mean_of = [&](int i) { return mean(all[static_cast<std::size_t>(i)].corners); };
  auto at = std::lower_bound(order.begin(), order.end(), centre.z() - near,
                             [&](int i, double z) { return mean_of(i).z() < z; });
  for (; at != order.end() && mean_of(*at).z() <= centre.z() + near; ++at) {
    const Corners& corners = all[static_cast<std::size_t>(*at)].corners;
    if (corners.size() != wanted.size() || (mean(corners) - centre).norm() > near) continue;
    const bool same = std::all_of(wanted.begin(), wanted.end(), [&](const Vector3d& p) {
      return std::any_of(corners.begin(), corners.end(), [&](const Vector3d& q) { return (p - q).norm() < near; });
    });
    if (same) return *at;
  }
  return -1;
}

/// The outline that each is mirrored to; empty if the mesh is not its own image, or an outline crosses the plane.
std::vector<int> partners(const std::vector<Outline>& all, const Image& mirror, double near) {
  std::vector<int> order(all.size()), out;
  for (std::size_t i = 0; i < all.size(); ++i) order[i] = static_cast<int>(i);
  const auto height = [&](int i) { return mean(all[static_cast<std::size_t>(i)].corners).z(); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return height(a) < height(b); });
  for (const Outline& o : all) {
    double low = 0, high = 0;
    Corners image;
    for (const Vector3d& p : o.corners) {
      const double across = mirror.x < 0 ? p.x() : p.y();
      low = std::min(low, across);
      high = std::max(high, across);
      image.push_back(mirror * p);
    }
    const int partner = low < -near && high > near ? -1 : find_outline(all, order, image, near);
    if (partner < 0) return {};
    out.push_back(partner);
  }
  return out;
}

// ---- rules of quadrature

void add_three_points(const Vector3d& a, const Vector3d& b, const Vector3d& c, int cuts, std::vector<RulePoint>& rule) {
  if (cuts > 0) {
    const Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    for (const auto& t : {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{bc, ca, ab}})
      add_three_points(t[0], t[1], t[2], cuts - 1, rule);
    return;
  }
  const double weight = twice_area(a, b, c) / 6;
  for (const Vector3d& p :
       {Vector3d((4 * a + b + c) / 6), Vector3d((a + 4 * b + c) / 6), Vector3d((a + b + 4 * c) / 6)})
    rule.push_back({p, weight});
}

void add_squares(const std::vector<Segment>& waterline, const Vector2d& low, double side, int cuts,
                 std::vector<Polygon>& out) {
  int in = 0;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j) in += is_inside(waterline, low + side / 4 * Vector2d(i, j)) ? 1 : 0;
  if (in == 25) {
    const double x = low.x(), y = low.y();
    out.push_back(polygon({{x, y, 0}, {x + side, y, 0}, {x + side, y + side, 0}, {x, y + side, 0}}));
  } else if (in > 0 && cuts > 0) {
    for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1), Vector2d(1, 1)})
      add_squares(waterline, low + side / 2 * corner, side / 2, cuts - 1, out);
  }
}

/// Squares of a hull's lid have about twice the side of its panels: they carry next to nothing.
void add_lid(const WetHull& hull, const std::vector<Image>& images, int body, PanelMesh& out) {
  double area = 0;
  for (const Outline& o : hull.outlines)
    for (std::size_t i = 1; i + 1 < o.corners.size(); ++i)
      area += twice_area(o.corners[0], o.corners[i], o.corners[i + 1]) / 2;
  const double side = 2 * std::sqrt(area / static_cast<double>(hull.outlines.size()));
  for (const Polygon& square : lid_squares(hull.waterline, side)) {
    const bool kept = images.size() == 1 || std::all_of(images.begin(), images.end(), [&](const Image& image) {
                        return (image.x > 0 || square.centre.x() > 0) && (image.y > 0 || square.centre.y() > 0);
                      });
    if (kept) out.lid.push_back(panel(square.corners, body, {}));
  }
}

// ---- edges

/// Of each side of each outline whether the potential is not smooth there: at the waterline, and at knuckles of more
/// than 30° like those of hydrostatics::chord_volume().
std::vector<std::vector<bool>> edges_of(const std::vector<Outline>& all) {
  constexpr double cosine = 0.866;
  std::map<std::pair<Key, Key>, Vector3d> normal_of;
  const auto normal = [](const Corners& c) {
    Vector3d n = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < c.size(); ++i) n += (c[i] - c[0]).cross(c[i + 1] - c[0]);
    return Vector3d(n.normalized());
  };
  const auto next = [](const Corners& c, std::size_t i) { return c[(i + 1) % c.size()]; };
  for (const Outline& o : all)
    for (std::size_t i = 0; i < o.corners.size(); ++i)
      normal_of[{key(o.corners[i]), key(next(o.corners, i))}] = normal(o.corners);
  std::vector<std::vector<bool>> out;
  for (const Outline& o : all) {
    out.emplace_back();
    for (std::size_t i = 0; i < o.corners.size(); ++i) {
      const Vector3d &a = o.corners[i], b = next(o.corners, i);
      const auto other = normal_of.find({key(b), key(a)});
      const bool knuckle = other != normal_of.end() && other->second.dot(normal(o.corners)) < cosine;
      out.back().push_back(knuckle || (a.z() == 0 && b.z() == 0));
    }
  }
  return out;
}

std::vector<Image> images_of(bool x, bool y) {
  std::vector<Image> images{{1, 1}};
  if (x) images.push_back({-1, 1});
  if (y) images.push_back({1, -1});
  if (x && y) images.push_back({-1, -1});
  return images;
}

}  // namespace

Panel panel(std::vector<Vector3d> corners, int body, std::vector<bool> edge) {
  Panel p{.shape = polygon(std::move(corners)), .body = body, .rule = {}, .edge = std::move(edge)};
  p.rule[0] = {{p.shape.centre, p.shape.area}};
  const auto& c = p.shape.corners;
  for (int level = 1; level < 4; ++level)
    for (std::size_t i = 1; i + 1 < c.size(); ++i)
      add_three_points(c[0], c[i], c[i + 1], level - 1, p.rule[static_cast<std::size_t>(level)]);
  return p;
}

bool is_inside(const std::vector<Segment>& waterline, const Vector2d& p) {
  bool in = false;
  for (const auto& [a, b] : waterline)
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      in = !in;
  return in;
}

std::vector<Polygon> lid_squares(const std::vector<Segment>& waterline, double side) {
  std::vector<Polygon> out;
  if (waterline.empty()) return out;
  Vector2d low = waterline[0][0], high = low;
  for (const auto& s : waterline)
    for (const Vector2d& p : s) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  // A whole number of squares on either side of the axes, so that the lid is as symmetric as the hull.
  for (double i = std::floor(low.x() / side); i * side < high.x(); ++i)
    for (double j = std::floor(low.y() / side); j * side < high.y(); ++j)
      add_squares(waterline, side * Vector2d(i, j), side, 1, out);
  return out;
}

bool stands_on_bed(const HullBody& body, const WaterDepth& depth) {
  const std::vector<Triangle> all = triangles_of(body, depth.metres());
  return std::any_of(all.begin(), all.end(), [&](const Triangle& t) { return is_on_bed(t, depth.metres()); });
}

double wet_area(const PanelMesh& mesh) {
  double sum = 0;
  for (const Panel& p : mesh.hull) sum += p.shape.area;
  return sum * static_cast<double>(mesh.images.size());
}

PanelMesh panel_mesh(const std::vector<HullBody>& bodies, const WaterDepth& depth, bool lid) {
  require(!bodies.empty(), "there is no body");
  std::vector<WetHull> hulls;
  std::vector<Outline> outlines;
  double near = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    hulls.push_back(wet_hull(bodies[b], static_cast<int>(b), depth.metres()));
    outlines.insert(outlines.end(), hulls[b].outlines.begin(), hulls[b].outlines.end());
    near = std::max(near, 10 * hulls[b].near);
  }
  const std::vector<int> x = partners(outlines, {-1, 1}, near), y = partners(outlines, {1, -1}, near);
  PanelMesh out;
  out.images = images_of(!x.empty(), !y.empty());
  const std::vector<std::vector<bool>> edges = edges_of(outlines);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const Vector3d centre = mean(outlines[i].corners);
    if ((!x.empty() && centre.x() < 0) || (!y.empty() && centre.y() < 0)) continue;
    out.hull.push_back(panel(outlines[i].corners, outlines[i].body, edges[i]));
    std::array<int, 4> body{};
    for (std::size_t s = 0; s < out.images.size(); ++s) {
      std::size_t at = i;
      if (out.images[s].x < 0) at = static_cast<std::size_t>(x[at]);
      if (out.images[s].y < 0) at = static_cast<std::size_t>(y[at]);
      body[s] = outlines[at].body;
    }
    out.body_of.push_back(body);
  }
  for (std::size_t b = 0; lid && b < bodies.size(); ++b) add_lid(hulls[b], out.images, static_cast<int>(b), out);
  return out;
}

}  // namespace hydro::panels
