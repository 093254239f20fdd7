// What has a state of its own goes through a checkpoint: the run that goes on from one has the bits of the undisturbed
// run, and that one, which is filled from the same bytes, is the run without checkpoints. A state that was forgotten is
// missing from both of the first two; only the third shows it (docs/decisions/0033).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

#include "answers/checkpoint.hpp"
#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/compile.hpp"
#include "hydro/base/error.hpp"
#include "support/scratch.hpp"

namespace checkpoint_states_test {
namespace {

using namespace froude;

struct Case {
  std::string name, scene;
  double duration, step;         // s
  std::vector<double> instants;  // s, of the one checkpoint at which a run is ended: what holds there is the case's
  double allowed;                // of the size of each signal, by which runs with and without checkpoints may differ
  std::string solve = "";
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

scene::Scene scene_of(const Case& c, double checkpoint) {
  const std::string kept = checkpoint > 0 ? fmt::format(", checkpoint = \"{} s\"", checkpoint) : "";
  return froude_test::parse(froude_test::water + c.scene +
                            fmt::format("[ask]\nrun = {{ duration = \"{} s\", every = \"{} s\"{} }}\naccuracy = "
                                        "1e-2\n[solve]\nstep = \"{} s\"\n{}",
                                        c.duration, c.step, kept, c.step, c.solve));
}

struct Ready {
  scene::Scene scene;
  compile::TimeModel model;
  Ready(const Case& c, double checkpoint)
      : scene(scene_of(c, checkpoint)), model(compile::time_model(scene, compile::prepare(scene))) {}
  Run run(const std::function<void(double)>& done = {}, const KeptRun& kept = {}) const {
    return run_model(scene, model, done, nullptr, nullptr, kept);
  }
};

/// The run is ended after its first checkpoint, which is always written, and gone on with.
Run ended_and_gone_on_with(const Ready& ready, const std::filesystem::path& folder, double share) {
  struct Ended {};
  const auto end_after = [share](double done) {
    if (done > share) throw Ended{};
  };
  Checkpoints first(folder, ready.scene, {});
  EXPECT_THROW(ready.run(end_after, {&first, "run"}), Ended);
  Checkpoints second(folder, ready.scene, {});
  Run out = ready.run({}, {&second, "run"});
  EXPECT_THAT(second.sentences(), testing::SizeIs(1)) << "it went on from its checkpoint";
  second.remove();
  return out;
}

void expect_same_bits(const Run& one, const Run& other) {
  EXPECT_EQ(one.time, other.time);
  ASSERT_EQ(one.signals.size(), other.signals.size());
  for (std::size_t i = 0; i < one.signals.size(); ++i)
    EXPECT_EQ(one.signals[i].values, other.signals[i].values) << one.signals[i].name;
  EXPECT_EQ(one.energy, other.energy);
  EXPECT_EQ(one.newton_iterations, other.newton_iterations);
  EXPECT_EQ(one.parts, other.parts);
  EXPECT_EQ(one.events, other.events);
  EXPECT_EQ(one.evaluations, other.evaluations);
}

/// Signals of one kind have one size: what should be zero is compared with what is not.
double size_of_kind(const Run& run, const std::string& units) {
  double out = 0;
  for (const Signal& s : run.signals)
    if (s.units == units)
      for (const double value : s.values) out = std::max(out, std::abs(value));
  return out;
}

void expect_near(const Run& one, const Run& other, double allowed) {
  ASSERT_EQ(one.signals.size(), other.signals.size());
  constexpr double rounding = 1e-12;  // of a unit, in what is zero
  double worst = 0;
  for (std::size_t i = 0; i < one.signals.size(); ++i) {
    const Signal &a = one.signals[i], &b = other.signals[i];
    ASSERT_EQ(a.values.size(), b.values.size());
    double off = 0;
    for (std::size_t k = 0; k < a.values.size(); ++k) off = std::max(off, std::abs(a.values[k] - b.values[k]));
    const double size = size_of_kind(other, b.units);
    EXPECT_LE(off, allowed * size + rounding) << a.name;
    if (off > rounding) worst = std::max(worst, off / size);
  }
  testing::Test::RecordProperty("worst", fmt::format("{:.2g}", worst));
}

const std::string crate = R"text([[body]]
name = "crate"
position = "(0, 0, 2.05) m"
mass = "100 kg"
centre_of_gravity = "(0, 0, 0.25) m"
radii_of_gyration = "(0.2, 0.2, 0.2) m"
weight = true
initial_velocity = { surge = "1.5 m/s" }
[[contact]]
between = ["crate", "ground"]
kind = "plane"
points = "(±0.25, ±0.25, 0) m"
at = "(0, 0, 2) m"
normal = "(0.1, 0, 1)"
)text";
const std::string ball = R"([[body]]
name = "ball"
position = "(0, 0, 2.6) m"
mass = "100 kg"
centre_of_gravity = "(0, 0, 0) m"
radii_of_gyration = "(0.2, 0.2, 0.2) m"
weight = true
initial_velocity = { surge = "2 m/s" }
[[contact]]
between = ["ball", "ground"]
kind = "plane"
points = "(0, 0, 0) m"
radius = "0.3 m"
at = "(0, 0, 2) m"
normal = "z"
)";
const std::string disc = R"([[body]]
name = "disc"
position = "(0, 0, 2) m"
centre_of_gravity = "(0, 0, 0) m"
mass = "20 kg"
radii_of_gyration = "(0.3, 0.3, 0.4) m"
weight = true
[[joint]]
name = "pivot"
kind = "hinge"
between = ["ground", "disc"]
at = "(0, 1, 2.6) m"
axis = "x"
)";
const std::string carriage = R"([[body]]
name = "carriage"
centre_of_gravity = "(0, 0, 0) m"
mass = "20 kg"
radii_of_gyration = "(0.3, 0.3, 0.4) m"
initial = { heave = "0.2 m" }
[[mooring]]
on = "carriage"
kind = "linear"
stiffness = { heave = "800 N/m" }
[[joint]]
name = "rack"
kind = "slider"
between = ["ground", "carriage"]
at = "(0, 0, 0) m"
axis = "z"
)";
const std::string wheel = R"([[body]]
name = "wheel"
centre_of_gravity = "(0, 0, 0) m"
mass = "2 kg"
radii_of_gyration = "(0.5, 0.5, 0.5) m"
initial = { pitch = "400 deg" }
initial_velocity = { pitch = "600 deg/s" }
[[joint]]
name = "hub"
kind = "hinge"
between = ["ground", "wheel"]
at = "(0, 0, 0) m"
axis = "y"
pto = { stiffness = "0.1 N m/rad", damping = "0.02 N m s/rad" }
)";
const std::string turning = R"([waves]
kind = "regular"
height = "0.5 m"
period = "6 s"
heading = "0 deg"
[[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
initial_velocity = { yaw = "-4 deg/s" }
[body.hydrodynamics]
file = "pontoon1.nc"
hydrostatics = true
excitation = true
turning = { from = "-90 deg", to = "0 deg", spacing = "45 deg", slower_than = "10 s" }
)";

/// A dropper that is let go, with what is counted of it; `more`: keys of its first table.
std::string dropper(const std::string& more = "", const std::string& tables = "") {
  return "[[line]]\nname = \"d\"\nfrom = \"(0, 0, 2) m\"\nto = \"(1.2, 0, 2) m\"\nlength = \"2 m\"\nsegments = "
         "5\nmass_per_length = \"1 kg/m\"\nsnaps = { slack_below = \"0.5 N\", snap_above = \"8 N\" }\n" +
         more + "[line.damping]\nquadratic = \"0.05 kg/m\"\n" + tables +
         "[line.release]\nnode = 2\nat = \"(0.4, 0.2, 1.5) m\"\n";
}
const std::string elastic = "axial_stiffness = \"20 kN\"\n";
/// A buoy drawn sideways by a chain, part of which slides about on the bed.
const std::string moored = R"([[body]]
name = "buoy"
position = "(0, 0, -1) m"
centre_of_gravity = "(0, 0, 0) m"
mass = "200 kg"
radii_of_gyration = "(0.5, 0.5, 0.5) m"
free = ["surge", "sway", "heave"]
initial_velocity = { surge = "-1 m/s", sway = "0.5 m/s" }
[[mooring]]
on = "buoy"
kind = "linear"
stiffness = { surge = "100 N/m", sway = "100 N/m", heave = "9000 N/m" }
[[line]]
name = "chain"
from = "(0, 0, -1) m"
on = { from = "buoy" }
to = "(9, 0, -4) m"
length = "10 m"
segments = 8
mass_per_length = "8 kg/m"
diameter = "0.05 m"
axial_stiffness = "200 kN"
buoyancy = true
bed = { stiffness = "200 kPa/m", damping = "10 kPa s/m", friction = 0.5 }
morison = { cd = 1.1, ca = 1 }
)";
const std::string switched = R"([[connector]]
name = "spring"
between = ["disc", "ground"]
ends = ["(0, 0, 2) m", "(0, 9, 2) m"]
kind = "axial"
stiffness = "900 N/m"
rest_length = "as placed"
[connector.switch]
watch = "disc.sway"
every = "0.5 s"
window = "2 s"
hysteresis = "0.2 Hz"
settings = [{ from = "0 s", stiffness = "300 N/m" }, { from = "6 s", stiffness = "90 N/m" }]
)";
std::string lines_by(const std::string& scheme) { return fmt::format("integrator = {{ lines = \"{}\" }}\n", scheme); }

std::string method(const std::string& name) { return fmt::format("integrator = {{ name = \"{}\" }}\n", name); }

// Newton's first guesses begin anew at a checkpoint: what it leaves moves, 1e-9 of accelerations, and instants of
// events with it. 1e-6 of each signal is far above that, and far below what any lost state does.
constexpr double newton = 1e-6;

// Of lines tensions are what Newton leaves of places times EA, and neighbours part on the way.
constexpr double lines = 1e-4;

const std::vector<Case> cases = {
    {"RoughContact", crate + "restitution = 0.2\nfriction = 0.5\n", 0.8, 0.01, {0.05, 0.15, 0.3, 0.7}, newton},
    {"SmoothContact", ball + "restitution = 0.8\n", 2, 0.01, {0.15, 0.5, 1.5}, newton},
    {"RestingContact", ball + "restitution = 0\n", 1, 0.01, {0.2, 0.4}, newton},
    {"RollingContact", ball + "restitution = 0\nfriction = 0.2\n", 1.5, 0.01, {0.3, 0.5, 1.2}, newton},
    {"FrictionOfAHinge",
     disc + "friction = { dynamic = \"40 N m\", static = \"50 N m\" }\n",
     6,
     0.02,
     {0.3, 1.5, 5},
     newton},
    {"Latch",
     carriage + "pto = { damping = \"5 N s/m\", latch = { hold = \"0.4 s\" } }\n",
     4,
     0.01,
     {0.3, 0.6, 1.2},
     newton},
    {"StopsOfAPto",
     carriage + "[joint.pto]\ndamping = \"5 N s/m\"\nstops = { upper = \"0.25 m\", lower = \"-0.1 m\", "
                "stiffness = \"20 kN/m\", damping = \"30 N s/m\" }\n",
     4,
     0.01,
     {0.3, 0.37},
     newton},
    {"TurnsOfAHinge", wheel, 4, 0.02, {0.5, 2.2}, newton},
    {"SlowYaw", turning, 20, 0.1, {3, 11}, newton},
    {"ImplicitEuler", disc, 3, 0.01, {0.4, 1.3}, newton, method("implicit_euler")},
    {"SemiImplicitEuler", disc, 3, 0.01, {0.4, 1.3}, newton, method("semi_implicit_euler")},
    {"StepsCutToATolerance",
     carriage + "pto = { damping = \"5 N s/m\" }\n",
     2,
     0.05,
     {0.5, 1.3},
     newton,
     "integrator = { name = \"implicit_euler\", tolerance = 1e-3 }\n"},
    {"Line", dropper("", "[line.lyapunov]\nfrom = \"1 s\"\n"), 3, 0.01, {0.5, 2}, lines},
    {"LineByGeneralizedAlpha", dropper(elastic), 2, 0.01, {0.5, 1.5}, lines, lines_by("generalized_alpha")},
    {"LineByRosenbrock", dropper(elastic), 2, 0.01, {0.5, 1.5}, lines, lines_by("rosenbrock")},
    {"LineByGamma", dropper(), 2, 0.01, {0.5, 1.5}, lines, lines_by("gamma")},
    {"LineBySemiImplicitEuler", dropper(), 1, 0.002, {0.3, 0.7}, lines, lines_by("semi_implicit_euler")},
    {"LineOnABodyAndABedWithFriction", moored, 4, 0.01, {0.5, 1.5, 3}, lines},
    {"SwitchByAPeriod", disc + switched, 8, 0.02, {1.2, 3.1, 5.2}, newton},
    {"FrictionByTheExplicitPair",
     disc + "friction = { dynamic = \"40 N m\", static = \"50 N m\" }\n",
     3,
     0.02,
     {0.3, 1.5},
     newton,
     method("explicit_pair")},
};

class StateInACheckpoint : public testing::TestWithParam<Case> {};

TEST_P(StateInACheckpoint, IsThereAgainAfterIt) {
  const Case& c = GetParam();
  const froude::Run without = Ready(c, 0).run();
  ASSERT_TRUE(without.stopped.empty()) << without.stopped;
  for (const double instant : c.instants) {
    SCOPED_TRACE(fmt::format("checkpoint at {} s", instant));
    const Ready ready(c, instant);
    const froude::Run undisturbed = ready.run();
    ASSERT_TRUE(undisturbed.stopped.empty()) << undisturbed.stopped;
    expect_same_bits(ended_and_gone_on_with(ready, support::scratch_folder() / "run", instant / c.duration + 1e-9),
                     undisturbed);
    expect_near(undisturbed, without, c.allowed);
  }
}

// What a controller of the caller's has seen only the caller knows.
TEST(ControllersOfTheCaller, AreRefusedWithCheckpoints) {
  const std::string spring = switched.substr(0, switched.find("[connector.switch]"));
  const Case c{"Ruled", disc + spring, 1, 0.02, {}, newton};
  const Control leaves_it{.connectors = "spring", .decide = [](const Sample&) { return std::nullopt; }};
  EXPECT_NO_THROW(simulate(scene_of(c, 0), {}, {leaves_it}));
  EXPECT_THAT([&] { simulate(scene_of(c, 0.5), {}, {leaves_it}); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("the state of controllers cannot be kept")));
}

INSTANTIATE_TEST_SUITE_P(All, StateInACheckpoint, testing::ValuesIn(cases),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace checkpoint_states_test
