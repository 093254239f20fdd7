#pragma once
/// \file  [camera] of a fit: what makes places in the plane of motion of what a film tells. Plain data.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit/camera/track_file.hpp"
#include "fit/camera/view.hpp"
#include "scene/binding.hpp"

namespace froude::scene {

/// What a board told of a camera, from a file or as numbers.
struct Calibration {
  std::optional<::fit::camera::Lens> lens = {};
  std::optional<::fit::camera::PlanePose> plane = {};
};
/// A file of `froude calibrate`. \throws hydro::InputError
Calibration read_calibration(const std::filesystem::path& file);

struct CameraTable {
  std::optional<Located<std::filesystem::path>> calibration_file = {};
  Calibration calibration = {};
  std::optional<double> scale = {};  ///< m, of a pixel
  struct Distance {
    std::vector<std::string> between;
    double is = 0;  ///< m
    Place place = {};
  };
  std::optional<Distance> distance = {};
  std::string axis = "x";  ///< of the scene, to the right in the picture: x, -x, y or -y
  bool y_down = true;
  std::string pivot = {};  ///< a marker, or "(640, 100)": px
  Eigen::Vector3d pivot_at = {0, 0, 0};
  double rotation = 0;                       ///< rad
  std::string deviation = {};                ///< of places that the track tells no errors of: "0.3 px", "1 mm"
  double frame_rate = 0;                     ///< Hz; 0: the track has times
  double offset = 0;                         ///< s, added to the track's times
  std::optional<double> shutter = {};        ///< s, in which the rows of a frame are read; none: all at once
  std::optional<double> from = {}, to = {};  ///< s, in these times
  std::vector<::fit::camera::TrackColumns::Of> markers = {};
  Place place = {};

  /// Along which coordinate of the scene the picture's right lies: 0 for x, 1 for y.
  int along() const { return axis.back() == 'y' ? 1 : 0; }
  bool leftwards() const { return axis.front() == '-'; }
};

const Binding<CameraTable>& camera_binding();
/// The tables [lens] and [plane], of a file of their own or within [camera].
const Binding<Calibration>& calibration_binding();

}  // namespace froude::scene
