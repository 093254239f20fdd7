#include <fmt/format.h>

#include "harness/case.hpp"
#include "support/two_clocks.hpp"

namespace froude::validation::clock_offset {

Outcome outcome(const Folders&) {
  constexpr int sets = 400;
  Outcome out;
  for (const auto& of : froude_test::two_clocks) {
    const auto errors = froude_test::errors_of_offsets(of, sets);
    out.numbers.push_back({fmt::format("coverage, {}", of.name), static_cast<double>(errors.within) / errors.sets, ""});
    out.numbers.push_back(
        {fmt::format("mean of squared errors over their variances, {}", of.name), errors.squares / errors.sets, ""});
    out.numbers.push_back({fmt::format("share refused, {}", of.name), static_cast<double>(errors.refused) / sets, ""});
  }
  return out;
}

}  // namespace froude::validation::clock_offset
