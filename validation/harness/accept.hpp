#pragma once
/// \file  The pass rule of a validation case, accept.toml, fixed before the first run.
///
///   [[check]]
///   number = "period_long"              # the name that the case gives it
///   unit = "s"                          # left out for a number without dimension
///   expected = 2.0500                   # with limit or limit_relative; or instead of both: at_most, or at_least
///   limit = 1e-3                        # |value − expected| <= limit
///   reference_uncertainty = 5e-4        # of `expected`, in the unit; shown, not used
///   because = "stopwatch, three digits" # a limit without a reason is refused
///   fails = "…"                         # the reason of a known failure: shown as failing, counted apart
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/case.hpp"
#include "hydro/base/error.hpp"

namespace froude::validation {

struct Check {
  std::string number, unit;
  enum class Rule { absolute, relative, at_most, at_least } rule;
  double expected = 0;  ///< for absolute and relative
  double limit = 0;     ///< ≥ 0 for absolute and relative, else the bound itself
  std::optional<double> reference_uncertainty;
  std::string because;
  std::optional<std::string> fails;
  hydro::Place place;
};

/// \throws hydro::InputError with file and line: unknown or missing key, wrong type, two kinds of limit, a limit
/// without `because`, two checks of one number, no check at all
std::vector<Check> read_checks(const std::filesystem::path& file);
std::vector<Check> parse_checks(std::string_view text, const std::string& file);

enum class Verdict {
  pass,
  fail,
  known_failure,   ///< outside its limit, as accept.toml says with a reason
  unexpected_pass  ///< within its limit although accept.toml says that it fails: the mark is out of date
};

/// A value that is not finite fails. \throws hydro::InputError if the units differ
Verdict judge(const Check& check, const Number& number);

/// "2.05 ± 0.001", "2.05 ± 0.25 %", "at most 1e-14": what is expected, with its limit.
std::string rule_text(const Check& check);

}  // namespace froude::validation
