// Linear scenes answered without stepping, against the same scenes stepped and against their RAOs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "answers/simulate.hpp"
#include "compile/kept.hpp"
#include "hydro/base/error.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "support/pontoons.hpp"

namespace steady_test {
namespace {

using namespace froude;
using froude_test::parse;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string scene_text(const std::string& waves, const std::string& start, const std::string& more = {}) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
heading = "0 deg"
)" + waves +
         "\n" + support::pontoons(2, "(-6.5, 0, 0) m") + R"(free = ["surge", "heave", "pitch"]
[body.hydrodynamics]
excitation = true
radiation = { memory = "60 s", accept_error = 2 }
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(±5.2, ±5.2, 0) m"
diameter = "1.6 m"
draught = "1.13 m"
frequencies = "0.1 rad/s .. 5 rad/s, 99 values"
[[mooring]]
on = ["m*"]
kind = "linear"
stiffness = { surge = "4280 N/m" }
damping = { surge = "1500 N s/m" }
)" + more +
         R"(
[ask]
run = { duration = "400 s", every = "0.1 s", )" +
         start + R"( }
accuracy = 3e-3
)";
}

/// The coefficients of the cylinders are computed once for the scenes of a test.
froude::Run simulated(const std::string& text) {
  static const auto kept = std::make_shared<compile::Kept>();
  return simulate(parse(text), {}, {}, kept);
}

double largest(const std::vector<double>& x, std::size_t from) {
  double out = 0;
  for (std::size_t i = from; i < x.size(); ++i) out = std::max(out, std::abs(x[i]));
  return out;
}

// Small waves, so that what is not linear in a run, rotations squared, is below the tolerance. After the start has died
// out both are the same motion to 1 %: coefficients, memory and step take their parts of an accuracy of 0.3 %.
TEST(SteadyRun, AgreesWithTheSameSceneStepped) {
  const std::string sea =
      "kind = \"jonswap\"\nhs = \"0.1 m\"\ntp = \"6 s\"\nseed = 3\ncomponents = { repetition = \"400 s\" }\n";
  const froude::Run steady = simulated(scene_text(sea, "start = \"steady\""));
  const froude::Run stepped = simulated(scene_text(sea + "ramp = \"20 s\"\n", "of = [\"*\"]"));
  EXPECT_EQ(steady.steps, 0u);
  constexpr std::size_t settled = 2500;
  for (const char* name : {"wave.elevation", "m1.surge", "m1.heave", "m1.pitch", "m2.surge", "m2.heave", "m2.pitch"}) {
    const auto &x = steady.signal(name), &y = stepped.signal(name);
    ASSERT_EQ(x.size(), y.size());
    double off = 0;
    for (std::size_t i = settled; i < x.size(); ++i) off = std::max(off, std::abs(x[i] - y[i]));
    EXPECT_LT(off, 0.01 * largest(y, settled)) << name;
  }
}

TEST(SteadyRun, OfARegularWaveIsItsRao) {
  const froude::Run run =
      simulated(scene_text("kind = \"regular\"\nheight = \"2 m\"\nperiod = \"5 s\"\n", "start = \"steady\""));
  const auto& heave = run.signal("m1.heave");
  EXPECT_NEAR(heave[0], heave[50], 1e-9 * largest(heave, 0)) << "a period later";
  EXPECT_THAT(run.notes, testing::Contains(HasSubstr("without stepping")));
}

TEST(SteadyRun, IsRefusedWhereTheSceneIsNotLinear) {
  const std::string regular = "kind = \"regular\"\nheight = \"2 m\"\nperiod = \"5 s\"\n";
  const auto expect = [](const std::string& text, const char* message) {
    EXPECT_THAT([&] { simulated(text); }, ThrowsMessage<hydro::InputError>(HasSubstr(message)));
  };
  expect(scene_text(regular, "start = \"steady\"",
                    "[[member]]\non = \"m*\"\nfrom = \"(0, 0, -1) m\"\nto = \"(0, 0, 0) m\"\ndiameter = \"1 m\"\ndrag "
                    "= { cd = 1.0 }\n"),
         "drag on members");
  expect(scene_text(regular + "ramp = \"10 s\"\n", "start = \"steady\""), "no beginning");
}

}  // namespace
}  // namespace steady_test
