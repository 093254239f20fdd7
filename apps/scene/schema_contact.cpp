#include "scene/schema_contact.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Table& rod_table() {
  static const Table table{.title = "a rod of [[contact]]",
                           .meaning = "a cylinder with round ends",
                           .keys = {vector("from", dim::length, "middle of one end, body axes (ground: global axes)"),
                                    vector("to", dim::length, "middle of the other end"),
                                    quantity("diameter", dim::length, "of the rod").positive()}};
  return table;
}

Key balls() { return points("points", "on the first body, body axes; each ± makes two, each a contact of its own"); }
Key ball_radius() {
  return quantity("radius", dim::length, "of a ball about each point; left out: the point itself")
      .positive()
      .optional();
}

}  // namespace

const Table& contact_table() {
  static const Table table{
      .title = "[[contact]]",
      .meaning = "shapes of two bodies that do not pass through each other; they touch, slip, stick and part",
      .keys = {name_key("contact", "of the contact"),
               texts("between",
                     "[\"a\", \"b\"], [\"a\", \"ground\"], or \"neighbours of m\": m1–m2, m2–m3, … of the copies m"),
               number("restitution", "share of the speed of approach that comes back, 0 to 1").within(Limit::fraction),
               number("friction", "Coulomb's coefficient; left out: smooth").positive().optional(),
               text("kind", "of the second body's shape")},
      .chosen_by = "kind",
      .variants = {{.word = "plane",
                    .meaning = "points or balls of the first against a plane of the second: a wall, a quay, a floor",
                    .keys = {balls(), ball_radius(),
                             vector("at", dim::length, "a point of the plane, axes of the second (ground: global)"),
                             direction("normal", "out of the second, its axes (ground: global)")},
                    .groups = {}},
                   {.word = "box",
                    .meaning = "points or balls of the first against a box of the second",
                    .keys = {balls(), ball_radius(),
                             vector("from", dim::length, "one corner, axes of the second (ground: global)"),
                             vector("to", dim::length, "the corner opposite to it")},
                    .groups = {}},
                   {.word = "rods",
                    .meaning = "a cylinder with round ends of the first against one of the second",
                    .keys = {inner_table("first", rod_table()), inner_table("second", rod_table())},
                    .groups = {}}}};
  return table;
}

}  // namespace froude::scene
