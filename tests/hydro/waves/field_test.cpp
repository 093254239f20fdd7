#include "hydro/waves/kinematics/field.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>

#include "hydro/waves/kinematics/kinematics.hpp"
#include "hydro/waves/kinematics/sea.hpp"

namespace hydro::waves::field_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Water shelf{.density = 1025, .gravity = 9.81, .depth = WaterDepth::from_metres(20)};
const Water deep{};

GivenWave wave(double amplitude, double period, double heading_deg, double phase) {
  return {AngularFrequency::from_period_s(period), WaveAmplitude::from_metres(amplitude), phase,
          Angle::from_degrees(heading_deg)};
}

Sea three_waves(const Water& water, const Current& current = Current::none()) {
  const std::vector<GivenWave> list{wave(0.8, 6, 20, 0.3), wave(0.5, 4.5, -40, 2.0), wave(0.3, 3, 100, 5.1)};
  return Sea::of(list, water, current);
}

HarmonicField field_of(const Sea& sea, Stretching stretching) {
  HarmonicField::Options options;
  options.stretching = stretching;
  return linear_field(sea, options);
}

// Five-point difference: error h⁴ f⁗/30 with h = 0.01 of scales of metres and seconds, about 1e-9, and rounding 1e-13.
Eigen::Vector3d slope(const std::function<Eigen::Vector3d(double)>& f) {
  constexpr double h = 0.01;
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

TEST(LinearField, IsTheSumOfTheTransfersOfItsComponents) {
  const Sea sea = three_waves(shelf);
  const HarmonicField field = field_of(sea, Stretching::none);
  const Eigen::Vector3d point(3, -7, -4);
  const double t = 12.3;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Component& w : sea.components())
    sum += (velocity_transfer(w, shelf, point) * std::polar(w.amplitude, w.omega * t + w.phase)).real();
  const Kinematics k = field.at(t, point);
  EXPECT_LT((k.velocity - sum).norm(), 1e-14);  // the same sums in another order
  EXPECT_NEAR(k.elevation, sea.elevation(t, 3, -7), 1e-14);
  EXPECT_NEAR(field.elevation(t, 3, -7), k.elevation, 1e-15);
}

TEST(LinearField, DerivativesAreThoseOfItsOwnVelocity) {
  // (W17), without stretching, where they are exact; with a uniform current as well.
  for (const Current& current : {Current::none(), Current::uniform({0.7, -0.4})}) {
    const HarmonicField field = field_of(three_waves(shelf, current), Stretching::none);
    const Eigen::Vector3d p(1, 2, -3);
    const double t = 5;
    const Kinematics k = field.at(t, p);
    const auto rate = slope([&](double dt) { return field.at(t + dt, p).velocity; });
    EXPECT_LT((k.acceleration - rate).norm(), 1e-7);
    for (int axis = 0; axis < 3; ++axis) {
      const auto column = slope([&](double d) { return field.at(t, p + d * Eigen::Vector3d::Unit(axis)).velocity; });
      EXPECT_LT((k.gradient.col(axis) - column).norm(), 1e-7) << axis;
    }
    EXPECT_NEAR(k.gradient.trace(), 0, 1e-15);                       // volume is kept
    EXPECT_LT((k.gradient - k.gradient.transpose()).norm(), 1e-15);  // and nothing spins
  }
}

TEST(LinearField, MeetsTheSurfaceConditionsAtStillWaterAlsoOnACurrent) {
  // ∂ζ/∂t + U·∇ζ = w and p = ρgζ at z = 0, to first order exactly (W16), (W18).
  const Eigen::Vector2d U(1.2, 0.5);
  const HarmonicField field = field_of(three_waves(shelf, Current::uniform(U)), Stretching::none);
  const double t = 7, x = 4, y = -2, h = 1e-3;
  const Kinematics k = field.at(t, {x, y, 0});
  const auto zeta = [&](double dt, double dx, double dy) { return field.elevation(t + dt, x + dx, y + dy); };
  const auto central = [&](int which) {
    const auto f = [&](double d) { return zeta(which == 0 ? d : 0, which == 1 ? d : 0, which == 2 ? d : 0); };
    return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
  };
  EXPECT_NEAR(central(0) + U.x() * central(1) + U.y() * central(2), k.velocity.z(), 1e-11);
  EXPECT_NEAR(k.dynamic_pressure / (1025 * 9.81), k.elevation, 1e-14);
}

TEST(LinearField, PressureUnderACrestIsThatOfTheDisplacedSurface) {
  const Sea sea = Sea::of(std::vector{wave(1, 8, 0, 0)}, shelf);
  const double k = sea.components()[0].k;
  const Kinematics at_bed = field_of(sea, Stretching::wheeler).at(0, {0, 0, -20});
  // Wheeler leaves the bed where it is: ρ g a / cosh kh.
  EXPECT_NEAR(at_bed.dynamic_pressure, 1025 * 9.81 / std::cosh(k * 20), 1e-9);
}

TEST(LinearField, MaterialAccelerationIsThatOfADriftingParticle) {
  // (W19): the velocity met along the path of a particle, by a Runge–Kutta step of 0.01 s either way (error 1e-8).
  const HarmonicField field = field_of(three_waves(shelf, Current::uniform({0.6, 0})), Stretching::none);
  const Eigen::Vector3d start(0.5, 1, -2);
  const double t = 3;
  const auto velocity_along_path = [&](double dt) {
    Eigen::Vector3d p = start;
    const Eigen::Vector3d k1 = field.at(t, p).velocity, k2 = field.at(t + dt / 2, p + dt / 2 * k1).velocity,
                          k3 = field.at(t + dt / 2, p + dt / 2 * k2).velocity,
                          k4 = field.at(t + dt, p + dt * k3).velocity;
    p += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    return field.at(t + dt, p).velocity;
  };
  EXPECT_LT((field.at(t, start).material_acceleration() - slope(velocity_along_path)).norm(), 1e-7);
}

TEST(LinearField, ManyPointsAreThePointsOneByOne) {
  const HarmonicField field = field_of(three_waves(shelf), Stretching::wheeler);
  const std::vector<Eigen::Vector3d> points{{0, 0, -1}, {5, 5, -10}, {-3, 2, 0.5}};
  std::vector<Kinematics> out(points.size());
  field.at(2.5, points, out);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(out[i].velocity, field.at(2.5, points[i]).velocity);
  std::vector<Kinematics> too_few(2);
  EXPECT_THROW(field.at(2.5, points, too_few), InputError);
}

TEST(LinearField, NeverOverflowsNorVanishesInTheLimitsOfDepth) {
  // kh = 1e3: only the top matters. kh = 1e-6: u = ζ √(g/h), the same at every height, w falls straight to the bed.
  const Water ocean{.depth = WaterDepth::from_metres(1000)};
  const double omega_short = std::sqrt(9.81 * 1.0);  // k = 1
  const Sea ripples = Sea::of(std::vector<GivenWave>{{AngularFrequency::from_rad_per_s(omega_short),
                                                      WaveAmplitude::from_metres(0.01), 0, Angle::from_radians(0)}},
                              ocean);
  const Kinematics at_top = field_of(ripples, Stretching::vertical).at(0, {0, 0, 0});
  EXPECT_NEAR(at_top.velocity.x() / (0.01 * omega_short), 1, 1e-14);
  EXPECT_EQ(field_of(ripples, Stretching::vertical).at(0, {0, 0, -1000}).velocity.z(), 0);
  const Water puddle{.depth = WaterDepth::from_metres(1)};
  const double k = 1e-6, omega_long = std::sqrt(9.81 * k * std::tanh(k));
  const Sea tide = Sea::of(std::vector<GivenWave>{{AngularFrequency::from_rad_per_s(omega_long),
                                                   WaveAmplitude::from_metres(0.01), 0, Angle::from_radians(0)}},
                           puddle);
  const HarmonicField field = field_of(tide, Stretching::vertical);
  EXPECT_NEAR(field.at(0, {0, 0, -0.7}).velocity.x() / (0.01 * std::sqrt(9.81)), 1, 1e-11);  // next term (kh)²
  const double quarter = std::numbers::pi / 2 / omega_long;
  EXPECT_NEAR(field.at(quarter, {0, 0, -0.7}).velocity.z() / (-0.01 * omega_long * 0.3), 1, 1e-11);
}

// ---- stretching ----

TEST(Stretching, EachReadsTheProfileWhereItsAuthorsSay) {
  const double h = 20, hs = 4, crest = 2;
  EXPECT_EQ(stretched_height(Stretching::none, 1.5, crest, h, hs).z, 1.5);
  EXPECT_EQ(stretched_height(Stretching::vertical, 1.5, crest, h, hs).z, 0);
  EXPECT_EQ(stretched_height(Stretching::vertical, -3, crest, h, hs).z, -3);
  // Wheeler (W14): surface to 0, bed to bed.
  EXPECT_NEAR(stretched_height(Stretching::wheeler, crest, crest, h, hs).z, 0, 1e-15);
  EXPECT_NEAR(stretched_height(Stretching::wheeler, -h, crest, h, hs).z, -h, 1e-14);
  EXPECT_NEAR(stretched_height(Stretching::wheeler, -1, -1, h, hs).z, 0, 1e-15);  // in a trough too
  const auto infinite = stretched_height(Stretching::wheeler, -5, crest, std::numeric_limits<double>::infinity(), hs);
  EXPECT_EQ(infinite.z, -7);
  // Linear: the tangent above still water.
  EXPECT_EQ(stretched_height(Stretching::linear, 1.5, crest, h, hs).z, 0);
  EXPECT_EQ(stretched_height(Stretching::linear, 1.5, crest, h, hs).tangent, 1.5);
  // Delta (W15): nothing below −Hs/2; the surface goes to 0.3 of the crest, on the tangent.
  EXPECT_EQ(stretched_height(Stretching::delta, -2, crest, h, hs).z, -2);
  EXPECT_NEAR(stretched_height(Stretching::delta, crest, crest, h, hs).tangent, 0.3 * crest, 1e-15);
  EXPECT_NEAR(stretched_height(Stretching::delta, -1, -1, h, hs).z, -0.3, 1e-15);  // the trough's surface: 0.3 ζ
}

TEST(Stretching, GivesTheVelocitiesOfTheStillWaterLevelAtTheCrest) {
  const Sea sea = Sea::of(std::vector{wave(2, 8, 0, 0)}, shelf);
  const double still = field_of(sea, Stretching::none).at(0, {0, 0, 0}).velocity.x();
  const double crest = 2;
  EXPECT_NEAR(field_of(sea, Stretching::vertical).at(0, {0, 0, crest}).velocity.x(), still, 1e-15);
  EXPECT_NEAR(field_of(sea, Stretching::wheeler).at(0, {0, 0, crest}).velocity.x(), still, 1e-15);
  const double k = sea.components()[0].k;
  const double tangent = still * (1 + crest * k * std::tanh(k * 20));
  EXPECT_NEAR(field_of(sea, Stretching::linear).at(0, {0, 0, crest}).velocity.x(), tangent, 1e-14);
  const double exponential = field_of(sea, Stretching::none).at(0, {0, 0, crest}).velocity.x();
  EXPECT_GT(exponential, tangent);  // cosh curves upwards
  const double delta = field_of(sea, Stretching::delta).at(0, {0, 0, crest}).velocity.x();
  EXPECT_GT(delta, still);
  EXPECT_LT(delta, tangent);
}

TEST(Stretching, IsContinuousAtStillWater) {
  const Sea sea = three_waves(shelf);
  for (const auto how :
       {Stretching::none, Stretching::vertical, Stretching::wheeler, Stretching::linear, Stretching::delta}) {
    const HarmonicField field = field_of(sea, how);
    const auto above = field.at(1, {0, 0, 1e-9}), below = field.at(1, {0, 0, -1e-9});
    EXPECT_LT((above.velocity - below.velocity).norm(), 1e-8) << static_cast<int>(how);
    EXPECT_LT((above.acceleration - below.acceleration).norm(), 1e-8) << static_cast<int>(how);
  }
}

TEST(HarmonicField, RefusesWhatHasNoMeaning) {
  const Sea sea = three_waves(shelf);
  EXPECT_THAT(
      [&] {
        field_of(sea, Stretching::none).at(0, {0, 0, -20.5});
      },
      ThrowsMessage<InputError>(HasSubstr("below the bed")));
  EXPECT_THAT([&] { HarmonicField(harmonics(sea), shelf, {.stretching = Stretching::delta}); },
              ThrowsMessage<InputError>(HasSubstr("significant wave height")));
  auto broken = harmonics(sea);
  broken[1].omega = std::nan("");
  EXPECT_THROW(HarmonicField(broken, shelf, {}), InputError);
}

}  // namespace
}  // namespace hydro::waves::field_test
