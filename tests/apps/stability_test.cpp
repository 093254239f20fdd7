// Maps of periodic motions against closed forms: a body on a vertical slide that Morison's inertia drives.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/stability_check.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "scene/scene.hpp"
#include "support/scratch.hpp"

namespace stability_test {
namespace {

using namespace froude;
using dynamics::frequency::Fate;
constexpr double pi = std::numbers::pi;

// A tube of 2 m and a diameter of 1 m, 20 m deep across deep-water waves of 10 s.
constexpr double period = 10, omega = 2 * pi / period, density = 1025, volume = pi / 2, M = 10e3 + density * volume;
constexpr double stiffness = 4180, damping = 904;

/// Amplitude of the force, N: Froude–Krylov's and as much again of the added mass.
double force(double height) {
  return 2 * density * volume * height / 2 * omega * omega * std::exp(-omega * omega / 9.81 * 20);
}

std::string slide_text(const std::string& heights, const std::string& cubic = "") {
  return R"(schema = 1
[water]
density = "1025 kg/m^3"
gravity = "9.81 m/s^2"
depth = "infinite"
[waves]
kind = "regular"
height = "0.1 m"
period = "10 s"
heading = "0 deg"
[[body]]
name = "tube"
position = "(0, 0, -20) m"
mass = "10 t"
centre_of_gravity = "(0, 0, 0) m"
radii_of_gyration = "(1, 1, 1) m"
[[member]]
on = "tube"
from = "(0, -1, 0) m"
to = "(0, 1, 0) m"
diameter = "1 m"
morison = { cd = 0, ca = 1.0 }
[[joint]]
name = "slide"
kind = "slider"
between = ["ground", "tube"]
at = "(0, 0, -20) m"
axis = "z"
[joint.pto]
stiffness = "4180 N/m"
damping = "904 N s/m"
)" + cubic +
         R"(
[ask]
stability = { periods = "10 s .. 10 s, 1 values", heights = ")" +
         heights + R"(", of = ["slide.stroke"] }
accuracy = 1e-3
)";
}

scene::Scene scene_of(const std::string& text) {
  const auto file = support::scratch_folder() / "slide.toml";
  std::ofstream(file) << text;
  return scene::read(file);
}

scene::Scene slide(const std::string& heights, const std::string& cubic = "") {
  return scene_of(slide_text(heights, cubic));
}

// The force is that where the tube is: kA of it, and as much of the stiffness of the waves.
TEST(Stability, OfALinearBodyIsItsResponseAndItsDecay) {
  const StabilityMap map = stability(slide("0.05 m .. 0.1 m, 2 values"));
  ASSERT_EQ(map.cells.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    const double amplitude = force(map.height[c]) / std::hypot(stiffness - M * omega * omega, damping * omega);
    const double kA = omega * omega / 9.81 * amplitude;
    EXPECT_EQ(map.cells[c].fate, Fate::stable);
    EXPECT_NEAR(map.cells[c].multiplier, std::exp(-damping * period / (2 * M)), kA);
    EXPECT_NEAR(map.signals.at(0).values[c], amplitude / std::sqrt(2), kA * amplitude + 1e-4 * amplitude);
  }
  EXPECT_TRUE(std::isnan(map.mathieu.at(0)));  // a single motion that waves drive does not grow by itself
}

// A mooring in place of the slide: no joint at all.
TEST(Stability, WithoutJointsIsThatOfTheSlide) {
  const StabilityMap slid = stability(slide("0.1 m .. 0.1 m, 1 values"));
  std::string text = slide_text("0.1 m .. 0.1 m, 1 values");
  const auto begin = text.find("[[joint]]"), end = text.find("[ask]");
  text.replace(
      begin, end - begin,
      "[[mooring]]\non = \"tube\"\nkind = \"linear\"\nstiffness = { heave = \"4180 N/m\" }\ndamping = { heave = "
      "\"904 N s/m\" }\n");
  text.insert(text.find("mass = "), "free = [\"heave\"]\n");
  text.replace(text.find("slide.stroke"), std::string("slide.stroke").size(), "tube.heave");
  const StabilityMap moored = stability(scene_of(text));
  EXPECT_NEAR(moored.cells.at(0).multiplier, slid.cells.at(0).multiplier, 1e-9);
  EXPECT_NEAR(moored.signals.at(0).values.at(0), slid.signals.at(0).values.at(0), 1e-9);
}

// To one harmonic F² = A² ((k − Mω² + ¾βA²)² + c²ω²); the third is ¼βA³ over 8 Mω² and more, 4e-3 of A.
TEST(Stability, OfACubicSpringIsTheAmplitudeOfDuffing) {
  constexpr double cubic = 53.7e3;
  const StabilityMap map = stability(slide("0.1 m .. 0.2 m, 2 values", "cubic = \"53.7 kN/m^3\"\n"));
  for (std::size_t c = 0; c < 2; ++c) {
    double A = 0;
    const auto needed = [&](double a) {
      return a * std::hypot(stiffness - M * omega * omega + 0.75 * cubic * a * a, damping * omega);
    };
    while (needed(A) < force(map.height[c])) A += 1e-5;
    EXPECT_EQ(map.cells[c].fate, Fate::stable);
    EXPECT_NEAR(map.signals.at(0).values[c], A / std::sqrt(2), 8e-3 * A) << map.height[c];
  }
}

/// Amplitude of the force at another period, N.
double force(double height, double T) {
  const double w = 2 * pi / T;
  return 2 * density * volume * height / 2 * w * w * std::exp(-w * w / 9.81 * 20);
}

// The spring that hardens holds three motions of one wave between the folds, of which the middle one does not last. To
// one harmonic F = A √((k − Mω² + ¾βA²)² + c²ω²); the force is that where the tube is, kA of it.
TEST(Stability, FollowsTheBranchesOfDuffing) {
  constexpr double cubic = 53.7e3, height = 0.6;
  scene::Scene scene = slide("0.6 m .. 0.6 m, 1 values", "cubic = \"53.7 kN/m^3\"\n");
  scene.stability->periods = {7, 12};
  scene.stability->branches = {{.height = height, .period = {}, .place = {}}};
  const StabilityMap map = stability(scene);
  ASSERT_EQ(map.branches.size(), 1u);
  const StabilityMap::Branch& branch = map.branches[0];
  EXPECT_EQ(branch.end, "");
  EXPECT_TRUE(branch.over_periods);
  EXPECT_EQ(branch.held, height);
  EXPECT_EQ(branch.points.front().period, 7);
  EXPECT_EQ(branch.points.back().period, 12);
  int folds = 0, back = 0;
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const auto& p = branch.points[i];
    const double A = std::sqrt(2) * branch.signals.at(0).values.at(i), w = 2 * pi / p.period;
    EXPECT_NEAR(A * std::hypot(stiffness - M * w * w + 0.75 * cubic * A * A, damping * w), force(height, p.period),
                (w * w / 9.81 * A + 0.01) * force(height, p.period) + 0.01 * stiffness * A)
        << p.period;
    back += p.forwards ? 0 : 1;
    if (i == 0 || i + 1 == branch.points.size()) continue;
    folds += p.forwards != branch.points[i - 1].forwards ? 1 : 0;
    if (p.forwards != branch.points[i - 1].forwards || p.forwards != branch.points[i + 1].forwards) continue;
    EXPECT_EQ(p.fate, p.forwards ? Fate::stable : Fate::fold) << p.period << " s, " << A << " m";
  }
  EXPECT_EQ(folds, 2);
  EXPECT_GT(back, 3);
}

// On a map of many heights the last one below the fold lies above the other fold, to which the branch turns back.
TEST(Stability, FindsAMotionBeyondAFoldFromHeightsAboveTheOther) {
  scene::Scene scene = slide("0.1 m .. 1 m, 19 values", "cubic = \"53.7 kN/m^3\"\n");
  scene.stability->periods = {9};
  scene.stability->branches = {{.height = {}, .period = 9, .place = {}}};
  const StabilityMap map = stability(scene);
  int round = 0;
  double before = 0;
  for (std::size_t c = 0; c < map.cells.size(); ++c) {
    ASSERT_NE(map.cells[c].reached, StabilityMap::Reached::not_found) << map.height[c];
    EXPECT_GT(map.signals.at(0).values[c], before) << "higher waves move more";
    before = map.signals.at(0).values[c];
    round += map.cells[c].reached == StabilityMap::Reached::round_folds ? 1 : 0;
  }
  EXPECT_EQ(round, 1) << "beyond it heights go on from the upper branch";
  EXPECT_EQ(map.branches.at(0).end, "");
  EXPECT_EQ(map.branches.at(0).points.back().height, map.height.back());
}

// At 9 s the motion cannot grow any further somewhere below 1 m, and what a run comes to is on the other side of two
// folds.
TEST(Stability, TellsWhereABranchTurnsBackOnItsWay) {
  constexpr double cubic = 53.7e3, T = 9, w = 2 * pi / T;
  scene::Scene scene = slide("0.1 m .. 1 m, 2 values", "cubic = \"53.7 kN/m^3\"\n");
  scene.stability->periods = {T};
  const StabilityMap map = stability(scene);
  EXPECT_EQ(map.cells[0].reached, StabilityMap::Reached::grown);
  EXPECT_EQ(map.cells[1].reached, StabilityMap::Reached::round_folds);
  // The same to one harmonic: below the first fold the lower of three, above it the only one.
  const auto needed = [&](double a) {
    return a * std::hypot(stiffness - M * w * w + 0.75 * cubic * a * a, damping * w);
  };
  for (std::size_t c = 0; c < 2; ++c) {
    double A = 0;
    while (needed(A) < force(map.height[c], T)) A += 1e-5;
    EXPECT_NEAR(map.signals.at(0).values[c], A / std::sqrt(2), (0.02 + w * w / 9.81 * A) * A) << map.height[c];
  }
}

// Waves of 10 s are 156 m long and none is higher than 22 m.
TEST(Stability, LeavesCellsEmptyWhoseWavesBreak) {
  scene::Scene scene = slide("0.1 m .. 30 m, 2 values");
  scene.stability->periods = {10, 12};
  scene.stability->branches = {{.height = {}, .period = 10, .place = {}}, {.height = 25, .period = {}, .place = {}}};
  const StabilityMap map = stability(scene);
  for (const std::size_t c : {0u, 1u}) EXPECT_EQ(map.cells[c].fate, Fate::stable);
  EXPECT_EQ(map.cells[2].reached, StabilityMap::Reached::beyond_breaking);
  EXPECT_FALSE(map.cells[2].fate);
  EXPECT_TRUE(std::isnan(map.signals.at(0).values[2]));
  EXPECT_NE(map.branches[0].end.find("beyond breaking"), std::string::npos);
  EXPECT_TRUE(map.branches[0].points.empty());
  scene.stability->heights = {30, 40}, scene.stability->periods = {9, 10}, scene.stability->branches.clear();
  EXPECT_THROW(stability(scene), hydro::InputError);
}

TEST(Stability, FilesTellHowACellWasReachedAndWhyABranchEnds) {
  StabilityMap map;
  map.period = {7, 8}, map.height = {1};
  map.cells.resize(2);
  map.cells[0].fate = Fate::doubled, map.cells[0].reached = StabilityMap::Reached::jumped;
  map.cells[1].reached = StabilityMap::Reached::beyond_breaking;
  map.mathieu = {1, 2};
  map.branches.push_back({.over_periods = true, .held = 2, .points = {}, .signals = {}, .end = "nothing there"});
  const auto file = support::scratch_folder() / "map.h5";
  map.write(file);
  const hydro::io::Hdf5Reader read(file);
  EXPECT_EQ(read.numbers("/reached").values, (std::vector<double>{2, 4}));
  EXPECT_EQ(read.text_attribute("/branch1", "end"), "nothing there");
  EXPECT_EQ(read.number_attribute("/branch1", "height_m"), 2);
  EXPECT_TRUE(read.numbers("/branch1/period").values.empty());
}

TEST(Stability, IsWhatARunFromRestComesTo) {
  const scene::Scene scene = slide("0.1 m .. 0.2 m, 2 values", "cubic = \"53.7 kN/m^3\"\n");
  const StabilityMap map = stability(scene);
  const MapCheck check = check_in_time(scene, map, 1, 400);
  ASSERT_EQ(check.cells.size(), 1u);
  EXPECT_TRUE(check.cells[0].decided);
  EXPECT_LT(check.cells[0].apart, 1e-2);  // the error of the run's own step
  EXPECT_TRUE(check.cells[0].agrees(map.cells[check.cells[0].cell]));
}

StabilityMap blank_map(std::size_t periods, std::size_t heights) {
  StabilityMap map;
  map.period.resize(periods), map.height.resize(heights), map.cells.resize(periods * heights);
  return map;
}

TEST(StabilityCheck, TakesCellsThatHaveAMotion) {
  StabilityMap map = blank_map(7, 1);
  for (const std::size_t c : {1u, 2u, 4u, 6u}) map.cells[c].fate = Fate::stable;
  for (const std::size_t c : cells_to_step(map, 2)) EXPECT_TRUE(map.cells[c].fate) << c;
  EXPECT_EQ(cells_to_step(map, 9), (std::vector<std::size_t>{1, 2, 4, 6}));
}

// A stride through the map's order that is a whole number of its rows stepped one period alone.
TEST(StabilityCheck, SpreadsCellsOverPeriodsAndHeights) {
  for (const auto& [periods, heights] : {std::pair{21u, 8u}, {5u, 4u}, {4u, 4u}, {10u, 16u}, {8u, 3u}, {16u, 16u}})
    for (std::size_t count = 2; count <= 8; ++count) {
      StabilityMap map = blank_map(periods, heights);
      for (auto& cell : map.cells) cell.fate = Fate::stable;
      std::set<std::size_t> columns, rows;
      const auto cells = cells_to_step(map, count);
      EXPECT_EQ(cells.size(), count);
      for (const std::size_t c : cells) columns.insert(c % periods), rows.insert(c / periods);
      // More than half of what could be different is, and both halves of either axis have some.
      EXPECT_GE(columns.size(), std::min<std::size_t>(count, periods) / 2 + 1) << periods << " x " << heights;
      EXPECT_GE(rows.size(), std::min<std::size_t>(count, heights) / 2 + 1) << periods << " x " << heights;
      EXPECT_LT(*columns.begin(), periods / 2.0) << periods << " x " << heights << ", " << count;
      EXPECT_GE(*columns.rbegin() + 1, periods / 2.0) << periods << " x " << heights << ", " << count;
      EXPECT_LT(*rows.begin(), heights / 2.0) << periods << " x " << heights << ", " << count;
      EXPECT_GE(*rows.rbegin() + 1, heights / 2.0) << periods << " x " << heights << ", " << count;
    }
}

}  // namespace
}  // namespace stability_test
