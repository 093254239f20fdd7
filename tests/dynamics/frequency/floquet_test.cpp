#include "dynamics/frequency/floquet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/hill_determinant.hpp"

namespace floquet_test {
namespace {

using namespace dynamics::frequency;
using testing::HasSubstr, testing::ThrowsMessage;
constexpr double two_pi = 2 * std::numbers::pi;

using support::Mathieu;

PeriodicMatrix matrix_of(const Mathieu& m) {
  return [m](double t) { return Eigen::Matrix2d{{0, 1}, {-(m.delta + m.epsilon * std::cos(t)), -2 * m.c}}; };
}

TEST(Floquet, MultipliersOfASteadySystemAreThoseOfItsModes) {
  // s = −c ± i √(δ − c²)
  const auto mu = floquet_multipliers(matrix_of(Mathieu{2, 0, 0.1}), two_pi);
  const std::complex<double> s(-0.1, std::sqrt(2 - 0.01)), expected = std::exp(s * two_pi);
  EXPECT_NEAR(std::abs(mu(0)), std::exp(-0.1 * two_pi), 1e-11);
  EXPECT_NEAR(mu(0).real(), expected.real(), 1e-11);
  EXPECT_NEAR(std::abs(mu(0).imag()), std::abs(expected.imag()), 1e-11);
}

TEST(Floquet, DeterminantIsThatOfLiouville) {
  const PeriodicMatrix a = [](double t) {
    Eigen::Matrix3d m;
    m << -0.2 + std::sin(t), 1, 0.3, -2 - std::cos(2 * t), 0.1 * std::cos(t), 0.5, 0.2, std::sin(3 * t), -0.4;
    return Eigen::MatrixXd(m);
  };
  // The trace is −0.6 on average.
  const auto mu = floquet_multipliers(a, two_pi);
  const std::complex<double> product = mu.prod();
  EXPECT_NEAR(product.real(), std::exp(-0.6 * two_pi), 1e-11);
  EXPECT_NEAR(product.imag(), 0, 1e-11);
  EXPECT_GE(std::abs(mu(0)), std::abs(mu(1)));
}

TEST(Floquet, MultipliersWithoutDampingComeInReciprocalPairs) {
  const auto mu = floquet_multipliers(matrix_of(Mathieu{0.25, 0.3, 0}), two_pi);
  EXPECT_GT(std::abs(mu(0)), 1.1);
  EXPECT_NEAR(std::abs(mu(0) * mu(1) - 1.0), 0, 1e-11);
  EXPECT_LT(mu(0).real(), 0);  // its period doubles
}

TEST(Floquet, BoundariesOfDampedMathieuAreThoseOfHillsDeterminants) {
  for (const double c : {0.02, 0.1})
    for (const double delta : {0.1, 0.25, 0.5, 0.9, 1.0, 1.3}) {
      const double ours = support::first_zero([&](double epsilon) {
        return std::abs(floquet_multipliers(matrix_of({delta, epsilon, c}), two_pi)(0)) - 1;
      });
      const double hills = support::hill_boundary(delta, c);
      ASSERT_LT(hills, 4) << delta << " " << c;
      EXPECT_NEAR(ours, hills, 1e-6)
          << delta << " " << c;  // roots are found to 1e-12, multipliers to 1e-11 over slopes of 0.1 and more
    }
}

TEST(Floquet, NamesWhatIsWrong) {
  EXPECT_THAT(
      [] {
        monodromy(matrix_of(Mathieu{1, 0, 0}), 0);
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("period must be positive, got 0 s")));
  EXPECT_THAT([] { monodromy([](double) { return Eigen::MatrixXd::Zero(2, 3); }, 1); },
              ThrowsMessage<hydro::InputError>(HasSubstr("square and finite, got 2 x 3")));
}

// An oscillator whose stiffness, coupling and velocity vary, with three states of a memory of which one is slow, one
// turns and one is fast: the same matrix as that of the whole system, which has no structure.
PeriodicWithMemory with_memory(double fast) {
  PeriodicWithMemory out;
  out.A = Eigen::MatrixXd{{-0.3, 0.8, 0}, {-0.8, -0.3, 0}, {0, 0, -fast}};
  out.B = Eigen::MatrixXd{{1, 0.2}, {0, 0.7}, {2, -1}};
  out.at = [](double t) {
    return PeriodicWithMemory::Varying{Eigen::MatrixXd{{0, 1}, {-1 - 0.4 * std::cos(t), -0.1 - 0.05 * std::sin(2 * t)}},
                                       Eigen::MatrixXd{{0, 0, 0}, {-0.3, 0.1 * std::cos(t), -0.2}},
                                       Eigen::MatrixXd{{0.1 * std::sin(t), 1 + 0.3 * std::cos(2 * t)}, {0, 1}}};
  };
  return out;
}
PeriodicMatrix whole(const PeriodicWithMemory& system) {
  return [system](double t) {
    const auto now = system.at(t);
    Eigen::MatrixXd out(5, 5);
    out << now.P, now.Q, system.B * now.V, system.A;
    return out;
  };
}

TEST(Floquet, MemoryThatIsEliminatedLeavesTheMonodromyOfTheWhole) {
  for (const double fast : {2.0, 300.0}) {  // beyond what collocation resolves, steps are still halved until it is told
    const PeriodicWithMemory system = with_memory(fast);
    const Eigen::MatrixXd expected = monodromy(whole(system), two_pi), found = monodromy(system, two_pi, 1e-10);
    EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm()) << fast;  // what was asked
  }
}

// States that act on each other far apart are one block, whichever lie between.
TEST(Floquet, MemoryOfOneBlockIsEliminatedWhole) {
  PeriodicWithMemory system = with_memory(2);
  system.A(0, 2) = 0.4;
  const Eigen::MatrixXd expected = monodromy(whole(system), two_pi), found = monodromy(system, two_pi, 1e-10);
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());  // what was asked
}

TEST(Floquet, WithoutAMemoryCollocationIsTheExplicitPair) {
  PeriodicWithMemory system = with_memory(1);
  system.A = Eigen::MatrixXd(0, 0), system.B = Eigen::MatrixXd(0, 0);
  const auto varying = system.at;
  system.at = [&](double t) {
    return PeriodicWithMemory::Varying{varying(t).P, Eigen::MatrixXd(2, 0), Eigen::MatrixXd(0, 2)};
  };
  const Eigen::MatrixXd expected = monodromy([&](double t) { return varying(t).P; }, two_pi);
  EXPECT_LT((monodromy(system, two_pi, 1e-10) - expected).norm(), 1e-10 * expected.norm());
}

TEST(Floquet, OfAMemoryRefusesPeriodsAndTellsWhereStepsAreTooFew) {
  const PeriodicWithMemory system = with_memory(1);
  EXPECT_THAT([&] { monodromy(system, 0, 1e-10); },
              ThrowsMessage<hydro::InputError>(HasSubstr("a period must be positive, got 0 s")));
  // No doubles tell a change of 1e-17.
  EXPECT_THAT([&] { monodromy(system, two_pi, 0); },
              ThrowsMessage<hydro::NumericsError>(HasSubstr("16384 steps of a period of 6.28319 s do not tell")));
}

}  // namespace
}  // namespace floquet_test
