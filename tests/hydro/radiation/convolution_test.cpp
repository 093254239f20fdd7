#include "hydro/radiation/convolution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hydro/base/random.hpp"
#include "support/two_pole_body.hpp"

namespace convolution_test {
namespace {

using namespace hydro::radiation;

const support::TwoPoleBody body{};

RetardationKernel kernel(double step, int modes = 1) {
  return RetardationKernel::from_damping(body.damping_table(40, 1000, modes), {step, 30});
}

/// The integral for v = sin ωt from rest, at time n·h, by our convolution.
double harmonic_force(double step, double omega, int steps) {
  const DirectConvolution convolution(kernel(step));
  auto history = convolution.make_history();
  for (int i = 0; i < steps; ++i) history.push(Eigen::VectorXd::Constant(1, std::sin(omega * step * i)));
  const double now = std::sin(omega * step * steps);
  return convolution.history_force(history, 1)[0] + convolution.instantaneous(1)(0, 0) * now;
}

// After the memory (30 s, e^{−9}) is full: ∫K(t−τ) sin ωτ dτ = B sin ωt + ω(A − A∞) cos ωt.
TEST(DirectConvolution, GivesDampingAndAddedMassOfAHarmonicMotion) {
  for (const double omega : {0.4, 1.1, 2.5}) {
    constexpr double h = 0.02;
    const int steps = 3000;
    const double t = h * steps;
    const double exact = body.B(omega) * std::sin(omega * t) + omega * body.A_minus_A_inf(omega) * std::cos(omega * t);
    // Cubic between frequencies 0.04 rad/s apart, cut into pieces of 0.01: B″ 0.01²/12 = 3e-4; the table ends at 40
    // rad/s and the memory at 30 s, e^{−9}; the trapezium rule adds (ωh)²/12 = 2e-4.
    EXPECT_NEAR(harmonic_force(h, omega, steps), exact, 1e-3);
  }
}

TEST(DirectConvolution, ConvergesWithTheSquareOfTheStep) {
  const double omega = 1.1, t = 12;
  const double reference = harmonic_force(0.0125, omega, static_cast<int>(t / 0.0125));
  const double coarse = std::abs(harmonic_force(0.1, omega, 120) - reference);
  const double fine = std::abs(harmonic_force(0.05, omega, 240) - reference);
  EXPECT_NEAR(coarse / fine, 4,
              0.5);  // 4.2 is exact for a pure second-order error measured against h/4 of the finer one
}

TEST(DirectConvolution, ReachesPartOfAStepContinuously) {
  const DirectConvolution convolution(kernel(0.1));
  auto history = convolution.make_history();
  for (int i = 0; i <= 100; ++i) history.push(Eigen::VectorXd::Constant(1, std::sin(0.9 * 0.1 * i)));
  const auto force = [&](double fraction) {
    return convolution.history_force(history, fraction)[0] +
           convolution.instantaneous(fraction)(0, 0) * std::sin(0.9 * 0.1 * (100 + fraction));
  };
  // Straight pieces of K against the trapezium rule: both are second order in the step, 0.1² · |K''|/8 per unit of
  // memory.
  EXPECT_NEAR(force(0.5), (force(1) + force(1e-9)) / 2, 2e-3);
}

TEST(DirectConvolution, AgreesWithASumWrittenOut) {
  const int modes = 3;
  const auto K = kernel(0.2, modes);
  const DirectConvolution convolution(K);
  auto history = convolution.make_history();
  const hydro::RandomStream random(1, 1);
  std::vector<Eigen::VectorXd> v;
  for (std::uint64_t i = 0; i < 400; ++i) {  // more than the kernel's 150 samples: the ring has turned
    v.push_back(Eigen::Vector3d(random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2)));
    history.push(v.back());
  }
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(modes);
  for (std::size_t j = 1; j < K.samples(); ++j) sum += 0.2 * K.at(j) * v[v.size() - j];
  EXPECT_LT((convolution.history_force(history, 1) - sum).norm(), 1e-12 * sum.norm());  // round-off of 150 products
}

// (R8): the discrete sum is passive: energy taken out of any motion that starts and ends at rest is not negative.
TEST(DirectConvolution, NeverGivesEnergyToARandomMotion) {
  const DirectConvolution convolution(kernel(0.2));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    auto history = convolution.make_history();
    const hydro::RandomStream random(seed, 0);
    double energy = 0, scale = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Eigen::VectorXd v = Eigen::VectorXd::Constant(1, random.normal(i));
      const double force = (convolution.history_force(history, 1) + convolution.instantaneous(1) * v)[0];
      energy += 0.2 * force * v[0];
      scale += 0.2 * v.squaredNorm() * convolution.instantaneous(1)(0, 0);
      EXPECT_GE(energy, -1e-3 * scale) << "seed " << seed;  // the kernel is cut at 30 s, e^{−9}
      history.push(v);
    }
  }
}

/// A flap of which damping is largest at 12.8 rad/s and 0.65 of that at the 20 rad/s at which its table ends; by itself
/// it swings at 2.3 rad/s.
struct Flap {
  static constexpr double inertia = 2e3, stiffness = 30e3, strength = 600e3, last = 20;  // kg m², N m/rad, N m
  support::TwoPoleBody water{.decay = 8, .frequency = 10};

  /// With a tail to so many times the last frequency, which falls as the true one.
  DampingTable table(double times) const {
    DampingTable out = water.damping_table(times * last, static_cast<int>(100 * times));
    for (auto& B : out.B) B *= strength;
    return out;
  }

  /// Angles at multiples of 0.1 s up to 6 s of a decay from 1, by the trapezium rule with steps of 0.1 s over `parts`.
  template <class Make>
  Eigen::VectorXd decay(int parts, Make kernel) const {
    const double h = 0.1 / parts;
    const DirectConvolution memory(kernel(MemoryGrid{h, 3}));
    auto past = memory.start(Eigen::VectorXd::Zero(1));
    const double D = memory.instantaneous(1)(0, 0);
    double x = 1, v = 0, a = -stiffness / inertia;
    Eigen::VectorXd out(60);
    for (int n = 1; n <= 60 * parts; ++n) {
      const double history = past->history_force(1)[0], x_free = x + h * v + h * h / 4 * a, v_free = v + h / 2 * a;
      a = (-history - D * v_free - stiffness * x_free) / (inertia + h / 2 * D + h * h / 4 * stiffness);
      x = x_free + h * h / 4 * a;
      v = v_free + h / 2 * a;
      past->accept(Eigen::VectorXd::Constant(1, v));
      if (n % parts == 0) out[n / parts - 1] = x;
    }
    return out;
  }
};

// What a tail adds acts at once and is the same at any step: the decay goes to its limit with the square of the step,
// wherever the tail ends. With samples of K, of which a step of 0.1 s lays what is about 63 rad/s upon motions at rest,
// the coarsest is off by as much as it swings.
TEST(DirectConvolution, LetsADecayConvergeAtItsOrderWhereverTheTailEnds) {
  const Flap flap;
  for (const double times : {4.0, 8.0, 16.0}) {
    const DampingTable table = flap.table(times);
    const MemorySurvey survey(table);
    const auto averaged = [&](const MemoryGrid& grid) { return RetardationKernel::averaged(table, grid, survey); };
    const auto sampled = [&](const MemoryGrid& grid) { return RetardationKernel::from_damping(table, grid, survey); };
    const Eigen::VectorXd limit = flap.decay(32, averaged);
    const auto off = [&](int parts) { return (flap.decay(parts, averaged) - limit).norm() / limit.norm(); };
    const double h = off(1), half = off(2), quarter = off(4);
    // 2.3 rad/s in steps of 0.1 s: (ωh)²/12 of 14 rad is 0.06 of phase.
    EXPECT_LT(h, 0.06) << times;
    // The table ends abruptly, and so does the memory at 3 s where K still rings with that end: 1e-4 of the decay.
    EXPECT_NEAR(h / half, 4, 0.5) << times;
    EXPECT_NEAR(half / quarter, 4, 0.6) << times;
    EXPECT_GT((flap.decay(1, sampled) - limit).norm() / limit.norm(), 5 * h) << times;
  }
}

}  // namespace
}  // namespace convolution_test
