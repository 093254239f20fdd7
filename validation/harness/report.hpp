#pragma once
/// \file  Runs cases and tells what came out: as a table, and as a page with pictures.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/accept.hpp"
#include "harness/case.hpp"

namespace froude::validation {

/// One line of the table; without a check the number is told for information.
struct Line {
  Number number;
  std::optional<Check> check;
  Verdict verdict = Verdict::pass;
};

struct CaseReport {
  std::string name;
  std::string readme = {};       ///< README.md of the case
  std::vector<Line> lines = {};  ///< in the order of the case's numbers
  std::vector<Picture> pictures = {};
  std::optional<std::string> skipped = {};  ///< the data that are absent
  std::optional<std::string> broken = {};   ///< what the case threw
};

struct Tally {
  int passed = 0, failed = 0, known_failures = 0, cases_skipped = 0, cases_broken = 0;
  bool good() const { return failed == 0 && cases_broken == 0; }
};

/// Runs one case and judges it. What the case throws ends in the report; what is wrong with its folder is thrown.
/// \throws hydro::InputError if README.md or accept.toml is missing or wrong, or checks a number that the case does not
/// give
CaseReport run_case(const Case& the_case, const Folders& folders);

/// An unexpected pass counts as failed: the mark in accept.toml must go.
Tally tally(const std::vector<CaseReport>& reports);

/// "passed", "FAILED", "FAILED (known)" …
std::string verdict_text(Verdict verdict);

/// One case as a table for a terminal.
std::string as_text(const CaseReport& report);

/// "12 passed, 1 failed, 1 known failure, 2 cases skipped for want of data".
std::string summary(const Tally& tally);

/// Whether pictures that show curves of others are drawn: they must not be shipped with this project.
enum class ReferenceCurves { drawn, left_out };

/// All cases as Markdown at `page`; pictures as SVG in a folder beside it, named as the page without its ending.
/// \throws hydro::InputError if it cannot be written
void write_page(const std::vector<CaseReport>& reports, const std::filesystem::path& page, ReferenceCurves curves);

}  // namespace froude::validation
