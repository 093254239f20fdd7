// Values of a scene written over by others.
#include "scene/override.hpp"

#include <cstdint>
#include <numbers>

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

// A seed, a word and a quantity with its unit, where the scene writes one and where it does not.
const std::string sea =
    "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n"
    "[waves]\nkind = \"jonswap\"\nhs = \"1 m\"\ntp = \"6 s\"\nseed = 3\n"
    "heading = \"0 deg\"\n"
    "[[probe]]\nname = \"gauge\"\nat = \"(0, 0, 0) m\"\n"
    "[ask]\nwaves = { duration = \"10 s\", every = \"1 s\" }\n";

const RandomSea& sea_with(const std::vector<OverriddenValue>& values, Scene& kept) {
  kept = parse_with(sea, "s.toml", values);
  return std::get<RandomSea>(kept.waves->kind);
}

std::string refused_in_sea(const OverriddenValue& value) {
  try {
    parse_with(sea, "s.toml", {value});
  } catch (const hydro::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << value.path << " was accepted";
  return {};
}

TEST(Override, LeavesAnIntegerAnInteger) {
  Scene scene;
  EXPECT_EQ(sea_with({{"waves.seed", 7}}, scene).seed, 7U);
  EXPECT_EQ(sea_with({{"waves.seed", 8.0}}, scene).seed, 8U);
  constexpr std::int64_t beyond_doubles = (std::int64_t{1} << 53) + 1;
  EXPECT_EQ(sea_with({{"waves.seed", beyond_doubles}}, scene).seed, static_cast<std::uint64_t>(beyond_doubles));
  EXPECT_THAT(refused_in_sea({"waves.seed", 7.5}), testing::HasSubstr("seed = 7.5"));
}

TEST(Override, WritesTextsWholeAndKeysThatWereNotThere) {
  Scene scene;
  EXPECT_DOUBLE_EQ(sea_with({{"waves.hs", std::string("250 cm")}}, scene).systems[0].spectrum->hs(), 2.5);
  sea_with({{"waves.heading", std::string("90 deg")}, {"waves.ramp", std::string("30 s")}}, scene);
  EXPECT_DOUBLE_EQ(scene.waves->heading.radians(), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(scene.waves->ramp, 30);
  sea_with({{"waves.gamma", 1}}, scene);  // the default is 3.3
  const auto& spectrum = *std::get<RandomSea>(scene.waves->kind).systems[0].spectrum;
  EXPECT_DOUBLE_EQ(dynamic_cast<const hydro::waves::PeakedSpectrum&>(spectrum).gamma(), 1);
}

TEST(Override, LeavesTheGrammarToJudgeWhatIsWritten) {
  using testing::HasSubstr;
  EXPECT_THAT(refused_in_sea({"waves.gama", 2}), HasSubstr("did you mean \"gamma\"?"));
  EXPECT_THAT(refused_in_sea({"waves.ramp", 2}), HasSubstr("ramp"));
  EXPECT_THAT(refused_in_sea({"waves.hs", std::string("2 kg")}), HasSubstr("hs = \"2 kg\""));
  EXPECT_THAT(refused_in_sea({"waves.hs", true}), HasSubstr("hs = true"));
  EXPECT_THAT(refused_in_sea({"waves", std::string("none")}), HasSubstr("a single value is needed"));
  EXPECT_THAT(refused_in_sea({"probe.gauge.at.x", std::string("1 m")}), HasSubstr("component of a vector"));
  EXPECT_THAT(refused_in_sea({"wave.hs", 2}), HasSubstr("did you mean \"waves\"?"));
}

}  // namespace
}  // namespace froude::scene::override_test
