// Coefficients by KC and Re. (D104), (D105)
#include "dynamics/line/exposure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hydro/base/error.hpp"
#include "support/line_models.hpp"

namespace exposure_test {
namespace {

using namespace support;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Rows = std::vector<CoefficientTable::Row>;
constexpr double g = 9.81, pi = std::numbers::pi;
const hydro::Water deep{.density = 1000, .gravity = g, .depth = hydro::WaterDepth::infinite()};

/// Waves towards +x in deep water: amplitude, ω, phase.
hydro::waves::HarmonicField waves(const std::vector<Vector3d>& list) {
  std::vector<hydro::waves::Harmonic> harmonics;
  for (const Vector3d& w : list) {
    const std::complex<double> E = std::polar(w[0], w[2]);
    harmonics.push_back({w[1], w[1] * w[1] / g, 0, E, std::complex<double>(0, g / w[1]) * E});
  }
  return {harmonics, deep, {.stretching = hydro::waves::Stretching::none}};
}

Places segment(const Vector3d& from, const Vector3d& to) {
  Places out(3, 2);
  out << from, to;
  return out;
}

// u = aω e^{kz}, on circles: the amplitude is the same whichever way the segment lies, and so is the period.
TEST(Exposure, IsAmplitudeAndPeriodOfARegularWave) {
  const double omega = 1.2, a = 0.7, z = -3;
  const auto field = waves({{a, omega, 0.4}});
  const Vector3d middle(5, 2, z);
  for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(0, 1, 0), Vector3d(1, 0, 0), Vector3d(1, 2, 3)}) {
    const Vector3d half = 0.4 * axis.normalized();
    const auto e = exposure(field, segment(middle - half, middle + half), 3, 3 + 10 * 2 * pi / omega);
    EXPECT_NEAR(e[0].velocity, a * omega * std::exp(omega * omega / g * z), 1e-12);
    EXPECT_NEAR(e[0].period, 2 * pi / omega, 1e-11);
    EXPECT_NEAR(e[0].keulegan_carpenter(0.05), e[0].velocity * 2 * pi / omega / 0.05, 1e-9);
    EXPECT_NEAR(e[0].reynolds(0.05, 1e-6), e[0].velocity * 0.05 / 1e-6, 1e-6);
  }
}

// Of many waves: √(2 Σ u²/2) and the zero-crossing period of the velocity, √(Σ u²/Σ ω²u²).
TEST(Exposure, IsThatOfTheRegularWaveOfTheSameSquares) {
  std::vector<Vector3d> list;
  double u2 = 0, a2 = 0;
  for (int i = 1; i <= 12; ++i) {
    const double omega = 2 * pi * (20 + i) / 200, amplitude = 0.1 + 0.01 * i;  // whole numbers of waves in 200 s
    list.emplace_back(amplitude, omega, 0.7 * i * i);
    const double u = amplitude * omega * std::exp(-2 * omega * omega / g);
    u2 += u * u;
    a2 += omega * omega * u * u;
  }
  const auto e = exposure(waves(list), segment({0, 0, -1}, {0, 0, -3}), 0, 200);
  EXPECT_NEAR(e[0].velocity, std::sqrt(u2), 1e-10);
  EXPECT_NEAR(e[0].period, 2 * pi * std::sqrt(u2 / a2), 1e-9);
}

TEST(Exposure, RefusesWhereThereIsNone) {
  const auto field = waves({{1, 1, 0}});
  EXPECT_THAT(
      [&] {
        exposure(field, segment({0, 0, 0.5}, {0, 0, -0.7}), 0, 20);
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("segment 1 is above the water at t =")));
  EXPECT_THAT(
      [&] {
        exposure(waves({}), segment({0, 0, -1}, {0, 0, -2}), 0, 20);
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("no water goes to and fro past segment 1")));
  EXPECT_THAT(
      [&] {
        exposure(field, segment({0, 0, -2}, {0, 0, -3}), 20, 20);
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("20 to 20 s")));
}

// What is straight in both logarithms, product included, comes back exactly.
TEST(CoefficientTable, IsStraightInLogarithms) {
  const auto cd = [](double kc, double re) {
    return 9 - std::log(kc) - 0.3 * std::log(re) + 0.02 * std::log(kc) * std::log(re);
  };
  const auto ca = [](double kc, double re) { return 1 + 0.1 * std::log(kc) + 0.01 * std::log(re); };
  Rows rows;
  for (const double re : {1e4, 3e4, 2e5})
    for (const double kc : {30.0, 2.0, 9.0}) rows.push_back({kc, re, cd(kc, re), ca(kc, re)});
  const CoefficientTable table(rows);
  EXPECT_TRUE(table.knows_reynolds());
  for (const double kc : {2.0, 5.0, 9.0, 30.0})
    for (const double re : {1e4, 2e4, 1e5, 2e5}) {
      // Between points the product of the logarithms is straight in each by itself.
      EXPECT_NEAR(table.at(kc, re).cd, cd(kc, re), 1e-12);
      EXPECT_NEAR(table.at(kc, re).ca, ca(kc, re), 1e-12);
    }
  const CoefficientTable by_kc(Rows{{1, 1, 2, 0.5}, {100, 1, 1, 1.5}});
  EXPECT_FALSE(by_kc.knows_reynolds());
  EXPECT_NEAR(by_kc.at(10, 12345).cd, 1.5, 1e-14);
  EXPECT_NEAR(by_kc.at(10, 0).ca, 1, 1e-14);
}

TEST(CoefficientTable, GuessesNothing) {
  const auto refuses = [](const auto& what, const char* why) {
    EXPECT_THAT(what, ThrowsMessage<hydro::InputError>(HasSubstr(why)));
  };
  const CoefficientTable table(Rows{{2, 1e4, 2, 1}, {9, 1e4, 2, 1}, {2, 1e5, 2, 1}, {9, 1e5, 2, 1}});
  refuses([&] { table.at(1.9, 2e4); }, "KC is 1.9, and the table goes from 2 to 9");
  refuses([&] { table.at(9.1, 2e4); }, "KC is 9.1");
  refuses([&] { table.at(5, 2e5); }, "Re is 2e+05, and the table goes from 1e+04 to 1e+05");
  refuses([&] { table.at(std::nan(""), 2e4); }, "KC is nan");
  refuses(
      [] {
        CoefficientTable(Rows{{2, 1e4, 2, 1}, {9, 1e4, 2, 1}, {2, 1e5, 2, 1}});
      },
      "KC = 9, Re = 100000 is there 0 times");
  refuses([] { CoefficientTable(Rows{{2, 1, 2, 1}, {9, 1, 2, 1}, {2, 1, 3, 1}}); }, "KC = 2 is there 2 times");
  refuses([] { CoefficientTable(Rows{{2, 1, 2, 1}}); }, "two values of KC or more, got 1");
  refuses([] { CoefficientTable(Rows{{0, 1, 2, 1}, {9, 1, 2, 1}}); }, "above 0");
  refuses([] { CoefficientTable(Rows{{2, 1, -2, 1}, {9, 1, 2, 1}}); }, "must not be negative");
}

}  // namespace
}  // namespace exposure_test
