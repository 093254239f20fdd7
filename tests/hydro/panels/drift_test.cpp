// Mean drift of single hulls: against cylinders, waves far away, and partial waves. (P41), (G23).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hulls.hpp"
#include "hydro/base/error.hpp"
#include "hydro/cylinders/field.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/field.hpp"

namespace hydro::panels::drift_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index, Eigen::RowVector3d, Eigen::Vector3d;
using hydrostatics::box_mesh, hydrostatics::cylinder_mesh;
using potential::BodyDrift, potential::FieldQuestion, potential::WaveField;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(3)};

/// In a wave of 2.3 rad/s that goes to 40 degrees, moving in all modes.
FieldQuestion asked(std::size_t bodies) {
  FieldQuestion out{2.3, 0.7, Eigen::VectorXcd::Zero(6 * static_cast<Index>(bodies)), Eigen::RowVector2d(5, 0)};
  for (Index i = 0; i < out.motion.size(); ++i)
    out.motion(i) = (i % 6 < 3 ? 0.4 : 0.1) * std::polar(1.0, 0.7 * static_cast<double>(i));
  out.drift = true;
  return out;
}

// Panels leave two percent of potentials, twice as much of their squares.
TEST(PanelDrift, OfDrumsBesideEachOtherIsThatOfExactOnes) {
  const Vector3d here(0.2, -0.1, 0), there(2.8, 0.9, 0);
  const WaveField panels = wave_field(
      {body("a", cylinder_mesh(0.8, 0.7, 2, 2, 16), here), body("b", cylinder_mesh(0.6, 0.5, 2, 2, 16), there)}, tank,
      asked(2), {.interaction = Interaction::panels});
  const WaveField exact = cylinders::wave_field(
      {{"a", here, {}, {{here.head<2>(), 0.8, 0.7}}}, {"b", there, {}, {{there.head<2>(), 0.6, 0.5}}}}, tank, asked(2));
  EXPECT_LT(difference(*panels.on_bodies, *exact.on_bodies), 0.04);
  EXPECT_LT(missed(*panels.on_bodies, mean_drift(panels.far, 2.3, tank)), 0.01);
  EXPECT_LT(panels.on_bodies->estimate, 0.1);
  for (Index b = 0; b < 2; ++b) EXPECT_GT(std::abs(exact.on_bodies->load(b, 2)), 1.0);  // N m: there is a moment
}

// Of one hull, over a bed and without: what momentum near it tells is what waves far away tell.
TEST(PanelDrift, OfABoxIsThatOfWavesFarAway) {
  const std::vector<HullBody> box{body("box", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {4, 3, 2}), {0, 0, 0})};
  for (const Water& water : {tank, Water{.density = 1000, .gravity = 9.81}}) {
    const WaveField f = wave_field(box, water, asked(1));
    // The same potentials; a step of differences and rules of quadrature leave 1e-3, the far field's panels the rest.
    EXPECT_LT(missed(*f.on_bodies, mean_drift(f.far, 2.3, water)), 0.01);
  }
}

// Boxes without symmetry about their places, so that a mirrored image or a turned axis would be seen.
TEST(PanelDrift, OfHullsThatStandApartIsTheSameByPartialWaves) {
  const std::vector<HullBody> both{body("near", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {4, 3, 2}), {-1.4, 0, 0}),
                                   body("far", box_mesh({-0.3, -0.5, -0.4}, {0.3, 0.5, 0}, {3, 4, 2}), {1.5, 0.6, 0})};
  const WaveField together = wave_field(both, tank, asked(2), {.interaction = Interaction::panels});
  const WaveField apart = wave_field(both, tank, asked(2), {.interaction = Interaction::partial_waves});
  EXPECT_LT(difference(*apart.on_bodies, *together.on_bodies), 0.02);  // twice the surface's 1 %
}

TEST(PanelDrift, OfForcesHasAnErrorThatMomentsDoNotSetTheSizeOf) {
  potential::BodyDrift coarse, fine;
  coarse.load = Eigen::RowVector3d(4, 0, 101);  // over 2 m the moment is worth 50 times the force
  fine.load = Eigen::RowVector3d(3, 0, 100);
  fine.length = 2;
  EXPECT_DOUBLE_EQ(potential::difference(coarse, fine), 1. / 3);
  coarse.load = Eigen::RowVector3d(3, 0, 0.3);  // a moment that symmetry takes away: over what the force does at 2 m
  fine.load = Eigen::RowVector3d(3, 0, 0);
  EXPECT_DOUBLE_EQ(potential::difference(coarse, fine), 0.05);
}

TEST(PanelDrift, IsNotToldWhereNoSurfacePartsTwoHulls) {
  const std::vector<HullBody> both{body("over", box_mesh({-0.6, -0.4, -0.2}, {0.6, 0.4, 0}, {6, 4, 2}), {0, 0, 0}),
                                   body("under", box_mesh({-0.6, -0.4, -1.5}, {0.6, 0.4, -1}, {4, 3, 2}), {0, 0, 0})};
  EXPECT_THAT([&] { wave_field(both, tank, asked(2)); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("overlap when seen from above")));
}

}  // namespace
}  // namespace hydro::panels::drift_test
