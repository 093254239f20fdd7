#include "between.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "hydro/base/error.hpp"
#include "hydro/base/product.hpp"

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

/// The order up to which waves pass over the lattice with the least work; higher ones pass pair by pair. −1: none.
template <class Classes>
Index order_of_lattice(const Lattice& lattice, const Classes& classes, Index highest) {
  const auto pairwise = [&](Index beyond) {
    double work = 0;
    for (const auto& c : classes)
      if (c.within || c.order() > beyond)
        work += static_cast<double>(c.pairs.size()) * static_cast<double>(c.G->front().size());
    return work;
  };
  Index best = -1;
  double least = pairwise(-1);
  for (Index order = 1; order <= highest; ++order) {
    const double work = pairwise(order) + lattice.work(static_cast<double>(order));
    if (work < least) best = order, least = work;
  }
  return best;
}

}  // namespace

Between::Between(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& group_of,
                 const std::vector<RadialScales>& scale, const VerticalModes& modes, const Channels& channels,
                 double least, const Lattice* lattice)
    : index_(channels), count_(channels.count()), size_(count_ * static_cast<Index>(cylinders.size())) {
  const auto whole = [&](std::size_t to, std::size_t from) {
    return translation(cylinders[to], cylinders[from], scale[to], scale[from], modes, channels, least);
  };
  std::vector<std::vector<double>> strongest(static_cast<std::size_t>(channels.vertical()));
  for (std::size_t n = 0; n < strongest.size(); ++n)
    strongest[n].assign(static_cast<std::size_t>(channels.order[n] + 1), 0);
  for (const auto& [i, j] : closest_pairs(cylinders)) {
    const Translation G = whole(i, j);
    for (std::size_t n = 0; n < G.size(); ++n) {
      const auto of_mode = rings(G[n]);
      for (std::size_t m = 0; m < of_mode.size(); ++m) strongest[n][m] = std::max(strongest[n][m], of_mode[m]);
    }
  }
  const Pass pass = [&](std::size_t to, std::size_t from) { return trimmed(whole(to, from), strongest, least); };
  if (lattice != nullptr && modes.has_wave()) {
    link_classes(*lattice, classes(*lattice, group_of), pass);
    return;
  }
  for (std::size_t to = 0; to < cylinders.size(); ++to)
    for (std::size_t from = 0; from < cylinders.size(); ++from) {
      if (group_of[to] == group_of[from]) continue;
      link_.push_back({to, from, std::make_shared<const Translation>(pass(to, from)), 0});
    }
}

std::vector<Between::Class> Between::classes(const Lattice& lattice, const std::vector<std::size_t>& group_of) {
  std::map<std::tuple<std::size_t, std::size_t, Index, Index>, Class> found;
  for (std::size_t to = 0; to < group_of.size(); ++to)
    for (std::size_t from = 0; from < group_of.size(); ++from) {
      if (to == from) continue;
      const Lattice::Site &a = lattice.site[to], &b = lattice.site[from];
      const Index row = a.row - b.row, column = a.column - b.column;
      Class& c = found.try_emplace({a.kind, b.kind, row, column}, Class{a.kind, b.kind, row, column, {}, false, {}})
                     .first->second;
      if (group_of[to] == group_of[from])
        c.within = true;
      else
        c.pairs.emplace_back(to, from);
    }
  std::vector<Class> out;
  for (auto& [key, c] : found)
    if (!c.pairs.empty()) out.push_back(std::move(c));
  return out;
}

// Evanescent modes reach few pairs, which pass them one by one.
void Between::link_classes(const Lattice& lattice, std::vector<Class> all, const Pass& pass) {
  Index highest = 0;
  for (Class& c : all) {
    c.G = std::make_shared<const Translation>(pass(c.pairs.front().first, c.pairs.front().second));
    highest = std::max(highest, c.order());
  }
  const Index order = order_of_lattice(lattice, all, highest);
  if (order >= 0) far_.emplace(lattice, static_cast<int>(order));
  for (const Class& c : all) {
    const bool far = !c.within && c.order() <= order;
    if (far) far_->set(c.to_kind, c.from_kind, c.row, c.column, c.G->front());
    if (far && c.G->size() == 1) continue;
    for (const auto& [to, from] : c.pairs) link_.push_back({to, from, c.G, far ? std::size_t{1} : std::size_t{0}});
  }
  if (far_) far_->transform();
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
  if (far_) far_->add(index_, b, a);
  for (const Link& link : link_)
    for (std::size_t n = link.first; n < link.G->size(); ++n) {
      const MatrixXcd& G = (*link.G)[n];
      const int M = static_cast<int>(G.rows() / 2), mode = static_cast<int>(n);
      add_product(G, b.middleRows(index_(link.from, mode, -M), G.rows()),
                  a.middleRows(index_(link.to, mode, -M), G.rows()));
    }
  return a;
}

MatrixXcd Between::system(const GroupedCylinders& groups) const {
  ensure(!far_, "equations are written out pair by pair");
  MatrixXcd A = MatrixXcd::Identity(size_, size_);
  for (const Link& link : link_) {
    const std::size_t group = groups.group_of[link.from];
    const auto& members = groups.members[group];
    const MatrixXcd& T = groups.compound[group]->T;
    const auto own = static_cast<std::size_t>(std::find(members.begin(), members.end(), link.from) - members.begin());
    for (std::size_t n = 0; n < link.G->size(); ++n) {
      const Index rows = (*link.G)[n].rows();
      const int M = static_cast<int>(rows / 2), mode = static_cast<int>(n);
      const MatrixXcd passed = (*link.G)[n] * T.middleRows(index_(own, mode, -M), rows);
      for (std::size_t j = 0; j < members.size(); ++j)
        A.block(index_(link.to, mode, -M), static_cast<Index>(members[j]) * count_, rows, count_) -=
            passed.middleCols(static_cast<Index>(j) * count_, count_);
    }
  }
  return A;
}

}  // namespace hydro::cylinders
