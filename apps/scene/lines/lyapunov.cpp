/// \file  `[line.lyapunov]`: how fast neighbouring motions part.
#include "scene/line_property.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Binding<Line::Lyapunov>& line_lyapunov() {
  static const auto binding =
      Binding<Line::Lyapunov>("[line.lyapunov]",
                              "the largest Lyapunov exponent of a run: a second line a millionth of a segment beside "
                              "the first tells how fast neighbours part")
          .key(quantity("from", dim::time, "growth counts from here on, when the start is forgotten").positive(),
               &Line::Lyapunov::from)
          .place(&Line::Lyapunov::place);
  return binding;
}

}  // namespace

LineProperty lyapunov_of_lines() {
  return {
      inner_table("lyapunov", line_lyapunov().table()).optional(), [](const Record& own, const Record&, Line& line) {
        if (line.fastened())
          throw own.refused("asks for neighbours of a line that is on a body, whose own neighbours are not followed",
                            "hold the line by the ground");
        line.lyapunov = line_lyapunov().read(own);
      }};
}

}  // namespace froude::scene
