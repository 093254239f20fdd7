// The water's surface about hulls: against cylinders, and one way of solving against the other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hulls.hpp"
#include "hydro/base/error.hpp"
#include "hydro/cylinders/field.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/field.hpp"

namespace hydro::panels::field_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index, Eigen::Vector3d;
using hydrostatics::box_mesh, hydrostatics::cylinder_mesh;
using potential::FieldQuestion, potential::WaveField;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(3)};

/// Points about the origin, in a wave of 2.3 rad/s that goes to 40 degrees.
FieldQuestion about_origin(double radius, std::size_t bodies) {
  FieldQuestion out{2.3, 0.7, Eigen::VectorXcd::Zero(6 * static_cast<Index>(bodies)), Eigen::MatrixX2d(12, 2)};
  for (Index i = 0; i < 12; ++i)
    out.point.row(i) = radius * Eigen::RowVector2d(std::cos(0.5236 * static_cast<double>(i)),
                                                   std::sin(0.5236 * static_cast<double>(i)));
  return out;
}

double largest(const Eigen::VectorXcd& difference, const Eigen::VectorXcd& of) {
  return difference.cwiseAbs().maxCoeff() / of.cwiseAbs().maxCoeff();
}

// In surge, heave and pitch too, whose radiated waves have other phases. Panels leave
// a percent or so.
TEST(PanelField, OfACylinderIsThatOfTheExactOne) {
  const Vector3d at(0.2, -0.1, 0);
  FieldQuestion question = about_origin(2, 1);
  question.motion << 0.4, Complex(0, 0.2), Complex(-0.3, 0.5), 0.1, Complex(0, 0.3), 0;
  const WaveField panels = wave_field({body("drum", cylinder_mesh(0.8, 0.7, 4, 4, 24), at)}, tank, question);
  const WaveField exact = cylinders::wave_field({{"drum", at, {}, {{at.head<2>(), 0.8, 0.7}}}}, tank, question);
  EXPECT_LT(largest(panels.incident - exact.incident, exact.incident), 1e-12);
  EXPECT_LT(largest(panels.scattered - exact.scattered, exact.scattered), 0.03);
  EXPECT_LT(largest(panels.radiated - exact.radiated, exact.radiated), 0.03);
  const potential::MeanDrift by_panels = mean_drift(panels.far, question.omega, tank),
                             by_cylinder = mean_drift(exact.far, question.omega, tank);
  EXPECT_LT((by_panels.force - by_cylinder.force).norm(), 0.03 * by_cylinder.force.norm());
  EXPECT_NEAR(by_panels.taken, by_cylinder.taken, 0.03 * by_cylinder.scattered);
  EXPECT_GT(largest(exact.scattered, exact.incident), 0.1);  // it is no small part
  EXPECT_GT(largest(exact.radiated, exact.incident), 0.05);
}

TEST(PanelField, InDeepWaterIsThatOfTheExactCylinder) {
  const Water deep{.density = 1000, .gravity = 9.81};
  FieldQuestion question = about_origin(3, 1);
  question.motion(2) = 1;
  const WaveField panels = wave_field({body("drum", cylinder_mesh(0.8, 0.7, 4, 4, 24), {0, 0, 0})}, deep, question);
  const WaveField exact = cylinders::wave_field({{"drum", {0, 0, 0}, {}, {{{0, 0}, 0.8, 0.7}}}}, deep, question);
  EXPECT_LT(largest(panels.total() - exact.total(), exact.total()), 0.02);
}

// A box that has no symmetry about its place, so that a mirrored image or a turned axis would be seen.
TEST(PanelField, OfHullsThatStandApartIsTheSameByPartialWaves) {
  const std::vector<HullBody> both{body("near", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6, 4, 3}), {-1.4, 0, 0}),
                                   body("far", box_mesh({-0.3, -0.5, -0.4}, {0.3, 0.5, 0}, {4, 6, 3}), {1.5, 0.6, 0})};
  FieldQuestion question = about_origin(3, 2);
  question.motion(2) = 0.7;
  question.motion(6) = Complex(0.2, -0.5);
  const WaveField together = wave_field(both, tank, question, {.interaction = Interaction::panels});
  const WaveField apart = wave_field(both, tank, question, {.interaction = Interaction::partial_waves});
  // One integrates waves over panels, the other takes them at their centres.
  EXPECT_LT(largest(apart.total() - together.total(), together.total()), 0.01);
  EXPECT_LT(apart.estimate, 0.1);
  const potential::MeanDrift one = mean_drift(together.far, question.omega, tank),
                             each = mean_drift(apart.far, question.omega, tank);
  EXPECT_LT((one.force - each.force).norm(), 0.02 * one.force.norm());  // twice as much in squares
}

// Twice as many panels again are nearer than the estimate says.
TEST(PanelField, IsNearerToFinerPanelsThanItsEstimate) {
  const auto drum = [](int times) {
    return std::vector{body("drum", cylinder_mesh(0.8, 0.7, 3 * times, 3 * times, 16), {0, 0, 0})};
  };
  FieldQuestion question = about_origin(1.3, 1);
  question.motion(0) = 1;
  const WaveField coarse = wave_field(drum(1), tank, question), fine = wave_field(drum(3), tank, question);
  EXPECT_LT(largest(coarse.total() - fine.total(), fine.total()), coarse.estimate);
  EXPECT_LT(fine.estimate, coarse.estimate);
}

TEST(PanelField, TellsNothingInsideAWaterlineOrACircleOfPartialWaves) {
  const std::vector<HullBody> both{body("one", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6, 4, 3}), {0, 0, 0}),
                                   body("two", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6, 4, 3}), {4, 0, 0})};
  FieldQuestion question = about_origin(1, 2);
  question.point.resize(3, 2);
  question.point << 0.5, 0.3, 0.5, 0.5, 2, 0;  // in the box; beside it, in its circle of 0.72 m; between both
  EXPECT_THAT(wave_field(both, tank, question, {.interaction = Interaction::panels}).known,
              testing::ElementsAre(false, true, true));
  EXPECT_THAT(wave_field(both, tank, question, {.interaction = Interaction::partial_waves}).known,
              testing::ElementsAre(false, false, true));
}

// At a side Green's theorem gives half of what is there, at a corner another share: both sides are left out alike.
TEST(PanelField, TellsNothingOnAHullsSide) {
  FieldQuestion question = about_origin(1, 1);
  question.point.resize(6, 2);
  question.point << 0.6, 0.1, -0.6, 0.1, 0.1, 0.4, 0.1, -0.4, 0.6, 0.4, 0.6001, 0.1;
  EXPECT_THAT(
      wave_field({body("box", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6, 4, 3}), {0, 0, 0})}, tank, question)
          .known,
      testing::ElementsAre(false, false, false, false, false, true));
}

}  // namespace
}  // namespace hydro::panels::field_test
