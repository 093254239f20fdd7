// What a scene does not name is not made, not evaluated and not stepped; what it names is, and that alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "scenes.hpp"

namespace effects_test {
namespace {

using namespace froude;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// One effect: what it adds to a scene of a module in waves, and the kind of force that it is.
struct Effect {
  const char* name;
  const char* table;     ///< further tables
  const char* of_body;   ///< further keys of [[body]]
  const char* of_water;  ///< keys of [body.hydrodynamics]
  const char* kind;
};

const std::vector<Effect>& effects() {
  static const std::vector<Effect> all{
      {"hydrostatics", "", "", "hydrostatics = true\n", "hydrostatics"},
      {"excitation", "", "", "excitation = true\n", "excitation"},
      {"turning excitation", "", "",
       "excitation = true\nturning = { from = \"-5 deg\", to = \"0 deg\", slower_than = \"60 s\" }\n",
       "excitation.turning"},
      {"radiation", "", "", "radiation = { memory_tolerance = 1e-2 }\n", "radiation"},
      {"weight", "", "weight = true\n", "", "weight"},
      {"linear mooring", "[[mooring]]\non = [\"m\"]\nkind = \"linear\"\nstiffness = { surge = \"1 kN/m\" }\n", "", "",
       "mooring"},
      {"catenary",
       "[[mooring]]\non = [\"m\"]\nkind = \"catenary\"\nfrom = \"(5, 0, 0) m\"\nto = \"(45, 0, -14) m\"\nlength = \"46 "
       "m\"\nmass_per_length = \"8 "
       "kg/m\"\ndiameter = \"36 mm\"\naxial_stiffness = \"30 MN\"\non_bed = true\n",
       "", "", "mooring.catenary"},
      {"axial connector",
       "[[connector]]\nbetween = [\"m\", \"ground\"]\nends = [\"(6, 0, 0) m\", \"(9, 0, 0) m\"]\nkind = "
       "\"axial\"\nstiffness = \"1 kN/m\"\n",
       "", "", "connector.axial"},
      {"switched connector",
       "[[connector]]\nbetween = [\"m\", \"ground\"]\nends = [\"(6, 0, 0) m\", \"(9, 0, 0) m\"]\nkind = "
       "\"axial\"\nstiffness = \"1 kN/m\"\n"
       "[connector.switch]\nwatch = \"m.surge\"\nevery = \"1 s\"\nwindow = \"2 s\"\nhysteresis = \"0.01 Hz\"\n"
       "settings = [{ from = \"0 s\", stiffness = \"2 kN/m\" }]\n",
       "", "", "connector.switched"},
      {"bushing",
       "[[connector]]\nbetween = [\"m\", \"ground\"]\nends = [\"(6, 0, 0) m\", \"(9, 0, 0) m\"]\nkind = "
       "\"bushing\"\nstiffness = \"(1, 1, 1) kN/m\"\n",
       "", "", "connector.bushing"},
      {"power take-off",
       "[[joint]]\nkind = \"slider\"\nbetween = [\"ground\", \"m\"]\nat = \"(0, 0, 0) m\"\naxis = "
       "\"z\"\n[joint.pto]\ndamping = \"1 kN s/m\"\n",
       "", "", "pto"},
      {"friction",
       "[[joint]]\nkind = \"slider\"\nbetween = [\"ground\", \"m\"]\nat = \"(0, 0, 0) m\"\naxis = \"z\"\nfriction = { "
       "dynamic = \"10 N\" }\n",
       "", "", "friction"},
      {"constant load", "[[load]]\non = [\"m\"]\nat = \"(0, 0, 0) m\"\nforce = \"(1, 0, 0) kN\"\n", "", "", "load"},
      {"drag",
       "[[member]]\non = \"m\"\nfrom = \"(0, 0, -1) m\"\nto = \"(0, 0, 0) m\"\ndiameter = \"1 m\"\ndrag = { cd = 1.0 "
       "}\n",
       "", "", "drag"},
      {"Morison",
       "[[member]]\non = \"m\"\nfrom = \"(0, 0, -1) m\"\nto = \"(0, 0, 0) m\"\ndiameter = \"0.1 m\"\nmorison = { cd = "
       "1.0, ca = 1.0 }\n",
       "", "", "morison"},
      {"contact",
       "[[contact]]\nbetween = [\"m\", \"ground\"]\nkind = \"plane\"\npoints = \"(0, 0, 0) m\"\nat = \"(0, 0, -10) "
       "m\"\nnormal = \"z\"\nrestitution = 0\n",
       "", "", "contact"}};
  return all;
}

std::string scene_with(const Effect* effect) {
  const std::string hydrodynamics = effect != nullptr ? effect->of_water : "";
  return froude_test::water + R"([waves]
kind = "regular"
height = "1 m"
period = "5 s"
heading = "0 deg"
[[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
)" + (effect != nullptr ? effect->of_body : "") +
         (hydrodynamics.empty() ? "" : "[body.hydrodynamics]\nfile = \"pontoon1.nc\"\n" + hydrodynamics) +
         (effect != nullptr ? effect->table : "") + R"([ask]
run = { duration = "1 s", every = "0.1 s" }
accuracy = 1e-2
)";
}

std::map<std::string, std::size_t> evaluated(const Effect* effect) {
  const froude::Run run = simulate(froude_test::parse(scene_with(effect)));
  EXPECT_TRUE(run.stopped.empty()) << run.stopped;
  return {run.evaluations.begin(), run.evaluations.end()};
}

TEST(Effects, OfASceneThatNamesNoneAreNone) { EXPECT_TRUE(evaluated(nullptr).empty()); }

TEST(Effects, AreThoseThatTheSceneNamesAndNoOther) {
  for (const Effect& effect : effects()) {
    SCOPED_TRACE(effect.name);
    const auto counts = evaluated(&effect);
    ASSERT_EQ(counts.size(), 1u);
    EXPECT_EQ(counts.begin()->first, effect.kind);
    EXPECT_GE(counts.begin()->second, 10u) << "once a step at least";
  }
}

// No element is made twice or in vain: as many as the scene has, and their count is what the plan tells.
TEST(Effects, HaveAsManyElementsAsTheSceneNames) {
  for (const Effect& effect : effects()) {
    SCOPED_TRACE(effect.name);
    const auto scene = froude_test::parse(scene_with(&effect));
    const auto model = compile::time_model(scene, compile::prepare(scene));
    ASSERT_EQ(model.model.forces().size(), 1u);
    const bool pieces = effect.kind == std::string("drag") || effect.kind == std::string("morison");
    EXPECT_TRUE(pieces || model.model.forces()[0]->elements() == 1u) << model.model.forces()[0]->elements();
  }
}

// A module that is alike on both sides answers a push in heave with heave alone, and as much as it ever does.
TEST(Excitation, ActsOnTheModesThatTheSceneNames) {
  const auto responses = [](const std::string& modes) {
    return respond(froude_test::parse(froude_test::water + R"([[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
free = ["surge", "heave", "pitch"]
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
)" + modes + R"(radiation = {}
hydrostatics = true
[ask]
rao = { periods = "3 s .. 6 s, 4 values", heading = "0 deg" }
)"));
  };
  const Responses all = responses(""), heave = responses("excitation_modes = \"heave\"\n");
  for (std::size_t i = 0; i < all.omega.size(); ++i) {
    EXPECT_GT(std::abs(all.signal("m.surge").values[i]), 0.1);
    // The data are symmetric to 1e-4 of their largest entries.
    EXPECT_LT(std::abs(heave.signal("m.surge").values[i]), 1e-3);
    EXPECT_LT(std::abs(heave.signal("m.heave").values[i] - all.signal("m.heave").values[i]), 1e-3);
  }
}

}  // namespace
}  // namespace effects_test
