#include "network_shape.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

#include "dynamics/line/equilibrium.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::line {
namespace {

using Eigen::Vector3d;

/// Constant loads, and what floats that are wet in part lift when they are wet all.
Places loads_at_rest(const Line& line) {
  Places out = line.constant_load();
  for (int i = 0; i < line.nodes(); ++i) {
    const Bob& s = line.node(i).bob;
    if (s.diameter == 0 || !s.buoyancy || s.wet != Wet::below_surface) continue;
    const hydro::Water& water = line.description().water.field->water();
    out(2, i) += water.density * water.gravity * s.volume();
  }
  return out;
}

/// All that pulls, N; something for a network without weight, which has no scale of its own.
double whole_load(const Places& load) {
  const double sum = load.colwise().norm().sum();
  return sum > 0 ? sum : 1;
}

/// A network of springs without a length of their own, tension = density times length: linear.
class LooseNetwork {
 public:
  LooseNetwork(const Line& line, const State& places) : line_(line), places_(places), load_(loads_at_rest(line)) {}

  /// Where it hangs with one density for each segment, N/m. \throws hydro::InputError if nothing holds a part of it
  Places hang(const Eigen::VectorXd& density) {
    const int n = line_.nodes();
    entries_.clear();
    Eigen::MatrixX3d right = load_.transpose();
    for (int i = 0; i < n; ++i) {
      if (line_.moves(i)) continue;
      entries_.emplace_back(i, i, 1);
      if (line_.held(i) == nullptr) right.row(line_.same_as(i)) += right.row(i);
      right.row(i).setZero();
    }
    for (int j = 0; j < line_.segments(); ++j) {
      const int first = line_.same_as(line_.first(j)), second = line_.same_as(line_.first(j) + 1);
      join(first, second, density[j], right);
      join(second, first, density[j], right);
    }
    return solve(right);
  }

 private:
  void join(int here, int there, double density, Eigen::MatrixX3d& right) {
    if (!line_.moves(here)) return;
    entries_.emplace_back(here, here, density);
    if (line_.moves(there))
      entries_.emplace_back(here, there, -density);
    else
      right.row(here) += density * places_.position.col(there).transpose();
  }

  Places solve(const Eigen::MatrixX3d& right) {
    const int n = line_.nodes();
    matrix_.resize(n, n);
    matrix_.setFromTriplets(entries_.begin(), entries_.end());
    if (!ordered_) factors_.analyzePattern(matrix_);
    ordered_ = true;
    factors_.factorize(matrix_);
    hydro::require(factors_.info() == Eigen::Success && factors_.vectorD().minCoeff() > 0,
                   "nothing holds a part of the lines, so it has no shape to hang in");
    const Eigen::MatrixX3d x = factors_.solve(right);
    Places out(3, n);
    for (int i = 0; i < n; ++i)
      out.col(i) =
          line_.held(i) != nullptr ? Vector3d(places_.position.col(i)) : Vector3d(x.row(line_.same_as(i)).transpose());
    return out;
  }

  const Line& line_;
  const State& places_;
  Places load_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  bool ordered_ = false;
};

/// Every part of a network must be tied or joined to something that is held.
void require_held(const Line& line) {
  std::vector<bool> reached(static_cast<std::size_t>(line.nodes()), false);
  const auto at = [&](int i) { return reached[static_cast<std::size_t>(line.same_as(i))]; };
  for (const Held& h : line.description().held) at(h.node) = true;
  for (bool more = true; more;) {
    more = false;
    for (int j = 0; j < line.segments(); ++j) {
      const int first = line.first(j);
      if (at(first) == at(first + 1)) continue;
      at(first) = at(first + 1) = more = true;
    }
    // From the other end too: chains are then passed in one go, whichever end is held.
    for (int j = line.segments() - 1; j >= 0; --j)
      if (at(line.first(j) + 1)) at(line.first(j)) = true;
  }
  for (int i = 0; i < line.nodes(); ++i)
    hydro::require(at(i), "nothing holds a part of the lines, so it has no shape to hang in");
}

/// By how much a segment is longer than its tension makes it, relative.
double excess(const Line& line, const Places& x, const Eigen::VectorXd& tension, int j) {
  const Segment& s = line.segment(j);
  const double r = (x.col(line.first(j) + 1) - x.col(line.first(j))).norm();
  return r / (s.length * (1 + tension[j] / s.axial_stiffness)) - 1;
}

/// No segment stiffer than `stiffest`; none is a catenary or bends.
Line softened(const Line& line, double stiffest) {
  Description d = line.description();
  for (Segment& s : d.segments) {
    s.axial_stiffness = std::min(s.axial_stiffness, stiffest);
    s.catenary = false;
    s.axial_damping = s.bending_stiffness = 0;
  }
  for (Held& h : d.held) {
    h.clamp.setZero();
    h.path = nullptr;
  }
  return Line(std::move(d));
}

/// Of segments that are to be inextensible, by how much they are too long, m; and the one that is most, relative.
struct TooLong {
  double sum = 0, strain = 0;
  int segment = 0;
};
TooLong too_long(const Line& line, const Places& x) {
  TooLong out;
  for (int j = 0; j < line.segments(); ++j) {
    if (!line.segment(j).is_inextensible()) continue;
    const double length = line.segment(j).length,
                 more = (x.col(line.first(j) + 1) - x.col(line.first(j))).norm() - length;
    out.sum += std::max(more, 0.0);
    if (more / length > out.strain) {
      out.strain = more / length;
      out.segment = j;
    }
  }
  return out;
}

/// What is a hundred times stiffer is a hundredth as much too long, unless it does not reach.
void require_reach(const Line& line, const TooLong& soft, const TooLong& stiff) {
  if (stiff.strain < 0.5 * soft.strain || stiff.strain < 1e-6) return;
  int chain = 0;
  while (line.last_of_chain(chain) <= line.first(stiff.segment)) ++chain;
  throw hydro::InputError(
      fmt::format("lines that meet do not reach from one end to the other: together they are {:.4g} m too short, line "
                  "{} of them most",
                  stiff.sum, chain + 1),
      {}, "bring their ends together, lengthen them, or give them an axial stiffness");
}

/// What is taut comes slowly to its lengths by densities, and by Newton at once.
State tautened(const Line& line, const State& near, double load) {
  const State soft = equilibrium(softened(line, 1e4 * load), near);
  const State stiff = equilibrium(softened(line, 1e6 * load), soft);
  require_reach(line, too_long(line, soft.position), too_long(line, stiff.position));
  return stiff;
}

}  // namespace

// Densities are corrected until segments have their lengths: all of them pull all the time, whatever they are.
State network_shape(const Line& line, const State& places) {
  constexpr int most = 60;                     // each takes two thirds of the error, of what is not taut
  constexpr double near = 1e-6, least = 1e-9;  // of a length; of the whole load in a length
  require_held(line);
  LooseNetwork network(line, places);
  const double load = whole_load(loads_at_rest(line));
  State out{.time = places.time,
            .position = {},
            .velocity = Places::Zero(3, line.nodes()),
            .tension = Eigen::VectorXd(line.segments())};
  Eigen::VectorXd density(line.segments());  // T/r, N/m
  for (int j = 0; j < line.segments(); ++j) density[j] = load / line.segment(j).length;
  for (int i = 0; i < most; ++i) {
    out.position = network.hang(density);
    double worst = 0;
    for (int j = 0; j < line.segments(); ++j) {
      out.tension[j] = density[j] * (out.position.col(line.first(j) + 1) - out.position.col(line.first(j))).norm();
      const double more = excess(line, out.position, out.tension, j);
      density[j] = std::max(density[j] * (1 + more), least * load / line.segment(j).length);
      worst = std::max(worst, std::abs(more));
    }
    if (worst < near) return out;
  }
  return tautened(line, out, load);
}

}  // namespace dynamics::line
