#include "hydro/waves/kinematics/focus.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"

namespace hydro::waves::focus_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(0.994)};
const Water shelf{.density = 1025, .gravity = 9.81, .depth = WaterDepth::from_metres(30)};

Sea random_sea(std::uint64_t seed) {
  return Sea::irregular(Jonswap(3, 9, 3.3), {FftGrid{600}, 0.35, 2.5, seed}, {Angle::from_degrees(25)}, shelf);
}

double rate(const Sea& sea, const Focus& f) {
  constexpr double h = 1e-4;  // central difference: error h² ζ‴/6 ~ 1e-9
  return (sea.elevation(f.t_s + h, f.x_m, f.y_m) - sea.elevation(f.t_s - h, f.x_m, f.y_m)) / (2 * h);
}

TEST(NewWave, HasItsCrestAtTheFocusAndTheShapeOfTheAutocorrelation) {
  const Sea sea = random_sea(3);
  const Focus focus{.x_m = 40, .y_m = -15, .t_s = 100};
  const Sea group = new_wave(sea, 4.5, focus);
  EXPECT_NEAR(group.elevation(100, 40, -15), 4.5, 1e-12);
  EXPECT_NEAR(rate(group, focus), 0, 1e-8);
  // (W25): symmetric in time about the focus, and nowhere higher.
  for (double tau = 0.5; tau < 60; tau += 0.5) {
    const double after = group.elevation(100 + tau, 40, -15);
    EXPECT_NEAR(after, group.elevation(100 - tau, 40, -15), 1e-11);
    EXPECT_LT(std::abs(after), 4.5);
  }
  // The autocorrelation of a record of the sea over its repetition is that shape: Σ e_j cos ω_j τ / Σ e_j.
  const double tau = 3.7;
  double product = 0, square = 0;
  for (int n = 0; n < 6000; ++n) {
    const double t = 0.1 * n;
    product += sea.elevation(t, 0, 0) * sea.elevation(t + tau, 0, 0);
    square += sea.elevation(t, 0, 0) * sea.elevation(t, 0, 0);
  }
  EXPECT_NEAR(product / square, group.elevation(100 + tau, 40, -15) / 4.5, 1e-10);  // sums over a whole period: exact
}

TEST(NewWave, IsWhatASeaDoesOnAverageAroundAHighCrest) {
  // Over seeds: the mean of ζ(τ) given ζ(0) is ζ(0) r(τ) for a Gaussian sea; taken by regression over 2000 seeds.
  const double tau = 2.2;
  double with = 0, square = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Sea sea = Sea::irregular(Jonswap(3, 9, 3.3), {FftGrid{60}, 0.35, 2.5, seed}, {}, shelf);
    with += sea.elevation(0, 0, 0) * sea.elevation(tau, 0, 0);
    square += sea.elevation(0, 0, 0) * sea.elevation(0, 0, 0);
  }
  const Sea one = Sea::irregular(Jonswap(3, 9, 3.3), {FftGrid{60}, 0.35, 2.5, 0}, {}, shelf);
  const double r = new_wave(one, 1, {}).elevation(tau, 0, 0);
  EXPECT_NEAR(with / square, r, 4 * std::sqrt((1 - r * r) / 2000));  // four standard errors; seeds fixed
}

TEST(ConstrainedNewWave, PutsTheCrestInAndLeavesTheRestOfTheSea) {
  const Sea sea = random_sea(8);
  const Focus focus{.x_m = -20, .y_m = 5, .t_s = 250};
  const Sea with = constrained_new_wave(sea, 5, focus);
  EXPECT_NEAR(with.elevation(250, -20, 5), 5, 1e-12);
  EXPECT_NEAR(rate(with, focus), 0, 1e-7);
  // Far from the focus the correction has died out as the autocorrelation has.
  const Sea group = new_wave(sea, 1, focus);
  const double missing = 5 - sea.elevation(250, -20, 5), slope = rate(sea, focus);
  double m0 = 0, m2 = 0;
  for (const Component& w : sea.components())
    m0 += w.amplitude * w.amplitude / 2, m2 += w.omega * w.omega * w.amplitude * w.amplitude / 2;
  for (const double tau : {-120.0, -3.0, 1.7, 60.0}) {
    const Focus there{-20, 5, 250 + tau};
    EXPECT_NEAR(with.elevation(250 + tau, -20, 5) - sea.elevation(250 + tau, -20, 5),
                missing * group.elevation(250 + tau, -20, 5) + slope * m0 / m2 * rate(group, there), 1e-7)
        << tau;
  }
}

TEST(ConstrainedNewWave, ChangesNothingWhereTheSeaHasThatCrestAlready) {
  const Sea sea = random_sea(8), once = constrained_new_wave(sea, 5, {.t_s = 33}),
            twice = constrained_new_wave(once, 5, {.t_s = 33});
  for (const double t : {0.0, 20.0, 33.0, 90.0})
    EXPECT_NEAR(twice.elevation(t, 0, 0), once.elevation(t, 0, 0), 2e-10);  // m_0 and m_2 of `once` differ a little
}

// ---- packets ----

std::vector<Packet> zanten() {
  std::vector<Packet> out;
  const double a[] = {0.0100, 0.0110, 0.0125, 0.0145, 0.0170, 0.0200, 0.0240, 0.0290, 0.0360, 0.0500};
  const double T[] = {0.8003, 0.8394, 0.8948, 0.9639, 1.0441, 1.1340, 1.2467, 1.3814, 1.5667, 1.9437};
  for (int i = 0; i < 10; ++i) out.push_back({WaveAmplitude::from_metres(a[i]), AngularFrequency::from_period_s(T[i])});
  return out;
}

TEST(Packets, MeetAtTheFocusWithAllTheirAmplitudes) {
  const PacketField field(zanten(), {.x_m = -1, .t_s = 2}, Angle::from_radians(0), tank);
  EXPECT_NEAR(field.elevation(2, -1, 0), 0.2240, 1e-12);  // Σ a of Van Zanten's table 3.1
  EXPECT_NEAR(field.elevation(2, -1, 7), 0.2240, 1e-12);  // long-crested
  for (const double x : {-6.0, -2.0, 0.0, 3.0}) EXPECT_LT(field.elevation(2, x, 0), 0.2240);
}

TEST(Packets, LastThreeAndAHalfWavesAtEveryPlace) {
  const std::vector<Packet> one{{WaveAmplitude::from_metres(0.05), AngularFrequency::from_period_s(1.9437)}};
  const PacketField field(one, {}, Angle::from_radians(0), tank);
  const double cg = group_velocity(2 * std::numbers::pi / 1.9437, tank), x = 12;
  EXPECT_NEAR(cg, 1.8187, 5e-4);  // the last row of Van Zanten's table 3.1, which is 4e-4 off its own period
  const auto [from, to] = field.stay(x);
  EXPECT_NEAR(to - from, 3.5 * 1.9437, 1e-12);
  EXPECT_NEAR((from + to) / 2, x / cg, 1e-12);
  EXPECT_EQ(field.elevation(from - 1e-6, x, 0), 0);
  EXPECT_EQ(field.elevation(to + 1e-6, x, 0), 0);
  double highest = 0;
  for (double t = from; t < to; t += 0.001) highest = std::max(highest, field.elevation(t, x, 0));
  EXPECT_NEAR(highest, 0.05, 0.05 * 1e-5);  // a crest within the flat middle, sampled every 0.001 s
}

TEST(Packets, AccelerationIsTheDerivativeOfTheVelocityAlsoInTheRamps) {
  const PacketField field(zanten(), {}, Angle::from_degrees(30), tank, Stretching::none);
  constexpr double h = 1e-3;
  for (const double t : {-3.0, -1.3, 0.2, 1.1}) {
    const Eigen::Vector3d p(-0.4, 0.3, -0.2);
    const auto at = [&](double dt) { return field.at(t + dt, p).velocity; };
    const Eigen::Vector3d rate_of_u = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    EXPECT_LT((field.at(t, p).acceleration - rate_of_u).norm(), 1e-7) << t;  // h⁴ ω⁵ u / 30
    for (int axis = 0; axis < 3; ++axis) {
      const auto beside = [&](double d) { return field.at(t, p + d * Eigen::Vector3d::Unit(axis)).velocity; };
      const Eigen::Vector3d column = (8 * (beside(h) - beside(-h)) - (beside(2 * h) - beside(-2 * h))) / (12 * h);
      EXPECT_LT((field.at(t, p).gradient.col(axis) - column).norm(), 1e-6) << t << ' ' << axis;
    }
  }
}

TEST(Packets, AreLinearWavesInTheirMiddle) {
  const std::vector<Packet> one{{WaveAmplitude::from_metres(0.05), AngularFrequency::from_period_s(1.5)}};
  const PacketField packet(one, {}, Angle::from_degrees(40), tank, Stretching::wheeler);
  const Sea sea = Sea::regular(one[0].amplitude, one[0].omega, Angle::from_degrees(40), tank);
  const HarmonicField wave = linear_field(sea);  // Wheeler
  for (const double t : {-0.6, 0.0, 0.9}) {
    const Eigen::Vector3d p(0.1, -0.2, -0.15);
    const Kinematics a = packet.at(t, p), b = wave.at(t, p);
    EXPECT_LT((a.velocity - b.velocity).norm(), 1e-14);
    EXPECT_LT((a.acceleration - b.acceleration).norm(), 1e-13);
    EXPECT_LT((a.gradient - b.gradient).norm(), 1e-13);
    EXPECT_NEAR(a.dynamic_pressure, b.dynamic_pressure, 1e-10);
  }
}

TEST(Packets, EnvelopeAndItsSlopeBelongTogether) {
  EXPECT_EQ(packet_envelope(0).value, 1);
  EXPECT_EQ(packet_envelope(0.75).value, 1);
  EXPECT_NEAR(packet_envelope(1.25).value, 0.5, 1e-15);
  EXPECT_EQ(packet_envelope(-1.75).value, 0);
  for (double s = -1.9; s < 1.9; s += 0.1)
    EXPECT_NEAR(packet_envelope(s).slope, (packet_envelope(s + 1e-6).value - packet_envelope(s - 1e-6).value) / 2e-6,
                6e-6)
        << s;  // kinks of the slope at ¾ and 7/4: 1e-6 π²/2
}

TEST(FindFocus, TellsAFocusedGroupFromARandomSea) {
  const Sea sea = random_sea(1);
  const FocusFound random = find_focus(sea, 0, 0, 0, 300);
  EXPECT_GT(random.probability, 1e-3);
  EXPECT_LT(random.share, 0.5);
  const FocusFound focused = find_focus(new_wave(sea, 5, {.t_s = 120}), 0, 0, 0, 300);
  EXPECT_NEAR(focused.t_s, 120, 2 * std::numbers::pi / 2.5 / 40);  // one sample
  EXPECT_NEAR(focused.envelope_m, 5, 5e-3);
  EXPECT_GT(focused.share, 0.999);
  EXPECT_LT(focused.probability, 1e-6);
  EXPECT_THROW(find_focus(sea, 0, 0, 10, 10), InputError);
}

TEST(Focus, RefusesWhatCannotFocus) {
  EXPECT_THROW(PacketField({}, {}, Angle::from_radians(0), tank), InputError);
  EXPECT_THROW(new_wave(random_sea(1), std::nan(""), {}), InputError);
  EXPECT_THAT(
      [] {
        const Sea flat = Sea::regular(WaveAmplitude::from_metres(0), AngularFrequency::from_period_s(5),
                                      Angle::from_radians(0), shelf);
        new_wave(flat, 1, {});
      },
      ThrowsMessage<InputError>(HasSubstr("without energy")));
}

}  // namespace
}  // namespace hydro::waves::focus_test
