/// \file  What a scene wants to be told beside what its elements tell: `[[probe]]`, `[[point]]`, `[[relative_motion]]`.
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Binding<Probe>& probe() {
  static const auto binding =
      Binding<Probe>("[[probe]]", "a point that stays where it is, at which the water is told")
          .key(name_key("probe", "of the probe"))
          .key(vector("at", dim::length, "global, z up from still water"), &Probe::at)
          .flags(texts("gives",
                       "what is told there; acceleration: the rate of the velocity at the fixed point, not of the "
                       "water that goes by")
                     .or_default("elevation", "the height of the surface above the point"),
                 {{"elevation", &Probe::elevation},
                  {"velocity", &Probe::velocity},
                  {"acceleration", &Probe::acceleration},
                  {"pressure", &Probe::pressure}})
          .place(&Probe::place);
  return binding;
}

const Binding<Point>& point() {
  static const auto binding =
      Binding<Point>("[[point]]", "a point of a body, of which a run and responses tell what `gives` names")
          .keys({name_key("point", "of the point; of several bodies they get a number"),
                 texts("on", "bodies it belongs to, by name; * stands for any characters")})
          .key(vector("at", dim::length, "from the body's origin, body axes"), &Point::at)
          .flags(texts("gives",
                       "what is told, along global axes: position (x, y, z), velocity and acceleration (velocity_x …), "
                       "air_gap: its height above the undisturbed surface"),
                 {{"position", &Point::position},
                  {"velocity", &Point::velocity},
                  {"acceleration", &Point::acceleration},
                  {"air_gap", &Point::air_gap}});
  return binding;
}

}  // namespace

const Table& probe_table() { return probe().table(); }
const Table& point_table() { return point().table(); }

const Table& relative_motion_table() {
  static const Table table{
      .title = "[[relative_motion]]",
      .meaning = "how a point of one body moves against a point of another, or of the ground: x, y, z",
      .keys = {name_key("relative_motion", "of the pair of points"), between_key(),
               ends("ends",
                    "[point of the first, point of the second], body axes (ground: global axes); ± makes several, "
                    "taken in pairs; the second is seen from the first body, along its axes, from as placed")}};
  return table;
}

void build_probes(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("probe")) {
    scene.probes.push_back(probe().read(record));
    scene.probes.back().name = names.of(record, 1).front();
  }
}

void build_signals(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("point"))
    on_each_body(record, names, scene.bodies, point().read(record), scene.points);
  for (const Record& record : root.tables("relative_motion"))
    for (PointPair& pair : read_point_pairs(record, names, scene.bodies))
      scene.relative_motions.push_back(std::move(pair));
}

}  // namespace froude::scene
