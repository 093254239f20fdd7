#include "hydro/waves/kinematics/kinematics.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hydro/waves/dispersion.hpp"

namespace hydro::waves::kinematics_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Complex = std::complex<double>;
constexpr Complex i(0, 1);

Water water_of_depth(double h) { return {.density = 1025, .gravity = 9.81, .depth = WaterDepth::from_metres(h)}; }

Component wave_in(const Water& water, double omega, double heading) {
  return {
      .omega = omega, .k = wavenumber(omega, water), .sigma = omega, .amplitude = 1, .phase = 0, .heading = heading};
}

// ∂V/∂axis by a five-point difference with step 1e-3/k: error of order 1e-12 k |V| plus rounding 1e-13 k |V|.
Eigen::Vector3cd slope(const Component& w, const Water& water, const Eigen::Vector3d& p, int axis) {
  const double d = 1e-3 / w.k;
  const auto at = [&](double s) { return velocity_transfer(w, water, p + s * Eigen::Vector3d::Unit(axis)); };
  return (8 * (at(d) - at(-d)) - (at(2 * d) - at(-2 * d))) / (12 * d);
}

struct Case {
  double depth, omega;
};
const std::vector<Case> cases{{0.5, 0.3}, {10, 0.9}, {10, 3.0}, {300, 0.8}};

TEST(WaveKinematics, ConserveVolumeAndDoNotSpin) {
  for (const auto& [h, omega] : cases) {
    const Water water = water_of_depth(h);
    const Component w = wave_in(water, omega, 0.7);
    const Eigen::Vector3d p(1.3, -2.1, -0.4 * std::min(h, 1 / w.k));
    const Eigen::Vector3cd dx = slope(w, water, p, 0), dy = slope(w, water, p, 1), dz = slope(w, water, p, 2);
    const double tolerance = 1e-10 * w.k * velocity_transfer(w, water, p).norm();
    EXPECT_LT(std::abs(dx.x() + dy.y() + dz.z()), tolerance) << h;
    EXPECT_LT(std::abs(dy.z() - dz.y()), tolerance) << h;
    EXPECT_LT(std::abs(dz.x() - dx.z()), tolerance) << h;
    EXPECT_LT(std::abs(dx.y() - dy.x()), tolerance) << h;
  }
}

TEST(WaveKinematics, SurfaceMovesWithTheWater) {
  // (W11): w = ∂ζ/∂t at z = 0, that is iω times the elevation.
  for (const auto& [h, omega] : cases) {
    const Water water = water_of_depth(h);
    const Component w = wave_in(water, omega, -0.3);
    const Complex vertical = velocity_transfer(w, water, {4, 5, 0}).z();
    EXPECT_LT(std::abs(vertical - i * omega * elevation_transfer(w, 4, 5)), 1e-15 * omega) << h;
  }
}

TEST(WaveKinematics, PressureAtTheSurfaceIsConstant) {
  // Linear Bernoulli with φ = i V_along/k (u = ∇φ): iωφ + gζ = 0 at z = 0, which is the dispersion relation over again.
  for (const auto& [h, omega] : cases) {
    const Water water = water_of_depth(h);
    const Component w = wave_in(water, omega, 0);
    const Complex phi = i * velocity_transfer(w, water, {4, 0, 0}).x() / w.k;
    EXPECT_LT(std::abs(i * omega * phi + 9.81 * elevation_transfer(w, 4, 0)), 1e-14 * 9.81) << h;
  }
}

TEST(WaveKinematics, NoFlowThroughTheBed) {
  const Water water = water_of_depth(10);
  const Component w = wave_in(water, 0.9, 0);
  EXPECT_EQ(velocity_transfer(w, water, {0, 0, -10}).z(), Complex(0));
  EXPECT_GT(velocity_transfer(w, water, {0, 0, -10}).x().real(), 0.0);
}

TEST(WaveKinematics, WaterUnderACrestMovesWithTheWave) {
  const Water water = water_of_depth(10);
  const Eigen::Vector3cd V = velocity_transfer(wave_in(water, 0.9, 2.0), water, {0, 0, -1});
  EXPECT_GT((V.x() * std::cos(2.0) + V.y() * std::sin(2.0)).real(), 0.0);
  EXPECT_NEAR(std::abs(V.x() * std::sin(2.0) - V.y() * std::cos(2.0)), 0.0, 1e-16);  // none across it
  EXPECT_GT(V.z().imag(), 0.0);  // quarter of a period before the crest the water rises
}

TEST(WaveKinematics, AgreeWithTheTextbookRatiosWhereThoseCanBeComputed) {
  const Water water = water_of_depth(10);
  const Component w = wave_in(water, 0.9, 0);
  for (const double z : {0.0, -0.5, -3.0, -9.9}) {
    const Eigen::Vector3cd V = velocity_transfer(w, water, {0, 0, z});
    EXPECT_NEAR(V.x().real(), w.omega * std::cosh(w.k * (z + 10)) / std::sinh(w.k * 10), 4e-15) << z;
    EXPECT_NEAR(V.z().imag(), w.omega * std::sinh(w.k * (z + 10)) / std::sinh(w.k * 10), 4e-15) << z;
  }
}

TEST(WaveKinematics, NeitherOverflowNorCancelInTheLimits) {
  const Water deep{};
  const Component w = wave_in(deep, 1.0, 0);
  const Eigen::Vector3cd in_deep = velocity_transfer(w, deep, {0, 0, -7});
  EXPECT_DOUBLE_EQ(in_deep.x().real(), std::exp(-7 * w.k));
  EXPECT_DOUBLE_EQ(in_deep.z().imag(), std::exp(-7 * w.k));
  const Water kh_1000 = water_of_depth(1000 / w.k);
  EXPECT_LT((velocity_transfer(w, kh_1000, {0, 0, -7}) - in_deep).norm(), 1e-15);
  // Very long waves: u = ζ √(g/h) over the whole depth, w falls linearly to the bed; corrections are O((kh)²) = 1e-10.
  const Water shallow = water_of_depth(2);
  const Component tide = wave_in(shallow, 2e-5, 0);
  const Eigen::Vector3cd V = velocity_transfer(tide, shallow, {0, 0, -1.5});
  EXPECT_NEAR(V.x().real() / std::sqrt(9.81 / 2), 1.0, 1e-9);
  EXPECT_NEAR(V.z().imag() / (tide.omega * 0.25), 1.0, 1e-9);
}

TEST(WaveKinematics, KeepTheirSurfaceValueAboveStillWater) {
  const Water water = water_of_depth(10);
  const Component w = wave_in(water, 2.0, 0.4);
  EXPECT_EQ(velocity_transfer(w, water, {1, 2, 3}), velocity_transfer(w, water, {1, 2, 0}));  // (W13)
}

TEST(WaveKinematics, RefuseAPointBelowTheBed) {
  const Water water = water_of_depth(10);
  EXPECT_THAT(
      [&] {
        velocity_transfer(wave_in(water, 1, 0), water, {0, 0, -10.5});
      },
      ThrowsMessage<InputError>(HasSubstr("below the bed at z = -10 m")));
}

}  // namespace
}  // namespace hydro::waves::kinematics_test
