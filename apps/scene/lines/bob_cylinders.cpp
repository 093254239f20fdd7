/// \file  `[line.bob_cylinders]`: a cylinder of its own at each bob, whatever hangs between the bobs. (D153)
#include "scene/line_property.hpp"

namespace froude::scene {
namespace {

const Binding<dynamics::line::Bob>& bob_cylinder() {
  using dynamics::line::Bob;
  namespace dim = hydro::dim;
  static const auto binding =
      Binding<Bob>("[line.bob_cylinders]",
                   "each node that is not held is loaded as a cylinder of its own, the same from all sides, as some "
                   "models of droppers have it; `morison` loads segments across and along")
          .key(positive("length", dim::length, "of each cylinder, whatever the segments beside its node are long"),
               &Bob::length)
          .key(positive("diameter", dim::length, "of each cylinder"), &Bob::diameter)
          .key(number("cd", "drag coefficient, by diameter times length").within(Limit::not_negative), &Bob::cd)
          .key(number("ca", "added mass over displaced mass").within(Limit::not_negative), &Bob::ca)
          .key(effect("relative_acceleration",
                      "ca times the displaced mass acts on the water's acceleration less the node's, without the "
                      "Froude-Krylov load; left out: Morison's"),
               &Bob::relative_only)
          .key(effect("componentwise", "drag |w_i| w_i for each component instead, which depends on the axes"),
               &Bob::by_component);
  return binding;
}

}  // namespace

LineProperty bob_cylinders_of_lines() {
  return {inner_table("bob_cylinders", bob_cylinder().table()).optional(),
          [](const Record& own, const Record& whole, Line& line) {
            if (whole.has("morison"))
              throw own.refused("loads the nodes beside [line.morison], which loads the segments for the same water",
                                "leave out one of them");
            if (whole.has("buoyancy"))
              throw own.refused("loads the nodes beside buoyancy, with which the water pushes the segments too",
                                "leave out one of them");
            if (line.from.meets || line.to.meets)
              throw own.refused("is for lines by themselves, and this one meets others", "take [line.morison]");
            line.node.bob = bob_cylinder().read(own);
          }};
}

}  // namespace froude::scene
