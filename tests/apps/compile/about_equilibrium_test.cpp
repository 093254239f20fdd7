// Linear responses about where bodies balance: of a moored module that wind has pushed aside, against a run there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/harmonics.hpp"

namespace about_equilibrium_test {
namespace {

using namespace froude;
constexpr double period = 5;

/// On four chains in a wind that takes it some metres away, turned by a load beside its centre.
std::string scene_text(const std::string& about) {
  return froude_test::water + R"([waves]
kind = "regular"
amplitude = "0.01 m"
period = "5 s"
heading = "30 deg"
ramp = "60 s"
[[body]]
name = "module"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = { memory_tolerance = 1e-4, accept_error = 0.02 }
hydrostatics = true
[[mooring]]
name = "damper"
on = "module"
kind = "linear"
damping = { surge = "4 kN s/m", sway = "4 kN s/m", yaw = "60 kN m s/rad" }
[[mooring]]
name = "chain"
on = "module"
kind = "catenary"
from = "(±5.2, ±5.2, -1.1) m"
to = "(±45, ±45, -14) m"
length = "59 m"
mass_per_length = "8 kg/m"
diameter = "36 mm"
axial_stiffness = "30 MN"
on_bed = true
[[load]]
name = "wind"
on = "module"
at = "(0, 4, 6) m"
force = "(12000, 3000, -6000) N"
[ask]
run = { start = "equilibrium", duration = "300 s", every = "0.1 s", of = ["module.*", "chain*"] }
rao = { periods = "4 s .. 5 s, 2 values", of = ["module.*", "chain*"], about = ")" +
         about + R"(" }
modes = { about = "equilibrium" }
accuracy = 1e-3
)";
}

TEST(AboutEquilibrium, ResponsesAreThoseOfARunThatSwingsThere) {
  const scene::Scene scene = froude_test::parse(scene_text("equilibrium"));
  const Responses linear = respond(scene);
  const froude::Run run = simulate(scene);
  ASSERT_EQ(run.stopped, "");
  EXPECT_GT(std::abs(run.signal("module.surge").front()), 0.5) << "far from where it was placed";
  EXPECT_GT(std::abs(run.signal("module.pitch").front()), 0.02);
  const auto begin = static_cast<std::ptrdiff_t>(std::lround(200 / 0.1));
  const std::vector<double> time(run.time.begin() + begin, run.time.end());
  const double omegas[] = {2 * std::numbers::pi / period};
  for (const ComplexSignal& s : linear.signals) {
    const auto& all = run.signal(s.name);
    const auto of_run =
        hydro::signal::fit_harmonics(time, {all.begin() + begin, all.end()}, omegas).amplitude.at(0) / 0.01;
    // 1 % is the promise of Agreement, for the same reasons; yaw and sway are small beside what couples into them.
    const double scale = s.units == "m/m" ? 0.3 : s.units == "N/m" ? 100 : 0.03;
    EXPECT_LT(std::abs(of_run - s.values.front()), 0.01 * std::abs(s.values.front()) + 2e-3 * scale)
        << s.name << ": run " << of_run << ", rao " << s.values.front();
  }
}

TEST(AboutEquilibrium, TheNotesTellWhereItIs) {
  const Responses linear = respond(froude_test::parse(scene_text("equilibrium")));
  bool told = false;
  for (const auto& note : linear.notes) told = told || note.find("about the equilibrium, module.") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(AboutEquilibrium, AsPlacedItIsNotAtRest) {
  EXPECT_THROW(respond(froude_test::parse(scene_text("as placed"))), hydro::InputError);
}

/// A pendulum upside down: its weight turns it by mgl = 9088 · 9.81 · 1.31 N m = 116.8 kN m/rad, against a spring of
/// `roll` kN m/rad.
std::string top_heavy(const std::string& roll, const std::string& start) {
  return froude_test::water + R"([waves]
kind = "regular"
amplitude = "0.1 m"
period = "5 s"
heading = "90 deg"
[[body]]
name = "b"
mass = "9088 kg"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
centre_of_gravity = "(0, 0, 1.31) m"
weight = true
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
[[joint]]
name = "hinge"
kind = "hinge"
between = ["ground", "b"]
at = "(0, 0, 0) m"
axis = "x"
[[mooring]]
on = "b"
kind = "linear"
stiffness = { roll = ")" +
         roll + R"( kN m/rad" }
[ask]
run = { duration = "2 s", every = "0.1 s", start = ")" +
         start + R"(" }
rao = { periods = "4 s .. 5 s, 2 values" }
modes = {}
)";
}

// Nothing lasts about a rest that is not stable: neither responses nor runs that begin there tell what bodies do.
TEST(UnstableRest, IsRefusedByNameWhereSomethingShouldLast) {
  using testing::HasSubstr, testing::ThrowsMessage;
  const auto refused =
      ThrowsMessage<hydro::InputError>(HasSubstr("no stable equilibrium: a motion of b.sway, b.roll has"));
  const scene::Scene topples = froude_test::parse(top_heavy("116", "equilibrium"));
  EXPECT_THAT([&] { respond(topples); }, refused);
  EXPECT_THAT([&] { simulate(topples); }, refused);
  EXPECT_EQ(simulate(froude_test::parse(top_heavy("116", "as placed"))).stopped, "");
  const scene::Scene stands = froude_test::parse(top_heavy("118", "equilibrium"));
  EXPECT_NO_THROW(respond(stands));
  EXPECT_EQ(simulate(stands).stopped, "");
}

}  // namespace
}  // namespace about_equilibrium_test
