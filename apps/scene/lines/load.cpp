/// \file  `[[line.load]]`: forces on nodes. (D150)
#include "scene/line_property.hpp"
#include "scene/load_history.hpp"

namespace froude::scene {
namespace {

const Binding<Line::NodeLoad>& line_load() {
  static const Binding<Line::NodeLoad> binding =
      Binding<Line::NodeLoad>("[[line.load]]", "a force on one node: what pulls the line aside, and lets it go")
          .key(integer("node", "counted from 0 at `from`").within(Limit::at_least_one), &Line::NodeLoad::node)
          .key(vector("force", hydro::dim::force, "in full, global axes"), &Line::NodeLoad::force)
          .part(load_history(), &Line::NodeLoad::history);
  return binding;
}

}  // namespace

LineProperty load_of_lines() {
  return {inner_tables("load", line_load().table()).optional(), [](const Record& own, const Record&, Line& line) {
            require_free_node(own, line);
            line.loads.push_back(line_load().read(own));
          }};
}

}  // namespace froude::scene
