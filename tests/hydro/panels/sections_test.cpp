// Loads on parts of hulls: that they add up to the whole's, and what still water does to a part of a box.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hulls.hpp"
#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "panels/one_frequency.hpp"

namespace hydro::panels::sections_test {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::Vector3d;
using hydrostatics::box_mesh;
using potential::Coefficients, potential::Matrix6;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(4)};
const std::vector<double> omega{1.3, 2.6}, heading{0.4};

/// A barge of 2 m by 1.2 m by 0.5 m, closed above the water, with these sections.
HullBody barge(const Vector3d& at, std::vector<HullSection> sections) {
  HullBody out = body("barge", box_mesh({-1, -0.6, -0.5}, {1, 0.6, 0.4}, {6, 4, 5}), at);
  out.centre_of_gravity = at + Vector3d(0, 0, -0.05);
  for (HullSection& section : sections) section.at += at;
  out.sections = std::move(sections);
  return out;
}

/// A plane, and the same seen from its other side.
std::vector<HullSection> both_sides(const Vector3d& at, const Vector3d& normal) {
  return {{"ahead", at, normal.normalized()}, {"behind", at, -normal.normalized()}};
}

/// Rows of part number `part` of one body.
template <class Matrix>
Matrix rows_of(const Matrix& all, Index part, Index columns) {
  return all.block(6 + 6 * part, 0, 6, columns);
}

void expect_sums(const Solution& s) {
  const Coefficients &whole = s.coefficients, &parts = *s.parts;
  constexpr double rounding = 1e-12;  // sums of some hundred panels in another order
  for (std::size_t w = 0; w < whole.omega.size(); ++w) {
    const MatrixXd A = rows_of(parts.A[w], 0, 6) + rows_of(parts.A[w], 1, 6),
                   B = rows_of(parts.B[w], 0, 6) + rows_of(parts.B[w], 1, 6);
    EXPECT_LT((A - whole.A[w]).norm(), rounding * whole.A[w].norm());
    EXPECT_LT((B - whole.B[w]).norm(), rounding * whole.A[w].norm() * whole.omega[w]);
  }
  for (std::size_t h = 0; h < whole.heading.size(); ++h) {
    const Eigen::MatrixXcd X = rows_of(parts.X[h], 0, whole.X[h].cols()) + rows_of(parts.X[h], 1, whole.X[h].cols());
    EXPECT_LT((X - whole.X[h]).norm(), rounding * whole.X[h].norm());
  }
  EXPECT_GT(rows_of(parts.A[0], 0, 6).norm(), 0.1 * whole.A[0].norm());  // both have their share
  EXPECT_GT(rows_of(parts.A[0], 1, 6).norm(), 0.1 * whole.A[0].norm());
}

// By quarters of a symmetric hull, and by all panels of one that stands beside the origin; planes that cut panels, one
// of them across all axes.
TEST(PanelSections, PartsAddUpToTheWhole) {
  for (const Vector3d& at : {Vector3d(0, 0, 0), Vector3d(2, 0.7, 0)})
    for (const Vector3d& normal : {Vector3d(1, 0, 0), Vector3d(1, 0.4, -0.3)})
      expect_sums(solve({barge(at, both_sides({0.17, 0.05, -0.2}, normal))}, tank, omega, heading));
}

// Two meshes have one ratio of extrapolation, so that sums stay sums.
TEST(PanelSections, PartsAddUpToTheWholeWhereTheyAreExtrapolated) {
  const Solution s = solve({barge({0, 0, 0}, both_sides({0.17, 0, 0}, {1, 0, 0}))}, tank, {1.3, 2.0, 2.6}, heading,
                           {.tolerance = 0.2});
  ASSERT_EQ(s.check.extrapolated_from.size(), 2U);
  expect_sums(s);
}

// The answers of the whole are those without sections, to the bit: nothing else is solved.
TEST(PanelSections, LeaveTheWholeAsItIs) {
  const Solution with = solve({barge({0, 0, 0}, both_sides({0.17, 0, 0}, {1, 0, 0}))}, tank, omega, heading),
                 without = solve({barge({0, 0, 0}, {})}, tank, omega, heading);
  EXPECT_FALSE(without.parts);
  EXPECT_EQ(with.coefficients.A, without.coefficients.A);
  EXPECT_EQ(with.coefficients.B, without.coefficients.B);
  EXPECT_EQ(with.coefficients.X, without.coefficients.X);
}

// At the end of a hull one part is all of it, the end wall too, and the other nothing.
TEST(PanelSections, AtTheEndAreTheWholeAndNothing) {
  const Solution s = solve({barge({0, 0, 0}, both_sides({-1, 0, 0}, {1, 0, 0}))}, tank, omega, heading);
  const Coefficients &whole = s.coefficients, &parts = *s.parts;
  for (std::size_t w = 0; w < omega.size(); ++w) {
    EXPECT_LT((rows_of(parts.A[w], 0, 6) - whole.A[w]).norm(), 1e-12 * whole.A[w].norm());  // rounding of sums
    EXPECT_TRUE(rows_of(parts.A[w], 1, 6).isZero(0));
  }
  EXPECT_TRUE(rows_of(parts.X[0], 1, 2).isZero(0));
}

// Two boxes, one with a section: rows are of its own panels, columns of the motions of both.
TEST(PanelSections, FeelTheMotionsOfOtherBodies) {
  HullBody other = body("other", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0.4}, {4, 3, 4}), {3, 0, 0});
  const Solution s = solve({other, barge({0, 0, 0}, both_sides({0.17, 0, 0}, {1, 0, 0}))}, tank, omega, heading);
  const MatrixXd &A = s.parts->A[0], sum = A.block(12, 0, 6, 12) + A.block(18, 0, 6, 12);
  EXPECT_LT((sum - s.coefficients.A[0].block(6, 0, 6, 12)).norm(), 1e-12 * s.coefficients.A[0].norm());  // rounding
  EXPECT_GT(A.block(12, 0, 6, 6).norm(), 0);
  EXPECT_EQ(s.parts->body[2].name, "barge.ahead");
}

// Still water on the half of a box ahead of x = 0, in body axes about the origin: the bottom loses ρg times its rise,
// and so does the end wall, over its depth T with the lever T/2.
TEST(PanelSections, LosePressureAsTheyRise) {
  constexpr double b = 1.2, T = 0.5, L = 1, rho_g = 9810;
  const Solution s = solve({barge({0, 0, 0}, both_sides({0, 0, 0}, {1, 0, 0}))}, tank, {1.3}, {});
  const MatrixXd C = rows_of(*s.parts->C, 0, 6);
  constexpr double rounding = 1e-9;  // of numbers of the order of 1e4
  EXPECT_NEAR(C(2, 2), rho_g * b * L, rounding * 1e4);
  EXPECT_NEAR(C(2, 4), -rho_g * b * L * L / 2, rounding * 1e4);
  EXPECT_NEAR(C(0, 2), -rho_g * b * T, rounding * 1e4);
  EXPECT_NEAR(C(0, 4), rho_g * b * T * L, rounding * 1e4);
  EXPECT_NEAR(C(3, 3), rho_g * L * (b * b * b / 12 - b * T * T / 2), rounding * 1e4);
  EXPECT_NEAR(C(4, 2), rho_g * b * (T * T / 2 - L * L / 2), rounding * 1e4);
}

// Both parts of what still water does to a turned body are the whole's matrix, once the weight turns with the body:
// (P12) has it along axes that stay.
TEST(PanelSections, RestoreWithTheWeightAsTheWholeDoes) {
  const HullBody hull = barge({0, 0, 0}, both_sides({0.17, 0.1, 0}, {1, 0.2, 0}));
  const Solution s = solve({hull}, tank, {1.3}, {});
  MatrixXd C = rows_of(*s.parts->C, 0, 6) + rows_of(*s.parts->C, 1, 6);
  const double weight = 9810 * 2 * 1.2 * 0.5;
  Matrix6 turned = Matrix6::Zero();
  turned(0, 4) = weight;
  turned(1, 3) = -weight;
  C -= potential::rigid_shift(*hull.centre_of_gravity).transpose() * turned;
  EXPECT_LT((C - *s.coefficients.C).norm(), 1e-12 * s.coefficients.C->norm());  // rounding
}

TEST(PanelSections, AreRefusedWhereTheyCannotBeTold) {
  const auto refused = [](const HullBody& hull, const Options& options, const char* why) {
    EXPECT_THAT(
        [&] {
          solve({hull}, tank, {1, 1.5, 2, 2.5, 3}, {0.0}, options);
        },
        testing::ThrowsMessage<InputError>(testing::HasSubstr(why)));
  };
  refused(barge({0, 0, 0}, {{"far", {1.2, 0, 0}, {1, 0, 0}}}), {}, "does not cut \"barge\"");
  refused(barge({0, 0, 0}, {{"long", {0, 0, 0}, {2, 0, 0}}}), {}, "normal of unit length");
  refused(barge({0, 0, 0}, {{"mid", {0, 0, 0}, {1, 0, 0}}}), {.interaction = Interaction::partial_waves},
          "partial waves");
  refused(barge({0, 0, 0}, {{"mid", {0, 0, 0}, {1, 0, 0}}}), {.frequency_tolerance = 0.01}, "frequency_tolerance");
  HullBody standing = body("pile", box_mesh({-1, -1, -4}, {1, 1, 0.4}, {4, 4, 6}), {0, 0, 0});
  standing.sections = {{"mid", {0, 0, 0}, {1, 0, 0}}};
  refused(standing, {}, "stands on the sea bed");
}

}  // namespace
}  // namespace hydro::panels::sections_test
