// Markers that are no discs, from a film in a file to a track in a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "fit/camera/render.hpp"
#include "fit/camera/track_file.hpp"
#include "froude/film/commands.hpp"
#include "froude/film/markers.hpp"
#include "support/refused.hpp"
#include "support/scratch.hpp"

namespace markers_test {
namespace {

namespace fc = fit::camera;
namespace ff = froude::film;
using support::refused;
using testing::AllOf;
using testing::HasSubstr;

constexpr int frames = 30;
const Eigen::Vector2i size(320, 240);

Eigen::Vector2d place(int m, int frame) {
  const double t = frame / 25.0;
  return {160 + (m == 0 ? 70 : -70) * std::cos(2 * t), (m == 0 ? 70 : 170) + 15 * std::sin(3 * t + m)};
}

fc::Filming camera(double noise) {
  fc::Filming out;
  out.view.metres_per_pixel = 1e-3;
  out.size = size;
  out.noise = noise;
  return out;
}

/// Light with both tags at their places, turning, 40 px wide and more: samples of the drawn tag, meaned over pixels.
fc::Light light_of_tags(const ff::TagReader& tags, int frame) {
  constexpr int cell = 16, across = 4;
  fc::Light out = fc::Light::Constant(size.y(), size.x(), 180);
  for (int m = 0; m < 2; ++m) {
    const fc::Picture drawn = tags.drawn(m == 0 ? 3 : 7, cell);
    const double scale = drawn.width / 56.0, turn = 0.02 * frame * (m == 0 ? 1 : -1);
    const Eigen::Vector2d middle((drawn.width - 1) / 2.0, (drawn.height - 1) / 2.0), at = place(m, frame);
    Eigen::Matrix2d to_tag;
    to_tag << std::cos(turn), std::sin(turn), -std::sin(turn), std::cos(turn);
    to_tag *= scale;
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) {
        if ((Eigen::Vector2d(x, y) - at).norm() > 45) continue;
        double sum = 0;
        for (int i = 0; i < across; ++i)
          for (int j = 0; j < across; ++j) {
            const Eigen::Vector2d off((i + 0.5) / across - 0.5, (j + 0.5) / across - 0.5);
            const Eigen::Vector2d p = (middle + to_tag * (Eigen::Vector2d(x, y) + off - at)).array().round();
            const bool outside = p.minCoeff() < 0 || p.x() > drawn.width - 1 || p.y() > drawn.height - 1;
            sum += outside ? double(out(y, x)) : 20 + 0.75 * drawn.at(static_cast<int>(p.x()), static_cast<int>(p.y()));
          }
        out(y, x) = static_cast<float>(sum / (across * across));
      }
  }
  return out;
}

/// rms of places against where they were filmed, px, and how often a marker was seen.
std::pair<double, int> error_of(const fc::Track& track) {
  double squares = 0;
  int seen = 0;
  for (int m = 0; m < 2; ++m)
    for (int i = 0; i < frames; ++i) {
      const auto& s = track.markers[static_cast<std::size_t>(m)].seen[static_cast<std::size_t>(i)];
      if (!s) continue;
      squares += (s->at - place(m, i)).squaredNorm();
      ++seen;
    }
  return {std::sqrt(squares / seen), seen};
}

TEST(Markers, ThatAreTagsAreKnownByTheirNumbers) {
  if (ff::tag_families().empty()) GTEST_SKIP() << "OpenCV has no module aruco here";
  const auto film = support::scratch_folder() / "tags.avi", track = support::scratch_folder() / "tags.csv";
  const ff::TagReader tags("apriltag 36h11");
  {
    ff::FilmWriter writer(film, size, 25);
    for (int i = 0; i < frames; ++i)
      writer.add(exposed(camera(4), light_of_tags(tags, i), static_cast<std::uint64_t>(i)));
  }
  std::ostringstream out, err;
  froude::TrackArguments a{.film = film, .markers = "right = 3, left = 7", .tags = "apriltag 36h11", .output = track};
  froude::track(a, {out, err});
  const auto [rms, seen] = error_of(fc::read_track(track, {.time = "t"}));
  EXPECT_LT(rms, 0.1);
  EXPECT_EQ(seen, 2 * frames);
  EXPECT_THAT(out.str(), HasSubstr("tags of apriltag 36h11"));
  const auto told = [&](const std::string& markers, const std::string& family) {
    a.markers = markers;
    a.tags = family;
    return refused([&] { froude::track(a, {out, err}); });
  };
  EXPECT_THAT(told("right = 3, left = 9", "apriltag 36h11"), HasSubstr("the tag of \"left\" is in no frame"));
  EXPECT_THAT(told("right, left", "apriltag 36h11"), HasSubstr("does not say which tag \"right\" is"));
  EXPECT_THAT(told("right = 3, left = 3", "apriltag 36h11"), HasSubstr("names tag 3 twice"));
  EXPECT_THAT(told("right = 600", "apriltag 36h11"), HasSubstr("its tags are 0 to 586"));
  EXPECT_THAT(told("right = 3", "apriltag"), AllOf(HasSubstr("no family"), HasSubstr("apriltag 36h11")));
}

/// Both markers as discs on stickers.
fc::Picture discs(int i) {
  const fc::Filming filming = camera(4);
  const auto places = [i](double) {
    return std::vector<Eigen::Vector2d>{point_of(camera(0).view, place(0, i)), point_of(camera(0).view, place(1, i))};
  };
  return exposed(filming, light_of(filming, places, 0), static_cast<std::uint64_t>(i));
}

TEST(Markers, ThatAreInNoneOfSomeFramesAreGapsAndTheFirstOfThemIsNamed) {
  const auto film = support::scratch_folder() / "dark.avi", track = support::scratch_folder() / "dark.csv";
  {
    ff::FilmWriter writer(film, size, 25);
    for (int i = 0; i < frames; ++i) {
      fc::Picture picture = discs(i);
      if (i >= 10 && i < 13)  // somebody walks before the lamp
        for (auto& grey : picture.grey) grey = static_cast<std::uint8_t>(grey / 12);
      writer.add(picture);
    }
  }
  std::ostringstream out, err;
  froude::track({.film = film, .markers = "left, right", .output = track}, {out, err});
  EXPECT_THAT(out.str(),
              AllOf(HasSubstr("no marker in 3 of 30 frames, the first of them frame 11"), HasSubstr("--contrast")));
  const fc::Track found = fc::read_track(track, {.time = "t"});
  for (const auto& marker : found.markers) {
    EXPECT_FALSE(marker.seen[11]);
    EXPECT_TRUE(marker.seen[13]);
  }
}

TEST(Markers, LikeATemplateAreFollowed) {
  const auto film = support::scratch_folder() / "like.avi", track = support::scratch_folder() / "like.csv",
             pattern = support::scratch_folder() / "pattern.png";
  {
    ff::FilmWriter writer(film, size, 25);
    for (int i = 0; i < frames; ++i) writer.add(discs(i));
  }
  // Cut out of the first frame, as a user would: its middle is where the marker is to half a pixel only.
  const fc::Picture first = discs(0);
  const Eigen::Vector2i at = place(0, 0).array().round().cast<int>();
  fc::Picture cut(31, 31);
  for (int y = 0; y < 31; ++y)
    for (int x = 0; x < 31; ++x) cut.row(y)[x] = first.at(at.x() - 15 + x, at.y() - 15 + y);
  ff::write_picture(pattern, cut);
  std::ostringstream out, err;
  froude::TrackArguments a{.film = film, .markers = "left, right", .pattern = pattern, .output = track};
  froude::track(a, {out, err});
  fc::Track found = fc::read_track(track, {.time = "t"});
  std::swap(found.markers[0], found.markers[1]);
  const Eigen::Vector2d off = place(0, 0) - at.cast<double>();  // what the cut itself is off by
  for (auto& marker : found.markers)
    for (auto& s : marker.seen)
      if (s) s->at += off;
  const auto [rms, seen] = error_of(found);
  EXPECT_LT(rms, 0.1);
  EXPECT_EQ(seen, 2 * frames);
  EXPECT_THAT(out.str(), HasSubstr("places like pattern.png"));
  a.likeness = 0.999;  // of the piece itself, in the first frame alone
  EXPECT_THAT(refused([&] { froude::track(a, {out, err}); }), HasSubstr("the first frame has 1 marker"));
}

}  // namespace
}  // namespace markers_test
