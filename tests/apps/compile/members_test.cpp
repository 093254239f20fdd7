#include "compile/members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/kept.hpp"
#include "hydro/base/error.hpp"
#include "same_water.hpp"
#include "scenes.hpp"

namespace members_test {
namespace {

using namespace froude;
using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

using froude_test::examples;
using froude_test::expect_same_water;

/// A pile in surge, with waves and what acts on its member.
scene::Scene pile(const std::string& waves, const std::string& loads, const std::string& top = "-1") {
  return scene::parse("schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n" + waves +
                          "[[body]]\nname = \"pile\"\nmass = \"500 kg\"\nfree = [\"surge\"]\n"
                          "[[member]]\non = \"pile\"\nfrom = \"(0, 0, -9) m\"\nto = \"(0, 0, " +
                          top + ") m\"\ndiameter = \"0.4 m\"\n" + loads +
                          "\n[ask]\nrun = { duration = \"8 s\", every = \"0.1 s\" }\n",
                      examples / "test.toml");
}

const std::string linear = "[waves]\nkind = \"regular\"\nheight = \"1 m\"\nperiod = \"4 s\"\nheading = \"0 deg\"\n";
const std::string stream = linear + "theory = \"stream\"\n";

TEST(Members, NameTheEffectsThatThePlanShows) {
  const auto effects = [](const std::string& loads) {
    const auto s = pile(linear, loads);
    std::vector<std::string> names;
    for (const auto& line : compile::time_model(s, compile::prepare(s)).plan) names.push_back(line.effect);
    return names;
  };
  EXPECT_THAT(effects("drag = { cd = 1 }"), AllOf(Contains("drag"), Not(Contains("morison"))));
  EXPECT_THAT(effects("morison = { cd = 1, ca = 1 }\nslamming = { model = \"wienke\" }"),
              AllOf(Contains("morison"), Contains("slamming"), Not(Contains("drag"))));
}

TEST(Members, OfMorisonTakeWavesOfAnyKind) {
  const auto s = pile(stream, "morison = { cd = 1, ca = 1, partial_immersion = true }", "2");
  const auto record = simulate(s);
  EXPECT_EQ(record.stopped, "");
  double most = 0;
  for (const double x : record.signal("pile.surge")) most = std::max(most, std::abs(x));
  EXPECT_GT(most, 0.05);
}

// A long run in a sea reads waves near its members from a table, a short one sums them; the water is the same.
TEST(Members, InALongRunReadTheSeaFromATable) {
  auto s = pile("[waves]\nkind = \"jonswap\"\nhs = \"1 m\"\ntp = \"5 s\"\nheading = \"30 deg\"\n",
                "morison = { cd = 1, ca = 1 }");
  s.run->duration = 0.2;
  const compile::Prepared prepared = compile::prepare(s);
  const compile::RunWater summed = compile::time_model(s, prepared).water;
  s.run->duration = 200;
  const compile::RunWater tabled = compile::time_model(s, prepared).water;
  EXPECT_EQ(summed.around_members->tables(), 0);
  EXPECT_EQ(tabled.around_members->tables(), 1);
  expect_same_water(*summed.field, *tabled.field);
}

// Errors of a run are estimated by runs of other steps and pieces. A table takes as long to make as many of them to
// step.
TEST(Members, ShareTheSeaAroundThemAmongRunsOfOtherStepsAndPieces) {
  const auto sea = [](const std::string& hs) {
    auto s = pile("[waves]\nkind = \"jonswap\"\nhs = \"" + hs + "\"\ntp = \"5 s\"\nheading = \"30 deg\"\n",
                  "morison = { cd = 1, ca = 1 }");
    s.run->duration = 200;
    return s;
  };
  auto s = sea("1 m");
  const compile::Prepared prepared = compile::prepare(s);
  const auto runs = [&](const scene::Scene& one) { compile::time_model(one, prepared); };
  runs(s);
  s.solve.step = scene::Located<double>{0.025, {}};
  runs(s);
  compile::cut_members_finer({2, 2}, s);
  runs(s);
  EXPECT_EQ(prepared.kept->water_of_members().made(), 1u);
  runs(sea("1.1 m"));
  EXPECT_EQ(prepared.kept->water_of_members().made(), 2u);
}

TEST(Members, OfDragAtRestTakeLinearWavesOnly) {
  const auto s = pile(stream, "drag = { cd = 1 }");
  EXPECT_THAT([&] { compile::time_model(s, compile::prepare(s)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("not a sum of linear waves")));
}

TEST(Members, ThatReachOutOfTheWaterMustSaySo) {
  const auto s = pile(linear, "morison = { cd = 1, ca = 1 }", "2");
  EXPECT_THAT([&] { compile::time_model(s, compile::prepare(s)); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("reaches above still water"), HasSubstr("partial_immersion = true"))));
}

TEST(Members, ExampleOfABraceRunsAndItsEnergyAddsUp) {
  const auto s = scene::read(examples / "brace.toml");
  const auto record = simulate(s);
  EXPECT_EQ(record.stopped, "");
  double most = 0;
  for (const double x : record.signal("brace.pitch")) most = std::max(most, std::abs(x));
  EXPECT_GT(most, 0.02);
  EXPECT_LT(most, 1.5);
  const auto energy = [&](const std::string& name) {
    for (const auto& [key, value] : record.energy)
      if (key == name) return value;
    return std::nan("");
  };
  EXPECT_GT(energy("morison.dissipated"), 0);
  EXPECT_NE(energy("slamming.supplied"), 0);
  // The trapezium rule over an impact that begins at full force within a step is of first order.
  EXPECT_LT(std::abs(energy("residual")), 0.02 * energy("turnover"));
}

/// A spar of 20 m draught and 4 m diameter with a plate of 8 m at its foot, in deep water.
scene::Scene spar(const std::string& ends, const std::string& more = "", const std::string& foot = "-20") {
  return scene::parse("schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"infinite\"\n" + linear +
                          "[[body]]\nname = \"spar\"\nmass = \"251.327 t\"\nfree = [\"heave\"]\nweight = true\n"
                          "[body.buoyancy]\ncylinders = { from = \"(0, 0, -20) m\", to = \"(0, 0, 5) m\", "
                          "diameter = \"4 m\" }\n" +
                          more + "[[member]]\nname = \"column\"\non = \"spar\"\nfrom = \"(0, 0, " + foot +
                          ") m\"\nto = \"(0, 0, 5) m\"\ndiameter = \"4 m\"\n"
                          "morison = { cd = 0.7, ca = 1, partial_immersion = true }\n" +
                          ends +
                          "[ask]\nrao = { periods = \"6 s .. 14 s, 3 values\", of = [\"spar.heave\"] }\n"
                          "run = { duration = \"8 s\", every = \"0.1 s\" }\n",
                      examples / "test.toml");
}

const std::string foot_and_plate = "ends = { at = [\"from\"], pressure = true, ca = 1.2, diameter = \"8 m\" }\n";

// e^{−kT} (ρgA − ω² m_a) lifts what has the mass M + m_a and the stiffness ρgA.
TEST(Spar, HeavesAsThePressureAtItsFootLiftsIt) {
  const auto s = spar(foot_and_plate);
  const auto response = respond(s);
  const double A = 4 * std::numbers::pi, lift = 1000 * s.water.gravity * A,
               added = 1.2 * 1000 * std::numbers::pi / 12 * 512;
  for (std::size_t w = 0; w < s.rao->omega.size(); ++w) {
    const double omega = s.rao->omega[w], k = omega * omega / s.water.gravity;
    const double wanted =
        std::exp(-20 * k) * (lift - omega * omega * added) / (lift - omega * omega * (s.bodies[0].mass + added));
    const std::complex<double> found = response.signal("spar.heave").values[w];
    // Rounding of the dispersion and of two sums that nearly cancel at the heave period, 11 s.
    EXPECT_NEAR(std::abs(found - wanted), 0, 1e-9 * std::abs(wanted)) << omega;
  }
}

TEST(Spar, TellsTheLiftThatIsMissingWithoutEnds) {
  EXPECT_THAT(compile::ends_without_pressure(spar("")), testing::ElementsAre(HasSubstr("ends = { at = [\"from\"]")));
  EXPECT_THAT(compile::ends_without_pressure(spar(foot_and_plate)), testing::IsEmpty());
}

TEST(Spar, IsRefusedWherePressureCountsTwiceOrLiesAboveTheWater) {
  const auto compiled = [](const scene::Scene& s) { return [s] { compile::time_model(s, compile::prepare(s)); }; };
  EXPECT_THAT(compiled(spar(foot_and_plate,
                            "[body.hydrodynamics]\nexcitation = true\n"
                            "cylinders = { at = \"(0, 0, 0) m\", diameter = \"4 m\", draught = "
                            "\"20 m\", frequencies = \"0.4 rad/s .. 1 rad/s, 3 values\" }\n")),
              ThrowsMessage<hydro::InputError>(HasSubstr("count twice")));
  EXPECT_THAT(compiled(spar("ends = { at = [\"to\"], cd = 1 }\n")),
              ThrowsMessage<hydro::InputError>(HasSubstr("lies above it")));
}

}  // namespace
}  // namespace members_test
