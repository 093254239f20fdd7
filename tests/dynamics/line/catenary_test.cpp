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
  laws::expect_force_laws(CatenaryMooringKind({{0, {1, 0.5, -1}, {50, 10, -20}, resting},
                                               {1, {0, 0, -1}, {-20, 3, -15}, free},
                                               {1, {0.3, 0, 0}, {30, -40, -20}, slack}}),
                          bodies);
}

}  // namespace
}  // namespace catenary_test
