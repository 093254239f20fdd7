/// \file  `[line.damping]`: damping of nodes. (D73)
#include "dynamics/line/node_damping.hpp"
#include "scene/line_property.hpp"

namespace froude::scene {

LineProperty damping_of_lines() {
  using dynamics::line::NodeDamping;
  using C = NodeDamping::Coefficients;
  namespace dim = hydro::dim;
  static const auto keys =
      Binding<C>("[line.damping]", "of each node, against its velocity")
          .optional(positive("linear", dim::mass / dim::time, "b_l of -b_l v"), &C::linear)
          .optional(positive("quadratic", dim::mass / dim::length, "b_q of -b_q |v| v"), &C::quadratic)
          .key(effect("componentwise", "-b_q |v_i| v_i for each component instead, which depends on the axes")
                   .only_beside("quadratic"),
               &C::componentwise)
          .at_least_one_of({"linear", "quadratic"});
  return {inner_table("damping", keys.table()).optional(), [](const Record& own, const Record&, Line& line) {
            line.node.forces.push_back(std::make_shared<const NodeDamping>(keys.read(own)));
          }};
}

}  // namespace froude::scene
