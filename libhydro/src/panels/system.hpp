#pragma once
/// \file  The equations of one frequency, assembled and solved. (G12), (G13) in docs/theory/panels.md. Not installed.
#include <Eigen/Core>

#include <vector>

#include "green.hpp"
#include "panel_mesh.hpp"

namespace hydro::panels {

/// How potentials behave from image to image: one sign for each.
using Signs = std::vector<double>;
/// One a class of symmetry: 1, 2 or 4 that all motions are sums of.
std::vector<Signs> classes_of(const PanelMesh& mesh);

/// Unit velocities and waves as they stand on all panels: image s of panel i is row s · n + i.
struct AllPanels {
  Eigen::MatrixXd normal;  ///< generalised normals, (all, 6N)
  Eigen::MatrixXd point;   ///< centres, (all, 3)
  Eigen::MatrixXd n;       ///< normals, (all, 3)
  Eigen::VectorXd area;
};
AllPanels all_panels(const PanelMesh& mesh, const std::vector<HullBody>& bodies);

/// Rankine's parts, the same at all frequencies: for each class, from panels to the centres of panels and lid.
struct RankineParts {
  struct OfClass {
    Eigen::MatrixXd dipole, image_dipole;  ///< (rows, hull panels)
    Eigen::MatrixXd source, image_source;  ///< of hull panels times velocities: (rows, 6N)
    Eigen::MatrixXd lid;                   ///< sources of the lid with their images, (rows, lid panels)
  };
  std::vector<OfClass> of_class;
};
/// dipole holds the image in the bed too.
RankineParts rankine_parts(const PanelMesh& mesh, const AllPanels& all, const WaterDepth& depth);

/// ∬ G dS and ∬ ∂G/∂n dS of a panel, at a point P in the water or at its surface that is not on the panel; by rules
/// that suit a point `decided_at`, so that places near it have the same.
struct Influence {
  std::complex<double> source, dipole;
};
Influence influence(const WaveGreen& green, const WaterDepth& depth, const Panel& panel, const Eigen::Vector3d& P,
                    const Eigen::Vector3d& decided_at);

/// Potentials of unit motions and, total, of unit waves at the centres of all panels.
struct Potentials {
  Eigen::MatrixXcd motion;  ///< (all, 6N), m²/s per m/s, or per rad/s
  Eigen::MatrixXcd wave;    ///< (all, headings)
};
/// `incident` at the centres of all panels, then of all images of the lid; (rows, headings).
Potentials solve_system(const PanelMesh& mesh, const AllPanels& all, const RankineParts& parts, const WaveGreen& green,
                        const Eigen::MatrixXcd& incident);

}  // namespace hydro::panels
