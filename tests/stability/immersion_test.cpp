// Members that leave the water and come back to it, down to once in every step: loads stay finite, momentum and energy
// are accounted for, and shorter steps come to one motion.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "answers/simulate.hpp"
#include "dynamics/force/morison.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/force/slamming.hpp"
#include "laws/force_kind_laws.hpp"
#include "scene/scene.hpp"
#include "support/motion.hpp"
#include "support/small_seas.hpp"

namespace immersion_test {
namespace {

using namespace dynamics;
using hydro::waves::CylinderImpact;
using hydro::waves::ImpactTheory;
using support::Motion;

constexpr double mass = 20, radius = 0.1, length = 1;  // kg, m
constexpr ImpactTheory theories[] = {ImpactTheory::von_karman, ImpactTheory::goda, ImpactTheory::wienke_oumeraci};

std::vector<RigidBody> tube() {
  return {
      RigidBody({.name = "tube", .mass = mass, .inertia = Eigen::Vector3d(5, 1, 5).asDiagonal(), .rest_position = {}})};
}
SlenderMember level_member() { return {0, {0, -length / 2, 0}, {0, length / 2, 0}, 2 * radius, 4, Immersion::surface}; }
std::unique_ptr<const ForceKind> slamming(double step, ImpactTheory theory = ImpactTheory::goda) {
  return std::make_unique<SlammingKind>(std::vector<SlammingMember>{{level_member(), theory}}, support::still_water(),
                                        step);
}
std::unique_ptr<const ForceKind> morison(double ca) {
  return std::make_unique<MorisonKind>(std::vector<MorisonMember>{{level_member(), 1.0, ca}}, support::still_water());
}

/// At a height above still water and a speed upwards.
State at(double height, double speed, double time) {
  State s = rest_state(tube());
  s.pose[0].centre.z() = height;
  s.velocity[2] = speed;
  s.time = time;
  return s;
}

// Under at one step, out at the next, under again: each entry strikes anew and ends the strike before it. What a strike
// has given until then is its impulse over two steps; no load exceeds the mean of the first, which is the largest.
TEST(IntermittentImmersion, StrikesAtEveryOtherStepAddUpToTheirImpulses) {
  constexpr double speed = 3;
  for (const ImpactTheory theory : theories)
    for (const double h : {1e-4, 1e-3, 0.01, 0.1, 1.0}) {  // the impact lasts R/V or less, 33 ms
      const auto kind = slamming(h, theory);
      const auto memory = kind->make_memory(at(0.3, speed, 0));
      const CylinderImpact impact(theory, radius, speed, support::fresh_water.density);
      const double largest = length * impact.impulse(h) / h;
      double given = 0;
      constexpr int strikes = 50;
      for (int i = 1; i <= 2 * strikes + 1; ++i) {
        const State now = i % 2 == 1 ? at(-0.3, -speed, i * h) : at(0.3, speed, i * h);
        const double load = laws::load(*kind, now, memory.get())[2];
        EXPECT_GE(load, 0) << "water does not pull";
        EXPECT_LE(load, largest * (1 + 1e-12)) << h;
        given += h * load;
        memory->accept(now);
      }
      const double expected = strikes * length * impact.impulse(2 * h);
      EXPECT_NEAR(given, expected, 1e-9 * expected) << h;
    }
}

// What the body loses of its momentum is the impulse of the theory, whether a step lasts a thirtieth of the impact or
// ten times as long; what it loses of its energy follows from that.
TEST(IntermittentImmersion, MomentumIsLostAsTheTheorySays) {
  constexpr double speed = 3;
  for (const ImpactTheory theory : theories)
    for (const double h : {0.001, 0.01, 0.07, 0.3}) {
      std::vector<std::unique_ptr<const ForceKind>> forces;
      forces.push_back(slamming(h, theory));
      const Model model(tube(), {}, std::move(forces));
      Motion run(model, at(0.5, -speed, 0));
      run.go(h, 200 + static_cast<int>(1 / h));  // of what the integrator damps 0.8^200 is left
      const double impulse =
          length * CylinderImpact(theory, radius, speed, support::fresh_water.density).impulse(10 * radius / speed);
      EXPECT_NEAR(run.workspace.state.velocity[2], -speed + impulse / mass, 1e-9 * speed) << h;
    }
}

/// On a spring that swings it through the surface, once a second where it is dry.
Model skipper(std::vector<std::unique_ptr<const ForceKind>> loads) {
  Matrix6 stiffness = Matrix6::Zero();
  stiffness.diagonal().head<3>().setConstant(mass * std::pow(2 * std::numbers::pi, 2));
  stiffness.diagonal().tail<3>().setConstant(1e3);
  loads.push_back(std::make_unique<RestoringKind>("mooring", tube(), std::vector<Restoring>{{0, stiffness}}));
  return Model(tube(), {}, std::move(loads));
}
/// Of the body and its spring, over that at the start; still water has none to give.
double energy_of(const State& s, double start) {
  const double z = s.pose[0].centre.z(), v = s.velocity[2] / (2 * std::numbers::pi);
  return (z * z + v * v) / (start * start);
}

struct Loads {
  const char* name;
  bool slams;
  double ca;  ///< NaN: no Morison
};
class Skipping : public testing::TestWithParam<Loads> {
 protected:
  struct Outcome {
    double place, most_energy, residual;  // after 6 s, m; of the start; of what was turned over
    int entries;
  };
  static Outcome go(double h) {
    constexpr double start = 0.3, duration = 6;
    std::vector<std::unique_ptr<const ForceKind>> loads;
    if (!std::isnan(GetParam().ca)) loads.push_back(morison(GetParam().ca));
    if (GetParam().slams) loads.push_back(slamming(h));
    const Model model = skipper(std::move(loads));
    Motion run(model, at(start, 0, 0));
    Outcome out{0, 0, 0, 0};
    bool under = false;
    for (int i = 0; i < std::lround(duration / h); ++i) {
      run.go(h, 1);
      const double z = run.workspace.state.pose[0].centre.z();
      out.entries += z < 0 && !under;
      under = z < 0;
      out.most_energy = std::max(out.most_energy, energy_of(run.workspace.state, start));
      out.residual = std::max(out.residual, std::abs(run.ledger.residual() / run.ledger.turnover()));
      out.place = z;
    }
    return out;
  }
};

TEST_P(Skipping, ShorterStepsComeToOneMotionWithoutEnergyFromNowhere) {
  double before = std::numeric_limits<double>::infinity(), coarser = go(0.01).place;
  for (const double h : {0.0025, 0.000625}) {
    const Outcome out = go(h);
    EXPECT_GE(out.entries, 4);
    EXPECT_LT(out.most_energy, 1 + 1e-4) << "water at rest gives none; (ωh)²/12 of it is the step's";
    EXPECT_LT(out.residual, 2 * h) << "first order: a load that begins within a step is booked for a part of it";
    // First order of the instant of contact: a quarter of the step leaves a quarter of the difference, or less.
    EXPECT_LT(std::abs(out.place - coarser), before / 2.5) << h;
    before = std::abs(out.place - coarser);
    coarser = out.place;
  }
  EXPECT_LT(before, 2e-3) << "m, of 0.3 m let go";
}
INSTANTIATE_TEST_SUITE_P(IntermittentImmersion, Skipping,
                         testing::Values(Loads{"Drag", false, 0}, Loads{"Morison", false, 1},
                                         Loads{"Slamming", true, std::numeric_limits<double>::quiet_NaN()},
                                         Loads{"All", true, 1}),
                         [](const auto& which) { return std::string(which.param.name); });

// Steps so long that the body is in at one and out at the next: the motion is wrong, and the run stops or says so. In
// any case it ends, and nothing in it is without bound.
TEST(IntermittentImmersion, StepsThatMissTheWaterAreTold) {
  for (const char* loads :
       {"morison = { cd = 1.0, ca = 1.0, partial_immersion = true }", "slamming = { model = \"goda\" }",
        "morison = { cd = 1.0, ca = 1.0, partial_immersion = true }\nslamming = { model = \"goda\" }"})
    for (const double h : {0.2, 0.25, 0.4, 0.5}) {
      SCOPED_TRACE(fmt::format("{} by {} s", loads, h));
      const auto scene = froude::scene::parse(fmt::format(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "20 m"
[[body]]
name = "tube"
mass = "20 kg"
radii_of_gyration = "(0.5, 0.3, 0.5) m"
free = ["heave"]
initial = {{ heave = "0.3 m" }}
[[mooring]]
on = "tube"
kind = "linear"
stiffness = {{ heave = "790 N/m" }}
[[member]]
on = "tube"
from = "(0, -0.5, 0) m"
to = "(0, 0.5, 0) m"
diameter = "0.2 m"
{}
[ask]
run = {{ duration = "20 s", every = "{} s" }}
[solve]
step = "{} s"
)",
                                                          loads, h, h),
                                              "skipper.toml");
      const froude::Run run = froude::simulate(scene);
      EXPECT_TRUE(!run.stopped.empty() || !run.warnings().empty());
      for (const double z : run.signal("tube.heave")) EXPECT_LT(std::abs(z), 1) << "m, of 0.3 m let go";
    }
}

}  // namespace
}  // namespace immersion_test
