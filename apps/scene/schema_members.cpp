/// \file  The tables of slender members.
#include "scene/schema_members.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using enum Group::Count;

const Table& drag() {
  static const Table table{
      .title = "[member.drag]",
      .meaning =
          "½ ρ cd D ‖u‖ u per length, of the flow across the member; water as it moves where the member is at rest",
      .keys = {number("cd", "drag coefficient").positive()}};
  return table;
}

Key pieces_key() {
  return integer("pieces", "into which the member is cut; left out: as many as the accuracy asked needs")
      .within(Limit::at_least_one)
      .optional();
}

const Table& morison() {
  static const Table table{
      .title = "[member.morison]",
      .meaning = "drag, Froude-Krylov load and added mass of the member where it is at each instant",
      .keys = {number("cd", "drag coefficient across the member").within(Limit::not_negative),
               number("ca", "added mass over displaced mass, across the member").within(Limit::not_negative),
               number("cd_tangential", "drag coefficient along the member, of its skin pi D")
                   .within(Limit::not_negative)
                   .or_default("0", "a smooth cylinder has some 0.01"),
               effect("partial_immersion", "only the part under water is loaded; left out: the member is always wet")
                   .optional(),
               text("surface", "that partial immersion goes by: \"waves\", or \"still\" water")
                   .one_of({"waves", "still"})
                   .or_default("waves", "the surface is where the waves are")
                   .only_beside("partial_immersion"),
               pieces_key()}};
  return table;
}

const Table& slamming() {
  static const Table table{
      .title = "[member.slamming]",
      .meaning = "impact of water on the member, once for each piece that goes under",
      .keys = {
          text("model",
               "\"goda\" or \"von karman\": the plate below the undisturbed surface; \"wienke\": water "
               "piled up beside the member")
              .one_of({"goda", "von karman", "wienke"}),
          text("begins",
               "what goes under when the impact begins: the \"underside\", the \"line\" of the axis, or "
               "all, \"submerged\"")
              .one_of({"underside", "line", "submerged"})
              .or_default("line", "between the first touch and the last"),
          number("factor", "by which the model's force is multiplied").positive().or_default("1", "the model itself"),
          pieces_key()}};
  return table;
}

}  // namespace

const Table& member_table() {
  static const Table table{
      .title = "[[member]]",
      .meaning = "a slender cylinder fixed to a body; what is named acts on it",
      .keys = {name_key("member", "of the member"),
               texts("on", "bodies that carry it, by name; * stands for any characters"),
               points("from", "one end, body axes; each ± makes two members"),
               points("to", "other end, body axes; as many as `from`, taken in pairs"),
               quantity("diameter", dim::length, "of the member").positive(), inner_table("drag", drag()).optional(),
               inner_table("morison", morison()).optional(), inner_table("slamming", slamming()).optional()},
      .groups = {{at_most_one, {"drag", "morison"}}, {at_least_one, {"drag", "morison", "slamming"}}}};
  return table;
}

}  // namespace froude::scene
