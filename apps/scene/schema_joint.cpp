#include "scene/schema_joint.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

Table friction_table(const hydro::Dimension& dimension, const std::string& what) {
  return {.title = "[joint.friction]",
          .meaning =
              "Coulomb friction: the joint sticks until the static level is reached, and slips against the dynamic one",
          .keys = {quantity("dynamic", dimension, what + " that resists while it slips").positive(),
                   quantity("static", dimension, what + " that it holds while it sticks; left out: the dynamic one")
                       .positive()
                       .optional()}};
}
const Table& hinge_friction() {
  static const Table table = friction_table(dim::moment, "moment");
  return table;
}
const Table& slider_friction() {
  static const Table table = friction_table(dim::force, "force");
  return table;
}

Key axis(const std::string& meaning) { return direction("axis", meaning); }

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
      .variants = {{.word = "fixed", .meaning = "nothing moves", .keys = {}},
                   {.word = "hinge",
                    .meaning = "the two turn about one axis",
                    .keys = {axis("about which they turn, global at rest"),
                             inner_table("friction", hinge_friction()).optional()}},
                   {.word = "universal",
                    .meaning = "the two turn about two axes across each other",
                    .keys = {axis("that the first body holds, global at rest"),
                             direction("second_axis", "that the second body holds, across the first")}},
                   {.word = "ball", .meaning = "the two turn freely about the point", .keys = {}},
                   {.word = "slider",
                    .meaning = "the second slides along an axis of the first and turns about nothing",
                    .keys = {axis("along which it slides, held by the first, global at rest"),
                             inner_table("friction", slider_friction()).optional()}},
                   {.word = "planar",
                    .meaning = "the second slides in a plane of the first and turns about its normal",
                    .keys = {axis("across the plane, held by the first, global at rest")}}}};
  return table;
}

}  // namespace froude::scene
