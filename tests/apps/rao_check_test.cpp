// Responses held against runs: where a scene is linear they agree, and what is not linear shows as large as it is.
#include "answers/rao_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "answers/linear_response.hpp"
#include "compile/compile.hpp"
#include "compile/scenes.hpp"
#include "hydro/waves/dispersion.hpp"

namespace rao_check_test {
namespace {

using namespace froude;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi, steepness = 0.01;

/// A float, 6 m wide and 2 m deep, that heaves in waves of 3 to 6 s, about its natural period.
scene::Scene buoy(const std::string& damping = "") {
  return froude_test::parse(froude_test::water + R"([[body]]
name = "m"
mass = "56549 kg"
free = ["heave"]
[body.hydrodynamics]
hydrostatics = true
excitation = true
radiation = {}
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "6 m"
draught = "2 m"
frequencies = "0.1 rad/s .. 6 rad/s, 60 values"
)" + damping + R"([ask]
rao = { omega = "1 rad/s .. 2 rad/s, 9 values", heading = "0 deg", of = ["m.heave", "wave.elevation"] }
accuracy = 1e-2
)");
}

TEST(RaoCheck, OfALinearSceneIsItsResponse) {
  const scene::Scene scene = buoy();
  const Responses linear = respond(scene);
  const auto cells = check_in_time(scene, linear, steepness);
  ASSERT_EQ(cells.size(), 3u);  // the elevation of the waves is no answer to check
  for (std::size_t i = 0; i < 3; ++i) {
    const CheckedCell& c = cells[i];
    EXPECT_EQ(c.signal, "m.heave");
    EXPECT_EQ(c.omega, linear.omega[(i + 1) * 9 / 4]);
    EXPECT_NEAR(c.height, steepness * 2 * pi / hydro::waves::wavenumber(c.omega, scene.water), 1e-12);
    EXPECT_LT(c.difference(), 2e-2) << c.omega;  // the accuracy of the run, of a peak that is near twice each value
    EXPECT_LT(c.unsettled, 1e-2);
    EXPECT_LT(c.rest, 2e-2 * c.peak);
  }
}

// −q|v|v takes as much as (8/3π) q ω|x|: X = (Z + iω (8/3π) q ω|x|) x, with X = Z x_linear. Its third harmonic is a
// fifth of the first, far above the resonance.
TEST(RaoCheck, TellsHowMuchQuadraticDampingTakes) {
  constexpr double q = 100e3;
  const scene::Scene scene = buoy("[[damping]]\non = \"m\"\nquadratic = { heave = \"100 kN s^2/m^2\" }\n");
  const Responses linear = respond(scene);
  const auto prepared = compile::prepare(scene);
  double most = 0;
  for (const CheckedCell& c : check_in_time(scene, linear, steepness)) {
    const double amplitude = c.height / 2;
    const Complex X = prepared.groups[0].table.excitation(c.omega, 0)(2), Z = X / c.linear;
    double size = std::abs(c.linear);
    for (int i = 0; i < 200; ++i)
      size = (size + std::abs(X / (Z + Complex(0, 8 / (3 * pi) * q * c.omega * c.omega * size * amplitude)))) / 2;
    const Complex expected = X / (Z + Complex(0, 8 / (3 * pi) * q * c.omega * c.omega * size * amplitude));
    EXPECT_LT(std::abs(c.run - expected), 2e-2 * c.peak) << c.omega;
    EXPECT_NEAR(c.difference(), std::abs(expected - c.linear) / c.peak, 2e-2) << c.omega;
    most = std::max(most, c.difference());
  }
  EXPECT_GT(most, 0.05) << "the damping is to be seen";
}

// A frame of columns that Morison's equation alone moves, its drag linear in waves of 0.5 m: runs are in such waves.
// What the equivalent linearisation misses at the resonance of 9.7 s is below a hundredth of the peak; runs add 1e-3.
TEST(RaoCheck, OfLinearDragIsInTheWavesThatItIsLinearFor) {
  scene::Scene scene = scene::read(froude_test::examples / "frame.toml");
  scene.accuracy.value = 1e-3;
  const Responses linear = respond(scene);
  for (const CheckedCell& c : check_in_time(scene, linear)) {
    EXPECT_EQ(c.height, 0.5);
    EXPECT_LT(c.difference(), 1e-2) << c.signal << ' ' << c.omega;
  }
  const auto low = check_in_time(scene, linear, 0.002);
  EXPECT_GT(low.front().difference(), 0.05) << "in lower waves there is less drag than was put in";
}

}  // namespace
}  // namespace rao_check_test
