#include "fit/camera/assign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "support/refused.hpp"

namespace camera_assign_test {
namespace {

using fit::camera::assign;
using fit::camera::AssignOptions;
using fit::camera::Frame;
using fit::camera::Sighting;
using support::refused;
using testing::AllOf;
using testing::HasSubstr;

TEST(LeastAssignment, IsTheLeastOfAllPermutations) {
  const hydro::RandomStream random(4, 17);
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    const Eigen::Index n = 2 + static_cast<Eigen::Index>(trial % 4), m = n + static_cast<Eigen::Index>(trial % 3);
    Eigen::MatrixXd cost(n, m);
    for (Eigen::Index i = 0; i < cost.size(); ++i)
      cost.data()[i] = random.uniform(100 * trial + static_cast<std::uint64_t>(i));
    std::vector<Eigen::Index> order(static_cast<std::size_t>(m));
    std::iota(order.begin(), order.end(), 0);
    double least = 1e9;
    do {
      double sum = 0;
      for (Eigen::Index i = 0; i < n; ++i) sum += cost(i, order[static_cast<std::size_t>(i)]);
      least = std::min(least, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    const auto found = fit::camera::least_assignment(cost);
    double sum = 0;
    for (Eigen::Index i = 0; i < n; ++i) sum += cost(i, static_cast<Eigen::Index>(found[static_cast<std::size_t>(i)]));
    EXPECT_NEAR(sum, least, 1e-12);
    EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()).size(), found.size());
  }
}

/// Two markers that cross each other in every swing, 5 px apart when they do.
Eigen::Vector2d crossing(int m, double t) { return {320 + (m == 0 ? -1 : 1) * 150 * std::cos(3 * t), 200 + 5.0 * m}; }

/// A link of 40 px that swings fast.
Eigen::Vector2d link(int m, double t) {
  const double a = 1.2 * std::sin(8 * t);
  return Eigen::Vector2d(300, 100) + (m == 0 ? 0 : 40) * Eigen::Vector2d(std::sin(a), std::cos(a));
}

constexpr double noise = 0.2;

/// What is found of these places, in an order that changes from frame to frame.
template <class Place>
std::vector<Frame> film(int frames, int markers, Place place, std::uint64_t seed = 1) {
  const hydro::RandomStream random(seed, 23);
  std::vector<Frame> out;
  std::uint64_t i = 0;
  for (int k = 0; k < frames; ++k) {
    Frame f{k / 50.0, {}};
    for (int m = 0; m < markers; ++m, i += 2)
      f.found.push_back({place(m, f.time) + noise * Eigen::Vector2d(random.normal(i), random.normal(i + 1)),
                         noise * noise * Eigen::Matrix2d::Identity()});
    std::rotate(f.found.begin(), f.found.begin() + k % markers, f.found.end());
    out.push_back(std::move(f));
  }
  return out;
}

/// Frames in which a marker was given a place that is not its own.
template <class Place>
int wrong(const fit::camera::Track& track, Place place) {
  int out = 0;
  for (std::size_t m = 0; m < track.markers.size(); ++m)
    for (std::size_t i = 0; i < track.frames(); ++i)
      if (const auto& s = track.markers[m].seen[i])
        out += (s->at - place(static_cast<int>(m), track.time[i])).norm() > 6 * noise;
  return out;
}

TEST(Assignment, FollowsMarkersThroughTheirCrossings) {
  const auto found = assign(film(400, 2, crossing), {.names = {"left", "right"}});
  EXPECT_EQ(wrong(found.track, crossing), 0);
  EXPECT_EQ(found.missing, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(found.left_over, 0u);
  EXPECT_EQ(found.sightings, 800u);
}

/// Two balls that swing towards each other, touch at so many pixels and turn back, again and again: of 25 frames a
/// second, since it goes twice as fast as films here are told.
struct TurningBack {
  double gap, phase;
  Eigen::Vector2d operator()(int m, double t) const {
    return {320 + (m == 0 ? -1 : 1) * (gap / 2 + std::abs(150 * std::cos(std::numbers::pi * t + phase))), 240};
  }
};

// The predictions say that they pass each other. A name is given where it is certain, and that is the right one.
TEST(Assignment, OfMarkersThatTurnBackIsLeftOutWhereNamesMayBeExchanged) {
  int left_out = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const hydro::RandomStream random(seed, 5);
    const TurningBack place{24 + 6 * random.uniform(0), random.uniform(1)};
    const auto out = assign(film(100, 2, place, seed), {.names = {"a", "b"}});
    EXPECT_EQ(wrong(out.track, place), 0) << seed;
    left_out += !out.alike.empty();
  }
  EXPECT_GT(left_out, 0);
}

TEST(Assignment, LeavesAGapWhereAMarkerIsHiddenAndTakesItUpAgain) {
  auto frames = film(400, 2, crossing);
  for (std::size_t i = 100; i < 110; ++i)
    std::erase_if(frames[i].found, [&](const Sighting& s) { return (s.at - crossing(1, frames[i].time)).norm() < 3; });
  const auto found = assign(frames, {.names = {"left", "right"}});
  EXPECT_EQ(wrong(found.track, crossing), 0);
  EXPECT_EQ(found.missing, (std::vector<std::size_t>{0, 10}));
  EXPECT_TRUE(found.track.markers[1].seen[110]);
}

TEST(Assignment, GivesAHiddenMarkerThatMayBeAnywhereNoDiscOfItsNeighbour) {
  auto frames = film(300, 2, link);
  for (std::size_t i = 150; i < 165; ++i)
    std::erase_if(frames[i].found, [&](const Sighting& s) { return (s.at - link(1, frames[i].time)).norm() < 3; });
  const auto found = assign(frames, {.names = {"pivot", "bob"}, .order = AssignOptions::Order::top_to_bottom});
  EXPECT_EQ(wrong(found.track, link), 0);
  EXPECT_EQ(found.missing, (std::vector<std::size_t>{0, 15}));
}

TEST(Assignment, LeavesFalseOnesOver) {
  auto frames = film(300, 2, crossing);
  const hydro::RandomStream random(9, 2);
  for (std::size_t i = 1; i < frames.size(); ++i)
    for (std::uint64_t k = 0; k < 3; ++k)
      frames[i].found.push_back({{640 * random.uniform(10 * i + 2 * k), 300 + 180 * random.uniform(10 * i + 2 * k + 1)},
                                 0.04 * Eigen::Matrix2d::Identity()});
  const auto found = assign(frames, {.names = {"left", "right"}});
  EXPECT_EQ(wrong(found.track, crossing), 0);
  EXPECT_EQ(found.left_over, 3u * 299u);
}

TEST(Assignment, KnownLengthRefusesAFalseOneThatPredictionsWouldTake) {
  auto frames = film(300, 2, link);
  // While the bob is hidden, something shines near where it is expected, but at another distance from the pivot.
  for (std::size_t i = 150; i < 153; ++i) {
    std::erase_if(frames[i].found, [&](const Sighting& s) { return (s.at - link(1, frames[i].time)).norm() < 3; });
    const Eigen::Vector2d away = (link(1, frames[i].time) - link(0, 0)).normalized();
    frames[i].found.push_back({link(1, frames[i].time) + 5 * away, 0.04 * Eigen::Matrix2d::Identity()});
  }
  const AssignOptions plain{.names = {"pivot", "bob"}, .order = AssignOptions::Order::top_to_bottom};
  AssignOptions held = plain;
  held.lengths = {{"pivot", "bob", 40, 0.2}};
  EXPECT_GT(wrong(assign(frames, plain).track, link), 0) << "or the length would not be what tells";
  const auto found = assign(frames, held);
  EXPECT_EQ(wrong(found.track, link), 0);
  EXPECT_EQ(found.missing[1], 3u);
}

TEST(Assignment, KnownLengthCountsFromWhereAMarkerIsExpectedWhileItIsNotSeen) {
  auto frames = film(300, 2, link);
  for (std::size_t i = 150; i < 165; ++i)
    std::erase_if(frames[i].found, [&](const Sighting& s) { return (s.at - link(1, frames[i].time)).norm() < 3; });
  // The pivot is hidden too, and something shines beside it while the bob may be anywhere.
  frames[160].found = {{link(0, 0) + Eigen::Vector2d(0, 15), 0.04 * Eigen::Matrix2d::Identity()}};
  const AssignOptions plain{.names = {"pivot", "bob"}, .order = AssignOptions::Order::top_to_bottom};
  AssignOptions held = plain;
  held.lengths = {{"pivot", "bob", 40, 0.2}};
  EXPECT_TRUE(assign(frames, plain).track.markers[1].seen[160]) << "or the length would not be what tells";
  const auto found = assign(frames, held);
  EXPECT_EQ(wrong(found.track, link), 0);
  EXPECT_EQ(found.missing, (std::vector<std::size_t>{1, 15}));
}

TEST(Assignment, SaysWhatToDo) {
  auto frames = film(20, 2, crossing);
  const auto told = [&](const AssignOptions& options) { return refused([&] { assign(frames, options); }); };
  EXPECT_THAT(told({.names = {"a", "b", "c"}}),
              AllOf(HasSubstr("first frame has 2 markers"), HasSubstr("3 are named"), HasSubstr("--radius")));
  EXPECT_THAT(told({.names = {"a"}}), AllOf(HasSubstr("2 bright places, 1 markers are named"), HasSubstr("--first")));
  EXPECT_THAT(told({.names = {"a", "b"}, .first = {{100, 200}, {101, 200}}}), HasSubstr("nearest to one place"));
  EXPECT_THAT(told({.names = {"a", "b"}, .first = {{175, 195}, {10, 400}}}),
              AllOf(HasSubstr("first place of \"b\", (10, 400)"), HasSubstr("--picture")));
  EXPECT_THAT(told({.names = {"a", "b"}, .lengths = {{"a", "x", 1, 0.1}}}), HasSubstr("there is no marker \"x\""));
  EXPECT_THAT(told({.names = {"a", "b"}, .lengths = {{"a", "b", 1, 1}}}),
              HasSubstr("is no smaller than the length itself"));
  frames[7].time = frames[6].time;
  EXPECT_THAT(told({.names = {"a", "b"}}), AllOf(HasSubstr("frame 8"), HasSubstr("--frame-rate")));
  frames = film(20, 2, [](int m, double) { return Eigen::Vector2d(100 * m, 50); });
  EXPECT_THAT(told({.names = {"a", "b"}}), HasSubstr("nothing moves in this film"));
}

TEST(Assignment, TakesTheFirstPlacesThatAreGiven) {
  auto frames = film(50, 2, crossing);
  frames[0].found.push_back({{600, 20}, 0.04 * Eigen::Matrix2d::Identity()});
  const auto found = assign(frames, {.names = {"right", "left"}, .first = {{465, 210}, {175, 195}}});
  EXPECT_EQ(wrong(found.track, [](int m, double t) { return crossing(1 - m, t); }), 0);
}

}  // namespace
}  // namespace camera_assign_test
