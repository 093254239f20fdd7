#pragma once
/// \file  Private: the small motions that joints and held modes leave, and matrices of all motions brought down to
/// them.
#include <Eigen/Core>
#include <Eigen/QR>

#include <vector>

#include "dynamics/frequency/small_motions.hpp"

namespace dynamics::frequency {

/// δ = N x with G N = 0, one column of N a motion that is left (D17). Without joints the columns are single modes, and
/// only indices are kept.
class Reduction {
 public:
  explicit Reduction(const SmallMotions& about);

  Eigen::Index count() const { return jointed_ ? basis_.cols() : static_cast<Eigen::Index>(free_.size()); }

  /// Nᵀ A N.
  template <class Matrix>
  Matrix matrix(const Matrix& whole) const {
    if (!jointed_) return whole(free_, free_);
    const Matrix N = basis_.cast<typename Matrix::Scalar>();
    return N.transpose() * whole * N;
  }
  /// Nᵀ f, of a vector or of each column.
  template <class Vector>
  Vector vector(const Vector& whole) const {
    if (!jointed_) return whole(free_, Eigen::all);
    return basis_.transpose().cast<typename Vector::Scalar>() * whole;
  }
  /// N x, of a vector or of each column.
  template <class Vector>
  Vector expanded(const Vector& x) const {
    if (jointed_) return basis_.cast<typename Vector::Scalar>() * x;
    Vector out = Vector::Zero(modes_, x.cols());
    out(free_, Eigen::all) = x;
    return out;
  }

 private:
  Eigen::Index modes_;
  bool jointed_;
  std::vector<int> free_;
  Eigen::MatrixXd basis_;
};

}  // namespace dynamics::frequency
