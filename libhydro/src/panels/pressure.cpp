#include "pressure.hpp"

#include <algorithm>

namespace hydro::panels {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// The panels in all images, in the order of AllPanels; corners of a mirrored one in the opposite order.
std::vector<potential::WetPanel> wet_panels(const PanelMesh& mesh, const AllPanels& all) {
  std::vector<potential::WetPanel> out;
  Index row = 0;
  for (std::size_t s = 0; s < mesh.images.size(); ++s)
    for (std::size_t i = 0; i < mesh.hull.size(); ++i, ++row) {
      std::vector<Vector3d> corners;
      for (const Vector3d& p : mesh.hull[i].shape.corners) corners.emplace_back(mesh.images[s] * p);
      if (mesh.images[s].x * mesh.images[s].y < 0) std::reverse(corners.begin(), corners.end());
      out.push_back({mesh.body_of[i][s], std::move(corners), all.point.row(row), all.n.row(row), all.area(row)});
    }
  return out;
}

}  // namespace

potential::HullPressure pressure_of(const Model& model, const Water& water, const potential::FieldQuestion& question,
                                    const Potentials& phi) {
  const std::complex<double> rate(0, question.omega);
  const Eigen::VectorXcd velocity = rate * question.motion;
  potential::HullPressure out{.panel = wet_panels(model.mesh(), model.all()),
                              .dynamic = -water.density * rate * (phi.wave.col(0) + phi.motion * velocity),
                              .hydrostatic = Eigen::VectorXcd(phi.wave.rows())};
  for (std::size_t i = 0; i < out.panel.size(); ++i) {
    const auto body = static_cast<std::size_t>(out.panel[i].body);
    const auto xi = question.motion.segment<6>(6 * static_cast<Index>(body));
    const Vector3d from = out.panel[i].centre - model.reference_points()[body];
    out.hydrostatic(static_cast<Index>(i)) =
        -water.density * water.gravity * (xi(2) + xi(3) * from.y() - xi(4) * from.x());
  }
  return out;
}

}  // namespace hydro::panels
