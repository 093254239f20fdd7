#include "hydro/base/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace random_test {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Known answers published with the generator (Random123 1.x, kat_vectors, philox 4x32 10).
TEST(Philox, GivesItsPublishedKnownAnswers) {
  EXPECT_EQ(hydro::philox4x32({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(hydro::philox4x32({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(hydro::philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, HasTheMomentsItPromises) {
  const hydro::RandomStream stream(7, 3);
  constexpr int n = 100000;
  double mean_u = 0, mean_n = 0, variance_n = 0, kurtosis = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double z = stream.normal(i);
    mean_u += stream.uniform(i) / n;
    mean_n += z / n;
    variance_n += z * z / n;
    kurtosis += z * z * z * z / n;
  }
  // Five standard errors of each estimate: sqrt(1/12n), 1/sqrt(n), sqrt(2/n), sqrt(96/n).
  EXPECT_NEAR(mean_u, 0.5, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(mean_n, 0.0, 5 / std::sqrt(n));
  EXPECT_NEAR(variance_n, 1.0, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(kurtosis, 3.0, 5 * std::sqrt(96.0 / n));
}

TEST(RandomStream, SeparatesSeedsAndStreams) {
  EXPECT_NE(hydro::RandomStream(1, 0).uniform(5), hydro::RandomStream(2, 0).uniform(5));
  EXPECT_NE(hydro::RandomStream(1, 0).uniform(5), hydro::RandomStream(1, 1).uniform(5));
  EXPECT_EQ(hydro::RandomStream(1, 0).uniform(5), hydro::RandomStream(1, 0).uniform(5));
}

}  // namespace
}  // namespace random_test
