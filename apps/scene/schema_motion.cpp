/// \file  The root table of a scene of motion.
#include "scene/build.hpp"
#include "scene/schema.hpp"
#include "scene/schema_ask.hpp"
#include "scene/schema_connections.hpp"
#include "scene/schema_contact.hpp"
#include "scene/schema_joint.hpp"
#include "scene/schema_signals.hpp"
#include "scene/schema_waves.hpp"

namespace froude::scene {

const Table& motion_schema() {
  static const Table table{
      .title = "a scene",
      .meaning = "floating bodies in waves",
      .keys = {integer("schema", "version of this grammar, 1"),
               text("title", "for people").optional(),
               texts("include",
                     "results of `froude fit -o`: with \"fit.toml\", a text \"fit.cd\" stands for the number cd of its "
                     "[coefficients]")
                   .optional(),
               inner_table("water", water_table()),
               inner_table("waves", waves_table()).optional(),
               inner_table("current", current_table()).optional(),
               inner_tables("body", body_table()).optional(),
               inner_tables("probe", probe_table()).optional(),
               inner_tables("point", point_table()).optional(),
               inner_tables("relative_motion", relative_motion_table()).optional(),
               inner_tables("member", member_table()).optional(),
               inner_tables("line", line_table()).optional(),
               inner_tables("junction", junction_table()).optional(),
               inner_tables("mooring", mooring_table()).optional(),
               inner_tables("connector", connector_table()).optional(),
               inner_tables("joint", joint_table()).optional(),
               inner_tables("load", load_table()).optional(),
               inner_tables("contact", contact_table()).optional(),
               inner_table("ask", ask_table()),
               inner_table("solve", solve_table()).or_default("", "see its keys")}};
  return table;
}

}  // namespace froude::scene
