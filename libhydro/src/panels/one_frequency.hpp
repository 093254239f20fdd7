#pragma once
/// \file  Loads of one frequency from its potentials, and what waves far away say of them. (G13), (G14) in
/// docs/theory/panels.md. Not installed.
#include <cmath>

#include "system.hpp"

namespace hydro::panels {

/// (6N, 6N) and (6N, headings). Far: from the waves that motions make.
struct OneFrequency {
  Eigen::MatrixXd A, B, B_far;
  Eigen::MatrixXcd X, X_far;
};

/// A mesh with all that does not depend on the frequency.
class Model {
 public:
  Model(PanelMesh mesh, const std::vector<HullBody>& bodies, const Water& water);

  OneFrequency at(double omega, const std::vector<double>& heading) const;
  /// A at K = 0 (deep water only) or K = +∞.
  Eigen::MatrixXd added_mass_limit(double K) const;
  /// The side of a square of the mean wet area of a hull, m.
  double length(std::size_t bodies) const { return std::sqrt(all_.area.sum() / static_cast<double>(bodies)); }
  const PanelMesh& mesh() const { return mesh_; }

 private:
  Eigen::MatrixXcd incident(double omega, double k, const std::vector<double>& heading) const;
  Eigen::MatrixXcd haskind(double omega, double k, const Eigen::MatrixXcd& motion,
                           const std::vector<double>& heading) const;
  Eigen::MatrixXcd loads(const Eigen::MatrixXcd& potential) const;
  Eigen::MatrixXd damping_far(double omega, double k, const Eigen::MatrixXcd& motion) const;
  double profile(double k, double z) const;

  PanelMesh mesh_;
  Water water_;
  AllPanels all_;
  RankineParts parts_;
  double reach_ = 0;
};

}  // namespace hydro::panels
