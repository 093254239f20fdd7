// Motions that are images of others by mirrors and quarter turns of the arrangement, against solutions of their own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "cylinders/symmetry.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "layouts.hpp"

namespace hydro::cylinders::symmetry_test {
namespace {

using Eigen::Index, Eigen::Matrix2d, Eigen::MatrixXd, Eigen::Vector3d;
using potential::Coefficients;

/// Rafts of two cylinders each, along x: mirrored in x and y, but not turned into themselves.
std::vector<CylinderBody> rafts(int along, int across) {
  std::vector<CylinderBody> out;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const double x = 5 + 6.0 * i, y = -3 + 6.0 * j;
      out.push_back({"raft", {x, y, 0.2}, Vector3d(x, y, -0.5), {{{x - 1.5, y}, 0.6, 0.9}, {{x + 1.5, y}, 0.6, 0.9}}});
    }
  return out;
}

std::vector<CylinderBody> buoys(int along, int across) {
  std::vector<CylinderBody> out;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) out.push_back(single(0.8, 1.1, 4.0 * i, 1 + 4.0 * j));
  return out;
}

template <class Body>
SolvedMotions solved_of(const std::vector<Body>& bodies) {
  std::vector<Cylinder> all;
  for (const auto& b : bodies) all.insert(all.end(), b.cylinders.begin(), b.cylinders.end());
  MatrixXd motion = MatrixXd::Zero(6 * static_cast<Index>(all.size()), 6 * static_cast<Index>(bodies.size()));
  Index row = 0, column = 0;
  for (const auto& b : bodies) {
    for (const auto& c : b.cylinders) {
      motion.block<6, 6>(row, column) =
          potential::rigid_shift(Vector3d(c.centre.x(), c.centre.y(), 0) - b.reference_point);
      row += 6;
    }
    column += 6;
  }
  return {all, std::vector<std::size_t>(all.size()), motion, [](std::size_t, const Matrix2d&) { return true; }};
}

TEST(SolvedMotions, AreThoseOfOneBodyOfEachOrbit) {
  EXPECT_EQ(solved_of(buoys(3, 3)).columns().size(), 6u * 3);  // corner, side, middle: all eight
  EXPECT_EQ(solved_of(buoys(3, 4)).columns().size(), 6u * 4);  // two mirrors alone
  EXPECT_EQ(solved_of(rafts(3, 3)).columns().size(), 6u * 4);  // no quarter turn of a raft
  EXPECT_EQ(solved_of(rafts(2, 2)).columns().size(), 6u * 4);  // so few are solved side by side
  auto other_point = buoys(3, 3);
  other_point[3].reference_point += Vector3d(0.1, 0.2, 0);
  EXPECT_EQ(solved_of(other_point).columns().size(), 6u * 9) << "its modes are not those of the others";
  auto moved = buoys(3, 3);
  moved[8].cylinders.front().centre.x() += 0.1;
  EXPECT_EQ(solved_of(moved).columns().size(), 6u * 9);
}

/// The largest differences, over the sizes of the two modes.
struct Differences {
  double A = 0, B = 0, A_inf = 0, X = 0;
};
Differences differences(const Coefficients& c, const Coefficients& of) {
  const Eigen::VectorXd s = of.A.front().diagonal().cwiseAbs().cwiseMax(1e-3).cwiseSqrt();
  const auto largest = [&](const MatrixXd& a, const MatrixXd& b) {
    return (s.cwiseInverse().asDiagonal() * (a - b) * s.cwiseInverse().asDiagonal()).cwiseAbs().maxCoeff();
  };
  return {largest(c.A.front(), of.A.front()), largest(c.B.front(), of.B.front()), largest(*c.A_inf, *of.A_inf),
          (s.cwiseInverse().asDiagonal() * (c.X.front() - of.X.front())).cwiseAbs().maxCoeff()};
}

/// With the reference point of one body moved no symmetry is left; then moved back.
template <class Bodies, class Solve>
Coefficients without_symmetry(Bodies bodies, const Solve& solve) {
  std::vector<Vector3d> to, from;
  for (const auto& b : bodies) to.push_back(b.reference_point);
  bodies[1].reference_point += Vector3d(0.3, 0.1, 0.2);
  for (const auto& b : bodies) from.push_back(b.reference_point);
  return potential::about(solve(bodies).coefficients, from, to);
}

// Truncation is the same in both; what is left is rounding of equations that are solved directly.
TEST(SolvedMotions, OfCylindersTellAllOthers) {
  const auto solution = [](const std::vector<CylinderBody>& bodies) {
    return solve(bodies, tank(6), {2.3}, {0.3},
                 {.tolerance = 1e-3, .threads = 1, .doubled_frequencies = 0, .equations = Equations::direct});
  };
  for (const auto& bodies : {buoys(3, 3), rafts(3, 3), buoys(5, 2)}) {
    const Solution found = solution(bodies);
    const Differences off = differences(found.coefficients, without_symmetry(bodies, solution));
    for (const double one : {off.A, off.B, off.A_inf, off.X}) EXPECT_LT(one, 1e-9);
    EXPECT_LT(found.check.energy, 1e-3) << "waves far away, turned";
    EXPECT_LT(found.check.haskind, 1e-3) << "and those against the waves";
  }
}

TEST(SolvedMotions, OfHullsTellAllOthers) {
  std::vector<panels::HullBody> bodies;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vector3d at(4.0 * i, 5.0 * j, 0);
      auto mesh = hydrostatics::box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {4, 4, 2});
      for (Vector3d& v : mesh.vertices) v += at;
      bodies.push_back({"box", at, at + Vector3d(0, 0, -0.2), hydrostatics::Hull(std::move(mesh))});
    }
  const auto solution = [](const std::vector<panels::HullBody>& all) {
    return panels::solve(all, tank(3), {2.3}, {0.3}, {.interaction = panels::Interaction::partial_waves, .threads = 1});
  };
  const panels::Solution found = solution(bodies);
  const Differences off = differences(found.coefficients, without_symmetry(bodies, solution));
  EXPECT_LT(off.A, 1e-9);
  EXPECT_LT(off.X, 1e-9);
  EXPECT_LT(off.A_inf, 1e-6) << "more motions are iterated, to a hundredth of the threshold of 1e-3 and less";
  EXPECT_LT(off.B, found.check.passivity) << "negative damping is taken away in modes about the points of reference";
}

}  // namespace
}  // namespace hydro::cylinders::symmetry_test
