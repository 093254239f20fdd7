// A decay with radiation memory, against the closed form by eigenvalues and the convolution itself.
#include "fit/decay_memory.hpp"

#include <Eigen/Dense>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace decay_memory_test {
namespace {

using fit::MotionLaw;

/// ω₀, b₁, κ, α, ω_p.
struct Water {
  double omega0 = 1.6, linear = 0, strength = 0.9, decay = 0.8, frequency = 2.0;
  std::vector<double> theta() const { return {omega0, linear, 0, 0, 0, strength, decay, frequency}; }
  /// k̂(iω) = iωκ/(ω_p² − ω² + 2iαω).
  std::complex<double> transform(double w) const {
    return std::complex<double>(0, w * strength) / std::complex<double>(frequency * frequency - w * w, 2 * decay * w);
  }
};

/// e^{At}y₀ by the eigenvectors of the four linear equations; x alone.
std::vector<double> closed_form(const Water& w, const Eigen::Vector4d& start, double step, int n) {
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a(0, 1) = a(2, 3) = a(3, 1) = 1;
  a(1, 0) = -w.omega0 * w.omega0, a(1, 1) = -w.linear, a(1, 3) = -w.strength;
  a(3, 2) = -w.frequency * w.frequency, a(3, 3) = -2 * w.decay;
  const Eigen::EigenSolver<Eigen::Matrix4d> s(a);
  const Eigen::Vector4cd parts = s.eigenvectors().partialPivLu().solve(start.cast<std::complex<double>>());
  std::vector<double> out;
  for (int j = 0; j < n; ++j)
    out.push_back(
        ((s.eigenvalues() * (step * j)).array().exp() * parts.array() * s.eigenvectors().row(0).transpose().array())
            .sum()
            .real());
  return out;
}

fit::Window record(const Water& w, double step, int n, double noise = 0, std::uint64_t stream = 1,
                   const Eigen::Vector4d& start = {0.2, 0, 0, 0}) {
  const auto x = closed_form(w, start, step, n);
  const auto e = froude_test::ar1_noise(static_cast<std::size_t>(n), 0.5, 1, stream);
  fit::Window out{step, Eigen::MatrixXd(n, 1)};
  for (int j = 0; j < n; ++j)
    out.values(j, 0) = x[static_cast<std::size_t>(j)] + noise * e[static_cast<std::size_t>(j)];
  return out;
}

TEST(MotionWithRadiationMemory, IsTheClosedForm) {
  const Water w{.linear = 0.05};
  const auto truth = closed_form(w, {0.2, -0.1, 0.02, 0.03}, 0.1, 300);
  const auto x =
      fit::follow(MotionLaw::with_radiation_memory, w.theta(), Eigen::Vector4d(0.2, -0.1, 0.02, 0.03), 0.1, 300, 8);
  // Fourth order: (ωh)⁴/120 of the phase at h = 0.0125 and ω = 2 after 60 rad.
  for (int j = 0; j < 300; ++j) ASSERT_NEAR(x(j, 0), truth[static_cast<std::size_t>(j)], 0.2 * 4e-7) << j;
}

TEST(MotionWithRadiationMemory, IsThatOfTheConvolution) {
  // Leapfrog with the trapezoidal rule for ∫k(t − τ)ẋ dτ, k = κe^{−αt}(cos βt − α/β sin βt), β² = ω_p² − α².
  const Water w;
  const double h = 0.005, beta = std::sqrt(w.frequency * w.frequency - w.decay * w.decay);
  const int n = 2000;
  std::vector<double> k, v{0}, x{0.2};
  for (int j = 0; j <= n; ++j) {
    const double t = h * j;
    k.push_back(w.strength * std::exp(-w.decay * t) * (std::cos(beta * t) - w.decay / beta * std::sin(beta * t)));
  }
  const auto history_force = [&](std::size_t now) {
    double sum = 0;
    for (std::size_t i = 0; i <= now; ++i) sum += k[now - i] * v[i] * (i == 0 || i == now ? 0.5 : 1);
    return h * sum;
  };
  for (std::size_t j = 0; j + 1 < static_cast<std::size_t>(n); ++j) {  // Heun
    const double a = -w.omega0 * w.omega0 * x[j] - history_force(j);
    x.push_back(x[j] + h * v[j] + h * h / 2 * a);
    v.push_back(v[j] + h * a);
    const double b = -w.omega0 * w.omega0 * x[j + 1] - history_force(j + 1);
    v[j + 1] = v[j] + h / 2 * (a + b);
  }
  const auto followed =
      fit::follow(MotionLaw::with_radiation_memory, w.theta(), Eigen::Vector4d(0.2, 0, 0, 0), h, n, 1);
  // Second order: (ωh)²/12 of the phase of 16 rad at ω = 2.
  for (std::size_t j = 0; j < x.size(); j += 10)
    ASSERT_NEAR(followed(static_cast<Eigen::Index>(j), 0), x[j], 0.2 * 16 * 1e-4 / 12) << j;
}

TEST(DecayMemory, IsRecoveredFromAMotionWithoutNoise) {
  const Water w;
  const fit::DecayMemoryOptions options{.starts_empty = true, .substeps = 8};
  const auto f = fit::fit_decay_memory(std::vector{record(w, 0.1, 300)}, options);
  EXPECT_NEAR(f.motion.ended[0], w.omega0, 1e-6);
  for (const auto& [c, truth] :
       {std::pair{f.memory[0], w.strength}, {f.memory[1], w.decay}, {f.memory[2], w.frequency}})
    EXPECT_NEAR(c.value.value_or(0), truth, 2e-6) << c.name << c.why_not;
  // A and B at any frequency are those of k̂.
  for (const double omega : {0.4, 1.5, 4.0}) {
    const auto r = fit::radiation_of(f, {.mass = 100, .stiffness = 600}, omega);
    const double swings = 600 / (w.omega0 * w.omega0);
    EXPECT_NEAR(r.added_mass.value.value_or(0), swings * (1 + w.transform(omega).imag() / omega) - 100, 1e-3);
    EXPECT_NEAR(r.damping.value.value_or(0), swings * w.transform(omega).real(), 1e-3);
  }
}

TEST(DecayMemory, OfRecordsThatBeginInMotionIsRecoveredToo) {
  const Water w;
  const std::vector<fit::Window> records{record(w, 0.1, 250, 0, 1, {0.2, 0.1, 0.05, -0.03}),
                                         record(w, 0.1, 200, 0, 1, {-0.1, 0.2, 0.0, 0.06})};
  const auto f = fit::fit_decay_memory(records, {.substeps = 8});
  EXPECT_NEAR(f.memory[0].value.value_or(0), w.strength, 1e-5) << f.memory[0].why_not;
  EXPECT_NEAR(f.memory[1].value.value_or(0), w.decay, 1e-5);
  EXPECT_NEAR(f.memory[2].value.value_or(0), w.frequency, 1e-5);
}

TEST(DecayMemory, BesideALinearDampingIsNotSeenWhereTheStartIsNotKnown) {
  // A linear motion in free decay tells four coefficients of its characteristic polynomial, and five are asked for.
  const Water w{.linear = 0.1};
  const std::vector<fit::Window> records{record(w, 0.1, 300, 0, 1, {0.2, 0.1, 0.05, -0.03})};
  const auto f = fit::fit_decay_memory(records, {.terms = {.linear = true}, .substeps = 8});
  for (const auto& c : f.memory) EXPECT_FALSE(c.value) << c.name;
  EXPECT_THAT(f.motion.search.identifiability,
              testing::AllOf(testing::HasSubstr("do not see"), testing::HasSubstr("memory_strength")));
  EXPECT_FALSE(fit::radiation_of(f, {.mass = 0, .stiffness = 1}, 1).damping.value);
  // Let go from rest in calm water, the shares of both swings in the start tell the fifth.
  const auto known = fit::fit_decay_memory(std::vector{record(w, 0.1, 300)},
                                           {.terms = {.linear = true}, .starts_empty = true, .substeps = 8});
  EXPECT_NEAR(known.motion.ended[1], 0.1, 1e-4);
  EXPECT_NEAR(known.memory[0].value.value_or(0), w.strength, 1e-3);
}

TEST(DecayMemory, IsNotToldOfADecayWithoutOne) {
  int told = 0;
  for (std::uint64_t k = 0; k < 3; ++k) {
    fit::Window w{0.1, fit::follow(MotionLaw::oscillator, std::vector<double>{1.6, 0.12, 0, 0, 0, 0},
                                   Eigen::Vector2d(0.2, 0), 0.1, 400, 4)};
    const auto e = froude_test::ar1_noise(400, 0.5, 1, 90 + k);
    for (Eigen::Index j = 0; j < 400; ++j) w.values(j, 0) += 0.002 * e[static_cast<std::size_t>(j)];
    const auto f = fit::fit_decay_memory(std::vector{w}, {.starts_empty = true, .substeps = 2});
    told += f.memory[0].value.has_value();
    for (const auto& c : f.memory) EXPECT_EQ(c.value.has_value(), c.why_not.empty());
  }
  EXPECT_LE(told, 1);  // AICc takes a needless term in about one case of six, and intervals must hold zero beside
}

TEST(DecayMemory, IsNotToldOfAQuadraticDamping) {
  // Large swings lose more than small ones, which one damping cannot follow and a pair of poles can, for a while.
  fit::Window w{0.1, fit::follow(MotionLaw::oscillator, std::vector<double>{1.6, 0.05, 1.0, 0, 0, 0},
                                 Eigen::Vector2d(0.2, 0), 0.1, 400, 4)};
  const auto e = froude_test::ar1_noise(400, 0.5, 1, 21);
  for (Eigen::Index j = 0; j < 400; ++j) w.values(j, 0) += 0.0005 * e[static_cast<std::size_t>(j)];
  for (const bool empty : {true, false}) {
    const auto f = fit::fit_decay_memory(std::vector{w}, {.starts_empty = empty, .substeps = 2});
    EXPECT_LT(f.gain, 2);
    EXPECT_FALSE(f.memory[0].value);
    EXPECT_THAT(f.memory[0].why_not, testing::AnyOf(testing::HasSubstr("quadratic"), testing::HasSubstr("zero")));
  }
}

TEST(DecayMemory, CoversAddedMassAndDamping) {
  const Water w;
  const double swings = 600 / (w.omega0 * w.omega0);
  int told = 0, mass = 0, damping = 0, far = 0;
  constexpr int sets = 20;
  for (std::uint64_t k = 0; k < sets; ++k) {
    const auto f =
        fit::fit_decay_memory(std::vector{record(w, 0.1, 300, 0.001, 300 + k)}, {.starts_empty = true, .substeps = 2});
    if (!f.memory[0].value) continue;
    ++told;
    const auto holds = [](const fit::Coefficient& c, double truth) {
      return c.interval.low < truth && truth < c.interval.high;
    };
    const auto at = fit::radiation_of(f, {.mass = 100, .stiffness = 600}, f.omega);
    mass += holds(at.added_mass, swings * (1 + w.transform(f.omega).imag() / f.omega) - 100);
    damping += holds(at.damping, swings * w.transform(f.omega).real());
    far += holds(fit::radiation_of(f, {.mass = 100, .stiffness = 600}, 3).damping, swings * w.transform(3).real());
  }
  EXPECT_GE(told, sets - 2);
  for (const int count : {mass, damping, far}) EXPECT_GE(count, told - 5);  // 1 ± 1 of 20 outside; four deviations
}

TEST(DecayMemory, TellsWhatIsTheSameInAllSamples) {
  const Water w;
  const auto f = fit::fit_decay_memory(std::vector{record(w, 0.1, 300, 0.0005)}, {.starts_empty = true, .substeps = 2});
  const auto exact = fit::radiation_of(f, {.mass = 100, .stiffness = 600}, 1.5),
             known = fit::radiation_of(f, {.mass = 100, .stiffness = 600, .mass_error = 0.01, .stiffness_error = 0.02},
                                       1.5);
  const double whole = *exact.added_mass.value + 100;
  EXPECT_NEAR(known.added_mass.systematic_error, std::hypot(0.02 * whole, 0.01 * 100), 1e-9 * whole);
  EXPECT_NEAR(known.damping.systematic_error, 0.02 * *exact.damping.value, 1e-9 * whole);
  EXPECT_GT(f.gain, 2);
  EXPECT_THAT(f.weakest, testing::HasSubstr("memory"));
  EXPECT_EQ(f.singular_values.size(), 4);
}

TEST(DecayMemory, RefusesWhatItDoesNotKnow) {
  const std::vector<fit::Window> records{record({}, 0.1, 300)};
  EXPECT_THROW(fit::fit_decay_memory(records, {.terms = {.linear = false, .coulomb = true}}), hydro::InputError);
  const auto f = fit::fit_decay_memory(records, {.starts_empty = true, .substeps = 2});
  EXPECT_THROW(fit::radiation_of(f, {.mass = 1, .stiffness = 0}, 1), hydro::InputError);
  EXPECT_THROW(fit::radiation_of(f, {.mass = 1, .stiffness = 1}, 0), hydro::InputError);
}

}  // namespace
}  // namespace decay_memory_test
