#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/harmonics.hpp"
#include "hydro/waves/dispersion.hpp"
#include "scenes.hpp"
#include "support/pontoons.hpp"

namespace rao_drag_test {
namespace {

using namespace froude;
using testing::HasSubstr, testing::ThrowsMessage;

/// One module moored so that its surge has the period of the waves, which nothing but drag and radiation limit.
std::string moored_module(const std::string& drag, const std::string& of_rao) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "regular"
height = "0.8 m"
period = "7 s"
heading = "0 deg"
ramp = "20 s"
)" + support::pontoons(1) +
         R"(free = ["surge", "heave", "pitch"]
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = { memory_tolerance = 2e-2 }
hydrostatics = true
[[mooring]]
on = ["m1"]
kind = "linear"
stiffness = { surge = "12300 N/m" }
)" + drag +
         "[ask]\nrao = { periods = \"7 s .. 7.1 s, 2 values\", " + of_rao + R"(of = ["m1.*"] }
run = { duration = "300 s", every = "0.1 s", of = ["m1.*"] }
)";
}
const std::string on_cylinders =
    "[[member]]\non = \"m1\"\nfrom = \"(±5.2, ±5.2, -1.13) m\"\nto = \"(±5.2, ±5.2, 0) m\"\ndiameter = \"1.6 "
    "m\"\ndrag = { cd = 1.0 }\n";

double surge_of(const std::string& text) {
  const auto response = respond(froude_test::parse(text));
  return std::abs(response.signal("m1.surge").values.back());  // at 7 s
}

TEST(RaoDrag, IsWhatARunWithQuadraticDragShows) {
  const scene::Scene scene = froude_test::parse(moored_module(on_cylinders, "drag = { height = \"0.8 m\" }, "));
  const auto response = respond(scene);
  const froude::Run run = simulate(scene);
  const std::vector<double> last_time(run.time.end() - 701, run.time.end() - 1);  // ten periods
  const std::vector<double> omega{2 * std::numbers::pi / 7};
  for (const char* name : {"m1.surge", "m1.heave", "m1.pitch"}) {
    const auto& all = run.signal(name);
    const std::vector<double> last(all.end() - 701, all.end() - 1);
    const auto of_run = hydro::signal::fit_harmonics(last_time, last, omega).amplitude.at(0) / 0.4;
    const auto of_rao = response.signal(name).values.back();  // frequencies increase: 7 s comes last
    // Harmonics of the drag are what a response of one frequency leaves out.
    EXPECT_LT(std::abs(of_run - of_rao), 0.02 * std::abs(of_rao)) << name << ' ' << of_run << ' ' << of_rao;
  }
}

TEST(RaoDrag, TakesHalfTheResonanceAndVanishesInSmallWaves) {
  const double without = surge_of(moored_module(on_cylinders, ""));
  EXPECT_LT(surge_of(moored_module(on_cylinders, "drag = { height = \"0.8 m\" }, ")), 0.7 * without);
  EXPECT_NEAR(surge_of(moored_module(on_cylinders, "drag = { height = \"10 um\" }, ")) / without, 1, 1e-3);
}

TEST(RaoDrag, ByHeightAndBySteepnessAreTheSameWhereTheWavesAre) {
  const scene::Scene by_height = froude_test::parse(moored_module(on_cylinders, "drag = { height = \"0.8 m\" }, "));
  const double length = 2 * std::numbers::pi / hydro::waves::wavenumber(2 * std::numbers::pi / 7, by_height.water);
  const double by_steepness =
      surge_of(moored_module(on_cylinders, fmt::format("drag = {{ steepness = {} }}, ", 0.8 / length)));
  EXPECT_NEAR(by_steepness / std::abs(respond(by_height).signal("m1.surge").values.back()), 1, 1e-9);
}

TEST(RaoDrag, IsToldWhetherItActsOrIsLeftOut) {
  const auto without = respond(froude_test::parse(moored_module(on_cylinders, "")));
  EXPECT_THAT(without.notes, testing::Contains(HasSubstr("drag on members is left out")));
  const auto with = respond(froude_test::parse(moored_module(on_cylinders, "drag = { steepness = 0.02 }, ")));
  EXPECT_THAT(with.notes, testing::Contains(HasSubstr("steepness 0.02")));
}

TEST(RaoDrag, NeedsDragAndStillWater) {
  EXPECT_THAT([] { froude_test::parse(moored_module("", "drag = { height = \"0.8 m\" }, ")); },
              ThrowsMessage<hydro::InputError>(HasSubstr("no member names drag")));
  std::string text = moored_module(on_cylinders, "drag = { height = \"0.8 m\" }, ");
  text.insert(text.find("[waves]"), "[current]\nvelocity = \"(0.5, 0, 0) m/s\"\n");
  EXPECT_THAT([&] { respond(froude_test::parse(text)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("no part for a current")));
}

}  // namespace
}  // namespace rao_drag_test
