#include "hydro/radiation/missing_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "support/two_pole_body.hpp"

namespace missing_load_test {
namespace {

using namespace hydro::radiation;

const support::TwoPoleBody body{};
constexpr double added = 0.7, h = 0.02;
constexpr Eigen::Index samples = 1500;

/// All of a body's water is missing, with added mass beyond its waves; on two modes, the second three times as much.
MissingImpedance missing() {
  MissingImpedance out{{0}, {Eigen::MatrixXcd::Zero(2, 2)}};
  for (double omega = 0.05; omega < 30; omega += 0.05) {
    const std::complex<double> Z(body.B(omega), omega * (added + body.A_minus_A_inf(omega)));
    out.omega.push_back(omega);
    out.Z.emplace_back(Eigen::Vector2cd(Z, 3.0 * Z).asDiagonal());
  }
  return out;
}

/// The same load, the memory carried on by its poles and the added mass by the derivative known.
template <class Velocity, class Acceleration>
void expect_load_of(Velocity v, Acceleration a) {
  const PoleMemory memory(body.model(), h);
  const auto past = memory.start(Eigen::VectorXd::Constant(1, v(0)));
  Eigen::MatrixXd velocity(2, samples);
  for (Eigen::Index i = 0; i < samples; ++i) velocity.col(i).setConstant(v(h * static_cast<double>(i)));
  const Eigen::MatrixXd load = missing_load(missing(), velocity, h);
  double worst = 0, size = 0;
  for (Eigen::Index i = 1; i < samples; ++i) {
    const double t = h * static_cast<double>(i);
    const double exact = -past->history_force(1)[0] - memory.instantaneous(1)(0, 0) * v(t) - added * a(t);
    past->accept(Eigen::VectorXd::Constant(1, v(t)));
    // The table's end at 30 rad/s rings for two of its periods where a motion begins at speed.
    if (t > 0.5) worst = std::max({worst, std::abs(load(0, i) - exact), std::abs(load(1, i) / 3 - exact)});
    size = std::max(size, std::abs(exact));
  }
  // (ωh)²/6 of the derivative by differences is 5e-5; cubics between 0.05 rad/s, and B ~ ω⁻² beyond 30 rad/s, which is
  // (1/30)² of what it was: 1e-3.
  EXPECT_LT(worst, 2e-3 * size);
}

TEST(MissingLoad, IsThatOfAMemoryKnownExactly) {
  expect_load_of([](double t) { return std::sin(0.9 * t); }, [](double t) { return 0.9 * std::cos(0.9 * t); });
}

TEST(MissingLoad, GivesNoBlowWhereAMotionBeginsAtSpeed) {
  expect_load_of([](double t) { return std::cos(0.9 * t); }, [](double t) { return -0.9 * std::sin(0.9 * t); });
}

// The last samples of a record must not push on the first ones.
TEST(MissingLoad, IsNothingBeforeTheMotion) {
  Eigen::MatrixXd late = Eigen::MatrixXd::Zero(2, samples);
  for (Eigen::Index i = samples / 2; i < samples; ++i)
    late.col(i).setConstant(std::sin(0.9 * h * static_cast<double>(i - samples / 2)));
  const Eigen::MatrixXd load = missing_load(missing(), late, h);
  EXPECT_LT(load.leftCols(samples / 2 - 50).cwiseAbs().maxCoeff(), 1e-3 * load.cwiseAbs().maxCoeff());
}

TEST(MissingLoad, RefusesVelocitiesOfOtherModes) {
  EXPECT_THROW(missing_load(missing(), Eigen::MatrixXd::Zero(3, 10), h), hydro::InputError);
}

}  // namespace
}  // namespace missing_load_test
