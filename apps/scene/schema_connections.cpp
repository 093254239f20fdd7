/// \file  What holds bodies to the ground and to each other.
#include "scene/schema_connections.hpp"

#include "scene/schema_modes.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using enum Group::Count;

/// The six diagonal and fifteen other entries of a symmetric 6 × 6 matrix: surge, …, yaw, surge_sway, …, pitch_yaw.
std::vector<Key> keys_of_matrix(const hydro::Dimension& translation, const std::string& what) {
  std::vector<Key> keys;
  const auto entry = [&](std::size_t i, std::size_t j) {
    auto dimension = translation;  // N/m → N/rad → N m/rad
    if (rotates(i) != rotates(j)) dimension = translation * dim::length / dim::angle;
    if (rotates(i) && rotates(j)) dimension = translation * dim::area / dim::angle;
    const std::string row(hydro::mode_names[i]), column(hydro::mode_names[j]);
    keys.push_back(i == j ? quantity(row, dimension, "load in " + row + " per " + what + " in " + row).optional()
                          : quantity(row + "_" + column, dimension,
                                     "load in " + row + " per " + what + " in " + column + ", and the reverse")
                                .optional());
  };
  for (std::size_t i = 0; i < 6; ++i) entry(i, i);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j) entry(i, j);
  return keys;
}

const Table& mooring_stiffness() {
  static const Table table = at_least_one_of("[mooring.stiffness]", "about the body's origin, at rest; symmetric",
                                             keys_of_matrix(dim::stiffness, "displacement"));
  return table;
}

const Table& mooring_damping() {
  static const Table table = at_least_one_of("[mooring.damping]", "about the body's origin; symmetric",
                                             keys_of_matrix(dim::damping, "velocity"));
  return table;
}

Key rest_length() {
  return quantity("rest_length", dim::length, "without tension, or \"as placed\": the distance of the ends at rest")
      .positive()
      .one_of({"as placed"})
      .or_default("as placed", "so that the scene is at rest where it is placed");
}

const Table& switch_setting() {
  static const Table table{
      .title = "[[connector.switch.settings]]",
      .meaning = "a stiffness from some period on",
      .keys = {quantity("from", dim::time, "period; the first is \"0 s\"").within(Limit::not_negative),
               quantity("stiffness", dim::stiffness, "of each connector").positive()}};
  return table;
}

const Table& connector_switch() {
  static const Table table{
      .title = "[connector.switch]",
      .meaning = "sets the stiffness by the period that dominates a motion, once two checks in turn agree",
      .keys = {text("watch", "a motion, like \"m2.surge\""),
               quantity("every", dim::time, "from one check to the next").positive(),
               quantity("window", dim::time,
                        "of the motion that a check looks at; some periods; the first check is when it is full")
                   .positive(),
               quantity("hysteresis", dim::angular_velocity,
                        "by which the frequencies of two checks in turn may differ: \"0.001 Hz\"")
                   .positive(),
               quantity("dwell", dim::time, "least time between two switches")
                   .within(Limit::not_negative)
                   .or_default("0 s", "two checks that agree are enough"),
               inner_tables("settings", switch_setting())}};
  return table;
}

const Table& catenary_table() {
  static const Table table{
      .title = "[mooring.table]",
      .meaning = "the shape is looked up where the fairlead is near its place at rest, and solved elsewhere",
      .keys = {quantity("reach", dim::length, "of the table about rest, horizontally and vertically").positive(),
               number("tolerance", "largest error of the pull, of the largest pull in reach")
                   .within(Limit::open_fraction)
                   .or_default("1e-4",
                               "far below what drag and friction on the bed, which a catenary leaves out, amount to")}};
  return table;
}

}  // namespace

const Table& mooring_table() {
  static const Table table{
      .title = "[[mooring]]",
      .meaning = "what holds a body in place",
      .keys = {name_key("mooring", "of the mooring"),
               texts("on", "bodies it holds, by name; * stands for any characters"), text("kind", "of mooring")},
      .chosen_by = "kind",
      .variants = {
          {.word = "linear",
           .meaning = "load proportional to displacement and velocity",
           .keys = {inner_table("stiffness", mooring_stiffness()).optional(),
                    inner_table("damping", mooring_damping()).optional()},
           .groups = {{at_least_one, {"stiffness", "damping"}}}},
          {.word = "catenary",
           .meaning = "elastic lines in their static shape, from each body to the ground",
           .keys = {points("from", "fairlead, body axes; each ± makes two lines"),
                    points("to", "anchor, global; as many as `from`, taken in pairs"),
                    quantity("length", dim::length, "of the line without tension").positive(),
                    quantity("mass_per_length", dim::mass / dim::length, "of the line, in air").positive(),
                    quantity("diameter", dim::length, "of the line, by the water that it displaces").positive(),
                    quantity("axial_stiffness", dim::force, "EA: tension per strain").positive(),
                    effect("on_bed", "the anchor lies on a flat bed, on which the line may rest, without friction")
                        .optional(),
                    inner_table("table", catenary_table()).optional()}}}};
  return table;
}

const Table& connector_table() {
  static const Table table{
      .title = "[[connector]]",
      .meaning = "joins a point of one body to a point of another, or to the ground",
      .keys = {name_key("connector", "of the connector"),
               texts("between",
                     "[\"a\", \"b\"], [\"a\", \"ground\"], or \"neighbours of m\": m1–m2, m2–m3, … of the copies m"),
               ends("ends",
                    "[end on the first, end on the second], body axes (ground: global axes); ± makes several, taken in "
                    "pairs"),
               text("kind", "of connector")},
      .chosen_by = "kind",
      .variants = {
          {.word = "axial",
           .meaning = "a load along the line between its ends",
           .keys = {quantity("stiffness", dim::stiffness, "tension per elongation").positive().optional(),
                    quantity("cubic", dim::stiffness / dim::area, "tension per elongation cubed, beside stiffness")
                        .optional()
                        .only_beside("stiffness"),
                    quantity("damping", dim::damping, "tension per rate of elongation").positive().optional(),
                    quantity("quadratic_damping", dim::force / (dim::velocity * dim::velocity),
                             "tension per rate of elongation times its size")
                        .positive()
                        .optional(),
                    rest_length().only_beside("stiffness"),
                    inner_table("switch", connector_switch()).optional().only_beside("stiffness")},
           .groups = {{at_least_one, {"stiffness", "damping", "quadratic_damping"}}}},
          {.word = "tabulated",
           .meaning = "as axial, with a spring by a table",
           .keys = {text("table",
                         "CSV beside the scene: columns elongation [m], increasing, and tension [N], not falling; "
                         "straight between points and beyond the ends"),
                    quantity("damping", dim::damping, "tension per rate of elongation").positive().optional(),
                    rest_length()},
           .groups = {}},
          {.word = "cable",
           .meaning = "as axial, but it never pushes: slack where it is shorter than its rest length",
           .keys = {quantity("stiffness", dim::stiffness, "tension per elongation").positive(),
                    quantity("damping", dim::damping, "tension per rate of elongation, as far as the cable is tight")
                        .positive()
                        .optional(),
                    rest_length()},
           .groups = {}},
          {.word = "bushing",
           .meaning = "loads and moments along the axes of the first body",
           .keys = {vector("stiffness", dim::stiffness, "along x, y, z").within(Limit::not_negative).optional(),
                    vector("damping", dim::damping, "along x, y, z").within(Limit::not_negative).optional(),
                    vector("rotational_stiffness", dim::rotational_stiffness, "about x, y, z")
                        .within(Limit::not_negative)
                        .optional(),
                    vector("rotational_damping", dim::rotational_damping, "about x, y, z")
                        .within(Limit::not_negative)
                        .optional()},
           .groups = {{at_least_one, {"stiffness", "damping", "rotational_stiffness", "rotational_damping"}}}}}};
  return table;
}

}  // namespace froude::scene
