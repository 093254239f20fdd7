#include "froude/kinematics_space.hpp"

#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <any>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/camera_track.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "fit/camera/meeting.hpp"
#include "fit/camera/space.hpp"
#include "froude/kinematics_bodies.hpp"
#include "froude/report.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace fc = ::fit::camera;
using Eigen::Vector3d;
using hydro::InputError;

/// \throws hydro::InputError for a scene without a track
const scene::MotionModel& motion_of_films(const scene::FitScene& scene) {
  const auto* model = std::any_cast<scene::MotionModel>(&scene.settings);
  if (model == nullptr || !model->camera)
    throw InputError("the scene has no track: it is no fit of kind \"motion\" with [camera]", scene.model_place,
                     "name a scene whose files are tracks");
  return *model;
}

std::vector<std::string> names_of(const std::vector<scene::MotionModel::Record>& films) {
  std::vector<std::string> out;
  for (const auto& film : films) out.push_back(film.name);
  return out;
}

/// Rows of numbers under a time, of which a frame may have none.
class TableWithGaps {
 public:
  explicit TableWithGaps(const std::vector<std::string>& columns)
      : text_(fmt::format("t [s],{}\n", fmt::join(columns, ","))) {}
  void time(double t) { text_ += fmt::format("{}{:.10g}", text_.back() == '\n' ? "" : "\n", t); }
  void add(const std::vector<double>& numbers) {
    for (const double x : numbers) text_ += fmt::format(",{:.10g}", x);
  }
  void gap(std::size_t columns) { text_ += std::string(columns, ','); }
  void write(const Path& file) const { hydro::io::write_atomically(file, text_ + "\n"); }

 private:
  std::string text_;
};

struct OneCamera {
  FilmedTrack filmed;
  fc::Eye eye;
  bool at_one_instant;  ///< all rows of a frame: no shutter is stated
};
OneCamera camera_of(const scene::FitScene& scene, const FilmAsked& film) {
  const scene::CameraTable& camera = film.camera;
  FilmedTrack filmed = filmed_track(scene, film.model, film.record);
  const fc::Eye eye = scene::placed(
      camera.place, [&] { return fc::eye_of(filmed.view, camera.along(), camera.pivot_at[1 - camera.along()]); });
  return {std::move(filmed), eye, !camera.shutter};
}

/// What a shutter that nobody has stated would do, of the film in which markers move most.
std::vector<std::string> notes_of_shutters(const std::vector<const OneCamera*>& cameras) {
  double fastest = 0;
  for (const OneCamera* camera : cameras)
    for (const fc::Marker& m : camera->filmed.track.markers)
      for (std::size_t i = 1; i < m.seen.size() && camera->at_one_instant; ++i)
        if (m.seen[i] && m.seen[i - 1]) fastest = std::max(fastest, (m.seen[i]->at - m.seen[i - 1]->at).norm());
  if (!(fastest > 0)) return {};
  return {
      fmt::format("each frame is taken for one instant: a rolling shutter displaces the fastest marker, which goes "
                  "{:.3g} px a frame, by up to that, and deviations do not count it; [camera] shutter takes it off",
                  fastest)};
}

/// Motions from rest of a body, each followed by its standard deviation times a factor; angles near those before.
std::vector<double> motions_of(const fc::SpacePose& pose, const scene::Body& body, Vector3d& angles, double widened) {
  angles = dynamics::roll_pitch_yaw(pose.attitude, angles);
  const Vector3d moved = pose.place - body.position;
  // A small turn of roll, pitch and yaw about the axes that each of them has: yaw first, then pitch, then roll.
  Eigen::Matrix3d turns;
  turns << pose.attitude * Vector3d::UnitX(), dynamics::attitude_of({0, 0, angles.z()}) * Vector3d::UnitY(),
      Vector3d::UnitZ();
  Eigen::Matrix<double, 6, 6> slope = Eigen::Matrix<double, 6, 6>::Identity();
  slope.bottomRightCorner<3, 3>() = turns.inverse();
  const Eigen::Matrix<double, 6, 1> sd =
      (slope * pose.covariance * slope.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
  std::vector<double> out;
  for (int k = 0; k < 6; ++k) {
    out.push_back(k < 3 ? moved[k] : angles[k - 3]);
    out.push_back(widened * sd[k]);
  }
  return out;
}

struct FilmedInSpace {
  const scene::Body* body;
  std::size_t markers;
  fc::SpacePoses poses;
  double widened;  ///< deviations, by this factor
};

std::vector<FilmedInSpace> bodies_in_space(const scene::Scene& scene, const OneCamera& camera) {
  std::vector<std::string> markers;
  for (const auto& m : camera.filmed.track.markers) markers.push_back(m.name);
  std::vector<FilmedInSpace> out;
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    const scene::Body& body = scene.bodies[static_cast<std::size_t>(b)];
    const auto on = markers_on(scene, b, markers);
    if (on.size() < 4) continue;
    fc::SpacePoses poses = scene::placed(body.place, [&] {
      return fc::poses_in_space(camera.filmed.track, camera.eye, on, body.position, camera.filmed.deviation);
    });
    const double widened = fc::widening_of(poses);
    out.push_back({&body, on.size(), std::move(poses), widened});
  }
  if (out.empty())
    throw InputError("no body of the scene has four markers on it, named as its points and joints", {.file = "--space"},
                     fmt::format("name [[point]]s of the scene as the markers are: {}", fmt::join(markers, ", ")));
  return out;
}

/// Frames by their times, as many as a screen takes.
std::string times_of(const std::vector<std::size_t>& frames, const FilmedTrack& film) {
  constexpr std::size_t most = 8;
  std::vector<std::string> out;
  for (const std::size_t i : frames)
    if (out.size() < most) out.push_back(fmt::format("{:.6g} s", film.track.time[i] + film.begin));
  if (frames.size() > most) out.push_back(fmt::format("{} more", frames.size() - most));
  return fmt::format("{}", fmt::join(out, ", "));
}

/// \throws hydro::InputError where pixels of so many frames fit no pose that no poses can be believed
void refuse_misfits(const FilmedInSpace& b, const OneCamera& camera) {
  constexpr std::size_t one_in = 10;  // single wrong sightings are fewer; of a clean film it is none
  const auto told = static_cast<std::size_t>(
      std::count_if(b.poses.pose.begin(), b.poses.pose.end(), [](const auto& pose) { return pose.has_value(); }));
  if (one_in * b.poses.misfits.size() <= told + b.poses.misfits.size()) return;
  throw InputError(
      fmt::format(
          "in {} of {} frames the markers of \"{}\" lie farther from every pose than their deviation allows: {}",
          b.poses.misfits.size(), told + b.poses.misfits.size(), b.body->name,
          times_of(b.poses.misfits, camera.filmed)),
      {.file = "--space"},
      "state the deviation that the pixels have; or the markers' names or their places on the body, the lens or the "
      "pose of the camera are wrong");
}

void say_misfits(const std::vector<FilmedInSpace>& bodies, const OneCamera& camera, Report& report) {
  std::vector<std::string> notes;
  for (const FilmedInSpace& b : bodies)
    if (!b.poses.misfits.empty())
      notes.push_back(fmt::format("markers of \"{}\" fit no pose at {}: are names exchanged, or is a sighting wrong?",
                                  b.body->name, times_of(b.poses.misfits, camera.filmed)));
  for (const FilmedInSpace& b : bodies)
    if (b.widened > 1)
      notes.push_back(
          fmt::format("pixels of \"{}\" stray by {:.3g} of their errors throughout, which is no chance: "
                      "deviations are widened by as much",
                      b.body->name, b.widened));
  report.sentences("misfits", "note: {}", notes);
}

void six_motions(const KinematicsArguments& a, Report& report) {
  const scene::FitScene fit = scene::read_fit(a.scene);
  const FilmAsked film = film_asked(fit, a.film);
  const OneCamera camera = camera_of(fit, film);
  const scene::Scene scene = scene::read(film.scene_of_motion());
  const auto bodies = bodies_in_space(scene, camera);
  std::vector<std::string> columns;
  for (const auto& b : bodies) {
    refuse_misfits(b, camera);
    for (std::size_t k = 0; k < 6; ++k)
      for (const char* of : {"", "_deviation"})
        columns.push_back(fmt::format("{}.{}{} [{}]", b.body->name, hydro::mode_names[k], of, k < 3 ? "m" : "rad"));
    columns.push_back(fmt::format("{}.misfit [1]", b.body->name));
  }
  TableWithGaps table(columns);
  std::vector<Vector3d> angles(bodies.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < camera.filmed.track.frames(); ++i) {
    table.time(camera.filmed.track.time[i]);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (const auto& pose = bodies[b].poses.pose[i])
        table.add(motions_of(*pose, *bodies[b].body, angles[b], bodies[b].widened));
      else
        table.gap(12);
      if (const double stray = bodies[b].poses.stray[i]; std::isfinite(stray))
        table.add({stray});
      else
        table.gap(1);
    }
  }
  table.write(a.output);
  for (const auto& b : bodies) {
    double squares = 0;
    int frames = 0;
    for (const auto& pose : b.poses.pose)
      if (pose) squares += pose->stray * pose->stray, ++frames;
    report.row("body",
               "{}: pose of {} markers in {} of {} frames; fewer than four were seen in {}, a mirrored pose is as "
               "likely in {}, none fits in {}; pixels stray by {:.2g} of their errors",
               fact("name", b.body->name), fact("markers", b.markers), fact("frames", frames), b.poses.pose.size(),
               fact("too_few", b.poses.too_few), fact("ambiguous", b.poses.ambiguous), fact("lost", b.poses.lost),
               fact("stray", frames > 0 ? std::sqrt(squares / frames) : 0.0));
  }
  say_misfits(bodies, camera, report);
  report.sentences("notes", "note: {}", notes_of_shutters({&camera}));
}

/// The name of the other film, where a scene has two.
std::optional<std::string> other_film(const scene::FitScene& scene, const std::string& second) {
  const auto& films = motion_of_films(scene).records;
  if (films.size() != 2) return std::nullopt;
  return films[films[0].name == second ? 1 : 0].name;
}

/// Films of two cameras: of one scene, or each of its own.
std::pair<OneCamera, OneCamera> two_cameras(const KinematicsArguments& a) {
  const scene::FitScene scene = scene::read_fit(a.scene);
  const auto& films = motion_of_films(scene).records;
  const std::string& second = *a.second;
  if (std::any_of(films.begin(), films.end(), [&](const auto& film) { return film.name == second; })) {
    const auto first = a.film ? a.film : other_film(scene, second);
    if (first == second)
      throw InputError(fmt::format("\"{}\" is the first camera, too", second), {.file = "--second"},
                       "name the film of another camera");
    return {camera_of(scene, film_asked(scene, first)), camera_of(scene, film_asked(scene, second))};
  }
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(second, unknown))
    throw InputError(
        fmt::format("\"{}\" is neither a film of the scene nor a file", second), {.file = "--second"},
        fmt::format("its films are {}; or name the fit scene of another camera", fmt::join(names_of(films), ", ")));
  const scene::FitScene own = scene::read_fit(second);
  return {camera_of(scene, film_asked(scene, a.film)), camera_of(own, film_asked(own, {}))};
}

/// Places of markers of two films whose rays meet, and what is said of those that do not.
struct Met {
  fc::SpaceTrack points;
  double widened = 1;  ///< deviations, by this factor
  std::vector<std::string> notes = {};
};

/// \throws hydro::InputError where rays meet at another offset of the clocks, or in most of the film at none
void refuse_apart(const fc::SeenByEye& first, const fc::SeenByEye& second, double stray, std::size_t apart,
                  int points) {
  constexpr std::size_t one_in = 10;  // as of poses
  if (const auto later = fc::clock_of_second(first, second))
    throw InputError(
        fmt::format("rays of the two cameras pass each other by {:.3g} of their errors, and meet where the second film "
                    "is taken {:.4g} s {}",
                    stray, std::abs(*later), *later > 0 ? "later" : "earlier"),
        {.file = "--second"},
        fmt::format("add {:+.4g} s to the offset of the second film's clock: [camera] offset", *later));
  if (one_in * apart > apart + static_cast<std::size_t>(points))
    throw InputError(
        fmt::format("at {} of {} places the rays of the two cameras pass each other by more than their errors allow",
                    apart, apart + static_cast<std::size_t>(points)),
        {.file = "--second"},
        "state the deviation that the pixels have; or names of markers, a lens or the pose of a camera are wrong");
}

std::string told_apart(const fc::SpaceTrack& points, const std::vector<std::pair<std::size_t, std::size_t>>& apart,
                       double begin) {
  constexpr std::size_t most = 8;
  std::vector<std::string> which;
  for (const auto& [marker, frame] : apart)
    if (which.size() < most)
      which.push_back(fmt::format("{} at {:.6g} s", points.markers[marker], points.time[frame] + begin));
  if (apart.size() > most) which.push_back(fmt::format("{} more", apart.size() - most));
  return fmt::format(
      "rays pass each other by more than their errors allow, and these places are left out: {}; are "
      "names exchanged, or is a sighting wrong?",
      fmt::join(which, ", "));
}

Met met(const fc::SeenByEye& first, const fc::SeenByEye& second, double begin) {
  Met out{.points = fc::joined(first, second)};
  const double stray = fc::stray_of(out.points);
  const auto apart = fc::leave_out_apart(out.points);
  out.widened = fc::widening_of(out.points);
  if (!apart.empty() || out.widened > 1) refuse_apart(first, second, stray, apart.size(), out.points.points);
  if (!apart.empty()) out.notes.push_back(told_apart(out.points, apart, begin));
  if (out.widened > 1)
    out.notes.push_back(
        fmt::format("rays pass each other by {:.3g} of their errors throughout, which is no chance: "
                    "deviations are widened by as much",
                    out.widened));
  return out;
}

void places_by_two(const KinematicsArguments& a, Report& report) {
  const auto seen_by = [](const OneCamera& c, double later) {
    fc::SeenByEye out{c.filmed.track, c.eye, c.filmed.deviation};
    for (double& t : out.track.time) t += later;
    return out;
  };
  const auto cameras = two_cameras(a);
  const OneCamera &first = cameras.first, &second = cameras.second;
  const Met both = scene::placed({.file = "--second"}, [&] {
    return met(seen_by(first, 0), seen_by(second, second.filmed.begin - first.filmed.begin), first.filmed.begin);
  });
  const fc::SpaceTrack& points = both.points;
  const double squared = both.widened * both.widened;
  std::vector<std::string> columns;
  for (const auto& m : points.markers) {
    for (const char* axis : {"x", "y", "z"}) columns.push_back(fmt::format("{}_{} [m]", m, axis));
    for (const char* axes : {"xx", "xy", "xz", "yy", "yz", "zz"})
      columns.push_back(fmt::format("{}_{} [m^2]", m, axes));
  }
  TableWithGaps table(columns);
  for (std::size_t i = 0; i < points.time.size(); ++i) {
    table.time(points.time[i]);
    for (const auto& of_marker : points.point)
      if (const auto& p = of_marker[i]) {
        const Eigen::Matrix3d c = squared * p->covariance;
        table.add({p->at.x(), p->at.y(), p->at.z(), c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)});
      } else {
        table.gap(9);
      }
  }
  table.write(a.output);
  report.say("{} frames, {} places of {} markers; rays of {} more do not meet", fact("frames", points.time.size()),
             fact("points", points.points), fact("markers", points.markers.size()), fact("behind", points.behind));
  for (std::size_t m = 0; m < points.markers.size(); ++m) {
    double squares = 0;
    Vector3d variance = Vector3d::Zero();
    int frames = 0;
    for (const auto& p : points.point[m])
      if (p) squares += p->stray * p->stray, variance += p->covariance.diagonal(), ++frames;
    if (frames == 0) continue;
    const Vector3d sd = both.widened * (variance / frames).cwiseSqrt();
    report.row("marker",
               "{}: in {} frames, standard deviations {:.2g}, {:.2g} and {:.2g} m along x, y and z; rays pass each "
               "other by {:.2g} of their errors, between frames of the second film {:.3g} s apart",
               fact("name", points.markers[m]), fact("frames", frames), fact("deviation_x_m", sd.x()),
               fact("deviation_y_m", sd.y()), fact("deviation_z_m", sd.z()), fact("stray", std::sqrt(squares / frames)),
               fact("second_spacing_s", points.spacing));
  }
  report.sentences("apart", "note: {}", both.notes);
  report.sentences("notes", "note: {}", notes_of_shutters({&first, &second}));
}

}  // namespace

FilmAsked film_asked(const scene::FitScene& scene, const std::optional<std::string>& name) {
  const scene::MotionModel& model = motion_of_films(scene);
  for (const auto& record : model.records)
    if (record.name == name || (!name && model.records.size() == 1)) return {model, record, model.camera_of(record)};
  throw InputError(name ? fmt::format("the scene has no film \"{}\"", *name)
                        : fmt::format("the scene has {} films, of which one is looked at", model.records.size()),
                   {.file = "--film"}, fmt::format("its films are {}", fmt::join(names_of(model.records), ", ")));
}

void kinematics_in_space(const KinematicsArguments& a, const Console& console) {
  Report report;
  a.space ? six_motions(a, report) : places_by_two(a, report);
  report.wrote(a.output);
  tell(report, console);
}

}  // namespace froude
