// The whole way from raw channels to coefficients, through what goes wrong in tanks.
#include "fit/prepare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace prepare_test {
namespace {

using fit::FilterChoice;
using fit::PrepareOptions;
using fit::RawRun;
using fit::WindowChoice;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

const fit::Cylinder& cylinder = froude_test::moved_cylinder;
constexpr double step = 0.005, period = 4.0, amplitude = 0.36, truth_cd = 1.2, truth_ca = 1.0;

/// Rest, three cycles of build-up, ten full, three of run-down, rest, at 200 Hz; two load cells that share the force as
/// 0.6 and 0.4. C_D = 1.2, C_A = 1.
RawRun clean() {
  RawRun run;
  run.force = {{"F1", {}, {}}, {"F2", {}, {}}};
  const double omega = 2 * std::numbers::pi / period;
  for (int j = 0; j < 200 * 76; ++j) {
    const double t = step * j, cycle = t / period - 1;
    // While the amplitude changes, its own rate is left out of velocity and force: only full cycles are consistent.
    const double ramp = std::clamp(std::min(cycle / 3, (16 - cycle) / 3), 0.0, 1.0);
    const double x = amplitude * ramp * std::sin(omega * t);
    const double v = amplitude * ramp * omega * std::cos(omega * t), a = -omega * omega * x;
    const double f = fit::morison_force(cylinder, truth_cd, truth_ca, v, a);
    run.time.push_back(t);
    run.position.push_back(x);
    run.force[0].values.push_back(0.6 * f);
    run.force[1].values.push_back(0.4 * f);
  }
  return run;
}

const PrepareOptions usual{.filters = {{.kind = FilterChoice::Kind::butterworth, .order = 4, .hz = 3.33}},
                           .window = {.kind = WindowChoice::Kind::full_cycles, .cycles = 5}};

fit::MorisonFit fitted(const RawRun& run, const PrepareOptions& options = usual) {
  return fit::fit_morison(cylinder, fit::prepare(run, options).record);
}

/// The derivative of the position is 1 % off at five times the main frequency, and 1 %/625 at the main one.
constexpr double by_derivatives = 2e-4;

TEST(Prepare, GivesTheCoefficientsOfACleanRunBack) {
  const auto fit = fitted(clean());
  EXPECT_NEAR(*fit.cd.value, truth_cd, 5 * by_derivatives);
  EXPECT_NEAR(*fit.inertia.value, truth_ca, 5 * by_derivatives);
  EXPECT_EQ(fit.samples, 5 * 800 + 1u);
}

TEST(Prepare, FindsTheCyclesOfFullAmplitudeAndTellsItsSteps) {
  const auto p = fit::prepare(clean(), {.window = {.kind = WindowChoice::Kind::full_cycles}});
  EXPECT_NEAR(static_cast<double>(p.cycle_starts.size()) - 1, 10, 1);
  EXPECT_THAT(p.steps, Contains(HasSubstr("cycles of full amplitude")));
  EXPECT_THAT(p.steps, Contains(HasSubstr("sum of 2 channels")));
  EXPECT_THAT(p.steps, Contains(HasSubstr("derivatives of the position")));
  EXPECT_THAT(p.cautions, IsEmpty());
}

TEST(Prepare, TakesAGivenDelayOff) {
  RawRun run = clean();
  for (auto& f : run.force) {  // 0.73 s are 146 samples
    f.values.insert(f.values.begin(), 146, 0.0);
    f.values.resize(run.time.size());
  }
  PrepareOptions options = usual;
  options.delay_s = 0.73;
  const auto fit = fitted(run, options);
  EXPECT_NEAR(*fit.cd.value, truth_cd, 5 * by_derivatives);
  EXPECT_NEAR(*fit.inertia.value, truth_ca, 5 * by_derivatives);
}

TEST(Prepare, KeepsHumOfTheMainsOutAndNamesIt) {
  RawRun run = clean();
  for (std::size_t j = 0; j < run.time.size(); ++j)
    for (auto& f : run.force) f.values[j] += 3 * std::sin(2 * std::numbers::pi * 50 * run.time[j]);
  const auto p = fit::prepare(run, usual);
  EXPECT_THAT(p.steps, Contains(HasSubstr("hum of the mains")));
  const auto fit = fit::fit_morison(cylinder, p.record);
  EXPECT_NEAR(*fit.cd.value, truth_cd, 5 * by_derivatives);
  EXPECT_LT(fit.residual_rms, 0.05);  // of an amplitude of 6 N that came in
}

TEST(Prepare, ReadsACoarsePotentiometer) {
  RawRun run = clean();
  for (double& x : run.position) x = 0.005 * std::round(x / 0.005);  // 145 levels
  const auto p = fit::prepare(run, usual);
  EXPECT_THAT(p.steps, Contains(HasSubstr("position knows 145 levels")));
  const auto fit = fit::fit_morison(cylinder, p.record);
  // 1.4 mm of noise, averaged over the window of the derivative; the acceleration keeps about 1 % of itself.
  EXPECT_NEAR(*fit.cd.value, truth_cd, 0.02);
  EXPECT_NEAR(*fit.inertia.value, truth_ca, 0.02);
}

TEST(Prepare, SaysThatALoadCellWasAtItsStop) {
  RawRun run = clean();
  for (double& f : run.force[0].values) f = std::min(f, 8.0);
  const auto p = fit::prepare(run, usual);
  EXPECT_THAT(p.cautions, Contains(HasSubstr("F1 stands at 8 in")));
}

TEST(Prepare, RefusesAChannelThatGaveNothing) {
  RawRun run = clean();
  for (double& f : run.force[1].values) f = 0.013;
  EXPECT_THAT([&] { fit::prepare(run, usual); }, ThrowsMessage<hydro::InputError>(HasSubstr("F2 is 0.013 throughout")));
}

TEST(Prepare, FindsAChannelWithTheWrongSign) {
  RawRun run = clean();
  for (double& f : run.force[1].values) f = -f;
  EXPECT_THAT([&] { fit::prepare(run, usual); }, ThrowsMessage<hydro::InputError>(HasSubstr("wrong sign")));
  for (double& f : run.force[0].values) f = -f;  // now both
  EXPECT_THAT(fit::sign_trouble(cylinder, fitted(run)), HasSubstr("wrong sign"));
  EXPECT_THAT(fit::sign_trouble(cylinder, fitted(clean())), IsEmpty());
}

TEST(Prepare, BridgesGapsAndSpikesWithinLimits) {
  RawRun run = clean();
  RawRun holes;
  holes.force = {{"F1", {}, {}}, {"F2", {}, {}}};
  for (std::size_t j = 0; j < run.time.size(); ++j) {
    if (j % 997 < 6) continue;  // six rows lost now and then
    holes.time.push_back(run.time[j]);
    holes.position.push_back(run.position[j]);
    for (std::size_t i = 0; i < 2; ++i)
      holes.force[i].values.push_back(run.force[i].values[j] + (j % 1501 == 30 ? 40 : 0));
  }
  PrepareOptions options = usual;
  EXPECT_THAT([&] { fit::prepare(holes, options); }, ThrowsMessage<hydro::InputError>(HasSubstr("are missing")));
  options.longest_gap_s = 0.05;
  options.outlier_window_s = 20.5 * (holes.time[7] - holes.time[6]);  // ten neighbours on either side
  const auto p = fit::prepare(holes, options);
  EXPECT_THAT(p.steps, Contains(HasSubstr("samples were missing")));
  const auto fit = fit::fit_morison(cylinder, p.record);
  EXPECT_NEAR(*fit.cd.value, truth_cd, 0.005);  // straight lines over 0.035 s lose ω²τ²/8 = 4e-4 of each harmonic
  EXPECT_NEAR(*fit.inertia.value, truth_ca, 0.005);
}

TEST(Prepare, TurnsVoltsIntoNewtonsAndKeepsTheErrorsOfTheLine) {
  RawRun run = clean();
  fit::Calibration line{};
  line.slope = 0.0933;
  line.offset = 0.4;
  line.slope_error = 0.000933;  // 1 %
  line.hysteresis = 0.002;
  line.range = 15;
  const auto rest = froude_test::ar1_noise(4000, 0.8, 0.002, 4);
  for (auto& f : run.force) {
    for (double& v : f.values) v = 0.55 + 0.0933 * v;  // the zero has drifted since the calibration
    f.calibration = line;
    for (const double e : rest) f.zero_run.push_back(0.55 + e);
  }
  const auto p = fit::prepare(run, usual);
  EXPECT_THAT(p.steps, Contains(HasSubstr("F1 has 0.0933")));
  EXPECT_THAT(p.steps, Contains(HasSubstr("zero: 5.89")));  // 0.55/0.0933 = 5.895 and the noise of the mean
  ASSERT_EQ(p.force_errors.size(), 4u);
  const auto fit = fit::fit_morison(cylinder, p.record, {.force_errors = p.force_errors});
  EXPECT_NEAR(*fit.cd.value, truth_cd, 0.005);
  ASSERT_GE(fit.budget.size(), 4u);
  EXPECT_NEAR(fit.budget[0].cd, 0.6 * 0.01 * truth_cd, 1e-3);  // F1 carries 0.6 of the force
  EXPECT_NEAR(fit.budget[2].cd, 0.4 * 0.01 * truth_cd, 1e-3);
}

TEST(Prepare, CountsTheVelocityAcrossInTheDragOfAHorizontalCylinder) {
  fit::Cylinder fixed = cylinder;
  fixed.experiment = fit::Experiment::water_moves;
  fixed.mass_beyond_load_cells = 0;
  RawRun run;
  run.force = {{"F", {}, {}}};
  const double omega = 2 * std::numbers::pi / 3;
  for (int j = 0; j < 3000; ++j) {
    const double t = 0.01 * j, u = 0.5 * std::cos(omega * t), w = 0.4 * std::sin(omega * t);
    const double a = -0.5 * omega * std::sin(omega * t);
    run.time.push_back(t);
    run.velocity.push_back(u);
    run.cross_velocity.push_back(w);
    run.acceleration.push_back(a);
    run.force[0].values.push_back(997 * fixed.volume() * 1.8 * a +
                                  0.5 * 997 * 0.06 * 1.4 * std::sqrt(u * u + w * w) * u);
  }
  const auto fit = fit::fit_morison(fixed, fit::prepare(run, usual).record);
  EXPECT_NEAR(*fit.cd.value, 1.4, 1e-6);  // the filter's settling leaves 1e-4 of 1e-4
  EXPECT_NEAR(*fit.inertia.value, 1.8, 1e-6);
  run.cross_velocity.clear();
  EXPECT_GT(*fit::fit_morison(fixed, fit::prepare(run, usual).record).cd.value, 1.5);
}

TEST(Prepare, WarnsOfNoiseInADerivedAccelerationAndOfWhatItDoes) {
  RawRun run = clean();
  const auto noise = froude_test::ar1_noise(run.time.size(), 0, 0.0005, 12);
  for (std::size_t j = 0; j < noise.size(); ++j) run.position[j] += noise[j];
  PrepareOptions wide = usual;
  wide.filters.clear();
  wide.derivative_bandwidth_hz = 3;
  const auto noisy = fit::prepare(run, wide);
  EXPECT_THAT(noisy.cautions, Contains(HasSubstr("what that takes from inertia is put back")));
  auto as_exact = noisy.record;
  as_exact.motion_errors.clear();
  EXPECT_LT(*fit::fit_morison(cylinder, as_exact).inertia.value, 0.98);
  const auto put_back = fit::fit_morison(cylinder, noisy.record).inertia;
  EXPECT_GT(put_back.interval.high, truth_ca);
  EXPECT_LT(put_back.interval.low, truth_ca);
  wide.derivative_bandwidth_hz = 0.5;  // a sixth of the bandwidth: the noise's variance falls with its fifth power
  const auto narrow = fit::prepare(run, wide);
  EXPECT_THAT(narrow.cautions, IsEmpty());
  EXPECT_NEAR(*fit::fit_morison(cylinder, narrow.record).inertia.value, truth_ca, 0.01);
}

TEST(Prepare, TakesTheWaterFromAProbeWhoseSignalIsLate) {
  fit::Cylinder fixed = cylinder;
  fixed.experiment = fit::Experiment::water_moves;
  fixed.mass_beyond_load_cells = 0;
  const fit::ProbeToBody probe{
      .water = {.density = 997, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(1.25)},
      .level = -0.48,
      .ahead = 0.6};
  const double omega = 2 * std::numbers::pi / 3, k = hydro::waves::wavenumber(omega, probe.water);
  const double along = omega * 0.1 * std::cosh(k * 0.77) / std::sinh(k * 1.25),
               up = omega * 0.1 * std::sinh(k * 0.77) / std::sinh(k * 1.25);
  RawRun run;
  run.force = {{"F", {}, {}}};
  run.probe = probe;
  for (int j = 0; j < 6000; ++j) {
    const double t = 0.01 * j, at = omega * t - k * probe.ahead;
    const double u = along * std::cos(at), w = -up * std::sin(at), a = -along * omega * std::sin(at);
    run.time.push_back(t);
    run.elevation.push_back(0.1 * std::cos(omega * (t - 0.73)));  // the probe tells it 0.73 s later
    run.force[0].values.push_back(997 * fixed.volume() * 1.8 * a +
                                  0.5 * 997 * 0.06 * 1.4 * std::sqrt(u * u + w * w) * u);
  }
  PrepareOptions options = usual;
  options.delay_s = -0.73;  // so the force is early
  options.window = {.kind = WindowChoice::Kind::full_cycles, .cycles = 5};
  const auto p = fit::prepare(run, options);
  EXPECT_THAT(p.steps, Contains(HasSubstr("from the surface at the probe")));
  const auto fit = fit::fit_morison(fixed, p.record);
  EXPECT_NEAR(*fit.cd.value, 1.4, 0.03);  // what the ends of the transform leave, 1e-3 of the motion, on a small drag
  EXPECT_NEAR(*fit.inertia.value, 1.8, 0.01);
}

TEST(Prepare, TakesTheWaterWhereABodyIsThatMovesFar) {
  fit::Cylinder both = cylinder;
  both.experiment = fit::Experiment::both_move;
  fit::ProbeToBody probe{.water = {.density = 997, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(1.25)},
                         .level = -0.48,
                         .ahead = 0.6,
                         .regular = true,
                         .follow = true};
  const double omega = 2 * std::numbers::pi / 2, k = hydro::waves::wavenumber(omega, probe.water), slow = 1.1;
  const double along = omega * 0.1 * std::cosh(k * 0.77) / std::sinh(k * 1.25),
               up = omega * 0.1 * std::sinh(k * 0.77) / std::sinh(k * 1.25);
  RawRun run;
  run.force = {{"F", {}, {}}};
  for (int j = 0; j < 6000; ++j) {
    const double t = 0.01 * j, x = 0.5 * std::sin(slow * t), v = 0.5 * slow * std::cos(slow * t),
                 acceleration = -slow * slow * x, at = omega * t - k * (probe.ahead + x);
    const double u = along * std::cos(at), w = -up * std::sin(at), a = -along * omega * std::sin(at);
    run.time.push_back(t);
    run.position.push_back(x);
    run.elevation.push_back(0.1 * std::cos(omega * t));
    const double mass = 997 * both.volume();
    run.force[0].values.push_back(mass * a - both.mass_beyond_load_cells * acceleration +
                                  0.8 * mass * (a - acceleration) +
                                  0.5 * 997 * 0.06 * 1.4 * std::hypot(u - v, w) * (u - v));
  }
  PrepareOptions options = usual;
  options.derivative_bandwidth_hz = 0.6;
  options.window = {};
  const auto fitted = [&](bool follow) {
    probe.follow = follow;
    run.probe = probe;
    return fit::prepare(run, options);
  };
  const auto p = fitted(true), still = fitted(false);
  EXPECT_THAT(p.steps, Contains(HasSubstr("where the body is, up to 0.5 m")));
  EXPECT_THAT(still.cautions, Contains(HasSubstr("follow = true")));
  const auto fit = fit::fit_morison(both, p.record), without = fit::fit_morison(both, still.record);
  EXPECT_NEAR(*fit.cd.value, 1.4, 0.01);  // the derivative's gain, 1e-3 of the body's motion at a third of its band
  EXPECT_NEAR(*fit.inertia.value, 0.8, 0.01);
  EXPECT_GT(without.residual_rms, 10 * fit.residual_rms);
}

TEST(Prepare, BringsARecordToAnotherRateAndTellsItsBand) {
  PrepareOptions slower = usual;
  slower.resample_hz = 40;
  const auto p = fit::prepare(clean(), slower);
  EXPECT_THAT(p.steps, Contains(HasSubstr("from 200 Hz to 40 Hz")));
  EXPECT_THAT(p.steps, Contains(HasSubstr("0.2 % to 12 Hz, closed from 20 Hz")));
  const auto fit = fit::fit_morison(cylinder, p.record);
  EXPECT_NEAR(static_cast<double>(fit.samples), 5 * 160, 1);
  EXPECT_NEAR(*fit.cd.value, truth_cd, 5 * by_derivatives);
  EXPECT_NEAR(*fit.inertia.value, truth_ca, 5 * by_derivatives);
  // A vibration above the new band does not come back as a slow force: 90 Hz would be 10 Hz at 40 samples a second.
  RawRun run = clean();
  for (std::size_t j = 0; j < run.time.size(); ++j)
    for (auto& f : run.force) f.values[j] += 5 * std::sin(2 * std::numbers::pi * 90 * run.time[j]);
  slower.filters.clear();
  EXPECT_LT(fit::fit_morison(cylinder, fit::prepare(run, slower).record).residual_rms, 0.1);
}

TEST(Prepare, LaysCyclesOverEachOther) {
  RawRun run = clean();
  const auto shake = froude_test::ar1_noise(run.time.size(), 0.9, 2, 7),
             jitter = froude_test::ar1_noise(run.time.size(), 0, 4e-4, 8);
  for (std::size_t j = 0; j < run.time.size(); ++j) {
    run.force[0].values[j] += shake[j];
    run.position[j] += jitter[j];
  }
  PrepareOptions options{.derivative_bandwidth_hz = 1.25,
                         .window = {.kind = WindowChoice::Kind::full_cycles, .cycles = 8}};
  const auto all = fit::fit_morison(cylinder, fit::prepare(run, options).record);
  options.average_cycles = true;
  const auto p = fit::prepare(run, options);
  EXPECT_THAT(p.steps, Contains(HasSubstr("mean cycle: 8 cycles of 4 s")));
  ASSERT_EQ(p.record.time.size(), 8 * 800u);
  ASSERT_EQ(p.cycle_starts.size(), 9u);
  EXPECT_EQ(p.mean_force->force.size(), 800u);
  for (std::size_t j = 0; j < 800; ++j) ASSERT_EQ(p.record.velocity[j], p.record.velocity[j + 800]);
  const auto mean = fit::fit_morison(cylinder, p.record, {.method = fit::IntervalMethod::cycle_clusters});
  // Both are least squares over the same samples; noise of the motion, an eighth as strong, makes the difference.
  EXPECT_NEAR(*mean.cd.value, *all.cd.value, all.cd.standard_error);
  EXPECT_NEAR(*mean.inertia.value, *all.inertia.value, all.inertia.standard_error);
  EXPECT_LT(mean.cd.interval.low, truth_cd);
  EXPECT_GT(mean.cd.interval.high, truth_cd);
  // The same as one fit of the mean force: what least squares is over columns that repeat.
  fit::ForceRecord one{{}, p.mean_force->force, {}, {}};
  for (std::size_t j = 0; j < 800; ++j) {
    one.time.push_back(p.record.time[j]);
    one.velocity.push_back(p.record.velocity[j]);
    one.acceleration.push_back(p.record.acceleration[j]);
    one.drag_flow.push_back(p.record.drag_flow[j]);
  }
  for (auto* column :
       {&one.force, &one.velocity, &one.acceleration, &one.drag_flow})  // two periods: one is too few for the fit
    column->insert(column->end(), column->begin(), column->begin() + 800);
  for (std::size_t j = 0; j < 800; ++j) one.time.push_back(p.record.time[j + 800]);
  const auto of_mean = fit::fit_morison(cylinder, one);
  auto as_exact = p.record;  // what noise of the motion takes off is put back for records, not for single columns
  as_exact.motion_errors.clear();
  const auto of_all = fit::fit_morison(cylinder, as_exact, {.method = fit::IntervalMethod::cycle_clusters});
  EXPECT_NEAR((of_mean.cd.interval.low + of_mean.cd.interval.high) / 2, *of_all.cd.value, 1e-9);
  options.window = {};
  EXPECT_THAT([&] { fit::prepare(run, options); }, ThrowsMessage<hydro::InputError>(HasSubstr("full cycles")));
}

/// Six and a half minutes of a steady oscillation at 20 Hz, whose force has more in it.
template <class Force>
RawRun steady_run(Force more) {
  RawRun run;
  run.force = {{"F", {}, {}}};
  const double omega = 2 * std::numbers::pi / period;
  for (int j = 0; j < 8000; ++j) {
    const double t = 0.05 * j, v = amplitude * omega * std::cos(omega * t);
    run.time.push_back(t);
    run.position.push_back(amplitude * std::sin(omega * t));
    run.force[0].values.push_back(
        fit::morison_force(cylinder, truth_cd, truth_ca, v, -omega * omega * run.position.back()) + more(t));
  }
  return run;
}

// A line off the force and off each column of the model is a column more in the fit: what drifts is gone from what is
// left over, and the coefficients are those of the force alone, to what derivatives lose at 20 Hz.
TEST(Prepare, TakesADriftOffForceAndModelAlike) {
  const auto drift = [](double t) { return 0.05 * (t - 200); };
  const RawRun drifting = steady_run(drift), clean_run = steady_run([](double) { return 0.0; });
  const auto plain = fitted(clean_run, {}), as_it_is = fitted(drifting, {}),
             level = fitted(drifting, {.detrend = true});
  EXPECT_NEAR(*level.cd.value, *plain.cd.value, 1e-3 * truth_cd);
  EXPECT_NEAR(*level.inertia.value, *plain.inertia.value, 1e-3 * truth_ca);
  EXPECT_LT(as_it_is.explained, 0.9);
  EXPECT_GT(level.explained, 1 - 1e-4);
  const auto p = fit::prepare(drifting, {.detrend = true});
  EXPECT_THAT(p.steps, Contains(HasSubstr("trend: the force changes by")));
}

// Drift of a minute and a vibration of 3 Hz are outside of the band, 0.2 to 4 times the frequency of the motion. Third
// harmonics of drag are within 0.5 % and fifth ones are lost to force and model alike.
TEST(Prepare, KeepsABandOfForceAndModelAlike) {
  const RawRun run = steady_run([](double t) {
    return 6 * std::sin(2 * std::numbers::pi * t / 60) + 2 * std::sin(2 * std::numbers::pi * 3 * t);
  });
  const auto fit = fitted(run, {.band_pass = fit::band_about_waves(1 / period)});
  const auto plain = fitted(steady_run([](double) { return 0.0; }), {});
  EXPECT_NEAR(*fit.cd.value, *plain.cd.value, 2e-3 * truth_cd);
  EXPECT_NEAR(*fit.inertia.value, *plain.inertia.value, 2e-3 * truth_ca);
  EXPECT_GT(fit.explained, 1 - 1e-3);
  EXPECT_THAT([&] { fit::prepare(run, {.band_about_waves = true}); },
              ThrowsMessage<hydro::InputError>(HasSubstr("needs their frequency")));
}

}  // namespace
}  // namespace prepare_test
