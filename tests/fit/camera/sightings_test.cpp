#include "fit/camera/sightings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/random.hpp"

namespace camera_sightings_test {
namespace {

using fit::camera::check_sightings;
using fit::camera::SightingCheck;
using fit::camera::Track;

constexpr double step = 0.04, sd = 4e-4;  // m, of a pixel of a millimetre that is found to 0.4

/// Two bobs that swing at 0.9 and 1.3 Hz, with noise `noisier` times what is stated.
Track filmed(std::uint64_t seed, double noisier = 1, int frames = 150) {
  const hydro::RandomStream random(seed, 71);
  Track out{.time = {}, .markers = {{"joint", {}}, {"bob", {}}}, .in_metres = true};
  std::uint64_t i = 0;
  for (int k = 0; k < frames; ++k) {
    const double t = step * k;
    out.time.push_back(t);
    for (std::size_t m = 0; m < 2; ++m) {
      const double angle = 0.4 * std::sin(2 * std::numbers::pi * (m == 0 ? 0.9 : 1.3) * t), arm = m == 0 ? 0.5 : 0.9;
      const Eigen::Vector2d error(random.normal(i), random.normal(i + 1));
      i += 2;
      out.markers[m].seen.push_back(
          fit::camera::Sighting{arm * Eigen::Vector2d(std::sin(angle), -std::cos(angle)) + noisier * sd * error,
                                sd * sd * Eigen::Matrix2d::Identity()});
    }
  }
  return out;
}

TEST(Sightings, OfACleanFilmFit) {
  int with_misfits = 0, widened = 0, cut = 0;
  constexpr int films = 40;
  for (std::uint64_t k = 1; k <= films; ++k) {
    const SightingCheck check = check_sightings(filmed(k), 4);
    with_misfits += check.misfits.empty() ? 0 : 1;
    for (const auto& m : check.markers) widened += m.factor > 1 ? 1 : 0, cut += m.cut() ? 1 : 0;
  }
  EXPECT_LE(with_misfits, 2);  // one in a hundred: three or more of forty have the probability 0.8 %
  EXPECT_LE(widened, 1);       // one marker in a thousand: two or more of eighty have 0.3 %
  EXPECT_EQ(cut, 0);           // a swing of 1.3 Hz loses 1e-5 of its amplitude
}

TEST(Sightings, ThatAreWrongAreNamed) {
  Track track = filmed(1);
  track.markers[1].seen[99]->at.x() += 0.06;
  const SightingCheck check = check_sightings(track, 4);
  ASSERT_EQ(check.misfits.size(), 1U);
  EXPECT_EQ(check.misfits[0].marker, "bob");
  EXPECT_EQ(check.misfits[0].first, 99U);
  EXPECT_EQ(check.misfits[0].last, 99U);
  EXPECT_NEAR(check.misfits[0].away, 0.06,
              0.008);  // the path is known to some deviations, 0.4 mm each, between two frames
}

TEST(Sightings, OfExchangedNamesAreNamedForBoth) {
  Track track = filmed(2);
  for (std::size_t i = 70; i < 73; ++i) std::swap(track.markers[0].seen[i], track.markers[1].seen[i]);
  const SightingCheck check = check_sightings(track, 4);
  ASSERT_EQ(check.misfits.size(), 2U);
  for (const auto& m : check.misfits) {
    EXPECT_EQ(m.first, 70U) << m.marker;
    EXPECT_EQ(m.last, 72U) << m.marker;
  }
}

TEST(Sightings, WhoseDeviationIsStatedTooSmallWidenIt) {
  const Track track = filmed(3, 8);
  const SightingCheck check = check_sightings(track, 4);
  EXPECT_TRUE(check.misfits.empty());
  for (const auto& m : check.markers) {
    EXPECT_NEAR(m.factor, 8, 2) << m.marker;  // 1.44/sqrt(0.28 150)/2 is 11 %; twice that, and motion
    EXPECT_FALSE(m.cut()) << m.marker;
  }
  EXPECT_NEAR(widened(track, check).markers[0].seen[5]->covariance(0, 0), std::pow(sd * check.markers[0].factor, 2),
              1e-15);
}

TEST(Sightings, TellABandThatCutsTheMotion) {
  for (const auto& m : check_sightings(filmed(4), 0.5).markers) EXPECT_TRUE(m.cut()) << m.marker << ' ' << m.lost;
}

}  // namespace
}  // namespace camera_sightings_test
