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
          throw own.refused(
              "asks for neighbours of a line that is on a body: both are stepped by generalised-alpha as one system, "
              "which goes on from accelerations too, so that near places and velocities make no neighbour of it",
              "hold the line by the ground, or give its end the path of the body ([line.prescribed])");
        line.lyapunov = line_lyapunov().read(own);
      }};
}

}  // namespace froude::scene
