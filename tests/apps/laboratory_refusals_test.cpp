// What is wrong with records of a laboratory is refused with its place, the rule and the remedy: never answered.
#include <string>
#include <vector>

#include "fit_fixture.hpp"

namespace fit_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class LaboratoryRefuses : public TankDay {};

TEST_F(LaboratoryRefuses, TimesThatGoBackAtTheirLine) {
  const struct {
    const char *scene, *file;
  } kinds[] = {{"delay.toml", "let_go.csv"}, {"delay.toml", "let_go_film.csv"}, {"gauge.toml", "gauge.csv"},
               {"tows.toml", "tow_2.csv"},   {"swing.toml", "swing.csv"},       {"waves.toml", "waves_2.csv"},
               {"sea.toml", "sea_2.csv"}};
  for (const auto& [scene, file] : kinds) {
    const std::string before = text_of(file);
    refill(file, 0, [](std::size_t row, const std::string& cell) { return row == 9 ? "0.01" : cell; });
    EXPECT_THAT(refusal(scene), AllOf(HasSubstr(std::string(file) + ":12"), HasSubstr("does not increase"))) << scene;
    write(file, before);
  }
}

TEST_F(LaboratoryRefuses, ChannelsThatGaveNoSignal) {
  const struct {
    const char *scene, *file;
    std::size_t column;
  } kinds[] = {{"delay.toml", "let_go.csv", 1},  {"delay.toml", "let_go_film.csv", 1}, {"gauge.toml", "gauge.csv", 2},
               {"tows.toml", "tow_2.csv", 2},    {"swing.toml", "swing.csv", 1},       {"waves.toml", "waves_2.csv", 1},
               {"waves.toml", "waves_2.csv", 2}, {"sea.toml", "sea_2.csv", 1},         {"sea.toml", "sea_2.csv", 2}};
  for (const auto& [scene, file, column] : kinds) {
    const std::string before = text_of(file);
    refill(file, column, [](std::size_t, const std::string&) { return "3.25"; });
    EXPECT_THAT(refusal(scene), HasSubstr("gave no signal")) << scene << " " << file;
    write(file, before);
  }
}

TEST_F(LaboratoryRefuses, SizesThatAreNoMeasurements) {
  const struct {
    const char *scene, *file;
  } kinds[] = {{"delay.toml", "let_go.csv"}, {"gauge.toml", "gauge.csv"}, {"tows.toml", "tow_2.csv"},
               {"tows.toml", "zero.csv"},    {"swing.toml", "swing.csv"}, {"waves.toml", "waves_2.csv"},
               {"waves.toml", "gauge.csv"},  {"sea.toml", "sea_2.csv"},   {"tows.toml", "cell_1.csv"}};
  for (const auto& [scene, file] : kinds)
    for (const char* exponent : {"e200", "e-200"}) {
      const std::string before = text_of(file);
      refill(file, 1, [&](std::size_t, const std::string& cell) { return cell + exponent; });
      // Of large ones the table is refused, at the cell; small ones are those of a fit.
      EXPECT_THAT(refusal(scene), AllOf(HasSubstr(file), HasSubstr("1e30"))) << scene << exponent;
      write(file, before);
    }
  for (const char* size : {"1e200 m", "1e-320 m", "-1e31 m"})
    EXPECT_THAT(refusal("tows.toml", "length = \"0.5 m\"", std::string("length = \"") + size + "\""),
                AllOf(HasSubstr("tows.toml:16:"), HasSubstr(std::string(size) == "-1e31 m" ? "between 1e-30" : size)));
}

TEST_F(LaboratoryRefuses, TimesThatJump) {  // a lag for each half sample between would be looked at
  refill("let_go_film.csv", 0,
         [](std::size_t row, const std::string& cell) { return row < 300 ? cell : std::to_string(1e9 + double(row)); });
  EXPECT_THAT(refusal("delay.toml"), AllOf(HasSubstr("1e+07 are looked at"), HasSubstr("bound the offset")));
}

TEST_F(LaboratoryRefuses, WindowsOutsideTheRecordOfADelay) {
  EXPECT_THAT(refusal("delay.toml", "[model]",
                      "[prepare]\nwindow = { kind = \"span\", from = \"100 s\", to = \"200 s\" }\n[model]"),
              AllOf(HasSubstr("from 100 s to 200 s holds 0 samples"), HasSubstr("from 0 s to 14.98 s")));
}

TEST_F(LaboratoryRefuses, DelaysWhoseBoundsHoldNone) {
  for (const char* bound : {"0 s", "-1 s"})
    EXPECT_THAT(refusal("delay.toml", "kind = \"delay\"", std::string("kind = \"delay\"\nlongest = \"") + bound + "\""),
                AllOf(HasSubstr("delay.toml:11:11"), HasSubstr("must be positive")));
  EXPECT_THAT(refusal("delay.toml", "kind = \"delay\"", "kind = \"delay\"\nlongest = \"1 ms\""),
              HasSubstr("or look further"));
  EXPECT_THAT(refusal("delay.toml", "kind = \"delay\"", "kind = \"delay\"\nsign = \"same\""),
              HasSubstr("or leave out the sign"));
}

TEST_F(LaboratoryRefuses, KeysOfOtherKinds) {
  for (const char* key : {"tank = { depth = \"1 m\" }", "segment = \"2 s\"", "longst = \"1 s\"", "diameter = \"1 m\""})
    EXPECT_THAT(refusal("delay.toml", "kind = \"delay\"", std::string("kind = \"delay\"\n") + key),
                AllOf(HasSubstr("delay.toml:11:1"), HasSubstr("unknown key")));
  for (const char* key : {"settle = 3", "harmonics = 3", "longest = \"1 s\""})
    EXPECT_THAT(refusal("sea.toml", "segment = \"24 s\"", std::string("segment = \"24 s\"\n") + key),
                AllOf(HasSubstr("sea.toml:15:1"), HasSubstr("unknown key")));
  EXPECT_THAT(refusal("sea.toml", "[model]", "[prepare]\nband_pass = { kind = \"about the waves\" }\n[model]"),
              AllOf(HasSubstr("sea.toml:"), HasSubstr("needs the frequency of the waves")));
  EXPECT_THAT(refusal("delay.toml", "second = \"y\"", "second = \"y\", elevation = \"y\""),
              HasSubstr("its channels are time, first, second, second_time"));
  EXPECT_THAT(refusal("delay.toml", "second_file = \"let_go_film.csv\"", "second_file = \"\""),
              AllOf(HasSubstr("delay.toml:6:15"), HasSubstr("is empty")));
  EXPECT_THAT(refusal("delay.toml", "let_go_film.csv", "let_go_flim.csv"),
              AllOf(HasSubstr("delay.toml:6:15"), HasSubstr("cannot read")));
}

TEST_F(LaboratoryRefuses, SegmentsThatTheRunsDoNotHold) {
  for (const char* segment : {"200 s", "0.1 s", "1e9 s"})
    EXPECT_THAT(refusal("sea.toml", "\"24 s\"", std::string("\"") + segment + "\""), HasSubstr("it needs 4 at least"));
  for (const char* body : {"200 m", "20 km", "1e29 m"})
    EXPECT_THAT(
        refusal("sea.toml", "segment =",
                std::string("tank = { depth = \"1.25 m\", gauge = \"20 m\", body = \"") + body + "\" }\nsegment ="),
        AllOf(HasSubstr("sea_1.csv"), HasSubstr("so far apart")));
}

TEST_F(LaboratoryRefuses, ZerosOfFewSamples) {
  for (const std::size_t rows : {0u, 1u, 15u}) {
    keep("zero.csv", rows);
    EXPECT_THAT(refusal("tows.toml"), AllOf(HasSubstr("zero.csv"), HasSubstr("16 at least"))) << rows;
    EXPECT_THAT(refusal("swing.toml"), AllOf(HasSubstr("zero.csv"), HasSubstr("16 at least"))) << rows;
  }
  EXPECT_THAT(refusal("tows.toml", "\"zero.csv\"", "\"\""), AllOf(HasSubstr("tows.toml:8:8"), HasSubstr("is empty")));
  EXPECT_THAT(refusal("tows.toml", "\"zero.csv\"", "\"zer.csv\""),
              AllOf(HasSubstr("tows.toml:8:8"), HasSubstr("cannot read")));
}

TEST_F(LaboratoryRefuses, LinesThatTellNothing) {
  EXPECT_THAT(refusal("gauge.toml", "reference = \"level\"", "reference = \"reading\""),
              HasSubstr("names the same column as reading"));
  const std::string before = text_of("gauge.csv");
  refill("gauge.csv", 2, [](std::size_t row, const std::string&) { return std::to_string(row * 7 % 5); });
  for (const char* scene : {"gauge.toml", "waves.toml", "sea.toml"})
    EXPECT_THAT(refusal(scene), AllOf(HasSubstr("gauge.csv"), HasSubstr("holds zero"))) << scene;
  write("gauge.csv", before);
  refill("gauge.csv", 1, [](std::size_t, const std::string&) { return "20"; });
  for (const char* scene : {"gauge.toml", "waves.toml"})
    EXPECT_THAT(refusal(scene), AllOf(HasSubstr("gauge.csv"), HasSubstr("all references are 0.02"))) << scene;
  refill("cell_1.csv", 1, [](std::size_t, const std::string&) { return "4.9"; });
  EXPECT_THAT(refusal("tows.toml"), HasSubstr("cell_1.csv"));
}

TEST_F(LaboratoryRefuses, LinesThatGoNowhere) {
  EXPECT_THAT(refusal("waves.toml", "column = \"gauge\"", "column = \"guage\""),
              HasSubstr("is no channel of this fit"));
  EXPECT_THAT(refusal("waves.toml", "column = \"float\"", "column = \"gauge\""), HasSubstr("two lines"));
  EXPECT_THAT(refusal("waves.toml", "reference = \"level\"", "reference = \"t\""), HasSubstr("is needed"));
  EXPECT_THAT(refusal("waves.toml", "file = \"gauge.csv\"", "file = \"gauche.csv\""),
              AllOf(HasSubstr("waves.toml:8"), HasSubstr("gauche.csv")));
  EXPECT_THAT(refusal("gauge.toml", "time = \"t\" }",
                      "time = \"t\" }\nline = [{ column = \"reading\", file = \"gauge.csv\", reading = \"reading\", "
                      "reference = \"level\" }]"),
              HasSubstr("does not apply to a fit of kind \"calibration\""));
}

TEST_F(TankDay, SaysWhereALineIsAnExtrapolation) {
  EXPECT_THAT(told({.scene = folder / "waves.toml"}), Not(HasSubstr("extrapolation")));
  refill("waves_1.csv", 1,
         [](std::size_t, const std::string& cell) { return std::to_string(5 + 9 * (std::stod(cell) - 5)); });
  EXPECT_THAT(told({.scene = folder / "waves.toml"}),
              AllOf(HasSubstr("the line was taken from 2.997 to"), HasSubstr("extrapolation")));
}

TEST_F(TankDay, SaysThatASeaIsNotRegular) {
  EXPECT_THAT(told({.scene = folder / "waves.toml"}), Not(HasSubstr("not regular")));
  replace("waves.toml", "waves_*.csv", "sea_*.csv");
  EXPECT_THAT(told({.scene = folder / "waves.toml"}),
              HasSubstr("in no harmonic of this period: the waves are not regular"));
}

TEST_F(LaboratoryRefuses, LevelsThatNoIntervalHas) {
  for (const char* scene : {"gauge.toml", "delay.toml", "sea.toml", "waves.toml"})
    for (const char* level : {"0", "1", "0.99999999", "1e-9"})
      EXPECT_THAT(refusal(scene, "[ask]", std::string("[ask]\nintervals = { level = ") + level + " }"),
                  AllOf(HasSubstr(level), HasSubstr("must lie between")))
          << scene;
}

TEST_F(LaboratoryRefuses, StepsThatCannotBeTaken) {
  for (const auto& [step, word] :
       std::vector<std::pair<std::string, std::string>>{{"resample = \"1 GHz\"", "more than 100 times"},
                                                        {"outliers = { window = \"1e-9 s\" }", "at least"},
                                                        {"outliers = { window = \"1e9 s\" }", "at most"}})
    EXPECT_THAT(refusal("tows.toml", "[prepare]", "[prepare]\n" + step), HasSubstr(word)) << step;
}

/// Scenes that stand beside those of the tank.
class FitsOfTheLaboratoryRefuse : public FitsOf {
 protected:
  FitsOfTheLaboratoryRefuse() : FitsOf("fit") {
    std::filesystem::copy(froude_test::source_dir() / "examples/fit/batch", folder / "batch");
  }
};

TEST_F(FitsOfTheLaboratoryRefuse, MeansOfTowsWhoseDragIsNone) {
  const std::string before = text_of("towing.csv");
  refill("towing.csv", 2, [](std::size_t, const std::string& cell) { return "-" + cell; });
  EXPECT_THAT(refusal("towing.toml"), AllOf(HasSubstr("towing.csv:3"), HasSubstr("wrong sign")));
  write("towing.csv", before);
  // The third of the rows below a comment and the header.
  const auto third = [&](std::size_t column, const std::string& put) {
    refill("towing.csv", column, [&](std::size_t row, const std::string& cell) { return row == 2 ? put : cell; });
    const std::string out = refusal("towing.toml");
    write("towing.csv", before);
    return out;
  };
  for (const char* speed : {"0", "-0.5"})
    EXPECT_THAT(third(0, speed), AllOf(HasSubstr("towing.csv:5:1: the speed must be positive"), HasSubstr(speed),
                                       HasSubstr("leave runs at rest out")));
  for (const char* none : {"nan", "inf", ""}) EXPECT_THAT(third(0, none), HasSubstr("towing.csv:5")) << none;
  EXPECT_THAT(third(1, "-0.01"), AllOf(HasSubstr("towing.csv:5"), HasSubstr("must not be negative")));
  EXPECT_THAT(third(3, "12"), AllOf(HasSubstr("towing.csv:5"), HasSubstr("force, 12, is no smaller than the force")));
  refill("towing.csv", 1, [](std::size_t, const std::string&) { return "0"; });
  refill("towing.csv", 3, [](std::size_t row, const std::string& cell) { return row == 2 ? "0" : cell; });
  EXPECT_THAT(refusal("towing.toml"), AllOf(HasSubstr("towing.csv:5"), HasSubstr("for all runs or for none")));
  write("towing.csv", before);
  keep("towing.csv", 1);
  refill("towing.csv", 1, [](std::size_t, const std::string&) { return "0"; });
  refill("towing.csv", 3, [](std::size_t, const std::string&) { return "0"; });
  EXPECT_THAT(refusal("towing.toml"), AllOf(HasSubstr("towing.toml:"), HasSubstr("one run without deviations")));
  keep("towing.csv", 0);
  EXPECT_THAT(refusal("towing.toml"), AllOf(HasSubstr("towing.toml:"), HasSubstr("no towing runs")));
}

TEST_F(FitsOfTheLaboratoryRefuse, UncertaintiesAsLargeAsWhatTheyAreOf) {
  for (const auto& [key, value] : {std::pair{"diameter", "0.12 m"}, {"length", "60 cm"}, {"density", "1 t/m^3"}})
    EXPECT_THAT(
        refusal("tows.toml", "diameter = \"0.5 mm\"", std::string(key) + " = \"" + value + "\""),
        AllOf(HasSubstr("tows.toml:16"), HasSubstr(std::string(key) + " = \"" + value + "\" is no smaller than"),
              HasSubstr("one standard deviation")))
        << key;
  EXPECT_THAT(refusal("batch.toml", "length = \"0.5 m\"", "length = \"0.5 m\"\nuncertainty = { mass = \"6 kg\" }"),
              AllOf(HasSubstr("batch.toml:"), HasSubstr("mass = \"6 kg\" is no smaller than")));
  for (const char* error : {"mass_error = 1.2", "stiffness_error = 1"})
    EXPECT_THAT(refusal("decay.toml", "body = {", std::string("body = { ") + error + ","),
                AllOf(HasSubstr("decay.toml:10"), HasSubstr(error), HasSubstr("must lie between 0 and 1")));
}

TEST_F(FitsOfTheLaboratoryRefuse, RowsOfRunsWhoseSizeIsLessThanItsUncertainty) {
  replace("batch/runs.csv", "file,amplitude [m]", "file,diameter [mm]");
  refill("batch/runs.csv", 1, [](std::size_t row, const std::string&) { return row == 3 ? "0.4" : "120"; });
  EXPECT_THAT(
      refusal("batch.toml", "length = \"0.5 m\"", "length = \"0.5 m\"\nuncertainty = { diameter = \"0.5 mm\" }"),
      AllOf(HasSubstr("runs.csv:5"), HasSubstr("is no larger than its uncertainty"), HasSubstr("[model.uncertainty]")));
}

TEST_F(FitsOfTheLaboratoryRefuse, LawsOfFewerRunsThanTheyNeed) {
  keep("batch/runs.csv", 2);
  EXPECT_THAT(refusal("batch.toml"), AllOf(HasSubstr("batch.toml:21:7: a law over runs needs 3 runs at least, got 2"),
                                           HasSubstr("more runs")));
  EXPECT_THAT(refusal("batch.toml", "law = \"best\"", "law = \"kc\""),
              AllOf(HasSubstr("batch.toml:21:7"), HasSubstr("\"ln KC\" needs 4 runs at least")));
}

TEST_F(FitsOfTheLaboratoryRefuse, TablesOfRunsWithoutTheirFiles) {
  replace("batch/runs.csv", "run_1.csv", "run_99.csv");
  EXPECT_THAT(refusal("batch.toml"), AllOf(HasSubstr("runs.csv:2"), HasSubstr("\"run_99.csv\" is no file")));
  replace("batch/runs.csv", "run_99.csv", "run_1.csv");
  const std::string before = text_of("batch/runs.csv");
  replace("batch/runs.csv", "file,amplitude [m]", "file,diameter [m]");
  refill("batch/runs.csv", 1, [](std::size_t, const std::string&) { return "0"; });
  EXPECT_THAT(refusal("batch.toml"), AllOf(HasSubstr("runs.csv:2"), HasSubstr("diameter of a run must be positive")));
  write("batch/runs.csv", before);
  keep("batch/runs.csv", 0);
  EXPECT_THAT(refusal("batch.toml"), AllOf(HasSubstr("runs.csv"), HasSubstr("no rows")));
}

TEST_F(FitsOfTheLaboratoryRefuse, SignalsOfAMotionThatAreConstant) {
  refill("pendulums.csv", 1, [](std::size_t, const std::string&) { return "0"; });
  EXPECT_THAT(refusal("pendulums.toml"), AllOf(HasSubstr("pendulums.csv"), HasSubstr("gave no signal")));
}

TEST_F(FitsOfTheLaboratoryRefuse, RunsThatAreMostlyBeforeTheirRecord) {
  refill("pendulums.csv", 0,
         [](std::size_t, const std::string& cell) { return std::to_string(1000 + std::stod(cell)); });
  EXPECT_THAT(refusal("pendulums.toml"),
              AllOf(HasSubstr("pendulums.toml:5:10"), HasSubstr("begins at 0 s and the first row comes at 1000 s"),
                    HasSubstr("write start = \"1000 s\"")));
  replace("pendulums.toml", "files = [\"pendulums.csv\"]\n", "");
  replace("pendulums.toml", "[model]", "[[data.record]]\nfile = \"pendulums.csv\"\nstart = \"-1 s\"\n[model]");
  EXPECT_THAT(refusal("pendulums.toml"), AllOf(HasSubstr("pendulums.toml:13:9"), HasSubstr("begins at -1 s")));
  EXPECT_THAT(refusal("pendulums.toml", "\"-1 s\"", "\"1000 s\""), IsEmpty());
}

TEST_F(FitsOfTheLaboratoryRefuse, NothingOfWhatIsRight) {
  for (const char* scene : {"towing.toml", "batch.toml"}) EXPECT_THAT(refusal(scene), IsEmpty());
}

TEST_F(LaboratoryRefuses, NothingOfWhatIsRight) {
  for (const char* scene : {"gauge.toml", "delay.toml", "sea.toml", "waves.toml", "tows.toml", "swing.toml"})
    EXPECT_THAT(refusal(scene), IsEmpty()) << scene;
  EXPECT_THAT(refusal("delay.toml", "\"y\"", "\"z\""), Not(IsEmpty()));
}

}  // namespace
}  // namespace fit_test
