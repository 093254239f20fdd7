// Boards and films through OpenCV, on pictures whose truth is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

#include "answers/camera.hpp"
#include "fit/camera/render.hpp"
#include "froude/film/board.hpp"
#include "froude/film/commands.hpp"
#include "froude/film/video.hpp"
#include "hydro/base/random.hpp"
#include "support/refused.hpp"
#include "support/scratch.hpp"

namespace calibrate_test {
namespace {

namespace fc = fit::camera;
namespace ff = froude::film;
using support::refused;
using testing::AllOf;
using testing::HasSubstr;

const fc::Board board{.columns = 9, .rows = 6, .square = 0.03};
const ff::BoardSize board_size{9, 6, 0.03};

fc::Filming camera() {
  fc::Filming out;
  out.view.lens = fc::Lens{.focal = {600, 604},
                           .principal = {325, 236},
                           .radial = {-0.15, 0.06, 0},
                           .tangential = {0, 0},
                           .size = {640, 480}};
  out.size = {640, 480};
  out.noise = 3;
  return out;
}

/// The board tilted by these angles about x and y, with its middle at this place before the camera.
fc::PlanePose pose(double about_x, double about_y, const Eigen::Vector3d& middle) {
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(about_y, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(about_x, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  const Eigen::AngleAxisd turned(R);
  return {.rotation = turned.angle() * turned.axis(),
          .translation = middle - R * Eigen::Vector3d(4 * 0.03, 2.5 * 0.03, 0)};
}

/// Twelve poses that reach all parts of the picture.
std::vector<fc::PlanePose> poses() {
  std::vector<fc::PlanePose> out;
  for (const double y : {-0.1, 0.0, 0.1})
    for (const double x : {-0.17, -0.05, 0.06, 0.17})
      out.push_back(pose(3 * y + 0.1, 2 * x, {x, y, 0.65 + 0.3 * std::abs(x)}));
  return out;
}

Eigen::Vector2d corner_of(const fc::Lens& lens, const fc::PlanePose& p, int column, int row) {
  const double angle = p.rotation.norm();
  const Eigen::Vector3d at =
      Eigen::AngleAxisd(angle, p.rotation / angle) * Eigen::Vector3d(0.03 * column, 0.03 * row, 0) + p.translation;
  return pixel_of(lens, Eigen::Vector2d(at.head<2>() / at.z()));
}

std::filesystem::path scratch(const std::string& name) { return support::scratch_folder() / name; }

/// Pictures of the board in files.
std::vector<std::filesystem::path> pictures(std::size_t count = 12) {
  const fc::Filming film = camera();
  std::vector<std::filesystem::path> out;
  for (const fc::PlanePose& p : poses()) {
    if (out.size() == count) break;
    out.push_back(scratch(fmt::format("board{}.png", out.size())));
    ff::write_picture(out.back(), exposed(film, light_of_board(film, board, p), out.size()));
  }
  return out;
}

TEST(Boards, CornersAreFoundToATenthOfAPixel) {
  const fc::Filming film = camera();
  double squares = 0;
  int corners = 0;
  for (const fc::PlanePose& p : poses()) {
    const auto found = ff::find_board(exposed(film, light_of_board(film, board, p), 1), board_size);
    ASSERT_EQ(found.size(), 54u);
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 9; ++i, ++corners)
        squares += (found[static_cast<std::size_t>(9 * j + i)] - corner_of(*film.view.lens, p, i, j)).squaredNorm();
  }
  EXPECT_LT(std::sqrt(squares / corners), 0.1);
}

TEST(Boards, PartlySeenAreNone) {
  const fc::Filming film = camera();
  EXPECT_TRUE(
      ff::find_board(exposed(film, light_of_board(film, board, pose(0.1, 0.1, {0.3, 0, 0.6})), 1), board_size).empty());
}

TEST(Calibration, TellsTheLensThePoseAndWhatItDoesNotKnow) {
  std::ostringstream out, err;
  const auto plane = pose(0.02, -0.03, {0.01, 0.02, 0.8});
  const fc::Filming film = camera();
  ff::write_picture(scratch("plane.png"), exposed(film, light_of_board(film, board, plane), 99));
  froude::CalibrateArguments a{.pictures = pictures(),
                               .corners = "9 x 6",
                               .square = "30 mm",
                               .plane = scratch("plane.png"),
                               .output = scratch("lens.toml")};
  froude::calibrate(a, {out, err});
  const auto found = froude::scene::read_calibration(scratch("lens.toml"));
  const fc::Lens &lens = *found.lens, &truth = *film.view.lens;
  // Four standard deviations as told, which the twelve pictures leave at about a pixel.
  EXPECT_NEAR(lens.focal.x(), truth.focal.x(), 2.5);
  EXPECT_NEAR(lens.focal.y(), truth.focal.y(), 2.5);
  EXPECT_NEAR(lens.principal.x(), truth.principal.x(), 2.5);
  EXPECT_NEAR(lens.principal.y(), truth.principal.y(), 2.5);
  // Coefficients are correlated: what matters is where they put pixels.
  for (const Eigen::Vector2d& ray :
       {Eigen::Vector2d(0.4, 0.3), Eigen::Vector2d(-0.45, 0.1), Eigen::Vector2d(0.1, -0.33)})
    EXPECT_LT((pixel_of(lens, ray) - pixel_of(truth, ray)).norm(), 2.5);
  // Lens and pose together: places in the plane of motion, where the board was, to a fifth of a millimetre in 300.
  fc::View view{.lens = lens, .pose = found.plane}, exact{.lens = truth, .pose = plane};
  view.pivot = exact.pivot = corner_of(truth, plane, 0, 0);
  for (const auto& [i, j] : {std::pair{8, 5}, std::pair{0, 5}, std::pair{4, 2}})
    EXPECT_LT((point_of(view, corner_of(truth, plane, i, j)) - point_of(exact, corner_of(truth, plane, i, j))).norm(),
              2e-4);
  EXPECT_THAT(out.str(), AllOf(HasSubstr("12 pictures of 640 x 480 px"), HasSubstr("focal_x"),
                               HasSubstr("standard deviation"), HasSubstr("plane of motion: ")));
}

TEST(Calibration, SaysWhatToDo) {
  std::ostringstream out, err;
  const froude::Console console{out, err};
  const auto all = pictures(3);
  froude::CalibrateArguments a{.pictures = {all[0], all[1]}, .square = "30 mm", .output = scratch("x.toml")};
  EXPECT_THAT(refused([&] { calibrate(a, console); }),
              AllOf(HasSubstr("in 2 of 2 pictures, 3 are needed"), HasSubstr("partly seen")));
  ff::write_picture(scratch("small.png"), fc::Picture(320, 240));
  a.pictures = {all[0], all[1], all[2], scratch("small.png")};
  EXPECT_THAT(refused([&] { calibrate(a, console); }), HasSubstr("small.png is 320 x 240 px"));
  a.pictures = {all[0], all[1], all[2]};
  a.corners = "9";
  EXPECT_THAT(refused([&] { calibrate(a, console); }), HasSubstr("is no number of corners"));
  a.corners = "9 x 6";
  calibrate(a, console);
  EXPECT_THAT(out.str(), HasSubstr("the board never was in the")) << "three pictures of the upper edge";
}

TEST(Films, ComeBackFromTheirFilesAsTheyWere) {
  fc::Filming film = camera();
  film.view.lens.reset();
  film.view.metres_per_pixel = 1e-3;
  film.noise = 10;
  std::vector<fc::Picture> written;
  for (const char* name : {"film.avi", "film.mkv"}) {
    written.clear();
    {
      ff::FilmWriter writer(scratch(name), film.size, 30);
      for (std::uint64_t i = 0; i < 7; ++i) {
        written.push_back(exposed(film,
                                  light_of(
                                      film,
                                      [](double) {
                                        return std::vector<Eigen::Vector2d>{{0.2, -0.2}};
                                      },
                                      0),
                                  i));
        writer.add(written.back());
      }
    }
    ff::FilmReader reader(scratch(name));
    EXPECT_EQ(reader.size(), film.size);
    EXPECT_NEAR(reader.frame_rate(), 30, 0.01);
    fc::Picture picture;
    double time = -1;
    for (std::size_t i = 0; i < 7; ++i) {
      ASSERT_TRUE(reader.next(picture, time));
      EXPECT_EQ(picture.grey, written[i].grey) << "FFV1 loses nothing";
      EXPECT_NEAR(time, static_cast<double>(i) / 30, 1.1e-3) << name;
    }
    EXPECT_FALSE(reader.next(picture, time));
  }
  EXPECT_THAT(refused([&] { ff::FilmWriter(scratch("film.gif"), film.size, 30); }), HasSubstr(".avi"));
}

}  // namespace
}  // namespace calibrate_test
