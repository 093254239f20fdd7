#pragma once
/// \file  Hulls as panels: cut at the water, joined to quadrilaterals, and of a symmetric mesh one part only.
/// (G10), (G11) in docs/theory/panels.md. Not installed.
#include <array>
#include <vector>

#include "hydro/panels/solve.hpp"
#include "polygon.hpp"

namespace hydro::panels {

/// A point of a rule of quadrature; the weights of a panel add up to its area.
struct RulePoint {
  Eigen::Vector3d at;
  double weight;
};

struct Panel {
  Polygon shape;
  int body;
  std::array<std::vector<RulePoint>, 4> rule;  ///< from its centre alone to many points
  std::vector<bool> edge;                      ///< of each side: a knuckle of the hull or its waterline, see graded()
};
/// With rules; `edge` belongs to the sides from each corner to the next.
Panel panel(std::vector<Eigen::Vector3d> corners, int body, std::vector<bool> edge);

/// Signs of x and y in one image of the part that is kept; the first is (1, 1).
struct Image {
  double x, y;
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return {x * p.x(), y * p.y(), p.z()}; }
};

/// The part of all panels that its images complete.
struct PanelMesh {
  std::vector<Panel> hull, lid;
  std::vector<Image> images;                ///< 1, 2 or 4
  std::vector<std::array<int, 4>> body_of;  ///< of each panel of `hull`, in each image
  int hull_panels() const { return static_cast<int>(hull.size() * images.size()); }
  int lid_panels() const { return static_cast<int>(lid.size() * images.size()); }
};

/// \throws InputError as solve()
PanelMesh panel_mesh(const std::vector<HullBody>& bodies, const WaterDepth& depth, bool lid);
/// A face lies on the bed: no water is there. \throws InputError as panel_mesh()
bool stands_on_bed(const HullBody& body, const WaterDepth& depth);
/// Of all images of the hulls, m².
double wet_area(const PanelMesh& mesh);
/// Whether p is inside the closed lines that these pairs of points make.
bool is_inside(const std::vector<std::array<Eigen::Vector2d, 2>>& waterline, const Eigen::Vector2d& p);
/// Squares that cover the water inside the closed lines that `waterline` (pairs of points) makes, all but a seam.
std::vector<Polygon> lid_squares(const std::vector<std::array<Eigen::Vector2d, 2>>& waterline, double side);

}  // namespace hydro::panels
