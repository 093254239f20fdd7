#pragma once
/// \file  The surface about hulls, from potentials on their panels. (G21) in docs/theory/panels.md. Not installed.
#include <array>
#include <vector>

#include "hydro/potential/wave_field.hpp"
#include "one_frequency.hpp"

namespace hydro::panels {

/// Potentials and velocities along the normals on all panels: what Green's theorem needs of one motion of the water.
struct OnPanels {
  Eigen::VectorXcd potential, velocity;
};

/// 4π φ at a point P of the water or its surface, outside of all hulls, of each of these motions; panels are summed by
/// rules that suit `decided_at`, at P or near it.
template <std::size_t Count>
std::array<std::complex<double>, Count> by_greens_theorem(const PanelMesh& mesh, const WaterDepth& depth,
                                                          const WaveGreen& green,
                                                          const std::array<OnPanels, Count>& motion,
                                                          const Eigen::Vector3d& P, const Eigen::Vector3d& decided_at) {
  std::array<std::complex<double>, Count> sum{};
  Eigen::Index row = 0;
  for (const Image& image : mesh.images) {
    const Eigen::Vector3d from = image * P, decided_from = image * decided_at;
    for (const Panel& panel : mesh.hull) {
      const Influence of = influence(green, depth, panel, from, decided_from);
      for (std::size_t i = 0; i < Count; ++i)
        sum[i] += of.dipole * motion[i].potential(row) - of.source * motion[i].velocity(row);
      ++row;
    }
  }
  return sum;
}

/// True for each point that is outside of the waterlines of all hulls of the mesh, and not on one.
std::vector<bool> outside(const PanelMesh& mesh, const Eigen::MatrixX2d& point);

/// By Green's theorem over all panels, from potentials that are solved for here. Points that are not outside() are not
/// told. `threads`: which share the points.
potential::WaveField field_of(const Model& model, const Water& water, const potential::FieldQuestion& question,
                              int threads);

}  // namespace hydro::panels
