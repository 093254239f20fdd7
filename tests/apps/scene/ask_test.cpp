#include <algorithm>
#include <numbers>

#include "apps/scene/scenes.hpp"

namespace froude::scene::ask_test {
namespace {

TEST(SceneAsk, TurnsPeriodsIntoIncreasingFrequencies) {
  const AskRao rao = *parse(pontoons, "scene.toml").rao;
  ASSERT_EQ(rao.omega.size(), 61u);
  EXPECT_DOUBLE_EQ(rao.omega.front(), 2 * std::numbers::pi / 8);
  EXPECT_DOUBLE_EQ(rao.omega.back(), 2 * std::numbers::pi / 2);
  EXPECT_TRUE(std::is_sorted(rao.omega.begin(), rao.omega.end()));
  const auto text = with(pontoons, "periods = \"2 s .. 8 s, 61 values\"", "omega = \"0.1 Hz .. 0.2 Hz, 2 values\"");
  EXPECT_DOUBLE_EQ(parse(text, "scene.toml").rao->omega.front(), 0.2 * std::numbers::pi);
}

TEST(SceneAsk, TakesOneValueForARange) {
  const AskRao rao =
      *parse(with(pontoons, "periods = \"2 s .. 8 s, 61 values\"", "periods = \"5 s\""), "scene.toml").rao;
  ASSERT_EQ(rao.omega.size(), 1u);
  EXPECT_DOUBLE_EQ(rao.omega[0], 2 * std::numbers::pi / 5);
  EXPECT_THAT(refusal(with(pontoons, "periods = \"2 s .. 8 s, 61 values\"", "periods = \"5 m\"")),
              HasSubstr("is a length"));
  EXPECT_THAT(refusal(with(pontoons, "periods = \"2 s .. 8 s, 61 values\"", "periods = \"0 s\"")),
              HasSubstr("must be positive"));
}

TEST(SceneAsk, RefusesRangesThatAreNone) {
  const auto range = [](const std::string& value) {
    return with(pontoons, "periods = \"2 s .. 8 s, 61 values\"", value);
  };
  EXPECT_THAT(refusal(range("periods = \"2 s - 8 s, 61 values\"")),
              AllOf(StartsWith("scene.toml:40:19: "), HasSubstr("is not a range of values")));
  EXPECT_THAT(refusal(range("periods = \"2 m .. 8 m, 61 values\"")),
              HasSubstr("\"2 m\" is a length; a time is needed"));
  EXPECT_THAT(refusal(range("periods = \"0 s .. 8 s, 9 values\"")), HasSubstr("must be positive"));
  EXPECT_THAT(refusal(range("periods = \"8 s .. 2 s, 9 values\"")), HasSubstr("does not increase"));
  EXPECT_THAT(refusal(range("periods = \"2 s .. 8 s, 2000000000 values\"")), HasSubstr("at most a million"));
  EXPECT_THAT(refusal(range("periods = \"2 s .. 8 s, 9 values\", omega = \"1 rad/s .. 2 rad/s, 2 values\"")),
              HasSubstr("may hold only one of periods, omega"));
  EXPECT_THAT(refusal(with(pontoons, "periods = \"2 s .. 8 s, 61 values\", ", "")),
              HasSubstr("[ask.rao] needs one of periods, omega"));
}

TEST(SceneAsk, TakesTheHeadingOfTheWavesForAnRao) {
  const Scene scene = parse(pontoons, "scene.toml");
  ASSERT_EQ(scene.rao->headings.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.rao->headings[0], std::numbers::pi / 6);
  const auto own = parse(with(pontoons, "rao = {", "rao = { heading = \"45 deg\","), "scene.toml");
  EXPECT_DOUBLE_EQ(own.rao->headings.at(0), std::numbers::pi / 4);
  const auto from = pontoons.find("[waves]"), to = pontoons.find("[[body]]"), run = pontoons.find("run = ");
  const std::string calm = pontoons.substr(0, from) + pontoons.substr(to, run - to);
  EXPECT_THAT(refusal(calm),
              AllOf(StartsWith("scene.toml:35:7: error: [ask.rao] needs a heading"), HasSubstr("add heading")));
  EXPECT_NO_THROW(parse(with(calm, "rao = {", "rao = { heading = \"45 deg\","), "scene.toml"));
}

/// The pontoons with these headings in [ask.rao].
std::string with_headings(const std::string& value) {
  return with(pontoons, "rao = {", "rao = { headings = " + value + ",");
}

TEST(SceneAsk, TakesHeadingsAsARangeOrAList) {
  const double degree = std::numbers::pi / 180;
  const AskRao range = *parse(with_headings("\"0 deg .. 180 deg, 13 values\""), "scene.toml").rao;
  ASSERT_EQ(range.headings.size(), 13u);
  for (std::size_t h = 0; h < 13; ++h) EXPECT_NEAR(range.headings[h], 15 * degree * static_cast<double>(h), 1e-15);
  EXPECT_EQ(range.headings_place.line, 40);
  const Scene list = parse(with_headings("[\"90 deg\", \"-0.5 rad\", \"0 deg\"]"), "scene.toml");
  EXPECT_THAT(list.rao->headings, testing::ElementsAre(testing::DoubleEq(90 * degree), -0.5, 0)) << "as asked";
  const auto told = std::find_if(list.echo.begin(), list.echo.end(),
                                 [](const Echo& e) { return e.key.starts_with("ask.rao.heading"); });
  ASSERT_NE(told, list.echo.end());
  EXPECT_EQ(told->key + " = " + told->value, "ask.rao.headings = [90 deg, -0.5 rad, 0 deg]");
  const std::string table = "[ask.rao]\nperiods = \"2 s .. 8 s, 4 values\"\nheadings = [\"10 deg\"]\n";
  const std::string inline_rao =
      pontoons.substr(pontoons.find("rao = {"), pontoons.find("run = {") - pontoons.find("rao = {"));
  EXPECT_EQ(parse(with(pontoons, inline_rao, "") + table, "scene.toml").rao->headings.size(), 1u);
}

TEST(SceneAsk, RefusesHeadingsThatAreNone) {
  EXPECT_THAT(refusal(with_headings("[]")),
              AllOf(StartsWith("scene.toml:40:20: error: [ask.rao] headings = [] is empty"),
                    HasSubstr("write at least one, or leave the key out")));
  EXPECT_THAT(refusal(with_headings("[\"0 deg\", \"90 deg\", \"1.5707963 rad\"]")),
              AllOf(StartsWith("scene.toml:40:40: error: [ask.rao] headings = \"1.5707963 rad\" stands twice"),
                    HasSubstr("first as \"90 deg\""), HasSubstr("keep one")));
  EXPECT_THAT(refusal(with_headings("[\"0 deg\", \"0 rad\"]")), HasSubstr("stands twice"));
  EXPECT_THAT(refusal(with_headings("[\"0 deg\", 90]")), HasSubstr("90 has no unit; an angle is needed"));
  EXPECT_THAT(refusal(with_headings("\"45 deg\"")),
              AllOf(HasSubstr("is not a range of values"), HasSubstr("or as a list like [\"22.5 deg\"]")));
  EXPECT_THAT(refusal(with_headings("45")), HasSubstr("is an integer; a range of values, or a list of quantities"));
  EXPECT_THAT(refusal(with_headings("\"90 deg .. 0 deg, 4 values\"")), HasSubstr("does not increase"));
  EXPECT_THAT(refusal(with_headings("\"0 m .. 90 m, 4 values\"")),
              HasSubstr("\"0 m\" is a length; an angle is needed"));
  EXPECT_THAT(refusal(with_headings("[\"0 deg\"], heading = \"0 deg\"")),
              HasSubstr("may hold only one of heading, headings"));
  EXPECT_THAT(refusal(with(with_headings("[\"0 deg\", \"90 deg\"]"), "excitation = true\n", "")),
              AllOf(StartsWith("scene.toml:39:7: error: [ask.rao] asks how bodies answer waves"),
                    HasSubstr("excitation = true")));
}

TEST(SceneAsk, WantsWavesForExcitationInARun) {
  const auto from = sphere.find("[waves]"), to = sphere.find("[[body]]");
  const std::string calm = sphere.substr(0, from) + sphere.substr(to);
  EXPECT_THAT(refusal(calm),
              AllOf(StartsWith("scene.toml:12:14: error: [body.hydrodynamics] excitation = true needs waves for a run"),
                    HasSubstr("[waves]")));
  EXPECT_NO_THROW(parse(with(calm, "excitation = true\n", ""), "scene.toml"));
}

TEST(SceneAsk, WantsExcitationForAnRao) {
  EXPECT_THAT(refusal(with(pontoons, "excitation = true\n", "")),
              AllOf(StartsWith("scene.toml:39:7: error: [ask.rao] asks how bodies answer waves"),
                    HasSubstr("excitation = true")));
}

TEST(SceneAsk, AsksForSomething) {
  EXPECT_THAT(refusal(with(sphere, "run = { duration = \"40 s\", every = \"0.02 s\" }\n", "")),
              StartsWith("scene.toml:20:1: error: [ask] needs at least one of rao, modes, stability, field, run"));
}

TEST(SceneAsk, RunsAWholeNumberOfSamples) {
  const AskRun run = *parse(sphere, "scene.toml").run;
  EXPECT_EQ(run.duration, 40);
  EXPECT_EQ(run.every, 0.02);
  EXPECT_THAT(
      refusal(with(sphere, "\"40 s\"", "\"40.01 s\"")),
      AllOf(StartsWith("scene.toml:21:20: "), HasSubstr("is 2000.5 times every = \"0.02 s\"; a whole number is needed"),
            HasSubstr("write duration = \"40.02 s\"")));
  EXPECT_THAT(refusal(with(sphere, "\"40 s\"", "\"0.01 s\"")), HasSubstr("write duration = \"0.02 s\""));
  EXPECT_NO_THROW(parse(with(sphere, "\"0.02 s\"", "\"0.1 s\""), "scene.toml"));  // 0.1 is not a binary fraction
}

TEST(SceneAsk, LeavesTheListOfSignalsEmptyForEverything) {
  EXPECT_TRUE(parse(sphere, "scene.toml").run->of.empty());
  EXPECT_EQ(parse(with(sphere, "\"0.02 s\" }", "\"0.02 s\", of = \"sphere.heave\" }"), "scene.toml").run->of,
            std::vector<std::string>{"sphere.heave"});
}

// (D132)
TEST(SceneSolve, TakesNoMemoryWhereSomethingActsOneWayOnly) {
  const std::string cable = sphere +
                            "[[connector]]\nbetween = [\"sphere\", \"ground\"]\nkind = \"cable\"\n"
                            "ends = [\"(0, 0, 0) m\", \"(0, 0, 9) m\"]\nstiffness = \"1 kN/m\"\n";
  EXPECT_FALSE(acts_one_way(parse(sphere, "scene.toml")));
  EXPECT_TRUE(acts_one_way(parse(cable, "scene.toml")));
  EXPECT_EQ(parse(cable, "scene.toml").solve.rho_infinity, 0);
  EXPECT_EQ(parse(cable + "[solve]\nintegrator = { rho_infinity = 0.5 }\n", "scene.toml").solve.rho_infinity, 0.5);
  EXPECT_EQ(parse(with(cable, "\"cable\"", "\"axial\""), "scene.toml").solve.rho_infinity, 0.8);
}

TEST(SceneSolve, ChoosesUnlessOverridden) {
  const Solve chosen = parse(sphere, "scene.toml").solve;
  EXPECT_FALSE(chosen.step);
  EXPECT_EQ(chosen.rho_infinity, 0.8);
  const Solve given =
      parse(sphere + "[solve]\nstep = \"10 ms\"\nintegrator = { name = \"generalized_alpha\", rho_infinity = 1 }\n",
            "scene.toml")
          .solve;
  EXPECT_EQ(given.step->value, 0.01);
  EXPECT_EQ(given.step->place.line, 23);
  EXPECT_EQ(given.rho_infinity, 1);
  EXPECT_THAT(refusal(sphere + "[solve]\nstep = \"0 s\"\n"),
              AllOf(StartsWith("scene.toml:23:8: "), HasSubstr("must be positive")));
  EXPECT_THAT(refusal(sphere + "[solve]\nintegrator = { rho_infinity = 1.1 }\n"), HasSubstr("must lie from 0 to 1"));
  EXPECT_THAT(refusal(sphere + "[solve]\nintegrator = { name = \"euler\" }\n"),
              HasSubstr("is not one of generalized_alpha"));
}

TEST(SceneWaves, KeepsAmplitudeNotHeight) {
  EXPECT_EQ(std::get<RegularWave>(parse(sphere, "scene.toml").waves->kind).amplitude, 1);
  EXPECT_EQ(std::get<RegularWave>(parse(with(sphere, "height", "amplitude"), "scene.toml").waves->kind).amplitude, 2);
  const Waves jonswap = *parse(pontoons, "scene.toml").waves;
  const RandomSea& sea = std::get<RandomSea>(jonswap.kind);
  ASSERT_EQ(sea.systems.size(), 1u);
  EXPECT_EQ(dynamic_cast<const hydro::waves::Jonswap&>(*sea.systems[0].spectrum).gamma(), 3.3);
  EXPECT_EQ(sea.seed, 1u);
  EXPECT_EQ(jonswap.ramp, 0);
  const auto pm = parse(with(pontoons, "\"jonswap\"", "\"pierson-moskowitz\""), "scene.toml");
  EXPECT_NEAR(std::get<RandomSea>(pm.waves->kind).systems[0].spectrum->tp(), 6, 1e-14);
}

TEST(ScenePatterns, MatchAnyCharactersForAStar) {
  EXPECT_TRUE(matches("m*.surge", "m12.surge"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("a*b*c", "aXbYbZc"));
  EXPECT_TRUE(matches("m1", "m1"));
  EXPECT_FALSE(matches("m1", "m12"));
  EXPECT_FALSE(matches("a*b*c", "aXbYbZ"));
  EXPECT_FALSE(matches("m*.surge", "m1.heave"));
}

TEST(ScenePatterns, AreCheckedAgainstTheSignalsThatExist) {
  const std::vector<std::string> known{"m1.surge", "m1.heave", "connector1.force", "wave.elevation"};
  EXPECT_NO_THROW(check_patterns(parse(pontoons, "scene.toml"), known));
  const Scene wrong = parse(with(pontoons, "\"m*.surge\"", "\"m*.surg\""), "scene.toml");
  try {
    check_patterns(wrong, known);
    FAIL() << "was accepted";
  } catch (const hydro::InputError& error) {
    EXPECT_THAT(error.what(), AllOf(StartsWith("scene.toml:40:50: error: no signal is called \"m*.surg\""),
                                    HasSubstr("did you mean \"m1.surge\"?")));
  }
}

}  // namespace
}  // namespace froude::scene::ask_test
