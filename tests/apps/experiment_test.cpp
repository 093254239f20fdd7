// `froude experiment` through the functions that the command line calls.
#include "froude/experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/scratch.hpp"

namespace experiment_command_test {
namespace {

using hydro::InputError;
using testing::HasSubstr;
using testing::ThrowsMessage;

template <class Arguments>
nlohmann::json told(void (*command)(const Arguments&, const froude::Console&), const Arguments& arguments) {
  std::ostringstream out, err;
  command(arguments, {out, err, true});
  return nlohmann::json::parse(out.str());
}

TEST(Experiment, OfAnOscillationTellsAllItsNumbers) {
  const auto j =
      told(froude::plan_oscillation, {.known = {.diameter = 0.12, .period = 4, .kc = 20}, .viscosity = 1.05e-6});
  EXPECT_NEAR(j["speed"].get<double>(), 20 * 0.12 / 4, 1e-12);
  EXPECT_NEAR(j["re"].get<double>(), 0.6 * 0.12 / 1.05e-6, 1e-6);
  EXPECT_FALSE(j.contains("length"));
}

TEST(Experiment, OfAnOscillationTellsHowLongItsRecordMustBe) {
  froude::OscillationPlanArguments a{
      .known = {.diameter = 0.12, .period = 4, .kc = 20}, .viscosity = 1.05e-6, .width = 0.05};
  a.record.noise = 2;
  a.record.memory = 0.1;
  a.record.step = 0.02;
  a.record.cylinder = {
      .diameter = 0, .length = 0.5, .density = 997, .viscosity = {}, .experiment = fit::Experiment::body_moves};
  const auto j = told(froude::plan_oscillation, a);
  EXPECT_LE(j["half_width"].get<double>(), 0.05);
  EXPECT_EQ(j["length"].back()["cycles"], j["cycles"]);
  a.width = 1e-6;
  EXPECT_THAT([&] { told(froude::plan_oscillation, a); }, ThrowsMessage<InputError>(HasSubstr("is wanted")));
}

TEST(Experiment, OfATowTellsItsTime) {
  const auto j = told(froude::plan_tow, {.diameter = 0.12, .re = 8e4, .viscosity = 1.05e-6, .length = 60});
  EXPECT_NEAR(j["speed"].get<double>(), 0.7, 1e-12);
  EXPECT_NEAR(j["steady_s"].get<double>(), 60 / 0.7 - 0.7, 1e-9);
  EXPECT_THAT([] { told(froude::plan_tow, {.diameter = 0.12, .viscosity = 1e-6, .length = 60}); },
              ThrowsMessage<InputError>(HasSubstr("two are needed")));
  EXPECT_THAT([] { told(froude::plan_tow, {.diameter = 0.12, .speed = 3, .viscosity = 1e-6, .length = 5}); },
              ThrowsMessage<InputError>(HasSubstr("does not reach")));
}

TEST(Experiment, OfATowTellsHowLongItMustBe) {
  froude::TowPlanArguments a{.diameter = 0.12, .re = 8e4, .viscosity = 1.05e-6, .length = 60, .width = 0.01};
  a.record.noise = 0.3;
  a.record.memory = 0.5;
  a.record.step = 0.02;
  a.record.cylinder = {
      .diameter = 0, .length = 0.5, .density = 997, .viscosity = {}, .experiment = fit::Experiment::body_moves};
  const auto j = told(froude::plan_tow, a);
  EXPECT_LE(j["half_width"].get<double>(), 0.01);
  EXPECT_EQ(j["time"].back()["time_s"], j["needed_s"]);
  EXPECT_FALSE(j.contains("warnings"));
  a.length = 8;
  EXPECT_THAT(told(froude::plan_tow, a)["warnings"].dump(), HasSubstr("tows together"));
}

TEST(Experiment, TellsWhichLoadLeadsAndTheLargestForce) {
  froude::OscillationPlanArguments a{.known = {.diameter = 0.12, .period = 4, .kc = 20}, .viscosity = 1.05e-6};
  auto j = told(froude::plan_oscillation, a);
  EXPECT_NEAR(j["drag_over_inertia"].get<double>(), 1.2 * 20 / (std::numbers::pi * std::numbers::pi), 1e-12);
  EXPECT_FALSE(j.contains("largest_force"));
  a.loads = true;
  a.record.cylinder = {
      .diameter = 0, .length = 0.5, .density = 997, .viscosity = {}, .experiment = fit::Experiment::body_moves};
  j = told(froude::plan_oscillation, a);
  const double drag = 0.5 * 997 * 1.2 * 0.12 * 0.5 * 0.36, inertia = drag / j["drag_over_inertia"].get<double>();
  EXPECT_NEAR(j["largest_force"].get<double>(), drag + inertia * inertia / (4 * drag), 1e-9);  // sums of (F109)
}

TEST(Experiment, OfATowTellsForceAndVortices) {
  froude::TowPlanArguments a{
      .diameter = 0.12, .speed = 0.85, .viscosity = 1.05e-6, .length = 60, .strouhal = 0.25, .loads = true};
  a.record.cylinder = {
      .diameter = 0, .length = 0.5, .density = 997, .viscosity = {}, .experiment = fit::Experiment::body_moves};
  const auto j = told(froude::plan_tow, a);
  EXPECT_NEAR(j["shedding_hz"].get<double>(), 0.25 * 0.85 / 0.12, 1e-12);
  EXPECT_NEAR(j["force"].get<double>(), 0.5 * 997 * a.record.cd * 0.12 * 0.5 * 0.85 * 0.85, 1e-9);
}

TEST(Experiment, OfWavesTellsWhetherACylinderIsSlender) {
  froude::WavePlanArguments a{.period = 1.6, .height = 0.06};
  a.tank = {.water = {.depth = hydro::WaterDepth::infinite()}, .gauge = 20, .body = 23, .end = 60};
  a.diameter = 0.12, a.level = 0.2;
  auto j = told(froude::plan_waves, a);
  const double length = j["wavelength"];
  EXPECT_NEAR(j["diameter_over_wavelength"].get<double>(), 0.12 / length, 1e-12);
  EXPECT_THAT(j.value("warnings", nlohmann::json::array()).dump(), testing::Not(HasSubstr("slender")));
  a.diameter = 0.051 * length;
  EXPECT_THAT(told(froude::plan_waves, a)["warnings"].dump(), HasSubstr("not slender"));
}

TEST(Experiment, OfWavesDrawsWhichLoadLeads) {
  froude::WavePlanArguments a{.period = 1.6, .height = 0.06};
  a.tank = {.water = {.depth = hydro::WaterDepth::infinite()}, .gauge = 20, .body = 23, .end = 60};
  a.picture = support::scratch_folder() / "regimes.svg";
  EXPECT_THAT([&] { told(froude::plan_waves, a); }, ThrowsMessage<InputError>(HasSubstr("--diameter")));
  EXPECT_FALSE(std::filesystem::exists(*a.picture));
  a.diameter = 0.12, a.level = 0.2;
  told(froude::plan_waves, a);
  EXPECT_THAT(hydro::io::read_text(*a.picture),
              testing::AllOf(HasSubstr("highest waves"), HasSubstr("drag 10 times inertia"), HasSubstr("these waves"),
                             HasSubstr("slender left of it"), HasSubstr("KC at the axis")));
}

TEST(Experiment, OfWavesTellsWhenTheyAreSteady) {
  froude::WavePlanArguments a{.period = 1.6, .height = 0.06};
  a.tank = {.water = {.depth = hydro::WaterDepth::from_metres(1.25)}, .gauge = 20, .body = 23, .end = 60};
  a.ramp = 2;
  const auto j = told(froude::plan_waves, a);
  const double c = j["group_velocity"];
  EXPECT_NEAR(j["front_s"].get<double>(), 23 / c, 1e-12);
  EXPECT_NEAR(j["back_from_end_s"].get<double>(), 97 / c, 1e-12);
  EXPECT_EQ(j["steady_periods"].get<double>(), std::floor((97 / c - 23 / c - 2 - 8) / 1.6));
  EXPECT_EQ(j["depth_regime"], "intermediate");
  a.diameter = 0.12;
  EXPECT_THAT([&] { told(froude::plan_waves, a); }, ThrowsMessage<InputError>(HasSubstr("belong together")));
  a.level = 0.48;
  EXPECT_GT(told(froude::plan_waves, a)["kc"].get<double>(), 0);
}

}  // namespace
}  // namespace experiment_command_test
