#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "dynamics/frequency/rao.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/harmonics.hpp"
#include "scenes.hpp"

namespace springs_test {
namespace {

using namespace froude;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

using froude_test::examples;

double energy(const froude::Run& record, const std::string& name) {
  for (const auto& [key, value] : record.energy)
    if (key == name) return value;
  return std::nan("");
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

TEST(Springs, ExampleOfAPowerTakeOffKeepsToItsLimitAndItsEnergyAddsUp) {
  const auto record = simulate(scene::read(examples / "takeoff.toml"));
  EXPECT_EQ(record.stopped, "");
  const double stroke = largest(record.signal("rack.stroke"));
  EXPECT_GT(stroke, 0.2);
  EXPECT_LT(stroke, 0.7);  // the stops yield some centimetres
  EXPECT_GT(energy(record, "pto.dissipated"), 0);
  EXPECT_LT(std::abs(energy(record, "residual")), 0.01 * energy(record, "turnover"));
}

// The rig carries (−ω²(M + A) + iωB + C) x, the module's impedance in heave.
TEST(Springs, ExampleOfAForcedOscillationGivesTheImpedanceBack) {
  const scene::Scene scene = scene::read(examples / "forced.toml");
  const auto record = simulate(scene);
  EXPECT_EQ(record.stopped, "");
  const compile::Prepared prepared = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(prepared);
  const double omegas[] = {2 * std::numbers::pi / 4};
  const auto Z = dynamics::frequency::impedance(model, prepared.groups, omegas[0])(2, 2);
  const auto amplitude = [&](const char* name) {
    const auto& all = record.signal(name);
    const std::size_t periods = 1600;  // samples of 20 of them
    return hydro::signal::fit_harmonics(std::span(record.time).last(periods), std::span(all).last(periods), omegas)
        .amplitude.at(0);
  };
  const auto x = amplitude("m.heave"), F = amplitude("rig.m.force_z");
  EXPECT_NEAR(std::abs(x), 0.1, 1e-6);
  // The accuracy asked, 1e-3, of memory and step; relative to restoring and inertia, which work against each other.
  EXPECT_LT(std::abs(F / x - Z), 2e-3 * 79e3) << F / x << " against " << Z;
  EXPECT_GT(energy(record, "joint.prescribed.supplied"), 0) << "waves go out";
}

// Waves of 7 s, a float of some 3 s: held at its ends it keeps their time and goes farther than without.
TEST(Springs, ExampleOfALatchHoldsTheFloatAndTakesNoEnergy) {
  auto scene = scene::read(examples / "latched.toml");
  const auto latched = simulate(scene);
  EXPECT_EQ(latched.stopped, "");
  EXPECT_EQ(energy(latched, "latch.dissipated"), 0);
  scene.joints[0].pto->latch.reset();
  const auto free = simulate(scene);
  const auto late = [](const froude::Run& r) {
    const auto& all = r.signal("rack.stroke");
    return largest({all.end() - 400, all.end()});
  };
  EXPECT_GT(late(latched), 1.3 * late(free)) << late(latched) << " m, free " << late(free) << " m";
}

TEST(Springs, ExampleOfChainsBeginsWithTheirStaticTensions) {
  auto scene = scene::read(examples / "moored.toml");
  scene.run->from_equilibrium = false;  // the line is worked out from where the module is placed
  const auto record = simulate(scene);
  EXPECT_EQ(record.stopped, "");
  // From ((5.2, 5.2, −1.1) m) to ((45, 45, −14) m): four equal chains.
  const double weight = (8 - 1000 * std::numbers::pi / 4 * 0.036 * 0.036) * 9.81;
  const auto rest = dynamics::catenary({59, weight, 30e6, true}, std::hypot(39.8, 39.8), 12.9);
  for (const char* name : {"chain1", "chain2", "chain3", "chain4"}) {
    EXPECT_NEAR(record.signal(std::string(name) + ".tension").front(), rest.fairlead(), 1e-6 * rest.fairlead());
    EXPECT_NEAR(record.signal(std::string(name) + ".anchor_tension").front(), rest.anchor(), 1e-6 * rest.fairlead());
  }
  EXPECT_LT(std::abs(energy(record, "residual")), 0.01 * energy(record, "turnover"));
}

TEST(Springs, ExampleOfChainsLiesStillInItsEquilibriumUntilWavesCome) {
  const auto record = simulate(scene::read(examples / "moored.toml"));
  const auto& heave = record.signal("module.heave");
  EXPECT_LT(heave[0], -0.1) << "the chains pull it down";
  // As placed it would sink by 4 cm in the first 0.3 s; of the waves the ramp has let through less than a hundredth.
  EXPECT_NEAR(heave[3], heave[0], 2e-3);
}

/// Two bodies in surge, joined; nothing else.
scene::Scene joined(const std::string& connector) {
  std::string text = "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n";
  for (const char* body :
       {"name = \"a\"\n", "name = \"b\"\nposition = \"(5, 0, 0) m\"\ninitial_velocity = { surge = \"1 m/s\" }\n"})
    text += std::string("[[body]]\n") + body + "mass = \"100 kg\"\nfree = [\"surge\"]\n";
  return scene::parse(text + "[[connector]]\nbetween = [\"a\", \"b\"]\nends = [\"(0, 0, 0) m\", \"(0, 0, 0) m\"]\n" +
                          connector + "[ask]\nrun = { duration = \"10 s\", every = \"0.01 s\" }\n",
                      examples / "test.toml");
}

// b flies off, the cable tightens after 1 s and throws both together: they meet at half the speed and part again.
// Looked up, the chains pull as they do when they are solved; the table is one for four alike chains.
TEST(Springs, ChainsFromATableAreThoseThatAreSolved) {
  auto scene = scene::read(examples / "moored.toml");
  scene.run->duration = 20;
  const froude::Run solved = simulate(scene);
  for (auto& line : scene.catenaries) line.table = scene::CatenaryLine::Table{3, 1e-4, {}};
  const compile::Prepared prepared = compile::prepare(scene);
  for (const auto& line : prepared.catenaries) EXPECT_EQ(line.table, prepared.catenaries.front().table);
  const froude::Run looked_up = simulate(scene);
  const double largest_tension = largest(solved.signal("chain1.tension"));
  for (const char* name : {"chain1.tension", "chain4.anchor_tension"})
    for (std::size_t i = 0; i < solved.time.size(); ++i)
      ASSERT_NEAR(looked_up.signal(name)[i], solved.signal(name)[i], 5e-4 * largest_tension)
          << name << ": the tolerance is of the largest pull in reach, some four times this one";
  EXPECT_NE(looked_up.signal("chain1.tension"), solved.signal("chain1.tension")) << "the table was used";
  EXPECT_LT(std::abs(energy(looked_up, "residual")), 1e-3 * energy(looked_up, "turnover"));
}

TEST(Springs, RefuseATableThatReachesTooFar) {
  auto scene = scene::read(examples / "moored.toml");
  for (auto& line : scene.catenaries) line.table = scene::CatenaryLine::Table{8, 1e-9, {}};
  EXPECT_THAT([&] { compile::prepare(scene); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("mooring \"chain1\""), HasSubstr("a smaller reach"))));
}

TEST(Springs, ACableExchangesVelocitiesOnceItTightens) {
  const auto record = simulate(joined("kind = \"cable\"\nstiffness = \"20 kN/m\"\nrest_length = \"6 m\"\n"));
  const auto& a = record.signal("a.surge");
  EXPECT_LT(a[99], 1e-9);  // until 1 s nothing
  // Then a has b's velocity, as well as ωh = 0.2 follows half a swing: (ωh)²/12 = 3e-3.
  EXPECT_NEAR(a[300] - a[299], 0.01, 3e-5);
  EXPECT_NEAR(*std::min_element(record.signal("connector1.force").begin(), record.signal("connector1.force").end()), 0,
              1e-9);
  // Half a swing of the reduced mass: peak v √(k m/2).
  EXPECT_NEAR(largest(record.signal("connector1.force")), std::sqrt(20e3 * 50), 0.02 * std::sqrt(20e3 * 50));
}

TEST(Springs, RefuseWhatDoesNotHang) {
  const auto text = [](const std::string& line) {
    return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n[[body]]\nname = \"a\"\nmass = \"100 "
           "kg\"\nfree = [\"surge\"]\n[[mooring]]\non = \"a\"\nkind = \"catenary\"\nfrom = \"(0, 0, 0) m\"\n" +
           line +
           "diameter = \"0.1 m\"\naxial_stiffness = \"1 MN\"\n[ask]\nrun = { duration = \"10 s\", every = \"0.1 s\" "
           "}\n";
  };
  EXPECT_THAT(
      [&] {
        scene::parse(text("to = \"(30, 0, -20) m\"\nlength = \"40 m\"\nmass_per_length = \"5 kg/m\"\n"), "test.toml");
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("it floats")));
  const auto above = scene::parse(
      text("to = \"(30, 0, 5) m\"\non_bed = true\nlength = \"40 m\"\nmass_per_length = \"20 kg/m\"\n"), "test.toml");
  EXPECT_THAT([&] { compile::prepare(above); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("under the bed"), HasSubstr("on_bed"))));
}

}  // namespace
}  // namespace springs_test
