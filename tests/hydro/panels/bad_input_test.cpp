// What cannot be solved is refused before anything is computed, with the number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"

namespace hydro::panels::bad_input_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const Water shallow{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(0.7)};
const Water deep{};

hydrostatics::Hull hemisphere(double radius, int rows, int columns) {
  return hydrostatics::Hull(hydrostatics::hemisphere_mesh(radius, rows, columns));
}

HullBody named(const std::string& name, hydrostatics::Hull hull) { return {name, {0, 0, 0}, {}, std::move(hull)}; }

std::string refusal(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega = {1.0},
                    const Options& options = {}) {
  try {
    solve(bodies, water, omega, {0}, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PanelInput, AHullBelowTheBedIsRefused) {
  EXPECT_THAT(refusal({named("buoy", hemisphere(1, 4, 8))}, shallow), AllOf(HasSubstr("\"buoy\""), HasSubstr("0.7 m")));
}

TEST(PanelInput, AHullInTheAirIsRefused) {
  hydrostatics::TriangleMesh mesh{.source = "high.stl", .vertices = {}, .triangles = {}};
  const auto low = hemisphere(1, 4, 8);
  for (const auto& v : low.vertices()) mesh.vertices.emplace_back(v.x(), v.y(), v.z() + 3);
  mesh.triangles = low.triangles();
  EXPECT_THAT(refusal({named("buoy", hydrostatics::Hull(mesh))}, deep),
              AllOf(HasSubstr("high.stl"), HasSubstr("under water")));
}

TEST(PanelInput, AnOpeningUnderWaterIsRefused) {
  hydrostatics::TriangleMesh mesh{.source = "cup.stl", .vertices = {}, .triangles = {}};
  const auto low = hemisphere(1, 4, 8);
  for (const auto& v : low.vertices()) mesh.vertices.emplace_back(v.x(), v.y(), v.z() - 0.5);
  mesh.triangles = low.triangles();
  EXPECT_THAT(refusal({named("cup", hydrostatics::Hull(mesh))}, deep),
              AllOf(HasSubstr("\"cup\""), HasSubstr("0.5 m under water")));
}

// Of waves shorter than twice the top row no panel has its centre in reach.
TEST(PanelInput, WavesFarShorterThanPanelsAreRefused) {
  for (const double omega : {8.0, 20.0, 60.0})
    EXPECT_THAT(refusal({named("buoy", hemisphere(1, 2, 8))}, deep, {omega}), HasSubstr("panels a wave length"))
        << omega;
}

TEST(PanelInput, AHullOnTheBedHasNoRestoringMatrixAndSaysSo) {
  auto mesh = hydrostatics::box_mesh({-1, -1, -0.7}, {1, 1, 0}, {6, 6, 4});
  HullBody box = named("box", hydrostatics::Hull(mesh));
  box.centre_of_gravity = Eigen::Vector3d(0, 0, -0.2);
  const auto c = solve({box}, shallow, {1.0}, {0}).coefficients;
  EXPECT_FALSE(c.C.has_value());
  EXPECT_THAT(c.notes, ::testing::Contains(HasSubstr("\"box\" stands on the sea bed")));
}

// Panels of a third of a metre over a gap of a millimetre.
TEST(PanelInput, WhatItsOwnLawsRefuteIsRefused) {
  const auto mesh = hydrostatics::box_mesh({-1, -1, -0.699}, {1, 1, 0}, {6, 6, 3});
  EXPECT_THAT(refusal({named("box", hydrostatics::Hull(mesh))}, shallow, {1.0, 2.0}),
              AllOf(HasSubstr("no answer"), HasSubstr("Haskind")));
}

TEST(PanelInput, HullsInsideOneAnotherAreRefused) {
  EXPECT_THAT(refusal({named("outer", hemisphere(2, 4, 8)), named("inner", hemisphere(1, 4, 8))}, deep),
              AllOf(HasSubstr("\"inner\" is inside \"outer\""), HasSubstr("a union of solids")));
}

TEST(PanelInput, FrequenciesAndOptionsOutOfRangeAreRefused) {
  const std::vector<HullBody> buoy{named("buoy", hemisphere(1, 4, 8))};
  EXPECT_THAT(refusal(buoy, deep, {}), HasSubstr("no frequency"));
  EXPECT_THAT(refusal(buoy, deep, {2.0, 1.0}), HasSubstr("must increase"));
  EXPECT_THAT(refusal(buoy, deep, {0.0, 1.0}), HasSubstr("must be positive"));
  EXPECT_THAT(refusal(buoy, deep, {1.0}, {.tolerance = 0.0}), HasSubstr("between 0 and 1"));
  EXPECT_THAT(refusal(buoy, deep, {1.0, 2.0}, {.frequency_tolerance = 1e-2}), HasSubstr("5 at least"));
  EXPECT_THAT(refusal(buoy, deep, {1.0}, {.frequency_tolerance = 0.5}), HasSubstr("between 1e-6 and 0.1"));
  EXPECT_THAT(refusal({}, deep), HasSubstr("no body"));
}

TEST(PanelInput, AnEstimateAboveTheToleranceIsRefusedWithBoth) {
  EXPECT_THAT(refusal({named("buoy", hemisphere(1, 2, 16))}, deep, {1.0}, {.tolerance = 1e-5}),
              AllOf(HasSubstr("estimated at"), HasSubstr("1e-05"), HasSubstr("the finest of three meshes"),
                    HasSubstr("make the mesh finer")));
}

TEST(PanelInput, PanelsThatAreLongBesideTheShortestWaveAreRefused) {
  EXPECT_THAT(refusal({named("buoy", hemisphere(1, 6, 24))}, deep, {1.0, 6.5}),
              AllOf(HasSubstr("6.5 rad/s"), HasSubstr("fewer than 5 panels a wave length"),
                    HasSubstr("finer at the waterline")));
  EXPECT_EQ(refusal({named("buoy", hemisphere(1, 6, 24))}, deep, {1.0, 5.0}), "accepted");
}

/// Wholly under water; its top has panels of 2.5 m.
HullBody box_under(double depth) {
  return named("box", hydrostatics::Hull(hydrostatics::box_mesh({-10, -5, -4.5}, {10, 5, -depth}, {8, 4, 2},
                                                                hydrostatics::Spacing::equal)));
}

// Waves of 1.5 rad/s are 27 m long in deep water and 9.1 m over half a metre; of 0.6 rad/s they are 23 m there.
TEST(PanelInput, PanelsThatAreLongBesideWavesOverAShallowTopAreRefused) {
  EXPECT_THAT(refusal({box_under(0.5)}, deep, {0.6, 1.5}),
              AllOf(HasSubstr("face up 0.5 m below the surface"), HasSubstr("9.1 m long there")));
  EXPECT_EQ(refusal({box_under(0.5)}, deep, {0.6}), "accepted");
  EXPECT_EQ(refusal({box_under(3)}, deep, {0.6, 1.5}), "accepted");
}

TEST(PanelInput, ATopAMillimetreUnderWaterIsRefusedWithAToleranceToo) {
  for (const Options& options : {Options{}, Options{.tolerance = 0.2}})
    EXPECT_THAT(refusal({box_under(1e-3)}, deep, {0.3, 1.2}, options),
                AllOf(HasSubstr("face up 0.001 m below the surface"), HasSubstr("(z = 0)")));
}

// The slope of a cone that stands on its base, from the surface to 4 m: by the mean of the roots of both depths.
TEST(PanelInput, ASlopeThatMeetsTheSurfaceIsHeldAgainstTheWavesAlongIt) {
  const hydrostatics::TriangleMesh mesh{
      .source = "pyramid",
      .vertices = {{-8, -8, -4}, {8, -8, -4}, {8, 8, -4}, {-8, 8, -4}, {0, 0, 0.5}},
      .triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  EXPECT_THAT(refusal({named("pyramid", hydrostatics::Hull(mesh))}, deep, {0.3}),
              HasSubstr("face up 1 m below the surface"));
}

// 20 m × 10 m × 4 m: 1e-6 of its diagonal is 23 µm.
TEST(PanelInput, ADeckARoundingErrorUnderTheSurfaceIsInItForRestoringAsForWaves) {
  const auto solved = [](double depth) {
    HullBody body = box_under(depth);
    body.centre_of_gravity = Eigen::Vector3d(0, 0, -2);
    return solve({body}, deep, {0.6}, {0}).coefficients;
  };
  const auto at = solved(0);
  for (const double depth : {1e-9, 1e-7, 1e-5}) {
    const auto below = solved(depth);
    EXPECT_NEAR((*below.C)(2, 2), 200 * at.water.density * at.water.gravity, 1e-6 * (*at.C)(2, 2)) << depth;
    // 1e-5 m of 4 m of side; no more than rounding moves panels.
    EXPECT_NEAR(below.A[0](2, 2), at.A[0](2, 2), 1e-4 * at.A[0](2, 2)) << depth;
  }
}

TEST(PanelInput, TheCostIsToldBeforeAnythingIsSolved) {
  const Cost c = cost({named("buoy", hemisphere(1, 6, 24))}, deep, {1.0, 2.0}, {0}, {.refined_frequencies = 1});
  EXPECT_EQ(c.panels, 144);
  EXPECT_EQ(c.systems, 4);
  EXPECT_GE(c.unknowns, 36);
  EXPECT_GE(c.refined_unknowns, 144);
  EXPECT_GT(c.bytes, 0);
  EXPECT_GT(c.seconds, 0);
}

}  // namespace
}  // namespace hydro::panels::bad_input_test
