#include "answers/camera_track.hpp"

#include <limits>

#include "fit/camera/shutter.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace fc = ::fit::camera;
namespace dim = hydro::dim;
using hydro::InputError;

/// "(640, 100)"
Eigen::Vector2d point_in(const std::string& text) {
  const auto comma = text.find(',');
  if (comma == std::string::npos || text.back() != ')')
    throw InputError(fmt::format("the pivot \"{}\" is neither a marker nor a point", text), {}, "write \"(640, 100)\"");
  return {hydro::parse_number(hydro::trimmed(std::string_view(text).substr(1, comma - 1))),
          hydro::parse_number(hydro::trimmed(std::string_view(text).substr(comma + 1, text.size() - comma - 2)))};
}

/// The mean place of a marker that stays where it is.
Eigen::Vector2d mean_place(const fc::Marker& marker) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int frames = 0;
  for (const auto& s : marker.seen)
    if (s) sum += s->at, ++frames;
  hydro::require(frames > 0, "the pivot, marker \"{}\", is in no frame", marker.name);
  return sum / frames;
}

/// In the track's unit; 0 where nothing is stated.
double deviation_of(const std::string& text, bool in_metres) {
  if (text.empty()) return 0;
  const bool pixels = text.ends_with("px");
  if (pixels == in_metres)
    throw InputError(fmt::format("the deviation \"{}\" is in another unit than the track, which is in {}", text,
                                 in_metres ? "metres" : "pixels"),
                     {}, in_metres ? "write a length, \"1 mm\"" : "write pixels, \"0.3 px\"");
  const double out = pixels ? hydro::parse_number(hydro::trimmed(std::string_view(text).substr(0, text.size() - 2)))
                            : hydro::parse_si(text, dim::length);
  hydro::require(out > 0, "the deviation \"{}\" must be positive", text);
  return out;
}

fc::TrackColumns columns_of(const scene::FitScene& scene, const scene::MotionModel& model,
                            const scene::CameraTable& camera) {
  fc::TrackColumns out{.names = {},
                       .time = scene.channels.count("time") > 0 ? scene.channels.at("time") : std::string(),
                       .frames_per_second = camera.frame_rate,
                       .markers = camera.markers,
                       .time_unit = model.time_unit,
                       .position_unit = model.position_unit};
  for (const auto& name : model.columns) out.names.push_back(name.value);
  return out;
}

/// Where a rolling shutter is stated, the places at the frames' own times.
fc::Track without_shutter(fc::Track track, const scene::CameraTable& camera) {
  if (!camera.shutter) return track;
  const auto& lens = camera.calibration.lens;
  const int height = lens ? lens->size.y() : track.size.y();
  return scene::placed(camera.place, [&] {
    return fc::of_one_instant(track, *camera.shutter, height, deviation_of(camera.deviation, track.in_metres));
  });
}

}  // namespace

fc::View view_of(const scene::CameraTable& camera, const fc::Track& track) {
  fc::View out{.lens = camera.calibration.lens,
               .pose = camera.calibration.plane,
               .metres_per_pixel = 1,
               .y_down = camera.y_down,
               .leftwards = camera.leftwards(),
               .rotation = camera.rotation};
  const bool scaled = camera.scale || camera.distance;
  if (track.in_metres && (out.lens || scaled))
    throw InputError("the track is in metres, and [camera] has a lens or a scale", camera.place, "leave them out");
  if (!track.in_metres && !out.pose && !scaled)
    throw InputError("the track is in pixels, and [camera] does not say how long one is", camera.place,
                     "add scale = \"0.5 mm\", a known distance = { between = [\"a\", \"b\"], is = \"0.4 m\" }, or a "
                     "calibration with a board in the plane of motion");
  if (camera.scale) out.metres_per_pixel = *camera.scale;
  if (camera.distance)
    out.metres_per_pixel =
        camera.distance->is / scene::placed(camera.distance->place, [&] {
          return fc::mean_distance(track, out, camera.distance->between[0], camera.distance->between[1]);
        });
  out.pivot_at = {camera.pivot_at[camera.along()], camera.pivot_at.z()};
  if (!camera.pivot.empty())
    out.pivot = scene::placed(camera.place, [&] {
      return camera.pivot.front() == '(' ? point_in(camera.pivot) : mean_place(track.marker(camera.pivot));
    });
  return out;
}

FilmedTrack filmed_track(const scene::FitScene& scene, const scene::MotionModel& model,
                         const scene::MotionModel::Record& record) {
  const scene::CameraTable& camera = model.camera_of(record);
  return scene::placed({.file = record.file.value.string()}, [&] {
    fc::Track track = without_shutter(fc::read_track(record.file.value, columns_of(scene, model, camera)), camera);
    for (double& t : track.time) t += camera.offset;
    const double begin = record.start.value_or(camera.from.value_or(track.time.front()));
    const double end = record.end.value_or(camera.to.value_or(std::numeric_limits<double>::infinity()));
    fc::Track part = fc::cut(track, begin, end);
    const double deviation =
        scene::placed(camera.place, [&] { return deviation_of(camera.deviation, track.in_metres); });
    fc::View view = view_of(camera, part);
    return FilmedTrack{std::move(part), begin, std::move(view), deviation};
  });
}

TrackInPlane track_in_plane(const scene::FitScene& scene, const scene::MotionModel& model,
                            const scene::MotionModel::Record& record) {
  const FilmedTrack filmed = filmed_track(scene, model, record);
  return scene::placed({.file = record.file.value.string()}, [&] {
    return TrackInPlane{fc::in_plane(filmed.track, filmed.view, filmed.deviation), filmed.begin};
  });
}

std::vector<fc::Channel> channels_asked(const scene::MotionModel& model, const scene::CameraTable& camera) {
  std::vector<fc::Channel> out;
  for (const auto& s : model.signals) {
    if (s.marker.empty()) {
      // About +y the x axis turns down; about +x the y axis turns up. Polar angles of links are below the horizontal.
      const bool downwards = camera.along() == 0 || s.of.ends_with(".polar");
      out.push_back({fc::Channel::Kind::angle, s.between[0], s.between[1], downwards, s.zero});
      continue;
    }
    const bool up = s.along == "z", across = s.along != std::string(1, camera.axis.back());
    if (!up && across)
      throw InputError(fmt::format("the coordinate {} of \"{}\" does not lie in the picture, whose axes are {} and z",
                                   s.along, s.of, camera.axis.back()),
                       s.deviation.place, "take another coordinate, or say what the picture shows: [camera] axis");
    out.push_back({up ? fc::Channel::Kind::up : fc::Channel::Kind::along, s.marker});
  }
  return out;
}

}  // namespace froude
