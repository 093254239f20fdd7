// Contacts of scenes: what is read, and modules that collide in steep waves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "hydro/base/error.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "support/source_dir.hpp"

namespace contact_test {
namespace {

using namespace froude;
using froude_test::parse;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string scene_text(const std::string& contact) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "10 m"
[[body]]
name = "crate"
position = "(0, 0, 3) m"
mass = "100 kg"
centre_of_gravity = "(0, 0, 0.25) m"
radii_of_gyration = "(0.2, 0.2, 0.2) m"
weight = true
[[contact]]
)" + contact +
         R"([ask]
run = { duration = "2 s", every = "0.01 s" }
)";
}

const std::string on_corners = R"(between = ["crate", "ground"]
kind = "plane"
points = "(±0.25, ±0.25, 0) m"
at = "(0, 0, 2) m"
normal = "z"
restitution = 0.2
friction = 0.5
)";

// It falls 1 m, bounces and lies on its four corners, which carry a quarter of its weight each.
TEST(ContactInAScene, LetsACrateFallOnItsCorners) {
  const froude::Run run = simulate(parse(scene_text(on_corners)));
  ASSERT_TRUE(run.stopped.empty()) << run.stopped;
  EXPECT_NEAR(run.signal("crate.heave").back(), -1, 1e-9);
  for (int i = 1; i <= 4; ++i) {
    EXPECT_NEAR(run.signal(fmt::format("contact{}.gap", i)).back(), 0, 1e-9);
    EXPECT_NEAR(run.signal(fmt::format("contact{}.force", i)).back(), 100 * 9.81 / 4, 0.01)
        << "as even as Newton leaves it";
    EXPECT_GT(run.signal(fmt::format("contact{}.impacts", i)).back(), 0);
  }
  EXPECT_NEAR(run.signal("energy.contact.dissipated").back(), 100 * 9.81, 1e-6 * 981) << "all that it fell";
}

TEST(ContactInAScene, OfABoxOrOfRodsActsWhereTheShapesAre) {
  const auto box = compile::prepare(parse(scene_text(R"(between = ["crate", "ground"]
kind = "box"
points = "(0, 0, -0.5) m"
radius = "0.5 m"
from = "(-1, -1, 0) m"
to = "(1, 1, 1.5) m"
restitution = 0
)")));
  const dynamics::ContactKind kind(box.contacts);
  const auto rest = dynamics::rest_state(box.bodies);
  EXPECT_NEAR(kind.gap(0, rest), 3 - 0.5 - 0.5 - 1.5, 1e-12);
  const auto rods = compile::prepare(parse(scene_text(R"(between = ["crate", "ground"]
kind = "rods"
first = { from = "(0, 0, -1) m", to = "(0, 0, 1) m", diameter = "0.4 m" }
second = { from = "(2, -1, 3) m", to = "(2, 1, 3) m", diameter = "0.2 m" }
restitution = 0
)")));
  EXPECT_NEAR(dynamics::ContactKind(rods.contacts).gap(0, rest), 2 - 0.2 - 0.1, 1e-12);
}

TEST(ContactInAScene, IsRefusedWithItsPlace) {
  const auto expect = [](const std::string& contact, const std::string& message) {
    EXPECT_THAT([&] { parse(scene_text(contact)); }, ThrowsMessage<hydro::InputError>(HasSubstr(message)));
  };
  expect(
      "between = [\"crate\", \"crate\"]\nkind = \"plane\"\npoints = \"(0,0,0) m\"\nat = \"(0,0,0) m\"\nnormal = "
      "\"z\"\nrestitution = 0\n",
      "stands twice");
  expect(
      "between = [\"crate\", \"ground\"]\nkind = \"plane\"\npoints = \"(0,0,0) m\"\nat = \"(0,0,0) m\"\nnormal = "
      "\"z\"\nrestitution = 1.2\n",
      "restitution = 1.2");
  expect(
      "between = [\"crate\", \"ground\"]\nkind = \"box\"\npoints = \"(0,0,0) m\"\nfrom = \"(0,0,0) m\"\nto = \"(1,1,0) "
      "m\"\nrestitution = 0\n",
      "a box without volume");
}

// Five at once in steep waves: no gap is ever crossed, and what contact takes is in the ledger. The residual is that of
// the step: 0.0005 to 0.0025 of the turnover as the waves change by a thousandth, 0.0003 at a quarter of the step.
TEST(ContactInAScene, KeepsFiveModulesApartInSteepWaves) {
  const froude::Run run = simulate(scene::read(froude_test::source_dir() / "examples/fenders.toml"));
  ASSERT_TRUE(run.stopped.empty()) << run.stopped;
  double impacts = 0;
  for (int i = 1; i <= 8; ++i) {
    const auto& gap = run.signal(fmt::format("fender{}.gap", i));
    EXPECT_GT(*std::min_element(gap.begin(), gap.end()), -1e-9) << i;
    impacts += run.signal(fmt::format("fender{}.impacts", i)).back();
  }
  EXPECT_GT(impacts, 20);
  EXPECT_GT(run.signal("energy.contact.dissipated").back(), 0);
  double residual = 0, turnover = 0;
  for (const auto& [name, joules] : run.energy) {
    if (name == "residual") residual = joules;
    if (name == "turnover") turnover = joules;
  }
  EXPECT_LT(std::abs(residual), 4e-3 * turnover);
}

/// A block of 2 kg on four rough pads, pushed by up to 10 N askew.
std::string pushed_block(const std::string& accuracy) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "10 m"
[[body]]
name = "a"
mass = "2 kg"
centre_of_gravity = "(0, 0, 0) m"
inertia = "(1, 1, 1) kg m^2"
weight = true
[[load]]
on = "a"
force = "(6, 8, 0) N"
ramp_up = "10 s"
[[contact]]
name = "g"
between = ["a", "ground"]
kind = "plane"
points = "(±0.3, ±0.3, 0) m"
at = "(0, 0, 0) m"
normal = "z"
restitution = 0
friction = 0.3
[ask]
run = { duration = "14 s", every = "0.05 s", of = ["a.surge", "a.sway"] }
accuracy = )" +
         accuracy + "\n";
}

// The neighbour of a body that lies on something is moved in its velocities alone: moved into the floor it was refused,
// as shapes that overlap where the run starts.
TEST(ContactInAScene, ABlockThatRestsIsJudgedByANeighbourThatRestsToo) {
  const froude::Run run = simulate(scene::parse(pushed_block("1e-2"), "scene.toml"));
  ASSERT_TRUE(run.stopped.empty()) << run.stopped;
  // It slips from μmg = 5.886 N at 5.886 s on, with (t − 5.886)/2 m/s² until 10 s and 2.057 m/s² for 4 s more.
  constexpr double friction = 0.3 * 2 * 9.81, rising = 10 - friction, after = 4;
  const double way = rising * rising * rising / 12 + rising * rising / 4 * after + rising / 2 * after * after / 2;
  EXPECT_NEAR(run.signal("a.surge").back(), 0.6 * way, 1e-2 * 0.6 * way);  // the accuracy asked
  EXPECT_NEAR(run.signal("a.sway").back(), 0.8 * way, 1e-2 * 0.8 * way);
}

/// A ball of 1 kg falls a metre on a table that a rig moves up and down.
std::string driven_table(const std::string& duration, const std::string& step) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "10 m"
[[body]]
name = "t"
mass = "5 kg"
centre_of_gravity = "(0, 0, 0) m"
inertia = "(1, 1, 1) kg m^2"
[[body]]
name = "b"
position = "(0, 0, 1) m"
mass = "1 kg"
centre_of_gravity = "(0, 0, 0) m"
inertia = "(1, 1, 1) kg m^2"
weight = true
[[joint]]
name = "rig"
kind = "slider"
between = ["ground", "t"]
at = "(0, 0, 0) m"
axis = "z"
prescribed = { amplitude = "0.2 m", period = "1.7 s" }
[[contact]]
name = "c"
between = ["b", "t"]
kind = "plane"
points = "(0, 0, 0) m"
at = "(0, 0, 0) m"
normal = "z"
restitution = 0.6
[ask]
run = { duration = ")" +
         duration + R"(", every = "0.05 s", of = ["b.heave", "t.heave", "c.impacts"] }
[solve]
step = ")" +
         step + "\"\n";
}

// In a blow the rig works by its impulse times the speed of the table. The residual is what the trapezium rule leaves
// of the rig's power, of order 2; without that work it was 0.4 J at the first blow, some 2 % whatever the step.
TEST(ContactInAScene, ADrivenTableWorksInABlow) {
  const auto residual = [](const std::string& duration, const std::string& step) {
    const froude::Run run = simulate(parse(driven_table(duration, step)));
    EXPECT_TRUE(run.stopped.empty()) << run.stopped;
    EXPECT_GE(run.signal("c.impacts").back(), 1);
    return run.relative_residual();
  };
  EXPECT_LT(residual("0.6 s", "0.01 s"), 1e-3);
  EXPECT_LT(residual("6 s", "0.001 s"), 1e-2);  // thirty blows and what ends their series
}

}  // namespace
}  // namespace contact_test
