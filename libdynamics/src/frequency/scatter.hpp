#pragma once
/// \file  Private: from the matrix of a group of bodies to that of the model.
#include <Eigen/Core>

#include <vector>

namespace dynamics::frequency {

/// Adds the 6 × 6 blocks of a group's matrix to those of the whole.
template <class Part, class Whole>
void scatter_add(const std::vector<int>& bodies, const Part& part, Whole& whole) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = 0; j < bodies.size(); ++j)
      whole.template block<6, 6>(6 * bodies[i], 6 * bodies[j]) +=
          part.template block<6, 6>(6 * static_cast<Eigen::Index>(i), 6 * static_cast<Eigen::Index>(j));
}

}  // namespace dynamics::frequency
