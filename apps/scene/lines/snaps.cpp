/// \file  `[line.snaps]`: slack and snaps are counted.
#include "scene/line_property.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Binding<Line::Snaps>& line_snaps() {
  static const auto binding =
      Binding<Line::Snaps>("[line.snaps]",
                           "counts slack and snaps over the steps of a run, and tells the largest tension")
          .key(quantity("slack_below", dim::force, "a link with this tension or less is slack")
                   .within(Limit::not_negative),
               &Line::Snaps::slack_below)
          .key(quantity("snap_above", dim::force, "a link that was slack snaps when it reaches this").positive(),
               &Line::Snaps::snap_above)
          .then([](const Record& record, const Line::Snaps& out) {
            if (!(out.snap_above > out.slack_below))
              throw record.wrong("snap_above", "is not above slack_below", "a snap is tighter than slack");
          });
  return binding;
}

}  // namespace

LineProperty snaps_of_lines() {
  return {inner_table("snaps", line_snaps().table()).optional(),
          [](const Record& own, const Record&, Line& line) { line.snaps = line_snaps().read(own); }};
}

}  // namespace froude::scene
