/// \file  `[line.waves]`: where the water of a line is taken. (D152)
#include "scene/line_property.hpp"

namespace froude::scene {
namespace {

const Binding<Line::WavesAt>& line_waves() {
  static const auto binding =
      Binding<Line::WavesAt>("[line.waves]", "where its nodes take waves and current; left out: each where it is")
          .key(vector("at", hydro::dim::length, "one place for all of its nodes, as models of small droppers have it"),
               &Line::WavesAt::place_m)
          .place(&Line::WavesAt::place);
  return binding;
}

}  // namespace

LineProperty waves_of_lines() {
  return {inner_table("waves", line_waves().table()).optional(),
          [](const Record& own, const Record&, Line& line) { line.waves_at = line_waves().read(own); }};
}

}  // namespace froude::scene
