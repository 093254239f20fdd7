// The sums of energy of a structure that yields: a double pendulum with friction, against Van Zanten's own formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"

namespace energies_test {
namespace {

using namespace froude;

constexpr double m1 = 24.92, m2 = 5.26, h1 = 0.755, h2 = 0.107, L = 1.25, I1 = 3.07, I2 = 0.14, g = 9.81;

const std::string text = froude_test::water + R"([[body]]
name = "top"
position = "(0, 0, 1.735) m"
mass = "24.92 kg"
weight = true
energy = true
centre_of_gravity = "(0, 0, -0.755) m"
inertia = "(3.07, 3.07, 3.07) kg m^2"
free = ["surge", "heave", "pitch"]
[body.initial_velocity]
pitch = "1.5 rad/s"
[[body]]
name = "bottom"
position = "(0, 0, 0.485) m"
mass = "5.26 kg"
weight = true
energy = true
centre_of_gravity = "(0, 0, -0.107) m"
inertia = "(0.14, 0.14, 0.14) kg m^2"
free = ["surge", "heave", "pitch"]
[[joint]]
name = "upper"
kind = "hinge"
between = ["ground", "top"]
at = "(0, 0, 1.735) m"
axis = "y"
[[joint]]
name = "lower"
kind = "hinge"
between = ["top", "bottom"]
at = "(0, 0, 0.485) m"
axis = "y"
friction = { static = "1 N m", dynamic = "0.8 N m" }
[ask]
run = { duration = "3 s", every = "0.01 s" }
[solve]
step = "2 ms"
)";

TEST(Energies, AreTheSumsOfVanZantensTable) {
  const froude::Run run = simulate(froude_test::parse(text));
  ASSERT_EQ(run.stopped, "");
  const auto& top = run.signal("upper.angle");
  const auto& relative = run.signal("lower.angle");
  double most_lost = 0;
  for (std::size_t i = 1; i + 1 < top.size(); ++i) {
    const double span = run.time[i + 1] - run.time[i - 1], rate = (top[i + 1] - top[i - 1]) / span,
                 bottom_rate = rate + (relative[i + 1] - relative[i - 1]) / span, bottom = top[i] + relative[i];
    // Van Zanten (2020), eqs. 4.1 and 4.2.
    const double kinetic = 0.5 * (m1 * h1 * h1 + I1) * rate * rate + 0.5 * m2 * L * L * rate * rate +
                           m2 * rate * bottom_rate * L * h2 * std::cos(bottom - top[i]) +
                           0.5 * (m2 * h2 * h2 + I2) * bottom_rate * bottom_rate;
    const double potential =
        m1 * g * h1 * (1 - std::cos(top[i])) + m2 * g * (L * (1 - std::cos(top[i])) + h2 * (1 - std::cos(bottom)));
    const double lost = run.signal("energy.friction.dissipated")[i];
    EXPECT_NEAR(run.signal("energy.stored")[i], potential, 1e-9);
    // The same of the upper and of the lower part alone (fig. 4.5); rates as below.
    EXPECT_NEAR(run.signal("top.energy.potential")[i], m1 * g * h1 * (1 - std::cos(top[i])), 1e-9);
    EXPECT_NEAR(run.signal("top.energy.kinetic")[i], 0.5 * (m1 * h1 * h1 + I1) * rate * rate, 0.03);
    EXPECT_NEAR(run.signal("bottom.energy.kinetic")[i], kinetic - 0.5 * (m1 * h1 * h1 + I1) * rate * rate, 0.03);
    EXPECT_NEAR(run.signal("top.energy.potential")[i] + run.signal("bottom.energy.potential")[i], potential, 1e-9);
    // No water moves with these bodies, so their own energies are all that is held: to rounding.
    EXPECT_NEAR(run.signal("top.energy.kinetic")[i] + run.signal("bottom.energy.kinetic")[i],
                run.signal("energy.kinetic")[i], 1e-9);
    // Rates are central differences over 20 ms; where friction changes they have a corner, 0.1 % of the energy.
    EXPECT_NEAR(run.signal("energy.elastic")[i], kinetic + potential, 0.03);
    EXPECT_DOUBLE_EQ(run.signal("energy.dissipated")[i], lost);
    // Nothing is supplied, so what swings and what is lost stay one sum: to the step's error, 1e-4 of 30 J.
    EXPECT_NEAR(run.signal("energy.absorbed")[i], run.signal("energy.absorbed")[0], 3e-3);
    most_lost = std::max(most_lost, lost);
  }
  EXPECT_GT(most_lost, 0.5) << "the lower hinge slips";
}

}  // namespace
}  // namespace energies_test
