#include "dynamics/line/sundials_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/line/equilibrium.hpp"
#include "hydro/base/error.hpp"
#include "support/line_models.hpp"

namespace sundials_reference_test {
namespace {

using namespace dynamics::line;

/// A loop of inextensible links, swung across.
State swung(const Line& line, int links) {
  State s = hanging_shape(line, support::ends_at(line, {2.5, 0, 0}));
  for (int i = 1; i < links; ++i) s.velocity(1, i) = std::sin(std::numbers::pi * i / links);
  return s;
}

// Energy-momentum comes nearer to it by the square of the step.
TEST(SundialsReference, IsWhatEnergyMomentumTendsTo) {
  const Line line(support::loop(7));
  State exact = swung(line, 7);
  run_by_sundials(line, exact, 0.5, 1e-10);
  const auto off = [&](double h) {
    State s = swung(line, 7);
    Stepper stepper(line, {});
    stepper.start(s);
    for (int i = 0; i < std::lround(0.5 / h); ++i) stepper.step(s, h);
    return (s.position - exact.position).norm();
  };
  const double rough = off(2e-3), fine = off(1e-3);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(rough / fine, 4, 0.4);
}

TEST(SundialsReference, RefusesNoTolerance) {
  const Line line(support::loop(7));
  State s = swung(line, 7);
  EXPECT_THROW(run_by_sundials(line, s, 1, 0), hydro::InputError);
}

}  // namespace
}  // namespace sundials_reference_test
