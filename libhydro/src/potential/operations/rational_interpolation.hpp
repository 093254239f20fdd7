#pragma once
/// \file  One rational function of frequency for many entries at once. (P36) in docs/theory/conventions.md. Not
/// installed.
#include <Eigen/Core>

#include <complex>
#include <vector>

namespace hydro::potential {

/// The unit vector x for which |A x| is least, of a matrix with as many rows as columns or more; where several are as
/// good to rounding, one of them. By inverse iteration with R of A = QR.
Eigen::VectorXcd least_stretched(const Eigen::MatrixXcd& A);

/// r(x) = Σ w_j f_j/(x − x_j) / Σ w_j/(x − x_j) over some of the places, its supports, with the same weights w for
/// every entry of f. At supports it is f itself, at the other places as near as one rational function of that order
/// comes.
class RationalInterpolation {
 public:
  /// Supports are added, each time the place that is missed most, until no entry of `value` (one row a place, in units
  /// of what an entry may be off) is missed by more than `tolerance`, or the other places would be too few to tell the
  /// weights: each of them has as many conditions as there are independent entries. `place` increases.
  RationalInterpolation(const std::vector<double>& place, const Eigen::MatrixXcd& value, double tolerance);

  /// The share of the value at each place in that at `x`, which may lie anywhere: (places).
  Eigen::RowVectorXcd shares(double x) const;
  std::vector<double> supports() const;

 private:
  std::vector<Eigen::Index> others() const;
  void find_weights();

  std::vector<double> place_;
  Eigen::MatrixXcd mixed_;  ///< of the values, which weights are found from
  std::vector<Eigen::Index> support_;
  Eigen::VectorXcd weight_;  ///< of those
};

}  // namespace hydro::potential
