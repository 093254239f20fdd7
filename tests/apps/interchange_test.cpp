// Results for other programs: surfaces that close, names that MATLAB takes, tables, samples that are kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "hydro/io/atomic_file.hpp"
#include "interchange/csv.hpp"
#include "interchange/grid.hpp"
#include "interchange/matlab.hpp"

namespace interchange_test {
namespace {

namespace fi = froude::interchange;
namespace view = froude::view;
using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// By the divergence theorem: Σ a · (b × c) / 6 over triangles that are anticlockwise seen from outside.
double volume(const fi::Faces& f) {
  double sum = 0;
  const auto at = [&](int i) { return f.points[static_cast<std::size_t>(i)]; };
  for (const auto& t : f.triangles) sum += at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6;
  return sum;
}

/// Each edge has one triangle on each side, which go along it in opposite directions.
bool is_closed(const fi::Faces& f) {
  std::map<std::pair<int, int>, int> seen;
  for (const auto& t : f.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++seen[{t[k], t[(k + 1) % 3]}];
  return std::all_of(seen.begin(), seen.end(), [&](const auto& edge) {
    const auto back = seen.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != seen.end() && back->second == 1;
  });
}

TEST(Faces, OfABoxHoldItsVolume) {
  const fi::Faces box = fi::faces_of(view::Box{{-1, 2, 3}, {4, 4, 7}});
  EXPECT_TRUE(is_closed(box));
  EXPECT_NEAR(volume(box), 5 * 2 * 4, 1e-12);  // round-off of twelve products
}

// A prism over a regular polygon of n corners on the circle has n/2 r² sin(2π/n) for π r².
TEST(Faces, OfACylinderAreAPrism) {
  const Vector3d from(1, -2, 0.5), to(3, 1, -1);
  const fi::Faces prism = fi::faces_of(view::Cylinder{from, to, 0.8});
  EXPECT_TRUE(is_closed(prism));
  const double n = static_cast<double>(prism.points.size() - 2) / 2;
  EXPECT_NEAR(volume(prism), n / 2 * 0.64 * std::sin(2 * std::numbers::pi / n) * (to - from).norm(), 1e-12);
  EXPECT_GT(volume(prism), 0.995 * std::numbers::pi * 0.64 * (to - from).norm());  // what the page says of 48 sides
}

TEST(Faces, OfASphereLieOnIt) {
  const Vector3d centre(5, 1, -2);
  const fi::Faces sphere = fi::faces_of(view::Sphere{centre, 1.5});
  EXPECT_TRUE(is_closed(sphere));
  for (const Vector3d& p : sphere.points) EXPECT_NEAR((p - centre).norm(), 1.5, 1e-12);
  const double whole = 4.0 / 3 * std::numbers::pi * std::pow(1.5, 3);
  EXPECT_LT(volume(sphere), whole);  // flat faces lie within
  EXPECT_GT(volume(sphere), 0.98 * whole);
}

TEST(Matlab, NamesAreThoseThatItTakes) {
  std::set<std::string> taken{"froude"};
  EXPECT_EQ(fi::matlab_name("m1.heave", taken), "m1_heave");
  EXPECT_EQ(fi::matlab_name("m1_heave", taken), "m1_heave_2");
  EXPECT_EQ(fi::matlab_name("m1 heave", taken), "m1_heave_3");
  EXPECT_EQ(fi::matlab_name("froude", taken), "froude_2");
  EXPECT_EQ(fi::matlab_name("1st", taken), "x1st");
  EXPECT_EQ(fi::matlab_name("_hidden", taken), "x_hidden");
  EXPECT_EQ(fi::matlab_name("end", taken), "xend");
  EXPECT_EQ(fi::matlab_name("ζ", taken), "x_");  // one character of two bytes
  const std::string longest = fi::matlab_name(std::string(80, 'a'), taken);
  EXPECT_EQ(longest.size(), 63u);
  EXPECT_EQ(fi::matlab_name(std::string(70, 'a'), taken), std::string(61, 'a') + "_2");
}

fi::Array axis(const std::string& name, std::vector<double> values, const std::string& unit = "") {
  return {.name = name,
          .unit = unit,
          .meaning = "",
          .along = {name},
          .shape = {values.size()},
          .values = values,
          .amplitudes = {},
          .texts = {}};
}

fi::Content a_map() {
  fi::Content out;
  out.arrays = {axis("height", {1, 2}, "m"),
                axis("period", {5, 6, 7}, "s"),
                {.name = "fate",
                 .unit = "",
                 .meaning = "",
                 .along = {"height", "period"},
                 .shape = {2, 3},
                 .values = {11, 12, 13, 21, 22, 23},
                 .amplitudes = {},
                 .texts = {}},
                {.name = "limit",
                 .unit = "m",
                 .meaning = "",
                 .along = {"period"},
                 .shape = {3},
                 .values = {0.5, 0.6, 0.7},
                 .amplitudes = {},
                 .texts = {}},
                axis("branch1/point", {1, 2}),
                axis("branch1/height", {3, 4}, "m")};
  out.arrays.back().along = {"branch1/point"};
  return out;
}

struct Written {
  std::vector<std::string> left_out;
  std::string text;
};
Written written(const fi::Content& content) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("interchange.{}.csv", ::getpid());
  Written out{fi::write_csv(path, content), hydro::io::read_text(path)};
  std::filesystem::remove(path);
  return out;
}

TEST(Tables, HaveARowForEachCellAndRepeatWhatLacksAnAxis) {
  const Written map = written(a_map());
  EXPECT_THAT(map.text,
              HasSubstr("height [m],period [s],fate,limit [m]\n1,5,11,0.5\n1,6,12,0.6\n1,7,13,0.7\n2,5,21,0.5\n"));
  EXPECT_THAT(map.left_out, ElementsAre("branch1/height"));
}

TEST(Tables, HaveAColumnForEachText) {
  fi::Content modes;
  fi::Array motion = axis("motion", {});
  motion.texts = {"a.heave", "a.roll"}, motion.shape = {2};
  modes.arrays = {axis("mode", {1, 2}),
                  motion,
                  {.name = "shape",
                   .unit = "",
                   .meaning = "",
                   .along = {"mode", "motion"},
                   .shape = {2, 2},
                   .values = {},
                   .amplitudes = {{1, 5}, {2, 6}, {3, 7}, {4, 8}},
                   .texts = {}}};
  EXPECT_THAT(written(modes).text,
              HasSubstr("mode,shape a.heave real,shape a.heave imaginary,shape a.roll real,shape a.roll imaginary\n"
                        "1,1,5,2,6\n2,3,7,4,8\n"));
}

// A density per hertz stays one, and its axis stays in hertz.
TEST(Tables, KeepTheUnitsOfTheResult) {
  fi::Content spectrum;
  spectrum.arrays = {axis("frequency", {0.125, 0.25}, "Hz"),
                     {.name = "m.density",
                      .unit = "m^2/Hz",
                      .meaning = "",
                      .along = {"frequency"},
                      .shape = {2},
                      .values = {3, 4},
                      .amplitudes = {},
                      .texts = {}}};
  EXPECT_THAT(written(spectrum).text, HasSubstr("frequency [Hz],m.density [m^2/Hz]\n0.125,3\n0.25,4\n"));
}

TEST(Content, KeepsSamplesAlongOneOfItsAxes) {
  fi::Content map = a_map();
  fi::keep(map, "period", {0, 2});
  EXPECT_THAT(map.array("fate").values, ElementsAre(11, 13, 21, 23));
  EXPECT_THAT(map.array("limit").values, ElementsAre(0.5, 0.7));
  EXPECT_THAT(map.array("height").values, ElementsAre(1, 2));
  fi::keep_named(map, [](const std::string& name) { return name == "limit"; });
  std::vector<std::string> left;
  for (const fi::Array& a : map.arrays) left.push_back(a.name);
  EXPECT_THAT(left, ElementsAre("period", "limit"));
}

}  // namespace
}  // namespace interchange_test
