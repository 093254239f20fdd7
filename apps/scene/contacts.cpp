#include <fmt/format.h>

#include "scene/build.hpp"

namespace froude::scene {
namespace {

ContactRod read_rod(const Record& record) {
  return {record.vector("from"), record.vector("to"), record.si("diameter") / 2};
}

ContactBox read_box(const Record& record) {
  const Eigen::Vector3d from = record.vector("from"), to = record.vector("to");
  if (!((to - from).cwiseAbs().minCoeff() > 0))
    throw record.wrong("to", "makes a box without volume", "give the corner opposite to `from`");
  return {(from + to) / 2, (to - from).cwiseAbs() / 2};
}

/// Shapes of the first body, each a contact of its own.
std::vector<ContactRod> read_first(const Record& record) {
  if (record.text("kind") == "rods") return {read_rod(record.table("first"))};
  std::vector<ContactRod> out;
  const double radius = record.has("radius") ? record.si("radius") : 0;
  for (const Eigen::Vector3d& p : record["points"].points.front()) out.push_back({p, p, radius});
  return out;
}

decltype(Contact::on_second) read_second(const Record& record) {
  if (record.text("kind") == "rods") return read_rod(record.table("second"));
  if (record.text("kind") == "box") return read_box(record);
  return ContactPlane{record.vector("at"), record.vector("normal").normalized()};
}

}  // namespace

void build_contacts(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("contact")) {
    const auto pairs = read_between(record, scene.bodies, GroundFirst::refused);
    const auto first = read_first(record);
    const auto second = read_second(record);
    const auto name = names.of(record, pairs.size() * first.size());
    for (std::size_t p = 0, n = 0; p < pairs.size(); ++p)
      for (const ContactRod& shape : first)
        scene.contacts.push_back({name[n++], *pairs[p].first, pairs[p].second, shape, second,
                                  record["restitution"].number, record.has("friction") ? record["friction"].number : 0,
                                  record.place()});
  }
}

}  // namespace froude::scene
