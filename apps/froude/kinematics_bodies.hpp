#pragma once
/// \file  Bodies of a scene that a film shows: markers with the names of its points and joints sit there. Private to
///        apps/froude.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "answers/fit_models.hpp"
#include "fit/camera/pose.hpp"
#include "fit/camera/space.hpp"
#include "froude/report.hpp"
#include "scene/scene.hpp"

namespace froude {

/// The markers that sit on a body, from its origin: at points of it, and at joints that it has with others or the
/// ground, whose names they have.
std::vector<::fit::camera::MarkerInSpace> markers_on(const scene::Scene& scene, int body,
                                                     const std::vector<std::string>& markers);

/// One number at each frame, with its standard deviation.
struct SmoothedColumn {
  std::string name, unit;
  std::vector<double> value, deviation;
};

/// A frame, and how long after it an instant is, s.
struct NearFrame {
  std::size_t frame;
  double since;
};

/// A scene of motion as text, its bodies beginning as filmed.
struct FilmedStart {
  std::string text, opened;         ///< and by how much joints were open as measured
  std::array<double, 4> deviation;  ///< the largest of places, angles and their rates: m, rad, m/s, rad/s
};

/// Bodies on which two markers and more sit, and their motions from rest in the plane of the film.
class FilmedBodies {
 public:
  /// \throws hydro::InputError for a scene of motion that is wrong, markers that all sit at one place of a body
  FilmedBodies(const std::filesystem::path& scene_of_motion, const scene::CameraTable& camera,
               const ::fit::camera::SmoothTrack& track);

  /// True for the name of one of the motions, "upper.pitch".
  bool tells(std::string_view signal) const;
  std::vector<SmoothedColumn> columns() const;
  /// At an instant, joints closed; for a file that stands where `beside` says. \throws hydro::InputError: a body
  /// without two markers, copies of bodies, joints that do not close, a scene with files elsewhere
  FilmedStart start(const NearFrame& at, const std::filesystem::path& beside, const std::string& when) const;
  void say(Report& report) const;

 private:
  struct Filmed {
    int body;  ///< of the scene
    std::vector<::fit::camera::MarkerOnBody> markers;
    std::vector<::fit::camera::PlanarMotion> motion;  ///< place from rest
    double stray;                                     ///< rms over all frames
  };
  std::string named(const Filmed& filmed, int k) const;

  std::filesystem::path file_;
  scene::Scene scene_;
  std::array<hydro::Mode, 3> modes_;  ///< along the picture's axis, up, and about the axis across
  std::vector<Filmed> bodies_;
};

}  // namespace froude
