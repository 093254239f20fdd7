#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "layouts.hpp"
#include "support/bottom_mounted_cylinders.hpp"

namespace hydro::cylinders::arrays_test {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

// Linton & Evans (1990): four cylinders at the corners of a square, a gap as wide as a diameter, waves along the
// diagonal.
TEST(Arrays, OfFourCylindersOnTheBottomAreThoseOfLintonAndEvans) {
  const double a = 1, h = 6, beta = pi / 4;
  std::vector<Eigen::Vector2d> centre;
  std::vector<CylinderBody> bodies;
  for (const double x : {-2.0, 2.0})
    for (const double y : {-2.0, 2.0}) {
      centre.emplace_back(x, y);
      bodies.push_back({"pile", {x, y, 0}, {}, {{{x, y}, a, {}}}});
    }
  std::vector<double> omega;
  for (const double ka : {0.3, 1.0, 1.66, 2.5}) omega.push_back(std::sqrt(9.81 * ka * std::tanh(ka * h)));
  const auto c =
      solve(bodies, tank(h), omega, {beta}, {.tolerance = 1e-6, .threads = 1, .doubled_frequencies = 0}).coefficients;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const double k = waves::wavenumber(omega[i], tank(h));
    const auto expected = froude_test::forces_on_bottom_mounted(centre, a, k, h, beta, 1000, 9.81);
    for (std::size_t b = 0; b < 4; ++b)
      for (const int mode : {0, 1}) {
        const Complex X = c.X[0](6 * static_cast<Eigen::Index>(b) + mode, static_cast<Eigen::Index>(i));
        EXPECT_LT(std::abs(X - expected[b](mode)), 1e-6 * expected[b].norm()) << "ω = " << omega[i] << ", pile " << b;
      }
  }
}

// What one cylinder sends to another falls as √(2/(πkR)); so does its effect on the forces.
TEST(Arrays, FarApartAreSingleCylindersWithThePhaseOfTheirPlace) {
  const double omega = 2.0, beta = 0.4, k = waves::wavenumber(omega, tank());
  const Options options{.tolerance = 1e-6, .threads = 1, .doubled_frequencies = 0};
  const auto alone = solve({single(1, 1)}, tank(), {omega}, {beta}, options).coefficients;
  for (const double R : {100.0, 10000.0}) {
    const auto pair = solve({single(1, 1), single(1, 1, R, 0)}, tank(), {omega}, {beta}, options).coefficients;
    const double bound = std::sqrt(2 / (pi * k * R));
    const Complex phase = std::polar(1.0, -k * R * std::cos(beta));
    for (const Eigen::Index mode : {0, 2, 4}) {
      const Complex X = alone.X[0](mode, 0);
      EXPECT_LT(std::abs(pair.X[0](mode, 0) - X), bound * std::abs(X)) << R;
      EXPECT_LT(std::abs(pair.X[0](6 + mode, 0) - phase * X), bound * std::abs(X)) << R;
      EXPECT_LT(std::abs(pair.A[0](mode, mode) - alone.A[0](mode, mode)), bound * alone.A[0](mode, mode)) << R;
    }
  }
}

// Close cylinders are grouped to save work; what is close is a matter of the other gaps, and must not show: the far
// pair seen as single cylinders far away, or as a group, is the same.
TEST(Arrays, GroupsOfCloseCylindersDoNotShowInTheResult) {
  const std::vector<CylinderBody> pairs{single(0.8, 1.1, 0, 0), single(0.8, 1.1, 3, 0), single(0.8, 1.1, 12, 0),
                                        single(0.8, 1.1, 15, 0)};
  const Options coarse{.tolerance = 1e-3, .threads = 1, .doubled_frequencies = 0};
  const Options fine{.tolerance = 1e-5, .threads = 1, .doubled_frequencies = 0};
  const auto grouped = solve(pairs, tank(6), {2.2}, {0.3}, coarse).coefficients;
  const auto finer = solve(pairs, tank(6), {2.2}, {0.3}, fine).coefficients;
  EXPECT_LT((grouped.A[0] - finer.A[0]).cwiseAbs().maxCoeff(), 1e-3 * finer.A[0].maxCoeff());
  const auto near_only = solve({pairs[0], pairs[1]}, tank(6), {2.2}, {0.3}, fine).coefficients;
  // The far pair matters to the near one by some √(2/(πkR)) = 0.37 of scattered waves, but matters.
  const double effect = (finer.A[0].topLeftCorner(12, 12) - near_only.A[0]).cwiseAbs().maxCoeff() / finer.A[0](0, 0);
  EXPECT_GT(effect, 1e-3);
  EXPECT_LT(effect, 0.4);
}

TEST(Arrays, OfNearlyTouchingCylindersKeepTheirTolerance) {
  const std::vector<CylinderBody> close{single(1, 1, 0, 0), single(1, 1, 2.4, 0)};
  const auto check =
      solve(close, tank(3), {1.0, 2.5}, {0.5}, {.tolerance = 1e-3, .threads = 1, .doubled_frequencies = 2}).check;
  EXPECT_LT(check.doubling, 1e-3);
}

/// Sixteen cylinders in close pairs, so that there are groups and something between them.
std::vector<CylinderBody> pairs() {
  std::vector<CylinderBody> bodies;
  for (int i = 0; i < 4; ++i)
    for (const double y : {0.0, 9.0})
      for (const double dx : {0.0, 2.5}) bodies.push_back(single(0.8, 1.1, 10.0 * i + dx, y + 0.3 * i));
  return bodies;
}

// Iteration stops far below the tolerance, and what is left out between pairs is the same: a tenth of it is generous.
TEST(Arrays, ByIterationAndByEliminationAgree) {
  for (const double tolerance : {1e-3, 1e-5}) {
    Options options{.tolerance = tolerance, .threads = 1, .doubled_frequencies = 0, .equations = Equations::direct};
    const auto direct = solve(pairs(), tank(6), {0.8, 2.2}, {0.3, 1.9}, options);
    options.equations = Equations::iterative;
    const auto iterated = solve(pairs(), tank(6), {0.8, 2.2}, {0.3, 1.9}, options);
    EXPECT_EQ(direct.check.steps, 0);
    EXPECT_GT(iterated.check.steps, 2);
    EXPECT_THAT(iterated.coefficients.notes, testing::Contains(testing::HasSubstr("by iteration")));
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::MatrixXd &A = direct.coefficients.A[i], &B = direct.coefficients.B[i];
      const Eigen::MatrixXcd& X = direct.coefficients.X[i];
      EXPECT_LT((iterated.coefficients.A[i] - A).cwiseAbs().maxCoeff(), 0.1 * tolerance * A.cwiseAbs().maxCoeff());
      EXPECT_LT((iterated.coefficients.B[i] - B).cwiseAbs().maxCoeff(), 0.1 * tolerance * B.cwiseAbs().maxCoeff());
      EXPECT_LT((iterated.coefficients.X[i] - X).cwiseAbs().maxCoeff(), 0.1 * tolerance * X.cwiseAbs().maxCoeff());
    }
  }
}

/// Modules of two unlike cylinders on a skew lattice with a hole, turned so that nothing lies along an axis.
std::vector<CylinderBody> lattice(double disorder) {
  std::vector<CylinderBody> bodies;
  const Eigen::Rotation2Dd turn(0.3);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if (i == 2 && j == 1) continue;
      const Eigen::Vector2d at = turn * Eigen::Vector2d(9.0 * i + 2.0 * j + (i + j == 3 ? disorder : 0), 8.0 * j);
      const Eigen::Vector2d other = at + turn * Eigen::Vector2d(3, 0.5);
      CylinderBody body{"module", {at.x(), at.y(), 0}, {}, {}};
      body.cylinders = {{at, 0.8, 1.1}, {other, 0.6, 0.9}};
      bodies.push_back(body);
    }
  return bodies;
}

// As ByIterationAndByEliminationAgree. With cylinders a hundredth of a metre out of place there is no lattice.
TEST(Arrays, OnALatticeKeepTheirTolerance) {
  constexpr double tolerance = 1e-4;
  Options options{.tolerance = tolerance, .threads = 1, .doubled_frequencies = 0, .equations = Equations::direct};
  const auto direct = solve(lattice(0), tank(6), {0.8, 2.2}, {0.3, 1.9}, options);
  options.equations = Equations::iterative;
  const auto passed = solve(lattice(0), tank(6), {0.8, 2.2}, {0.3, 1.9}, options);
  EXPECT_FALSE(direct.check.lattice);
  EXPECT_TRUE(passed.check.lattice);
  EXPECT_THAT(passed.coefficients.notes, testing::Contains(testing::HasSubstr("over a lattice")));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto differ = [](const auto& a, const auto& b) {
      return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
    };
    EXPECT_LT(differ(passed.coefficients.A[i], direct.coefficients.A[i]), 0.1 * tolerance);
    EXPECT_LT(differ(passed.coefficients.B[i], direct.coefficients.B[i]), 0.1 * tolerance);
    EXPECT_LT(differ(passed.coefficients.X[i], direct.coefficients.X[i]), 0.1 * tolerance);
  }
  EXPECT_FALSE(solve(lattice(0.01), tank(6), {0.8}, {0.3}, options).check.lattice);
}

// Elimination grows as the cube of the number of cylinders; so many are dearer by it, whatever the machine.
TEST(Arrays, OfHundredsOfCylindersAreSolvedByIterationUnlessAskedOtherwise) {
  std::vector<CylinderBody> farm;
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 14; ++j) farm.push_back(single(0.8, 1.1, 10.0 * i, 10.0 * j));
  CylinderBody raft{"raft", {0, 0, 0}, {}, {}};
  for (const CylinderBody& body : farm) raft.cylinders.push_back(body.cylinders.front());
  const Cost many = cost({raft}, tank(), {2.0}, {0}, {.tolerance = 1e-4, .threads = 1});
  const Cost asked =
      cost({raft}, tank(), {2.0}, {0}, {.tolerance = 1e-4, .threads = 1, .equations = Equations::direct});
  EXPECT_TRUE(many.iterative);
  EXPECT_FALSE(asked.iterative);
  EXPECT_LT(many.bytes, asked.bytes);
  EXPECT_LT(many.seconds, asked.seconds);
  EXPECT_FALSE(cost({single(1, 1), single(1, 1, 9, 0)}, tank(), {2.0}, {0}, {.threads = 1}).iterative);
}

TEST(Arrays, TellTheirCostBeforehand) {
  const Cost small = cost({pontoon(0)}, tank(), {1.0, 2.0}, {0}, {.threads = 1});
  const Cost large = cost({pontoon(-6.5), pontoon(6.5)}, tank(), {1.0, 2.0}, {0}, {.threads = 1});
  EXPECT_GT(small.unknowns, 12);
  EXPECT_GT(large.unknowns, small.unknowns);
  EXPECT_GT(large.bytes, small.bytes);
}

}  // namespace
}  // namespace hydro::cylinders::arrays_test
