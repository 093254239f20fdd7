// Forces with more in them than drag and inertia of one motion: a body that moves in waves, lines, a linear drag, and
// the bands about the fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/diagnose.hpp"
#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace morison_parts_test {
namespace {

using fit::Experiment;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double two_pi = 2 * std::numbers::pi, truth_cd = 1.4, truth_ca = 0.8;

fit::Cylinder in_waves() {
  fit::Cylinder c = froude_test::moved_cylinder;
  c.experiment = Experiment::both_move;
  return c;
}

/// Body and water with a frequency of their own each; the force is written out here, by (F49).
struct Scene {
  fit::RawRun raw;
  fit::ForceRecord record;
};
Scene moved_in_waves(std::size_t n, double step, double noise, std::uint64_t stream, double delay = 0) {
  Scene s;
  s.raw.force = {{"F", {}, {}}};
  const double body = two_pi / 4.1, water = two_pi / 2.9, x0 = 0.25, u0 = 0.3;
  const double displaced = 997 * std::numbers::pi / 4 * 0.12 * 0.12 * 0.5;
  const auto e = froude_test::ar1_noise(n, 0.9, noise, stream);
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j);
    const auto force = [&](double at) {
      const double v = x0 * body * std::cos(body * at), a = -x0 * body * body * std::sin(body * at),
                   u = u0 * std::cos(water * at + 0.7), rate = -u0 * water * std::sin(water * at + 0.7);
      return displaced * rate - 5.9 * a + truth_ca * displaced * (rate - a) +
             0.5 * 997 * 0.12 * 0.5 * truth_cd * std::abs(u - v) * (u - v);
    };
    s.raw.time.push_back(t);
    s.raw.position.push_back(x0 * std::sin(body * t));
    s.raw.water_velocity.push_back(u0 * std::cos(water * t + 0.7));
    s.raw.force[0].values.push_back(force(t - delay) + e[j]);
    s.record.time.push_back(t);
    s.record.force.push_back(s.raw.force[0].values.back());
    s.record.velocity.push_back(s.raw.water_velocity[j] - x0 * body * std::cos(body * t));
    s.record.water_acceleration.push_back(-u0 * water * std::sin(water * t + 0.7));
    s.record.acceleration.push_back(s.record.water_acceleration[j] + x0 * body * body * std::sin(body * t));
  }
  return s;
}

TEST(MorisonInWaves, OfABodyAtRestIsThatOfMovingWaterAndOfStillWaterThatOfAMovedBody) {
  const fit::Cylinder both = in_waves(), still = froude_test::moved_cylinder, held = froude_test::held_cylinder;
  // At rest the relative motion is the water's, and C_M = 1 + C_A; in still water it is the body's turned round.
  for (const double u : {-0.7, 0.2})
    for (const double a : {-1.1, 0.4}) {
      EXPECT_NEAR(fit::morison_force(both, 1.4, 0.8, u, a, a), fit::morison_force(held, 1.4, 1.8, u, a), 1e-12);
      EXPECT_NEAR(fit::morison_force(both, 1.4, 0.8, -u, -a, 0), fit::morison_force(still, 1.4, 0.8, u, a), 1e-12);
    }
}

TEST(MorisonInWaves, GivesTheCoefficientsBackFromBothMotions) {
  const auto s = moved_in_waves(3000, 0.02, 0, 1);
  const auto f = fit::fit_morison(in_waves(), s.record);
  EXPECT_NEAR(*f.cd.value, truth_cd, 1e-9);
  EXPECT_NEAR(*f.inertia.value, truth_ca, 1e-9);
  EXPECT_EQ(f.inertia.name, "ca");
  EXPECT_NEAR(*fit::inertia_as(f, "cm").value, 1 + truth_ca, 1e-9);
  const auto cycles = fit::fit_cycles(in_waves(), s.record, std::vector{0.0, 20.0, 40.0});
  EXPECT_NEAR(cycles[1].cd, truth_cd, 1e-9);
}

TEST(MorisonInWaves, IsPreparedFromThePositionOfTheBodyAndTheVelocityOfTheWater) {
  const auto s = moved_in_waves(4000, 0.02, 0, 1);
  const auto p =
      fit::prepare(s.raw, {.derivative_bandwidth_hz = 1.5,
                           .filters = {{.kind = fit::FilterChoice::Kind::butterworth, .order = 4, .hz = 4}}});
  EXPECT_THAT(p.steps, testing::Contains(HasSubstr("less those of the body")));
  const auto f = fit::fit_morison(in_waves(), p.record);
  // Derivatives are 1 % off at 1.5 Hz, and 1 % (0.34/1.5)^4 at the faster of both motions.
  EXPECT_NEAR(*f.cd.value, truth_cd, 1e-3);
  EXPECT_NEAR(*f.inertia.value, truth_ca, 1e-3);
}

TEST(MorisonInWaves, FindsADelayThoughPartOfTheForceIsCarried) {
  const auto s = moved_in_waves(4000, 0.02, 0, 1, 0.13);
  const auto d = fit::fit_morison_and_delay(in_waves(), s.record, 0.3);
  EXPECT_NEAR(*d.fit.delay->value, 0.13,
              2e-5);  // the cubic between samples, 3/128 (ωΔt)⁴ of a force of several harmonics
  EXPECT_NEAR(*d.fit.cd.value, truth_cd, 1e-3);
  EXPECT_NEAR(*d.fit.inertia.value, truth_ca, 1e-3);
}

TEST(MorisonInWaves, CountsWhatAnErrorOfDiameterAndMassDoes) {
  auto s = moved_in_waves(3000, 0.02, 0.5, 4);
  const fit::MorisonOptions options{.cylinder_errors = {.diameter = 0.0012, .mass = 0.06}};
  const auto f = fit::fit_morison(in_waves(), s.record, options);
  // The truth of a budget is the fit with the other number.
  fit::Cylinder wider = in_waves(), heavier = in_waves();
  wider.diameter += 0.0012;
  heavier.mass_beyond_load_cells += 0.06;
  const auto w = fit::fit_morison(wider, s.record), h = fit::fit_morison(heavier, s.record);
  ASSERT_EQ(f.budget.size(), 2u);
  EXPECT_NEAR(*w.cd.value - *f.cd.value, f.budget[0].cd, 0.03 * std::abs(f.budget[0].cd));  // 1 % squared, and its like
  EXPECT_NEAR(*w.inertia.value - *f.inertia.value, f.budget[0].inertia, 0.03 * std::abs(f.budget[0].inertia));
  EXPECT_NEAR(*h.cd.value - *f.cd.value, f.budget[1].cd, 1e-9);
  EXPECT_NEAR(*h.inertia.value - *f.inertia.value, f.budget[1].inertia, 1e-9);
}

TEST(MorisonInWaves, NeedsTheWaterAndNothingElseHasIt) {
  auto s = moved_in_waves(500, 0.02, 0, 1);
  EXPECT_THAT([&] { fit::fit_morison(froude_test::moved_cylinder, s.record); },
              ThrowsMessage<hydro::InputError>(HasSubstr("water itself")));
  s.record.water_acceleration.clear();
  EXPECT_THAT([&] { fit::fit_morison(in_waves(), s.record); },
              ThrowsMessage<hydro::InputError>(HasSubstr("water itself")));
}

/// Water that swings about a held cylinder, with a lift of twice the frequency and noise with a memory.
fit::ForceRecord with_lift(double lift, std::uint64_t stream, double noise = 3) {
  auto r = froude_test::swinging_water(4000, 0.02, 0.9, stream);
  const auto e = froude_test::ar1_noise(4000, 0.9, noise, stream);
  for (std::size_t j = 0; j < r.time.size(); ++j)
    r.force[j] = fit::morison_force(froude_test::held_cylinder, 1.2, 1.8, r.velocity[j], r.acceleration[j]) +
                 lift * std::cos(two_pi / 2 * r.time[j] + 0.5) + e[j];
  return r;
}

TEST(ForceLine, IsToldWithItsAmplitudeAndPhase) {
  const auto f =
      fit::fit_morison(froude_test::held_cylinder, with_lift(5, 1, 0.01), {.lines = {{.multiple = 2}, {.hz = 1.3}}});
  ASSERT_EQ(f.lines.size(), 2u);
  EXPECT_NEAR(f.lines[0].hz, 0.5, 1e-6);
  EXPECT_NEAR(*f.lines[0].amplitude.value, 5,
              5 * 0.002);  // 0.01·√(2/4000), and as much again for the memory, five times
  EXPECT_NEAR(f.lines[0].phase, 0.5, 1e-3);
  EXPECT_NEAR(*f.cd.value, 1.2, 1e-3);
  EXPECT_FALSE(f.lines[1].amplitude.value);  // there is none of 1.3 Hz
}

TEST(ForceLine, WidensNoIntervalOnceItIsNamed) {
  const auto quiet = fit::fit_morison(froude_test::held_cylinder, with_lift(0, 2)),
             ignored = fit::fit_morison(froude_test::held_cylinder, with_lift(30, 2)),
             named = fit::fit_morison(froude_test::held_cylinder, with_lift(30, 2), {.lines = {{.multiple = 2}}});
  const auto width = [](const fit::Coefficient& c) { return c.interval.high - c.interval.low; };
  EXPECT_GT(width(ignored.cd), 1.5 * width(quiet.cd));
  EXPECT_NEAR(width(named.cd), width(quiet.cd), 0.1 * width(quiet.cd));
  EXPECT_NEAR(*named.lines[0].amplitude.value, 30, 3 * named.lines[0].amplitude.standard_error);
}

TEST(ForceLine, HasIntervalsThatHold) {
  int covered = 0, seen = 0, false_alarms = 0;
  constexpr int sets = 100;
  for (int k = 0; k < sets; ++k) {
    const auto stream = static_cast<std::uint64_t>(100 + k);
    const auto f =
        fit::fit_morison(froude_test::held_cylinder, with_lift(4, stream), {.lines = {{.multiple = 2}, {.hz = 0.83}}});
    const auto& a = f.lines[0].amplitude;
    covered += a.interval.low < 4 && 4 < a.interval.high;
    seen += a.value.has_value();
    false_alarms += f.lines[1].amplitude.value.has_value();
  }
  EXPECT_GE(covered, 88);  // 95 of 100, a binomial deviation 2.2: three of them below
  EXPECT_EQ(seen, sets);
  EXPECT_LE(false_alarms, 12);  // one in twenty is told though there is none; three deviations above
}

TEST(ForceLine, IsRefusedWhereItIsTheInertiaItself) {
  EXPECT_THAT([&] { fit::fit_morison(froude_test::held_cylinder, with_lift(0, 1, 0), {.lines = {{.hz = 0.25}}}); },
              ThrowsMessage<hydro::InputError>(HasSubstr("line 1")));
  EXPECT_THROW(fit::fit_morison(froude_test::held_cylinder, with_lift(0, 1), {.lines = {{.hz = 25}}}),
               hydro::InputError);
  EXPECT_THROW(fit::fit_morison(froude_test::held_cylinder, with_lift(0, 1), {.lines = {{.hz = 1, .multiple = 2}}}),
               hydro::InputError);
}

TEST(LinearDrag, IsFittedBesideTheQuadraticOne) {
  for (const auto& cylinder : {froude_test::held_cylinder, froude_test::moved_cylinder}) {
    auto r = froude_test::swinging_water(4000, 0.02, 0.9, 3);
    const double sign = cylinder.experiment == Experiment::body_moves ? -1 : 1;
    for (std::size_t j = 0; j < r.time.size(); ++j)
      r.force[j] =
          fit::morison_force(cylinder, 1.2, 1.8, r.velocity[j], r.acceleration[j]) + sign * 7 * r.velocity[j] + 0.25;
    const auto f = fit::fit_morison(cylinder, r, {.force_offset = true, .linear_drag = true});
    EXPECT_NEAR(*f.cd.value, 1.2, 1e-9);
    EXPECT_NEAR(*f.inertia.value, 1.8, 1e-9);
    EXPECT_NEAR(*f.linear_drag->value, 7, 1e-8);
    EXPECT_NEAR(*f.offset->value, 0.25, 1e-9);
    EXPECT_GT(*fit::fit_morison(cylinder, r).cd.value, 1.3);  // else it is taken for quadratic drag
  }
}

TEST(ForceBands, HoldTheTruthAndNewSamplesAsOftenAsTheyShould) {
  int truth_inside = 0, samples_inside = 0, all = 0;
  constexpr int sets = 100;
  for (int k = 0; k < sets; ++k) {
    const auto stream = static_cast<std::uint64_t>(300 + k);
    const auto r = froude_test::swinging_water(2000, 0.02, 0.9, stream);
    const auto f = fit::fit_morison(froude_test::held_cylinder, r, {.bands = true});
    ASSERT_EQ(f.fit_band.size(), r.time.size());
    const auto anew = froude_test::ar1_noise(r.time.size(), 0.9, 3, stream + 5000);
    for (std::size_t j = 100; j < r.time.size(); j += 317) {
      const double truth = fit::morison_force(froude_test::held_cylinder, 1.2, 1.8, r.velocity[j], r.acceleration[j]);
      truth_inside += std::abs(f.fitted[j] - truth) <= f.fit_band[j];
      samples_inside += std::abs(truth + anew[j] - f.fitted[j]) <= f.sample_band[j];
      ++all;
    }
    EXPECT_GT(f.inside, 0.9);
  }
  // Instants of one record share two coefficients: about 200 independent of 600. 3 deviations of 1.5 % and of 0.9 %.
  EXPECT_NEAR(truth_inside, 0.95 * all, 0.046 * all);
  EXPECT_NEAR(samples_inside, 0.95 * all, 0.03 * all);
}

TEST(ForceBands, CountWhatIsTheSameThroughout) {
  const auto r = froude_test::swinging_water(4000, 0.02, 0.9, 9);
  const auto plain = fit::fit_morison(froude_test::held_cylinder, r, {.bands = true}),
             unsure = fit::fit_morison(froude_test::held_cylinder, r,
                                       {.bands = true, .cylinder_errors = {.diameter = 0.006}});
  // 5 % of the diameter is 5 % of the drag where there is nothing else: at the highest velocity.
  const auto top =
      static_cast<std::size_t>(std::max_element(r.velocity.begin(), r.velocity.end()) - r.velocity.begin());
  const double drag = 0.5 * 997 * 0.06 * *plain.cd.value * r.velocity[top] * r.velocity[top];
  EXPECT_NEAR(std::sqrt(std::pow(unsure.fit_band[top], 2) - std::pow(plain.fit_band[top], 2)), 1.96 * 0.05 * drag,
              1e-2 * drag);
}

}  // namespace
}  // namespace morison_parts_test
