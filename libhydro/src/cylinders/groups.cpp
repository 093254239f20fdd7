#include "groups.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;

/// Sets of cylinders joined by gaps up to `reach`: each takes the smallest number of those it is joined to.
std::vector<std::vector<std::size_t>> joined(const std::vector<Cylinder>& cylinders, double reach) {
  const std::size_t N = cylinders.size();
  std::vector<std::size_t> label(N);
  for (std::size_t i = 0; i < N; ++i) label[i] = i;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double gap = (cylinders[i].centre - cylinders[j].centre).norm() - cylinders[i].radius - cylinders[j].radius;
      if (gap > reach || label[i] == label[j]) continue;
      const std::size_t kept = std::min(label[i], label[j]), gone = std::max(label[i], label[j]);
      std::replace(label.begin(), label.end(), gone, kept);
    }
  std::map<std::size_t, std::vector<std::size_t>> sets;
  for (std::size_t i = 0; i < N; ++i) sets[label[i]].push_back(i);
  std::vector<std::vector<std::size_t>> members;
  for (auto& [first, set] : sets) members.push_back(std::move(set));
  return members;
}

/// Different gaps between cylinders from the smallest on, at most `most`; they differ by a tenth at least.
std::vector<double> distinct_gaps(const std::vector<Cylinder>& cylinders, std::size_t most) {
  std::vector<double> gaps;
  for (std::size_t i = 0; i < cylinders.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      gaps.push_back((cylinders[i].centre - cylinders[j].centre).norm() - cylinders[i].radius - cylinders[j].radius);
  std::sort(gaps.begin(), gaps.end());
  std::vector<double> distinct;
  for (const double gap : gaps) {
    if (distinct.size() == most) break;
    if (distinct.empty() || gap > 1.1 * distinct.back()) distinct.push_back(1.0001 * gap);
  }
  return distinct;
}

double cube(double x) { return x * x * x; }

Grouping grouped(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& kind,
                 const VerticalModes& modes, double threshold, double reach) {
  Grouping g{joined(cylinders, reach), {}, {}, 0};
  std::vector<std::size_t> group(cylinders.size());
  for (std::size_t s = 0; s < g.members.size(); ++s)
    for (const std::size_t c : g.members[s]) group[c] = s;
  g.within =
      coupled_channels(cylinders, modes, threshold, [&](std::size_t i, std::size_t j) { return group[i] == group[j]; });
  g.between =
      coupled_channels(cylinders, modes, threshold, [&](std::size_t i, std::size_t j) { return group[i] != group[j]; });
  g.between.order[0] = std::max(g.between.order[0], g.within.order[0]);  // arriving waves have all orders
  g.within = g.within.united_with(g.between);
  constexpr double compression = 0.4;  // unknowns left of the partial waves within groups, as seen
  std::set<std::string> known;
  if (g.members.size() > 1) g.work = cube(static_cast<double>(cylinders.size()) * g.between.count());
  for (const auto& members : g.members)
    if (members.size() > 1 && known.insert(shape_of(members, cylinders, kind)).second)
      g.work += cube(static_cast<double>(members.size()) * g.within.count() * compression);
  return g;
}

}  // namespace

std::string shape_of(const std::vector<std::size_t>& members, const std::vector<Cylinder>& cylinders,
                     const std::vector<std::size_t>& kind) {
  std::string shape;
  const Eigen::Vector2d origin = cylinders[members.front()].centre;
  for (const std::size_t c : members) {
    const Eigen::Vector2d place = (cylinders[c].centre - origin) / cylinders[c].radius * 1e9;
    shape += fmt::format("{}@{},{};", kind[c], std::llround(place.x()), std::llround(place.y()));
  }
  return shape;
}

Grouping choose_grouping(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& kind,
                         const VerticalModes& modes, double threshold) {
  Grouping best = grouped(cylinders, kind, modes, threshold, 0);
  for (const double reach : distinct_gaps(cylinders, 8)) {
    Grouping g = grouped(cylinders, kind, modes, threshold, reach);
    if (g.work < best.work) best = std::move(g);
  }
  return best;
}

Groups::Groups(std::vector<Cylinder> cylinders, const std::vector<std::size_t>& kind,
               const std::vector<const Scatterer*>& scatterer, const VerticalModes& modes, const Grouping& grouping,
               double precision)
    : cylinders_(std::move(cylinders)),
      modes_(modes),
      members_(grouping.members),
      group_of_(cylinders_.size()),
      between_(grouping.between),
      index_(between_) {
  std::map<std::string, std::shared_ptr<const Compound>> known;
  for (std::size_t g = 0; g < members_.size(); ++g) {
    std::vector<Cylinder> own;
    std::vector<const Scatterer*> of_own;
    for (const std::size_t c : members_[g]) {
      own.push_back(cylinders_[c]);
      of_own.push_back(scatterer[c]);
      group_of_[c] = g;
    }
    auto& compound = known[shape_of(members_[g], cylinders_, kind)];
    const Channels& channels = own.size() == 1 ? between_ : grouping.within;
    if (!compound)
      compound = std::make_shared<Compound>(Array(own, of_own, modes_, channels, precision).compound(between_));
    compound_.push_back(compound);
  }
  for (const Cylinder& c : cylinders_) scale_.push_back(radial_scales(modes_, c.radius, between_));
  const std::size_t N = cylinders_.size();
  G_.resize(N * N);
  for (std::size_t to = 0; to < N; ++to)
    for (std::size_t from = 0; from < N; ++from)
      if (group_of_[to] != group_of_[from])
        G_[to * N + from] =
            translation(cylinders_[to], cylinders_[from], scale_[to], scale_[from], modes_, between_, 1e-2 * precision);
}

MatrixXcd Groups::apply(MatrixXcd Compound::*part, const MatrixXcd& x, Index rows, Index columns) const {
  MatrixXcd y = MatrixXcd::Zero(rows * static_cast<Index>(cylinders_.size()), x.cols());
  for (std::size_t g = 0; g < members_.size(); ++g) {
    const Index size = static_cast<Index>(members_[g].size());
    MatrixXcd of_group(columns * size, x.cols());
    for (Index i = 0; i < size; ++i)
      of_group.middleRows(i * columns, columns) =
          x.middleRows(static_cast<Index>(members_[g][static_cast<std::size_t>(i)]) * columns, columns);
    const MatrixXcd result = (*compound_[g]).*part * of_group;
    for (Index i = 0; i < size; ++i)
      y.middleRows(static_cast<Index>(members_[g][static_cast<std::size_t>(i)]) * rows, rows) =
          result.middleRows(i * rows, rows);
  }
  return y;
}

MatrixXcd Groups::translated(const MatrixXcd& b) const {
  MatrixXcd a = MatrixXcd::Zero(b.rows(), b.cols());
  const std::size_t N = cylinders_.size();
  for (std::size_t to = 0; to < N; ++to)
    for (std::size_t from = 0; from < N; ++from)
      for (std::size_t n = 0; n < G_[to * N + from].size(); ++n) {
        const int M = between_.order[n];
        a.middleRows(index_(to, static_cast<int>(n), -M), 2 * M + 1).noalias() +=
            G_[to * N + from][n] * b.middleRows(index_(from, static_cast<int>(n), -M), 2 * M + 1);
      }
  return a;
}

// a = plane waves + G b, b = T a + R v, loads = E a + L v with the matrices of the groups.
Response Groups::respond(const std::vector<double>& heading, const MatrixXd& motion) const {
  const Index waves = between_.count(), size = waves * static_cast<Index>(cylinders_.size());
  const Index headings = static_cast<Index>(heading.size());
  MatrixXcd moving = MatrixXcd::Zero(motion.rows(), headings + motion.cols());
  moving.rightCols(motion.cols()) = motion.cast<Complex>();
  const MatrixXcd own = apply(&Compound::R, moving, waves, 6);
  MatrixXcd a = translated(own);
  a.leftCols(headings) += plane_waves(heading);
  if (members_.size() > 1) {
    const MatrixXcd T = apply(&Compound::T, MatrixXcd::Identity(size, size), waves, waves);
    const MatrixXcd system = MatrixXcd::Identity(size, size) - translated(T);
    a = system.partialPivLu().solve(a).eval();
  }
  return {apply(&Compound::T, a, waves, waves) + own,
          apply(&Compound::E, a, 6, waves) + apply(&Compound::L, moving, 6, 6)};
}

// e^{−ikr cos(θ−β)} = Σ_m (−i)^m J_m(kr) e^{im(θ−β)}.
MatrixXcd Groups::plane_waves(const std::vector<double>& heading) const {
  MatrixXcd a =
      MatrixXcd::Zero(between_.count() * static_cast<Index>(cylinders_.size()), static_cast<Index>(heading.size()));
  const int M = between_.highest_order();
  for (std::size_t c = 0; c < cylinders_.size(); ++c)
    for (std::size_t w = 0; w < heading.size(); ++w) {
      const double beta = heading[w];
      const Eigen::Vector2d towards(std::cos(beta), std::sin(beta));
      const Complex phase = std::polar(1.0, -modes_.k * cylinders_[c].centre.dot(towards));
      for (int m = -M; m <= M; ++m) {
        const double sign = m < 0 && m % 2 != 0 ? -1 : 1;  // J_{−m} = (−1)^m J_m
        a(index_(c, 0, m), static_cast<Index>(w)) =
            phase * std::polar(1.0, -m * (beta + pi / 2)) * sign / scale_[c][0][static_cast<std::size_t>(std::abs(m))];
      }
    }
  return a;
}

// H⁽²⁾_m(kr) → i^m √(2/(πkr)) e^{−i(kr − π/4)}, and r is shorter by the way to the cylinder along θ.
MatrixXcd Groups::far_field(const MatrixXcd& sent_out, const std::vector<double>& angle) const {
  MatrixXcd f = MatrixXcd::Zero(static_cast<Index>(angle.size()), sent_out.cols());
  const int M = between_.highest_order();
  for (std::size_t t = 0; t < angle.size(); ++t) {
    const Eigen::Vector2d towards(std::cos(angle[t]), std::sin(angle[t]));
    for (std::size_t c = 0; c < cylinders_.size(); ++c) {
      const Complex phase = std::polar(1.0, modes_.k * cylinders_[c].centre.dot(towards));
      for (int m = -M; m <= M; ++m)
        f.row(static_cast<Index>(t)) += phase * std::polar(1.0, m * angle[t] + std::abs(m) * pi / 2) /
                                        scale_[c][0][static_cast<std::size_t>(std::abs(m))] *
                                        sent_out.row(index_(c, 0, m));
    }
  }
  return f;
}

}  // namespace hydro::cylinders
