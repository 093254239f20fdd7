// How large what a linear response leaves out is, held against runs and against the response with that effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "scenes.hpp"
#include "support/pontoons.hpp"

namespace size_left_out_test {
namespace {

using namespace froude;
using testing::AllOf, testing::Contains, testing::HasSubstr;

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

TEST(SizeLeftOut, OfDragIsNotToldWhereItIsKeptOrACurrentFlows) {
  const auto kept = respond(froude_test::parse(module_in_waves(0.1, on_cylinders, "drag = { height = \"1 m\" }, ")));
  EXPECT_THAT(kept.notes, Not(Contains(HasSubstr("drag left out"))));
  std::string text = module_in_waves(0.1, on_cylinders);
  text.insert(text.find("[waves]"), "[current]\nvelocity = \"(0.5, 0, 0) m/s\"\n");
  EXPECT_THAT(respond(froude_test::parse(text)).notes,
              Contains(AllOf(HasSubstr("drag left out"), HasSubstr("a current flows"))));
}

}  // namespace
}  // namespace size_left_out_test
