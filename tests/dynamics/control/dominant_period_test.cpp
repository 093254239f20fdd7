// Which period dominates, and when that is taken as settled.
#include "dynamics/control/dominant_period.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/switched_connector.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "hydro/base/error.hpp"

namespace dominant_period_test {
namespace {

using namespace dynamics;
constexpr double two_pi = 2 * std::numbers::pi;

std::vector<double> sampled(double duration, double step, const std::function<double(double)>& x) {
  std::vector<double> out;
  for (double t = 0; t < duration; t += step) out.push_back(x(t));
  return out;
}

TEST(DominantPeriod, IsFoundBetweenTheBinsOfASpectrum) {
  for (const double period : {3.5, 4.1, 7.5, 9.3}) {
    const auto x = sampled(100, 0.1, [&](double t) { return 5 + 0.3 * std::cos(two_pi * t / period + 0.7); });
    EXPECT_NEAR(dominant_frequency(x, 0.1), 1 / period, 0.02 / 100) << period << ": two hundredths of a bin";
  }
}

TEST(DominantPeriod, IsThatOfTheLargerOscillation) {
  const auto x =
      sampled(100, 0.1, [](double t) { return std::cos(two_pi * t / 8) + 1.3 * std::cos(two_pi * t / 3.5); });
  EXPECT_NEAR(dominant_frequency(x, 0.1), 1 / 3.5, 1e-3);
  EXPECT_EQ(dominant_frequency(std::vector<double>(64, 2.0), 0.1), 0) << "nothing moves";
}

PeriodSwitching law() { return {.every = 25, .window = 100, .hysteresis = 1e-3, .settings = {{0, 1000}, {5, 3000}}}; }

/// The times and settings of a signal that has one period until `change` and another from then on.
std::vector<std::pair<double, double>> settings_of(PeriodSwitching with, double first, double then, double change) {
  DominantPeriodController controller(std::move(with));
  std::vector<std::pair<double, double>> out;
  for (int i = 0; i <= 12'000; ++i) {
    const double t = 0.1 * i;
    if (const auto set = controller.sample(t, std::sin(two_pi * t / (t < change ? first : then))))
      out.emplace_back(t, *set);
  }
  return out;
}

TEST(DominantPeriod, IsTakenOnceTwoChecksAgree) {
  const auto set = settings_of(law(), 7.5, 3.5, 600);
  ASSERT_EQ(set.size(), 2u) << "one for the first waves, one for the second";
  EXPECT_NEAR(set[0].first, 125, 1e-9) << "the second check of a window that is full";
  EXPECT_EQ(set[0].second, 3000);
  EXPECT_GT(set[1].first, 600);
  EXPECT_LE(set[1].first, 600 + 100 + 2 * 25) << "when the window is full of the new waves";
  EXPECT_EQ(set[1].second, 1000);
}

// A window that is not full shows a swing of 30 s as one of its own length, twice in turn.
TEST(DominantPeriod, DecidesNothingBeforeItsWindowIsFull) {
  PeriodSwitching with = law();
  with.every = 1;
  with.hysteresis = 1;
  EXPECT_NEAR(settings_of(with, 7.5, 7.5, 0).at(0).first, 101, 1e-9) << "a check at 100 s, and one that agrees";
  with.every = 300;
  EXPECT_NEAR(settings_of(with, 7.5, 7.5, 0).at(0).first, 600, 1e-9) << "full at the first check already";
}

TEST(DominantPeriod, WaitsForTheDwellTime) {
  PeriodSwitching with = law();
  with.dwell = 800;
  const auto set = settings_of(with, 7.5, 3.5, 600);
  ASSERT_EQ(set.size(), 2u);
  EXPECT_GE(set[1].first - set[0].first, 800);
}

TEST(DominantPeriod, RefusesSettingsThatDoNotAscendFromZero) {
  PeriodSwitching with = law();
  with.settings = {{1, 1000}};
  EXPECT_THROW(DominantPeriodController{with}, hydro::InputError);
  with.settings = {{0, 1000}, {0, 2000}};
  EXPECT_THROW(DominantPeriodController{with}, hydro::InputError);
}

// What a switch takes out of a stretched spring is accounted: kinetic and stored energy fall by it, and the ledger
// closes.
TEST(SwitchMemory, AccountsForTheEnergyOfASwitch) {
  const std::vector<RigidBody> bodies{RigidBody({.name = "mass", .mass = 2, .inertia = Eigen::Matrix3d::Identity()})};
  const Ends to_ground{{0, Eigen::Vector3d::Zero()}, PointOnGround{Eigen::Vector3d(10, 0, 0)}};
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<SwitchedConnectorKind>(
      std::vector<SwitchedConnectors>{SwitchedConnectors{{to_ground, {.stiffness = 50, .damping = 1}, 10}}}));
  const Model model(bodies, {}, std::move(forces));
  State start = rest_state(model.bodies());
  start.pose[0].centre.x() = 1;
  Workspace w(model, start);
  GeneralizedAlpha integrator(model, {.rho_infinity = 1});
  integrator.start(w);
  EnergyLedger ledger(model, w);
  auto& memory = static_cast<SwitchMemory&>(*w.memory[0]);
  for (int i = 0; i < 5000; ++i) {
    integrator.step(w, 1e-3);
    if (w.state.time > 2 && memory.set(0, 20, w.state)) integrator.loads_jumped(w);
    ledger.note(w);
  }
  EXPECT_EQ(memory.switches[0], 1u);
  EXPECT_EQ(memory.stiffness[0], 20);
  EXPECT_NEAR(ledger.residual(), 0, 1e-5 * 25) << "of the trapezium rule, (ωh)² = 2.5e-5";
}

}  // namespace
}  // namespace dominant_period_test
