/// \file  `[[load]]`
#include "scene/build.hpp"

namespace froude::scene {

const Table& load_table() {
  static const Table table{
      .title = "[[load]]",
      .meaning = "a force and a moment that stay as they are: wind, a tow",
      .keys = {name_key("load", "of the load"), texts("on", "bodies it acts on, by name; * stands for any characters"),
               vector("at", hydro::dim::length, "where the force acts, body axes")
                   .or_default("(0, 0, 0) m", "the body's origin"),
               vector("force", hydro::dim::force, "global axes").optional(),
               vector("moment", hydro::dim::moment, "global axes").optional()},
      .groups = {{Group::Count::at_least_one, {"force", "moment"}}}};
  return table;
}

void build_loads(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("load")) {
    const auto part = [&](std::string_view key) {
      return record.has(key) ? record.vector(key) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    };
    const auto on = bodies_on(record, "on", scene.bodies);
    const auto name = names.of(record, on.size());
    for (std::size_t b = 0; b < on.size(); ++b)
      scene.loads.push_back({name[b], on[b], record.vector("at"), part("force"), part("moment"), record.place()});
  }
}

}  // namespace froude::scene
