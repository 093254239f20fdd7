#include "scene/load_history.hpp"

#include <fmt/format.h>

namespace froude::scene {

const Binding<dynamics::LoadHistory>& load_history() {
  using dynamics::LoadHistory;
  namespace dim = hydro::dim;
  static const Binding<LoadHistory> binding =
      Binding<LoadHistory>("[[load]]", "when it acts")
          .key(quantity("from", dim::time, "it begins; left out: at t = 0; what acts then acts on the rest before, too")
                   .positive()
                   .optional(),
               &LoadHistory::from)
          .key(quantity("ramp_up", dim::time,
                        "it rises straight from nothing over so long; left out: it is there at once")
                   .positive()
                   .optional(),
               &LoadHistory::ramp_up)
          .key(quantity("until", dim::time, "it begins to fall; left out: it stays").positive().optional(),
               &LoadHistory::until)
          .key(quantity("ramp_down", dim::time, "it falls straight to nothing over so long; left out: it stops at once")
                   .positive()
                   .optional()
                   .only_beside("until"),
               &LoadHistory::ramp_down)
          .then([](const Record& record, const LoadHistory& out) {
            if (!out.is_ordered())
              throw record.wrong("until",
                                 fmt::format("ends the load before it has risen, at {:.6g} s", out.from + out.ramp_up),
                                 "let it end later, or rise faster");
          });
  return binding;
}

}  // namespace froude::scene
