// Responses to waves of several headings, from scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "answers/linear_response.hpp"
#include "hydro/base/error.hpp"
#include "scenes.hpp"
#include "support/pontoons.hpp"

namespace rao_headings_test {
namespace {

using namespace froude;
using testing::AllOf, testing::HasSubstr, testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;

Responses responses(std::string text, const std::string& headings) {
  const std::string placeholder = "HEADINGS";
  text.replace(text.find(placeholder), placeholder.size(), headings);
  return respond(froude_test::parse(text));
}

/// Values of one signal in waves of heading number h.
std::vector<std::complex<double>> of_heading(const Responses& all, const std::string& name, std::size_t h) {
  const auto begin = all.signal(name).values.begin() + static_cast<std::ptrdiff_t>(h * all.omega.size());
  return {begin, begin + static_cast<std::ptrdiff_t>(all.omega.size())};
}

double largest(const std::vector<std::complex<double>>& values) {
  double out = 0;
  for (const auto& v : values) out = std::max(out, std::abs(v));
  return out;
}

/// Largest |a − sign b|.
double farthest(std::vector<std::complex<double>> a, const std::vector<std::complex<double>>& b, double sign = 1) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= sign * b[i];
  return largest(a);
}

/// Each heading of `headings`, degrees, is what a scene that asks for it alone gets, to `error` of the largest value.
void expect_one_by_one(const std::string& text, const std::vector<double>& headings, double error) {
  std::vector<std::string> list;
  for (const double h : headings) list.push_back(fmt::format("\"{} deg\"", h));
  const Responses all = responses(text, fmt::format("headings = [{}]", fmt::join(list, ", ")));
  ASSERT_EQ(all.heading.size(), headings.size());
  for (std::size_t h = 0; h < headings.size(); ++h) {
    EXPECT_NEAR(all.heading[h], headings[h] * degree, 1e-15);
    const Responses alone = responses(text, "heading = " + list[h]);
    ASSERT_EQ(alone.heading.size(), 1u);
    for (const ComplexSignal& s : alone.signals) {
      double size = 0;  // of what has this unit: a load that is zero by symmetry has no size of its own
      for (const ComplexSignal& other : all.signals)
        if (other.units == s.units) size = std::max(size, largest(other.values));
      EXPECT_LE(farthest(of_heading(all, s.name, h), s.values), error * size) << s.name << " at " << headings[h];
    }
  }
}

/// Three modules on hinges: motions, angles, connectors' forces and what the hinges carry.
const std::string hinged = froude_test::water + support::pontoons(3, "(-26, 0, 0) m") +
                           R"([body.hydrodynamics]
file = "pontoon5.nc"
body = 1
excitation = true
radiation = { memory_tolerance = 1e-2 }
hydrostatics = true
[[joint]]
name = "hinge"
kind = "hinge"
between = "neighbours of m"
at = "(-19.5, 0, 0.5) m"
axis = "y"
[[mooring]]
on = ["m1", "m3"]
kind = "linear"
stiffness = { surge = "4280 N/m", sway = "10348 N/m", yaw = "15839 N m/rad" }
[ask]
rao = { periods = "3 s .. 8 s, 5 values", HEADINGS }
)";

// Only the order of sums differs; the equations of bodies on joints have a condition of some 1e3.
TEST(RaoHeadings, OfASceneAreThoseOfOneByOne) { expect_one_by_one(hinged, {90, 0, 30}, 1e-11); }

/// A module whose drag is linear for waves of half a metre.
const std::string with_drag = froude_test::water + support::pontoons(1) + R"([body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = {}
hydrostatics = true
[[member]]
on = "m1"
from = "(±5.2, ±5.2, -1.13) m"
to = "(±5.2, ±5.2, 0) m"
diameter = "1.6 m"
drag = { cd = 1.0 }
[[mooring]]
on = "m1"
kind = "linear"
stiffness = { surge = "12300 N/m", sway = "10348 N/m", yaw = "15839 N m/rad" }
[ask]
rao = { periods = "5 s .. 7 s, 3 values", drag = { height = "0.5 m" }, HEADINGS }
)";

// Drag depends on where the waves go, so that each heading is the very computation that it is alone.
TEST(RaoHeadings, WithLinearDragAreIteratedEachByItself) {
  expect_one_by_one(with_drag, {45, 0}, 0);
  const Responses all = responses(with_drag, "headings = [\"0 deg\", \"45 deg\"]");
  EXPECT_THAT(all.notes,
              testing::Contains(AllOf(HasSubstr("drag on members is linear"),
                                      HasSubstr("each of the 2 was found by iteration with factors of its"))));
  EXPECT_THAT(responses(with_drag, "heading = \"0 deg\"").notes, testing::Each(testing::Not(HasSubstr("iteration"))));
}

/// Columns alike on port and starboard, unlike fore and aft, computed for the headings asked.
const std::string float_on_columns = R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "40 m"
[[body]]
name = "b"
mass = "1017.9 t"
centre_of_gravity = "(0, 0, -4) m"
radii_of_gyration = "(7, 7, 8) m"
[body.hydrodynamics]
excitation = true
radiation = {}
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(-5, ±8.66, 0) m"
diameter = "6 m"
draught = "12 m"
others = [{ at = "(10, 0, 0) m", diameter = "6 m", draught = "12 m" }]
frequencies = "0.4 rad/s .. 1.2 rad/s, 5 values"
[[mooring]]
on = "b"
kind = "linear"
stiffness = { surge = "60 kN/m", sway = "60 kN/m", yaw = "8 MN m/rad" }
[ask]
rao = { periods = "6 s .. 12 s, 4 values", HEADINGS }
)";

// Seen in the mirror y → −y the body is itself, a wave of heading β goes towards −β, and sway, roll and yaw turn round.
TEST(RaoHeadings, OfASymmetricBodyAreMirroredByMirroredWaves) {
  const Responses all =
      responses(float_on_columns, "headings = [\"-40 deg\", \"110 deg\", \"40 deg\", \"-110 deg\", \"0 deg\"]");
  for (const auto& [name, sign] :
       {std::pair{"b.surge", 1}, {"b.sway", -1}, {"b.heave", 1}, {"b.roll", -1}, {"b.pitch", 1}, {"b.yaw", -1}}) {
    const double size = largest(all.signal(name).values);
    EXPECT_GT(size, 1e-3) << name;
    EXPECT_LT(farthest(of_heading(all, name, 0), of_heading(all, name, 2), sign), 1e-9 * size) << name;
    EXPECT_LT(farthest(of_heading(all, name, 1), of_heading(all, name, 3), sign), 1e-9 * size) << name;
    if (sign < 0) {
      EXPECT_LT(largest(of_heading(all, name, 4)), 1e-9 * size) << name << " in head waves";
    }
  }
  EXPECT_GT(farthest(of_heading(all, "b.pitch", 0), of_heading(all, "b.pitch", 1)), 1e-3) << "headings differ";
}

TEST(RaoHeadings, OutsideTheDataAreRefusedWhereTheyAreAsked) {
  const auto line = 1 + std::count(with_drag.begin(),
                                   with_drag.begin() + static_cast<std::ptrdiff_t>(with_drag.find("rao = {")), '\n');
  const std::string place = fmt::format("test.toml:{}:", line);
  for (const char* asked :
       {"headings = \"0 deg .. 180 deg, 5 values\"", "headings = [\"0 deg\", \"135 deg\"]", "heading = \"135 deg\""})
    EXPECT_THAT([&] { responses(with_drag, asked); },
                ThrowsMessage<hydro::InputError>(AllOf(HasSubstr(place), HasSubstr("heading 135 deg is asked for"),
                                                       HasSubstr("from 0 to 90 deg"),
                                                       HasSubstr("froude bem convert --symmetric"))))
        << asked;
}

TEST(RaoHeadings, OfAQuestionMadeByHandMustBeStated) {
  std::string text = with_drag;
  text.replace(text.find("HEADINGS"), 8, "heading = \"0 deg\"");
  scene::Scene scene = froude_test::parse(text);
  scene.rao->headings.clear();
  EXPECT_THAT([&] { respond(scene); }, ThrowsMessage<std::logic_error>(HasSubstr("without a heading")));
  scene.rao.reset();
  EXPECT_THROW(respond(scene), std::logic_error);
}

}  // namespace
}  // namespace rao_headings_test
