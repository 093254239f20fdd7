#pragma once
/// \file  Loads of one frequency from its potentials, and what waves far away say of them. (G13), (G14) in
/// docs/theory/panels.md. Not installed.
#include "discretisation.hpp"
#include "system.hpp"

namespace hydro::panels {

/// All hulls of one mesh, solved together, with all that does not depend on the frequency.
class Model {
 public:
  Model(PanelMesh mesh, const std::vector<HullBody>& bodies, const Water& water);

  OneFrequency at(double omega, const std::vector<double>& heading) const;
  /// A at K = ω²/g = 0 (deep water only) or +∞.
  Eigen::MatrixXd added_mass_limit(double K) const;

  const PanelMesh& mesh() const { return mesh_; }
  const AllPanels& all() const { return all_; }
  /// Of motions and moments of the bodies, m.
  const std::vector<Eigen::Vector3d>& reference_points() const { return reference_point_; }
  /// Centres of all panels, then of all images of the lid, (rows, 3); without the latter if K = +∞, where there is no
  /// lid.
  Eigen::MatrixXd points(double K) const;
  /// Of unit motions, and total ones of waves `incident` at points(K).
  Potentials potentials(double K, const Eigen::MatrixXcd& incident) const;
  /// The same in a wave of unit amplitude.
  Potentials in_wave(double omega, double heading) const;
  /// Of that wave without bodies, at a place in the water; k is its wavenumber.
  std::complex<double> incident(double omega, double k, double heading, const Eigen::Vector3d& at) const;
  /// Waves far away of bodies with these velocities, as in_wave() has their potentials. (P38)
  potential::FarField far_field(const Potentials& phi, double omega, double heading,
                                const Eigen::VectorXcd& velocity) const;
  /// The greatest distance along the water between panels, with room for their corners, m.
  double reach() const { return reach_; }
  /// L = ∬ φ n dS, row: load on, column: potential at the centres of all panels.
  Eigen::MatrixXcd loads(const Eigen::MatrixXcd& potential) const;

 private:
  Eigen::MatrixXcd incident(double omega, double k, const std::vector<double>& heading) const;
  Eigen::MatrixXcd haskind(double omega, double k, const Eigen::MatrixXcd& potential, const Eigen::MatrixXd& velocity,
                           const std::vector<double>& heading) const;
  Eigen::MatrixXd damping_far(double omega, double k, const Eigen::MatrixXcd& motion) const;
  double profile(double k, double z) const;

  PanelMesh mesh_;
  Water water_;
  std::vector<Eigen::Vector3d> reference_point_;
  AllPanels all_;
  Eigen::MatrixXd load_rows_;  // of parts of hulls
  RankineParts parts_;
  double reach_ = 0;
};

}  // namespace hydro::panels
