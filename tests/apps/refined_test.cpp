// Frequencies put where responses bend, and responses over the slope of the wave.
#include "answers/refined.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "answers/linear_response.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace refined_test {
namespace {

using namespace froude;

/// An oscillator of natural frequency one whose peak is as wide as its damping ratio, and a signal that turns with the
/// way to x = 30 m, in two headings.
std::complex<double> oscillator(double omega, double damping) {
  return 1.0 / std::complex<double>(1 - omega * omega, 2 * damping * omega);
}
std::vector<ComplexSignal> exact(const std::vector<double>& omega, double damping) {
  std::vector<ComplexSignal> out{{"sharp", "m/m", "", {}}, {"far", "rad/m", "", {}}};
  for (const double gain : {1.0, -0.5})
    for (const double w : omega) {
      out[0].values.push_back(gain * oscillator(w, damping));
      out[1].values.push_back(gain * std::polar(0.01, -w * w / 9.81 * 30));
    }
  return out;
}

/// Responses read as straight lines.
std::complex<double> read(const Refined& r, std::size_t signal, std::size_t heading, double omega) {
  const auto high =
      static_cast<std::size_t>(std::upper_bound(r.omega.begin() + 1, r.omega.end() - 1, omega) - r.omega.begin());
  const double share = (omega - r.omega[high - 1]) / (r.omega[high] - r.omega[high - 1]);
  const auto* values = &r.signals[signal].values[heading * r.omega.size()];
  return (1 - share) * values[high - 1] + share * values[high];
}

// The bend in the middle is four times what halves leave only where a response is a parabola; twice that is allowed
// for.
TEST(Refined, StraightLinesBetweenFrequenciesAreWithinTheAccuracyOfThePeak) {
  constexpr double accuracy = 1e-2, damping = 1e-3;
  const Refined r = refined({0.3, 0.6, 0.9, 1.2, 1.5}, 2, accuracy,
                            [](const std::vector<double>& omega) { return exact(omega, damping); });
  EXPECT_LT(r.omega.size(), 400u);
  EXPECT_TRUE(std::is_sorted(r.omega.begin(), r.omega.end()));
  const double peak[] = {1 / (2 * damping), 0.01};
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_LE(r.error[s], accuracy / 4);
    for (std::size_t h = 0; h < 2; ++h)
      for (int i = 0; i <= 20000; ++i) {
        const double omega = 0.3 + 1.2 * i / 20000;
        const auto true_value = exact({omega}, damping)[s].values[h];
        ASSERT_LT(std::abs(read(r, s, h, omega) - true_value), 2 * std::max(r.error[s], accuracy / 4) * peak[s])
            << s << " " << h << " at " << omega;
      }
  }
  double largest = 0;
  for (const auto& v : r.signals[0].values) largest = std::max(largest, std::abs(v));
  EXPECT_NEAR(largest, peak[0], accuracy * peak[0]) << "the grid of five frequencies had cut it";
}

TEST(Refined, RefusesAMotionWithoutDamping) {
  EXPECT_THAT(
      [] {
        refined({0.35, 1.45}, 2, 1e-2, [](const std::vector<double>& w) { return exact(w, 1e-12); });
      },
      testing::ThrowsMessage<hydro::NumericsError>(testing::HasSubstr("too sharp")));
}

// θ/(kζ), in deep water k = ω²/g; loads stay per metre.
TEST(Refined, RotationsAreOverTheSlopeOfTheWave) {
  Responses r;
  r.omega = {0.5, 1.0};
  r.heading = {0, 1};
  const std::string per_metre = "what it is per metre of wave amplitude";
  r.signals = {{"pitch", "rad/m", per_metre, {0.1, 0.2, 0.3, 0.4}},
               {"heave", "m/m", per_metre, {1, 2, 3, 4}},
               {"force", "N/m", per_metre, {5, 6, 7, 8}}};
  const hydro::Water water;
  const Responses over = over_wave_slope(r, water);
  for (std::size_t i = 0; i < 4; ++i) {
    const double k = hydro::waves::wavenumber(r.omega[i % 2], water);
    EXPECT_NEAR(over.signals[0].values[i].real(), r.signals[0].values[i].real() / k, 1e-12);
    EXPECT_EQ(over.signals[1].values[i], r.signals[1].values[i]);
    EXPECT_EQ(over.signals[2].values[i], r.signals[2].values[i]);
  }
  EXPECT_EQ(over.signals[0].units, "1");
  EXPECT_EQ(over.signals[0].long_name, "what it is over the slope of the wave");
  EXPECT_EQ(over.signals[1].units, "1");
  EXPECT_EQ(over.signals[2].units, "N/m");
}

}  // namespace
}  // namespace refined_test
