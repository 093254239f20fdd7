#include "fit/morison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

#include "fit/differentiate.hpp"
#include "fit/filter.hpp"
#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace morison_test {
namespace {

using fit::Cylinder;
using fit::Experiment;
using fit::ForceRecord;
using froude_test::ar1_noise;
using testing::HasSubstr;
using testing::ThrowsMessage;

Cylinder cylinder(Experiment experiment) {
  return {.diameter = 0.12,
          .length = 0.5,
          .density = 997,
          .viscosity = 1.05e-6,
          .experiment = experiment,
          .mass_beyond_load_cells = experiment == Experiment::body_moves ? 5.9 : 0.0};
}

/// Sinusoidal motion of amplitude A (m) and period T (s) and the force that (F7) or (F8) gives.
ForceRecord made(const Cylinder& c, double cd, double inertia, double amplitude, double period, std::size_t n,
                 double step) {
  ForceRecord r;
  const double omega = 2 * std::numbers::pi / period;
  for (std::size_t j = 0; j < n; ++j) {
    const double t = static_cast<double>(j) * step;
    r.time.push_back(t);
    r.velocity.push_back(amplitude * omega * std::cos(omega * t));
    r.acceleration.push_back(-amplitude * omega * omega * std::sin(omega * t));
    r.force.push_back(fit::morison_force(c, cd, inertia, r.velocity.back(), r.acceleration.back()));
  }
  return r;
}

void add(std::vector<double>& values, const std::vector<double>& noise) {
  for (std::size_t j = 0; j < values.size(); ++j) values[j] += noise[j];
}

TEST(MorisonForce, PushesAlongTheWaterAndAgainstTheBody) {
  const Cylinder fixed = cylinder(Experiment::water_moves), moving = cylinder(Experiment::body_moves);
  const double drag = 0.5 * 997 * 0.12 * 0.5 * 1.1 * 4, displaced = 997 * std::numbers::pi / 4 * 0.0144 * 0.5;
  EXPECT_NEAR(fit::morison_force(fixed, 1.1, 2.0, 2, 3), drag + displaced * 2 * 3, 1e-12);
  EXPECT_NEAR(fit::morison_force(fixed, 1.1, 2.0, -2, 0), -drag, 1e-12);
  EXPECT_NEAR(fit::morison_force(moving, 1.1, 1.0, 2, 3), -drag - (displaced + 5.9) * 3, 1e-12);
}

TEST(MorisonForce, OfWaterAndOfBodyDifferByTheFroudeKrylovForceForOneRelativeMotion) {
  // The same relative motion, u = −v: what is left is the push ρV u̇ of the water's own pressure, so C_M = 1 + C_A.
  const Cylinder fixed = cylinder(Experiment::water_moves);
  Cylinder moving = cylinder(Experiment::body_moves);
  moving.mass_beyond_load_cells = 0;
  const double ca = 0.8, difference = fit::morison_force(fixed, 1.1, 1 + ca, 0.7, 0.9) -
                                      fit::morison_force(moving, 1.1, ca, -0.7, -0.9);
  EXPECT_NEAR(difference, 997 * fixed.volume() * 0.9, 1e-12);
}

TEST(MorisonFit, RecoversAPureMorisonSignalInBothExperiments) {
  for (const auto experiment : {Experiment::water_moves, Experiment::body_moves}) {
    const auto c = cylinder(experiment);
    const auto fit = fit::fit_morison(c, made(c, 1.2, 1.7, 0.4, 4, 800, 0.02));
    EXPECT_EQ(fit.search.outcome, fit::SearchReport::Outcome::converged) << fit.search.why;
    EXPECT_NEAR(fit.cd.value.value(), 1.2, 1e-10);
    EXPECT_NEAR(fit.inertia.value.value(), 1.7, 1e-10);
    EXPECT_EQ(fit.inertia.name, experiment == Experiment::water_moves ? "cm" : "ca");
    EXPECT_NEAR(fit.period, 4, 1e-9);
    EXPECT_NEAR(fit.kc, 2 * std::numbers::pi * 0.4 / 0.12, 1e-8);  // 2πA/D for a sinusoid
    EXPECT_NEAR(fit.re.value(), 2 * std::numbers::pi / 4 * 0.4 * 0.12 / 1.05e-6, 1e-4);
  }
}

TEST(MorisonFit, ReadsPeriodAndAmplitudeFromARecordThatEndsWithinAPeriod) {
  const auto c = cylinder(Experiment::water_moves);
  for (const std::size_t n :
       {1000u, 1025u, 1050u, 1075u}) {  // ten periods of 2 s and a quarter, a half, three quarters
    const auto fit = fit::fit_morison(c, made(c, 1.2, 1.7, 0.1, 2, n, 0.02));
    // Under a Hann window the ends leave 1/(2·(2p)³) of p periods, here 6e-5.
    EXPECT_NEAR(fit.period, 2, 2 * 1e-4);
    EXPECT_NEAR(fit.velocity_amplitude, 0.1 * std::numbers::pi, 1e-4);
  }
}

TEST(MorisonFit, ConvertsBetweenConventionsByOne) {
  const auto c = cylinder(Experiment::body_moves);
  auto record = made(c, 1.2, 0.8, 0.4, 4, 800, 0.02);
  add(record.force, ar1_noise(800, 0, 1, 20));
  const auto fit = fit::fit_morison(c, record);
  const auto cm = fit::inertia_as(fit, "cm");
  EXPECT_DOUBLE_EQ(*cm.value, *fit.inertia.value + 1);
  EXPECT_DOUBLE_EQ(cm.interval.low, fit.inertia.interval.low + 1);
  EXPECT_DOUBLE_EQ(*fit::inertia_as(fit, "ca").value, *fit.inertia.value);
  EXPECT_THROW(fit::inertia_as(fit, "cd"), hydro::InputError);
}

TEST(MorisonFit, AgreesWithTheLinearLeastSquaresInClosedForm) {
  const auto c = cylinder(Experiment::body_moves);
  auto record = made(c, 1.2, 1.0, 0.4, 4, 1000, 0.02);
  add(record.force, ar1_noise(1000, 0.7, 5.0, 1));
  Eigen::MatrixXd a(1000, 2);
  Eigen::VectorXd b(1000);
  for (Eigen::Index j = 0; j < 1000; ++j) {
    const auto i = static_cast<std::size_t>(j);
    a(j, 0) = -0.5 * 997 * 0.06 * std::abs(record.velocity[i]) * record.velocity[i];
    a(j, 1) = -997 * c.volume() * record.acceleration[i];
    b[j] = record.force[i] + 5.9 * record.acceleration[i];
  }
  const Eigen::Vector2d x = (a.transpose() * a).inverse() * a.transpose() * b;
  const auto fit = fit::fit_morison(c, record);
  EXPECT_NEAR(*fit.cd.value, x[0], 1e-10);
  EXPECT_NEAR(*fit.inertia.value, x[1], 1e-10);
  EXPECT_NEAR(fit.residual_rms, (a * x - b).norm() / std::sqrt(1000.0), 1e-10);
}

TEST(MorisonFit, GivesIntervalsThatHoldAsOftenAsTheySay) {
  // 300 records each of white and of AR(1) noise: standard error of a coverage of 0.95 is 1.3 %; 0.92 to 0.98 is asked.
  const auto c = cylinder(Experiment::body_moves);
  const auto clean = made(c, 1.2, 1.0, 0.4, 4, 1600, 0.05);
  for (const double phi : {0.0, 0.9}) {
    int cd = 0, ca = 0, white = 0;
    constexpr int records = 300;
    for (std::uint64_t i = 0; i < records; ++i) {
      auto record = clean;
      add(record.force, ar1_noise(record.force.size(), phi, 4.0, 1000 + i));
      const auto fit = fit::fit_morison(c, record);
      cd += fit.cd.interval.low < 1.2 && 1.2 < fit.cd.interval.high;
      ca += fit.inertia.interval.low < 1.0 && 1.0 < fit.inertia.interval.high;
      white += fit.inertia.white_interval.low < 1.0 && 1.0 < fit.inertia.white_interval.high;
    }
    EXPECT_GE(cd, 0.92 * records) << "φ = " << phi;
    EXPECT_LE(cd, 0.98 * records) << "φ = " << phi;
    EXPECT_GE(ca, 0.92 * records) << "φ = " << phi;
    EXPECT_LE(ca, 0.98 * records) << "φ = " << phi;
    if (phi > 0) {
      EXPECT_LT(white, 0.7 * records) << "independent residuals would be a false promise here";
    }
  }
}

TEST(MorisonFit, At1kHzIsWorthFarFewerSamplesThanItHas) {
  const auto c = cylinder(Experiment::body_moves);
  auto record = made(c, 1.2, 1.0, 0.4, 4, 20000, 0.001);
  add(record.force, ar1_noise(20000, 0.995, 4.0, 7));  // memory 0.2 s
  const auto fit = fit::fit_morison(c, record);
  // Twenty seconds of noise with a memory of 0.2 s: (1 − φ)/(1 + φ) = 1/400 of the samples at low frequency.
  EXPECT_LT(fit.cd.effective_samples, 200);
  EXPECT_GT(fit.cd.effective_samples, 20);
  const auto width = [](const fit::Interval& i) { return i.high - i.low; };
  EXPECT_GT(width(fit.cd.interval), 8 * width(fit.cd.white_interval));
}

TEST(MorisonFit, FromAMeasuredPositionComesWithinItsInterval) {
  const auto c = cylinder(Experiment::body_moves);
  const double omega = 2 * std::numbers::pi / 4;
  auto record = made(c, 1.2, 1.0, 0.4, 4, 4000, 0.01);
  std::vector<double> position;
  const auto noise = ar1_noise(4000, 0, 5e-4, 8);
  for (std::size_t j = 0; j < 4000; ++j) position.push_back(0.4 * std::sin(omega * record.time[j]) + noise[j]);
  add(record.force, ar1_noise(4000, 0.9, 2.0, 9));
  const auto motion = fit::from_position(position, 0.01);
  const auto cut = [&](std::vector<double>& v) {
    v = {v.begin() + static_cast<std::ptrdiff_t>(motion.first), v.end() - static_cast<std::ptrdiff_t>(motion.first)};
  };
  cut(record.time);
  cut(record.force);
  record.velocity = motion.velocity;
  record.acceleration = motion.acceleration;
  const auto fit = fit::fit_morison(c, record, {.confidence = 0.99});
  EXPECT_LT(fit.cd.interval.low, 1.2);
  EXPECT_GT(fit.cd.interval.high, 1.2);
  EXPECT_LT(fit.inertia.interval.low, 1.0);
  EXPECT_GT(fit.inertia.interval.high, 1.0);
}

TEST(MorisonFit, ReportsDragAtSmallKeuleganCarpenterNumberAsNotIdentifiable) {
  // KC = 0.3 in short waves, like the one measured run whose fit gave C_D = 66.
  const auto c = cylinder(Experiment::water_moves);
  auto record = made(c, 1.0, 2.0, 0.0057, 1.19, 6000, 0.001);
  add(record.force, ar1_noise(6000, 0.99, 0.02, 10));
  const auto fit = fit::fit_morison(c, record);
  EXPECT_NEAR(fit.kc, 0.3, 0.01);
  EXPECT_FALSE(fit.cd.value.has_value());
  EXPECT_THAT(fit.cd.why_not, HasSubstr("cd"));
  EXPECT_GT(std::abs(fit.cd.shift_per_degree), 1);
  ASSERT_TRUE(fit.inertia.value.has_value()) << fit.inertia.why_not;
  EXPECT_NEAR(*fit.inertia.value, 2, 0.02);
}

TEST(MorisonFit, PredictsTheShiftOfALateForce) {
  const auto c = cylinder(Experiment::water_moves);
  auto record = made(c, 1.2, 2.0, 0.1, 4, 4000, 0.01);
  const auto before = fit::fit_morison(c, record);
  auto late = record;
  for (std::size_t j = 0; j < record.time.size(); ++j) {
    const double t = record.time[j] - 4.0 / 360, omega = 2 * std::numbers::pi / 4;
    late.force[j] =
        fit::morison_force(c, 1.2, 2.0, 0.1 * omega * std::cos(omega * t), -0.1 * omega * omega * std::sin(omega * t));
  }
  const auto after = fit::fit_morison(c, late);
  // First order in an angle of 0.0175 rad: 2 % of the shift.
  EXPECT_NEAR(*after.cd.value - *before.cd.value, before.cd.shift_per_degree,
              0.02 * std::abs(before.cd.shift_per_degree));
  EXPECT_NEAR(*after.inertia.value - *before.inertia.value, before.inertia.shift_per_degree,
              0.02 * std::abs(before.inertia.shift_per_degree) + 1e-3);
}

TEST(MorisonFit, FindsAnOffsetOfTheLoadCellsWhereAskedTo) {
  const auto c = cylinder(Experiment::body_moves);
  auto record = made(c, 1.2, 1.0, 0.4, 4, 900, 0.02);
  for (double& f : record.force) f += 3.5;
  const auto fit = fit::fit_morison(c, record, {.force_offset = true});
  EXPECT_NEAR(fit.offset->value.value(), 3.5, 1e-9);
  EXPECT_NEAR(*fit.cd.value, 1.2, 1e-10);
  EXPECT_FALSE(fit::fit_morison(c, record).offset.has_value());
}

TEST(MorisonFit, CautionsWhereTheResidualsRepeatInEveryCycle) {
  // A third harmonic that the model cannot make, and no noise: no interval from scatter can cover it.
  const auto c = cylinder(Experiment::body_moves);
  auto record = made(c, 1.2, 1.0, 0.4, 4, 2000, 0.02);
  for (std::size_t j = 0; j < 2000; ++j) record.force[j] += 4 * std::cos(3 * std::numbers::pi / 2 * record.time[j] + 1);
  const auto fit = fit::fit_morison(c, record);
  EXPECT_THAT(fit.caution, HasSubstr("same in every cycle"));
  EXPECT_LT(fit.cd.interval.low, 1.2);  // the line counts as noise of its own frequency
  EXPECT_GT(fit.cd.interval.high, 1.2);
  add(record.force, ar1_noise(2000, 0.5, 8, 12));
  EXPECT_TRUE(fit::fit_morison(c, record).caution.empty());
}

TEST(MorisonFit, GivesNoNumberWhereDragAndInertiaCannotBeToldApart) {
  const auto c = cylinder(Experiment::water_moves);
  auto record = made(c, 1.2, 2.0, 0.4, 4, 800, 0.02);
  for (std::size_t j = 0; j < 800; ++j) record.acceleration[j] = std::abs(record.velocity[j]) * record.velocity[j];
  add(record.force, ar1_noise(800, 0, 1, 11));
  const auto fit = fit::fit_morison(c, record);
  EXPECT_FALSE(fit.cd.value.has_value());
  EXPECT_FALSE(fit.inertia.value.has_value());
  EXPECT_THAT(fit.cd.why_not, HasSubstr("do not see"));
}

TEST(MorisonFit, RefusesBadRecordsAndBodies) {
  const auto c = cylinder(Experiment::water_moves);
  const auto good = made(c, 1.2, 2.0, 0.4, 4, 400, 0.02);
  const auto fit = [](Cylinder body, ForceRecord r) { return [body, r] { fit::fit_morison(body, r); }; };
  auto r = good;
  r.force.pop_back();
  EXPECT_THAT(fit(c, r), ThrowsMessage<hydro::InputError>(HasSubstr("399 forces")));
  r = good;
  r.velocity[5] = std::nan("");
  EXPECT_THAT(fit(c, r), ThrowsMessage<hydro::InputError>(HasSubstr("sample 6")));
  r = good;
  r.time[200] += 0.01;
  EXPECT_THAT(fit(c, r), ThrowsMessage<hydro::InputError>(HasSubstr("not evenly sampled")));
  EXPECT_THAT(fit(c, made(c, 1, 2, 0.4, 4, 100, 0.02)),
              ThrowsMessage<hydro::InputError>(HasSubstr("shorter than its main period")));
  auto body = c;
  body.mass_beyond_load_cells = 1;
  EXPECT_THAT(fit(body, good), ThrowsMessage<hydro::InputError>(HasSubstr("no inertia force")));
  body = c;
  body.diameter = 0;
  EXPECT_THROW(fit(body, good)(), hydro::InputError);
}

TEST(MorisonFit, IsNotBiasedByAFilterThatRunsOverTheDragFlowToo) {
  const auto c = cylinder(Experiment::water_moves);
  const auto raw = made(c, 1.2, 1.7, 0.4, 4, 4000, 0.02);
  const auto filter = fit::ZeroPhaseFilter::butterworth(2, 0.5, 0.02);  // cuts the third harmonic, 0.75 Hz, to 0.16
  ForceRecord r = raw;
  r.drag_flow.clear();
  for (const double u : raw.velocity) r.drag_flow.push_back(std::abs(u) * u);
  for (auto* column : {&r.force, &r.acceleration, &r.drag_flow}) *column = filter.apply(*column);
  for (auto* column : {&r.time, &r.velocity})
    *column = {column->begin() + static_cast<long>(filter.settling()),
               column->end() - static_cast<long>(filter.settling())};
  const auto fit = fit::fit_morison(c, r);
  EXPECT_NEAR(fit.cd.value.value(), 1.2, 1e-9);  // the same linear filter over both sides of the equation
  EXPECT_NEAR(fit.inertia.value.value(), 1.7, 1e-9);
  r.drag_flow.clear();
  // First harmonic of |u|u: 8/(3π); only it and a sixth of the third are left in the force.
  EXPECT_GT(std::abs(*fit::fit_morison(c, r).cd.value - 1.2), 0.02);
}

TEST(MorisonFit, AddsWhatDoesNotAverageOutToTheInterval) {
  const auto c = cylinder(Experiment::body_moves);
  auto record = made(c, 1.2, 1.0, 0.4, 4, 1000, 0.02);
  std::vector<double> slope = record.force;  // a slope that may be wrong by 2 % of the force
  for (double& f : slope) f *= 0.02;
  add(record.force, ar1_noise(1000, 0.7, 1.0, 4));
  const auto plain = fit::fit_morison(c, record);
  const auto wide = fit::fit_morison(
      c, record, {.cylinder_errors = {.diameter = 0.001, .mass = 0.1}, .force_errors = {{"slope of F1", slope}}});
  const double displaced = 997 * c.volume();
  ASSERT_EQ(wide.budget.size(), 3u);
  EXPECT_EQ(wide.budget[0].source, "slope of F1");
  EXPECT_NEAR(wide.budget[0].cd, 0.02 * 1.2, 1e-9);  // drag is proportional to the force,
  EXPECT_NEAR(wide.budget[0].inertia, 0.02 * (1.0 + 5.9 / displaced),
              1e-9);  // and so is all inertia, the mass included
  EXPECT_NEAR(wide.budget[1].cd, -*plain.cd.value / 120, 1e-9);
  EXPECT_NEAR(wide.budget[1].inertia, -2 * *plain.inertia.value / 120, 1e-9);
  EXPECT_NEAR(wide.budget[2].inertia, -0.1 / displaced, 1e-12);
  EXPECT_DOUBLE_EQ(*wide.cd.value, *plain.cd.value);
  EXPECT_NEAR(wide.cd.systematic_error, std::hypot(0.024, *plain.cd.value / 120), 1e-9);
  const double half = (wide.cd.interval.high - wide.cd.interval.low) / 2;
  const double scatter = (plain.cd.interval.high - plain.cd.interval.low) / 2;
  EXPECT_NEAR(half, std::hypot(scatter, 1.959964 * wide.cd.systematic_error), 1e-6);
}

TEST(MorisonFit, IsNotPulledByWildSamplesIfItIsRobust) {
  const auto c = cylinder(Experiment::body_moves);
  int plain_holds = 0, robust_holds = 0;
  double width = 0;
  constexpr int sets = 200;
  for (int i = 0; i < sets; ++i) {
    const auto stream = 500 + static_cast<std::uint64_t>(i);
    auto record = made(c, 1.2, 1.0, 0.4, 4, 1000, 0.02);
    add(record.force, ar1_noise(1000, 0.5, 1.0, stream));
    const auto robust_alone = fit::fit_morison(c, record, {.robust = fit::RobustLoss::huber}).cd;
    width += (robust_alone.interval.high - robust_alone.interval.low) / sets;
    for (std::size_t j = 0; j < 1000; j += 23) record.force[j] += record.velocity[j] > 0 ? 40 : 0;  // one side only
    const auto plain = fit::fit_morison(c, record).cd,
               robust = fit::fit_morison(c, record, {.robust = fit::RobustLoss::huber}).cd;
    plain_holds += plain.interval.low < 1.2 && 1.2 < plain.interval.high;
    robust_holds += robust_alone.interval.low < 1.2 && 1.2 < robust_alone.interval.high;
    EXPECT_LT(std::abs(*robust.value - 1.2), 0.3 * std::abs(*plain.value - 1.2));
  }
  EXPECT_LT(plain_holds, 20);
  EXPECT_GE(robust_holds, 178);  // 190 ± 3.1
}

TEST(MorisonFit, ThatIsRobustSolvesHubersEquations) {
  const auto c = cylinder(Experiment::water_moves);
  auto record = made(c, 1.2, 1.7, 0.4, 4, 800, 0.02);
  add(record.force, ar1_noise(800, 0, 2.0, 8));
  const auto fit = fit::fit_morison(c, record, {.robust = fit::RobustLoss::huber});
  std::vector<double> e(800);
  for (std::size_t j = 0; j < 800; ++j) e[j] = record.force[j] - fit.fitted[j];
  auto sorted = e;
  for (double& x : sorted) x = std::abs(x);
  std::nth_element(sorted.begin(), sorted.begin() + 400, sorted.end());
  const double limit = 1.345 * sorted[400] / 0.6745;
  double gradient = 0, scale = 0;
  for (std::size_t j = 0; j < 800; ++j) {
    const double column = std::abs(record.velocity[j]) * record.velocity[j];
    gradient += column * std::clamp(e[j], -limit, limit);
    scale += column * column;
  }
  EXPECT_LT(std::abs(gradient) / std::sqrt(scale), 0.02 * limit);  // the scale is that of the third round
  EXPECT_NEAR(fit.share_inside, 0.82, 0.05);                       // P(|Z| < 1.345)
}

}  // namespace
}  // namespace morison_test
