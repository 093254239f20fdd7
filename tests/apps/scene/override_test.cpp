// Numbers of a scene written over by others.
#include "scene/override.hpp"

#include "apps/scene/scenes.hpp"
#include "hydro/base/error.hpp"

namespace froude::scene::override_test {
namespace {

const std::string chains =
    "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"14 m\"\n"
    "[[line]]\nname = \"long\"\nfrom = \"(0, 0, 0) m\"\nlength = \"5 m\"\nsegments = 5\nmass_per_length = \"10 kg/m\"\n"
    "[line.damping]\nlinear = \"2 g/s\"\n"
    "[[line]]\nname = \"short\"\nfrom = \"(1, 2, -3) m\"\nlength = \"2 m\"\nsegments = 2\nmass_per_length = \"10 "
    "kg/m\"\n"
    "[solve.integrator]\nname = \"generalized_alpha\"\nrho_infinity = 0.8\n"
    "[ask]\nrun = { duration = \"2 s\", every = \"0.01 s\" }\n";

Scene with_number(const std::string& path, double value) { return parse_with(chains, "s.toml", {{path, value}}); }

/// The linear damping of each node, kg/s: what a node at one metre a second feels.
double damping_of(const Line& line) {
  return -line.node.share * line.node.forces.at(0)->force({0, {0, 0, 0}, {1, 0, 0}}, nullptr).x();
}

std::string refused(const std::string& path) {
  try {
    number_at(chains, "s.toml", path, {.file = "fit.toml"});
  } catch (const hydro::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << path << " was accepted";
  return {};
}

TEST(Override, ReadsWhatTheSceneWritesInItsOwnUnit) {
  const auto damping = number_at(chains, "s.toml", "line[1].damping.linear", {});
  EXPECT_EQ(damping.value, 2);
  EXPECT_EQ(damping.unit, "g/s");
  EXPECT_EQ(number_at(chains, "s.toml", "line.short.from.z", {}).value, -3);
  EXPECT_EQ(number_at(chains, "s.toml", "solve.integrator.rho_infinity", {}).unit, "");
}

TEST(Override, WritesIntoTheUnitTheVectorOrTheNumberThatIsThere) {
  EXPECT_DOUBLE_EQ(damping_of(with_number("line.long.damping.linear", 7.5e-7).lines[0]), 7.5e-10);
  const Scene moved = with_number("line[2].from.y", 2.5);
  EXPECT_EQ(*moved.lines[1].from.at, Eigen::Vector3d(1, 2.5, -3));
  EXPECT_EQ(*moved.lines[0].from.at, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(with_number("solve.integrator.rho_infinity", 0.5).solve.rho_infinity, 0.5);
}

TEST(Override, OfASceneReadOnceLeavesItForTheNextNumber) {
  const ChangeableScene scene(chains, "s.toml");
  const auto damping = [](const Scene& s) { return damping_of(s.lines[0]); };
  EXPECT_DOUBLE_EQ(damping(scene.with({{"line.long.damping.linear", 3}})), 3e-3);
  EXPECT_DOUBLE_EQ(damping(scene.with({})), 2e-3);
  const Scene both = scene.with({{"line.long.damping.linear", 4}, {"solve.integrator.rho_infinity", 0.5}});
  EXPECT_DOUBLE_EQ(damping(both), 4e-3);
  EXPECT_EQ(both.solve.rho_infinity, 0.5);
  EXPECT_EQ(both.text, chains);
}

TEST(Override, RefusesPathsThatLeadNowhereAndSaysWhereToGo) {
  using testing::HasSubstr;
  EXPECT_THAT(refused("line.damping.linear"), HasSubstr("does not say which line of 2"));
  EXPECT_THAT(refused("line[3].length"), HasSubstr("asks for line 3, of 2"));
  EXPECT_THAT(refused("line[1].damping.linaer"), HasSubstr("did you mean \"linear\"?"));
  EXPECT_THAT(refused("line[1].from"), HasSubstr("a single number is needed"));
  EXPECT_THAT(refused("ask.run.every.x"), HasSubstr("goes on after a value"));
  EXPECT_THAT(refused("line[0].length"), HasSubstr("count tables from 1"));
}

TEST(Override, IsReadLikeAnyNumberOfTheScene) {
  EXPECT_THAT([] { with_number("line[1].length", -1); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("must be positive")));
}

}  // namespace
}  // namespace froude::scene::override_test
