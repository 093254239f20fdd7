// What a scene takes of coefficients, and what it has to say where their file does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/compile/scenes.hpp"
#include "compile/compile.hpp"
#include "compile/findings.hpp"
#include "froude/simulate.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/operations.hpp"

namespace hydrodynamics_test {
namespace {

using namespace froude;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::Finding;
using hydro::potential::Severity;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A hemisphere of radius 5 m on a hinge; WAMIT's files tell neither its volume nor its centres.
std::string hinged(const std::string& facts) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
gravity = "9.81 m/s^2"
depth = "infinite"
[[body]]
name = "m"
mass = "200 t"
centre_of_gravity = "(0.5, 0, -2) m"
radii_of_gyration = "(2, 2, 2) m"
[body.hydrodynamics]
file = "hemisphere_r5.1"
reference_point = "(0, 0, 0) m"
hydrostatics = true
)" + facts +
         R"([[joint]]
kind = "hinge"
between = ["ground", "m"]
at = "(8, 0, 0) m"
axis = "y"
[ask]
run = { duration = "1 s", every = "0.1 s" }
)";
}

TEST(Hydrodynamics, OfABodyOnJointsNeedItsVolume) {
  EXPECT_THAT([] { compile::prepare(froude_test::parse(hinged(""))); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.toml:12"), HasSubstr("\"m\" is on joints"),
                                              HasSubstr("displaced_volume"), HasSubstr("centre_of_buoyancy"))));
}

TEST(Hydrodynamics, ActWithTheVolumeAndCentreThatTheSceneStates) {
  const auto prepared = compile::prepare(
      froude_test::parse(hinged("displaced_volume = \"260 m^3\"\ncentre_of_buoyancy = \"(0.1, 0.2, -1.8) m\"\n")));
  ASSERT_EQ(prepared.hydrostatics.size(), 1u);
  const double buoyancy = 1000 * 9.81 * 260;
  EXPECT_NEAR(prepared.hydrostatics[0].lift, buoyancy - 200e3 * 9.81, 1e-6 * buoyancy);
  // (r_b − r_g) × (0, 0, ρgV) = ρgV (r_y, −r_x, 0) with r_b − r_g = (−0.4, 0.2, 0.2) m
  const Eigen::Vector3d expected = buoyancy * Eigen::Vector3d(0.2, 0.4, 0);
  EXPECT_LT((prepared.hydrostatics[0].moment - expected).norm(), 1e-6 * buoyancy);
}

TEST(Hydrodynamics, RefuseAVolumeThatContradictsTheFile) {
  std::string text = hinged("displaced_volume = \"260 m^3\"\n");
  text.replace(text.find("hemisphere_r5.1"), 15, "hemisphere_r5.nc");
  text.erase(text.find("reference_point"), std::string("reference_point = \"(0, 0, 0) m\"\n").size());
  text.replace(text.find("260"), 3, "300");
  EXPECT_THAT([&] { compile::prepare(froude_test::parse(text)); },
              ThrowsMessage<InputError>(HasSubstr("leave out displaced_volume")));
}

Severity gravest(const std::vector<Finding>& findings, const std::string& check) {
  Severity worst = Severity::note;
  for (const Finding& f : findings)
    if (f.check == check) worst = std::max(worst, f.severity);
  return worst;
}

TEST(Findings, AreOfTheBodiesAndModesThatAreTaken) {
  Coefficients c = hydro::potential::read(froude_test::examples / "data/box2.nc");
  c.B[5](7, 7) = -c.B[5].diagonal().maxCoeff();  // sway of the second body
  const std::array<bool, 6> all{true, true, true, true, true, true}, heave{false, false, true, false, false, false};
  ASSERT_EQ(gravest(hydro::potential::check(c), "sign of B"), Severity::error);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {all, all}, true}), "sign of B"), Severity::error);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0}, {all}, true}), "sign of B"), Severity::note);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {heave, heave}, true}), "sign of B"), Severity::note);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {all, all}, false}), "sign of B"), Severity::note);
  // What is taken is judged as before, also where something worse is not taken.
  c.B[5](2, 2) = -c.B[5](2, 2);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0}, {all}, true}), "sign of B"), Severity::error);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {heave, heave}, true}), "sign of B"), Severity::error);
}

}  // namespace
}  // namespace hydrodynamics_test
