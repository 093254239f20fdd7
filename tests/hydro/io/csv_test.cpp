#include "hydro/io/csv.hpp"
#include "support/scratch.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "hydro/io/atomic_file.hpp"

namespace csv_test {
namespace {

using hydro::InputError;
using hydro::io::CsvTable;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace dim = hydro::dim;

TEST(CsvTable, ConvertsToSiByTheUnitsOfItsHeaderInAnyOrderOfColumns) {
  const auto t = CsvTable::parse("# a run\nforce [kN], time (ms)\n\n1.5, 10\n# pause\n-2, 20\n", "a.csv");
  EXPECT_EQ(t.rows(), 2u);
  EXPECT_THAT(t.column("force", dim::force), ElementsAre(1500, -2000));
  EXPECT_THAT(t.column("time", dim::time), ElementsAre(0.01, 0.02));
  EXPECT_EQ(t.unit_text("force"), "kN");
}

TEST(CsvTable, ReadsSemicolonsWithDecimalCommasAndTabs) {
  EXPECT_THAT(CsvTable::parse("t [s];x [m]\n0,5;1,25\n", "a.csv").column("x", dim::length), ElementsAre(1.25));
  EXPECT_THAT(CsvTable::parse("t [s]\tx [m]\r\n0,5\t1,25\r\n", "a.csv").column("t", dim::time), ElementsAre(0.5));
  EXPECT_THAT(CsvTable::parse("\xEF\xBB\xBFt [s],x [m]\n+1e-1,2\n", "a.csv").column("t", dim::time), ElementsAre(0.1));
}

TEST(CsvTable, KeepsColumnsOfText) {
  const auto t = CsvTable::parse("spring, k [N/m]\nS1, 3\nS2, 4\n", "a.csv");
  EXPECT_THAT(t.text_column("spring"), ElementsAre("S1", "S2"));
  EXPECT_THROW(t.column("spring"), InputError);
}

// Grams to a balance, gravity to an accelerometer: taken for grams, an acceleration would be 9807 times too small.
TEST(CsvTable, AsksWhatTheUnitGMeans) {
  for (const char* header : {"t [s],a (g)", "t [s],a [mg]"})
    EXPECT_THAT(
        [&] { CsvTable::parse(std::string(header) + "\n0,1\n", "a.csv").column("a"); },
        ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:1:7"), HasSubstr("standard gravity"), HasSubstr("[gn]"))))
        << header;
  const auto t = CsvTable::parse("a [gn],m [kg]\n-1,2\n", "a.csv");
  EXPECT_THAT(t.column("a", dim::acceleration), ElementsAre(-9.80665));
}

// 2.112 N of a file with decimal commas is 2112 N: read as a decimal it made a drag coefficient a thousandth of itself.
TEST(CsvTable, RefusesDecimalPointsBesideDecimalCommas) {
  for (const char* text : {"v [m/s];F [N]\n0,80;2.112\n", "v [m/s];F [N]\n0.80;2,112\n",
                           "v [m/s]\tF [N]\n0.80\t2,112\n", "\"v [m/s]\",\"F [N]\"\n\"0.80\",\"2,112\"\n"})
    EXPECT_THAT([&] { CsvTable::parse(text, "a.csv"); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:2:"), HasSubstr("112\" in column \"F\""),
                                                HasSubstr("thousands"), HasSubstr("without thousands marks"))))
        << text;
  EXPECT_THAT([] { CsvTable::parse("n;t [s]\n1;0,5\n2;0,6\n3;1.036\n", "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:4:3"), HasSubstr("\"0,5\" in line 2 a comma"))));
}

TEST(CsvTable, RefusesThousandsMarksByName) {
  for (const char* number : {"1.234.567,8", "1,234.5", "1.234.567", "1 234,5",
                             "1\xC2\xA0"
                             "234",
                             "-1'234.5"})
    for (const char* before : {"", "0;1\n"})
      EXPECT_THAT(
          [&] { CsvTable::parse(std::string("t [s];F [N]\n") + before + "1;" + number + "\n", "a.csv").column("F"); },
          ThrowsMessage<InputError>(AllOf(HasSubstr(number), HasSubstr("marks thousands"), HasSubstr("1234567,8"))))
          << number;
  EXPECT_THAT([] { CsvTable::parse("spring;on\nS1;01.02.2024\n", "a.csv").column("on"); },
              ThrowsMessage<InputError>(HasSubstr("holds text")))
      << "a date";
}

// "900" and "1.036" are 900 and 1036 to a writer who groups digits; one who writes decimals writes 900.000.
TEST(CsvTable, RefusesIntegersThatSeemToBeGroupedWhereNothingElseTells) {
  EXPECT_THAT([] { CsvTable::parse("t [s];F [N]\n0;900\n1;1.036\n", "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:3:3"), HasSubstr("decimals or thousands"))));
  for (const char* sound : {"t [s];F [N]\n0.5;900\n1;1.036\n", "t [s];F [N]\n0;9\n1;1.036\n",
                            "t [s];F [N]\n0;1900\n1;1.036\n", "t [s],F [N]\n0,900\n1,1.036\n"})
    EXPECT_THAT(CsvTable::parse(sound, "a.csv").column("F"), ElementsAre(testing::_, 1.036)) << sound;
}

TEST(CsvTable, JudgesUnitsOfColumnsThatAreAskedForOnly) {
  const auto t = CsvTable::parse(
      "t [s];Temp [\xC2\xB0"
      "C];b [kg\n0,5;20,1;3\n",
      "a.csv");
  EXPECT_THAT(t.column("t", dim::time), ElementsAre(0.5));
  EXPECT_FALSE(t.has_known_unit("Temp"));
  EXPECT_THAT(t.values("Temp"), ElementsAre(20.1));
  EXPECT_THAT([&] { t.column("Temp"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:1:7"), HasSubstr("not a unit"))));
  EXPECT_THAT([&] { t.column("b"); }, ThrowsMessage<InputError>(HasSubstr("no closing bracket")));
}

TEST(CsvTable, ReadsQuotedCells) {
  const auto t =
      CsvTable::parse("\"t [s]\",\"the \"\"load\"\", raw [N]\",note\n\"0,5\" ,\"1,25\",\"a, \"\"b\"\"\"\n", "a.csv");
  EXPECT_THAT(t.column("t", dim::time), ElementsAre(0.5));
  EXPECT_THAT(t.column("the \"load\", raw", dim::force), ElementsAre(1.25));
  EXPECT_THAT(t.text_column("note"), ElementsAre("a, \"b\""));
  EXPECT_THAT([] { CsvTable::parse("\"t\n[s]\",x\n0,1\n", "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:1:1"), HasSubstr("not closed"))));
}

TEST(CsvTable, NamesEncodingsThatItDoesNotRead) {
  using namespace std::string_view_literals;
  EXPECT_THAT([] { CsvTable::parse("\xFF\xFEt\0,\0x\0\n\0"sv, "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv"), HasSubstr("UTF-16"), HasSubstr("CSV UTF-8"))));
  EXPECT_THAT([] { CsvTable::parse("t\0,\0x\0\n\0"sv, "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("byte 2"), HasSubstr("UTF-16LE"))));
}

TEST(CsvTable, ReadsAnyLineEnds) {
  for (const char* end : {"\n", "\r\n", "\r", "\r\r\n"}) {
    const auto t = CsvTable::parse(fmt::format("t [s],x [m]{0}0,1{0}1,2{0}", end), "a.csv");
    EXPECT_THAT(t.column("x", dim::length), ElementsAre(1, 2));
    EXPECT_EQ(t.place_of("x", 1).line, 3);
  }
}

TEST(CsvTable, PassesTitlesAndReadsARowOfUnits) {
  for (const char* text : {"Run 17, tank 2\nt [ms],x [mm]\n0,1\n20,2\n", "Run 17\nt,x\nms,mm\n0,1\n20,2\n",
                           "t,x\n[ms],(mm)\n0,1\n20,2\n", "Run 17\n\nt [ms];x [mm]\n0;1\n20;2\n"}) {
    const auto t = CsvTable::parse(text, "a.csv");
    EXPECT_THAT(t.column("t", dim::time), ElementsAre(0, 0.02)) << text;
    EXPECT_THAT(t.column("x", dim::length), ElementsAre(0.001, 0.002)) << text;
  }
  EXPECT_THAT(CsvTable::parse("file,label\ns,m\nN,kg\n", "a.csv").text_column("file"), ElementsAre("s", "N"))
      << "rows of text are no units";
  EXPECT_THAT(CsvTable::parse("name,note\nA,x\nB,3\n", "a.csv").text_column("note"), ElementsAre("x", "3"));
}

TEST(CsvTable, SaysThatBlanksDoNotSeparateColumns) {
  EXPECT_THAT([] { CsvTable::parse("t[s] x[m]\n0 1\n", "a.csv").column("t"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("holds text"), HasSubstr("not by blanks"))));
}

TEST(CsvTable, TakesEmptyCellsAtTheEndOfEachLineForNoColumn) {
  for (const char* text :
       {"t [s],x [m],\n0,1,\n1,2,\n", "t [s],x [m]\n0,1,\n1,2,\n", "t [s],x [m],,\n0,1,,\n,,,\n1,2,,\n,,,\n"}) {
    const auto t = CsvTable::parse(text, "a.csv");
    EXPECT_THAT(t.names(), ElementsAre("t", "x")) << text;
    EXPECT_THAT(t.column("x", dim::length), ElementsAre(1, 2)) << text;
  }
  EXPECT_THAT([] { CsvTable::parse("t [s],x [m],\n0,1,3\n", "a.csv"); },
              ThrowsMessage<InputError>(HasSubstr("3 cells")));
  EXPECT_THAT([] { CsvTable::parse("t [s],x [m]\n0,5,1,2\n", "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("4 cells"), HasSubstr("decimal comma"))));
}

TEST(CsvTable, PointsAtTheCellThatIsWrong) {
  EXPECT_THAT([] { CsvTable::parse("t [s],x [m]\n0,1\n1,nan\n", "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:3:3"), HasSubstr("not a finite number"))));
  EXPECT_THAT([] { CsvTable::parse("t [s],x [m]\n0,1\n1,one\n", "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:3:3"), HasSubstr("\"one\""))));
  EXPECT_THAT([] { CsvTable::parse("t [s],x [m]\n0,1\n1,\n", "a.csv"); },
              ThrowsMessage<InputError>(HasSubstr("is missing")));
  EXPECT_THAT([] { CsvTable::parse("t [s],x [m]\n0,1,2\n", "a.csv"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:2"), HasSubstr("3 cells"), HasSubstr("2 columns"))));
  EXPECT_THAT([] { CsvTable::parse("t [s],x [metre]\n0,1\n", "a.csv").column("x"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:1:7"), HasSubstr("not a unit"))));
  EXPECT_THAT([] { CsvTable::parse("t [s],t [s]\n0,1\n", "a.csv"); },
              ThrowsMessage<InputError>(HasSubstr("two columns")));
  EXPECT_THAT([] { CsvTable::parse("0,1\n1,2\n", "a.csv"); }, ThrowsMessage<InputError>(HasSubstr("no column name")));
  EXPECT_THAT([] { CsvTable::parse("# nothing\n", "a.csv"); }, ThrowsMessage<InputError>(HasSubstr("empty")));
}

TEST(CsvTable, KnowsTheLineOfACellThatACallerFindsWrongLater) {
  const auto file = support::scratch_folder() / "froude_csv_later.csv";
  hydro::io::write_atomically(file, "# a comment\nt [s]; F [N]\n0; 1,5\n\n1;  -20,5\n");
  const auto t = CsvTable::read(file);
  const hydro::Place at = t.place_of("F", 1);
  EXPECT_EQ(at.line, 5);
  EXPECT_EQ(at.column, 5);
  EXPECT_EQ(at.width, 5);
  EXPECT_EQ(at.text, "1;  -20,5");
  EXPECT_EQ(t.place_of("F", 2).text, "t [s]; F [N]") << "beyond the rows it is the column";
  std::filesystem::remove(file);
  EXPECT_EQ(t.place_of("F", 1).line, 5) << "of a file that is gone";
  EXPECT_EQ(t.place_of("F", 1).text, "");
}

TEST(CsvTable, WantsTheUnitThatIsNeededAndNamesTheNearestColumn) {
  const auto t = CsvTable::parse("time [s], force, speed [m/s]\n0, 1, 2\n", "a.csv");
  EXPECT_THAT([&] { t.column("force", dim::force); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("has no unit"), HasSubstr("force ["))));
  EXPECT_THAT([&] { t.column("speed", dim::force); }, ThrowsMessage<InputError>(HasSubstr("is a velocity")));
  EXPECT_THAT([&] { t.column("sped", dim::velocity); },
              ThrowsMessage<InputError>(HasSubstr("did you mean \"speed\"?")));
}

TEST(WriteCsv, IsReadBackToTheLastBit) {
  const auto file = support::scratch_folder() / "froude_csv_test.csv";
  const std::vector<double> time{0, 0.1, 1.0 / 3}, force{1e-300, -2.5e7, 0.1};
  hydro::io::write_csv(file, {{"time", "s", &time}, {"force", "N", &force}}, {"made by a test"});
  const auto t = CsvTable::read(file);
  EXPECT_EQ(t.column("time", dim::time), time);
  EXPECT_EQ(t.column("force", dim::force), force);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace csv_test
