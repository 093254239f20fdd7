/// \file  The tables of lines that are stepped: droppers, chains of pendulums, cables.
#include "scene/schema_line.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using enum Group::Count;

const Table& link() {
  static const Table table{
      .title = "[[line.link]]",
      .meaning = "one rigid link, in order from `from`",
      .keys = {quantity("length", dim::length, "of the link").positive(),
               quantity("mass", dim::mass, "of the link").within(Limit::not_negative),
               number("centre", "of its mass: share of the length from its first node")
                   .within(Limit::fraction)
                   .or_default("0.5", "the middle"),
               quantity("inertia", dim::inertia, "about that centre, across; left out: a uniform rod's, m l^2/12")
                   .within(Limit::not_negative)
                   .optional()}};
  return table;
}

const Table& morison() {
  static const Table table{
      .title = "[line.morison]",
      .meaning = "drag, Froude-Krylov load and added mass of the segments where they are at each instant",
      .keys = {number("cd", "drag coefficient across the segment").within(Limit::not_negative).optional(),
               number("ca", "added mass over displaced mass, across the segment")
                   .within(Limit::not_negative)
                   .optional()
                   .only_beside("cd"),
               text("file",
                    "CSV beside the scene with KC, cd, ca and perhaps Re: each segment takes what belongs to the waves "
                    "that pass it at rest")
                   .optional(),
               quantity("viscosity", dim::length * dim::velocity, "kinematic, of the water, for Re")
                   .positive()
                   .optional()
                   .only_beside("file"),
               number("cd_tangential", "drag coefficient along the segment, of its skin pi D")
                   .within(Limit::not_negative)
                   .or_default("0", "a smooth cylinder has some 0.01")},
      .groups = {{exactly_one, {"cd", "file"}}}};
  return table;
}

const Table& damping() {
  static const Table table{
      .title = "[line.damping]",
      .meaning = "of each node, against its velocity",
      .keys = {quantity("linear", dim::mass / dim::time, "b_l of -b_l v").positive().optional(),
               quantity("quadratic", dim::mass / dim::length, "b_q of -b_q |v| v").positive().optional(),
               effect("componentwise", "-b_q |v_i| v_i for each component instead, which depends on the axes")
                   .optional()
                   .only_beside("quadratic")},
      .groups = {{at_least_one, {"linear", "quadratic"}}}};
  return table;
}

const Table& bed() {
  static const Table table{
      .title = "[line.bed]",
      .meaning = "the sea bed at the water's depth pushes back where the line sinks into it",
      .keys = {
          quantity("stiffness", dim::pressure / dim::length, "pressure per depth, on the line's diameter").positive(),
          quantity("damping", dim::pressure / dim::velocity, "pressure per velocity; never pulls")
              .within(Limit::not_negative)
              .or_default("0 Pa s/m", "what is not named does not act"),
          number(
              "friction",
              "what lies on the bed is held by up to this times its weight on it; none at rest, before anything moves")
              .positive()
              .optional()}};
  return table;
}

const Table& release() {
  static const Table table{.title = "[line.release]",
                           .meaning = "the line starts at rest with one node held, and is let go at t = 0",
                           .keys = {integer("node", "counted from 0 at `from`").within(Limit::at_least_one),
                                    vector("at", dim::length, "where it is held, global")}};
  return table;
}

const Table& prescribed() {
  static const Table table{
      .title = "[line.prescribed]",
      .meaning = "the motion of one end, along a path",
      .keys = {text("end", "which: \"from\" or \"to\"").one_of({"from", "to"}),
               text("file", "CSV beside the scene with time, x, y, z; a cubic spline goes through its points")}};
  return table;
}

const Table& snaps() {
  static const Table table{
      .title = "[line.snaps]",
      .meaning = "counts slack and snaps over the steps of a run, and tells the largest tension",
      .keys = {
          quantity("slack_below", dim::force, "a link with this tension or less is slack").within(Limit::not_negative),
          quantity("snap_above", dim::force, "a link that was slack snaps when it reaches this").positive()}};
  return table;
}

const Table& lyapunov() {
  static const Table table{
      .title = "[line.lyapunov]",
      .meaning =
          "the largest Lyapunov exponent of a run: a second line a millionth of a segment beside the first tells how "
          "fast neighbours part",
      .keys = {quantity("from", dim::time, "growth counts from here on, when the start is forgotten").positive()}};
  return table;
}

const Table& part() {
  static const Table table{
      .title = "[[line.part]]",
      .meaning = "an even part of a line, in order from `from`: chain, rope, chain",
      .keys = {quantity("length", dim::length, "of the part without tension").positive(),
               integer("segments", "into which it is cut").within(Limit::at_least_one),
               quantity("mass_per_length", dim::mass / dim::length, "of the part").positive(),
               quantity("diameter", dim::length, "left out: that of the line").positive().optional(),
               quantity("axial_stiffness", dim::force, "EA; left out: that of the line").positive().optional(),
               quantity("bending_stiffness", dim::force * dim::length * dim::length, "EI; left out: that of the line")
                   .positive()
                   .optional()}};
  return table;
}

const Table& growth() {
  static const Table table{
      .title = "[line.growth]",
      .meaning =
          "a layer around the segments whose middle is between two distances along the line: it has mass, and "
          "widens the diameter that water and bed meet",
      .keys = {quantity("thickness", dim::length, "of the layer").positive(),
               quantity("density", dim::density, "of what grows, in air").positive(),
               quantity("from", dim::length, "distance from the line's first end")
                   .within(Limit::not_negative)
                   .or_default("0 m", "from there on"),
               quantity("to", dim::length, "likewise; left out: to the other end").positive().optional()}};
  return table;
}

const Table& clamp() {
  static const Table table{
      .title = "[line.clamp]",
      .meaning = "ends that do not turn: the direction in which the line goes there, from its first node to its last",
      .keys = {direction("from", "at the first node: \"x\" or \"(1, 0, -1)\"").optional(),
               direction("to", "at the last node, still from first to last").optional()},
      .groups = {{at_least_one, {"from", "to"}}}};
  return table;
}

const Table& on() {
  static const Table table{
      .title = "[line.on]",
      .meaning =
          "what ends of the line are on: a body, and `from` or `to` is then in its axes; or a junction or a node "
          "of a line, \"main.node4\", whose place is found, so that `from` or `to` is left out",
      .keys = {text("from", "of the first node, by name").optional(),
               text("to", "of the last node, by name").optional()},
      .groups = {{at_least_one, {"from", "to"}}}};
  return table;
}

const Table& sphere_morison() {
  static const Table table{.title = "[junction.morison]",
                           .meaning = "drag, Froude-Krylov load and added mass of the sphere",
                           .keys = {number("cd", "drag coefficient, of its section").within(Limit::not_negative),
                                    number("ca", "added mass over displaced mass")
                                        .within(Limit::not_negative)
                                        .or_default("0.5", "of a sphere in unbounded water")}};
  return table;
}

}  // namespace

const Table& junction_table() {
  static const Table table{
      .title = "[[junction]]",
      .meaning =
          "a place that nothing holds, at which lines meet that name it in [line.on]; where it is follows from "
          "them. With mass or diameter a float or sinker, on one line too",
      .keys = {name_key("junction", "of the junction"),
               quantity("mass", dim::mass, "of what is there besides the lines").positive().optional(),
               quantity("diameter", dim::length, "of a sphere that the water meets").positive().optional(),
               inner_table("morison", sphere_morison()).optional().only_beside("diameter"),
               effect("buoyancy", "weight of the water that the sphere displaces").optional().only_beside("diameter"),
               effect("partial_immersion", "only what is under the waves is wet; left out: all of it, always")
                   .optional()
                   .only_beside("diameter")}};
  return table;
}

const Table& line_table() {
  static const Table table{
      .title = "[[line]]",
      .meaning = "a chain of nodes and straight segments between two places: dropper, cable, pendulums; it has weight",
      .keys = {name_key("line", "of the line"),
               vector("from", dim::length,
                      "where its first node is held, global; of a body that holds it, in body axes; left out: it meets "
                      "what `on` names")
                   .optional(),
               vector("to", dim::length, "where its last node is held, as `from`; left out: a free end, or as `from`")
                   .optional(),
               inner_table("on", on()).optional(),
               quantity("length", dim::length, "of the line without tension").positive().optional(),
               integer("segments", "into which it is cut").within(Limit::at_least_one).optional().only_beside("length"),
               quantity("mass_per_length", dim::mass / dim::length, "of the line")
                   .positive()
                   .optional()
                   .only_beside("length"),
               text("mass_at", "\"nodes\": half a segment's mass at either end; \"segments\": spread along it")
                   .one_of({"nodes", "segments"})
                   .or_default("segments", "as a line has it"),
               inner_tables("part", part()).optional(),
               inner_tables("link", link()).optional(),
               quantity("node_mass", dim::mass, "of a bob, pin or clump at every node that is not held")
                   .positive()
                   .optional(),
               quantity("diameter", dim::length, "that the water and the bed meet").positive().optional(),
               quantity("axial_stiffness", dim::force, "EA: tension per strain; left out: segments are inextensible")
                   .positive()
                   .optional(),
               quantity("axial_damping", dim::force * dim::time, "tension per rate of strain")
                   .positive()
                   .optional()
                   .only_beside("axial_stiffness"),
               quantity("bending_stiffness", dim::force * dim::length * dim::length,
                        "EI: moment per curvature; left out: the line bends freely")
                   .positive()
                   .optional(),
               inner_table("clamp", clamp()).optional().only_beside("bending_stiffness"),
               effect("tension_only", "segments go slack instead of being pressed")
                   .optional()
                   .only_beside("axial_stiffness"),
               effect(
                   "catenary_segments",
                   "segments hang through between their nodes by their weight in water, and rest on the bed in part: "
                   "moorings with few segments; with lines = \"generalized_alpha\"")
                   .optional()
                   .only_beside("axial_stiffness"),
               effect("buoyancy", "weight of the water that it displaces").optional().only_beside("diameter"),
               effect("partial_immersion", "only what is under the waves is wet; left out: all of it, always")
                   .optional()
                   .only_beside("diameter"),
               inner_table("morison", morison()).optional().only_beside("diameter"),
               inner_table("damping", damping()).optional(),
               inner_table("growth", growth()).optional().only_beside("diameter"),
               inner_table("bed", bed()).optional().only_beside("diameter"),
               inner_table("release", release()).optional(),
               inner_table("prescribed", prescribed()).optional(),
               inner_table("snaps", snaps()).optional(),
               inner_table("lyapunov", lyapunov()).optional()},
      .groups = {{exactly_one, {"length", "part", "link"}}, {at_most_one, {"tension_only", "catenary_segments"}}}};
  return table;
}

}  // namespace froude::scene
