// Runs tell how far they are off, refine their step until that is within what was asked, and are refused where it
// cannot.
#include "answers/estimate.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "answers/simulate.hpp"
#include "compile/kept.hpp"
#include "hydro/base/error.hpp"
#include "support/source_dir.hpp"

namespace estimate_test {
namespace {

using namespace froude;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

/// Without the word that takes any error.
scene::Scene parse(const std::string& text) { return scene::parse(text, "scene.toml"); }

/// A sledge of 100 kg on a spring of 400 N/m, let go 1 m off: x = cos 2t, with 20 swings in 62.8 s.
std::string sledge(const std::string& ask, const std::string& more = "") {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"14 m\"\n"
         "[[body]]\nname = \"sledge\"\nmass = \"100 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\n"
         "free = [\"surge\"]\ninitial = { surge = \"1 m\" }\n"
         "[[mooring]]\non = \"sledge\"\nkind = \"linear\"\nstiffness = { surge = \"400 N/m\" }\n"
         "[ask]\n" +
         ask + "run = { duration = \"62.8 s\", every = \"0.1 s\", of = [\"sledge.surge\"] }\n" + more;
}

double true_error(const froude::Run& run) {
  double off = 0, all = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const double exact = std::cos(2 * run.time[i]);
    off += std::pow(run.signals[0].values[i] - exact, 2);
    all += exact * exact;
  }
  return std::sqrt(off / all);
}

constexpr double safety = 1.25;  // by which errors are told larger than the first term of their series (E1)

TEST(Estimate, TellsTheErrorOfAStepThatTheSceneGives) {
  // The phase is off by (omega h)^2/12 of omega t: at 20 swings, h = 0.02 s, 0.017 rad; rms over the run 0.0097.
  // Generalised-alpha with rho_infinity = 1 is of order 2 there, and the extrapolation is off by the next order, (omega
  // h)^2 of itself, and by how phases of 4h saturate: 10 % are plenty.
  for (const double step : {0.02, 0.01, 0.005}) {
    const auto run =
        simulate(parse(sledge("", "[solve]\nstep = \"" + std::to_string(step) +
                                      " s\"\nintegrator = { name = \"generalized_alpha\", rho_infinity = 1 }\n")));
    ASSERT_EQ(run.error.sources.size(), 1);
    EXPECT_EQ(run.step, step);
    EXPECT_NEAR(run.error.total(0) / (safety * true_error(run)), 1, 0.1) << step;
    const double phase = std::pow(2 * step, 2) / 12 * 2 * run.time.back();
    EXPECT_NEAR(true_error(run), phase / std::numbers::sqrt3, 0.1 * phase);
  }
}

TEST(Estimate, RefinesTheStepUntilTheErrorIsWithinWhatIsAsked) {
  for (const double asked : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const auto run = simulate(parse(sledge("accuracy = " + std::to_string(asked) + "\n")));
    EXPECT_LE(true_error(run), asked);
    EXPECT_LE(run.error.total(0), asked);
    // Phases of long steps saturate.
    EXPECT_NEAR(run.error.total(0) / (safety * true_error(run)), 1, 0.3) << asked;
    EXPECT_THAT(run.warnings(), IsEmpty());
    EXPECT_THAT(run.accuracy(), HasSubstr("(sledge.surge), by the step"));
  }
}

TEST(Estimate, WarnsWhereAGivenStepMissesTheAccuracy) {
  const auto run = simulate(parse(sledge("accuracy = 1e-3\n", "[solve]\nstep = \"0.05 s\"\n")));
  EXPECT_GT(true_error(run), 1e-3);
  EXPECT_TRUE(run.error.sources[0].given);
  EXPECT_THAT(run.warnings(), testing::ElementsAre(AllOf(HasSubstr("sledge.surge is off by an estimated"),
                                                         HasSubstr("from the step that the scene gives"))));
}

TEST(Estimate, ALoadThatOnlyTheLongerStepsMissIsNoReasonToRefuse) {
  // 20 N that rise within 0.5 s: steps of 0.4 s, which the scene gives, take that, those of 0.8 s do not.
  const auto run = simulate(
      parse("schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"infinite\"\n"
            "[[body]]\nname = \"b\"\nmass = \"30 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nfree = [\"surge\"]\n"
            "[[mooring]]\non = \"b\"\nkind = \"linear\"\nstiffness = { surge = \"100 N/m\" }\n"
            "[[load]]\non = \"b\"\nforce = \"(20, 0, 0) N\"\nfrom = \"0.3 s\"\nramp_up = \"0.5 s\"\n"
            "[ask]\nrun = { duration = \"80 s\", every = \"0.8 s\", of = [\"b.surge\"] }\naccuracy = 5e-2\n"
            "[solve]\nstep = \"0.4 s\"\naccept_error = true\n"));
  EXPECT_EQ(run.step, 0.4);
  EXPECT_THAT(run.stopped, IsEmpty());
  EXPECT_GT(run.error.total(0), 0.05);  // told by a run of half the step
}

TEST(Estimate, AnIntegratorWithAToleranceIsJudgedByIt) {
  const auto run =
      simulate(parse(sledge("", "[solve]\nintegrator = { name = \"explicit_pair\", tolerance = 1e-4 }\n")));
  EXPECT_EQ(run.error.sources[0].name, "tolerance");
  EXPECT_TRUE(run.error.sources[0].given);
  // Errors of the pair do not fall quite as its tolerance.
  EXPECT_NEAR(std::log10(run.error.total(0) / true_error(run)), 0, std::log10(3.0));
}

TEST(Estimate, WhatCannotBeMetIsRefusedOrAcceptedByName) {
  // Implicit Euler damps the swing by omega^2 h/2 a second: to keep it to 0.1 % over 63 s takes h = 8e-6 s, a 1700th of
  // the step of 0.014 s that its period asks for, and eight million steps.
  const std::string euler = "[solve]\nintegrator = { name = \"implicit_euler\" }\n", asked = "accuracy = 1e-3\n";
  // Less accuracy would begin with a longer step, and be refused alike.
  EXPECT_THAT([&] { simulate(parse(sledge(asked, euler))); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("accuracy of 0.001"), HasSubstr("sledge.surge is off by an estimated"),
                        HasSubstr("the step stands in the way"), HasSubstr("give a shorter step, [solve] step = "),
                        testing::Not(HasSubstr("less accuracy")), HasSubstr("accept_error = true"))));
  const auto run = simulate(parse(sledge(asked, euler + "accept_error = true\n")));
  EXPECT_TRUE(run.error.accepted);
  EXPECT_GT(run.error.total(0), 0.01);
  EXPECT_THAT(run.warnings(), testing::Contains(HasSubstr("which the scene accepts")));
}

/// A pendulum of 3 kg on a hinge 1.2 m above its centre of gravity, let go at `angle`, rad.
std::string pendulum(double angle, const std::string& accuracy) {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ngravity = \"9.81 m/s^2\"\ndepth = \"infinite\"\n"
         "[[body]]\nname = \"p\"\nmass = \"3 kg\"\nweight = true\ncentre_of_gravity = \"(0, 0, -1.2) m\"\n"
         "inertia = \"(0.7, 0.5, 0.2) kg m^2\"\ninitial = { pitch = \"" +
         fmt::format("{:.17g}", angle) +
         " rad\" }\n[[joint]]\nname = \"h\"\nkind = \"hinge\"\nbetween = [\"ground\", \"p\"]\nat = \"(0, 0, 0) m\"\n"
         "axis = \"y\"\n[ask]\naccuracy = " +
         accuracy + "\nrun = { duration = \"100 s\", every = \"0.1 s\", of = [\"h.angle\"] }\n";
}

/// rms of what the angle is off by, over rms: from a classical Runge-Kutta's of 1 ms, whose errors of h^4 are below
/// 1e-8 here.
double error_of_pendulum(const froude::Run& run, double angle) {
  constexpr double h = 1e-3, every = 0.1, omega2 = 3 * 9.81 * 1.2 / (0.5 + 3 * 1.2 * 1.2);
  double x = angle, v = 0, off = 0, all = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    off += std::pow(run.signals[0].values[i] - x, 2);
    all += x * x;
    for (int part = 0; part < std::lround(every / h); ++part) {
      const auto pull = [&](double at) { return -omega2 * std::sin(at); };
      const double a1 = pull(x), v2 = v + h / 2 * a1, a2 = pull(x + h / 2 * v), v3 = v + h / 2 * a2;
      const double a3 = pull(x + h / 2 * v2), v4 = v + h * a3, a4 = pull(x + h * v3);
      x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
  }
  return std::sqrt(off / all);
}

// At an accuracy of 0.1 the first step, a sixth of a radian of the swing, gains energy until the run stops.
TEST(Estimate, RefinesAStepOfItsOwnWithWhichTheRunDoesNotEnd) {
  for (const char* accuracy : {"0.2", "0.1"}) {
    const auto run = simulate(parse(pendulum(std::numbers::pi / 2, accuracy)));
    EXPECT_THAT(run.stopped, IsEmpty());
    EXPECT_EQ(run.time.back(), 100);
    EXPECT_LE(error_of_pendulum(run, std::numbers::pi / 2), std::stod(accuracy));
    EXPECT_LE(run.error.total(0), std::stod(accuracy));
  }
}

// From 179.9 degrees it stays a while near its highest place, where what Newton leaves in each step grows a
// thousandfold. Runs that all leave the same agree in that; the truth was off by 0.13 where 0.01 was told.
TEST(Estimate, SeesWhatNewtonLeavesInEachStep) {
  constexpr double angle = 179.9 * std::numbers::pi / 180;
  for (const char* accuracy : {"0.05", "0.01"}) {
    const auto run = simulate(parse(pendulum(angle, accuracy)));
    EXPECT_LE(error_of_pendulum(run, angle), std::stod(accuracy));
    EXPECT_THAT(run.warnings(), IsEmpty());
  }
}

// A spring that grows stiff with the cube of its stroke: at rest, where the step is chosen, it swings at 1 rad/s, later
// at about 20 rad/s. Small scenes are refined beyond a 64th of such a step.
TEST(Estimate, LessAccuracyIsAnsweredWhereMoreIs) {
  const auto spring = [](const std::string& accuracy) {
    return simulate(
        parse("schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"infinite\"\n"
              "[[body]]\nname = \"p\"\nmass = \"1 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\n"
              "inertia = \"(1, 1, 1) kg m^2\"\ninitial_velocity = { surge = \"2 m/s\" }\n"
              "[[joint]]\nname = \"h\"\nkind = \"slider\"\nbetween = [\"ground\", \"p\"]\nat = \"(0, 0, 0) m\"\naxis = "
              "\"x\"\n"
              "pto = { stiffness = \"1 N/m\", cubic = \"1e4 N/m^3\" }\n[ask]\naccuracy = " +
              accuracy + "\nrun = { duration = \"40 s\", every = \"0.5 s\", of = [\"p.surge\"] }\n"));
  };
  const auto fine = spring("1e-3");
  for (const char* accuracy : {"0.1", "0.05", "0.01"}) {
    const auto run = spring(accuracy);
    double off = 0, all = 0;
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      off += std::pow(run.signals[0].values[i] - fine.signals[0].values[i], 2);
      all += std::pow(fine.signals[0].values[i], 2);
    }
    EXPECT_LE(std::sqrt(off / all), std::stod(accuracy) + 1e-3);  // which the reference may be off
    EXPECT_THAT(run.warnings(), IsEmpty());
  }
}

/// The same sledge swinging about 100 m, where a tow of 40 kN holds it.
std::string towed(const std::string& ask, const std::string& more = "") {
  std::string text = sledge(ask, "[[load]]\non = \"sledge\"\nforce = \"(40, 0, 0) kN\"\n" + more);
  return text.replace(text.find("\"1 m\""), 5, "\"101 m\"");
}

double deviation_error(const froude::Run& run) {
  double mean = 0, squares = 0, exact = 0, exact_squares = 0;
  const auto n = static_cast<double>(run.time.size());
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    mean += run.signals[0].values[i] / n;
    exact += std::cos(2 * run.time[i]) / n;
  }
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    squares += std::pow(run.signals[0].values[i] - mean, 2);
    exact_squares += std::pow(std::cos(2 * run.time[i]) - exact, 2);
  }
  return std::sqrt(squares / exact_squares) - 1;
}

TEST(Estimate, BoundsTheStandardDeviationAboutALargeMean) {
  // Implicit Euler damps by omega^2 h/2 a second: at h = 0.5 ms e^(-t/1000), which over 63 s takes 3 % of the
  // deviation, but 3e-4 of the rms, which is that of 100 m.
  const std::string euler = "[solve]\nintegrator = { name = \"implicit_euler\" }\nstep = \"0.5 ms\"\n";
  const auto run = simulate(parse(towed("", euler)));
  EXPECT_NEAR(deviation_error(run), -0.03, 0.005);
  // What is left of the swing is e^(-c h), and the ratio is that of rms, which phases of 4 h saturate: next orders, 6 %
  // of either.
  EXPECT_NEAR(run.error.total(0) / (safety * -deviation_error(run)), 1, 0.2);
  EXPECT_THAT(run.warnings(), testing::Contains(HasSubstr("standard deviation")));
  for (const double asked : {1e-1, 1e-2}) {
    const auto kept = simulate(parse(towed("accuracy = " + std::to_string(asked) + "\n")));
    EXPECT_LE(std::abs(deviation_error(kept)), asked);
    EXPECT_LE(kept.error.total(0), asked);
  }
}

TEST(Estimate, RefusesAnAccuracyBelowRounding) {
  EXPECT_THAT([] { parse(sledge("accuracy = 1e-10\n")); },
              ThrowsMessage<hydro::InputError>(HasSubstr("double precision")));
}

/// Two rods of 1 m and 1 kg, one hinged below the other, let go at `angle` from hanging.
std::string double_pendulum(const std::string& angle) {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"14 m\"\n"
         "[[body]]\nname = \"upper\"\nposition = \"(0, 0, -0.5) m\"\nmass = \"1 kg\"\ncentre_of_gravity = \"(0, 0, 0) "
         "m\"\nradii_of_gyration = \"(0.3, 0.3, 0.3) m\"\nfree = [\"surge\", \"heave\", \"pitch\"]\nweight = true\n"
         "[[body]]\nname = \"lower\"\nposition = \"(0, 0, -1.5) m\"\nmass = \"1 kg\"\ncentre_of_gravity = \"(0, 0, 0) "
         "m\"\nradii_of_gyration = \"(0.3, 0.3, 0.3) m\"\nfree = [\"surge\", \"heave\", \"pitch\"]\nweight = true\n"
         "initial_velocity = { pitch = \"" +
         angle +
         " rad/s\" }\n"
         "[[joint]]\nname = \"top\"\nkind = \"hinge\"\nbetween = [\"ground\", \"upper\"]\nat = \"(0, 0, 0) m\"\n"
         "axis = \"y\"\n[[joint]]\nname = \"knee\"\nkind = \"hinge\"\nbetween = [\"upper\", \"lower\"]\n"
         "at = \"(0, 0, -1) m\"\naxis = \"y\"\n"
         "[ask]\nrun = { duration = \"40 s\", every = \"0.05 s\", of = [\"top.angle\", \"energy.residual\"] }\n";
}

TEST(Estimate, SaysUntilWhenAChaoticMotionCanBePredicted) {
  const auto run = simulate(parse(double_pendulum("14")));
  ASSERT_THAT(run.error.unpredictable, testing::SizeIs(1));
  const auto& lost = run.error.unpredictable[0];
  EXPECT_GT(lost.until, 1);
  EXPECT_LT(lost.until, 35);
  EXPECT_THAT(run.warnings(), testing::Contains(HasSubstr("top.angle can be predicted until")));
  // Up to there a run with other errors tells the same: another integrator with an eighth of the step.
  auto scene = parse(double_pendulum("14"));
  scene.solve.step = scene::Located<double>{scene.run->every / 160, {}};
  scene.solve.integrator = "energy_momentum";
  scene.solve.accept_error = true;
  const auto other = simulate(scene);
  double off = 0, all = 0, beyond = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const double d = run.signals[0].values[i] - other.signals[0].values[i];
    (run.time[i] <= lost.until ? off : beyond) += d * d;
    all += run.signals[0].values[i] * run.signals[0].values[i];
  }
  const auto n = static_cast<double>(run.time.size());
  EXPECT_LT(std::sqrt(off / (lost.until / 40 * n)), 2 * run.error.asked * std::sqrt(all / n));
  EXPECT_GT(std::sqrt(beyond / all), 0.1);
}

// At a tenth errors fall from step to step, but not to what is asked before steps end: still no reason to refuse.
TEST(Estimate, DoesNotRefuseAChaoticMotionWhoseErrorsFall) {
  for (const char* accuracy : {"0.1", "0.03", "0.003"}) {
    SCOPED_TRACE(accuracy);
    const auto run = simulate(parse(double_pendulum("14") + "accuracy = " + accuracy + "\n"));
    ASSERT_THAT(run.error.unpredictable, testing::SizeIs(1));
    EXPECT_LE(run.error.total(0), std::stod(accuracy));
  }
}

TEST(Estimate, ARegularMotionOfTheSamePendulumIsPredictedToTheEnd) {
  const auto run = simulate(parse(double_pendulum("0.5")));
  EXPECT_THAT(run.error.unpredictable, IsEmpty());
  EXPECT_THAT(run.warnings(), IsEmpty());
  EXPECT_EQ(run.error.total(1), 0);  // energy.residual is an error itself
}

/// 1 kg on a slider with 1 N/m, between stops of 9999 N/m at ±1 m, thrown from the middle.
std::string between_stops(double speed, const std::string& accuracy, const std::string& more = "") {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"infinite\"\n"
         "[[body]]\nname = \"p\"\nmass = \"1 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\n"
         "inertia = \"(1, 1, 1) kg m^2\"\ninitial_velocity = { surge = \"" +
         fmt::format("{}", speed) +
         " m/s\" }\n"
         "[[joint]]\nname = \"h\"\nkind = \"slider\"\nbetween = [\"ground\", \"p\"]\nat = \"(0, 0, 0) m\"\n"
         "axis = \"x\"\n[joint.pto]\nstiffness = \"1 N/m\"\n"
         "stops = { lower = \"-1 m\", upper = \"1 m\", stiffness = \"9999 N/m\" }\n"
         "[ask]\naccuracy = " +
         accuracy + "\nrun = { duration = \"20 s\", every = \"0.1 s\", of = [\"p.surge\"] }\n" + more;
}

/// Between the stops it moves at 1 rad/s about 0, in one at 100 rad/s about 0.9999 m.
double exact_between_stops(double speed, double t) {
  constexpr double fast = 100, middle = 0.9999;
  const double at_stop = std::sqrt(speed * speed - 1), to_stop = std::asin(1 / speed);
  const double phase = std::atan2(at_stop / fast, 1 - middle), in_stop = 2 * phase / fast;
  const double half = 2 * to_stop + in_stop, whole_halves = std::floor(t / half), since = t - whole_halves * half;
  const double side = std::fmod(whole_halves, 2) == 0 ? 1 : -1;
  if (since < to_stop) return side * speed * std::sin(since);
  if (since > to_stop + in_stop) return side * speed * std::sin(half - since);
  return side * (middle + std::hypot(1 - middle, at_stop / fast) * std::cos(fast * (since - to_stop) - phase));
}

double error_between_stops(double speed, const froude::Run& run) {
  double off = 0, all = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const double exact = exact_between_stops(speed, run.time[i]);
    off += std::pow(run.signals[0].values[i] - exact, 2);
    all += exact * exact;
  }
  return std::sqrt(off / all);
}

// The step that is chosen first misses when the stops are reached, so that neighbours part as if by chaos. The motion
// has one degree of freedom: neighbours part as their phases do.
TEST(Estimate, NeighboursThatOnlyLongStepsPartAreNoChaos) {
  for (const double speed : {1.7, 2.1, 2.5, 2.9}) {
    const auto run = simulate(parse(between_stops(speed, "5e-2")));
    EXPECT_THAT(run.error.unpredictable, IsEmpty());
    EXPECT_THAT(run.warnings(), IsEmpty());
    EXPECT_LE(error_between_stops(speed, run), 0.05) << speed;
  }
  // A step that the scene gives stands, and is told to be too long.
  const auto given = simulate(parse(between_stops(2.5, "5e-2", "[solve]\nstep = \"0.001 s\"\n")));
  EXPECT_GT(error_between_stops(2.5, given), 0.05);
  EXPECT_THAT(given.error.unpredictable, IsEmpty());
  EXPECT_THAT(given.warnings(), testing::Contains(HasSubstr("p.surge is off by an estimated")));
}

// Modules whose water is looked at: all runs that are made beside each other.
TEST(Estimate, IsTheSameOnTwoThreads) {
  scene::Scene scene = scene::read(froude_test::source_dir() / "examples/pontoon5.toml");
  scene.run->duration = 20;
  const auto kept = std::make_shared<compile::Kept>();
  const froude::Run one = simulate(scene, {}, {}, kept, 1), two = simulate(scene, {}, {}, kept, 2);
  ASSERT_EQ(one.signals.size(), two.signals.size());
  for (std::size_t i = 0; i < one.signals.size(); ++i) {
    EXPECT_EQ(one.signals[i].values, two.signals[i].values) << one.signals[i].name;
    EXPECT_EQ(one.error.total(i), two.error.total(i)) << one.signals[i].name;
  }
  ASSERT_EQ(one.error.sources.size(), two.error.sources.size());
  EXPECT_EQ(one.error.sources.size(), 3) << "step, memory, coefficients";
  ASSERT_EQ(one.error.unpredictable.size(), two.error.unpredictable.size());
  for (std::size_t i = 0; i < one.error.unpredictable.size(); ++i) {
    EXPECT_EQ(one.error.unpredictable[i].until, two.error.unpredictable[i].until);
    EXPECT_EQ(one.error.unpredictable[i].scatter, two.error.unpredictable[i].scatter);
  }
}

TEST(Estimate, RefinesOnTwoThreadsAsOnOne) {
  const auto scene = parse(sledge("accuracy = 1e-4\n"));
  const auto one = simulate(scene), two = simulate(scene, {}, {}, nullptr, 2);
  EXPECT_EQ(one.step, two.step);
  EXPECT_EQ(one.signals[0].values, two.signals[0].values);
  EXPECT_EQ(one.error.total(0), two.error.total(0));
}

TEST(Estimate, ControllersOfTheCallerAreAskedOnce) {
  int asked = 0;
  const auto scene =
      parse(sledge("",
                   "[[connector]]\nname = \"spring\"\nkind = \"axial\"\nbetween = [\"sledge\", \"ground\"]\n"
                   "ends = [\"(0, 0, 0) m\", \"(5, 0, 0) m\"]\nstiffness = \"10 N/m\"\nrest_length = \"as placed\"\n"));
  const auto run = simulate(scene, {}, {{"spring", [&](const Sample&) {
                                           ++asked;
                                           return std::optional<double>();
                                         }}});
  EXPECT_EQ(asked, static_cast<int>(run.steps));
  EXPECT_THAT(run.accuracy(), HasSubstr("not estimated: controllers"));
}

}  // namespace
}  // namespace estimate_test
