#pragma once
/// \file  Potentials at the still surface of waves that cylinders, or circles about hulls, send out. (C22) in
/// docs/theory/cylinders.md. Not installed.
#include <Eigen/Core>

#include <vector>

#include "array.hpp"
#include "hydro/potential/wave_field.hpp"
#include "lattice.hpp"

namespace hydro::cylinders {

/// True for each point of which the waves sent out are told: outside of all these circles.
std::vector<bool> outside(const std::vector<Cylinder>& cylinders, const Eigen::MatrixX2d& point);
/// The distance of the nearest of those from a circle, m; +∞ if there is none.
double nearest_outside(const std::vector<Cylinder>& cylinders, const Eigen::MatrixX2d& point);

/// Q_n(r) of (C4) for m = 0 … `scale.size()` − 1.
std::vector<std::complex<double>> outgoing(const VerticalModes& modes, int n, double r, double radius,
                                           const std::vector<double>& scale);
/// The modes, of `vertical`, that reach from the side of a cylinder to a point `distance` from it, the wave among them.
int modes_that_reach(const VerticalModes& modes, double distance, int vertical);

/// Σ b Q_n(r) e^{imθ} Z_n(0) over all cylinders, one row a point, one column a column of `sent_out`, whose rows are as
/// WaveIndex(channels) has them. Of modes only those from `from` to before `to`. Rows of points that are not `known`
/// are 0.
Eigen::MatrixXcd potentials_at_surface(const std::vector<Cylinder>& cylinders, const VerticalModes& modes,
                                       const Channels& channels, const Amplitudes& sent_out,
                                       const Eigen::MatrixX2d& point, const std::vector<bool>& known, int from, int to,
                                       int threads);

/// What is added to a field by waves that are sent out by the unit wave Z_0(z) e^{−ik…} (first column) and by the real
/// and the imaginary part of the bodies' velocities per metre of wave (second and third); `known` as it is.
potential::WaveField field_of(const Eigen::MatrixXcd& at_surface, const VerticalModes& modes, const Water& water,
                              const potential::FieldQuestion& question, std::vector<bool> known);

/// The same far away, of f (C13) at each angle, one column each as `at_surface` has them.
potential::FarField far_field_of(std::vector<double> angle, const Eigen::MatrixXcd& f, const VerticalModes& modes,
                                 const Water& water, double omega);

/// Angles for the far field of waves from these cylinders, or circles about hulls, of so many orders.
std::vector<double> angles_around(const std::vector<Cylinder>& cylinders, double heading, double k, int orders);

/// Velocities per metre of wave, of motions about reference points: the real parts, then the imaginary ones, (6N, 2).
Eigen::MatrixXd velocities_of(const potential::FieldQuestion& question);

}  // namespace hydro::cylinders
