#pragma once
/// \file  The water's pressure on hulls in a regular wave, to first order. (P40) in docs/theory/conventions.md.
///
/// Pressures are complex amplitudes per metre of the amplitude of the incident wave, Re(p e^{iωt}), as elevations are.
#include <Eigen/Core>

#include <complex>
#include <vector>

namespace hydro::potential {

/// A flat piece of a hull under still water, global, m.
struct WetPanel {
  int body;                              ///< in the order of the bodies, from 0
  std::vector<Eigen::Vector3d> corners;  ///< anticlockwise seen from the water, three at least
  Eigen::Vector3d centre, normal;        ///< of its area; of unit length, out of the body
  double area;                           ///< m²
};

/// The pressure at the centres of panels.
struct HullPressure {
  std::vector<WetPanel> panel;
  Eigen::VectorXcd dynamic;      ///< −ρ iω φ of incident, scattered and radiated waves, Pa/m
  Eigen::VectorXcd hydrostatic;  ///< −ρ g times the rise of the centre, which moves with its body, Pa/m
  /// How far `dynamic` is off by the size of panels: the largest change that cutting them in four makes, over the
  /// largest.
  double estimate = 0;
};

/// Load of the dynamic pressure on body `body`, F and M about `about`, (6), N/m and N m/m.
Eigen::VectorXcd dynamic_load(const HullPressure& hulls, int body, const Eigen::Vector3d& about);

/// The largest difference of `dynamic` from the mean over the pieces of each panel, over the largest of `finer`, whose
/// panels are those of `coarser` cut in four: `pieces` has how many a panel of so many corners is.
double difference(const HullPressure& coarser, const HullPressure& finer, std::size_t (*pieces)(std::size_t corners));

}  // namespace hydro::potential
