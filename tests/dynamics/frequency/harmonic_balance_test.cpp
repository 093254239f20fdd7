#include "dynamics/frequency/harmonic_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/frequency/floquet.hpp"
#include "support/hill_determinant.hpp"

namespace harmonic_balance_test {
namespace {

using namespace dynamics::frequency;
using Eigen::MatrixXd, Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

MatrixXd one(double x) { return MatrixXd::Constant(1, 1, x); }

/// ÿ + 2c ẏ + q |ẏ| ẏ + (δ + ε cos ωt) y + β y³ + ∫ K w dτ = f(t), K(t) = k e^{−at}, w = ẏ.
struct Oscillator final : PeriodicSystem {
  double w = 1, c = 0, quadratic = 0, delta = 1, epsilon = 0, beta = 0;
  std::function<double(double)> force = [](double) { return 0.0; };
  std::optional<PeriodicMemory> kept = {};

  Eigen::Index size() const override { return 1; }
  double omega() const override { return w; }
  PeriodicSample at(const CoordinateMotion& m, const VectorXd& load) override {
    const double y = m.value[0], v = m.rate[0], stiffness = delta + epsilon * std::cos(w * m.time);
    const double r = m.acceleration[0] + 2 * c * v + quadratic * std::abs(v) * v + stiffness * y + beta * y * y * y -
                     force(m.time) - (kept ? load[0] : 0);
    PeriodicSample out{VectorXd::Constant(1, r), one(stiffness + 3 * beta * y * y),
                       one(2 * c + 2 * quadratic * std::abs(v)), one(1)};
    if (kept) out.by_load = one(-1), out.velocity_by_value = one(0), out.velocity_by_rate = one(1);
    return out;
  }
  const PeriodicMemory* memory() const override { return kept ? &*kept : nullptr; }
  VectorXd memory_velocity(const CoordinateMotion& m) override { return m.rate; }
};

PeriodicMemory exponential(double k, double a) {
  return {[k, a](double omega) { return Eigen::MatrixXcd::Constant(1, 1, k / std::complex<double>(a, omega)); },
          one(-a), one(1), one(k)};
}

double amplitude(const PeriodicMotion& m, Eigen::Index h = 1) {
  return m.coefficients.block(0, 2 * h - 1, 1, 2).norm();
}

TEST(HarmonicBalance, OfALinearSystemWithMemoryIsItsTransferFunction) {
  Oscillator system;
  system.w = 1.3, system.c = 0.1, system.kept = exponential(0.4, 0.7);
  system.force = [](double t) { return 2 * std::cos(1.3 * t) + std::sin(2.6 * t); };
  const Balance found = balance(system, at_rest(system));
  ASSERT_TRUE(found.found) << found.why;
  for (const int h : {1, 2}) {
    const std::complex<double> i(0, 1), s = 1.3 * h * i;
    // Re((c − i s) e^{iωt}) = c cos + s sin
    const std::complex<double> F = h == 1 ? 2.0 : -i, y = F / (s * s + 0.2 * s + 1.0 + s * 0.4 / (0.7 + s));
    EXPECT_NEAR(found.motion.coefficients(0, 2 * h - 1), y.real(), 1e-12);  // a linear system of nine equations
    EXPECT_NEAR(found.motion.coefficients(0, 2 * h), -y.imag(), 1e-12);
  }
}

TEST(HarmonicBalance, MultipliersWithMemoryAreThoseOfItsStates) {
  Oscillator system;
  system.w = 1.3, system.c = 0.1, system.kept = exponential(0.4, 0.7);
  const Eigen::Matrix3d A{{0, 1, 0}, {-1, -0.2, -0.4}, {0, 1, -0.7}};  // of y, ẏ and ∫e^{−a(t−τ)} ẏ dτ
  const double T = 2 * pi / 1.3;
  const auto expected = floquet_multipliers([&](double) { return MatrixXd(A); }, T);
  const auto found = floquet_multipliers(system, at_rest(system));
  ASSERT_EQ(found.size(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::abs(found[i]), std::abs(expected[i]), 1e-8);  // as promised
  EXPECT_EQ(fate_of(found), Fate::stable);
}

// y = 0.8 cos ωt + 0.2 sin 3ωt + 0.1, the force what the equation then leaves: harmonics up to nine, all below the 4 (H
// + 1) samples, so that rounding is all that is left.
TEST(HarmonicBalance, FindsAManufacturedMotionOfDuffing) {
  constexpr double w = 0.9, beta = 0.5, c = 0.05;
  const auto y = [](double t) { return 0.1 + 0.8 * std::cos(w * t) + 0.2 * std::sin(3 * w * t); };
  Oscillator system;
  system.w = w, system.beta = beta, system.c = c;
  system.force = [&](double t) {
    const double v = -0.8 * w * std::sin(w * t) + 0.6 * w * std::cos(3 * w * t);
    const double a = -0.8 * w * w * std::cos(w * t) - 1.8 * w * w * std::sin(3 * w * t);
    return a + 2 * c * v + y(t) + beta * std::pow(y(t), 3);
  };
  PeriodicMotion near = at_rest(system, 9);
  near.coefficients(0, 1) = 0.7;
  const Balance found = balance(system, near);
  ASSERT_TRUE(found.found) << found.why;
  for (const double t : {0.0, 1.0, 2.5, 6.0}) EXPECT_NEAR(found.motion.at(t).value[0], y(t), 1e-9);
}

/// Amplitude A and the force that holds it at ω, to one harmonic: F² = A² ((1 − ω² + ¾βA²)² + 4c²ω²).
double force_for(double A, double w, double beta, double c) {
  return A * std::hypot(1 - w * w + 0.75 * beta * A * A, 2 * c * w);
}

// At ω = 1.1 the force that holds an amplitude rises to a crest, falls, and rises again: between lie three motions for
// one force. The third harmonic is βA²/32 = 1e-3 of the first and changes the folds by its square over the detuning.
TEST(HarmonicBalance, FollowsDuffingRoundItsFolds) {
  constexpr double w = 1.1, beta = 0.1, c = 0.02;
  double crest = 0, trough = 1e9;
  for (double A = 0.01; A < 3; A += 1e-4) {
    const double before = force_for(A - 1e-4, w, beta, c), at = force_for(A, w, beta, c),
                 after = force_for(A + 1e-4, w, beta, c);
    if (at > before && at > after) crest = at;
    if (at < before && at < after) trough = at;
  }
  const Family family = [](double F) {
    auto system = std::make_unique<Oscillator>();
    system->w = w, system->beta = beta, system->c = c;
    system->force = [F](double t) { return F * std::cos(w * t); };
    return system;
  };
  const auto first = family(0.01);
  const Balance start = balance(*first, at_rest(*first));
  ASSERT_TRUE(start.found);
  const auto [branch, end] = follow(family, 0.01, 1.5 * crest, start.motion, {.step = 0.01, .largest_step = 0.02});
  EXPECT_EQ(end, "");
  double highest = 0, lowest = 1e9;
  int back = 0;
  for (std::size_t i = 1; i + 1 < branch.size(); ++i) {
    const BranchPoint& p = branch[i];
    const auto system = family(p.parameter);
    if (branch[i - 1].forwards && !p.forwards) highest = branch[i - 1].parameter;
    if (!branch[i - 1].forwards && p.forwards) lowest = branch[i - 1].parameter;
    back += p.forwards ? 0 : 1;
    // Between the folds, and nowhere else, a multiplier is above 1; next to a fold the two may differ by one point.
    if (p.forwards != branch[i - 1].forwards || p.forwards != branch[i + 1].forwards) continue;
    EXPECT_EQ(fate_of(floquet_multipliers(*system, p.motion)), p.forwards ? Fate::stable : Fate::fold)
        << "F = " << p.parameter << ", A = " << amplitude(p.motion);
  }
  EXPECT_GT(back, 5);
  EXPECT_NEAR(highest, crest, 0.01 * crest);  // within a step of the branch
  EXPECT_NEAR(lowest, trough, 0.02 * crest);
  EXPECT_NEAR(branch.back().parameter, 1.5 * crest, 1e-12);
}

// Below the crest of force_for() the motion goes on growing; beyond it the nearest one is on the upper branch, which
// no path of ever stronger forces comes to.
TEST(HarmonicBalance, KnowsWhetherNewtonJumpedOntoAnotherBranch) {
  constexpr double w = 1.1, beta = 0.1, c = 0.02;
  double crest = 0, at_crest = 0;
  for (double A = 0.01; force_for(A, w, beta, c) > crest; A += 1e-4) crest = force_for(A, w, beta, c), at_crest = A;
  const Family family = [](double F) {
    auto system = std::make_unique<Oscillator>();
    system->w = w, system->beta = beta, system->c = c;
    system->force = [F](double t) { return F * std::cos(w * t); };
    return system;
  };
  const auto first = family(0.1 * crest);
  const MotionAt rest{0, at_rest(*first)}, low{0.1 * crest, balance(*first, at_rest(*first)).motion};
  const Carried below = carry(family, rest, low, 0.95 * crest);
  ASSERT_TRUE(below.end.found);
  EXPECT_TRUE(below.joined);
  EXPECT_LT(amplitude(below.end.motion), at_crest);
  // Third harmonic as in FollowsDuffingRoundItsFolds.
  EXPECT_NEAR(force_for(amplitude(below.end.motion), w, beta, c), 0.95 * crest, 0.01 * crest);
  const Carried beyond = carry(family, rest, low, 1.1 * crest);
  EXPECT_FALSE(beyond.joined);
  if (beyond.end.found) {
    EXPECT_GT(amplitude(beyond.end.motion), 1.5 * at_crest);
  }
}

// Without damping and force a Duffing oscillator of amplitude A swings at ω = π √(1 + βA²)/(2 K(k)), k² = βA²/(2 (1 +
// βA²)), K the complete elliptic integral. A damper of 1e-5 picks that motion up, and a force that is more than it
// takes by βA²/32, the third harmonic's share: so the motion is there, ahead by √(β/16) = 0.056 rad, for a detuning of
// 2c · 0.056, over dω/dA = ¾βA.
TEST(HarmonicBalance, HasTheBackboneOfDuffing) {
  constexpr double beta = 0.05, A = 1, c = 1e-5, stiffer = 1 + beta * A * A;
  const double w = pi * std::sqrt(stiffer) / (2 * std::comp_ellint_1(std::sqrt(beta * A * A / (2 * stiffer))));
  Oscillator system;
  system.w = w, system.beta = beta, system.c = c;
  system.force = [&](double t) { return -2 * c * w * A * std::sin(w * t); };
  PeriodicMotion near = at_rest(system);
  near.coefficients(0, 1) = A - beta / 32;
  near.coefficients(0, 2) = 0.056;
  near.coefficients(0, 5) = beta / 32;
  const Balance found = balance(system, near, {.accuracy = 1e-7});
  ASSERT_TRUE(found.found) << found.why;
  const double turn = std::atan2(found.motion.coefficients(0, 2), found.motion.coefficients(0, 1)) / w;
  EXPECT_NEAR(found.motion.at(turn).value[0], A, 2 * c * 0.06 / (0.75 * beta));
  EXPECT_NEAR(amplitude(found.motion, 3) / A, beta * A * A / 32, beta * beta / 32);  // to leading order
}

// At ω = 1 the force is all damping: F = q (8/3π) (Aω)², to the harmonics that |ẏ|ẏ makes: 1/5 at three times ω, an
// eighth of which answers, of a force that is qA² of the inertia's.
TEST(HarmonicBalance, LosesByQuadraticDampingWhatItsEquivalentLinearisationSays) {
  constexpr double q = 0.02, F = 0.02;
  Oscillator system;
  system.quadratic = q;
  system.force = [](double t) { return F * std::cos(t); };
  PeriodicMotion near = at_rest(system);
  near.coefficients(0, 2) = 1;
  const Balance found = balance(system, near, {.accuracy = 1e-6});
  ASSERT_TRUE(found.found) << found.why;
  EXPECT_NEAR(amplitude(found.motion), std::sqrt(3 * pi * F / (8 * q)), q * q);
}

TEST(HarmonicBalance, MathieuLeavesRestWhereHillsDeterminantsSay) {
  for (const double delta : {0.2, 0.25, 0.3, 0.95, 1.0}) {
    constexpr double c = 0.02;
    const double ours = support::first_zero([&](double epsilon) {
      Oscillator system;
      system.c = c, system.delta = delta, system.epsilon = epsilon;
      return std::abs(floquet_multipliers(system, at_rest(system))[0]) - 1;
    });
    EXPECT_NEAR(ours, support::hill_boundary(delta, c), 1e-6) << delta;  // asked; multipliers are right to 1e-11
  }
}

// Mathieu with a cubic spring doubles its period: the motion of two periods is there, and lasts.
TEST(HarmonicBalance, FindsTheMotionOfTwoPeriodsThatTakesOver) {
  Oscillator system;
  system.c = 0.02, system.delta = 0.25, system.epsilon = 0.1, system.beta = 0.2;
  const PeriodicMotion rest = at_rest(system);
  EXPECT_EQ(fate_of(floquet_multipliers(system, rest)), Fate::doubled);
  PeriodicMotion near = rest.over(2);
  near.coefficients(0, 1) = near.coefficients(0, 2) = 0.4;
  const Balance found = balance(system, near);
  ASSERT_TRUE(found.found) << found.why;
  // y = A cos(t/2 + φ): ¾βA² = √(ε²/4 − (2c · ½)²) + … to one harmonic, as the mean of (Q10) over both phases gives it.
  const double A = std::sqrt(std::sqrt(0.05 * 0.05 - 0.02 * 0.02) / (0.75 * 0.2));
  EXPECT_NEAR(amplitude(found.motion), A, 0.05 * A);  // harmonics at 3/2: ε/2 over 9/4 − 1/4
  EXPECT_EQ(fate_of(floquet_multipliers(system, found.motion)), Fate::stable);
}

}  // namespace
}  // namespace harmonic_balance_test
