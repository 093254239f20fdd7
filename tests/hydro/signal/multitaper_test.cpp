#include "hydro/signal/multitaper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace multitaper_test {
namespace {

using namespace hydro::signal;
using testing::HasSubstr, testing::ThrowsMessage;

double area(const SpectrumPerHz& s) { return moments(s, whole(s)).m0; }

TEST(Multitaper, KeepsTheTaperedVarianceExactly) {
  const auto x = froude_test::ar1_noise(64, 0.5, 2, 1);
  const auto s = multitaper(x, 0.1, 5);
  // Parseval: Σ_k Σ_j v_kj² x_j²/K.
  double sum = 0;
  for (int k = 1; k <= 5; ++k)
    for (int j = 0; j < 64; ++j)
      sum += 2.0 / 65 * std::pow(std::sin(std::numbers::pi * k * (j + 1) / 65), 2) *
             std::pow(x[static_cast<std::size_t>(j)] - s.mean, 2) / 5;
  EXPECT_NEAR(area(s.spectrum), sum, 1e-12 * sum);
}

TEST(Multitaper, ScattersOverWhiteNoiseAsItsDegreesOfFreedomSay) {
  // S = 2σ²Δt; of 400 records one frequency each, S χ²_ν/ν with ν = 2K: mean S, variance S²/K.
  constexpr int records = 400;
  constexpr double level = 2 * 0.5;
  double sum = 0, squares = 0;
  for (int i = 0; i < records; ++i) {
    const double density =
        multitaper(froude_test::ar1_noise(256, 0, 1, static_cast<std::uint64_t>(i)), 0.5, 7).spectrum.density[40];
    sum += density;
    squares += density * density;
  }
  const double mean = sum / records, variance = squares / records - mean * mean;
  EXPECT_NEAR(mean, level, 4 * level / std::sqrt(7.0 * records));                    // four standard errors
  EXPECT_NEAR(variance * 7, 1, 4 * std::sqrt(2.0 / records + 12.0 / 14 / records));  // kurtosis of χ²_14: 12/14
}

TEST(Multitaper, HasTheVarianceOfASineWithinItsBand) {
  std::vector<double> x(1000);
  for (std::size_t j = 0; j < x.size(); ++j)
    x[j] = 3 + 1.5 * std::cos(2 * std::numbers::pi * 0.0713 * static_cast<double>(j));
  const auto s = multitaper(x, 1, 6);
  const double half = s.resolution_hz / 2;
  const auto m = moments(s.spectrum, {.from_hz = 0.0713 - 2 * half, .to_hz = 0.0713 + 2 * half});
  EXPECT_NEAR(m.m0, 1.5 * 1.5 / 2, 0.01 * 1.5 * 1.5 / 2);  // what leaks farther than two half bands is below 1 %
  EXPECT_EQ(s.dof, 12);
}

TEST(Multitaper, NamesWhatIsWrong) {
  const std::vector<double> x(20, 1.0);
  EXPECT_THAT([&] { multitaper(x, 1, 6); }, ThrowsMessage<hydro::InputError>(HasSubstr("takes 1 to 5 tapers, got 6")));
  EXPECT_THAT([&] { multitaper(x, 0, 2); }, ThrowsMessage<hydro::InputError>(HasSubstr("got 0 s")));
}

}  // namespace
}  // namespace multitaper_test
