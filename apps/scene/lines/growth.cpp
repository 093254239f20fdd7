/// \file  `[line.growth]`: marine growth. (D100)
#include <fmt/format.h>

#include "scene/finer.hpp"
#include "scene/line_property.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Binding<Line::Growth>& line_growth() {
  static const Binding<Line::Growth> binding =
      Binding<Line::Growth>(
          "[line.growth]",
          "a layer around the segments whose middle is between two distances along the line: it has mass, "
          "and widens the diameter that water and bed meet")
          .key(quantity("thickness", dim::length, "of the layer").positive(), &Line::Growth::thickness)
          .key(quantity("density", dim::density, "of what grows, in air").positive(), &Line::Growth::density)
          .key(quantity("from", dim::length, "distance from the line's first end")
                   .within(Limit::not_negative)
                   .or_default("0 m", "from there on"),
               &Line::Growth::from)
          .key(quantity("to", dim::length, "likewise; left out: to the other end").positive().optional(),
               &Line::Growth::to);
  return binding;
}

void read_growth(const Record& record, const Record& whole, Line& out) {
  if (whole.has("link"))
    throw record.refused("grows on links that are given one by one, each with its own mass",
                         "leave it out, or give the line a `length` or [[line.part]]");
  double length = 0;
  for (const Line::EvenPart& part : out.parts) length += part.whole.length;
  Line::Growth growth = line_growth().read(record);
  if (!record.has("to")) growth.to = length;
  if (!(growth.to > growth.from) || growth.to > length * (1 + 1e-9))
    throw record.refused(fmt::format("reaches from {} to {} m of a line of {} m", growth.from, growth.to, length),
                         "count both from the line's first end");
  out.growth = growth;
  out.segments = cut(out);
}

}  // namespace

LineProperty growth_of_lines() {
  return {inner_table("growth", line_growth().table()).optional().only_beside("diameter"), read_growth};
}

}  // namespace froude::scene
