#include "hydro/base/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace units_test {
namespace {

using namespace hydro;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double pi = std::numbers::pi;

TEST(Units, ReadWhatPeopleWrite) {
  EXPECT_DOUBLE_EQ(parse_si("29.3 kN/m", dim::stiffness), 29300);
  EXPECT_DOUBLE_EQ(parse_si("22.5 deg", dim::angle), pi / 8);
  EXPECT_DOUBLE_EQ(parse_si("1.2 t", dim::mass), 1200);
  EXPECT_DOUBLE_EQ(parse_si("10 knots", dim::velocity), 18520.0 / 3600);
  EXPECT_DOUBLE_EQ(parse_si("2 bar", dim::pressure), 2e5);
  EXPECT_DOUBLE_EQ(parse_si("-350 kN/m", dim::stiffness), -350e3);
  EXPECT_DOUBLE_EQ(parse_si("50 mm", dim::length), 0.05);
  EXPECT_DOUBLE_EQ(parse_si("1.05e-6 m^2/s", dim::kinematic_viscosity), 1.05e-6);
  EXPECT_DOUBLE_EQ(parse_si("3.07 kg m^2", dim::inertia), 3.07);
  EXPECT_DOUBLE_EQ(parse_si("3.07 kg·m²", dim::inertia), 3.07);
  EXPECT_DOUBLE_EQ(parse_si("60 kN s/m", dim::damping), 60e3);
  EXPECT_DOUBLE_EQ(parse_si("9.81 m/s2", dim::acceleration), 9.81);
  EXPECT_DOUBLE_EQ(parse_si("0.7", dim::none), 0.7);
  EXPECT_DOUBLE_EQ(parse_si("2 kN / m", dim::stiffness), 2000);
}

// Values of NIST Special Publication 811 (2008), appendix B.8, as many digits as it prints.
TEST(Units, ReadPoundsOfMassAndOfForce) {
  EXPECT_DOUBLE_EQ(parse_si("1 lb", dim::mass), 0.45359237);
  EXPECT_DOUBLE_EQ(parse_si("1 LT", dim::mass), 1016.0469088);
  EXPECT_NEAR(parse_si("1 slug", dim::mass), 14.59390, 5e-6);
  EXPECT_NEAR(parse_si("1 lbf", dim::force), 4.448222, 5e-7);
  EXPECT_NEAR(parse_si("1 kip", dim::force), 4448.222, 5e-4);
  EXPECT_NEAR(parse_si("1 kip ft", dim::moment), 1355.818, 5e-4);
  EXPECT_NEAR(parse_si("1 psi", dim::pressure), 6894.757, 5e-4);
  EXPECT_NEAR(parse_si("64 lb/ft^3", dim::density), 64 * 16.01846, 64 * 5e-6);
}

TEST(Units, TakeHertzForACyclePerSecond) {
  EXPECT_DOUBLE_EQ(parse_si("0.5 Hz", dim::angular_velocity), pi);
  EXPECT_DOUBLE_EQ(parse_si("60 rpm", dim::angular_velocity), 2 * pi);
  EXPECT_THROW(parse_si("0.5 1/s", dim::angular_velocity), InputError) << "a bare 1/s could be either";
}

TEST(Units, NeedNoRadianWhereForceTellsTheQuantity) {
  EXPECT_DOUBLE_EQ(parse_si("15839 N m/rad", dim::rotational_stiffness), 15839);
  EXPECT_DOUBLE_EQ(parse_si("15839 N m", dim::rotational_stiffness), 15839);
  EXPECT_DOUBLE_EQ(parse_si("1 N m/deg", dim::rotational_stiffness), 180 / pi);
  EXPECT_THROW(parse_si("0.3", dim::angle), InputError);
}

TEST(Units, RefuseAndSayWhatToWrite) {
  EXPECT_THAT(
      [] { parse_si("0.02 m", dim::time); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("is a length"), HasSubstr("a time is needed"), HasSubstr("0.02 s"))));
  EXPECT_THAT([] { parse_si("29.3", dim::stiffness); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("has no unit"), HasSubstr("29.3 kN/m"))));
  EXPECT_THAT([] { parse_si("3 knotts", dim::velocity); },
              ThrowsMessage<InputError>(HasSubstr("did you mean \"knots\"")));
  EXPECT_THAT([] { parse_si("nan m", dim::length); }, ThrowsMessage<InputError>(HasSubstr("not a finite number")));
  EXPECT_THAT([] { parse_si("deep", dim::length); },
              ThrowsMessage<InputError>(HasSubstr("does not begin with a number")));
  EXPECT_THROW(parse_si("3 m/", dim::length), InputError);
}

TEST(Vectors, KeepTheOrderOfPlusMinus) {
  EXPECT_EQ(parse_vector("(0, 0, 1.31) m", dim::length), Eigen::Vector3d(0, 0, 1.31));
  const auto both = parse_vectors("(±5.2, ±5.2, 0) m", dim::length);
  ASSERT_EQ(both.size(), 4u);
  EXPECT_EQ(both[0], Eigen::Vector3d(5.2, 5.2, 0));
  EXPECT_EQ(both[1], Eigen::Vector3d(-5.2, 5.2, 0));
  EXPECT_EQ(both[3], Eigen::Vector3d(-5.2, -5.2, 0));
  EXPECT_THROW(parse_vector("(1, 2) m", dim::length), InputError);
  EXPECT_THROW(parse_vector("(1, 2, 3, 4) m", dim::length), InputError);
  EXPECT_THROW(parse_vector("(1, 2, 3) kg", dim::length), InputError);
}

TEST(Ranges, IncludeBothEnds) {
  const auto t = parse_range("2 s .. 8 s, 61 values", dim::time);
  ASSERT_EQ(t.size(), 61u);
  EXPECT_DOUBLE_EQ(t.front(), 2);
  EXPECT_DOUBLE_EQ(t.back(), 8);
  EXPECT_DOUBLE_EQ(t[1], 2.1);
  EXPECT_THROW(parse_range("8 s .. 2 s, 61 values", dim::time), InputError);
  EXPECT_THROW(parse_range("2 s .. 8 s", dim::time), InputError);
}

TEST(Dimensions, NameThemselves) {
  EXPECT_EQ(dim::stiffness.name(), "a stiffness");
  EXPECT_EQ((dim::force / dim::angle).si(), "kg m/s^2/rad");
}

}  // namespace
}  // namespace units_test
