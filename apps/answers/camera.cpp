#include "answers/camera.hpp"

#include <algorithm>

#include "answers/fit_kind.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using ::fit::camera::Lens;
using ::fit::camera::PlanePose;
using Of = ::fit::camera::TrackColumns::Of;

/// A number of the lens, into a component that no member pointer leads to.
template <class Part>
auto to_lens(Part part) {
  return [part](const Value& value, Lens& lens) { part(lens) = value.number; };
}

Binding<Lens> lens_keys() {
  const auto px = [](const char* name, const char* meaning) { return number(name, meaning); };
  return Binding<Lens>("[lens]",
                       "a lens: focal lengths and principal point in pixels, which count from the centre of the upper "
                       "left one; coefficients as OpenCV and Matlab have them")
      .key(integer("width", "of the pictures it was calibrated with, px").within(Limit::at_least_one),
           [](const Value& v, Lens& lens) { lens.size.x() = static_cast<int>(v.integer); })
      .key(integer("height", "of these pictures, px").within(Limit::at_least_one),
           [](const Value& v, Lens& lens) { lens.size.y() = static_cast<int>(v.integer); })
      .key(px("focal_x", "focal length along x, px").positive(),
           to_lens([](Lens& l) -> double& { return l.focal.x(); }))
      .key(px("focal_y", "focal length along y, px").positive(),
           to_lens([](Lens& l) -> double& { return l.focal.y(); }))
      .key(px("principal_x", "principal point, px"), to_lens([](Lens& l) -> double& { return l.principal.x(); }))
      .key(px("principal_y", "principal point, px"), to_lens([](Lens& l) -> double& { return l.principal.y(); }))
      .key(number("k1", "radial distortion").or_default("0", "no distortion"),
           to_lens([](Lens& l) -> double& { return l.radial[0]; }))
      .key(number("k2", "radial distortion").or_default("0", "no distortion"),
           to_lens([](Lens& l) -> double& { return l.radial[1]; }))
      .key(number("k3", "radial distortion").or_default("0", "no distortion"),
           to_lens([](Lens& l) -> double& { return l.radial[2]; }))
      .key(number("p1", "tangential distortion").or_default("0", "no distortion"),
           to_lens([](Lens& l) -> double& { return l.tangential[0]; }))
      .key(number("p2", "tangential distortion").or_default("0", "no distortion"),
           to_lens([](Lens& l) -> double& { return l.tangential[1]; }))
      .then([](const Record& record, Lens& lens) {
        placed(record.place(), [&] {
          check(lens);
          return true;
        });
      });
}

Binding<PlanePose> plane_keys() {
  return Binding<PlanePose>("[plane]",
                            "where the plane of motion stands before the camera, whose axes are x right, y down and z "
                            "ahead: the place of a board in it")
      .key(vector("rotation", dim::angle, "from the board's axes (x right, y down) to the camera's: axis times angle"),
           &PlanePose::rotation)
      .key(vector("translation", dim::length, "of the board's first corner"), &PlanePose::translation);
}

const Binding<CameraTable::Distance>& distance_keys() {
  using Distance = CameraTable::Distance;
  static const auto table = Binding<Distance>("[camera.distance]", "a distance that is known, and tells the scale")
                                .key(texts("between", "two markers, in all frames in which both are seen"),
                                     [](const Value& v, Distance& out) {
                                       for (const auto& one : v.texts) out.between.push_back(one.value);
                                       if (out.between.size() != 2) throw v.wrong("must name two markers");
                                     })
                                .key(positive("is", dim::length, "how far they are apart"), &Distance::is)
                                .place(&Distance::place);
  return table;
}

const Binding<Of>& marker_keys() {
  static const auto table =
      Binding<Of>("[[camera.marker]]",
                  "which columns of the track are a marker's; left out: all pairs NAME_x, NAME_y (or x_NAME, NAME.x)")
          .key(name_key("", "of the marker"), &Of::marker)
          .key(text("x", "column of its places to the right"), &Of::x)
          .key(text("y", "column of its places down, or up"), &Of::y);
  return table;
}

/// What the keys of [camera] must keep together.
void check_camera(const Record& record, CameraTable& camera) {
  if (camera.calibration_file) camera.calibration = read_calibration(camera.calibration_file->value);
  if (camera.calibration.plane && !camera.calibration.lens)
    throw record.refused("has a plane and no lens", "a pose needs the lens that saw the board: [camera.lens]");
  if (camera.calibration.plane && (camera.scale || camera.distance))
    throw record.refused("has a plane, whose pose tells the scale, and a scale besides",
                         "leave out scale and distance");
  if (camera.calibration.lens && !camera.y_down)
    throw record.wrong("y", "does not go with a lens", "leave it out: rows of a picture count downwards");
  if (camera.shutter && !camera.y_down)
    throw record.wrong("y", "does not go with a shutter", "leave it out: rows of a picture count downwards");
  if (camera.from && camera.to && !(*camera.from < *camera.to)) throw record.wrong("to", "must be later than from");
}

/// Where the picture is in the scene.
Binding<CameraTable> placing_keys() {
  return Binding<CameraTable>("", "")
      .key(text("axis", "of the scene, to the right in the picture")
               .one_of({"x", "-x", "y", "-y"})
               .or_default("x", "seen from starboard, where y points away from the camera"),
           &CameraTable::axis)
      .key(text("y", "which way the track's second coordinate grows")
               .one_of({"down", "up"})
               .or_default("down", "rows of a picture count downwards"),
           [](const Value& v, CameraTable& out) { out.y_down = v.text == "down"; })
      .optional(text("pivot",
                     "a marker (its mean place) or a point of the picture, \"(640, 100)\" in pixels, that is at "
                     "pivot_at; left out: places count from the track's own zero"),
                &CameraTable::pivot)
      .key(vector("pivot_at", dim::length, "where the pivot is in the scene").or_default("(0, 0, 0) m", "the origin"),
           &CameraTable::pivot_at)
      .key(quantity("rotation", dim::angle, "anticlockwise turn that makes the picture upright")
               .or_default("0 deg", "a level camera"),
           &CameraTable::rotation);
}

}  // namespace

const Binding<Calibration>& calibration_binding() {
  static const auto table = Binding<Calibration>("a calibration", "what `froude calibrate` writes")
                                .table("lens", lens_keys(), &Calibration::lens)
                                .optional()
                                .table("plane", plane_keys(), &Calibration::plane)
                                .optional();
  return table;
}

Calibration read_calibration(const std::filesystem::path& file) {
  std::vector<Echo> echo;
  const Node document = parse_document(hydro::io::read_text(file), file.string());
  Calibration out = calibration_binding().read(read_record(document, calibration_binding().table(), echo));
  if (!out.lens)
    throw hydro::InputError("the calibration has no table [lens]", {.file = file.string()},
                            "write one with `froude calibrate`, or give the numbers as [camera.lens]");
  return out;
}

const Binding<CameraTable>& camera_binding() {
  static const auto table =
      Binding<CameraTable>(
          "[camera]",
          "motion: the files are tracks of markers, in pixels or metres; this is how they become places "
          "in the scene")
          .optional(text("calibration",
                         "file of `froude calibrate` with the lens, and the plane of motion if a board "
                         "was in it; left out: no distortion"),
                    &CameraTable::calibration_file)
          .part(calibration_binding(), &CameraTable::calibration)
          .optional(positive("scale", dim::length, "length of a pixel in the plane of motion"), &CameraTable::scale)
          .table("distance", distance_keys(), &CameraTable::distance)
          .optional()
          .part(placing_keys())
          .optional(
              text("deviation", "standard deviation of a place, \"0.3 px\" or \"1 mm\", where the track tells none"),
              &CameraTable::deviation)
          .optional(
              positive("frame_rate", dim::angular_velocity, "\"400 Hz\": rows are frames, where there is no time"),
              in_hertz(&CameraTable::frame_rate))
          .optional(quantity("offset", dim::time,
                             "added to the track's times, so that they are those of a record or of the waves: `froude "
                             "kinematics --record` finds it; left out: the film's own times"),
                    &CameraTable::offset)
          .optional(positive("shutter", dim::time,
                             "in which a rolling shutter reads the rows of a frame, from the first, at the frame's "
                             "time, to the last; left out: all at once"),
                    &CameraTable::shutter)
          .optional(
              quantity(
                  "from", dim::time,
                  "the run begins at this time, whether or not a frame was taken then; left out: at the first frame"),
              &CameraTable::from)
          .optional(quantity("to", dim::time, "what comes later is left out"), &CameraTable::to)
          .tables("marker", marker_keys(), &CameraTable::markers)
          .optional()
          .place(&CameraTable::place)
          .at_most_one_of({"calibration", "lens"})
          .at_most_one_of({"calibration", "plane"})
          .at_most_one_of({"scale", "distance"})
          .then(check_camera);
  return table;
}

}  // namespace froude::scene
