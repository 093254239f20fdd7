#include "froude/sections_told.hpp"

namespace froude {

Report report_of(const std::vector<SectionAtRest>& sections) {
  Report out;
  if (sections.empty()) return out;
  out.say("loads at rest, by weight, still water and what is fastened, of which those above are variations:");
  out.say("{:<24} {:>9} {:>12} {:>12} {:>12} {:>13} {:>13} {:>13}", "section", "x [m]", "force_x [N]", "force_y [N]",
          "force_z [N]", "moment_x [Nm]", "moment_y [Nm]", "moment_z [Nm]");
  for (const SectionAtRest& s : sections) {
    Report one;
    one.say("{:<24} {:>9.4g} {:>12.5g} {:>12.5g} {:>12.5g} {:>13.5g} {:>13.5g} {:>13.5g}", fact("section", s.name),
            s.at[0], fact("force_x", s.load[0]), fact("force_y", s.load[1]), fact("force_z", s.load[2]),
            fact("moment_x", s.load[3]), fact("moment_y", s.load[4]), fact("moment_z", s.load[5]));
    one.keep("at_m", s.at).keep("normal", s.normal);
    out.one_of("sections", std::move(one));
  }
  return out;
}

}  // namespace froude
