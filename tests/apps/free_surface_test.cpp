// Fields of scenes: bodies that move take what their dampers take, however coarse the table of their coefficients is.
#include <gtest/gtest.h>

#include "answers/answers.hpp"
#include "apps/compile/scenes.hpp"

namespace free_surface_test {
namespace {

using namespace froude;

/// Two buoys 8 m apart, near their resonance in heave; the table has two frequencies.
scene::Scene two_buoys(const std::string& further) {
  return froude_test::parse(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "10 m"
[[body]]
name = "c"
copies = { count = 2, step = "(8, 3, 0) m" }
mass = "12566.4 kg"
free = ["surge", "heave"]
centre_of_gravity = "(0, 0, -0.5) m"
radii_of_gyration = "(1, 1, 1) m"
[body.hydrodynamics]
excitation = true
radiation = {}
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "4 m"
draught = "1 m"
frequencies = "1 rad/s .. 3 rad/s, 2 values"
)" + further + R"([ask]
field = { period = "3 s", heading = "25 deg", x = "20 m .. 30 m, 2 values", y = "20 m .. 30 m, 2 values" }
accuracy = 1e-3
)");
}

TEST(FieldOfAScene, HasBodiesThatTakeNothingWhereNothingDampsThem) {
  const FreeSurface f = free_surface(two_buoys(""));
  EXPECT_GT(f.power_sent_out, 1000);                            // W/m^2: waves of 4.9 kW/m at all
  EXPECT_NEAR(f.power_taken / f.power_sent_out, 0, 10 * 1e-4);  // coefficients of 1e-4, ten times that at a resonance
  EXPECT_GT(f.drift_x, 0);
}

TEST(FieldOfAScene, HasBodiesThatTakeWhatDampersTake) {
  const FreeSurface f = free_surface(two_buoys("[[damping]]\non = \"c1\"\nlinear = { heave = \"5000 N s/m\" }\n"));
  EXPECT_GT(f.power_taken, 0.02 * f.power_sent_out);
}

}  // namespace
}  // namespace free_surface_test
