#include "apps/scene/scenes.hpp"

namespace froude::scene::connections_test {
namespace {

std::vector<std::string> names(const Scene& scene) {
  std::vector<std::string> out;
  for (const auto& c : scene.connectors) out.push_back(c.name);
  return out;
}

/// The pontoons with another connector table.
std::string connected(const std::string& lines) {
  const auto from = pontoons.find("[[connector]]"), to = pontoons.find("[ask]");
  return pontoons.substr(0, from) + lines + "\n" + pontoons.substr(to);
}

const std::string axial = "kind = \"axial\"\nstiffness = \"1 kN/m\"\n";

TEST(SceneMembers, TakesEndsInPairsOnEachBodyOfThePattern) {
  const Scene scene = parse(pontoons, "scene.toml");
  ASSERT_EQ(scene.members.size(), 20u);
  EXPECT_EQ(scene.members[0].name, "member1");
  EXPECT_EQ(scene.members[19].name, "member20");
  for (const Member& m : scene.members) {
    EXPECT_EQ(m.to - m.from, Eigen::Vector3d(0, 0, 1.13)) << m.name;
    EXPECT_EQ(m.diameter, 1.6);
    EXPECT_EQ(m.cd, 1);
  }
  EXPECT_EQ(scene.members[4].body, 1);
  EXPECT_EQ(scene.members[5].from, Eigen::Vector3d(-5.2, 5.2, -1.13));
}

TEST(SceneMembers, RefusesWhatIsNoCylinder) {
  EXPECT_THAT(refusal(with(pontoons, "to = \"(±5.2, ±5.2, 0) m\"", "to = \"(±5.2, 5.2, 0) m\"")),
              AllOf(StartsWith("scene.toml:26:6: "), HasSubstr("stands for 2 points and from for 4")));
  EXPECT_THAT(refusal(with(pontoons, "±5.2, 0) m", "±5.2, -1.13) m")), HasSubstr("is the same point as from"));
  EXPECT_THAT(refusal(with(pontoons, "drag = { cd = 1.0 }\n", "")),
              AllOf(StartsWith("scene.toml:23:1: error: [[member]] "), HasSubstr("drag"), HasSubstr("slamming")));
  EXPECT_THAT(refusal(with(pontoons, "on = \"m*\"", "on = \"n*\"")),
              AllOf(StartsWith("scene.toml:24:6: error: [[member]] refers to \"n*\", but there is no such body"),
                    HasSubstr("did you mean \"m1\"?")));
}

TEST(SceneMoorings, FillsASymmetricMatrix) {
  const auto text = with(pontoons, "yaw = \"15839 N m/rad\" }",
                         "surge_pitch = \"-12 N\", yaw = \"15839 N m\" }\ndamping = { surge = \"2 kN s/m\" }");
  const Scene scene = parse(text, "scene.toml");
  ASSERT_EQ(scene.moorings.size(), 2u);
  EXPECT_EQ(scene.moorings[0].name, "mooring1");
  EXPECT_EQ(scene.moorings[1].body, 4);
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  expected(0, 0) = 4280, expected(1, 1) = 10348, expected(5, 5) = 15839, expected(0, 4) = expected(4, 0) = -12;
  EXPECT_EQ(scene.moorings[1].stiffness, expected);
  EXPECT_EQ(scene.moorings[1].damping(0, 0), 2000);
  EXPECT_EQ(scene.moorings[1].damping.norm(), 2000);
}

TEST(SceneMoorings, RefusesWhatPushesAwayOrDrives) {
  EXPECT_THAT(refusal(with(pontoons, "\"4280 N/m\"", "\"-4280 N/m\"")),
              AllOf(StartsWith("scene.toml:32:23: "), HasSubstr("surge = \"-4280 N/m\" is negative")));
  EXPECT_THAT(refusal(with(pontoons, "\"4280 N/m\"", "\"0 N/m\"")), HasSubstr("is zero"));
  EXPECT_THAT(refusal(with(pontoons, "\"4280 N/m\"", "\"4280 N s/m\"")),
              HasSubstr("is a damping; a stiffness is needed"));
  EXPECT_THAT(refusal(with(pontoons, "surge = \"4280 N/m\"", "surge_pitch = \"4280 N/m\"")),
              HasSubstr("a stiffness between translation and rotation is needed"));
  // a_b² <= a·b: 3² > 2·4, so some motion would be driven; 2.8² < 2·4 is allowed
  EXPECT_THAT(
      refusal(
          with(pontoons, "stiffness = { surge",
               "damping = { surge = \"2 N s/m\", sway = \"4 N s/m\", surge_sway = \"3 N s/m\" }\nstiffness = { surge")),
      AllOf(StartsWith("scene.toml:32:11: "), HasSubstr("[mooring.damping] gives power to some motion")));
  EXPECT_NO_THROW(parse(
      with(pontoons, "stiffness = { surge",
           "damping = { surge = \"2 N s/m\", sway = \"4 N s/m\", surge_sway = \"2.8 N s/m\" }\nstiffness = { surge"),
      "scene.toml"));
  EXPECT_THAT(
      refusal(
          with(pontoons, "stiffness = { surge = \"4280 N/m\", sway = \"10348 N/m\", yaw = \"15839 N m/rad\" }\n", "")),
      StartsWith("scene.toml:29:1: error: [[mooring]] of kind \"linear\" needs at least one of stiffness, damping"));
  EXPECT_THAT(refusal(with(pontoons, "\"m5\"]", "\"m6\"]")),
              AllOf(StartsWith("scene.toml:30:13: "), HasSubstr("refers to \"m6\"")));
}

TEST(SceneConnectors, JoinsNeighboursPairByPair) {
  const Scene scene = parse(pontoons, "scene.toml");
  ASSERT_EQ(scene.connectors.size(), 8u);
  EXPECT_EQ(scene.connectors[0].name, "connector1");
  EXPECT_EQ(scene.connectors[7].name, "connector8");
  const Connector& c = scene.connectors[3];  // second of the gap m2–m3
  EXPECT_EQ(c.first, 1);
  EXPECT_EQ(c.second, 2);
  EXPECT_EQ(c.first_end, Eigen::Vector3d(6, -5, 0.5));
  EXPECT_EQ(c.second_end, Eigen::Vector3d(-6, -5, 0.5));
  const auto& kind = std::get<AxialConnector>(c.kind);
  EXPECT_EQ(kind.stiffness, 29332);
  EXPECT_EQ(kind.damping, 0);
  EXPECT_FALSE(kind.rest_length);
}

TEST(SceneConnectors, AreNumberedOverTheWholeFile) {
  const std::string ends = "ends = [\"(6, 0, 0) m\", \"(-6, 0, 0) m\"]\n";
  const auto table = [&](const std::string& lines) { return "[[connector]]\n" + lines + ends + axial; };
  const Scene scene =
      parse(connected(table("between = [\"m1\", \"m2\"]\n") + table("name = \"hinge\"\nbetween = [\"m2\", \"m3\"]\n") +
                      table("name = \"row\"\nbetween = \"neighbours of m\"\n") + table("between = [\"m4\", \"m5\"]\n")),
            "scene.toml");
  EXPECT_EQ(names(scene),
            (std::vector<std::string>{"connector1", "hinge", "row1", "row2", "row3", "row4", "connector2"}));
  EXPECT_THAT(refusal(connected(table("between = [\"m1\", \"m2\"]\n") +
                                table("name = \"connector1\"\nbetween = [\"m2\", \"m3\"]\n"))),
              HasSubstr("the name \"connector1\" is taken at scene.toml:33:1"));
}

TEST(SceneConnectors, AreOneGapFewerThanCopies) {
  for (const std::size_t copies : {1u, 2u, 5u}) {
    const std::string counted = with(pontoons, "count = 5", fmt::format("count = {}", copies));
    const Scene scene = parse(with(counted, "[\"m1\", \"m5\"]", "\"m1\""), "scene.toml");
    EXPECT_EQ(scene.connectors.size(), 2 * (copies - 1));  // two in each gap
  }
}

/// Two rows of three modules.
std::string grid(const std::string& between) {
  const std::string rows = with(pontoons, "count = 5, step = \"(13, 0, 0) m\"",
                                "count = 3, step = \"(13, 0, 0) m\", rows = 2, row_step = \"(1, 14, 0) m\"");
  return with(with(rows, "[\"m1\", \"m5\"]", "[\"m1_1\", \"m2_3\"]"), "\"neighbours of m\"", between);
}

TEST(SceneBodies, MayStandInAGrid) {
  const Scene scene = parse(grid("\"neighbours of m\""), "scene.toml");
  ASSERT_EQ(scene.bodies.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t row = i / 3, in_row = i % 3;
    EXPECT_EQ(scene.bodies[i].name, fmt::format("m{}_{}", row + 1, in_row + 1));
    EXPECT_EQ(scene.bodies[i].copy, static_cast<int>(i) + 1);  // bodies of a file follow row by row
    const auto r = static_cast<double>(row), c = static_cast<double>(in_row);
    EXPECT_EQ(scene.bodies[i].position, Eigen::Vector3d(13 * c + r, 14 * r, 0));
  }
  // Two in each gap within a row, none from the end of one row to the beginning of the next.
  ASSERT_EQ(scene.connectors.size(), 8u);
  for (const Connector& c : scene.connectors) EXPECT_EQ(*c.second, c.first + 1);
  EXPECT_EQ(scene.connectors[3].first, 1);
  EXPECT_EQ(scene.connectors[4].first, 3);
}

TEST(SceneBodies, RefuseAGridThatIsNone) {
  EXPECT_THAT(refusal(with(grid("\"neighbours of m\""), ", row_step = \"(1, 14, 0) m\"", "")), HasSubstr("row_step"));
  EXPECT_THAT(refusal(with(grid("\"neighbours of m\""), "rows = 2, ", "")), HasSubstr("rows"));
  EXPECT_THAT(refusal(with(grid("\"neighbours of m\""), "rows = 2", "rows = 0")), HasSubstr("rows"));
  EXPECT_THAT(refusal(with(grid("\"neighbours of m\""), "rows = 2", "rows = 90000")),
              HasSubstr("makes more than 100000 bodies"));
}

TEST(SceneConnectors, PairRowsBodyByBody) {
  const Scene scene = parse(grid("[\"m1_*\", \"m2_*\"]"), "scene.toml");
  ASSERT_EQ(scene.connectors.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(scene.connectors[i].first, static_cast<int>(i / 2));
    EXPECT_EQ(*scene.connectors[i].second, static_cast<int>(i / 2) + 3);
  }
  EXPECT_THAT(refusal(grid("[\"m1_*\", \"m*\"]")),
              AllOf(StartsWith("scene.toml:34:11: "), HasSubstr("\"m1_*\" names 3 and \"m*\" names 6")));
  EXPECT_THAT(refusal(grid("[\"m1_*\", \"m1*\"]")), HasSubstr("pairs \"m1_1\" with itself"));
  EXPECT_THAT(refusal(grid("[\"m1_*\", \"ground\"]")), HasSubstr("pairs a row with the ground"));
  EXPECT_THAT(refusal(grid("[\"m1_*\", \"k*\"]")), HasSubstr("refers to \"k*\", but there is no such body"));
}

TEST(SceneConnectors, ReachTheGroundInGlobalAxes) {
  const Scene scene = parse(
      connected("[[connector]]\nbetween = [\"m1\", \"ground\"]\nends = [\"(-6, 0, 0) m\", \"(-50, 0, -14) m\"]\n" +
                axial + "rest_length = \"40 m\""),
      "scene.toml");
  EXPECT_FALSE(scene.connectors.at(0).second);
  EXPECT_EQ(scene.connectors[0].second_end, Eigen::Vector3d(-50, 0, -14));
  EXPECT_EQ(std::get<AxialConnector>(scene.connectors[0].kind).rest_length, 40);
}

TEST(SceneConnectors, MayBeBushings) {
  const std::string lines =
      "[[connector]]\nbetween = [\"m1\", \"m2\"]\nends = [\"(6.5, 0, 0) m\", \"(-6.5, 0, 0) m\"]\nkind = \"bushing\"\n";
  const Scene scene = parse(
      connected(lines + "stiffness = \"(1, 2, 0) kN/m\"\nrotational_damping = \"(0, 3, 0) N m s/rad\""), "scene.toml");
  const auto& bushing = std::get<dynamics::BushingConnector>(scene.connectors.at(0).kind);
  EXPECT_EQ(bushing.stiffness, Eigen::Vector3d(1000, 2000, 0));
  EXPECT_EQ(bushing.damping, Eigen::Vector3d::Zero());
  EXPECT_EQ(bushing.rotational_damping, Eigen::Vector3d(0, 3, 0));
  EXPECT_THAT(refusal(connected(lines)),
              HasSubstr("needs at least one of stiffness, damping, rotational_stiffness, rotational_damping"));
  EXPECT_THAT(refusal(connected(lines + "damping = \"(0, 0, 0) N s/m\"")),
              AllOf(StartsWith("scene.toml:37:11: "), HasSubstr("is zero throughout")));
  EXPECT_THAT(refusal(connected(lines + "damping = \"(0, -1, 0) N s/m\"")), HasSubstr("must not be negative"));
}

TEST(SceneConnectors, RefuseEndsThatDoNotFit) {
  const auto between = [](const std::string& value) { return with(pontoons, "\"neighbours of m\"", value); };
  EXPECT_THAT(refusal(between("[\"m1\", \"m7\"]")),
              AllOf(StartsWith("scene.toml:34:18: error: [[connector]] refers to \"m7\", but there is no such body"),
                    HasSubstr("did you mean \"m1\"?")));
  EXPECT_THAT(refusal(between("[\"m1\", \"groud\"]")), HasSubstr("did you mean \"ground\"?"));
  EXPECT_THAT(refusal(between("[\"m1\", \"m1\"]")), HasSubstr("stands twice in this list"));
  EXPECT_THAT(refusal(between("[\"ground\", \"m1\"]")), HasSubstr("write the body first"));
  EXPECT_THAT(refusal(between("\"m1\"")), HasSubstr("does not name two ends"));
  EXPECT_THAT(refusal(between("\"neighbours of n\"")),
              AllOf(StartsWith("scene.toml:34:11: "), HasSubstr("did you mean \"neighbours of m\"?")));
  EXPECT_THAT(refusal(with(pontoons, "\"(-6, ±5, 0.5) m\"", "\"(-6, 5, 0.5) m\"")),
              AllOf(StartsWith("scene.toml:35:8: "), HasSubstr("stands for 2 and 1 points")));
  EXPECT_THAT(refusal(with(pontoons, "\"(6, ±5, 0.5) m\", ", "")), HasSubstr("is not a list of two points"));
  EXPECT_THAT(refusal(with(pontoons, "(6, ±5, 0.5) m", "(7, ±5, 0.5) m")),
              AllOf(StartsWith("scene.toml:35:8: "), HasSubstr("of \"connector1\" coincide at (7, 5, 0.5) m"),
                    HasSubstr("bushing")));
}

TEST(SceneConnectors, NeedStiffnessOrDamping) {
  EXPECT_THAT(refusal(with(pontoons, "stiffness = \"29332 N/m\"\nrest_length = \"as placed\"\n", "")),
              HasSubstr("[[connector]] of kind \"axial\" needs at least one of stiffness, damping"));
  EXPECT_THAT(refusal(with(pontoons, "stiffness = \"29332 N/m\"", "damping = \"1 N s/m\"")),
              HasSubstr("rest_length acts only beside \"stiffness\""));
}

}  // namespace
}  // namespace froude::scene::connections_test
