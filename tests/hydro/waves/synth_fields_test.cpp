// The fast fields against the plain one, and against the laws that any of them must obey.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <numbers>

#include "hydro/base/random.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/synthesis/boxed_field.hpp"
#include "hydro/waves/synthesis/field_choice.hpp"
#include "hydro/waves/synthesis/second_order.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"
#include "hydro/waves/synthesis/tabulated_field.hpp"

namespace hydro::waves::synth_fields_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Stretching all_stretchings[] = {Stretching::none, Stretching::vertical, Stretching::wheeler,
                                          Stretching::linear, Stretching::delta};
const Water deep{};
const Water shallow{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(11)};
const FieldBox box{400, 460, {-6, -4, -9}, {7, 5, 3}};

Sea sea_of(const Water& water, bool short_crested, std::size_t count = 40) {
  const RandomStream random(11, 5);
  std::vector<GivenWave> waves;
  for (std::size_t j = 0; j < count; ++j) {
    const double omega = 0.35 + 1.3 * (static_cast<double>(j) + 0.5) / static_cast<double>(count);
    const double heading = short_crested ? 30 + 80 * (random.uniform(3 * j) - 0.5) : 205;
    waves.push_back({AngularFrequency::from_rad_per_s(omega),
                     WaveAmplitude::from_metres(0.2 * random.uniform(3 * j + 1)), 6.28 * random.uniform(3 * j + 2),
                     Angle::from_degrees(heading)});
  }
  return Sea::of(waves, water);
}

std::vector<Eigen::Vector4d> places(std::size_t count) {  // (t, x, y, z) in the box
  const RandomStream random(7, 1);
  std::vector<Eigen::Vector4d> out;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector4d u(random.uniform(4 * i), random.uniform(4 * i + 1), random.uniform(4 * i + 2),
                            random.uniform(4 * i + 3));
    out.emplace_back(box.start_s + (box.end_s - box.start_s) * u[0], box.low.x() + (box.high.x() - box.low.x()) * u[1],
                     box.low.y() + (box.high.y() - box.low.y()) * u[2],
                     box.low.z() + (box.high.z() - box.low.z()) * u[3]);
  }
  // Corners of the box, where interpolation has least to hold on to.
  out.emplace_back(box.start_s, box.low.x(), box.low.y(), box.low.z());
  out.emplace_back(box.end_s, box.high.x(), box.high.y(), box.low.z());
  return out;
}

FieldError difference(const Kinematics& a, const Kinematics& b) {
  return {.elevation = std::abs(a.elevation - b.elevation),
          .velocity = (a.velocity - b.velocity).norm(),
          .acceleration = (a.acceleration - b.acceleration).norm(),
          .gradient = (a.gradient - b.gradient).norm(),
          .dynamic_pressure = std::abs(a.dynamic_pressure - b.dynamic_pressure)};
}

void expect_within(const FieldError& found, const FieldError& bound, const std::string& where) {
  EXPECT_LE(found.elevation, bound.elevation) << where;
  EXPECT_LE(found.velocity, bound.velocity) << where;
  EXPECT_LE(found.acceleration, bound.acceleration) << where;
  EXPECT_LE(found.gradient, bound.gradient) << where;
  EXPECT_LE(found.dynamic_pressure, bound.dynamic_pressure) << where;
}

TEST(SummedField, IsThePlainFieldToRounding) {
  for (const Water& water : {deep, shallow})
    for (const bool short_crested : {false, true})
      for (const Stretching stretching : all_stretchings) {
        const HarmonicField plain = linear_field(sea_of(water, short_crested), {.stretching = stretching});
        const SummedField fast(plain);
        for (const Eigen::Vector4d& p : places(40)) {
          const Kinematics a = plain.at(p[0], p.tail<3>());
          if (p[3] > a.elevation) continue;  // delta stretching is ill-conditioned far above a trough
          // Phases of 800 rad are known to 1e-13 in the plain sum; sizes are of order one, pressures of 1e4.
          const FieldError found = difference(a, fast.at(p[0], p.tail<3>()));
          expect_within(found, {2e-12, 2e-12, 2e-12, 2e-12, 2e-8}, fmt::format("stretching {}", int(stretching)));
          EXPECT_NEAR(fast.elevation(p[0], p[1], p[2]), a.elevation, 2e-12);
        }
      }
}

TEST(SummedField, ForgetsNothingAfterADay) {
  // ωt = 86400·π/8·(1 + 1/3): ζ = cos of that for a wave of one metre. 86400/16 turns are whole; 28800/16 are, too.
  const double omega = std::numbers::pi / 8, t = 86400;
  const Sea sea = Sea::regular(WaveAmplitude::from_metres(1), AngularFrequency::from_rad_per_s(omega),
                               Angle::from_radians(0), deep);
  // π/8 as a double is off by 1.5e-17 of itself at most (2^-56 relative): 34000 rad · 2^-54 = 2e-12 … of phase, and the
  // cosine at a crest is flat.
  EXPECT_NEAR(SummedField(linear_field(sea)).elevation(t, 0, 0), 1.0, 1e-14);
  const Kinematics quarter = SummedField(linear_field(sea)).at(t + 4, {0, 0, 0});  // a quarter of the period of 16 s
  EXPECT_NEAR(quarter.elevation, 0.0, 1e-11);
  EXPECT_NEAR(quarter.velocity.z(), -omega, 1e-11);  // the surface goes down
}

TEST(SummedField, FlowConservesVolumeAndDoesNotSpin) {
  const SummedField fast(linear_field(sea_of(shallow, true)));
  for (const Eigen::Vector4d& p : places(10)) {
    const Kinematics k = fast.at(p[0], p.tail<3>());
    EXPECT_NEAR(k.gradient.trace(), 0.0, 1e-15);
    EXPECT_LT((k.gradient - k.gradient.transpose()).norm(), 1e-15);
  }
}

TEST(SummedField, ManyPointsAreThoseOneByOne) {
  const SummedField fast(linear_field(sea_of(deep, true)));
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector4d& p : places(9)) points.push_back(p.tail<3>());
  std::vector<Kinematics> together(points.size());
  fast.at(412.3, points, together);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Kinematics alone = fast.at(412.3, points[i]);
    EXPECT_EQ(difference(alone, together[i]).velocity, 0.0);
    EXPECT_EQ(alone.dynamic_pressure, together[i].dynamic_pressure);
  }
  EXPECT_THROW(fast.at(0, points, {together.data(), 2}), InputError);
  EXPECT_THROW(SummedField(linear_field(sea_of(shallow, true))).at(0, {0, 0, -11.1}), InputError);
}

TEST(TabulatedField, IsThePlainFieldWithinTheErrorItStates) {
  for (const Water& water : {deep, shallow})
    for (const bool short_crested : {false, true})
      for (const Stretching stretching : all_stretchings)
        for (const double tolerance : {1e-4, 1e-10}) {
          if (short_crested && tolerance < 1e-4 && stretching != Stretching::wheeler) continue;  // to save time
          const HarmonicField plain = linear_field(sea_of(water, short_crested), {.stretching = stretching});
          const TabulatedField table(plain, box, {.tolerance = tolerance});
          EXPECT_LE(table.relative_error(), tolerance);
          for (const Eigen::Vector4d& p : places(60)) {
            const Kinematics a = plain.at(p[0], p.tail<3>());
            if (p[3] > a.elevation) continue;
            expect_within(difference(a, table.at(p[0], p.tail<3>())), table.error_bound(),
                          fmt::format("stretching {}, tolerance {}, t = {} s, ({}, {}, {}) m", int(stretching),
                                      tolerance, p[0], p[1], p[2], p[3]));
          }
        }
}

// Waves a metre long in a box nine metres high: some thirty polynomials, where those of the seas above are sixteen.
TEST(TabulatedField, HoldsWithManyPolynomials) {
  const FieldBox high{0, 4, {-1, -1, -9}, {1, 1, 0}};
  const Sea sea = Sea::of(std::vector<GivenWave>{{AngularFrequency::from_rad_per_s(7.8),
                                                  WaveAmplitude::from_metres(0.02), 0.3, Angle::from_degrees(70)}},
                          deep);
  for (const Stretching stretching : {Stretching::vertical, Stretching::linear}) {
    const HarmonicField plain = linear_field(sea, {.stretching = stretching});
    const TabulatedField table(plain, high, {.tolerance = 1e-9});
    for (const double z : {-9.0, -5.3, -0.9, -0.2, 0.0}) {
      const Eigen::Vector3d p(0.3, -0.4, z);
      expect_within(difference(plain.at(2.1, p), table.at(2.1, p)), table.error_bound(), fmt::format("z = {} m", z));
    }
  }
}

TEST(TabulatedField, HoldsWithACurrentAndTheFullBernoulliEquation) {
  const Current current = Current::profile({-9, 0}, {{0.1, 0}, {0.6, -0.3}});
  const Sea sea = Sea::of(std::vector<GivenWave>{{AngularFrequency::from_period_s(6), WaveAmplitude::from_metres(0.8),
                                                  0.3, Angle::from_degrees(70)}},
                          shallow, current);
  const HarmonicField plain = linear_field(sea, {.pressure = PressureLaw::full, .bernoulli_constant = 0.4});
  const TabulatedField table(plain, box);
  for (const Eigen::Vector4d& p : places(30)) {
    const Kinematics a = plain.at(p[0], p.tail<3>());
    if (p[3] <= a.elevation) expect_within(difference(a, table.at(p[0], p.tail<3>())), table.error_bound(), "current");
  }
}

TEST(FastFields, KeepThePressureUnderWavesThatMeet) {
  // The bound wave of two equal waves that run against each other has no wave vector: it lifts nothing and presses
  // everywhere, far down with 2 ρ a² ω² at twice their frequency (Longuet-Higgins 1950).
  for (const Water& water : std::array{deep, shallow}) {
    const auto wave = [](double heading) {
      return GivenWave{AngularFrequency::from_rad_per_s(1.2), WaveAmplitude::from_metres(0.5), 0.3,
                       Angle::from_degrees(heading)};
    };
    const HarmonicField plain = second_order_field(Sea::of(std::array{wave(0), wave(180)}, water));
    const SummedField sum(plain);
    if (water.depth.is_infinite()) {
      // Phases 2 (ωt + 0.3) of 0 at some instant; nothing else is left 500 m down (e^{-kz} is 1e-31).
      const double t = 2 * std::numbers::pi / 1.2 - 0.3 / 1.2, expected = 2 * deep.density * 0.25 * 1.44;
      EXPECT_NEAR(std::abs(sum.at(t, {3, 1, -500}).dynamic_pressure), expected, 1e-9 * expected);
    }
    const TabulatedField table(plain, box);
    for (const Eigen::Vector4d& p : places(20)) {
      const Kinematics a = plain.at(p[0], p.tail<3>());
      if (p[3] > a.elevation) continue;
      expect_within(difference(a, sum.at(p[0], p.tail<3>())), {2e-12, 2e-12, 2e-12, 2e-12, 2e-8}, "sum");
      expect_within(difference(a, table.at(p[0], p.tail<3>())), table.error_bound(), "table");
    }
  }
}

TEST(TabulatedField, ErrorBoundIsOfTheOrderOfTheToleranceTimesTheSea) {
  // A bound that is met by being enormous would promise nothing: Σ|a| here is 4 m, σ_ζ 0.5 m.
  const HarmonicField plain = linear_field(sea_of(deep, false));
  const TabulatedField table(plain, box);
  EXPECT_LT(table.error_bound().elevation, 1e-9);
  EXPECT_LT(table.error_bound().velocity, 1e-8);
  EXPECT_LT(table.error_bound().acceleration, 1e-8);
}

TEST(TabulatedField, ManyPointsAreThoseOneByOneBitForBit) {
  for (const bool short_crested : {false, true}) {
    const TabulatedField table(linear_field(sea_of(deep, short_crested)), box, {.tolerance = 1e-6});
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector4d& p : places(40)) points.push_back(p.tail<3>());
    std::vector<Kinematics> together(points.size());
    table.at(433.3, points, together);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Kinematics alone = table.at(433.3, points[i]);
      EXPECT_EQ(difference(alone, together[i]).acceleration, 0.0);
      EXPECT_EQ(difference(alone, together[i]).gradient, 0.0);
      EXPECT_EQ(alone.elevation, table.elevation(433.3, points[i].x(), points[i].y()));
    }
  }
}

// Each thread keeps what it has of one instant of one field: another field, or another instant, is not mistaken for it.
TEST(FastFields, AskedInTurnAnswerEachForItself) {
  const HarmonicField one = linear_field(sea_of(deep, false)), other = linear_field(sea_of(shallow, false));
  const TabulatedField table(one, box, {.tolerance = 1e-6}), other_table(other, box, {.tolerance = 1e-6});
  const SummedField sum(one), other_sum(other);
  const Eigen::Vector3d p(1, 0.5, -3), q(-2, 0, -1);
  const auto velocity = [](const WaveField& field, double t, const Eigen::Vector3d& at) -> Eigen::Vector3d {
    return field.at(t, at).velocity;
  };
  for (const WaveField* field : {static_cast<const WaveField*>(&table), static_cast<const WaveField*>(&sum)}) {
    const WaveField& second = field == &table ? static_cast<const WaveField&>(other_table) : other_sum;
    // Each first after an instant of its own, so that nothing of the other's can be left.
    velocity(*field, 401, q);
    const Eigen::Vector3d of_first = velocity(*field, 402, p);
    velocity(second, 401, q);
    const Eigen::Vector3d of_second = velocity(second, 402, p);
    EXPECT_NE(of_first, of_second);
    EXPECT_EQ(velocity(*field, 402, p), of_first);
    EXPECT_EQ(velocity(second, 402, p), of_second);
    velocity(second, 402, q);
    EXPECT_EQ(velocity(second, 402, p), of_second);
  }
}

TEST(TabulatedField, DerivativesBelongToItsValues) {
  // Central differences of the potential flow: the order of the difference, 1e-4², times third derivatives below one.
  const TabulatedField table(linear_field(sea_of(shallow, true)), box, {.tolerance = 1e-9});
  const double d = 1e-4;
  const Eigen::Vector3d p(0.3, -1.1, -4);
  const Kinematics k = table.at(430, p);
  const Eigen::Vector3d rate = (table.at(430 + d, p).velocity - table.at(430 - d, p).velocity) / (2 * d);
  // Wheeler's height moves with the surface, which the acceleration of (W17) leaves out: deep points hardly feel it.
  EXPECT_LT((rate - k.acceleration).norm(), 0.2 * k.acceleration.norm());
  const TabulatedField still(linear_field(sea_of(shallow, true), {.stretching = Stretching::none}), box,
                             {.tolerance = 1e-9});
  const Kinematics s = still.at(430, p);
  const Eigen::Vector3d still_rate = (still.at(430 + d, p).velocity - still.at(430 - d, p).velocity) / (2 * d);
  EXPECT_LT((still_rate - s.acceleration).norm(), 1e-7);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = d * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d slope = (still.at(430, p + step).velocity - still.at(430, p - step).velocity) / (2 * d);
    EXPECT_LT((slope - s.gradient.col(axis)).norm(), 1e-7) << axis;
  }
}

TEST(TabulatedField, RefusesWhatLiesOutsideItsBox) {
  const TabulatedField table(linear_field(sea_of(deep, false)), box, {.tolerance = 1e-4});
  EXPECT_NO_THROW(table.at(box.end_s, box.high));
  EXPECT_THAT([&] { table.at(460.1, {0, 0, -1}); }, ThrowsMessage<InputError>(HasSubstr("runs from 400 s to 460 s")));
  EXPECT_THAT([&] { table.at(430, {7.1, 0, -1}); }, ThrowsMessage<InputError>(HasSubstr("x from -6 m to 7 m")));
  EXPECT_THAT([&] { table.at(430, {0, -4.1, -1}); }, ThrowsMessage<InputError>(HasSubstr("asked for (0, -4.1) m")));
  EXPECT_THAT([&] { table.at(430, {0, 0, -9.1}); }, ThrowsMessage<InputError>(HasSubstr("z from -9 m to 3 m")));
  EXPECT_THROW(table.elevation(399, 0, 0), InputError);
  EXPECT_THROW(table.elevation(NAN, 0, 0), InputError);
  EXPECT_THROW(table.at(430, {0, 0, NAN}), InputError);
}

TEST(TabulatedField, RefusesBoxesThatCannotBe) {
  const HarmonicField plain = linear_field(sea_of(shallow, true));
  const auto with = [&](FieldBox b) { return [&plain, b] { TabulatedField(plain, b); }; };
  EXPECT_THAT(with({10, 5, {0, 0, -1}, {1, 1, 0}}), ThrowsMessage<InputError>(HasSubstr("start before its end")));
  EXPECT_THAT(with({0, 5, {0, 2, -1}, {1, 1, 0}}), ThrowsMessage<InputError>(HasSubstr("low corner below")));
  EXPECT_THAT(with({0, 5, {0, 0, -12}, {1, 1, 0}}), ThrowsMessage<InputError>(HasSubstr("below the bed at z = -11 m")));
  EXPECT_THAT([&] { TabulatedField(plain, box, {.tolerance = 1e-13}); },
              ThrowsMessage<InputError>(HasSubstr("between 1e-11 and 1e-2")));
  EXPECT_THAT([&] { TabulatedField(plain, box, {.largest_bytes = 1000000}); },
              ThrowsMessage<InputError>(HasSubstr("more than the 1 MB allowed")));
}

TEST(TabulatedField, OfTheElevationAloneSaysThatItHasNoFlow) {
  const HarmonicField plain = linear_field(sea_of(deep, false));
  const TabulatedField table(plain, box, {.elevation_only = true});
  EXPECT_LT(table.bytes(), TabulatedField(plain, box).bytes() / 4);
  for (const Eigen::Vector4d& p : places(20))
    EXPECT_NEAR(table.elevation(p[0], p[1], p[2]), plain.elevation(p[0], p[1], p[2]), table.error_bound().elevation);
  EXPECT_THAT([&] { table.at(430, {0, 0, -1}); }, ThrowsMessage<InputError>(HasSubstr("elevation only")));
}

// Few instants are a product of matrices, and some thousands go by transforms.
TEST(TabulatedField, OfManyInstantsIsTheSumToo) {
  const HarmonicField plain = linear_field(sea_of(deep, false));
  FieldBox hours = box;
  hours.end_s = box.start_s + 4000;
  const TabulatedField table(plain, hours, {});
  for (const Eigen::Vector4d& p : places(20)) {
    const double t = box.start_s + (hours.end_s - box.start_s) * (p[0] - box.start_s) / (box.end_s - box.start_s);
    expect_within(difference(plain.at(t, p.tail<3>()), table.at(t, p.tail<3>())), table.error_bound(), "");
  }
}

TEST(FieldChoice, TakesATableForManyQuestionsAndASumForFew) {
  const HarmonicField plain = linear_field(sea_of(deep, false, 400));
  const ChosenField few = choose_field(plain, {.box = box, .instants = 10, .points = 1});
  EXPECT_EQ(few.method, FieldMethod::vector_sum);
  const ChosenField many = choose_field(plain, {.box = box, .instants = 1e5, .points = 100});
  EXPECT_EQ(many.method, FieldMethod::table);
  const ChosenField no_room = choose_field(plain, {.box = box, .instants = 1e5, .points = 100, .largest_bytes = 10000});
  EXPECT_EQ(no_room.method, FieldMethod::vector_sum);
  for (const ChosenField* chosen : {&few, &many, &no_room})
    for (const Eigen::Vector4d& p : places(5)) {
      const Kinematics a = plain.at(p[0], p.tail<3>());
      // The plain sum's own rounding of phases, 2e-13 each, comes on top.
      EXPECT_LE(difference(a, chosen->field->at(p[0], p.tail<3>())).velocity, chosen->error_bound.velocity + 1e-12);
    }
  EXPECT_EQ(choose_field(plain, {.box = box, .instants = 1, .points = 1}, FieldMethod::harmonics).method,
            FieldMethod::harmonics);
  EXPECT_THROW(choose_field(plain, {.box = box, .instants = 0, .points = 1}), InputError);
}

// Inside the box the table answers, outside the sum; a list of points on both sides gets each from its own.
TEST(BoxedField, IsTheSumEverywhere) {
  const HarmonicField plain = linear_field(sea_of(deep, false, 400));
  const BoxedField field(plain, {.box = box, .instants = 1e5, .points = 100});
  ASSERT_EQ(field.tables(), 1);
  const FieldError& bounds = field.table(box.start_s)->error_bound();
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector4d& p : places(20)) {
    points.push_back(p.tail<3>());
    points.push_back(p.tail<3>() + Eigen::Vector3d(box.high.x() - box.low.x() + 1, 0, 0));
  }
  for (const double t : {places(1)[0][0], box.end_s + 1}) {
    std::vector<Kinematics> all(points.size());
    field.at(t, points, all);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Kinematics sum = plain.at(t, points[i]), one = field.at(t, points[i]);
      const double bound = bounds.velocity + 1e-12;
      EXPECT_LE(difference(sum, all[i]).velocity, bound);
      EXPECT_LE(difference(sum, one).velocity, bound);
      EXPECT_NEAR(field.elevation(t, points[i].x(), points[i].y()), sum.elevation, bounds.elevation + 1e-12);
    }
  }
  const BoxedField few(plain, {.box = box, .instants = 10, .points = 1});
  EXPECT_EQ(few.tables(), 0);
  EXPECT_EQ(few.table(box.start_s), nullptr);
}

// What does not fit into the memory allowed is made span by span. Two threads that go through all of them in opposite
// directions, so that spans are forgotten and made again, find what the sum tells, and the same bits.
TEST(BoxedField, HasTablesOneAfterTheOtherWhereAllTimesDoNotFit) {
  const HarmonicField plain = linear_field(sea_of(deep, false, 400));
  FieldUse use{.box = box, .instants = 1e5, .points = 100};
  use.largest_bytes = static_cast<std::size_t>(0.9 * TabulatedField::expected_bytes(plain, box, {}));
  const BoxedField field(plain, use);
  ASSERT_GE(field.tables(), 5) << "of a quarter of the memory each";
  EXPECT_LE(4 * field.bytes_of_table(), use.largest_bytes);
  std::vector<double> times;  // the ends of all spans too
  const int parts = 4 * field.tables();
  for (int i = 0; i <= parts; ++i) times.push_back(box.start_s + (box.end_s - box.start_s) * i / parts);
  const Eigen::Vector3d point = places(1)[0].tail<3>();
  const auto velocities = [&](std::vector<double> at) {
    std::vector<double> out;
    for (const double t : at) out.push_back(field.at(t, point).velocity.x());
    return out;
  };
  auto backwards = std::async(std::launch::async, [&] { return velocities({times.rbegin(), times.rend()}); });
  const std::vector<double> forwards = velocities(times);
  std::vector<double> others = backwards.get();
  std::reverse(others.begin(), others.end());
  EXPECT_EQ(forwards, others);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(forwards[i], plain.at(times[i], point).velocity.x(),
                field.table(times[i])->error_bound().velocity + 1e-12)
        << times[i];
}

}  // namespace
}  // namespace hydro::waves::synth_fields_test
