#include "froude/result.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "support/scratch.hpp"
#include "support/source_dir.hpp"

namespace result_file_test {
namespace {

using froude::ComplexSignal;
using froude::Provenance;
using froude::Signal;
using hydro::InputError;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

namespace fs = std::filesystem;

/// A fresh folder for each test, removed afterwards.
class ResultFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = support::scratch_folder() /
              (std::string("froude_result_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

// More samples than the writer keeps in one piece, so that compression is exercised.
std::vector<double> long_time() {
  std::vector<double> time(20000);
  for (std::size_t i = 0; i < time.size(); ++i) time[i] = 0.05 * static_cast<double>(i);
  return time;
}

std::vector<double> sine_of(const std::vector<double>& time) {
  std::vector<double> out;
  for (const double t : time) out.push_back(std::sin(t));
  return out;
}

Provenance provenance() {
  return {.scene_file = "a.toml",
          .scene_text = "schema = 1\ntitle = \"Grüße\"\n",
          .settings = {{"body[1].mass", "9088 kg"}},
          .seeds = {{"waves", 1}},
          .wall_time = {{"radiation", 0.5}},
          .energy = {{"supplied", 2.0}},
          .notes = {}};
}

void write_sample_run(const fs::path& path) {
  const auto time = long_time();
  froude::write_run(path, time, {{"m1.heave", "m", "heave of m1", sine_of(time)}, {"ratio", "", "a number", time}},
                    provenance());
}

void write_sample_rao(const fs::path& path) {
  froude::write_rao(path, {0.5, 1.0, 1.5}, {0.25}, {{"m1.heave", "m/m", "heave of m1", {{1, 2}, {3, 4}, {5, 6}}}},
                    provenance());
}

/// Two headings, not in rising order, with three frequencies each.
void write_sample_headings(const fs::path& path) {
  froude::write_rao(path, {0.5, 1.0, 1.5}, {1.25, 0.25},
                    {{"m1.heave", "m/m", "heave of m1", {{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}, {11, 12}}}},
                    provenance());
}

TEST_F(ResultFile, GivesBackTheVeryNumbersOfARun) {
  write_sample_run(folder_ / "run.h5");
  const auto run = froude::read_run(folder_ / "run.h5");
  EXPECT_EQ(run.time, long_time());
  ASSERT_EQ(run.signals.size(), 2u);
  EXPECT_EQ(run.signals[0].name, "m1.heave");
  EXPECT_EQ(run.signals[0].units, "m");
  EXPECT_EQ(run.signals[0].long_name, "heave of m1");
  EXPECT_EQ(run.signals[0].values, sine_of(long_time()));
  EXPECT_EQ(run.signals[1].units, "");
}

TEST_F(ResultFile, KeepsTheSceneAndTheLedgerInside) {
  write_sample_run(folder_ / "run.h5");
  const hydro::io::Hdf5Reader file(folder_ / "run.h5");
  EXPECT_EQ(file.text("/provenance/scene"), provenance().scene_text);
  EXPECT_EQ(file.text_attribute("/provenance/settings", "body[1].mass"), "9088 kg");
  EXPECT_EQ(file.number_attribute("/provenance/energy", "supplied"), 2.0);
  EXPECT_EQ(file.number_attribute("/provenance/seeds", "waves"), 1.0);
  EXPECT_EQ(file.number_attribute("/provenance/wall_time", "radiation"), 0.5);
  EXPECT_FALSE(file.has("/provenance/notes")) << "empty entries are left out";
}

TEST_F(ResultFile, StoresAComplexAmplitudeAsRealAndImaginaryPart) {
  write_sample_rao(folder_ / "rao.h5");
  const hydro::io::Hdf5Reader file(folder_ / "rao.h5");
  const auto array = file.numbers("/m1.heave");
  EXPECT_THAT(array.shape, ElementsAre(3, 2));
  EXPECT_THAT(array.values, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(file.scalar("/heading"), 0.25);
}

TEST_F(ResultFile, StoresSeveralHeadingsAsTheFirstDimension) {
  write_sample_headings(folder_ / "headings.h5");
  const hydro::io::Hdf5Reader file(folder_ / "headings.h5");
  const auto array = file.numbers("/m1.heave");
  EXPECT_THAT(array.shape, ElementsAre(2, 3, 2));
  EXPECT_THAT(array.values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  EXPECT_THAT(file.numbers("/heading").values, ElementsAre(1.25, 0.25));
  EXPECT_EQ(file.text_attribute("/heading", "units"), "rad");
}

TEST_F(ResultFile, OpensInXarrayWithDimensionsCoordinatesAndUnits) {
  if (std::system("/usr/bin/python3 -c 'import xarray, netCDF4' >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "skipped, no xarray with netCDF4 under /usr/bin/python3";
  write_sample_run(folder_ / "run.h5");
  write_sample_rao(folder_ / "rao.h5");
  write_sample_headings(folder_ / "headings.h5");
  const std::string command = "/usr/bin/python3 " + froude_test::source_dir().string() +
                              "/tests/apps/open_with_xarray.py '" + folder_.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(ResultFile, RefusesAFileThatIsNoRun) {
  write_sample_rao(folder_ / "rao.h5");
  EXPECT_THAT([&] { froude::read_run(folder_ / "rao.h5"); },
              ThrowsMessage<InputError>(HasSubstr("not a result of `froude run`")));
  EXPECT_THAT([&] { froude::read_run(folder_ / "none.h5"); }, ThrowsMessage<InputError>(HasSubstr("no such file")));
}

TEST_F(ResultFile, RefusesAFileThatWasCutShort) {
  write_sample_run(folder_ / "run.h5");
  fs::resize_file(folder_ / "run.h5", fs::file_size(folder_ / "run.h5") / 2);
  EXPECT_THAT([&] { froude::read_run(folder_ / "run.h5"); }, ThrowsMessage<InputError>(HasSubstr("cut short")));
}

TEST_F(ResultFile, LeavesNothingBehindWhenItCannotBeWritten) {
  EXPECT_THROW(write_sample_run(folder_ / "absent" / "run.h5"), InputError);
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace result_file_test
