#include "apps/scene/scenes.hpp"
#include "scene/document.hpp"

namespace froude::scene::reader_test {
namespace {

TEST(SceneReader, PointsAtAWrongDimensionAndTellsTheRightOne) {
  EXPECT_EQ(refusal(with(sphere, "\"8 s\"", "\"8 m\"")),
            "scene.toml:9:10: error: [waves] period = \"8 m\" is a length; a time is needed\n"
            "     9 | period = \"8 m\"\n"
            "       |          ^^^^^ write it like \"0.02 s\"");
}

TEST(SceneReader, MarksValuesInsideAnInlineTable) {
  EXPECT_THAT(refusal(with(sphere, "every = \"0.02 s\"", "every = \"0.02 m\"")),
              AllOf(StartsWith("scene.toml:21:36: error: [ask.run] every = \"0.02 m\" is a length; a time is needed"),
                    HasSubstr("\n       |                                    ^^^^^^^^ ")));
}

TEST(SceneReader, CountsColumnsInCharactersNotBytes) {
  const auto text = with(pontoons, "drag = { cd = 1.0 }", "drag = { \"±\" = 1, cd = \"x\" }");
  EXPECT_THAT(refusal(text), StartsWith("scene.toml:28:10: error: unknown key \"±\" in [member.drag]"));
  EXPECT_THAT(refusal(with(pontoons, "\"(-6, ±5, 0.5) m\"]", "5]")),
              StartsWith("scene.toml:35:27: error: [[connector]] ends = 5 is an integer; a point is needed"));
}

TEST(SceneReader, AsksForTheUnitOfABareNumber) {
  EXPECT_EQ(refusal(with(sphere, "\"261.8 t\"", "9088")),
            "scene.toml:13:8: error: [[body]] mass = 9088 has no unit; a mass is needed\n"
            "    13 | mass = 9088\n"
            "       |        ^^^^ write it with its unit, like \"9088 kg\"");
  EXPECT_THAT(refusal(with(sphere, "\"261.8 t\"", "\"9088\"")), HasSubstr("has no unit; a mass is needed"));
  EXPECT_THAT(refusal(with(pontoons, "\"29332 N/m\"", "29332")), HasSubstr("like \"29332 N/m\""));
  EXPECT_THAT(refusal(with(pontoons, "(0, 0, 1.31) m", "(0, 0, 1.31)")),
              AllOf(HasSubstr("has no unit; a length is needed"), HasSubstr("like \"(0, 0, 1.31) m\"")));
}

TEST(SceneReader, NamesTheNearestKeyForAnUnknownOne) {
  EXPECT_EQ(refusal(with(sphere, "mass =", "masss =")),
            "scene.toml:13:1: error: unknown key \"masss\" in [[body]]\n"
            "    13 | masss = \"261.8 t\"\n"
            "       | ^^^^^ did you mean \"mass\"?");
  EXPECT_THAT(refusal(sphere + "inclusion = \"fit.toml\"\n"), HasSubstr("unknown key \"inclusion\" in [ask]"));
  EXPECT_THAT(refusal(with(sphere, "title", "inclusion")),
              StartsWith("scene.toml:2:1: error: unknown key \"inclusion\" in a scene"));
  EXPECT_THAT(refusal(with(sphere, "[waves]", "[wave]")),
              AllOf(StartsWith("scene.toml:6:2: "), HasSubstr("did you mean \"waves\"?")));
  EXPECT_THAT(refusal(with(pontoons, "stiffness = { surge", "stiffness = { pitch_surge")),
              HasSubstr("did you mean \"surge_pitch\"?"));
}

TEST(SceneReader, TellsWhichKindAKeyBelongsTo) {
  EXPECT_THAT(refusal(with(sphere, "period =", "hs = \"1 m\"\nperiod =")),
              AllOf(StartsWith("scene.toml:9:1: error: unknown key \"hs\" in [waves] of kind \"regular\""),
                    HasSubstr("\"hs\" belongs to kind \"jonswap\"")));
  EXPECT_THAT(refusal(with(sphere, "period =", "seed = 1\nperiod =")),
              HasSubstr("unknown key \"seed\" in [waves] of kind \"regular\""));
  EXPECT_THAT(
      refusal(with(pontoons, "\"axial\"\nstiffness = \"29332 N/m\"", "\"bushing\"\nstiffness = \"(1, 1, 1) N/m\"")),
      AllOf(StartsWith("scene.toml:38:1: error: unknown key \"rest_length\" in [[connector]] of kind \"bushing\""),
            HasSubstr("belongs to kind \"axial\"")));
}

TEST(SceneReader, NamesTheNearestWordForAnUnknownOne) {
  EXPECT_THAT(refusal(with(sphere, "\"regular\"", "\"regulr\"")),
              AllOf(StartsWith("scene.toml:7:8: error: [waves] kind = \"regulr\" is not one of regular, components"),
                    HasSubstr("did you mean \"regular\"?")));
  EXPECT_THAT(refusal(with(sphere, "[\"heave\"]", "[\"hieve\"]")),
              AllOf(StartsWith("scene.toml:14:9: "), HasSubstr("\"heave\"?")));
  EXPECT_THAT(refusal(with(sphere, "\"infinite\"", "\"infinit\"")),
              AllOf(StartsWith("scene.toml:5:9: "), HasSubstr("did you mean \"infinite\"?")));
}

TEST(SceneReader, ShowsTheTableOfAMissingKey) {
  EXPECT_EQ(refusal(with(sphere, "mass = \"261.8 t\"\n", "")),
            "scene.toml:11:1: error: [[body]] needs the key \"mass\"\n"
            "    11 | [[body]]\n"
            "       | ^^^^^^^^ add mass = \"1.2 t\"");
  EXPECT_THAT(refusal(with(sphere, ", every = \"0.02 s\"", "")),
              StartsWith("scene.toml:21:7: error: [ask.run] needs the key \"every\""));
  EXPECT_THAT(refusal(with(sphere, "depth = \"infinite\"\n", "")),
              StartsWith("scene.toml:3:1: error: [water] needs the key \"depth\""));
  EXPECT_THAT(refusal(with(sphere, "density = \"1000 kg/m^3\"\n", "")), HasSubstr("[water] needs the key \"density\""));
  EXPECT_THAT(refusal(with(sphere, "heading = \"0 deg\"\n", "")), HasSubstr("needs the key \"heading\""));
  EXPECT_THAT(refusal(with(sphere, "kind = \"regular\"\n", "")),
              StartsWith("scene.toml:6:1: error: [waves] needs the key \"kind\""));
  EXPECT_THAT(refusal("schema = 1\n"), StartsWith("scene.toml:1:1: error: a scene needs the key \"water\""));
}

TEST(SceneReader, RefusesTheWrongType) {
  EXPECT_THAT(refusal(with(sphere, "\"261.8 t\"", "true")),
              HasSubstr("[[body]] mass = true is a boolean; a mass is needed"));
  EXPECT_THAT(refusal(with(sphere, "\"sphere.nc\"", "[\"sphere.nc\"]")), HasSubstr("is a list; text is needed"));
  EXPECT_THAT(refusal(with(sphere, "radiation = {}", "radiation = true")),
              AllOf(StartsWith("scene.toml:18:13: "), HasSubstr("is a boolean; a table is needed"),
                    HasSubstr("radiation = {}")));
  EXPECT_THAT(refusal(with(pontoons, "count = 5", "count = 5.0")), HasSubstr("is a number; an integer is needed"));
  EXPECT_THAT(refusal(with(pontoons, "cd = 1.0", "cd = \"1.0\"")),
              HasSubstr("[member.drag] cd = \"1.0\" is text; a number is needed"));
  EXPECT_THAT(refusal(with(pontoons, "cd = 1.0", "cd = nan")), HasSubstr("is not finite"));
  EXPECT_THAT(refusal(with(sphere, "\"2 m\"", "2020-01-01")),
              HasSubstr("is a date or time of day; a length is needed"));
}

TEST(SceneReader, TellsListsOfTablesFromTables) {
  EXPECT_THAT(refusal(with(sphere, "[[body]]", "[body]")),
              AllOf(StartsWith("scene.toml:11:1: "), HasSubstr("write [[body]] with two brackets")));
  EXPECT_THAT(refusal(with(sphere, "[water]", "[[water]]")),
              AllOf(StartsWith("scene.toml:3:1: "), HasSubstr("write [water] once")));
}

TEST(SceneReader, PassesOnWhatIsNotToml) {
  EXPECT_THAT(refusal(with(sphere, "\"8 s\"", "8 s")),
              AllOf(StartsWith("scene.toml:9:"), HasSubstr("this is not TOML"), HasSubstr("9 | period = 8 s")));
  EXPECT_THAT(refusal(with(sphere, "[ask]", "[ask")), StartsWith("scene.toml:20:"));
}

TEST(SceneReader, RefusesAKeyOrTableThatStandsTwice) {
  EXPECT_THAT(refusal(with(sphere, "mass =", "mass = \"1 t\"\nmass =")),
              AllOf(StartsWith("scene.toml:14:1: error: "), HasSubstr("redefine"),
                    HasSubstr("\n       | ^^^^ a key stands once")));
  EXPECT_THAT(refusal(sphere + "[water]\n"),
              AllOf(StartsWith("scene.toml:22:1: error: "), HasSubstr("^^^^^^^ a key stands once")));
}

TEST(SceneReader, WantsTheVersionItKnows) {
  EXPECT_THAT(refusal(with(sphere, "schema = 1\n", "")),
              AllOf(StartsWith("scene.toml:1:1: "), HasSubstr("schema = 1")));
  EXPECT_THAT(refusal(with(sphere, "schema = 1", "schema = 2")),
              AllOf(StartsWith("scene.toml:1:10: error: schema = 2 "), HasSubstr("write schema = 1")));
  EXPECT_THAT(refusal(with(sphere, "schema = 1", "schema = \"1\"")), StartsWith("scene.toml:1:10: "));
}

TEST(SceneReader, KnowsNoEffectThatIsSwitchedOff) {
  EXPECT_THAT(refusal(with(sphere, "excitation = true", "excitation = false")),
              AllOf(StartsWith("scene.toml:17:14: "), HasSubstr("what a scene does not name does not act"),
                    HasSubstr("leave the key out")));
}

TEST(SceneReader, KeepsNumbersInTheirBounds) {
  const auto refuses = [](const std::string& scene, std::string_view from, std::string_view to,
                          const std::string& rule) { EXPECT_THAT(refusal(with(scene, from, to)), HasSubstr(rule)); };
  refuses(sphere, "\"261.8 t\"", "\"0 kg\"", "mass = \"0 kg\" must be positive");
  refuses(sphere, "\"2 m\"", "\"-2 m\"", "must be positive");
  refuses(sphere, "\"8 s\"", "\"0 s\"", "must be positive");
  refuses(sphere, "\"infinite\"", "\"-14 m\"", "must be positive");
  refuses(sphere, "\"1000 kg/m^3\"", "\"0 kg/m^3\"", "must be positive");
  refuses(sphere, "heading", "ramp = \"-1 s\"\nheading", "must not be negative");
  refuses(pontoons, "\"1.2 m\"", "\"0 m\"", "hs = \"0 m\" must be positive");
  refuses(pontoons, "\"6 s\"", "\"-6 s\"", "tp = \"-6 s\" must be positive");
  refuses(pontoons, "heading", "gamma = 0.9\nheading", "gamma = 0.9 must be at least 1");
  refuses(pontoons, "heading", "seed = -1\nheading", "must not be negative");
  refuses(pontoons, "count = 5", "count = 0", "must be at least 1");
  refuses(pontoons, "1e-3", "0", "must lie between 0 and 1");
  refuses(pontoons, "1e-2", "1", "accuracy = 1 must lie between 0 and 1");
  refuses(pontoons, "\"1.6 m\"", "\"0 m\"", "must be positive");
  refuses(pontoons, "cd = 1.0", "cd = -1.0", "must be positive");
  refuses(pontoons, "\"29332 N/m\"", "\"0 N/m\"", "must be positive");
}

TEST(SceneReader, NeedsExactlyOneOfHeightAndAmplitude) {
  EXPECT_THAT(refusal(with(sphere, "height = \"2 m\"\n", "")),
              StartsWith("scene.toml:6:1: error: [waves] of kind \"regular\" needs one of height, amplitude"));
  EXPECT_THAT(refusal(with(sphere, "height = \"2 m\"\n", "height = \"2 m\"\namplitude = \"1 m\"\n")),
              AllOf(StartsWith("scene.toml:9:1: error: [waves] of kind \"regular\" may hold only one of height, "
                               "amplitude; height stands at line 8")));
}

TEST(SceneReader, TakesWindowsLineEndings) {
  std::string text;
  for (const char c : sphere) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parse(text, "scene.toml").bodies.size(), 1u);
  EXPECT_THAT(refusal(with(text, "\"8 s\"", "\"8 m\"")),
              AllOf(HasSubstr("| period = \"8 m\"\n"), StartsWith("scene.toml:9:10")));
}

TEST(SceneReader, TellsAFitFromAScene) {
  EXPECT_THAT(refusal(sphere + "[model]\n"), AllOf(StartsWith("scene.toml:22:2: "), HasSubstr("froude fit")));
}

TEST(SceneDocument, KeepsTheOrderOfTheFile) {
  const Node root = parse_document("b = 1\na = [1, \"x\"]\n[z]\n[c]\n", "f");
  std::string order;
  for (const auto& entry : root.entries) order += entry.key;
  EXPECT_EQ(order, "bazc");
  EXPECT_EQ(root.find("a")->value.items[1].place.column, 9);
}

}  // namespace
}  // namespace froude::scene::reader_test
