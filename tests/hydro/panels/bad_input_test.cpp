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
              AllOf(HasSubstr("\"inner\" is inside \"outer\""), HasSubstr("move the bodies apart")));
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
