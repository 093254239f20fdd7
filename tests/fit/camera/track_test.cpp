#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "fit/camera/track_file.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "support/refused.hpp"
#include "support/scratch.hpp"

namespace camera_track_test {
namespace {

using fit::camera::parse_track;
using fit::camera::Track;
using fit::camera::TrackColumns;
using support::refused;
using testing::AllOf;
using testing::HasSubstr;

TEST(TrackFile, OfAnotherProgramIsReadAsItIs) {
  const Track t = parse_track(
      "mass A;;\n"
      "t [ms];bob_x [px];bob_y [px]\n"
      "0,0;512,25;100\n"
      "40;;\n"
      "85;NaN;101\n"
      "120;514,5;102\n",
      "tracker.txt", {.time = "t"});
  ASSERT_EQ(t.frames(), 4u);
  EXPECT_DOUBLE_EQ(t.time[2], 0.085);
  ASSERT_EQ(t.markers.size(), 1u);
  EXPECT_EQ(t.markers[0].name, "bob");
  EXPECT_FALSE(t.in_metres);
  EXPECT_EQ(t.markers[0].seen[0]->at, Eigen::Vector2d(512.25, 100));
  EXPECT_FALSE(t.markers[0].seen[1]);
  EXPECT_FALSE(t.markers[0].seen[2]) << "half a place is none";
  EXPECT_FALSE(t.markers[0].seen[0]->has_covariance());
}

TEST(TrackFile, WithoutNamesOrTimesTakesThemFromTheScene) {
  const Track t = parse_track(
      "1201 1221  977 1782\n1202 1221 1008 1793\n", "camera.dat",
      {.names = {"pivot_x", "pivot_y", "joint_x", "joint_y"}, .frames_per_second = 400, .position_unit = "px"});
  EXPECT_DOUBLE_EQ(t.time[1], 0.0025);
  EXPECT_EQ(t.marker("joint").seen[1]->at, Eigen::Vector2d(1008, 1793));
}

TEST(TrackFile, InMillimetresWithTabsAndTitles) {
  const Track t = parse_track("Film 12\nmade by hand\ntime\tx\ty\n0\t1\t2\n1\t3\t4\n", "film.txt",
                              {.time = "time", .time_unit = "s", .position_unit = "mm"});
  EXPECT_TRUE(t.in_metres);
  EXPECT_EQ(t.marker("marker").seen[1]->at, Eigen::Vector2d(0.003, 0.004));
}

// "1.024" beside "0,04" is pixel 1024, or 1.024 mm: nobody can know.
TEST(TrackFile, RefusesDecimalPointsBesideDecimalCommas) {
  const TrackColumns asked{.time = "t"};
  EXPECT_THAT(
      refused([&] { parse_track("t [s];b_x [px];b_y [px]\n0,04;1.024;3\n", "t.csv", asked); }),
      AllOf(HasSubstr("t.csv:2:6"), HasSubstr("\"1.024\" in column \"b_x\" has a point"), HasSubstr("thousands")));
  EXPECT_THAT(refused([&] { parse_track("t [s];b_x [px];b_y [px]\n0,04;1;3\n0,08;1.024,5;3\n", "t.csv", asked); }),
              AllOf(HasSubstr("t.csv:3"), HasSubstr("marks thousands")));
}

TEST(TrackFile, ReadsUnitsInALineOfTheirOwnAndQuotes) {
  const Track t = parse_track("A\rt,b_x,\"b_y\"\rms,px,px\r\"40\",1,2\r", "t.csv", {.time = "t"});
  EXPECT_DOUBLE_EQ(t.time.at(0), 0.04);
}

TEST(TrackFile, TakesASeparatorAtTheEndOfEachRowForNoColumn) {
  const TrackColumns asked{.time = "t"};
  EXPECT_EQ(parse_track("t [s];b_x [px];b_y [px]\n0;1;2;\n1;;;\n", "t.csv", asked).time.size(), 2u);
  EXPECT_THAT(refused([&] { parse_track("t [s];b_x [px];b_y [px]\n0;1;2;\n1;1;2;3\n", "t.csv", asked); }),
              HasSubstr("the row has 4 cells"));
}

TEST(TrackFile, AsksOnceForAllUnits) {
  EXPECT_THAT(refused([] { parse_track("t,x,y\n0,1,2\n1,2,3\n", "plain.csv", {.time = "t"}); }),
              AllOf(HasSubstr("in which units are the columns t, x, y?"),
                    HasSubstr("units = { time = \"s\", position = \"px\" }")));
}

TEST(TrackFile, SaysWhatIsWrongAndWhere) {
  const TrackColumns plain{.time = "t", .time_unit = "s", .position_unit = "px"};
  const auto told = [&](const char* text) { return refused([&] { parse_track(text, "f.csv", plain); }); };
  EXPECT_THAT(told("t,x,y\n0,1,2\n1,1,2\n0.5,1,2\n"),
              AllOf(HasSubstr("f.csv:4"), HasSubstr("time goes from 1 s to 0.5 s")));
  EXPECT_THAT(told("t,x,y\n0,1,2\n1,1\n"), AllOf(HasSubstr("f.csv:3"), HasSubstr("2 cells, 3 columns")));
  EXPECT_THAT(told("t,x,y\n0,1,2\nt,x,y\n0,1,2\n"), AllOf(HasSubstr("f.csv:3"), HasSubstr("\"t\" is no number")));
  EXPECT_THAT(told("0,1,2\n1,1,2\n"), HasSubstr("no line names the columns"));
  EXPECT_THAT(told("t,u,v\n0,1,2\n"), HasSubstr("the track has no marker: its columns are t, u, v"));
  EXPECT_THAT(told("time,x,y\n0,1,2\n"), AllOf(HasSubstr("no column \"t\""), HasSubstr("time")));
  EXPECT_THAT(told("t,x [furlong],y [px]\n0,1,2\n"), HasSubstr("write px, or a length"));
  EXPECT_THAT(told("t [m],x,y\n0,1,2\n"), AllOf(HasSubstr("f.csv:1"), HasSubstr("column \"t\"")));
  EXPECT_THAT(told("# only a comment\n"), HasSubstr("the track is empty"));
}

TEST(TrackFile, ComesBackWithGapsAndCovariances) {
  Track t{.time = {0, 0.04, 0.08}, .markers = {{"a", {}}, {"b.c", {}}}, .in_metres = false, .size = {640, 480}};
  for (auto& m : t.markers) m.seen.resize(3);
  Eigen::Matrix2d errors;
  errors << 0.01, 0.002, 0.002, 0.02;
  t.markers[0].seen[0] = {{1.5, 2.25}, errors};
  t.markers[0].seen[2] = {{3.5, 4.25}, errors};
  t.markers[1].seen[1] = {{7, 8}};
  for (const char* name : {"track.csv", "track.h5"}) {
    const auto file = support::scratch_folder() / name;
    write_track(file, t, {"made by a test"});
    const Track back = fit::camera::read_track(file, {.time = "t"});
    EXPECT_EQ(back.size, t.size);
    ASSERT_EQ(back.markers.size(), 2u) << name;
    EXPECT_FALSE(back.markers[0].seen[1]);
    EXPECT_EQ(back.markers[0].seen[2]->at, t.markers[0].seen[2]->at);
    EXPECT_EQ(back.markers[0].seen[2]->covariance, errors);
    EXPECT_FALSE(back.marker("b.c").seen[1]->has_covariance());
  }
}

TEST(TrackFile, OfHdf5IsThatOfAnotherProgramTooAndSaysWhatItLacks) {
  const auto file = support::scratch_folder() / "other.h5";
  const auto written = [&](std::size_t rows, const char* unit) {
    hydro::io::Hdf5Writer h;
    const std::vector<double> values{0, 1, 3};
    for (const char* name : {"/time", "/bob_x"}) h.write(name, values, {3});
    h.write("/bob_y", std::span(values).first(rows), {rows});
    if (*unit != 0)
      for (const char* name : {"/bob_x", "/bob_y"}) h.attribute(name, "units", unit);
    h.attribute("/time", "units", "s");
    h.save(file);
  };
  const auto told = [&](const TrackColumns& columns) {
    return refused([&] { fit::camera::read_track(file, columns); });
  };
  written(3, "mm");
  const Track t = fit::camera::read_track(file, {.time = "time"});
  EXPECT_TRUE(t.in_metres);
  EXPECT_DOUBLE_EQ(t.marker("bob").seen[2]->at.y(), 0.003);
  EXPECT_THAT(told({.time = "tim"}), HasSubstr("did you mean \"time\"?"));
  EXPECT_THAT(told({.names = {"t", "x", "y"}, .time = "t"}), HasSubstr("names its columns itself"));
  written(3, "");
  EXPECT_THAT(told({.time = "time"}), HasSubstr("in which units are the columns bob_x, bob_y?"));
  written(2, "px");
  EXPECT_THAT(told({.time = "time"}), HasSubstr("has 2 rows"));
}

TEST(Track, GoesToMetresWithItsErrors) {
  Track t{.time = {0, 1}, .markers = {{"a", {fit::camera::Sighting{{100, 50}}, std::nullopt}}}};
  const fit::camera::View view{.metres_per_pixel = 0.002};
  const Track placed = in_plane(t, view, 0.5);
  EXPECT_LT((placed.markers[0].seen[0]->at - Eigen::Vector2d(0.2, -0.1)).norm(), 1e-12);
  EXPECT_NEAR(placed.markers[0].seen[0]->covariance(0, 0), 1e-6, 1e-11);  // (0.5 px × 2 mm)²
  EXPECT_THAT(refused([&] { in_plane(t, view, 0); }), HasSubstr("[camera] deviation"));
}

TEST(Track, RefusesALensOfPicturesOfAnotherSize) {
  const Track t{.time = {0, 1}, .markers = {{"a", {std::nullopt, std::nullopt}}}, .size = {1280, 720}};
  const fit::camera::View view{.lens = {{.focal = {1000, 1000}, .principal = {960, 540}, .size = {1920, 1080}}},
                               .metres_per_pixel = 0.001};
  EXPECT_THAT(refused([&] { in_plane(t, view, 1); }), AllOf(HasSubstr("1280 x 720"), HasSubstr("1920 x 1080")));
}

TEST(Track, IsCutAndCountsFromThere) {
  Track t{.time = {0, 1, 2, 3}, .markers = {{"a", {}}}};
  for (int i = 0; i < 4; ++i) t.markers[0].seen.push_back(fit::camera::Sighting{{i, 0}});
  const Track part = cut(t, 1, 2.5);
  EXPECT_EQ(part.time, (std::vector<double>{0, 1}));
  EXPECT_EQ(part.markers[0].seen[0]->at.x(), 1);
  EXPECT_THAT(refused([&] { cut(t, 2.5, 9); }), HasSubstr("it has 1 frames"));
  EXPECT_THAT(refused([&] { t.marker("aa"); }), HasSubstr("did you mean \"a\"?"));
}

}  // namespace
}  // namespace camera_track_test
