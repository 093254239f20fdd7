// How large what a linear response leaves out is, held against runs and against the response with that effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "scenes.hpp"
#include "support/pontoons.hpp"

namespace size_left_out_test {
namespace {

using namespace froude;
using testing::AllOf, testing::Contains, testing::HasSubstr, testing::Not;

/// One module on a soft mooring that only surges, in waves of 5 s.
std::string module_in_waves(double height, const std::string& more, const std::string& of_rao = "") {
  return fmt::format(R"(schema = 1
water = {{ density = "1000 kg/m^3", depth = "14 m" }}
[waves]
kind = "regular"
height = "{} m"
period = "5 s"
heading = "0 deg"
ramp = "60 s"
)",
                     height) +
         support::pontoons(1) + R"(free = ["surge"]
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = { memory_tolerance = 2e-2 }
[[mooring]]
on = ["m1"]
kind = "linear"
stiffness = { surge = "2000 N/m" }
)" + more +
         "[ask]\nrao = { periods = \"4.99 s .. 5 s, 2 values\", " + of_rao + R"(of = ["m1.surge"] }
run = { duration = "150 s", every = "0.05 s" }
)";
}

const std::string wall = R"toml([[contact]]
name = "quay"
between = ["m1", "ground"]
kind = "plane"
points = "(6.5, 0, 0.5) m"
at = "(6.8, 0, 0) m"
normal = "(-1, 0, 0)"
restitution = 0.5
)toml";
const std::string on_cylinders =
    "[[member]]\non = \"m1\"\nfrom = \"(±5.2, ±5.2, -1.13) m\"\nto = \"(±5.2, ±5.2, 0) m\"\ndiameter = \"1.6 "
    "m\"\ndrag = { cd = 1.0 }\n";

/// The number before " m height" in the note that has these words.
double height_told(const Responses& responses, const std::string& words) {
  for (const std::string& note : responses.notes)
    if (const auto at = note.find("in waves of "); at != std::string::npos && note.find(words) != std::string::npos)
      return std::atof(note.c_str() + at + 12);
  return std::nan("");
}

std::complex<double> surge(const std::string& text) {
  return respond(froude_test::parse(text)).signal("m1.surge").values.back();
}

double impacts_in(double height) {
  return simulate(froude_test::parse(module_in_waves(height, wall))).signal("quay.impacts").back();
}

// A gap of 0.3 m closes where the amplitude of surge is 0.3 m; a run tells who touches.
TEST(SizeLeftOut, OfContactsIsTheHeightOfWavesInWhichARunHasImpacts) {
  const auto responses = respond(froude_test::parse(module_in_waves(0.1, wall)));
  const double height = height_told(responses, "\"quay\""),
               per_metre = std::abs(responses.signal("m1.surge").values.back());
  EXPECT_NEAR(height, 2 * 0.3 / per_metre, 5e-3 * height);  // three digits, and 4.99 s beside 5 s
  EXPECT_EQ(impacts_in(0.93 * height),
            0);  // 2e-2 of the memory, what the ramp leaves of free surge, and the bend of it
  EXPECT_GT(impacts_in(1.07 * height), 0);
}

TEST(SizeLeftOut, OfContactsThatAreClosedAtRestIsToldWithoutAHeight) {
  std::string closed = wall;
  closed.replace(closed.find("6.8"), 3, "6.5");
  EXPECT_THAT(respond(froude_test::parse(module_in_waves(0.1, closed))).notes,
              Contains(HasSubstr("\"quay\" is closed at rest")));
}

// In waves of a hundredth of that height drag is a thousandth of the wave load. (k − ω²(M + A) + iωB) ξ = X + Q: the
// response changes by as much, but for terms of its square.
TEST(SizeLeftOut, OfDragIsWhatALinearisedResponseChangesBy) {
  const auto without = respond(froude_test::parse(module_in_waves(0.1, on_cylinders)));
  const double height = height_told(without, "drag left out");
  const std::complex<double> before = without.signal("m1.surge").values.back(),
                             after = surge(module_in_waves(
                                 0.1, on_cylinders, fmt::format("drag = {{ height = \"{} m\" }}, ", height / 100)));
  // 0.5 % by three digits of the height, 0.4 % by the load at 4.99 s beside that at 5 s, 0.4 % by the square, seen as
  // 4 % at ten times the height
  EXPECT_NEAR(std::abs(after - before) / std::abs(before), 0.001, 1.3e-2 * 0.001);
}

/// The number after these words in the note that has them.
double number_told(const Responses& responses, const std::string& words) {
  for (const std::string& note : responses.notes)
    if (const auto at = note.find(words); at != std::string::npos) return std::atof(note.c_str() + at + words.size());
  return std::nan("");
}

// Drag goes with the square of the height and the wave load with the height: a tenth at one, and as much more as others
// are higher. What a gap loses goes with the height.
TEST(SizeLeftOut, InWavesOfTheSceneGoesWithTheirHeight) {
  for (const double height : {0.1, 0.7}) {
    const auto of_drag = respond(froude_test::parse(module_in_waves(height, on_cylinders)));
    const double tenth = height_told(of_drag, "drag left out"),
                 own = number_told(of_drag, fmt::format("as those of the scene, {} m, it is ", height));
    EXPECT_NEAR(own, 0.1 * height / tenth, 1e-2 * own);  // three digits each
    const auto of_gap = respond(froude_test::parse(module_in_waves(height, wall)));
    const double closes = height_told(of_gap, "\"quay\""),
                 taken = number_told(of_gap, fmt::format("as those of the scene, {} m, ", height));
    EXPECT_NEAR(taken, height / closes, 1e-2 * taken);
  }
}

const std::string rail = R"toml([[joint]]
name = "rail"
between = ["ground", "m1"]
at = "(0, 0, 0) m"
kind = "slider"
axis = "x"
friction = { static = "3 kN", dynamic = "2 kN" }
)toml";

double most_slip(double height) {
  const Run run = simulate(froude_test::parse(module_in_waves(height, rail)));
  const auto& surge = run.signal("m1.surge");
  return *std::max_element(surge.begin(), surge.end()) - *std::min_element(surge.begin(), surge.end());
}

// One body on a rail is held by its wave load, which the data have: it sticks where that is below the static friction,
// and a run slips in higher waves alone. The friction that slips has 4/π of its level as first harmonic.
TEST(SizeLeftOut, OfFrictionIsTheWaveLoadThatItHolds) {
  const scene::Scene scene = froude_test::parse(module_in_waves(0.1, rail));
  const auto prepared = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(prepared);
  const dynamics::frequency::SmallMotions about(model);
  double load = 0;
  for (const double period : {4.99, 5.0})
    load = std::max(
        load, std::abs(dynamics::frequency::excitation(about, prepared.groups, 2 * std::numbers::pi / period, 0)[0]));
  const auto responses = respond(scene);
  const double sticks = number_told(responses, "\"rail\" sticks in waves of up to "),
               little = number_told(responses, "move freely, and in waves of ");
  EXPECT_NEAR(sticks, 2 * 3000 / load, 6e-3 * sticks);  // three digits
  EXPECT_NEAR(little, 2 * 4 / std::numbers::pi * 2000 / (0.1 * load), 6e-3 * little);
  EXPECT_THAT(responses.notes, Contains(HasSubstr("as those of the scene, 0.1 m, it sticks")));
  EXPECT_EQ(most_slip(0.95 * sticks), 0);
  EXPECT_GT(most_slip(1.1 * sticks), 1e-3);
}

std::string with_morison(const std::string& loads) {
  std::string out = on_cylinders;
  return out.replace(out.find("drag ="), std::string::npos, "morison = { " + loads + " }\n");
}

/// Half the way from trough to crest of the last waves of a run.
double amplitude_in_run(const Run& run, const std::string& signal) {
  const auto& all = run.signal(signal);
  const auto [low, high] = std::minmax_element(all.end() - 200, all.end());
  return (*high - *low) / 2;
}

// In waves of 1 cm nothing but Morison's inertia acts beside what is linear anyway: the run has as much of it as the
// response, to what the ramp leaves of free surge, the memory's tolerance and what 0.1 s miss of a crest.
TEST(LinearMembers, RespondAsARunInLowWaves) {
  const std::string text = module_in_waves(0.01, with_morison("cd = 0, ca = 1.0"));
  const auto responses = respond(froude_test::parse(text));
  const double with = 0.005 * std::abs(responses.signal("m1.surge").values.back()),
               without = 0.005 * std::abs(surge(module_in_waves(0.01, "")));
  EXPECT_GT(std::abs(with - without), 0.1 * without);
  EXPECT_NEAR(amplitude_in_run(simulate(froude_test::parse(text)), "m1.surge"), with, 2e-2 * with);
  EXPECT_THAT(responses.notes, Not(Contains(HasSubstr("left out"))));
}

// Drag of [member.morison] is linear where it is asked for, as that of [member.drag] at the same place is.
TEST(LinearMembers, HaveTheSameDragByEitherName) {
  const std::string of_rao = "drag = { height = \"1 m\" }, ";
  const auto by_drag = surge(module_in_waves(1, on_cylinders + with_morison("cd = 0, ca = 1.0"), of_rao)),
             by_morison = surge(module_in_waves(1, with_morison("cd = 1.0, ca = 1.0"), of_rao));
  EXPECT_NEAR(std::abs(by_drag - by_morison), 0, 1e-5 * std::abs(by_drag));  // the linearisation settles to 1e-6
}

TEST(LinearMembers, TellWhatIsNotLinearInThem) {
  const auto notes = [](const std::string& loads) {
    return respond(froude_test::parse(module_in_waves(0.1, with_morison(loads)))).notes;
  };
  EXPECT_THAT(notes("cd = 1.0, ca = 1.0"), Contains(HasSubstr("the drag left out reaches a tenth")));
  EXPECT_THAT(notes("cd = 0, ca = 1.0, partial_immersion = true"), Contains(HasSubstr("what is wet at rest")));
  EXPECT_THAT(notes("cd = 0, ca = 1.0, cd_tangential = 0.01"), Contains(HasSubstr("drag on members is left out")));
}

// A mooring that is taut across the motion: k(√(ℓ² + x²) − ℓ) x/√(ℓ² + x²), all of which is left out, for its stiffness
// along the motion is none at rest.
TEST(SizeLeftOut, OfATautLineAcrossTheMotionIsAllOfItsLoad) {
  const std::string across = R"toml([[connector]]
kind = "axial"
stiffness = "400 kN/m"
between = ["m1", "ground"]
ends = ["(0, 0, 0.5) m", "(0, 8, 0.5) m"]
)toml";
  const auto responses = respond(froude_test::parse(module_in_waves(2, across)));
  const scene::Scene scene = froude_test::parse(module_in_waves(2, across));
  const auto prepared = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(prepared);
  const dynamics::frequency::SmallMotions about(model);
  const double load = std::abs(dynamics::frequency::excitation(about, prepared.groups, 2 * std::numbers::pi / 5, 0)[0]),
               x = std::abs(responses.signal("m1.surge").values.back()), length = std::hypot(8, x);
  const double told = number_told(responses, "depart from their linear part by ");
  // Eight phases of the cube: the largest is missed by at most a fifth.
  EXPECT_LE(told, 1.02 * 400e3 * (length - 8) * x / length / load);
  EXPECT_GE(told, 0.78 * 400e3 * (length - 8) * x / length / load);
}

TEST(SizeLeftOut, OfDragIsNotToldWhereItIsKept) {
  const auto kept = respond(froude_test::parse(module_in_waves(0.1, on_cylinders, "drag = { height = \"1 m\" }, ")));
  EXPECT_THAT(kept.notes, Not(Contains(HasSubstr("drag left out"))));
}

}  // namespace
}  // namespace size_left_out_test
