// Added mass and damping of a body whose memory is known in closed form, (R9), from motions and decays made here.
#include "fit/forced_radiation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"
#include "support/two_pole_body.hpp"

namespace forced_radiation_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const support::TwoPoleBody waves{.decay = 1.2, .frequency = 2.8};
constexpr double strength = 400, limit = 60;
const fit::RestoredBody body{.mass = 120, .stiffness = 2500};

double added_mass(double omega) { return limit + strength * waves.A_minus_A_inf(omega); }
double damping(double omega) { return strength * waves.B(omega); }

fit::RadiationPoint forced(double omega, double force_noise, double motion_noise, std::uint64_t stream,
                           double cycles = 10.4, double third = 0) {
  const double step = 2 * std::numbers::pi / omega / 40;
  const auto n = static_cast<std::size_t>(cycles * 40);
  const auto e = froude_test::ar1_noise(n, 0.5, force_noise, stream),
             d = froude_test::ar1_noise(n, 0, motion_noise, stream + 10000);
  std::vector<double> time, motion, force;
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j), x = 0.05 * std::sin(omega * t + 0.3),
                 v = 0.05 * omega * std::cos(omega * t + 0.3);
    time.push_back(t);
    motion.push_back(0.02 + x + d[j]);
    force.push_back((120 + added_mass(omega)) * omega * omega * x - damping(omega) * v - 2500 * x + 4 +
                    third * std::sin(3 * omega * t) + e[j]);
  }
  return fit::fit_radiation(time, motion, force, body);
}

TEST(ForcedRadiation, GivesAddedMassAndDampingOfAClosedFormBack) {
  for (const double omega : {0.8, 2.5, 3.1, 7.0}) {
    const auto p = forced(omega, 0, 0, 1);
    EXPECT_NEAR(p.omega, omega, 1e-5 * omega);  // where a transform of ten periods has its peak
    // What an error of 1e-5 of the frequency does to ω²(M + A) − C over ten cycles.
    EXPECT_NEAR(*p.added_mass.value, added_mass(omega), 0.05);
    EXPECT_NEAR(*p.damping.value, damping(omega), 0.05 * omega);
    EXPECT_NEAR(p.amplitude, 0.05, 1e-5);
  }
}

TEST(ForcedRadiation, TellsHarmonicsApartFromWhatIsLinear) {
  const auto p = forced(3.1, 0, 0, 1, 10.4, 2.0);
  EXPECT_NEAR(*p.added_mass.value, added_mass(3.1), 0.05);
  EXPECT_NEAR(p.third_harmonic *
                  std::abs(std::complex<double>(2500 - 3.1 * 3.1 * (120 + added_mass(3.1)), 3.1 * damping(3.1))) * 0.05,
              2.0, 0.01);
  EXPECT_LT(p.second_harmonic, 1e-3);
}

TEST(ForcedRadiation, HasIntervalsThatHold) {
  int mass = 0, loss = 0;
  constexpr int sets = 300;
  for (int k = 0; k < sets; ++k) {
    const auto p = forced(3.1, 0.5, 2e-4, static_cast<std::uint64_t>(1 + k));
    const auto holds = [](const fit::Coefficient& c, double truth) {
      return c.interval.low < truth && truth < c.interval.high;
    };
    mass += holds(p.added_mass, added_mass(3.1));
    loss += holds(p.damping, damping(3.1));
  }
  // 285 of 300 with a binomial deviation of 3.8: three of them either way.
  for (const int covered : {mass, loss}) {
    EXPECT_GE(covered, 273);
    EXPECT_LE(covered, 297);
  }
}

TEST(ForcedRadiation, RefusesWhatIsNoSteadyOscillation) {
  std::vector<double> time, motion, force;
  for (int j = 0; j < 400; ++j) {
    time.push_back(0.05 * j);
    motion.push_back(std::exp(-0.1 * time.back()) * std::sin(2 * time.back()));
    force.push_back(motion.back());
  }
  EXPECT_THAT([&] { fit::fit_radiation(time, motion, force, body); },
              ThrowsMessage<hydro::InputError>(HasSubstr("not steady")));
  EXPECT_THROW(forced(3.1, 0, 0, 1, 2.2), hydro::InputError);
  EXPECT_THROW(fit::fit_radiation(time, std::vector<double>(400, 0.1), force, body), hydro::InputError);
}

TEST(RadiationMemory, HasThePolesOfTheBody) {
  std::vector<fit::RadiationPoint> points;
  for (const double omega : {0.6, 1.0, 1.4, 1.8, 2.2, 2.6, 3.0, 3.4, 3.9, 4.5, 5.2, 6.0, 7.0, 8.5, 10.0})
    points.push_back(forced(omega, 0, 0, 1));
  const auto m = fit::fit_radiation_memory(points);
  EXPECT_TRUE(m.poles.report.passive);
  EXPECT_LT(m.poles.report.error, 2 * m.tolerance);
  EXPECT_NEAR(m.poles.A_inf(0, 0), limit, 0.02 * limit);
  for (const double omega : {0.8, 2.0, 2.8, 4.2, 8.0}) {  // between the points
    const auto k = m.poles.model.transform(omega)(0, 0);
    EXPECT_NEAR(k.real(), damping(omega), 0.02 * damping(2.9)) << omega;
    EXPECT_NEAR(m.poles.A_inf(0, 0) + k.imag() / omega, added_mass(omega), 0.03 * limit) << omega;
  }
}

TEST(RadiationMemory, TellsHowWellTheLimitIsKnown) {
  int held = 0;
  constexpr int sets = 10;
  for (std::uint64_t k = 0; k < sets; ++k) {
    std::vector<fit::RadiationPoint> points;
    for (const double omega : {0.8, 1.4, 2.0, 2.6, 3.2, 3.9, 5.0, 6.5, 8.5, 11.0})
      points.push_back(forced(omega, 0.5, 2e-5, 100 * k + static_cast<std::uint64_t>(10 * omega)));
    const auto m = fit::fit_radiation_memory(points);
    ASSERT_TRUE(m.limit.value) << m.limit.why_not;
    held += m.limit.interval.low < limit && limit < m.limit.interval.high;
  }
  EXPECT_GE(held, 8);  // of ten at 95 %: fewer come once in eighty, by chance
}

TEST(RadiationMemory, NeedsPointsEnough) {
  std::vector<fit::RadiationPoint> points{forced(1, 0, 0, 1), forced(2, 0, 0, 1)};
  EXPECT_THAT([&] { fit::fit_radiation_memory(points); },
              ThrowsMessage<hydro::InputError>(HasSubstr("five frequencies")));
}

TEST(AddedMass, FollowsFromTheNaturalPeriod) {
  const double omega = 2 * std::numbers::pi / 6.4, all = 12000 / (omega * omega);
  int mass = 0, loss = 0;
  constexpr int sets = 100;
  for (int k = 0; k < sets; ++k) {
    fit::Window w{0.1, fit::follow(fit::MotionLaw::oscillator, std::vector{omega, 0.06, 0.0, 0.0, 0.0, 0.0},
                                   Eigen::Vector2d(0.15, 0), 0.1, 600, 4)};
    const auto e = froude_test::ar1_noise(600, 0.7, 0.002, static_cast<std::uint64_t>(50 + k));
    for (Eigen::Index j = 0; j < 600; ++j) w.values(j, 0) += e[static_cast<std::size_t>(j)];
    const auto decay = fit::fit_decay(std::vector{w}, {.terms = {.linear = true}, .substeps = 1});
    const auto a = fit::added_mass(decay, {.mass = 9960, .stiffness = 12000});
    EXPECT_NEAR(a.omega, omega, 1e-2);
    const auto holds = [](const fit::Coefficient& c, double truth) {
      return c.interval.low < truth && truth < c.interval.high;
    };
    mass += holds(a.added_mass, all - 9960);
    loss += holds(a.damping[0], 0.06 * all);
    if (k > 0) continue;
    // Uncertainties of mass and stiffness: A = C/ω² − M, so 1 % of C is 124.5 and 1 % of M 99.6.
    const auto unsure =
        fit::added_mass(decay, {.mass = 9960, .stiffness = 12000, .mass_error = 0.01, .stiffness_error = 0.01});
    EXPECT_NEAR(unsure.added_mass.systematic_error, std::hypot(0.01 * all, 99.6), 0.1);
    EXPECT_GT(unsure.added_mass.interval.high, a.added_mass.interval.high);
    EXPECT_FALSE(fit::added_mass(decay, {.mass = all, .stiffness = 12000, .mass_error = 0.05}).added_mass.value);
  }
  // 95 of 100, three binomial deviations of 2.2 either way.
  EXPECT_NEAR(mass, 95, 6.6);
  EXPECT_NEAR(loss, 95, 6.6);
}

}  // namespace
}  // namespace forced_radiation_test
