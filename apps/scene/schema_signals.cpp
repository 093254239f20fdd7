/// \file  What a scene wants to be told beside what its elements tell by themselves.
#include "scene/schema_signals.hpp"

namespace froude::scene {

namespace dim = hydro::dim;

const Table& point_table() {
  static const Table table{
      .title = "[[point]]",
      .meaning = "a point of a body, of which a run and responses tell what `gives` names",
      .keys = {name_key("point", "of the point; of several bodies they get a number"),
               texts("on", "bodies it belongs to, by name; * stands for any characters"),
               vector("at", dim::length, "from the body's origin, body axes"),
               texts("gives",
                     "what is told, along global axes: position (x, y, z), velocity and acceleration (velocity_x …), "
                     "air_gap: its height above the undisturbed surface")
                   .one_of({"position", "velocity", "acceleration", "air_gap"})}};
  return table;
}

const Table& relative_motion_table() {
  static const Table table{
      .title = "[[relative_motion]]",
      .meaning = "how a point of one body moves against a point of another, or of the ground: x, y, z",
      .keys = {name_key("relative_motion", "of the pair of points"),
               texts("between",
                     "[\"a\", \"b\"], [\"a\", \"ground\"], or \"neighbours of m\": m1–m2, m2–m3, … of the copies m"),
               ends("ends",
                    "[point of the first, point of the second], body axes (ground: global axes); ± makes several, "
                    "taken in pairs; the second is seen from the first body, along its axes, from as placed")}};
  return table;
}

}  // namespace froude::scene
