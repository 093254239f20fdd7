/// \file  `[[member]]`: slender cylinders fixed to bodies.
#include <fmt/format.h>

#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using dynamics::MorisonMember;
using dynamics::SlammingMember;

Binding<Member> member_drag() {
  return Binding<Member>(
             "[member.drag]",
             "½ ρ cd D ‖u‖ u per length, of the flow across the member; water as it moves where the member is at rest")
      .key(number("cd", "drag coefficient").positive(), &Member::cd);
}

Key pieces_key() {
  return integer("pieces", "into which the member is cut; left out: as many as the accuracy asked needs")
      .within(Limit::at_least_one)
      .optional();
}

Binding<MorisonMember> member_morison() {
  using enum dynamics::Immersion;
  return Binding<MorisonMember>("[member.morison]",
                                "drag, Froude-Krylov load and added mass of the member where it is at each instant")
      .key(number("cd", "drag coefficient across the member").within(Limit::not_negative), &MorisonMember::cd)
      .key(number("ca", "added mass over displaced mass, across the member").within(Limit::not_negative),
           &MorisonMember::ca)
      .key(number("cd_tangential", "drag coefficient along the member, of its skin pi D")
               .within(Limit::not_negative)
               .or_default("0", "a smooth cylinder has some 0.01"),
           &MorisonMember::cd_tangential)
      .key(effect("partial_immersion", "only the part under water is loaded; left out: the member is always wet"))
      .key(text("surface", "that partial immersion goes by: \"waves\", or \"still\" water")
               .one_of({"waves", "still"})
               .or_default("waves", "the surface is where the waves are")
               .only_beside("partial_immersion"))
      .key(pieces_key(), &MorisonMember::line, &dynamics::SlenderMember::pieces)
      .at_most(100'000)
      .then([](const Record& record, MorisonMember& out) {
        out.line.immersion = !record.has("partial_immersion")    ? whole
                             : record.text("surface") == "still" ? still_water
                                                                 : surface;
      });
}

Binding<SlammingMember> member_slamming() {
  using enum hydro::waves::ImpactTheory;
  using dynamics::ImpactBegins;
  return Binding<SlammingMember>("[member.slamming]",
                                 "impact of water on the member, once for each piece that goes under")
      .words(text("model",
                  "\"goda\" or \"von karman\": the plate below the undisturbed surface; \"wienke\": water "
                  "piled up beside the member"),
             {{"goda", goda}, {"von karman", von_karman}, {"wienke", wienke_oumeraci}}, &SlammingMember::theory)
      .words(text("begins",
                  "what goes under when the impact begins: the \"underside\", the \"line\" of the axis, or "
                  "all, \"submerged\"")
                 .or_default("line", "between the first touch and the last"),
             {{"underside", ImpactBegins::underside},
              {"line", ImpactBegins::line},
              {"submerged", ImpactBegins::submerged}},
             &SlammingMember::begins)
      .key(number("factor", "by which the model's force is multiplied").positive().or_default("1", "the model itself"),
           &SlammingMember::factor)
      .key(pieces_key(), &SlammingMember::line, &dynamics::SlenderMember::pieces)
      .at_most(100'000)
      .then([](const Record&, SlammingMember& out) { out.line.immersion = dynamics::Immersion::surface; });
}

Binding<EndLoads> member_ends() {
  return Binding<EndLoads>("[member.ends]",
                           "loads along the member on flat ends that stay under water, or on plates there")
      .key(texts("at", "which ends: \"from\", \"to\" or both").one_of({"from", "to"}))
      .key(effect("pressure", "waves press on the end, an area of the member's diameter"), &EndLoads::pressure)
      .key(number("cd", "drag coefficient along the member, of the area of the end or its plate")
               .within(Limit::not_negative)
               .or_default("0", "a flat end has about 1, a thin plate that swings 2 to 10"),
           &EndLoads::cd)
      .key(number("ca", "water that goes along with the end, over that of half a sphere of its diameter")
               .within(Limit::not_negative)
               .or_default("0", "a face of a thin disc has 2/pi, 0.64"),
           &EndLoads::ca)
      .key(quantity("diameter", dim::length, "of the plate; left out: that of the member").positive().optional(),
           &EndLoads::diameter)
      .then([](const Record& record, EndLoads& out) {
        for (const auto& end : record["at"].texts) (end.value == "from" ? out.from : out.to) = true;
        if (!out.pressure && out.cd == 0 && out.ca == 0)
          throw record.refused("names no load", "add pressure = true, cd or ca, or leave the table out");
      });
}

/// A member without name, body and ends.
const Binding<Member>& member() {
  static const Binding<Member> binding =
      Binding<Member>("[[member]]", "a slender cylinder fixed to a body; what is named acts on it")
          .place(&Member::place)
          .key(name_key("member", "of the member"))
          .key(texts("on", "bodies that carry it, by name; * stands for any characters"))
          .key(points("from", "one end, body axes; each ± makes two members"))
          .key(points("to", "other end, body axes; as many as `from`, taken in pairs"))
          .key(quantity("diameter", dim::length, "of the member").positive(), &Member::diameter)
          .table("drag", member_drag())
          .table("morison", member_morison(), &Member::morison)
          .table("slamming", member_slamming(), &Member::slamming)
          .table("ends", member_ends(), &Member::ends)
          .key(effect("loads",
                      "signals NAME.morison_force_x, NAME.slamming_force_x, NAME.ends_force_x, … "
                      "NAME.ends_moment_z: the load of each of the three on the body, about its origin, along global "
                      "axes")
                   .only_beside_one_of({"morison", "slamming", "ends"}),
               &Member::loads)
          .at_most_one_of({"drag", "morison"})
          .at_least_one_of({"drag", "morison", "slamming", "ends"});
  return binding;
}

}  // namespace

bool has_drag(const Member& m) {
  return m.cd || (m.morison && (m.morison->cd > 0 || m.morison->cd_tangential > 0)) || (m.ends && m.ends->cd > 0);
}

const Table& member_table() { return member().table(); }

void build_members(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("member")) {
    const auto& from = record["from"].points.front();
    const auto& to = record["to"].points.front();
    if (from.size() != to.size())
      throw record.wrong("to", fmt::format("stands for {} points and from for {}", to.size(), from.size()),
                         "use as many ± in one as in the other");
    for (std::size_t k = 0; k < from.size(); ++k)
      if (from[k] == to[k]) throw record.wrong("to", "is the same point as from", "a member has a length");
    Member one = member().read(record);
    const auto on = bodies_on(record, "on", scene.bodies);
    const auto name = names.of(record, on.size() * from.size());
    for (std::size_t b = 0, n = 0; b < on.size(); ++b)
      for (std::size_t k = 0; k < from.size(); ++k, ++n) {
        one.name = name[n];
        one.body = on[b];
        one.from = from[k];
        one.to = to[k];
        scene.members.push_back(one);
      }
  }
}

}  // namespace froude::scene
