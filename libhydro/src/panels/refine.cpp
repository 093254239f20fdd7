#include "refine.hpp"

#include <algorithm>

namespace hydro::panels {
namespace {

using Eigen::Vector3d;
using Corners = std::vector<Vector3d>;
using Edges = std::vector<bool>;

/// Through the middles of all sides; pieces of sides at an edge are at it.
void add_cut_in_middle(const Panel& p, std::vector<Panel>& out) {
  const Corners& c = p.shape.corners;
  const std::size_t n = c.size();
  Corners middle;
  Vector3d centre = Vector3d::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    middle.emplace_back((c[k] + c[(k + 1) % n]) / 2);
    centre += c[k] / static_cast<double>(n);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = (k + n - 1) % n;
    if (n > 3)
      out.push_back(
          panel({middle[before], c[k], middle[k], centre}, p.body, {p.edge[before], p.edge[k], false, false}));
    else
      out.push_back(panel({middle[before], c[k], middle[k]}, p.body, {p.edge[before], p.edge[k], false}));
  }
  if (n == 3) out.push_back(panel(middle, p.body, {false, false, false}));
}

/// Where a strip from 0 to 1 is cut: in half from an edge at one end, in quarters from both.
std::vector<double> cuts(bool at_0, bool at_1) {
  if (at_0 && at_1) return {0, 0.25, 0.75, 1};
  return at_0 || at_1 ? std::vector<double>{0, 0.5, 1} : std::vector<double>{0, 1};
}

/// Four corners, cut along those sides that are at an edge.
void add_cut_along_edges(const Panel& p, std::vector<Panel>& out) {
  const Corners& c = p.shape.corners;
  const auto at = [&](double u, double v) {
    return Vector3d((1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]));
  };
  const std::vector<double> u = cuts(p.edge[3], p.edge[1]), v = cuts(p.edge[0], p.edge[2]);
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      out.push_back(panel(
          {at(u[i], v[j]), at(u[i + 1], v[j]), at(u[i + 1], v[j + 1]), at(u[i], v[j + 1])}, p.body,
          {p.edge[0] && j == 0, p.edge[1] && i + 2 == u.size(), p.edge[2] && j + 2 == v.size(), p.edge[3] && i == 0}));
}

/// A triangle with one side at an edge: a strip of four corners along it, and the rest.
void add_cut_along_side(const Panel& p, std::size_t side, std::vector<Panel>& out) {
  const Vector3d &a = p.shape.corners[side], &b = p.shape.corners[(side + 1) % 3], &c = p.shape.corners[(side + 2) % 3];
  out.push_back(panel({a, b, (b + c) / 2, (c + a) / 2}, p.body, {true, false, false, false}));
  out.push_back(panel({(c + a) / 2, (b + c) / 2, c}, p.body, {false, false, false}));
}

void add_graded(const Panel& p, std::vector<Panel>& out) {
  const auto edges = std::count(p.edge.begin(), p.edge.end(), true);
  if (edges == 0)
    out.push_back(p);
  else if (p.edge.size() == 4)
    add_cut_along_edges(p, out);
  else if (p.edge.size() == 3 && edges == 1)
    add_cut_along_side(p, static_cast<std::size_t>(std::find(p.edge.begin(), p.edge.end(), true) - p.edge.begin()),
                       out);
  else
    add_cut_in_middle(p, out);
}

/// The mesh with each panel replaced by the pieces that `add` makes of it.
template <class Add>
PanelMesh cut(const PanelMesh& mesh, Add add) {
  PanelMesh out{.hull = {}, .lid = mesh.lid, .images = mesh.images, .body_of = {}};
  for (std::size_t i = 0; i < mesh.hull.size(); ++i) {
    add(mesh.hull[i], out.hull);
    out.body_of.resize(out.hull.size(), mesh.body_of[i]);
  }
  return out;
}

}  // namespace

std::size_t pieces_when_refined(std::size_t corners) { return corners > 3 ? corners : 4; }

PanelMesh refined(const PanelMesh& mesh) { return cut(mesh, add_cut_in_middle); }

PanelMesh graded(const PanelMesh& mesh, int times) {
  PanelMesh out = mesh;
  for (int i = 0; i < times; ++i) out = cut(out, add_graded);
  return out;
}

}  // namespace hydro::panels
