#include "hydro/io/csv.hpp"
#include "support/scratch.hpp"

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
  EXPECT_THAT(CsvTable::parse("t [s]\tx [m]\r\n0,5\t1.25\r\n", "a.csv").column("t", dim::time), ElementsAre(0.5));
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
        [&] { CsvTable::parse(std::string(header) + "\n0,1\n", "a.csv"); },
        ThrowsMessage<InputError>(AllOf(HasSubstr("a.csv:1:7"), HasSubstr("standard gravity"), HasSubstr("[gn]"))))
        << header;
  const auto t = CsvTable::parse("a [gn],m [kg]\n-1,2\n", "a.csv");
  EXPECT_THAT(t.column("a", dim::acceleration), ElementsAre(-9.80665));
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
  EXPECT_THAT([] { CsvTable::parse("t [s],x [metre]\n0,1\n", "a.csv"); },
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
