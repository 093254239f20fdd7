#include <filesystem>
#include <fstream>

#include "apps/scene/scenes.hpp"
#include "scene/element.hpp"
#include "support/scratch.hpp"

namespace froude::scene::joints_test {
namespace {

/// The pontoons with joints in place of the connector.
std::string jointed(const std::string& lines) {
  const auto from = pontoons.find("[[connector]]"), to = pontoons.find("[ask]");
  return with(pontoons.substr(0, from) + lines + "\n" + pontoons.substr(to), ", \"connector*.force\"", "");
}

const std::string hinges =
    "[[joint]]\nname = \"hinge\"\nkind = \"hinge\"\nbetween = \"neighbours of m\"\nat = \"(6.5, 0, 0.5) m\"\naxis = "
    "\"y\"\n";

TEST(SceneJoints, StandBetweenNeighboursAsTheBodiesDo) {
  const Scene scene = parse(jointed(hinges), "scene.toml");
  ASSERT_EQ(scene.joints.size(), 4u);
  EXPECT_EQ(scene.joints[3].name, "hinge4");
  EXPECT_EQ(scene.joints[3].first, 3);
  EXPECT_EQ(scene.joints[3].second, 4);
  EXPECT_EQ(scene.joints[3].at, Eigen::Vector3d(6.5 + 3 * 13, 0, 0.5));
  EXPECT_EQ(scene.joints[3].axis, Eigen::Vector3d::UnitY());
}

TEST(SceneJoints, TakeTheGroundAtEitherEndAndAnyDirection) {
  const Scene scene = parse(
      jointed(
          "[[joint]]\nkind = \"slider\"\nbetween = [\"ground\", \"m1\"]\nat = \"(0, 0, 0) m\"\naxis = \"(1, 0, 2)\"\n"),
      "scene.toml");
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_EQ(scene.joints[0].first, std::nullopt);
  EXPECT_EQ(scene.joints[0].second, 0);
  EXPECT_EQ(scene.joints[0].axis, Eigen::Vector3d(1, 0, 2));
}

TEST(SceneJoints, HaveFrictionWithTwoLevels) {
  const auto with_friction = [](const std::string& table) { return jointed(hinges + "friction = " + table + "\n"); };
  const Scene scene = parse(with_friction("{ static = \"3.7 N m\", dynamic = \"3 N m\" }"), "scene.toml");
  EXPECT_EQ(scene.joints[2].friction->breakaway, 3.7);
  EXPECT_EQ(scene.joints[2].friction->sliding, 3);
  EXPECT_EQ(parse(with_friction("{ dynamic = \"3 N m\" }"), "scene.toml").joints[0].friction->breakaway, 3);
  EXPECT_THAT(refusal(with_friction("{ static = \"2 N m\", dynamic = \"3 N m\" }")),
              HasSubstr("below the dynamic level"));
  EXPECT_THAT(refusal(with_friction("{ dynamic = \"3 N\" }")), HasSubstr("moment"));
  const std::string falling = "{ static = \"3.7 N m\", dynamic = \"3 N m\", stribeck = \"6 deg/s\" }";
  EXPECT_DOUBLE_EQ(parse(with_friction(falling), "scene.toml").joints[0].friction->stribeck.value(),
                   std::numbers::pi / 30);
  EXPECT_THAT(refusal(with_friction("{ dynamic = \"3 N m\", stribeck = \"6 deg/s\" }")), HasSubstr("changes nothing"));
}

TEST(SceneRun, StartsInEquilibriumOnlyIfNothingElseIsSaid) {
  const std::string asked = with(pontoons, "every = \"0.05 s\"", "every = \"0.05 s\", start = \"equilibrium\"");
  EXPECT_THAT(refusal(asked), HasSubstr("places a body that is to begin in equilibrium"));
  EXPECT_TRUE(parse(with(asked, "initial = { heave = \"10 cm\", pitch = \"5 deg\" }\n", ""), "scene.toml")
                  .run->from_equilibrium);
}

TEST(SceneJoints, RefuseWhatCannotBeAJoint) {
  EXPECT_THAT(refusal(jointed(with(hinges, "\"y\"", "\"w\""))), HasSubstr("\"(1, 0, 1)\""));
  EXPECT_THAT(refusal(jointed(with(hinges, "\"y\"", "\"(0, 0, 0)\""))), HasSubstr("has no direction"));
  EXPECT_THAT(refusal(jointed(with(hinges, "axis = \"y\"\n", ""))), HasSubstr("needs the key \"axis\""));
  EXPECT_THAT(refusal(jointed(with(hinges, "\"neighbours of m\"", "[\"m1\", \"m1\"]"))), HasSubstr("stands twice"));
  EXPECT_THAT(refusal(jointed(with(hinges, "kind = \"hinge\"", "kind = \"weld\""))), HasSubstr("fixed"));
  EXPECT_THAT(refusal(jointed(with(with(hinges, "kind = \"hinge\"", "kind = \"universal\""), "axis = \"y\"",
                                   "axis = \"y\"\nsecond_axis = \"(0, 1, 1)\""))),
              AllOf(HasSubstr("45 degrees off a right angle"), HasSubstr("second_axis")));
}

TEST(SceneJoints, RefuseABodyThatMayOnlyTurnAboutItsCentre) {
  std::string text = with(jointed(hinges), "radii_of_gyration", "free = [\"pitch\"]\nradii_of_gyration");
  text = with(text, "initial = { heave = \"10 cm\", pitch = \"5 deg\" }\n", "");
  EXPECT_THAT(refusal(text),
              AllOf(HasSubstr("may turn about its centre of gravity only"), HasSubstr("free the translations")));
}

}  // namespace
TEST(JointsOfAScene, AreLedByASineOrARecord) {
  const auto with = [](const std::string& keys) { return jointed(hinges + keys + "\n"); };
  const JointPrescribedMotion motion =
      parse(with("prescribed = { amplitude = \"5 deg\", period = \"2 s\" }"), "scene.toml")
          .joints[1]
          .prescribed.value();
  EXPECT_DOUBLE_EQ(motion.amplitude, std::numbers::pi / 36);
  EXPECT_DOUBLE_EQ(motion.omega, std::numbers::pi);
  EXPECT_EQ(motion.ramp, 0);
  EXPECT_THAT(refusal(with("prescribed = { amplitude = \"5 deg\" }")), HasSubstr("period"));
  EXPECT_THAT(refusal(with("prescribed = { period = \"5 s\" }")), HasSubstr("amplitude"));
  EXPECT_THAT(refusal(with("prescribed = { amplitude = \"5 m\", period = \"2 s\" }")), HasSubstr("angle"));
  EXPECT_THAT(
      refusal(with("prescribed = { amplitude = \"5 deg\", period = \"2 s\" }\nfriction = { dynamic = \"3 N m\" }")),
      HasSubstr("neither sticks nor slips"));
}

TEST(JointsOfAScene, HaveASpringByATable) {
  const auto path = support::scratch_folder() / "spring_of_a_joint.csv";
  const auto scene_with = [&](const std::string& rows) {
    std::ofstream(path) << "angle [deg],moment [N m]\n" << rows;
    return jointed(hinges + "spring = { file = \"" + path.filename().string() + "\" }\n");
  };
  const auto read = [&](const std::string& rows) { return parse(scene_with(rows), path.parent_path() / "scene.toml"); };
  const Scene scene = read("-90,100\n0,0\n90,50\n");
  ASSERT_EQ(scene.elements.size(), 1u);
  EXPECT_EQ(scene.elements[0]->table(), "joint.spring");
  EXPECT_EQ(scene.elements[0]->count(), 4u);  // one for each of the hinges
  EXPECT_THAT([&] { read("0,0\n0,5\n"); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("has the angle 0 after 0")));
  EXPECT_THAT([&] { read("0,0\n"); }, testing::ThrowsMessage<hydro::InputError>(HasSubstr("fewer than two points")));
  std::filesystem::remove(path);
}

TEST(JointsOfAScene, MayLatch) {
  const auto with = [](const std::string& keys) { return jointed(hinges + keys + "\n"); };
  const Pto pto = parse(with("pto = { latch = { hold = \"1.5 s\" } }"), "scene.toml").joints[0].pto.value();
  EXPECT_EQ(pto.latch, 1.5);
  EXPECT_FALSE(pto.has_force());
  EXPECT_THAT(refusal(with("pto = { latch = { hold = \"1.5 s\" } }\nfriction = { dynamic = \"3 N m\" }")),
              HasSubstr("two would hold one coordinate"));
  EXPECT_THAT(refusal(with("pto = { latch = { hold = \"0 s\" } }")), HasSubstr("hold"));
}

}  // namespace froude::scene::joints_test
