#include "network_shape.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

#include "dynamics/line/equilibrium.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::line {
namespace {

using Eigen::Vector3d;

/// All that pulls at a network at rest, N; something for one without weight, which has no scale of its own.
double whole_load(const Line& line) {
  const double sum = line.constant_load().colwise().norm().sum();
  return sum > 0 ? sum : 1;
}

/// Segments as springs without a length of their own, as stiff as the whole load stretches to theirs: linear.
State loose_shape(const Line& line, const State& places) {
  const int n = line.nodes();
  const double load = whole_load(line);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = line.constant_load().transpose();
  for (int i = 0; i < n; ++i) {
    if (line.moves(i)) continue;
    entries.emplace_back(i, i, 1);
    if (line.held(i) == nullptr) right.row(line.same_as(i)) += right.row(i);
    right.row(i).setZero();
  }
  for (int j = 0; j < line.segments(); ++j) {
    const double k = load / line.segment(j).length;
    const int ends[2] = {line.same_as(line.first(j)), line.same_as(line.first(j) + 1)};
    for (int e = 0; e < 2; ++e) {
      const int here = ends[e], there = ends[1 - e];
      if (!line.moves(here)) continue;
      entries.emplace_back(here, here, k);
      if (line.moves(there))
        entries.emplace_back(here, there, -k);
      else
        right.row(here) += k * places.position.col(there).transpose();
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  const double scale = matrix.diagonal().maxCoeff();
  hydro::require(factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 1e-13 * scale,
                 "nothing holds a part of the lines, so it has no shape to hang in");
  const Eigen::MatrixX3d x = factors.solve(right);
  State out{.time = places.time,
            .position = Places(3, n),
            .velocity = Places::Zero(3, n),
            .tension = Eigen::VectorXd(line.segments())};
  for (int i = 0; i < n; ++i)
    out.position.col(i) =
        line.held(i) != nullptr ? Vector3d(places.position.col(i)) : Vector3d(x.row(line.same_as(i)).transpose());
  for (int j = 0; j < line.segments(); ++j)
    out.tension[j] =
        load / line.segment(j).length * (out.position.col(line.first(j) + 1) - out.position.col(line.first(j))).norm();
  return out;
}

/// No segment stiffer than `stiffest`, none pressed, none bends.
Line softened(const Line& line, double stiffest) {
  Description d = line.description();
  for (Segment& s : d.segments) {
    s.axial_stiffness = std::min(s.axial_stiffness, stiffest);
    s.pulls_only = true;
    s.sags = false;
    s.axial_damping = s.bending_stiffness = 0;
  }
  for (Held& h : d.held) {
    h.clamp.setZero();
    h.path = nullptr;
  }
  return Line(std::move(d));
}

struct Stretch {
  double strain = 0;
  int segment = 0;
};

/// The largest of segments that are to keep their lengths.
Stretch largest_stretch(const Line& line, const State& state) {
  Stretch out;
  for (int j = 0; j < line.segments(); ++j) {
    if (!line.segment(j).keeps_length()) continue;
    const double r = (state.position.col(line.first(j) + 1) - state.position.col(line.first(j))).norm();
    const double strain = r / line.segment(j).length - 1;
    if (strain > out.strain) out = {strain, j};
  }
  return out;
}

/// What does not grow shorter as it grows stiffer does not reach.
void require_reach(const Line& line, const State& state, double softer) {
  const Stretch now = largest_stretch(line, state);
  if (now.strain < 0.5 * softer || now.strain < 1e-5) return;  // a hundred times stiffer: else a hundredth
  double missing = 0;
  int chain = 0;
  for (int j = 0; j < line.segments(); ++j)
    if (line.segment(j).keeps_length())
      missing += std::max(0.0, (state.position.col(line.first(j) + 1) - state.position.col(line.first(j))).norm() -
                                   line.segment(j).length);
  while (line.last_of_chain(chain) <= line.first(now.segment)) ++chain;
  throw hydro::InputError(
      fmt::format("lines that meet do not reach from one end to the other: together they are {:.4g} m too short, line "
                  "{} of them most",
                  missing, chain + 1),
      {}, "bring their ends together, lengthen them, or give them an axial stiffness");
}

}  // namespace

State network_shape(const Line& line, const State& places) {
  const double load = whole_load(line);
  double hardest = 0, softer = 0;
  for (int j = 0; j < line.segments(); ++j) hardest = std::max(hardest, line.segment(j).axial_stiffness);
  State state = loose_shape(line, places);
  for (const double factor : {1.0, 1e2, 1e4, 1e6}) {
    const Line soft = softened(line, factor * load);
    state = equilibrium(soft, state);
    if (factor == 1e6) require_reach(line, state, softer);
    softer = largest_stretch(line, state).strain;
    if (factor * load >= hardest) break;
  }
  return state;
}

}  // namespace dynamics::line
