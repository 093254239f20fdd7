#include "dynamics/line/catenary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/catenary_mooring.hpp"
#include "hydro/base/error.hpp"
#include "laws/force_kind_laws.hpp"

namespace catenary_test {
namespace {

using namespace dynamics;

/// The chain of the OC3 spar: 77.7066 kg/m in air, 0.09 m thick, sea water.
const LineProperties oc3{.length = 902.2,
                         .weight = (77.7066 - 1025 * std::numbers::pi / 4 * 0.09 * 0.09) * 9.80665,
                         .axial_stiffness = 384.243e6,
                         .on_bed = true};

TEST(Catenary, HasTheTensionsOfTheOc3Spar) {
  const LineTension t = catenary(oc3, 853.87 - 5.2, 250);
  constexpr double rounding = 0.005e3 + 1;  // given to 0.01 kN
  EXPECT_NEAR(t.fairlead(), 911.09e3, rounding);
  EXPECT_NEAR(t.horizontal, 736.94e3, rounding);
  EXPECT_NEAR(t.vertical, 535.73e3, rounding);
  EXPECT_GT(t.resting, 0);
}

TEST(Catenary, PutsTheFairleadWhereItWasAsked) {
  for (const bool on_bed : {true, false})
    for (const double stiffness : {1e4, 1e6, 1e9, 1e12})
      for (const double x : {1.0, 20.0, 60.0, 80.0, 99.0, 101.0, 140.0})
        for (const double z : {0.0, 5.0, 40.0, 90.0}) {
          const LineProperties line{100, 700, stiffness, on_bed};
          const LineTension t = catenary(line, x, z);
          if (t.horizontal == 0) continue;  // slack on the bed: has a test of its own
          const Eigen::Vector2d span = catenary_span(line, t.horizontal, t.vertical);
          EXPECT_LT((span - Eigen::Vector2d(x, z)).norm(), 1e-8 + 4e-16 * t.fairlead() / line.weight)
              << x << ' ' << z << ' ' << stiffness << ' ' << on_bed;
        }
}

// Inextensible and level: sag and tension of the textbook's catenary, a = H/w, L = 2a sinh(x/2a).
TEST(Catenary, IsTheTextbooksWhereItDoesNotStretch) {
  const double a = 30, w = 50, x = 40, L = 2 * a * std::sinh(x / (2 * a));
  const LineTension t = catenary({L, w, 1e15, false}, x, 0);
  EXPECT_NEAR(t.horizontal, a * w, 1e-6 * a * w);
  EXPECT_NEAR(t.vertical, w * L / 2, 1e-6 * w * L);
  EXPECT_NEAR(t.fairlead(), w * a * std::cosh(x / (2 * a)), 1e-6 * w * L);
}

TEST(Catenary, ATightLineWithoutWeightIsASpring) {
  const LineTension t = catenary({100, 1e-4, 1e6, false}, 110, 0);
  EXPECT_NEAR(t.horizontal, 1e6 * 0.1, 1);  // the sag takes w²L³/24H² of the length
  EXPECT_NEAR(t.stiffness(0, 0), 1e6 / 100, 1);
}

TEST(Catenary, HangsStraightDownWhereThereIsLineToSpare) {
  const LineProperties line{100, 700, 1e9, true};
  const LineTension t = catenary(line, 30, 40);
  EXPECT_EQ(t.horizontal, 0);
  EXPECT_NEAR(t.vertical, 700 * 40, 1e-4 * 700 * 40);
  EXPECT_NEAR(t.resting, 60, 1e-3);
  // It tightens without a jump.
  EXPECT_LT(catenary(line, t.resting + 1e-3, 40).horizontal, 30);
}

TEST(Catenary, SaysWhatItCannotSolve) {
  EXPECT_THROW(catenary({100, 700, 1e9, true}, 30, -1), hydro::NumericsError);
  EXPECT_THROW(catenary({100, 700, 1e9, false}, 0, 10), hydro::NumericsError);
  EXPECT_THROW(catenary({100, 0, 1e9, false}, 10, 10), hydro::InputError);
}

TEST(ForceLaws, HoldForCatenariesThatRestHangAndLieSlack) {
  const auto bodies = support::two_bodies();
  const LineProperties resting{60, 700, 1e7, true}, free{34, 300, 1e6, false}, slack{200, 700, 1e7, true};
  laws::expect_force_laws(CatenaryMooringKind({{{0, {1, 0.5, -1}}, {{50, 10, -20}}, resting},
                                               {{1, {0, 0, -1}}, {{-20, 3, -15}}, free},
                                               {{1, {0.3, 0, 0}}, {{30, -40, -20}}, slack}}),
                          bodies);
}

TEST(ForceLaws, HoldForCatenariesFromTables) {
  const auto bodies = support::two_bodies();
  const LineProperties resting{60, 700, 1e7, true};
  const Reach all{1, 80, 0.01, 40};
  const auto table = std::make_shared<CatenaryTable>(resting, all, 1e-2);
  laws::expect_force_laws(CatenaryMooringKind({{{0, {1, 0.5, -1}}, {{50, 10, -20}}, resting, table}}), bodies);
}

// The promise is checked where the table was not made to look.
TEST(CatenaryTable, IsWithinItsToleranceOfTheCatenary) {
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const Reach reach{838.67, 858.67, 240, 260};
    const CatenaryTable table(oc3, reach, tolerance);
    const double largest = catenary(oc3, reach.x_high, reach.z_high).fairlead();
    double difference = 0;
    for (int i = 0; i <= 97; ++i)
      for (int k = 0; k <= 97; ++k) {
        const double x = reach.x_low + i * 20.0 / 97, z = reach.z_low + k * 20.0 / 97;
        const LineTension is = table.at(x, z), should = catenary(oc3, x, z);
        difference = std::max(difference, std::hypot(is.horizontal - should.horizontal, is.vertical - should.vertical));
        EXPECT_NEAR(is.anchor(), should.anchor(), 2 * tolerance * largest);
        EXPECT_NEAR(is.resting, should.resting, 2 * tolerance * largest / oc3.weight);
      }
    EXPECT_LE(table.error(), tolerance * largest);
    EXPECT_LE(difference, 1.5 * tolerance * largest) << "the worst points are those of a cubic, to first order";
    EXPECT_GT(difference, 0.2 * table.error()) << "and the error that it tells is not made up";
  }
}

// Cubic slopes are off by the third power of the cells, where the line rests everywhere: as it leaves the bed its pull
// has a bend of its second derivative.
TEST(CatenaryTable, HasAnErrorOfThirdOrder) {
  const Reach reach{790, 830, 240, 260};
  ASSERT_GT(catenary(oc3, reach.x_high, reach.z_high).resting, 0);
  const CatenaryTable rough(oc3, reach, 1e-3), fine(oc3, reach, 1e-5);
  ASSERT_GT(fine.cells(), rough.cells());
  EXPECT_NEAR(std::log(rough.error() / fine.error()) / std::log(double(fine.cells()) / rough.cells()), 3, 0.5);
}

TEST(CatenaryTable, RefusesWhatItCannotHold) {
  EXPECT_THROW(CatenaryTable(oc3, {850, 840, 240, 260}, 1e-3), hydro::InputError);
  EXPECT_THROW(CatenaryTable(oc3, {840, 850, 240, 260}, 0), hydro::InputError);
  EXPECT_THROW(CatenaryTable(oc3, {840, 850, -1, 260}, 1e-3), hydro::NumericsError) << "under the bed";
  EXPECT_THROW(CatenaryTable(oc3, {1, 900, 0, 300}, 1e-9), hydro::InputError) << "too fine";
}

TEST(CatenaryMooring, HasTheGradientOfItsTensions) {
  const auto bodies = support::two_bodies();
  const LineProperties resting{60, 700, 1e7, true}, free{34, 300, 1e6, false};
  for (const CatenaryMooring& m : {CatenaryMooring{{0, {1, 0.5, -1}}, {{50, 10, -20}}, resting},
                                   CatenaryMooring{{1, {0, 0, -1}}, {{-20, 3, -15}}, free}}) {
    const State at = rest_state(bodies);
    const TensionGradient gradient = tension_gradient(m, at);
    for (int mode = 0; mode < 6; ++mode) {
      const auto moved = [&](double by) {
        State s = at;
        Pose& pose = s.pose[static_cast<std::size_t>(m.fairlead.body)];
        if (mode < 3)
          pose.centre[mode] += by;
        else
          pose.attitude = Eigen::AngleAxisd(by, Eigen::Vector3d::Unit(mode - 3)) * pose.attitude;
        return tension_of(m, s);
      };
      constexpr double step = 1e-5;  // m, rad: differences of tensions of 1e4 N to 1e-4 N/m beside their curvature
      const LineTension more = moved(step), less = moved(-step);
      const double scale = gradient.fairlead.norm();
      EXPECT_NEAR(gradient.fairlead[mode], (more.fairlead() - less.fairlead()) / (2 * step), 1e-6 * scale) << mode;
      EXPECT_NEAR(gradient.anchor[mode], (more.anchor() - less.anchor()) / (2 * step), 1e-6 * scale) << mode;
    }
  }
}

}  // namespace
}  // namespace catenary_test
