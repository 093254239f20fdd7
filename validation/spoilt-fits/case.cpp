#include <fmt/format.h>

#include <string>

#include "harness/case.hpp"
#include "support/spoilt_fits.hpp"

namespace froude::validation::spoilt_fits {

Outcome outcome(const Folders&) {
  constexpr std::uint64_t noises = 10;
  Outcome out;
  double wrong = 0;
  std::vector<Number> shares;
  for (const auto& way : froude_test::ways_to_spoil()) {
    double told = 0;
    std::string how;
    for (std::uint64_t seed = 1; seed <= noises; ++seed) {
      const auto fit = way(seed);
      const auto by = froude_test::wrong_by(fit);
      told += by.has_value() / static_cast<double>(noises);
      wrong += by.value_or(0) > 2;
      how = fit.how;
    }
    shares.push_back({"share that tells a value, of " + how, told, ""});
  }
  out.numbers.push_back({"fits that tell a value wrong by more than twice its interval", wrong, ""});
  out.numbers.insert(out.numbers.end(), shares.begin(), shares.end());
  double lacking = 0;
  for (std::uint64_t seed = 1; seed <= noises; ++seed)
    lacking += froude_test::wrong_by(froude_test::force_without_its_linear_drag(seed)).value_or(0) > 2;
  out.numbers.push_back({"share wrong by more than twice its interval, of forces without their linear drag",
                         lacking / static_cast<double>(noises), ""});
  return out;
}

}  // namespace froude::validation::spoilt_fits
