// Cylinders whose tops are under water: over a gap, on the sea bed, alone and among others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "layouts.hpp"
#include "support/plain_submerged.hpp"

namespace hydro::cylinders::submerged_test {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Options exact{.tolerance = 1e-8, .threads = 1, .doubled_frequencies = 1};

CylinderBody submerged(double radius, double top, std::optional<double> draught, double x = 0, double y = 0) {
  return {"disc", {x, y, 0}, {}, {{{x, y}, radius, draught, top}}};
}

/// A module of unlike kinds: one that pierces the surface, a disc under water, and a step of the sea bed.
std::vector<CylinderBody> mixed() {
  CylinderBody raft{"raft", {0.5, -0.3, -1}, {}, {}};
  raft.cylinders = {{{0, 0}, 1.0, 2.0}, {{3.4, 0.7}, 0.8, 2.5, 0.6}};
  CylinderBody step{"step", {-2, 4, 0}, {}, {{{-2, 4}, 1.3, {}, 1.5}}};
  return {raft, step};
}

TEST(SubmergedCylinder, KeepsEnergyHaskindAndReciprocityAndConvergesToEightDigits) {
  for (const std::optional<double> draught : {std::optional(2.1), std::optional<double>()})
    for (const double top : {0.2, 1.0}) {
      SCOPED_TRACE(testing::Message() << "top " << top << (draught ? " over a gap" : " on the bed"));
      const auto check = solve({submerged(1, top, draught)}, tank(5), {0.4, 1.1, 2.3}, {-0.4, 0.9}, exact).check;
      EXPECT_LT(check.energy, 1e-8);
      EXPECT_LT(check.haskind, 1e-8);
      EXPECT_LT(check.reciprocity, 1e-8);
      EXPECT_LT(check.doubling, 1e-8);
    }
}

TEST(SubmergedCylinder, AmongOthersOfUnlikeKindsKeepsTheLaws) {
  const auto check = solve(mixed(), tank(5), {0.6, 1.7}, {0.3}, exact).check;
  EXPECT_LT(check.energy, 1e-8);
  EXPECT_LT(check.haskind, 1e-8);
  EXPECT_LT(check.reciprocity, 1e-8);
  EXPECT_LT(check.doubling, 1e-7);  // ten times the tolerance: what the compression of (C12) may leave
}

TEST(SubmergedCylinder, OnTheBedAgreesWithPlainEigenfunctionMatching) {
  for (const double omega : {0.9, 1.8}) {
    const auto c = solve({submerged(1, 0.7, {})}, tank(2), {omega}, {}, exact).coefficients;
    const froude_test::PlainSubmerged plain(1, 0.7, 2, omega * omega / 9.81, 60);
    const auto L = [&](Eigen::Index mode) {  // A = −ρ Re L, B = ωρ Im L (C3)
      return std::complex<double>(-c.A[0](mode, mode) / 1000, c.B[0](mode, mode) / (1000 * omega));
    };
    // The velocity at the edge is infinite: 60 modes of the column leave 60^{−4/3} of what they cannot follow.
    EXPECT_LT(std::abs(L(2) - plain.heave()), 3e-3 * std::abs(L(2))) << L(2) << plain.heave();
    EXPECT_LT(std::abs(L(0) - plain.surge()), 3e-3 * std::abs(L(0))) << L(0) << plain.surge();
  }
}

// In infinite fluid a disc of no thickness has the added mass 8ρa³/3 (Lamb 1932, §102). Surface and bed 8 radii away
// change it by some (1/16)³; a thickness ε by about ε log ε.
TEST(SubmergedCylinder, ThinAndFarFromSurfaceAndBedHasTheAddedMassOfADisc) {
  const Options rough{.tolerance = 1e-4, .threads = 1, .doubled_frequencies = 0};
  double last = 1;
  for (const double thickness : {0.2, 0.05}) {
    const auto c = solve({submerged(1, 8, 8 + thickness)}, tank(16), {1.0}, {}, rough).coefficients;
    const double excess = c.A[0](2, 2) / (8000.0 / 3) - 1;
    EXPECT_GT(excess, 0) << thickness;
    EXPECT_LT(excess, last / 2) << thickness;
    last = excess;
  }
  EXPECT_LT(last, 0.08);
}

// Wave motion at the top is e^{−kt} < 0.1 of that at the surface. What is left is the cylinder's image in the surface,
// which fades from one sign to the other: (a/2t)³ = 1.25e-4, times a few.
TEST(SubmergedCylinder, DeepUnderTheWavesHardlyFeelsTheirFrequency) {
  const auto c = solve({submerged(1, 10, 12)}, tank(40), {1.5, 2.5}, {0}, exact).coefficients;
  EXPECT_NEAR(c.A[0](2, 2), (*c.A_inf)(2, 2), 1e-3 * c.A[0](2, 2));
  EXPECT_NEAR(c.A[1](2, 2), (*c.A_inf)(2, 2), 5e-4 * c.A[0](2, 2));
  EXPECT_LT(c.B[1](2, 2), 1e-3 * 2.5 * c.A[0](2, 2));
}

// However shallow, water above a top moves as waves do: the limit is not the cylinder that pierces the surface, but for
// the frequency infinity, where the surface has no potential and a thin column no inertia.
TEST(SubmergedCylinder, UnderAThinSheetOfWaterIsNotOneThatPiercesTheSurface) {
  const Options rough{.tolerance = 1e-4, .threads = 1, .doubled_frequencies = 0};
  const auto dry = solve({single(1, 1)}, tank(5), {1.0}, {}, rough).coefficients;
  double last = std::numeric_limits<double>::infinity();
  for (const double top : {0.2, 0.05}) {
    const auto wet = solve({submerged(1, top, 1.0)}, tank(5), {1.0}, {}, rough).coefficients;
    const double at_infinity = std::abs((*wet.A_inf)(2, 2) / (*dry.A_inf)(2, 2) - 1);
    EXPECT_LT(at_infinity, last / 2) << top;
    last = at_infinity;
    EXPECT_GT(std::abs(wet.A[0](2, 2) / dry.A[0](2, 2) - 1), 0.2) << top;
  }
  EXPECT_LT(last, 0.1);
}

// A long wave is pressure ρgη on the top of what stands on the bed, and next to nothing on what has water all around:
// its weight of water is pulled along by the slope. The relations of (C13) do not see the sign of a motion; this does.
TEST(SubmergedCylinder, IsPressedDownByLongWavesIfItStandsOnTheBed) {
  const auto X = [](std::optional<double> draught) {
    return solve({submerged(1, 0.5, draught)}, tank(2), {0.1}, {0}, exact).coefficients.X[0](2, 0);
  };
  EXPECT_NEAR(X({}).real(), -9810 * pi, 0.01 * 9810 * pi);  // (ωa)²/(gh) = 5e-4, times a few
  EXPECT_LT(std::abs(X({}).imag()), 0.02 * 9810 * pi);
  EXPECT_LT(std::abs(X(1.0)), 0.02 * 9810 * pi);
}

// McIver & Evans (1984): a shallow one has negative added mass over some frequencies.
TEST(SubmergedCylinder, InShallowSubmergenceHasNegativeAddedMass) {
  const auto c = solve({submerged(1, 0.1, 0.3)}, tank(4), {2.0}, {}, exact).coefficients;
  EXPECT_LT(c.A[0](2, 2), 0);
}

TEST(SubmergedCylinder, DisplacesWhatLiesBetweenItsEnds) {
  const Displacement d = displacement(submerged(2, 1, 4.0), WaterDepth::from_metres(10));
  EXPECT_NEAR(d.volume, pi * 4 * 3, 1e-12);
  EXPECT_EQ(d.centre_of_buoyancy, Eigen::Vector3d(0, 0, -2.5));
  CylinderBody body = submerged(2, 1, 4.0);
  body.centre_of_gravity = Eigen::Vector3d(0, 0, -3);
  const auto C = restoring(body, tank());
  EXPECT_EQ(C(2, 2), 0);
  EXPECT_NEAR(C(3, 3), 9810 * d.volume * 0.5, 1e-6);
}

TEST(SubmergedCylinder, NeedsATopUnderWaterAndAboveItsBottom) {
  const auto solving = [](const CylinderBody& body) { return [=] { solve({body}, tank(5), {1.0}, {}); }; };
  EXPECT_THAT(solving(submerged(1, -0.1, 2.0)),
              ThrowsMessage<InputError>(HasSubstr("top must be finite and positive")));
  EXPECT_THAT(solving(submerged(1, 2, 2.0)),
              ThrowsMessage<InputError>(AllOf(HasSubstr("2 m is not above"), HasSubstr("leave it out"))));
  EXPECT_THAT(solving(submerged(1, 5, {})), ThrowsMessage<InputError>(HasSubstr("not above its bottom at 5 m")));
}

}  // namespace
}  // namespace hydro::cylinders::submerged_test
