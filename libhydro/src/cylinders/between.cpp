#include "between.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hydro::cylinders {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;

/// Largest entry of each ring max(|l|, |m|) = 0, 1, … of a translation of one vertical mode.
std::vector<double> rings(const MatrixXcd& G) {
  const Index M = G.rows() / 2;
  std::vector<double> largest(static_cast<std::size_t>(M + 1));
  for (Index l = -M; l <= M; ++l)
    for (Index m = -M; m <= M; ++m) {
      double& ring = largest[static_cast<std::size_t>(std::max(std::abs(l), std::abs(m)))];
      ring = std::max(ring, std::abs(G(l + M, m + M)));
    }
  return largest;
}

/// The closest pair of each two radii, whatever their groups.
std::vector<std::pair<std::size_t, std::size_t>> closest_pairs(const std::vector<Cylinder>& cylinders) {
  std::map<std::pair<double, double>, std::pair<std::size_t, std::size_t>> closest;
  const auto distance = [&](std::size_t i, std::size_t j) {
    return (cylinders[i].centre - cylinders[j].centre).norm();
  };
  for (std::size_t i = 0; i < cylinders.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto [at, is_new] = closest.try_emplace(std::minmax(cylinders[i].radius, cylinders[j].radius), i, j);
      if (distance(i, j) < distance(at->second.first, at->second.second)) at->second = {i, j};
    }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [radii, pair] : closest) pairs.push_back(pair);
  return pairs;
}

}  // namespace

Between::Between(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& group_of,
                 const std::vector<RadialScales>& scale, const VerticalModes& modes, const Channels& channels,
                 double least)
    : index_(channels), count_(channels.count()), size_(count_ * static_cast<Index>(cylinders.size())) {
  const auto pass = [&](std::size_t to, std::size_t from) {
    return translation(cylinders[to], cylinders[from], scale[to], scale[from], modes, channels, least);
  };
  std::vector<std::vector<double>> strongest(static_cast<std::size_t>(channels.vertical()));
  for (std::size_t n = 0; n < strongest.size(); ++n)
    strongest[n].assign(static_cast<std::size_t>(channels.order[n] + 1), 0);
  for (const auto& [i, j] : closest_pairs(cylinders)) {
    const Translation G = pass(i, j);
    for (std::size_t n = 0; n < G.size(); ++n) {
      const auto of_mode = rings(G[n]);
      for (std::size_t m = 0; m < of_mode.size(); ++m) strongest[n][m] = std::max(strongest[n][m], of_mode[m]);
    }
  }
  for (std::size_t to = 0; to < cylinders.size(); ++to)
    for (std::size_t from = 0; from < cylinders.size(); ++from) {
      if (group_of[to] == group_of[from]) continue;
      link_.push_back({to, from, trimmed(pass(to, from), strongest, least)});
    }
}

// An order that arrives weakly matters as far as what it makes reaches others, at most over the closest pair: two
// passages. Loads are those of the orders 0 and ±1, which stay (C15).
Translation Between::trimmed(Translation G, const std::vector<std::vector<double>>& strongest, double least) const {
  for (std::size_t n = 0; n < G.size(); ++n) {
    const auto of_mode = rings(G[n]);
    const Index M = G[n].rows() / 2;
    Index kept = M;
    while (kept > std::min<Index>(M, 1) &&
           of_mode[static_cast<std::size_t>(kept)] * strongest[n][static_cast<std::size_t>(kept)] < least)
      --kept;
    if (kept < M) G[n] = G[n].block(M - kept, M - kept, 2 * kept + 1, 2 * kept + 1).eval();
  }
  return G;
}

Amplitudes Between::translated(const Amplitudes& b) const {
  Amplitudes a = Amplitudes::Zero(b.rows(), b.cols());
  for (const Link& link : link_)
    for (std::size_t n = 0; n < link.G.size(); ++n) {
      const Index rows = link.G[n].rows();
      const int M = static_cast<int>(rows / 2), mode = static_cast<int>(n);
      a.middleRows(index_(link.to, mode, -M), rows).noalias() +=
          link.G[n] * b.middleRows(index_(link.from, mode, -M), rows);
    }
  return a;
}

MatrixXcd Between::system(const GroupedCylinders& groups) const {
  MatrixXcd A = MatrixXcd::Identity(size_, size_);
  for (const Link& link : link_) {
    const std::size_t group = groups.group_of[link.from];
    const auto& members = groups.members[group];
    const MatrixXcd& T = groups.compound[group]->T;
    const auto own = static_cast<std::size_t>(std::find(members.begin(), members.end(), link.from) - members.begin());
    for (std::size_t n = 0; n < link.G.size(); ++n) {
      const Index rows = link.G[n].rows();
      const int M = static_cast<int>(rows / 2), mode = static_cast<int>(n);
      const MatrixXcd passed = link.G[n] * T.middleRows(index_(own, mode, -M), rows);
      for (std::size_t j = 0; j < members.size(); ++j)
        A.block(index_(link.to, mode, -M), static_cast<Index>(members[j]) * count_, rows, count_) -=
            passed.middleCols(static_cast<Index>(j) * count_, count_);
    }
  }
  return A;
}

}  // namespace hydro::cylinders
