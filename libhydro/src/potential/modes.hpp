#pragma once
/// \file  Private: what operations on whole sets of matrices share.
#include <Eigen/Core>

#include <complex>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// Applies `change` to A, B and their limits.
template <class Change>
void for_each_radiation_matrix(Coefficients& c, Change change) {
  for (auto& m : c.A) change(m);
  for (auto& m : c.B) change(m);
  if (c.A_zero) change(*c.A_zero);
  if (c.A_inf) change(*c.A_inf);
}

/// Sizes of modes, each raised to 1 % of the largest of its kind (translations, rotations): yaw of a body of revolution
/// has no added mass but the panels' noise, and without a floor that noise would be divided by itself (P11).
Eigen::VectorXd with_floor(Eigen::VectorXd size);

/// s of (P11): the largest diagonal entry of each mode, with_floor().
Eigen::VectorXd mode_sizes(const std::vector<Eigen::MatrixXd>& matrices);

/// Largest |D_ij| / sqrt(s_i s_j) (P11); 0 where nothing has a size.
double relative_size(const Eigen::MatrixXd& difference, const Eigen::VectorXd& size);

/// The nearest matrix without negative eigenvalues, entries being measured against the largest of their modes, `size`
/// (P11): a small damping is a difference of large numbers, and what is computed leaves it below zero now and then.
/// Were a small mode measured against itself alone, its error would be put on the large ones that it is coupled with.
Eigen::MatrixXd nearest_passive(const Eigen::MatrixXd& B, const Eigen::VectorXd& size);

/// Phase of the way to (x, y) of a wave of this wavenumber, 1/m: e^{−ik(x cos β + y sin β)}.
std::complex<double> way(double k, double heading, double x, double y);

/// X with the phase of the waves' way to the place of each body, one a body, taken out (`sign` −1) or put in (+1).
std::vector<Eigen::MatrixXcd> turned_by_way(const Coefficients& c, const std::vector<Eigen::Vector3d>& place,
                                            double sign);

/// The matrix of six numbers for each body, the same for all, on the diagonal: size (6N, 6N).
Eigen::MatrixXd for_every_body(const Matrix6& one, int bodies);

}  // namespace hydro::potential
