/// Loads on nodes over time (D150), against the closed form of one mass on a spring.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dynamics/line/stepper.hpp"
#include "support/line_models.hpp"

namespace timed_load_test {
namespace {

using namespace support;
using dynamics::LoadHistory;
using Eigen::Vector3d;

constexpr double mass = 2, stiffness = 18, length = 3, omega = 3;  // kg, N/m, m, rad/s
constexpr double full = 4;                                         // N

/// A mass at the end of one spring that lies along x, pulled along it, without weight.
Line mass_on_a_spring(const LoadHistory& history) {
  Description d;
  d.nodes = {{}, {.mass = mass, .loads = {{full * Vector3d::UnitX(), history}}}};
  d.segments = {{.length = length, .axial_stiffness = stiffness * length}};
  d.held = {{.node = 0}};
  d.gravity = 0;
  return Line(std::move(d));
}

State at_rest() {
  State s;
  s.position = s.velocity = Places::Zero(3, 2);
  s.position(0, 1) = length;
  s.tension = Eigen::VectorXd::Zero(1);
  return s;
}

/// What the mass does t after the load has begun to rise by one newton a second, or has jumped by one newton.
double after_a_corner(double t) { return t <= 0 ? 0 : (t - std::sin(omega * t) / omega) / stiffness; }
double after_a_jump(double t) { return t <= 0 ? 0 : (1 - std::cos(omega * t)) / stiffness; }

/// The displacement by superposition: one corner or one jump after the other.
double closed_form(const LoadHistory& h, double t) {
  double sum = 0;
  const auto change = [&](double sign, double begin, double over) {
    sum += over > 0 ? sign * full / over * (after_a_corner(t - begin) - after_a_corner(t - begin - over))
                    : sign * full * after_a_jump(t - begin);
  };
  change(1, h.from, h.ramp_up);
  change(-1, h.until, h.ramp_down);
  return sum;
}

// None of these times is a sum of steps.
constexpr LoadHistory pulled_and_let_go{.from = 0.317, .ramp_up = 1.203, .until = 2.411};
constexpr LoadHistory struck{.from = 0.317, .ramp_up = 0, .until = 0.823, .ramp_down = 0.551};

/// The largest difference from the closed form over 5 s; `residual` gets the largest of the ledger.
double worst_difference(const LoadHistory& history, Stepper::Settings settings, double h, double* residual = nullptr) {
  const Line line = mass_on_a_spring(history);
  State s = at_rest();
  Stepper stepper(line, settings);
  stepper.start(s);
  double worst = 0;
  for (int i = 0; i < std::lround(5 / h); ++i) {
    stepper.step(s, h);
    worst = std::max(worst, std::abs(s.position(0, 1) - length - closed_form(history, s.time)));
    if (residual != nullptr) *residual = std::max(*residual, std::abs(stepper.energies().residual()));
  }
  return worst;
}

TEST(LoadHistory, RisesStaysAndFalls) {
  const LoadHistory h{.from = 1, .ramp_up = 2, .until = 5, .ramp_down = 4};
  EXPECT_EQ(h.share(0.5), 0);
  EXPECT_EQ(h.share(2), 0.5);
  EXPECT_EQ(h.share(4), 1);
  EXPECT_EQ(h.share(6), 0.75);
  EXPECT_EQ(h.share(9), 0);
  EXPECT_EQ(h.share(5, 4), 1);  // a corner, by the piece that ends there
  EXPECT_EQ(h.next_corner(3), 5);
  EXPECT_EQ(h.next_corner(9), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(h.is_constant());
  EXPECT_TRUE(LoadHistory{}.is_constant());
  EXPECT_FALSE((LoadHistory{.from = 1, .ramp_up = 2, .until = 2}).is_ordered());
}

TEST(TimedLoads, JumpsHaveTwoSides) {
  const LoadHistory h{.from = 1, .until = 2};
  EXPECT_EQ(h.share(2, 1.5), 1);
  EXPECT_EQ(h.share(2, 2.5), 0);
  EXPECT_EQ(h.share(2), 0);
}

TEST(TimedLoads, PullAMassOnASpringAsTheClosedFormHasIt) {
  for (const LoadHistory& history : {pulled_and_let_go, struck})
    for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha}) {
      const double rough = worst_difference(history, {.scheme = scheme}, 0.02),
                   fine = worst_difference(history, {.scheme = scheme}, 0.01);
      // Of second order though every corner lies within a step: halving leaves a quarter, within a tenth of that for
      // what is of third order.
      EXPECT_NEAR(rough / fine, 4, 0.4) << name_of(scheme);
      // (ωh)²/12 of ωt is the error of phase of the trapezium, some 4 times that with ρ∞ = 0.8: of 0.3 m, 4 mm.
      EXPECT_LT(fine, 4 * 0.3 * (0.03 * 0.03 / 12) * 15) << name_of(scheme);
    }
}

TEST(TimedLoads, AreFollowedBySubStepsToTheirError) {
  const Stepper::Settings closely{.scheme = Scheme::rosenbrock, .local_error = 1e-8};
  for (const LoadHistory& history : {pulled_and_let_go, struck})
    EXPECT_LT(worst_difference(history, closely, 0.05), 1e-5);  // m: a hundred steps and more of 1e-8 of 3 m each
}

TEST(TimedLoads, GiveTheLedgerTheirWork) {
  for (const LoadHistory& history : {pulled_and_let_go, struck}) {
    double residual = 0;
    worst_difference(history, {}, 0.02, &residual);
    EXPECT_LT(residual, 1e-9);  // J: the step's own work; Newton's tolerance of 1.5 J
  }
  // Of generalised-α it is a trapezium of each step, whose error falls by four with the step.
  double rough = 0, fine = 0;
  worst_difference(pulled_and_let_go, {.scheme = Scheme::generalised_alpha, .rho_infinity = 1}, 0.02, &rough);
  worst_difference(pulled_and_let_go, {.scheme = Scheme::generalised_alpha, .rho_infinity = 1}, 0.01, &fine);
  EXPECT_LT(fine, 0.3 * rough);
  EXPECT_LT(rough, 1e-3);  // of 1.5 J
}

TEST(TimedLoads, LeaveWhatIsLetGoItsEnergy) {
  const Line line = mass_on_a_spring(pulled_and_let_go);
  State s = at_rest();
  Stepper stepper(line, {});
  stepper.start(s);
  double after = 0;
  for (int i = 0; i < 500; ++i) {
    stepper.step(s, 0.01);
    if (i == 242) after = stepper.energies().total();  // 2.43 s
  }
  EXPECT_GT(after, 0.1);
  EXPECT_NEAR(stepper.energies().total(), after, 1e-9);
  EXPECT_NEAR(stepper.energies().loads, after - stepper.energies().at_start, 1e-9);
}

}  // namespace
}  // namespace timed_load_test
