#pragma once
/// \file  Private: curves of straight pieces by where they bend.
#include <Eigen/Core>

#include <vector>

namespace hydro::radiation::detail {

/// Several curves, a column each, straight between the same places `at`, increasing.
struct Corners {
  Eigen::ArrayXd at;
  Eigen::MatrixXd value;  ///< a row a place

  /// The same curves without places where none bends: each stays within `share` of its largest value.
  Corners needed(double share) const;
  /// Second derivative at each place, where the slope jumps; beyond both ends the curves are level.
  Eigen::MatrixXd jumps() const;
};

}  // namespace hydro::radiation::detail
