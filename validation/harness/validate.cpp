#include "harness/validate.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <ostream>

#include "froude/outputs.hpp"
#include "froude/progress.hpp"
#include "harness/report.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation {
namespace {

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
  return existing_folder(validation::source_folder(), "cases");
}

// A folder that was named must exist; the default one may be absent, which skips the cases that need it.
Path folder_of_data(const ValidateArguments& arguments, const Path& cases) {
  if (arguments.data) return existing_folder(*arguments.data, "reference data");
  if (const char* named = std::getenv("FROUDE_REFERENCE_DATA"); named != nullptr && *named != '\0')
    return existing_folder(named, "reference data (from FROUDE_REFERENCE_DATA)");
  return (cases.parent_path() / ".." / "shared" / "data").lexically_normal();
}

std::vector<Case> wanted_cases(const std::vector<Case>& cases, const std::vector<std::string>& names) {
  if (names.empty()) return cases;
  std::vector<Case> wanted;
  std::vector<std::string> known;
  for (const Case& c : cases) known.push_back(c.name);
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      const std::string near = hydro::nearest(name, known);
      throw hydro::InputError(fmt::format("there is no validation case \"{}\"", name), {},
                              near.empty() ? fmt::format("cases are {}", fmt::join(known, ", "))
                                           : fmt::format("did you mean \"{}\"?", near));
    }
    wanted.push_back(cases[static_cast<std::size_t>(at - known.begin())]);
  }
  return wanted;
}

nlohmann::json json_of(const Line& line) {
  nlohmann::json out{{"number", line.number.name}, {"value", line.number.value}, {"unit", line.number.unit}};
  if (!line.check) return out;
  const Check& check = *line.check;
  out["expected"] = rule_text(check);
  out["because"] = check.because;
  out["verdict"] = verdict_text(line.verdict);
  if (check.reference_uncertainty) out["reference_uncertainty"] = *check.reference_uncertainty;
  if (check.fails) out["fails"] = *check.fails;
  return out;
}

nlohmann::json json_of(const std::vector<CaseReport>& reports) {
  nlohmann::json cases = nlohmann::json::array();
  for (const CaseReport& report : reports) {
    nlohmann::json one{{"case", report.name}, {"numbers", nlohmann::json::array()}};
    for (const Line& line : report.lines) one["numbers"].push_back(json_of(line));
    if (report.skipped) one["skipped"] = *report.skipped;
    if (report.broken) one["broken"] = *report.broken;
    cases.push_back(std::move(one));
  }
  const Tally sum = tally(reports);
  return {{"cases", std::move(cases)},
          {"passed", sum.passed},
          {"failed", sum.failed},
          {"known_failures", sum.known_failures},
          {"cases_skipped", sum.cases_skipped},
          {"cases_broken", sum.cases_broken}};
}

/// The paragraph of a README.md that asks, in one line.
std::string question_of(const Path& file) {
  const std::string readme = hydro::io::read_text(file), mark = "**Question.** ";
  const std::size_t start = readme.find(mark);
  if (start == std::string::npos)
    throw hydro::InputError("the case asks no question", {.file = file.string()},
                            "begin a paragraph with \"" + mark + "\"");
  const std::size_t end = std::min(readme.find("\n\n", start), readme.size());
  std::string question = readme.substr(start + mark.size(), end - start - mark.size());
  std::replace(question.begin(), question.end(), '\n', ' ');
  return question.substr(0, question.find_last_not_of(' ') + 1);
}

/// What `list` tells of one case.
struct Entry {
  Case the_case;
  std::string question;
  std::vector<std::string> absent;  ///< of the_case.reference_data
};

std::string as_text(const std::vector<Entry>& entries) {
  std::size_t longest = 0;
  for (const Entry& entry : entries) longest = std::max(longest, entry.the_case.name.size());
  std::string text;
  for (const Entry& entry : entries)
    text += fmt::format(
        "{:{}}  {}{}\n", entry.the_case.name, longest, entry.question,
        entry.absent.empty() ? "" : fmt::format(" (reference data are absent: {})", fmt::join(entry.absent, ", ")));
  return text;
}

nlohmann::json json_of(const std::vector<Entry>& entries) {
  nlohmann::json cases = nlohmann::json::array();
  for (const Entry& entry : entries)
    cases.push_back({{"case", entry.the_case.name},
                     {"question", entry.question},
                     {"reference_data", entry.the_case.reference_data},
                     {"reference_data_absent", entry.absent}});
  return {{"cases", std::move(cases)}};
}

}  // namespace

int validate(const std::vector<Case>& cases, const ValidateArguments& arguments, const Console& console) {
  const Path folder = folder_of_cases(arguments), data = folder_of_data(arguments, folder);
  const std::vector<Case> wanted = wanted_cases(cases, arguments.names);
  if (arguments.page) require_outputs({{"--page", *arguments.page}}, files_below("a file of the cases", folder));
  std::vector<CaseReport> reports;
  Progress progress(console.err, "validate", console.show_progress);
  for (const Case& c : wanted) {
    progress.update(static_cast<double>(reports.size()) / static_cast<double>(wanted.size()));
    reports.push_back(run_case(c, Folders(folder, data, c.name)));
    if (!console.json) console.out << as_text(reports.back()) << '\n' << std::flush;
  }
  const Tally sum = tally(reports);
  if (console.json)
    console.out << json_of(reports).dump(2) << '\n';
  else
    console.out << summary(sum) << '\n';
  if (arguments.page)
    write_page(reports, *arguments.page,
               arguments.reference_curves ? ReferenceCurves::drawn : ReferenceCurves::left_out);
  return sum.good() ? 0 : 1;
}

void list(const std::vector<Case>& cases, const ValidateArguments& arguments, const Console& console) {
  const Path folder = folder_of_cases(arguments), data = folder_of_data(arguments, folder);
  std::vector<Entry> entries;
  for (const Case& c : wanted_cases(cases, arguments.names)) {
    entries.push_back({c, question_of(folder / c.name / "README.md"), {}});
    for (const std::string& needed : c.reference_data)
      if (!std::filesystem::exists(data / needed)) entries.back().absent.push_back(needed);
  }
  console.out << (console.json ? json_of(entries).dump(2) + "\n" : as_text(entries));
}

}  // namespace froude::validation
