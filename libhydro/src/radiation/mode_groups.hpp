#pragma once
/// \file  Private: modes that feel each other, apart from those that do not.
#include <Eigen/Core>

#include <algorithm>
#include <utility>
#include <vector>

namespace hydro::radiation::detail {

/// Modes 0 … `modes` − 1 in groups, each ascending: a group's modes feel each other, through others or not, and no
/// others. `feels(i, j)` is asked for pairs in either order, so it must be symmetric. Cost O(modes²).
template <class Feels>
std::vector<std::vector<Eigen::Index>> groups_of_modes(Eigen::Index modes, const Feels& feels) {
  std::vector<std::vector<Eigen::Index>> out;
  std::vector<bool> taken(static_cast<std::size_t>(modes), false);
  for (Eigen::Index first = 0; first < modes; ++first) {
    if (taken[static_cast<std::size_t>(first)]) continue;
    taken[static_cast<std::size_t>(first)] = true;
    std::vector<Eigen::Index> group{first};
    for (std::size_t at = 0; at < group.size(); ++at)
      for (Eigen::Index other = 0; other < modes; ++other)
        if (!taken[static_cast<std::size_t>(other)] && feels(group[at], other)) {
          taken[static_cast<std::size_t>(other)] = true;
          group.push_back(other);
        }
    std::sort(group.begin(), group.end());
    out.push_back(std::move(group));
  }
  return out;
}

}  // namespace hydro::radiation::detail
