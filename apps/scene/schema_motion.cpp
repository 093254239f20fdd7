/// \file  The root table of a scene of motion.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "scene/binding.hpp"
#include "scene/build.hpp"
#include "scene/element.hpp"
#include "scene/schema.hpp"

namespace froude::scene {
namespace {

Table motion_table() {
  return {
      .title = "a scene",
      .meaning = "floating bodies in waves",
      .keys = {integer("schema", "version of this grammar, 1"), text("title", "for people").optional(),
               texts("include",
                     "results of `froude fit -o`: with \"fit.toml\", a text \"fit.cd\" stands for the number cd of its "
                     "[coefficients]")
                   .optional(),
               inner_table("water", water_table()), inner_table("waves", waves_binding().table()).optional(),
               inner_table("current", current_table()).optional(), inner_tables("body", body_table()).optional(),
               inner_tables("probe", probe_table()).optional(), inner_tables("point", point_table()).optional(),
               inner_tables("relative_motion", relative_motion_table()).optional(),
               inner_tables("member", member_table()).optional(), inner_tables("line", line_table()).optional(),
               inner_tables("junction", junction_table()).optional(),
               inner_tables("mooring", mooring_table()).optional(),
               inner_tables("connector", connector_table()).optional(), inner_tables("joint", joint_table()).optional(),
               inner_tables("contact", contact_table()).optional(), inner_table("ask", ask_binding().table()),
               inner_table("solve", solve_binding().table()).or_default("", "see its keys")}};
}

/// The tables of force elements stand before [[contact]].
Table with_elements(Table root) {
  const auto at = [&](const std::string& name) {
    return std::find_if(root.keys.begin(), root.keys.end(), [&](const Key& key) { return key.name == name; });
  };
  for (const auto& element : element_tables()) {
    if (at(element->name()) != root.keys.end())
      throw std::logic_error(fmt::format("the grammar has [[{}]] already", element->name()));
    root.keys.insert(at("contact"), inner_tables(element->name(), element->keys()).optional());
  }
  return root;
}

}  // namespace

const Table& motion_schema() {
  static const Table table = with_elements(motion_table());
  return table;
}

}  // namespace froude::scene
