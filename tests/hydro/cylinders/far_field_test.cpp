// Waves far away, and what they tell of power and mean drift: closed forms and laws. (P38), (P39).
#include "hydro/potential/far_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/hankel.hpp>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/cylinders/field.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/waves/dispersion.hpp"
#include "layouts.hpp"

namespace hydro::cylinders::far_field_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using potential::FieldQuestion, potential::MeanDrift, potential::mean_drift, potential::WaveField;
using std::numbers::pi;

/// A point far off: only what is farther still is looked at.
FieldQuestion asked(double omega, double heading, std::size_t bodies) {
  return {omega, heading, Eigen::VectorXcd::Zero(6 * static_cast<Index>(bodies)), Eigen::RowVector2d(500, 0)};
}

Complex hankel_slope(int m, double x) {
  return (boost::math::cyl_hankel_2(m - 1, x) - boost::math::cyl_hankel_2(m + 1, x)) / 2.0;
}

// MacCamy and Fuchs (1954) with H_m → √(2/(πkr)) i^m e^{−i(kr − π/4)}: A(θ) = −Σ ε_m J_m′/H_m′ cos m(θ − β).
TEST(FarField, OfACylinderOnTheBedIsMacCamyAndFuchs) {
  constexpr double omega = 1.1, a = 3, heading = 0.4;
  const CylinderBody pile{"pile", {0, 0, 0}, {}, {{{0, 0}, a, {}}}};
  const double ka = a * waves::wavenumber(omega, tank());
  const auto far = wave_field({pile}, tank(), asked(omega, heading, 1), {.tolerance = 1e-8}).far;
  EXPECT_EQ(far.angle.front(), heading);
  for (std::size_t t = 0; t < far.angle.size(); ++t) {
    Complex expected = 0;
    for (int m = 0; m <= 20; ++m)
      expected -= (m == 0 ? 1.0 : 2.0) * hankel_slope(m, ka).real() / hankel_slope(m, ka) *
                  std::cos(m * (far.angle[t] - heading));
    EXPECT_LT(std::abs(far.scattered[static_cast<Index>(t)] - expected), 1e-7);  // ten times the tolerance asked
  }
  const MeanDrift drift = mean_drift(far, omega, tank());
  EXPECT_NEAR(drift.taken / drift.scattered, 0, 1e-7);  // a body held still takes nothing
  EXPECT_NEAR(drift.force.y() / drift.force.x(), std::tan(heading), 1e-7);
}

// Short waves are turned back as light is: of the front half a strip dy with the slope α turns ρg ζ²/2 · (c_g/c = ½) ·
// (1 + cos 2α), in sum (2/3) ρg a ζ² (Havelock 1940).
TEST(FarField, OfShortWavesPushesACylinderAsHavelockHasIt) {
  constexpr double omega = 3.5, a = 10;
  const CylinderBody pile{"pile", {0, 0, 0}, {}, {{{0, 0}, a, {}}}};
  const double ka = a * waves::wavenumber(omega, tank());
  const MeanDrift drift = mean_drift(wave_field({pile}, tank(), asked(omega, 0, 1)).far, omega, tank());
  // Diffraction at the edge of the shadow leaves a part that falls as (ka)^{−2/3}, 0.19 here, times a number below one.
  EXPECT_NEAR(drift.force.x() / (2.0 / 3 * 1000 * 9.81 * a), 1, std::pow(ka, -2.0 / 3) / 2);
}

/// A buoy and a neighbour, free in heave and surge with a damper in heave: motions per metre of wave, and what the
/// dampers take.
struct Damped {
  FieldQuestion question;
  double taken = 0;
};
Damped damped(const std::vector<CylinderBody>& bodies, double omega, double heading, double damper) {
  const auto c = solve(bodies, tank(), {omega}, {heading}, {.tolerance = 1e-7, .threads = 1}).coefficients;
  Damped out{asked(omega, heading, bodies.size()), 0};
  std::vector<int> free;
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) free.insert(free.end(), {6 * b, 6 * b + 2});
  Eigen::MatrixXcd Z(free.size(), free.size());
  Eigen::VectorXcd X(free.size());
  for (Index i = 0; i < Z.rows(); ++i) {
    const int mode = free[static_cast<std::size_t>(i)], b = mode / 6;
    X[i] = c.X[0](mode, 0);
    for (Index j = 0; j < Z.cols(); ++j) {
      const int other = free[static_cast<std::size_t>(j)];
      const double mass = i == j ? 1000 * *c.body[static_cast<std::size_t>(b)].displaced_volume : 0;
      const double B = c.B[0](mode, other) + (i == j && mode % 6 == 2 ? damper : 0);
      Z(i, j) = -omega * omega * (mass + c.A[0](mode, other)) + Complex(0, omega) * B + (*c.C)(mode, other);
    }
  }
  const Eigen::VectorXcd xi = dense::ComplexLu(Z).solve(X);
  for (Index i = 0; i < xi.size(); ++i) {
    out.question.motion[free[static_cast<std::size_t>(i)]] = xi[i];
    if (free[static_cast<std::size_t>(i)] % 6 == 2) out.taken += 0.5 * damper * omega * omega * std::norm(xi[i]);
  }
  return out;
}

// What the waves lose is what the dampers take: phases of scattered and radiated waves, of arms and places, all of it.
TEST(FarField, TellsThePowerThatDampersTake) {
  const std::vector<CylinderBody> two{single(2, 3, 1, -2), single(1.5, 2, 9, 3)};
  for (const double damper : {0.0, 2e4}) {
    const Damped d = damped(two, 1.3, 0.7, damper);
    const MeanDrift drift = mean_drift(wave_field(two, tank(), d.question, {.tolerance = 1e-7}).far, 1.3, tank());
    EXPECT_NEAR(drift.taken, d.taken, 1e-5 * drift.scattered);  // coefficients of 1e-7, near a resonance of heave
    if (damper > 0) {
      EXPECT_GT(d.taken, 0.1 * drift.scattered);
    }
  }
}

// The place of the origin turns phases, and nothing else.
TEST(FarField, PushesAlikeWhereverTheOriginIs) {
  const auto drift_at = [](double x, double y) {
    const std::vector<CylinderBody> two{single(2, 3, x, y), single(1.5, 2, x + 8, y + 5)};
    const Damped d = damped(two, 1.3, 0.7, 1e4);
    return mean_drift(wave_field(two, tank(), d.question, {.tolerance = 1e-7}).far, 1.3, tank());
  };
  const MeanDrift here = drift_at(0, 0), there = drift_at(70, -40);
  EXPECT_LT((here.force - there.force).norm(), 1e-6 * here.force.norm());
  EXPECT_NEAR(there.scattered, here.scattered, 1e-6 * here.scattered);
}

TEST(FarField, RefusesAFrequencyThatIsNone) {
  EXPECT_THAT(
      [] {
        mean_drift({{0}, Eigen::VectorXcd::Ones(1), Eigen::VectorXcd::Ones(1)}, 0, tank());
      },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("frequency")));
}

}  // namespace
}  // namespace hydro::cylinders::far_field_test
