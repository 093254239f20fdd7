// One list of signals for runs and responses: whatever has a response agrees with a run in small waves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "answers/linear_response.hpp"
#include "apps/compile/scenes.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/harmonics.hpp"
#include "support/pontoons.hpp"

namespace signal_agreement_test {
namespace {

using namespace froude;

constexpr double amplitude = 0.01, period = 5;  // m, s

/// Two hinged modules with a take-off between them, a matrix, a catenary and a taut rope that hold them, and what a
/// scene may name: points, air gaps, relative motions, net loads.
std::string scene_text() {
  return fmt::format(R"({}[waves]
kind = "regular"
amplitude = "{} m"
period = "{} s"
heading = "30 deg"
ramp = "60 s"
{}net_load = true
[body.hydrodynamics]
file = "pontoon1.nc"
interaction = "self"
excitation = true
radiation = {{ memory_tolerance = 1e-4, accept_error = 0.5 }}
hydrostatics = true
[[mooring]]
name = "spring"
on = "m*"
kind = "linear"
stiffness = {{ surge = "4280 N/m", sway = "10348 N/m", yaw = "15839 N m/rad", surge_pitch = "900 N/rad" }}
damping = {{ surge = "4 kN s/m", sway = "4 kN s/m", yaw = "60 kN m s/rad" }}
[[mooring]]
name = "chain"
on = "m1"
kind = "catenary"
from = "(-6, ±3, -1) m"
to = "(-60, ±33, -14) m"
length = "70 m"
mass_per_length = "12 kg/m"
diameter = "30 mm"
axial_stiffness = "20 MN"
on_bed = true
[[mooring]]
name = "back"
on = "m2"
kind = "catenary"
from = "(6, ±3, -1) m"
to = "(73, ±33, -14) m"
length = "70 m"
mass_per_length = "12 kg/m"
diameter = "30 mm"
axial_stiffness = "20 MN"
on_bed = true
[[line]]
name = "rope"
on = {{ from = "m1", to = "m2" }}
from = "(2, 4, 1) m"
to = "(-2, 4, 1) m"
length = "9 m"
segments = 3
mass_per_length = "0.02 kg/m"
axial_stiffness = "20 kN"
axial_damping = "100 N s"
[[joint]]
name = "hinge"
between = ["m1", "m2"]
kind = "hinge"
at = "(6.5, 0, 0.5) m"
axis = "y"
pto = {{ stiffness = "20 kN m/rad", damping = "100 kN m s/rad" }}
[[point]]
name = "bow"
on = "m1"
at = "(-5, 2, 1.5) m"
gives = ["position", "velocity", "acceleration", "air_gap"]
[[relative_motion]]
name = "gangway"
between = ["m1", "m2"]
ends = ["(6, 4, 1) m", "(-6, 4, 1) m"]
[[probe]]
name = "staff"
at = "(20, 5, -1) m"
gives = ["elevation", "velocity", "acceleration", "pressure"]
[ask]
accuracy = 1e-3
)",
                     froude_test::water, amplitude, period, support::pontoons(2));
}

/// The shorter of two periods, which is the last: frequencies ascend.
const std::string ask_rao = "[ask.rao]\nperiods = \"5 s .. 6 s, 2 values\"\nabout = \"equilibrium\"\n";

/// The signals whose largest of their unit is so much larger that what is left over of the run hides them.
bool told(const ComplexSignal& s, const std::map<std::string, double>& largest) {
  return std::abs(s.values.back()) > 0.02 * largest.at(s.units);
}

TEST(SignalAgreement, OfRunsInSmallWavesAndResponses) {
  const Responses rao = respond(froude_test::parse(scene_text() + ask_rao));
  const froude::Run run = simulate(froude_test::parse(
      scene_text() + "[ask.run]\nstart = \"equilibrium\"\nduration = \"200 s\"\nevery = \"0.1 s\"\n"));
  ASSERT_EQ(run.stopped, "");
  ASSERT_NEAR(rao.omega.back(), 2 * std::numbers::pi / period, 1e-12);
  const double omegas[] = {2 * std::numbers::pi / period};
  const auto begin = static_cast<std::ptrdiff_t>(std::lround(150 / 0.1));
  const std::vector<double> time(run.time.begin() + begin, run.time.end());
  std::map<std::string, double> largest;  // by unit
  for (const auto& s : rao.signals) largest[s.units] = std::max(largest[s.units], std::abs(s.values.back()));
  std::size_t compared = 0;
  for (const auto& s : rao.signals) {
    if (!told(s, largest)) continue;
    const auto& all = run.signal(s.name);
    const auto of_run =
        hydro::signal::fit_harmonics(time, {all.begin() + begin, all.end()}, omegas).amplitude.at(0) / amplitude;
    ++compared;
    // The promise is 1 %; of each unit what the largest leaves over counts too.
    EXPECT_LT(std::abs(of_run - s.values.back()), 0.01 * std::abs(s.values.back()) + 2e-3 * largest[s.units])
        << s.name << ": run " << of_run << ", response " << s.values.back();
  }
  EXPECT_GT(compared, 60u);
  std::vector<std::string> names;
  for (const auto& s : rao.signals) names.push_back(s.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"spring1.surge", "spring2.pitch", "chain1.tension", "back2.anchor_tension",
                                            "rope.from.force", "rope.to.force", "hinge.pto_moment", "hinge.angle",
                                            "hinge.m1.force_x", "m1.net_force_z", "bow.z", "bow.velocity_x",
                                            "bow.acceleration_z", "bow.air_gap", "gangway.x", "wave.elevation",
                                            "staff.pressure", "staff.velocity_x"}));
}

TEST(SignalAgreement, WhatHasNoResponseSaysWhy) {
  const std::string rao = scene_text() + ask_rao;
  try {
    respond(froude_test::parse(rao + "of = [\"m1.heave\", \"hinge.pto_power\"]\n"));
    FAIL() << "power has no response per metre of wave";
  } catch (const hydro::InputError& e) {
    EXPECT_THAT(e.what(),
                testing::HasSubstr("\"hinge.pto_power\" has no response per metre of wave: power is of second order"));
    EXPECT_GT(e.where().line, 0);
  }
  const Responses some = respond(froude_test::parse(rao + "of = [\"hinge.pto_*\"]\n"));
  ASSERT_EQ(some.signals.size(), 1u);
  EXPECT_EQ(some.signals.front().name, "hinge.pto_moment");
  EXPECT_THAT(some.notes, testing::Contains(testing::HasSubstr("hinge.pto_power: power is of second order")));
}

// Whatever a run can tell, the list of responses knows by the same name, unit and meaning.
TEST(SignalAgreement, TheTwoListsAreOne) {
  const auto scene = froude_test::parse(scene_text() + "[ask.run]\nduration = \"1 s\"\nevery = \"0.5 s\"\n");
  const compile::Prepared prepared = compile::prepare(scene);
  const compile::TimeModel run = compile::time_model(scene, prepared);
  const dynamics::Model small = compile::frequency_model(prepared, {.equilibrium = true});
  std::vector<std::string> of_runs, of_responses;
  for (const auto& s : compile::signal_list(scene, run))
    if (!s.name.starts_with("energy.")) of_runs.push_back(s.name + " " + s.unit + " " + s.meaning);  // by effects
  for (const auto& s : compile::signal_list(scene, prepared, small))
    if (!s.name.starts_with("energy.")) of_responses.push_back(s.name + " " + s.unit + " " + s.meaning);
  EXPECT_THAT(of_runs, testing::UnorderedElementsAreArray(of_responses));
}

}  // namespace
}  // namespace signal_agreement_test
