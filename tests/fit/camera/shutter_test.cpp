// Films whose rows are read one after the other, against where markers were at one instant.
#include "fit/camera/shutter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace camera_shutter_test {
namespace {

using fit::camera::of_one_instant;
using fit::camera::Track;

constexpr double readout = 0.02;
constexpr int height = 720;

/// A marker that goes up and down by 200 px at 3 rad/s: 12 px while a frame of 20 ms is read.
Eigen::Vector2d place(double t) { return {640 + 100 * std::cos(2 * t), 360 + 200 * std::sin(3 * t)}; }

/// At 30 Hz, with white noise of that deviation.
Track filmed(double noise) {
  const hydro::RandomStream random(6, 3);
  Track out;
  out.markers.push_back({"m", {}});
  for (std::uint64_t i = 0; i < 300; ++i) {
    const double t = static_cast<double>(i) / 30;
    Eigen::Vector2d at = place(t);
    for (int k = 0; k < 20; ++k) at = place(t + readout * at.y() / height);  // the row at which it is read
    out.time.push_back(t);
    out.markers[0].seen.push_back(
        fit::camera::Sighting{at + noise * Eigen::Vector2d(random.normal(2 * i), random.normal(2 * i + 1)),
                              noise * noise * Eigen::Matrix2d::Identity()});
  }
  return out;
}

TEST(RollingShutter, IsTakenOffAMarkerThatMoves) {
  const Track raw = filmed(0), track = of_one_instant(raw, readout, height);
  for (std::size_t i = 2; i + 1 < track.frames(); ++i) {
    ASSERT_TRUE(track.markers[0].seen[i]);
    // 3/128 h⁴ of the fourth derivative, 81 · 200 px/s⁴, h = 1/30 s: 0.5 mpx; uneven times make it some more.
    EXPECT_LT((track.markers[0].seen[i]->at - place(track.time[i])).norm(), 1e-3);
  }
  double raw_off = 0;
  for (std::size_t i = 0; i < raw.frames(); ++i)
    raw_off = std::max(raw_off, (raw.markers[0].seen[i]->at - place(raw.time[i])).norm());
  EXPECT_GT(raw_off, 5);  // 600 px/s for half of 20 ms are 6 px
}

TEST(RollingShutter, KeepsTheErrorsOfSightings) {
  constexpr double noise = 0.2;
  const Track track = of_one_instant(filmed(noise), readout, height);
  double squares = 0;
  int numbers = 0;
  for (std::size_t i = 2; i + 1 < track.frames(); ++i) {
    const auto& s = *track.markers[0].seen[i];
    const Eigen::Vector2d off = s.at - place(track.time[i]);
    squares += off.x() * off.x() / s.covariance(0, 0) + off.y() * off.y() / s.covariance(1, 1);
    numbers += 2;
  }
  EXPECT_NEAR(squares / numbers, 1, 0.2);  // of some 590 numbers, neighbours alike: a deviation of 0.07
  Track bare = filmed(noise);
  for (auto& s : bare.markers[0].seen) s->covariance = fit::camera::Sighting{}.covariance;
  EXPECT_FALSE(of_one_instant(bare, readout, height).markers[0].seen[10]->has_covariance());
  const Track stated = of_one_instant(bare, readout, height, noise);
  EXPECT_NEAR(stated.markers[0].seen[10]->covariance(1, 1), track.markers[0].seen[10]->covariance(1, 1), 1e-12);
}

TEST(RollingShutter, IsNotLongerThanTheTimeBetweenFrames) {
  EXPECT_THROW(of_one_instant(filmed(0), 0.05, height), hydro::InputError);
  EXPECT_THROW(of_one_instant(filmed(0), 0, height), hydro::InputError);
  EXPECT_THROW(of_one_instant(filmed(0), readout, 0), hydro::InputError);
  Track metres = filmed(0);
  metres.in_metres = true;
  EXPECT_THROW(of_one_instant(metres, readout, height), hydro::InputError);
}

}  // namespace
}  // namespace camera_shutter_test
