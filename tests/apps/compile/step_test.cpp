// The step of a run follows what moves, and what it cannot follow is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "answers/scene_runs.hpp"
#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "compile/kept.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "scenes.hpp"
#include "support/scratch.hpp"
#include "support/two_pole_body.hpp"

namespace step_test {
namespace {

using namespace froude;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// A flap that pitches, in water whose memory is known exactly: damping is largest at 12.8 rad/s, and two thirds of
/// that are left at 20 rad/s, where the table ends.
struct Flap {
  static constexpr double inertia = 1.5e3, added = 0.5e3, stiffness = 30e3, start = 0.35;  // kg m², N m/rad, rad
  static constexpr double strength = 600e3;
  support::TwoPoleBody water{.decay = 8, .frequency = 10};

  std::filesystem::path write(const std::string& name) const {
    hydro::potential::Coefficients c;
    c.water = {.density = 1000, .gravity = 9.80665, .depth = hydro::WaterDepth::from_metres(10)};
    c.body.push_back({.name = "flap",
                      .reference_point = Eigen::Vector3d(0, 0, 0),
                      .centre_of_gravity = {},
                      .centre_of_buoyancy = {},
                      .displaced_volume = {}});
    const auto pitch = [](double value) {
      Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6, 6);
      out(4, 4) = value;
      return out;
    };
    for (int i = 1; i <= 100; ++i) {
      const double omega = 0.2 * i;
      c.omega.push_back(omega);
      c.A.push_back(pitch(added + strength * water.A_minus_A_inf(omega)));
      c.B.push_back(pitch(strength * water.B(omega)));
    }
    c.A_inf = pitch(added);
    c.C = pitch(stiffness);
    c.source = "a flap made for a test";
    const auto path = support::scratch_folder() / (name + ".h5");
    hydro::potential::write_froude(c, path);
    return path;
  }

  static std::string scene(const std::filesystem::path& file, const std::string& radiation, const std::string& every,
                           const std::string& solve = "") {
    return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"10 m\"\n"
           "[[body]]\nname = \"flap\"\nmass = \"1000 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\ninertia = \"(1500, "
           "1500, 1500) kg m^2\"\nfree = [\"pitch\"]\n"
           "[body.initial]\npitch = \"0.35 rad\"\n[body.hydrodynamics]\nfile = \"" +
           file.string() + "\"\naccept = [\"restoring matrix\"]\nhydrostatics = true\nradiation = { " + radiation +
           " }\n[ask]\nrun = { duration = \"8 s\", every = \"" + every + "\" }\n" + solve;
  }

  /// The angle at multiples of `every`: the memory as two states (R9), by a fine Runge–Kutta.
  std::vector<double> exact(double every, std::size_t samples) const {
    Eigen::Vector4d x(start, 0, 0, 0);
    const auto rate = [&](const Eigen::Vector4d& s) {
      return Eigen::Vector4d(s[1], (-stiffness * s[0] - strength * s[3]) / (inertia + added), s[3],
                             s[1] - 2 * water.decay * s[3] - water.w2() * s[2]);
    };
    constexpr int fine = 400;
    const double h = every / fine;
    std::vector<double> out{start};
    while (out.size() < samples) {
      for (int i = 0; i < fine; ++i) {
        const Eigen::Vector4d k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2), k4 = rate(x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
      out.push_back(x[0]);
    }
    return out;
  }
};

double off(const froude::Run& run, const std::vector<double>& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst, std::abs(run.signal("flap.pitch")[i] - exact[i]));
  return worst / Flap::start;
}

// With the steps left to the program, and with the memory by each of its methods.
TEST(StepOfARun, LetsAFlapSwingBackAtAnyDistanceOfSamples) {
  const Flap flap;
  const auto file = flap.write("flap_decay");
  for (const std::string method : {"direct", "partitioned", "automatic"})
    for (const double every : {0.05, 0.1, 0.2}) {
      const froude::Run run = simulate(
          scene::parse(Flap::scene(file, "memory_tolerance = 1e-3, accept_error = 0.02, method = \"" + method + "\"",
                                   fmt::format("{} s", every)),
                       file));
      ASSERT_EQ(run.stopped, "");
      // The accuracy asked; a memory 1e-3 off its largest damping is 2 % off that of the flap, 0.08 of critical: 0.005
      // a swing.
      EXPECT_LT(off(run, flap.exact(every, run.time.size())), 0.01) << method << ", every " << every << " s";
    }
}

// The flap swings in 2.7 s. The kernel averaged over 0.1 s is right; with samples of it the flap would come back half
// as far.
TEST(StepOfARun, DoesNotFoldTheDampingOfAFlapWhereTheSceneGivesALongOne) {
  const Flap flap;
  const auto file = flap.write("flap_long_step");
  const froude::Run run =
      simulate(scene::parse(Flap::scene(file, "memory_tolerance = 1e-3, accept_error = 0.02, method = \"direct\"",
                                        "0.1 s", "[solve]\nstep = \"0.1 s\"\n"),
                            file));
  EXPECT_LT(off(run, flap.exact(0.1, run.time.size())), 0.02);  // (ωh)²/12 of the flap's 2.3 rad/s is 0.004 a radian
  EXPECT_THAT(run.notes, Contains(HasSubstr("is longer than the")));
}

TEST(MemoryOfARun, IsRefusedWhereItMissesItsToleranceUnlessThatIsAccepted) {
  const Flap flap;
  const auto file = flap.write("flap_strict");
  const auto run = [&](const std::string& radiation) {
    return simulate(scene::parse(Flap::scene(file, radiation, "0.1 s", "[solve]\naccept_error = true\n"), file));
  };
  EXPECT_THAT([&] { run("memory = \"0.2 s\""); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("no memory of the radiated waves is within 0.001"), HasSubstr("accept_error = "))));
  EXPECT_THAT([&] { run("memory = \"0.2 s\", accept_error = 0.01"); },
              ThrowsMessage<hydro::InputError>(HasSubstr("misses them by")));
  const froude::Run taken = run("memory = \"0.2 s\", accept_error = 2");
  EXPECT_THAT(taken.notes, Contains(AllOf(HasSubstr("differs from the data"), HasSubstr("accept_error = 2"))));
  // Of the motion that is most of it: what 0.2 s of memory leave out damps the flap.
  EXPECT_THAT(taken.warnings(), Contains(HasSubstr("flap.pitch by")));
  EXPECT_EQ(taken.error.largest_source(0).name, "memory");
}

/// A mass on a spring along x.
std::string spring(const std::string& extra, const std::string& every, const std::string& initial) {
  return froude_test::water +
         "[[body]]\nname = \"m\"\nmass = \"100 kg\"\ninertia = \"(10, 10, 10) kg m^2\"\nfree = [\"surge\"]\n" +
         initial + extra + "[ask]\nrun = { duration = \"10 s\", every = \"" + every + "\" }\n";
}

TEST(StepOfARun, FollowsASpringOfOneSecond) {
  const double k = 100 * 4 * std::numbers::pi * std::numbers::pi;
  const froude::Run run = simulate(froude_test::parse(spring(
      fmt::format(
          "[[mooring]]\nname = \"spring\"\non = \"m\"\nkind = \"linear\"\nstiffness = {{ surge = \"{:.12g} N/m\" }}\n",
          k),
      "0.5 s", "[body.initial]\nsurge = \"0.1 m\"\n")));
  // cos 2πt at half periods; 10 periods with a period error of 1e-2/16 turn the phase by 0.04, and generalised-alpha
  // takes a few thousandths of the height.
  for (std::size_t i = 0; i < run.time.size(); ++i)
    EXPECT_NEAR(run.signal("m.surge")[i], 0.1 * (i % 2 == 0 ? 1 : -1), 1e-3) << run.time[i];
}

// A fit runs the scene with many numbers. Were the step chosen anew with each, motions would jump where one more step
// fits between samples, and no search ends on a jump.
TEST(StepOfARun, StaysWhileAFitSearchesForAStiffness) {
  const double k = 100 * 4 * std::numbers::pi * std::numbers::pi;
  const auto path = support::scratch_folder() / "searched.toml";
  std::ofstream(path) << spring(
      fmt::format("[[mooring]]\non = \"m\"\nkind = \"linear\"\nstiffness = {{ surge = \"{:.12g} N/m\" }}\n", k),
      "0.5 s", "[body.initial]\nsurge = \"0.1 m\"\n");
  scene::MotionModel fit;
  fit.scene.value = path;
  fit.parameters.push_back({{"mooring.stiffness.surge", k}, "N/m", {}});
  fit.signals.push_back({"x", "m.surge", {"1 mm", {}}});
  std::vector<double> time;
  for (int i = 0; i <= 20; ++i) time.push_back(0.5 * i);
  const MeasuredRun measured = MeasuredRun::of(time, Eigen::MatrixXd::Zero(21, 1), 0);
  SceneRuns runs(fit, measured);
  runs.units();                // compiles the scene with the numbers that it has
  constexpr int trials = 400;  // up to a tenth stiffer: the phase at the end goes on by 0.008 a trial
  std::vector<double> last;
  for (int i = 0; i < trials; ++i)
    last.push_back(runs.follow(0, Eigen::VectorXd::Constant(1, k * (1 + 0.1 * i / trials)), {})(20, 0));
  double by_trial = 0, bend = 0;
  for (std::size_t i = 1; i + 1 < last.size(); ++i) {
    by_trial = std::max(by_trial, std::abs(last[i + 1] - last[i]));
    bend = std::max(bend, std::abs(last[i + 1] - 2 * last[i] + last[i - 1]));
  }
  EXPECT_LT(bend, 0.02 * by_trial) << "0.008 of a cosine; a step more between samples moves it by a quarter of a trial";
}

// A search runs the scene a hundred times and more, while a file takes as long to read and to look through, memories to
// weigh and poles to fit, as many runs.
TEST(TrialsOfAFit, ReadNoFileAndWeighNoMemoryAgain) {
  const Flap flap;
  const auto file = flap.write("flap_searched");
  const auto path = support::scratch_folder() / "flap_searched.toml";
  std::ofstream(path) << Flap::scene(file, "memory_tolerance = 1e-3, accept_error = 0.02", "0.1 s");
  scene::MotionModel fit;
  fit.scene.value = path;
  fit.parameters.push_back({{"body.flap.initial.pitch", 0.35}, "rad", {}});
  fit.signals.push_back({"x", "flap.pitch", {"1 mrad", {}}});
  std::vector<double> time;
  for (int i = 0; i <= 20; ++i) time.push_back(0.1 * i);
  const MeasuredRun measured = MeasuredRun::of(time, Eigen::MatrixXd::Zero(21, 1), 0);
  SceneRuns runs(fit, measured);
  std::filesystem::remove(file);  // whoever reads it again finds nothing
  for (int i = 0; i < 10; ++i)
    EXPECT_NEAR(runs.follow(0, Eigen::VectorXd::Constant(1, 0.1 + 0.01 * i), {})(0, 0), 0.1 + 0.01 * i, 1e-12);
  EXPECT_EQ(runs.kept()->memories().made(), 1u);
  EXPECT_EQ(runs.kept()->fits().made(), 1u);
  EXPECT_EQ(runs.kept()->made(), 3u) << "with coefficients, and what the doctor finds in them";
}

// What is not weighed again is told all the same, and another step is another question.
TEST(Memories, ThatAreKnownStandInEachPlan) {
  const Flap flap;
  auto scene = froude_test::parse(
      Flap::scene(flap.write("flap_planned"), "memory_tolerance = 1e-3, accept_error = 0.02", "0.1 s"));
  const compile::Prepared prepared = compile::prepare(scene);
  const auto told = [&] {
    const compile::TimeModel model = compile::time_model(scene, prepared);
    std::string out = fmt::format("{}", fmt::join(model.notes, "\n"));
    for (const auto& line : model.plan) out += "\n" + line.method + ": " + line.size;
    return out;
  };
  const std::string first = told();
  EXPECT_THAT(first, testing::HasSubstr("A(inf) moved by"));
  EXPECT_EQ(told(), first);
  EXPECT_EQ(prepared.kept->memories().made(), 1u);
  scene.solve.step = scene::Located<double>{0.05, {}};
  EXPECT_THAT(told(), testing::HasSubstr("A(inf) moved by"));
  EXPECT_EQ(prepared.kept->memories().made(), 2u);
}

const std::string rod = froude_test::water + R"([[body]]
name = "rod"
mass = "3 kg"
weight = true
centre_of_gravity = "(0.5, 0, 0) m"
inertia = "(0.001, 0.25, 0.25) kg m^2"
[[joint]]
name = "hinge"
kind = "hinge"
between = ["ground", "rod"]
at = "(0, 0, 0) m"
axis = "y"
[ask]
run = { duration = "30 s", every = "0.075 s" }
)";

// Let go level it turns over 3 kg · 9.81 m/s² · 0.5 m twice in a swing, from where it hangs seen.
TEST(StepOfARun, LetsARodKeepItsEnergy) {
  const froude::Run run = simulate(froude_test::parse(rod));
  ASSERT_EQ(run.stopped, "");
  double turnover = 0;
  for (const auto& [name, joules] : run.energy)
    if (name == "turnover") turnover = joules;
  EXPECT_NEAR(turnover, 2 * 3 * 9.80665 * 0.5, 0.01 * 29.4) << "as much as swings, not what is held at the end";
  EXPECT_LT(std::abs(run.worst_residual.energy),
            0.01 * turnover);  // 18 swings of a step that an accuracy of 1e-2 chose
}

TEST(StepOfARun, StopsWhereEnergyComesFromNowhere) {
  const froude::Run run = simulate(froude_test::parse(rod + "[solve]\nstep = \"0.075 s\"\n"));
  EXPECT_THAT(run.stopped, AllOf(HasSubstr("energy comes from nowhere"), HasSubstr("[solve] step = \"0.01875 s\"")));
  EXPECT_GT(run.time.size(), 20u) << "what was computed is kept";
  EXPECT_LT(run.time.back(), 30);
}

TEST(StepOfARun, FollowsThePrescribedMotionOfAJoint) {
  const scene::Scene scene =
      froude_test::parse(spring("[[joint]]\nname = \"rig\"\nkind = \"slider\"\nbetween = [\"ground\", \"m\"]\nat = "
                                "\"(0, 0, 0) m\"\naxis = \"x\"\n"
                                "prescribed = { amplitude = \"0.1 m\", period = \"1 s\" }\n",
                                "0.5 s", ""));
  const auto model = compile::time_model(scene, compile::prepare(scene));
  EXPECT_LT(model.step, 1 / 72.0);  // √(12 · 1e-2)/4/ω
  EXPECT_THAT(model.plan.front().method, HasSubstr("the prescribed motion of joint rig"));
}

// A buffer in a gap is felt late: its stiffness counts from the start. A mass of 100 kg at 1 m/s runs into 4e5 N/m,
// half a period of 0.05 s.
TEST(StepOfARun, FollowsAStopBeforeItIsRunInto) {
  const std::string stop = R"([[joint]]
name = "rail"
kind = "slider"
between = ["ground", "m"]
at = "(0, 0, 0) m"
axis = "x"
[joint.pto]
stops = { upper = "0.5 m", stiffness = "400 kN/m" }
)";
  const scene::Scene scene = froude_test::parse(spring(stop, "0.02 s", "[body.initial_velocity]\nsurge = \"1 m/s\"\n"));
  const froude::Run run = simulate(scene);
  ASSERT_EQ(run.stopped, "");
  EXPECT_LT(run.step, 0.02 / 10);
  double most = 0;
  for (const double x : run.signal("m.surge")) most = std::max(most, x);
  // 0.5 + v √(m/k) = 0.5158 m; samples 0.02 s apart may miss the crest of a sine of 63 rad/s by 1 − cos 0.63 = 0.2 of
  // the way in.
  EXPECT_NEAR(most, 0.5 + 0.0158, 0.2 * 0.0158);
  EXPECT_NEAR(run.signal("m.surge").back(), 0.5 - (10 - 0.5 - std::numbers::pi / 63.25) * 1, 0.02)
      << "it comes back as fast as it went";
}

}  // namespace
}  // namespace step_test
