#include "froude/shares.hpp"

#include <fmt/ranges.h>

namespace froude {

Report Shares::report() const {
  double whole = 0;
  std::vector<std::string> told;
  Report out;
  for (const auto& [share, seconds] : seconds_) {
    whole += seconds;
    told.push_back(fmt::format("{} {:.2g}", share, seconds));
    out.keep(share + "_s", seconds);
  }
  return Report().part("time", out.say("time: {:.3g} s: {}", fact("whole_s", whole), fmt::join(told, ", ")));
}

}  // namespace froude
