// Maps of periodic motions against closed forms: a body on a vertical slide that Morison's inertia drives.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/stability_check.hpp"
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

scene::Scene slide(const std::string& heights, const std::string& cubic = "") {
  const auto file = support::scratch_folder() / "slide.toml";
  std::ofstream(file) << R"(schema = 1
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
)" << cubic << R"(
[ask]
stability = { periods = "10 s .. 10 s, 1 values", heights = ")"
                      << heights << R"(", of = ["slide.stroke"] }
accuracy = 1e-3
)";
  return scene::read(file);
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

TEST(Stability, IsWhatARunFromRestComesTo) {
  const scene::Scene scene = slide("0.1 m .. 0.2 m, 2 values", "cubic = \"53.7 kN/m^3\"\n");
  const StabilityMap map = stability(scene);
  const MapCheck check = check_in_time(scene, map, 1, 400);
  ASSERT_EQ(check.cells.size(), 1u);
  EXPECT_TRUE(check.cells[0].decided);
  EXPECT_LT(check.cells[0].apart, 1e-2);  // the error of the run's own step
  EXPECT_TRUE(check.cells[0].agrees(map.cells[check.cells[0].cell]));
}

TEST(StabilityCheck, TakesCellsWithAMotionEvenly) {
  StabilityMap map;
  map.cells.resize(7);
  for (const std::size_t c : {1u, 2u, 4u, 6u}) map.cells[c].fate = Fate::stable;
  EXPECT_EQ(cells_to_step(map, 2), (std::vector<std::size_t>{2, 6}));
  EXPECT_EQ(cells_to_step(map, 9), (std::vector<std::size_t>{1, 2, 4, 6}));
}

}  // namespace
}  // namespace stability_test
