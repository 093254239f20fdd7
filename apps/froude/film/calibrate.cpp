// `froude calibrate`: the lens, and the plane of motion, from pictures of a checkerboard.
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "fit/camera/view.hpp"
#include "froude/film/board.hpp"
#include "froude/film/commands.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/report.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/placed.hpp"

namespace froude::film {
namespace {

namespace fc = ::fit::camera;
using hydro::InputError;

std::vector<cv::Point3f> places_of(const BoardSize& board) {
  std::vector<cv::Point3f> out;
  for (int j = 0; j < board.rows; ++j)
    for (int i = 0; i < board.columns; ++i)
      out.emplace_back(static_cast<float>(i * board.square), static_cast<float>(j * board.square), 0.0f);
  return out;
}

std::vector<cv::Point2f> points_of(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<cv::Point2f> out;
  for (const Eigen::Vector2d& c : corners) out.emplace_back(static_cast<float>(c.x()), static_cast<float>(c.y()));
  return out;
}

cv::Mat matrix_of(const fc::Lens& lens) {
  return (cv::Mat_<double>(3, 3) << lens.focal.x(), 0, lens.principal.x(), 0, lens.focal.y(), lens.principal.y(), 0, 0,
          1);
}
cv::Mat coefficients_of(const fc::Lens& lens) {
  return (cv::Mat_<double>(1, 5) << lens.radial[0], lens.radial[1], lens.tangential[0], lens.tangential[1],
          lens.radial[2]);
}

}  // namespace

std::vector<Eigen::Vector2d> find_board(const fc::Picture& picture, const BoardSize& board) {
  const cv::Mat grey(picture.height, picture.width, CV_8UC1, const_cast<std::uint8_t*>(picture.grey.data()));
  std::vector<cv::Point2f> corners;
  const cv::Size size(board.columns, board.rows);
  if (!cv::findChessboardCornersSB(grey, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY))
    return {};
  // What finds the board is off by a fifth of a pixel; saddle points of the grey levels around each corner are not.
  double spacing = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (i % static_cast<std::size_t>(board.columns) != 0)
      spacing = std::min(spacing, cv::norm(corners[i] - corners[i - 1]));
  const int window = std::clamp(static_cast<int>(0.4 * spacing), 3, 15);
  cv::cornerSubPix(grey, corners, {window, window}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 60, 1e-3});
  // The board may be seen upside down: its first corner is the one nearer to the upper left.
  if (corners.front().x + corners.front().y > corners.back().x + corners.back().y)
    std::reverse(corners.begin(), corners.end());
  std::vector<Eigen::Vector2d> out;
  for (const cv::Point2f& c : corners) out.emplace_back(c.x, c.y);
  return out;
}

LensFit fit_lens(const std::vector<std::vector<Eigen::Vector2d>>& boards, const BoardSize& board,
                 const Eigen::Vector2i& size, int radial, bool tangential) {
  std::vector<std::vector<cv::Point3f>> places(boards.size(), places_of(board));
  std::vector<std::vector<cv::Point2f>> points;
  for (const auto& corners : boards) points.push_back(points_of(corners));
  int flags = 0;
  if (radial < 1) flags |= cv::CALIB_FIX_K1;
  if (radial < 2) flags |= cv::CALIB_FIX_K2;
  if (radial < 3) flags |= cv::CALIB_FIX_K3;
  if (!tangential) flags |= cv::CALIB_ZERO_TANGENT_DIST;
  cv::Mat matrix, coefficients, deviations, unused, errors;
  std::vector<cv::Mat> rotations, translations;
  LensFit out;
  out.rms = cv::calibrateCamera(places, points, cv::Size(size.x(), size.y()), matrix, coefficients, rotations,
                                translations, deviations, unused, errors, flags);
  const auto k = [&](int i) { return coefficients.at<double>(i); };
  out.lens = {.focal = {matrix.at<double>(0, 0), matrix.at<double>(1, 1)},
              .principal = {matrix.at<double>(0, 2), matrix.at<double>(1, 2)},
              .radial = {k(0), k(1), k(4)},
              .tangential = {k(2), k(3)},
              .size = size};
  for (int i = 0; i < 9; ++i) out.deviations.push_back(deviations.at<double>(i));  // fx fy cx cy k1 k2 p1 p2 k3
  for (int i = 0; i < errors.rows; ++i) out.rms_of_picture.push_back(errors.at<double>(i));
  return out;
}

PoseFit fit_pose(const std::vector<Eigen::Vector2d>& corners, const BoardSize& board, const fc::Lens& lens) {
  cv::Mat rotation, translation;
  const auto places = places_of(board);
  const auto points = points_of(corners);
  if (!cv::solvePnP(places, points, matrix_of(lens), coefficients_of(lens), rotation, translation))
    throw hydro::NumericsError("the pose of the board in the plane of motion is not found");
  std::vector<cv::Point2f> again;
  cv::projectPoints(places, rotation, translation, matrix_of(lens), coefficients_of(lens), again);
  double squares = 0;
  for (std::size_t i = 0; i < again.size(); ++i)
    squares += std::pow(again[i].x - points[i].x, 2) + std::pow(again[i].y - points[i].y, 2);
  const auto vector = [](const cv::Mat& m) {
    return Eigen::Vector3d(m.at<double>(0), m.at<double>(1), m.at<double>(2));
  };
  return {{vector(rotation), vector(translation)}, std::sqrt(squares / static_cast<double>(again.size()))};
}

namespace {

BoardSize board_of(const CalibrateArguments& a) {
  BoardSize out;
  if (std::sscanf(a.corners.c_str(), "%d x %d", &out.columns, &out.rows) != 2 || out.columns < 3 || out.rows < 3)
    throw InputError(fmt::format("\"{}\" is no number of corners", a.corners), {.file = "--corners"},
                     "count the corners between squares, three and more each way: \"9 x 6\"");
  out.square = option_si("--square", a.square, hydro::dim::length);
  hydro::require(out.square > 0, "--square must be positive, got {} m", out.square);
  if (a.radial < 0 || a.radial > 3)
    throw InputError(fmt::format("{} radial coefficients", a.radial), {.file = "--radial"}, "take 0 to 3");
  return out;
}

/// A picture of the board, or one frame of a film of it.
struct Shot {
  std::string name;
  fc::Picture picture;
  std::vector<Eigen::Vector2d> corners = {};
};

bool is_film(const Path& file) {
  const std::string kind = file.extension().string();
  for (const char* film : {".avi", ".mkv", ".mp4", ".mov", ".MP4", ".MOV", ".AVI"})
    if (kind == film) return true;
  return false;
}

/// Some thirty frames of a film, evenly.
void take_frames(const Path& file, std::vector<Shot>& out) {
  FilmReader reader(file);
  const std::size_t every = std::max<std::size_t>(1, reader.frames() / 30);
  fc::Picture picture;
  double time = 0;
  for (std::size_t i = 0; reader.next(picture, time); ++i)
    if (i % every == 0) out.push_back({fmt::format("{} frame {}", file.filename().string(), i + 1), picture});
}

std::vector<Shot> shots_of(const CalibrateArguments& a, const BoardSize& board, std::vector<std::string>& without) {
  std::vector<Shot> all, out;
  for (const Path& file : a.pictures) {
    if (is_film(file))
      take_frames(file, all);
    else
      all.push_back({file.filename().string(), read_picture(file)});
  }
  for (Shot& shot : all) {
    if (shot.picture.width != all.front().picture.width || shot.picture.height != all.front().picture.height)
      throw InputError(
          fmt::format("{} is {} x {} px, {} is {} x {} px", shot.name, shot.picture.width, shot.picture.height,
                      all.front().name, all.front().picture.width, all.front().picture.height),
          {.file = shot.name}, "a calibration holds for one size of picture: take all with the settings of the film");
    shot.corners = find_board(shot.picture, board);
    if (shot.corners.empty())
      without.push_back(shot.name);
    else
      out.push_back(std::move(shot));
  }
  if (out.size() < 3)
    throw InputError(fmt::format("the whole board is seen in {} of {} pictures, 3 are needed and 10 are good",
                                 out.size(), all.size()),
                     {.file = a.pictures.front().string()},
                     "a board that is partly seen tells nothing: keep all of it in the picture, tilted, near the edges "
                     "too, and count its inner corners (--corners)");
  return out;
}

/// Parts of the picture, of nine, in which no corner ever was.
std::vector<std::string> never_seen(const std::vector<Shot>& shots) {
  static constexpr const char* names[3][3] = {{"upper left", "upper middle", "upper right"},
                                              {"middle left", "middle", "middle right"},
                                              {"lower left", "lower middle", "lower right"}};
  bool seen[3][3] = {};
  for (const Shot& shot : shots)
    for (const Eigen::Vector2d& c : shot.corners)
      seen[std::clamp(static_cast<int>(3 * c.y() / shot.picture.height), 0, 2)]
          [std::clamp(static_cast<int>(3 * c.x() / shot.picture.width), 0, 2)] = true;
  std::vector<std::string> out;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      if (!seen[j][i]) out.push_back(names[j][i]);
  return out;
}

void write_calibration(const CalibrateArguments& a, const LensFit& fit, const std::optional<PoseFit>& pose) {
  const fc::Lens& l = fit.lens;
  std::string out = fmt::format(
      "# Written by `froude calibrate`, version {}: {} pictures, rms {:.3g} px.\n[lens]\nwidth = {}\nheight = "
      "{}\nfocal_x = "
      "{:.8g}\nfocal_y = {:.8g}\nprincipal_x = {:.8g}\nprincipal_y = {:.8g}\nk1 = {:.8g}\nk2 = {:.8g}\nk3 = {:.8g}\np1 "
      "= "
      "{:.8g}\np2 = {:.8g}\n",
      FROUDE_VERSION, fit.rms_of_picture.size(), fit.rms, l.size.x(), l.size.y(), l.focal.x(), l.focal.y(),
      l.principal.x(), l.principal.y(), l.radial[0], l.radial[1], l.radial[2], l.tangential[0], l.tangential[1]);
  if (pose) {
    const auto vector = [](const Eigen::Vector3d& v) {
      return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x(), v.y(), v.z());
    };
    out += fmt::format("[plane]\nrotation = \"{} rad\"\ntranslation = \"{} m\"\n", vector(pose->pose.rotation),
                       vector(pose->pose.translation));
  }
  hydro::io::write_atomically(a.output, out);
}

void draw(const Path& folder, const std::vector<Shot>& shots) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    Annotation drawn(shots[i].picture);
    drawn.path(shots[i].corners, colour_of(1));
    for (const Eigen::Vector2d& c : shots[i].corners) drawn.cross(c, 5, colour_of(0));
    drawn.write(folder / fmt::format("board_{}.png", i + 1));
  }
}

Report told(const std::vector<Shot>& shots, const std::vector<std::string>& without, const LensFit& fit,
            const std::optional<PoseFit>& pose) {
  Report report;
  const fc::Lens& l = fit.lens;
  report.say("{} pictures of {} x {} px, rms of the corners {:.3g} px", fact("pictures", shots.size()),
             fact("width", l.size.x()), fact("height", l.size.y()), fact("rms_px", fit.rms));
  const std::vector<std::pair<const char*, double>> all{
      {"focal_x", l.focal.x()},         {"focal_y", l.focal.y()}, {"principal_x", l.principal.x()},
      {"principal_y", l.principal.y()}, {"k1", l.radial[0]},      {"k2", l.radial[1]},
      {"p1", l.tangential[0]},          {"p2", l.tangential[1]},  {"k3", l.radial[2]}};
  for (std::size_t i = 0; i < all.size(); ++i)
    if (fit.deviations[i] > 0)
      report.row("number", "  {} {:.6g}, standard deviation {:.2g}", fact("name", std::string(all[i].first)),
                 fact("value", all[i].second), fact("deviation", fit.deviations[i]));
  for (std::size_t i = 0; i < shots.size(); ++i)
    report.row(
        "picture", "  {}: {:.3g} px{}", fact("name", shots[i].name), fact("rms_px", fit.rms_of_picture[i]),
        fit.rms_of_picture[i] > 2 * fit.rms ? ", twice the whole's: look at it, is the board flat and in focus?" : "");
  if (pose)
    report.say("plane of motion: {:.4g} m before the camera, rms of the corners {:.3g} px",
               fact("distance_m", pose->pose.translation.z()), fact("plane_rms_px", pose->rms));
  std::vector<std::string> cautions;
  if (!without.empty())
    cautions.push_back(fmt::format("the whole board was not found in {}", fmt::join(without, ", ")));
  if (const auto blind = never_seen(shots); !blind.empty())
    cautions.push_back(
        fmt::format("the board never was in the {} of the picture: what the lens does there is extrapolated",
                    fmt::join(blind, ", ")));
  report.sentences("cautions", "warning: {}", cautions);
  return report;
}

}  // namespace
}  // namespace froude::film

namespace froude {

void calibrate(const CalibrateArguments& a, const Console& console) {
  const film::BoardSize board = film::board_of(a);
  std::vector<NamedFile> inputs;
  for (const Path& file : a.pictures) inputs.push_back({"a picture", file});
  if (a.plane) inputs.push_back({"--plane", *a.plane});
  require_outputs({{"-o", a.output}}, inputs);
  std::vector<std::string> without;
  const auto shots = film::shots_of(a, board, without);
  std::vector<std::vector<Eigen::Vector2d>> boards;
  for (const auto& shot : shots) boards.push_back(shot.corners);
  const film::LensFit fit =
      film::fit_lens(boards, board, {shots[0].picture.width, shots[0].picture.height}, a.radial, a.tangential);
  scene::placed({}, [&] { return check(fit.lens), true; });
  std::optional<film::PoseFit> pose;
  if (a.plane) {
    const auto picture = film::read_picture(*a.plane);
    if (picture.width != fit.lens.size.x() || picture.height != fit.lens.size.y())
      throw hydro::InputError(fmt::format("the picture is {} x {} px, the lens was calibrated with {} x {} px",
                                          picture.width, picture.height, fit.lens.size.x(), fit.lens.size.y()),
                              {.file = a.plane->string()}, "take it with the settings of the others");
    const auto corners = film::find_board(picture, board);
    if (corners.empty())
      throw hydro::InputError("the whole board is not found", {.file = a.plane->string()},
                              "all of the board must be seen, in the plane of motion");
    pose = film::fit_pose(corners, board, fit.lens);
  }
  film::write_calibration(a, fit, pose);
  if (a.annotated) film::draw(*a.annotated, shots);
  Report report = film::told(shots, without, fit, pose);
  report.wrote(a.output);
  tell(report, console);
}

}  // namespace froude
