// froude validate: which cases to run, where their files are, and how the result is told.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <ostream>

#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/progress.hpp"
#include "harness/report.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

using validation::Case;
using validation::CaseReport;

Path existing_folder(const Path& folder, const std::string& what) {
  if (!std::filesystem::is_directory(folder))
    throw hydro::InputError(fmt::format("there is no such folder of {}", what), {.file = folder.string()});
  return std::filesystem::absolute(folder).lexically_normal();
}

// Beside an installed program the cases are in share/froude; a program in its build tree uses those it was built from.
Path folder_of_cases(const ValidateArguments& arguments) {
  if (arguments.folder) return existing_folder(*arguments.folder, "cases");
  std::error_code none;
  const Path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const Path installed = program.parent_path().parent_path() / "share" / "froude" / "validation";
  if (std::filesystem::is_directory(installed)) return installed;
  return existing_folder(FROUDE_VALIDATION_SOURCE, "cases");
}

// A folder that was named must exist; the default one may be absent, which skips the cases that need it.
Path folder_of_data(const ValidateArguments& arguments, const Path& cases) {
  if (arguments.data) return existing_folder(*arguments.data, "reference data");
  if (const char* named = std::getenv("FROUDE_REFERENCE_DATA"); named != nullptr && *named != '\0')
    return existing_folder(named, "reference data (from FROUDE_REFERENCE_DATA)");
  return (cases.parent_path() / ".." / "shared" / "data").lexically_normal();
}

std::vector<Case> wanted_cases(const std::vector<std::string>& names) {
  if (names.empty()) return validation::cases();
  std::vector<Case> wanted;
  std::vector<std::string> known;
  for (const Case& c : validation::cases()) known.push_back(c.name);
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      const std::string near = hydro::nearest(name, known);
      throw hydro::InputError(fmt::format("there is no validation case \"{}\"", name), {},
                              near.empty() ? fmt::format("cases are {}", fmt::join(known, ", "))
                                           : fmt::format("did you mean \"{}\"?", near));
    }
    wanted.push_back(validation::cases()[static_cast<std::size_t>(at - known.begin())]);
  }
  return wanted;
}

nlohmann::json json_of(const validation::Line& line) {
  nlohmann::json out{{"number", line.number.name}, {"value", line.number.value}, {"unit", line.number.unit}};
  if (!line.check) return out;
  const validation::Check& check = *line.check;
  out["expected"] = validation::rule_text(check);
  out["because"] = check.because;
  out["verdict"] = validation::verdict_text(line.verdict);
  if (check.reference_uncertainty) out["reference_uncertainty"] = *check.reference_uncertainty;
  if (check.fails) out["fails"] = *check.fails;
  return out;
}

nlohmann::json json_of(const std::vector<CaseReport>& reports) {
  nlohmann::json cases = nlohmann::json::array();
  for (const CaseReport& report : reports) {
    nlohmann::json one{{"case", report.name}, {"numbers", nlohmann::json::array()}};
    for (const validation::Line& line : report.lines) one["numbers"].push_back(json_of(line));
    if (report.skipped) one["skipped"] = *report.skipped;
    if (report.broken) one["broken"] = *report.broken;
    cases.push_back(std::move(one));
  }
  const validation::Tally sum = validation::tally(reports);
  return {{"cases", std::move(cases)},
          {"passed", sum.passed},
          {"failed", sum.failed},
          {"known_failures", sum.known_failures},
          {"cases_skipped", sum.cases_skipped},
          {"cases_broken", sum.cases_broken}};
}

}  // namespace

int validate(const ValidateArguments& arguments, const Console& console) {
  const Path folder = folder_of_cases(arguments), data = folder_of_data(arguments, folder);
  const std::vector<Case> wanted = wanted_cases(arguments.cases);
  if (arguments.page) require_outputs({{"--page", *arguments.page}}, files_below("a file of the cases", folder));
  std::vector<CaseReport> reports;
  Progress progress(console.err, "validate", console.show_progress);
  for (const Case& c : wanted) {
    progress.update(static_cast<double>(reports.size()) / static_cast<double>(wanted.size()));
    reports.push_back(validation::run_case(c, validation::Folders(folder, data, c.name)));
    if (!console.json) console.out << validation::as_text(reports.back()) << '\n' << std::flush;
  }
  const validation::Tally sum = validation::tally(reports);
  if (console.json)
    console.out << json_of(reports).dump(2) << '\n';
  else
    console.out << validation::summary(sum) << '\n';
  if (arguments.page)
    validation::write_page(
        reports, *arguments.page,
        arguments.reference_curves ? validation::ReferenceCurves::drawn : validation::ReferenceCurves::left_out);
  return sum.good() ? 0 : 1;
}

}  // namespace froude
