// Laws that any solution must obey, and that what saves work does not change it.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"
#include "hydro/potential/operations/operations.hpp"

namespace hydro::panels::laws_test {
namespace {

using Eigen::Vector3d;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(4)};

/// A box closed above the water.
HullBody box(const Vector3d& low, const Vector3d& high, int cuts) {
  const Vector3d middle = (low + high) / 2;
  return {"box",
          {middle.x(), middle.y(), 0},
          middle,
          hydrostatics::Hull(hydrostatics::box_mesh(low, high, {cuts, cuts, cuts}, hydrostatics::Spacing::equal))};
}

TEST(PanelLaws, PlanesOfSymmetryChangeNothing) {
  const HullBody whole = box({-1, -0.6, -0.5}, {1, 0.6, 0.4}, 6), moved = box({1, 0.4, -0.5}, {3, 1.6, 0.4}, 6);
  const std::vector<double> omega{1.3, 3.0};
  const Options plain{.lid = false};  // squares of the lid stand in the common axes
  // 1e-6: rounding decides which rule a pair at the border of two takes.
  const auto a = solve({whole}, tank, omega, {0.5}, plain), b = solve({moved}, tank, omega, {0.5}, plain);
  EXPECT_EQ(a.check.planes_of_symmetry, 2);
  EXPECT_EQ(b.check.planes_of_symmetry, 0);
  EXPECT_EQ(a.check.panels, b.check.panels);
  for (std::size_t w = 0; w < omega.size(); ++w) {
    const double size = a.coefficients.A[w].cwiseAbs().maxCoeff();
    EXPECT_LT((a.coefficients.A[w] - b.coefficients.A[w]).cwiseAbs().maxCoeff(), 1e-6 * size);
    EXPECT_LT((a.coefficients.B[w] - b.coefficients.B[w]).cwiseAbs().maxCoeff(), 1e-6 * size * omega[w]);
    const double k = omega[w] * omega[w] / 9.81;  // only the modulus: the phase is (P5)
    EXPECT_LT((a.coefficients.X[0].col(static_cast<Eigen::Index>(w)).cwiseAbs() -
               b.coefficients.X[0].col(static_cast<Eigen::Index>(w)).cwiseAbs())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6 * size * 9.81 * (1 + k));
  }
}

TEST(PanelLaws, EnergyAndHaskindAndReciprocityHoldToThePanelsError) {
  // The order of the error is that of the coefficients themselves: halved with the panels' side.
  SelfCheck before{};
  for (const int cuts : {5, 10}) {
    const SelfCheck now = solve({box({-1, -0.6, -0.5}, {1, 0.6, 0.4}, cuts)}, tank, {1.3, 3.0}, {0.5}).check;
    EXPECT_LT(now.energy, 0.5 / cuts);
    EXPECT_LT(now.haskind, 0.5 / cuts);
    EXPECT_LT(now.reciprocity, 0.2 / cuts);
    if (cuts == 10) {
      EXPECT_LT(now.energy, 0.6 * before.energy);
      EXPECT_LT(now.haskind, 0.6 * before.haskind);
    }
    before = now;
  }
}

TEST(PanelLaws, TheResultDoesNotDependOnThreads) {
  const HullBody hull = box({-1, -0.6, -0.5}, {1, 0.6, 0.4}, 4);
  const auto one = solve({hull}, tank, {1, 2, 3}, {0}, {.threads = 1}),
             three = solve({hull}, tank, {1, 2, 3}, {0}, {.threads = 3});
  for (std::size_t w = 0; w < 3; ++w) EXPECT_EQ(one.coefficients.A[w], three.coefficients.A[w]);
  EXPECT_EQ(one.coefficients.X[0], three.coefficients.X[0]);
}

TEST(PanelLaws, TheEstimateIsAboveTheErrorAgainstPanelsOfAThirdOfTheSide) {
  const std::vector<double> omega{1.0, 2.0, 3.0};
  const auto coarse = solve({box({-1, -0.6, -0.5}, {1, 0.6, 0.4}, 3)}, tank, omega, {0}, {.refined_frequencies = 3});
  const auto fine = solve({box({-1, -0.6, -0.5}, {1, 0.6, 0.4}, 12)}, tank, omega, {0});
  for (const Eigen::Index i : {0, 2, 4}) {
    double largest = 0, size = 0;
    for (std::size_t w = 0; w < omega.size(); ++w) {
      largest = std::max(largest, std::abs(coarse.coefficients.A[w](i, i) - fine.coefficients.A[w](i, i)));
      size = std::max(size, fine.coefficients.A[w](i, i));
    }
    EXPECT_LT(largest / size, coarse.check.estimate) << i;
  }
  EXPECT_LT(coarse.check.estimate, 0.5);
}

// Of two boxes with a gap between them, whose water resonates; with panels of one size, and extrapolated.
TEST(PanelLaws, AtChosenFrequenciesMeetTheToleranceBetweenThem) {
  const std::vector<HullBody> boxes{box({-1.2, -0.6, -0.5}, {-0.2, 0.6, 0.4}, 4),
                                    box({0.2, -0.6, -0.5}, {1.2, 0.6, 0.4}, 4)};
  const std::vector<double> first{1.5, 2.2, 3.0, 3.8, 4.4},
      unseen{1.71, 2.03, 2.61, 3.13, 3.37, 3.61, 3.93, 4.19, 4.31};
  for (const auto tolerance : {std::optional<double>{}, std::optional<double>{0.1}}) {
    Options options{.tolerance = tolerance, .frequency_tolerance = 1e-2};
    const Solution chosen = solve(boxes, tank, first, {0.5}, options);
    const double unforeseen = chosen.check.unseen;
    EXPECT_LE(unforeseen, 1e-2);
    EXPECT_LE(chosen.check.solved_omega.size(), 60u);
    options.frequency_tolerance.reset();
    const Solution truth = solve(boxes, tank, unseen, {0.5}, options);
    const potential::FrequencyTable read(chosen.coefficients, {boxes[0].reference_point, boxes[1].reference_point});
    potential::Coefficients there = truth.coefficients;
    for (std::size_t w = 0; w < unseen.size(); ++w) {
      there.A[w] = read.added_mass(unseen[w]);
      there.B[w] = read.damping(unseen[w]);
      there.X[0].col(static_cast<Eigen::Index>(w)) = read.excitation(unseen[w], 0.5);
    }
    // Both tables are extrapolated from frequencies of their own: each may be off by its estimate.
    const double panels = tolerance ? chosen.check.estimate + truth.check.estimate : 0;
    EXPECT_LE(difference(there, truth.coefficients, truth.check.length), 1e-2 + panels);
  }
}

}  // namespace
}  // namespace hydro::panels::laws_test
