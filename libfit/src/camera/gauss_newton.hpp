#pragma once
/// \file  Gauss–Newton for a handful of numbers whose slopes are known. Private to libfit.
#include <Eigen/Core>

#include <functional>
#include <optional>

namespace fit::camera {

/// What is sought is kept by whoever asks: turns are not added up.
struct FewNumbers {
  /// Missed over its errors, which are independent, and its slopes along the numbers as they are; false where there is
  /// no such thing.
  std::function<bool(Eigen::VectorXd& missed, Eigen::MatrixXd& slope)> model;
  std::function<void(const Eigen::VectorXd& step)> move;
};
struct LeastSquares {
  double squares;  ///< what is left over
  Eigen::MatrixXd covariance;
};
/// Steps are halved until what is missed falls, and end at 1e-6 of a standard deviation. None where no step helps, or
/// where the numbers cannot be told apart.
std::optional<LeastSquares> least_squares(const FewNumbers& sought);

}  // namespace fit::camera
