#include "hydro/radiation/kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "hydro/base/error.hpp"
#include "hydro/radiation/tail.hpp"
#include "support/two_pole_body.hpp"

namespace kernel_test {
namespace {

using namespace hydro::radiation;
using support::TwoPoleBody;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const TwoPoleBody body{};

TEST(RetardationKernel, RecoversATwoPoleBodyFromItsDamping) {
  const auto kernel = RetardationKernel::from_damping(body.damping_table(80, 2000), {.step = 0.05, .length = 20});
  for (const std::size_t i : {0u, 1u, 10u, 20u, 100u, 400u})
    EXPECT_NEAR(kernel.at(i)(0, 0), body.K(0.05 * static_cast<double>(i)), kernel.error_bound()(0, 0))
        << "sample " << i;
  // Beyond 80 rad/s lie 2/π · 2a/80 = 0.0048 of K(0) = 1; a bound much above that would say nothing.
  EXPECT_LT(kernel.error_bound()(0, 0), 0.007);
}

TEST(RetardationKernel, KeepsItsBoundWhenTheTableIsCoarseAndShort) {
  for (const double end : {4.0, 8.0, 20.0})
    for (const int count : {20, 40, 200}) {
      if (end / count > 2 * body.decay)
        continue;  // wider apart than the peak of B: no estimate can see what is not sampled
      const auto table = body.damping_table(end, count);
      const auto kernel = RetardationKernel::from_damping(
          table, {.step = 0.1, .length = std::min(4.0, RetardationKernel::longest_time(table))});
      for (std::size_t i = 0; i < kernel.samples(); ++i)
        EXPECT_NEAR(kernel.at(i)(0, 0), body.K(0.1 * static_cast<double>(i)), kernel.error_bound()(0, 0))
            << end << " rad/s, " << count << " values, sample " << i;
    }
}

TEST(RetardationKernel, TakesUnevenFrequencies) {
  DampingTable table;
  for (double omega = 0.02; omega < 80; omega *= 1.01) {
    table.omega.push_back(omega);
    table.B.push_back(Eigen::MatrixXd::Constant(1, 1, body.B(omega)));
  }
  EXPECT_NEAR(retardation(table, 1.0)(0, 0), body.K(1.0), 0.006);  // the tail as above
  EXPECT_NEAR(retardation(table, 3.0)(0, 0), body.K(3.0), 0.006);
}

/// Samples of a kernel, all of them, against the integral piece by piece.
void expect_the_same(const DampingTable& table, const MemoryGrid& grid) {
  const auto kernel = RetardationKernel::from_damping(table, grid);
  const double size = kernel.at(0).cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < kernel.samples(); ++i) {
    const Eigen::MatrixXd by_pieces = retardation(table, grid.step * static_cast<double>(i));
    // Rounding of N terms of the size of a slope's jump over t², t > 4/ω_N: 1e-12 is seen.
    ASSERT_LT((kernel.at(i) - by_pieces).cwiseAbs().maxCoeff(), 1e-11 * size) << "sample " << i;
  }
}

TEST(RetardationKernel, IsTheSameByItsCorners) {  // (R23)
  expect_the_same(body.damping_table(8, 80), {.step = 0.1, .length = 30});
  DampingTable uneven;  // two modes, unlike in size, on frequencies that spread
  for (double omega = 0.1; omega < 9; omega *= 1.06) {
    uneven.omega.push_back(omega);
    const double b = body.B(omega);
    uneven.B.push_back((Eigen::Matrix2d() << 1e6 * b, 300 * b, 300 * b, b * b).finished());
  }
  expect_the_same(uneven, {.step = 0.05, .length = 6});
}

TEST(RetardationKernel, IsTheSameWithATail) {  // (R23), (R11)
  const auto damping = body.damping_table(8, 160);
  const auto whole = extrapolated(damping, body.added_mass(damping, 5), std::nullopt);
  ASSERT_GT(whole.table.omega.size(), 3 * damping.omega.size());
  expect_the_same(whole.table, {.step = 0.05, .length = 40});
}

/// The mean of the exact kernel over a step to either side, weighted with a triangle, by Simpson's rule on either.
double averaged_exactly(double t, double h) {
  constexpr int pieces = 2000;
  double sum = 0;
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i <= pieces; ++i) {
      const double s = static_cast<double>(i) / pieces, weight = i == 0 || i == pieces ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight / (3.0 * pieces) * body.K(std::abs(t + side * s * h)) * (1 - s);
    }
  return sum;
}

TEST(RetardationKernel, IsAveragedOverSteps) {  // (R24)
  const auto damping = body.damping_table(80, 2000);
  const MemorySurvey survey(damping);
  for (const double h : {0.05, 0.5, 3.0}) {
    const auto kernel = RetardationKernel::averaged(damping, {.step = h, .length = 30}, survey);
    for (std::size_t i = 0; i < kernel.samples(); ++i)
      // B sinc² straight between its places is off by 1.3e-5; beyond 80 rad/s (2/π) 2a · 2/h² / (3 · 80³) of it are
      // left, 2e-4 at h = 0.05.
      EXPECT_NEAR(kernel.at(i)(0, 0), averaged_exactly(h * static_cast<double>(i), h), 2.3e-4)
          << "step " << h << ", sample " << i;
  }
}

TEST(MemorySurvey, HasTheTransformOfTheBody) {
  const auto damping = body.damping_table(40, 1000);
  const MemorySurvey survey(damping);
  for (const double omega : {0.1, 1.1, 5.0, 30.0}) {
    const std::complex<double> ours = survey.transforms({omega}, 60).front()(0, 0);
    // What lies beyond 40 rad/s, (2/π) ∫ B/ν² dν = (2/π) 2a/(3 · 40³) = 2e-6 of mass, times ω; e^{−18} is cut off; B at
    // 40 rad/s, 4e-4, ends in a step, which rings at its neighbours.
    EXPECT_NEAR(ours.real(), body.B(omega), 1e-3) << omega;
    EXPECT_NEAR(ours.imag(), omega * body.A_minus_A_inf(omega), 1e-3) << omega;
  }
}

TEST(RetardationKernel, RefusesAHullThatGivesPowerToItsOwnMotion) {
  auto damping = body.damping_table(80, 2000);
  damping.B[29](0, 0) = -1.0;  // 1.2 rad/s
  EXPECT_THAT(
      [&] {
        RetardationKernel::from_damping(damping, {0.05, 20});
      },
      ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("mode 0"), HasSubstr("1.2 rad/s"))));
}

TEST(RetardationKernel, RefusesMoreMemoryThanTheFrequenciesTell) {
  EXPECT_THAT(
      [&] {
        RetardationKernel::from_damping(body.damping_table(8, 80), {0.05, 40});
      },
      ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("31.42 s only"), HasSubstr("more frequencies"))));
}

TEST(RetardationKernel, RefusesFrequenciesThatDoNotIncrease) {
  auto damping = body.damping_table(8, 80);
  std::swap(damping.omega[3], damping.omega[4]);
  EXPECT_THAT(
      [&] {
        RetardationKernel::from_damping(damping, {0.05, 4});
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("do not increase")));
}

TEST(MemoryLength, CutsWhereTheRestIsWithinTheTolerance) {
  const auto table = body.damping_table(20, 500);
  double shorter = 0;
  for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
    const double length = MemorySurvey(table).length(tolerance);
    EXPECT_GT(length, shorter);
    shorter = length;
    EXPECT_LE(RetardationKernel::from_damping(table, {0.05, length + 0.05}).truncation(), tolerance);
    // |K| <= (w/b) e^{−at}, so the rest is below (w/ab) e^{−aL} relative to max B = 1/2a: a length that far overshoots
    // costs for nothing.
    const double enough =
        std::log(2 * body.decay * std::sqrt(body.w2()) / (body.decay * body.frequency) / tolerance) / body.decay;
    EXPECT_LT(length, enough + 3);  // 3 s: half a swing of K, in which its integral grows in steps
  }
}

TEST(InfiniteAddedMass, FollowsFromAddedMassAndDampingByOgilvie) {
  const auto table = body.damping_table(20, 500);
  constexpr double A_inf = 7.0;
  std::vector<Eigen::MatrixXd> A;
  for (const double omega : table.omega)
    A.push_back(Eigen::MatrixXd::Constant(1, 1, A_inf + body.A_minus_A_inf(omega)));
  const auto found = infinite_added_mass(table, A);
  EXPECT_NEAR(found.value(0, 0), A_inf, 3 * found.spread(0, 0) + 1e-3);
  EXPECT_LT(found.spread(0, 0), 1e-2);
  for (auto& a : A) a(0, 0) -= 2 * (a(0, 0) - A_inf);  // the sign of A − A∞ is wrong: the estimates cannot agree
  EXPECT_GT(infinite_added_mass(table, A).spread(0, 0), 10 * found.spread(0, 0));
}

}  // namespace
}  // namespace kernel_test
