#include "scene/schema_joint.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

Table friction_table(const std::string& joint, const hydro::Dimension& dimension, const std::string& what) {
  return {.title = "[joint.friction] of a " + joint,
          .meaning =
              "Coulomb friction: the joint sticks until the static level is reached, and slips against the dynamic one",
          .keys = {quantity("dynamic", dimension, what + " that resists while it slips").positive(),
                   quantity("static", dimension, what + " that it holds while it sticks; left out: the dynamic one")
                       .positive()
                       .optional()}};
}
const Table& hinge_friction() {
  static const Table table = friction_table("hinge", dim::moment, "moment");
  return table;
}
const Table& slider_friction() {
  static const Table table = friction_table("slider", dim::force, "force");
  return table;
}

Key axis(const std::string& meaning) { return direction("axis", meaning); }

/// What a kind of joint measures its travel in.
struct Measure {
  const char* joint;
  hydro::Dimension travel, force;
};
const Measure of_slider{"slider", dim::length, dim::force}, of_hinge{"hinge", dim::angle, dim::moment};

Table stops_table(const Measure& m) {
  return {
      .title = std::string("[joint.pto.stops] of a ") + m.joint,
      .meaning = "ends of the travel: a spring and a damper that never pull",
      .keys = {quantity("lower", m.travel, "travel at which the lower one begins").optional(),
               quantity("upper", m.travel, "travel at which the upper one begins").optional(),
               quantity("stiffness", m.force / m.travel, "of the stop").positive(),
               quantity("damping", m.force / (m.travel / dim::time), "of the stop, as far as its spring presses")
                   .within(Limit::not_negative)
                   .or_default(m.travel == dim::angle ? "0 N m s/rad" : "0 N s/m", "a stop gives back what it takes")},
      .groups = {{Group::Count::at_least_one, {"lower", "upper"}}}};
}

Table pto_table(const Measure& m, const Table& stops) {
  const auto rate = m.travel / dim::time;
  return {
      .title = std::string("[joint.pto] of a ") + m.joint,
      .meaning = std::string("works against the travel of the ") + m.joint + ", zero at rest",
      .keys = {quantity("stiffness", m.force / m.travel, "of the spring; negative ones push away from rest").optional(),
               quantity("cubic", m.force / (m.travel * m.travel * m.travel), "of the spring, times the travel cubed")
                   .optional(),
               quantity("damping", m.force / rate, "of the damper").positive().optional(),
               quantity("quadratic_damping", m.force / (rate * rate), "of the damper, times rate times its size")
                   .positive()
                   .optional(),
               quantity("preload", m.force, "constant, against growing travel").optional(),
               quantity("force_limit", m.force, "that spring, damper and preload together cannot exceed")
                   .positive()
                   .optional(),
               inner_table("stops", stops).optional()},
      .groups = {
          {Group::Count::at_least_one, {"stiffness", "cubic", "damping", "quadratic_damping", "preload", "stops"}}}};
}

const Table& pto_of_slider() {
  static const Table stops = stops_table(of_slider), table = pto_table(of_slider, stops);
  return table;
}

const Table& pto_of_hinge() {
  static const Table stops = stops_table(of_hinge), table = pto_table(of_hinge, stops);
  return table;
}

}  // namespace

const Table& load_table() {
  static const Table table{
      .title = "[[load]]",
      .meaning = "a force and a moment that stay as they are: wind, a tow",
      .keys =
          {name_key("load", "of the load"), texts("on", "bodies it acts on, by name; * stands for any characters"),
           vector("at", dim::length, "where the force acts, body axes").or_default("(0, 0, 0) m", "the body's origin"),
           vector("force", dim::force, "global axes").optional(),
           vector("moment", dim::moment, "global axes").optional()},
      .groups = {{Group::Count::at_least_one, {"force", "moment"}}}};
  return table;
}

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
                    inner_table("friction", hinge_friction()).optional()}},
          {.word = "universal",
           .meaning = "the two turn about two axes across each other",
           .keys = {axis("that the first body holds, global at rest"),
                    direction("second_axis", "that the second body holds, across the first")}},
          {.word = "ball", .meaning = "the two turn freely about the point", .keys = {}},
          {.word = "slider",
           .meaning = "the second slides along an axis of the first and turns about nothing",
           .keys = {axis("along which it slides, held by the first, global at rest"),
                    inner_table("pto", pto_of_slider()).optional(),
                    inner_table("friction", slider_friction()).optional()}},
          {.word = "planar",
           .meaning = "the second slides in a plane of the first and turns about its normal",
           .keys = {axis("across the plane, held by the first, global at rest")}}}};
  return table;
}

}  // namespace froude::scene
