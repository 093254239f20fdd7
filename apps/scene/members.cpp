#include <fmt/format.h>

#include <map>

#include "scene/build.hpp"

namespace froude::scene {
namespace {

std::optional<int> read_pieces(const Record& record) {
  if (!record.has("pieces")) return std::nullopt;
  constexpr std::int64_t most = 100'000;
  if (record["pieces"].integer > most) throw record.wrong("pieces", fmt::format("is more than {}", most));
  return static_cast<int>(record["pieces"].integer);
}

Morison read_morison(const Record& record) {
  Morison out{.cd = record.si("cd"), .ca = record.si("ca"), .cd_tangential = record.si("cd_tangential")};
  out.partial = record.has("partial_immersion");
  out.still = out.partial && record.text("surface") == "still";
  out.pieces = read_pieces(record);
  return out;
}

Slamming read_slamming(const Record& record) {
  static const std::map<std::string, Slamming::Model, std::less<>> models{{"goda", Slamming::Model::goda},
                                                                          {"wienke", Slamming::Model::wienke},
                                                                          {"von karman", Slamming::Model::von_karman}};
  static const std::map<std::string, Slamming::Begins, std::less<>> begins{{"underside", Slamming::Begins::underside},
                                                                           {"line", Slamming::Begins::line},
                                                                           {"submerged", Slamming::Begins::submerged}};
  return {models.at(record.text("model")), begins.at(record.text("begins")), record.si("factor"), read_pieces(record)};
}

/// What acts on the member, without name, body and ends.
Member read_member(const Record& record) {
  Member out;
  out.diameter = record.si("diameter");
  if (record.has("drag")) out.cd = record.table("drag").si("cd");
  if (record.has("morison")) out.morison = read_morison(record.table("morison"));
  if (record.has("slamming")) out.slamming = read_slamming(record.table("slamming"));
  out.place = record.place();
  return out;
}

}  // namespace

void build_members(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("member")) {
    const auto& from = record["from"].points.front();
    const auto& to = record["to"].points.front();
    if (from.size() != to.size())
      throw record.wrong("to", fmt::format("stands for {} points and from for {}", to.size(), from.size()),
                         "use as many ± in one as in the other");
    for (std::size_t k = 0; k < from.size(); ++k)
      if (from[k] == to[k]) throw record.wrong("to", "is the same point as from", "a member has a length");
    Member one = read_member(record);
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
