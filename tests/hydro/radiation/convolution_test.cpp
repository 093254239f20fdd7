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

}  // namespace
}  // namespace convolution_test
