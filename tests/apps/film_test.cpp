// Films as data of a fit: frames at their own times, and what [camera] refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "answers/camera_track.hpp"
#include "answers/scene_runs.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/refused.hpp"
#include "support/scratch.hpp"
#include "support/source_dir.hpp"

namespace film_test {
namespace {

using froude::MeasuredRun;
using support::refused;
using testing::AllOf;
using testing::HasSubstr;
namespace scene = froude::scene;

std::vector<double> even(int frames) {
  std::vector<double> out;
  for (int i = 0; i < frames; ++i) out.push_back(0.04 * i);
  return out;
}

TEST(Film, WithLostFramesIsEvenButForGaps) {
  std::vector<double> time = even(60);
  time.erase(time.begin() + 20, time.begin() + 23);
  for (double& t : time) t = 1e-4 * std::round(1e4 * t) + (t > 1 ? 2e-4 : 0);  // as files round
  const auto run = MeasuredRun::of_uneven(time, Eigen::MatrixXd::Zero(57, 1), 0.8);
  EXPECT_NEAR(run.step, 0.04, 1e-5);
  EXPECT_EQ(run.at[20], 23);
  EXPECT_EQ(run.first, (std::vector<Eigen::Index>{0, 20, 37}));  // frames that are lost make a window's rows fewer
  EXPECT_EQ(run.begin, (std::vector<Eigen::Index>{0, 20, 40}));
  EXPECT_EQ(run.rows(1), 17);
  EXPECT_EQ(run.run_length(0), 20);
  EXPECT_EQ(run.run_samples(1), 20);
  std::vector<double> sequence;
  for (int i = 0; i < 20; ++i) sequence.push_back(i);
  const Eigen::VectorXd told = run.told(1, sequence);
  EXPECT_EQ(told[0], 3) << "the frame after the gap is the fourth sample of its window";
}

TEST(Film, OfUnevenFramesIsBetweenTheRunsSamples) {
  std::vector<double> time = even(50);
  for (std::size_t i = 1; i < 50; ++i) time[i] += 0.009 * std::sin(2.3 * static_cast<double>(i));
  const auto run = MeasuredRun::of_uneven(time, Eigen::MatrixXd::Zero(50, 1), 0);
  const double omega = 0.3 / run.step;
  std::vector<double> wave;
  for (Eigen::Index i = 0; i < run.run_samples(0); ++i)
    wave.push_back(std::cos(omega * run.step * static_cast<double>(i)));
  const Eigen::VectorXd told = run.told(0, wave);
  for (std::size_t i = 0; i < 50; ++i)
    EXPECT_NEAR(told[static_cast<Eigen::Index>(i)], std::cos(omega * time[i]), 0.024 * std::pow(0.3, 6));  // (F102)
}

TEST(Film, BeginsWhereTheRunDoesWhetherOrNotAFrameWasTakenThen) {
  std::vector<double> time = even(60);
  for (double& t : time) t += 0.013;  // [camera] from lies a third of a period before the first frame
  const auto run = MeasuredRun::of_uneven(time, Eigen::MatrixXd::Zero(60, 1), 0);
  EXPECT_NEAR(run.at[0], 0.013 / 0.04, 1e-9);
  std::vector<double> wave;
  for (Eigen::Index i = 0; i < run.run_samples(0); ++i) wave.push_back(std::cos(3 * run.step * static_cast<double>(i)));
  const Eigen::VectorXd told = run.told(0, wave);
  for (std::size_t i = 0; i < 60; ++i)
    EXPECT_NEAR(told[static_cast<Eigen::Index>(i)], std::cos(3 * time[i]), 1e-6) << i;
}

TEST(Film, RefusesAWindowWithoutFrames) {
  std::vector<double> time = even(100);
  time.erase(time.begin() + 22, time.begin() + 38);
  EXPECT_THAT(refused([&] { MeasuredRun::of_uneven(time, Eigen::MatrixXd::Zero(84, 1), 0.8); }),
              AllOf(HasSubstr("the window from 0.8 s on has 4 samples"), HasSubstr("longer windows")));
}

TEST(Film, BesideAnotherKeepsItsWeights) {
  Eigen::Matrix2d first, second;
  first << 1, 0, -0.5, 1.2;
  second << 1, 0, 0.3, 1.1;
  const auto film = [](const Eigen::Matrix2d& whitening, double angle, double place, int frames) {
    std::vector<double> time = even(frames);
    auto out = MeasuredRun::of_uneven(time, Eigen::MatrixXd::Zero(frames, 2), 0);
    out.deviations = {angle, place};
    out.whitening.assign(time.size(), whitening);
    return out;
  };
  MeasuredRun a = film(first, 0.001, 0.02, 30), b = film(second, 0.003, 0.01, 60);
  froude::share_deviations({&a, &b});
  EXPECT_EQ(a.deviations, b.deviations);
  EXPECT_NEAR(a.deviations[0], std::sqrt((30 * 1e-6 + 60 * 9e-6) / 90), 1e-15);
  // The same error is as many independent ones as before.
  const Eigen::Vector2d error(0.002, -0.015), shared(a.deviations[0], a.deviations[1]);
  EXPECT_LT((a.whitening[7] * error.cwiseQuotient(shared) - first * Eigen::Vector2d(2, -0.75)).norm(), 1e-14);
  EXPECT_LT((b.whitening[7] * error.cwiseQuotient(shared) - second * Eigen::Vector2d(2.0 / 3, -1.5)).norm(), 1e-14);
}

/// The example of a foreign track with one text in place of another, and what reading it says.
std::string told(const std::string& old, const std::string& now) {
  const auto folder = froude_test::source_dir() / "examples/fit";
  std::string text = hydro::io::read_text(folder / "film_track.toml");
  const auto at = text.find(old);
  if (at == std::string::npos) return "the example has no " + old;
  text.replace(at, old.size(), now);
  return refused([&] {
    const auto fit = scene::parse_fit(text, folder / "film_track.toml");
    const auto& model = fit.model<scene::MotionModel>();
    const auto places = froude::track_in_plane(fit, model, model.records.at(0)).places;
    ::fit::camera::channels_of(places, froude::channels_asked(model, *model.camera));
  });
}

TEST(Film, SaysWhatTheSceneLacks) {
  EXPECT_EQ(told("2 deg", "2 deg"), "nothing was refused");
  EXPECT_THAT(told("units = { time = \"s\", position = \"px\" }", ""),
              HasSubstr("in which units are the columns t, pivot_x"));
  EXPECT_THAT(told("units = { time = \"s\", position = \"px\" }", "units = { position = \"px\" }"),
              AllOf(HasSubstr("the columns t?"), HasSubstr("units = { time = \"s\" }")));
  EXPECT_THAT(told("distance = { between = [\"pivot\", \"joint\"], is = \"0.5 m\" }", ""),
              HasSubstr("does not say how long one is"));
  EXPECT_THAT(told("deviation = \"0.4 px\"", ""), HasSubstr("the track tells no errors of marker \"pivot\""));
  EXPECT_THAT(told("deviation = \"0.4 px\"", "deviation = \"1 mm\""), HasSubstr("another unit than the track"));
  EXPECT_THAT(told("[\"joint\", \"bob\"]", "[\"joint\", \"bobb\"]"),
              AllOf(HasSubstr("no marker \"bobb\""), HasSubstr("did you mean \"bob\"?")));
  EXPECT_THAT(told("[\"joint\", \"bob\"]", "[\"joint\"]"), HasSubstr("must name two markers"));
  EXPECT_THAT(told("position = \"px\"", "position = \"mm\""),
              HasSubstr("another unit than the track, which is in metres"));
  EXPECT_THAT(told("pivot = \"pivot\"", "pivot = \"(640, 120\""), HasSubstr("neither a marker nor a point"));
  EXPECT_THAT(told("channels = { time = \"t\" }", ""), HasSubstr("when frames were taken"));
  EXPECT_THAT(told("rotation = \"2 deg\"", "frame_rate = \"25 Hz\""),
              HasSubstr("a column of time, and [camera] a frame rate"));
  EXPECT_THAT(told("rotation = \"2 deg\"", "from = \"20 s\""), HasSubstr("it has 0 frames"));
  EXPECT_THAT(told("rotation = \"2 deg\"", "axis = \"z\""), HasSubstr("axis"));
  EXPECT_THAT(told("{ between = [\"joint\", \"bob\"], of = \"chain.link2.polar\" }",
                   "{ marker = \"bob\", along = \"y\", of = \"chain.node2.y\" }"),
              HasSubstr("does not lie in the picture"));
  EXPECT_THAT(told("{ between = [\"joint\", \"bob\"], of", "{ column = \"bob_x\", deviation = \"1 deg\", of"),
              HasSubstr("with [camera] the files are tracks"));
  EXPECT_THAT(told("[camera]",
                   "[camera.lens]\nwidth = 640\nheight = 480\nfocal_x = 600\nfocal_y = 600\nprincipal_x = "
                   "320\nprincipal_y = 240\nk1 = -2\n[camera]"),
              HasSubstr("folds the picture"));
}

}  // namespace
}  // namespace film_test
