#include "scene/schema_joint.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

/// What a kind of joint measures its coordinate in.
struct Measure {
  const char* joint;
  hydro::Dimension coordinate, force;
};
const Measure of_slider{"slider", dim::length, dim::force}, of_hinge{"hinge", dim::angle, dim::moment};

Table friction_table(const Measure& m, const std::string& what) {
  return {.title = std::string("[joint.friction] of a ") + m.joint,
          .meaning =
              "Coulomb friction: the joint sticks until the static level is reached, and slips against the dynamic one",
          .keys = {quantity("dynamic", m.force, what + " that resists while it slips").positive(),
                   quantity("static", m.force, what + " that it holds while it sticks; left out: the dynamic one")
                       .positive()
                       .optional(),
                   quantity("stribeck", m.coordinate / dim::time,
                            "rate over which the load of slip falls from the static level to the dynamic one; left "
                            "out: it falls at once")
                       .positive()
                       .optional()}};
}
const Table& hinge_friction() {
  static const Table table = friction_table(of_hinge, "moment");
  return table;
}
const Table& slider_friction() {
  static const Table table = friction_table(of_slider, "force");
  return table;
}

Key axis(const std::string& meaning) { return direction("axis", meaning); }

Table prescribed_table(const Measure& m) {
  return {
      .title = std::string("[joint.prescribed] of a ") + m.joint,
      .meaning = std::string("what the coordinate of the ") + m.joint +
                 " is, whatever it takes: a forced oscillation or a recorded motion",
      .keys = {quantity("amplitude", m.coordinate, "of a sine that begins at rest").optional().only_beside("period"),
               quantity("period", dim::time, "of the sine").positive().optional().only_beside("amplitude"),
               quantity("ramp", dim::time, "over which the sine grows, by half a cosine")
                   .within(Limit::not_negative)
                   .or_default("0 s", "the sine begins at once, with its full speed"),
               text(
                   "file",
                   "CSV beside the scene with time and stroke, of hinges angle; a cubic spline goes through its points")
                   .optional()},
      .groups = {{Group::Count::exactly_one, {"amplitude", "file"}}}};
}
const Table& prescribed_of_slider() {
  static const Table table = prescribed_table(of_slider);
  return table;
}
const Table& prescribed_of_hinge() {
  static const Table table = prescribed_table(of_hinge);
  return table;
}

Table latch_table(const Measure& m) {
  return {.title = std::string("[joint.pto.latch] of a ") + m.joint,
          .meaning = "holds the coordinate wherever it comes to rest, whatever the load, and lets it go again",
          .keys = {quantity("hold", dim::time, "for which it holds").positive()}};
}

Table stops_table(const Measure& m) {
  return {
      .title = std::string("[joint.pto.stops] of a ") + m.joint,
      .meaning = "ends of the stroke: a spring and a damper that never pull",
      .keys = {quantity("lower", m.coordinate, "coordinate at which the lower one begins").optional(),
               quantity("upper", m.coordinate, "coordinate at which the upper one begins").optional(),
               quantity("stiffness", m.force / m.coordinate, "of the stop").positive(),
               quantity("damping", m.force / (m.coordinate / dim::time), "of the stop, as far as its spring presses")
                   .within(Limit::not_negative)
                   .or_default(m.coordinate == dim::angle ? "0 N m s/rad" : "0 N s/m",
                               "a stop gives back what it takes")},
      .groups = {{Group::Count::at_least_one, {"lower", "upper"}}}};
}

Table pto_table(const Measure& m, const Table& stops, const Table& latch) {
  const auto rate = m.coordinate / dim::time;
  return {.title = std::string("[joint.pto] of a ") + m.joint,
          .meaning = std::string("works against the coordinate of the ") + m.joint + ", zero at rest",
          .keys = {quantity("stiffness", m.force / m.coordinate, "of the spring; negative ones push away from rest")
                       .optional(),
                   quantity("cubic", m.force / (m.coordinate * m.coordinate * m.coordinate),
                            "of the spring, times the coordinate cubed")
                       .optional(),
                   quantity("damping", m.force / rate, "of the damper").positive().optional(),
                   quantity("quadratic_damping", m.force / (rate * rate), "of the damper, times rate times its size")
                       .positive()
                       .optional(),
                   quantity("preload", m.force, "constant, against a growing coordinate").optional(),
                   quantity("force_limit", m.force, "that spring, damper and preload together cannot exceed")
                       .positive()
                       .optional(),
                   inner_table("stops", stops).optional(), inner_table("latch", latch).optional()},
          .groups = {{Group::Count::at_least_one,
                      {"stiffness", "cubic", "damping", "quadratic_damping", "preload", "stops", "latch"}}}};
}

const Table& pto_of_slider() {
  static const Table stops = stops_table(of_slider), latch = latch_table(of_slider);
  static const Table table = pto_table(of_slider, stops, latch);
  return table;
}

const Table& pto_of_hinge() {
  static const Table stops = stops_table(of_hinge), latch = latch_table(of_hinge);
  static const Table table = pto_table(of_hinge, stops, latch);
  return table;
}

}  // namespace

const Table& joint_table() {
  static const Table table{
      .title = "[[joint]]",
      .meaning = "keeps two bodies, or a body and the ground, together exactly, whatever the forces",
      .keys =
          {name_key("joint", "of the joint"),
           texts("between",
                 "[\"a\", \"b\"], [\"ground\", \"a\"], or \"neighbours of m\": m1–m2, m2–m3, … of the copies m"),
           vector(
               "at", dim::length,
               "where the joint is at rest, global; of neighbours the first pair's, and the others' moves with them"),
           text("kind", "of joint")},
      .chosen_by = "kind",
      .variants = {
          {.word = "fixed", .meaning = "nothing moves", .keys = {}},
          {.word = "hinge",
           .meaning = "the two turn about one axis",
           .keys = {axis("about which they turn, global at rest"), inner_table("pto", pto_of_hinge()).optional(),
                    inner_table("friction", hinge_friction()).optional(),
                    inner_table("prescribed", prescribed_of_hinge()).optional()}},
          {.word = "universal",
           .meaning = "the two turn about two axes across each other",
           .keys = {axis("that the first body holds, global at rest"),
                    direction("second_axis", "that the second body holds, across the first")}},
          {.word = "ball", .meaning = "the two turn freely about the point", .keys = {}},
          {.word = "slider",
           .meaning = "the second slides along an axis of the first and turns about nothing",
           .keys = {axis("along which it slides, held by the first, global at rest"),
                    inner_table("pto", pto_of_slider()).optional(),
                    inner_table("friction", slider_friction()).optional(),
                    inner_table("prescribed", prescribed_of_slider()).optional()}},
          {.word = "planar",
           .meaning = "the second slides in a plane of the first and turns about its normal",
           .keys = {axis("across the plane, held by the first, global at rest")}}}};
  return table;
}

}  // namespace froude::scene
