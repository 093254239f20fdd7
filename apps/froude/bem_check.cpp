#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "froude/commands.hpp"
#include "froude/optional_json.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/check.hpp"

namespace froude {
namespace {

using hydro::potential::Finding;
using hydro::potential::Severity;
using nlohmann::json;

json json_finding(const Finding& f) {
  return {{"severity", to_string(f.severity)},
          {"check", f.check},
          {"where", f.where},
          {"message", f.message},
          {"why", f.why},
          {"remedy", f.remedy},
          {"body", json_or_null(f.body)},
          {"entry", json_or_null(f.entry)},
          {"omega_rad_per_s", json_or_null(f.omega)}};
}

std::string text_finding(const Finding& f) {
  std::string out = fmt::format("  {:<8} {:<28} {}\n", to_string(f.severity), f.check, f.message);
  if (f.severity == Severity::note) return out;
  const std::string indent(40, ' ');
  out += fmt::format("{}at {}\n", indent, f.where);
  if (!f.why.empty()) out += fmt::format("{}{}\n", indent, f.why);
  if (!f.remedy.empty()) out += fmt::format("{}{}\n", indent, f.remedy);
  return out;
}

std::size_t count(const std::vector<Finding>& findings, Severity severity) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.severity == severity; }));
}

}  // namespace

int bem_check(const BemArguments& arguments, const Console& console, bool strict) {
  hydro::require(!arguments.files.empty(), "no file is given; give at least one file of coefficients");
  json files = json::array();
  int status = 0;
  for (const Path& file : arguments.files) {
    const std::vector<Finding> findings = hydro::potential::check(hydro::potential::read(file, arguments.options));
    const std::size_t errors = count(findings, Severity::error), warnings = count(findings, Severity::warning),
                      notes = count(findings, Severity::note);
    if (errors > 0 || (strict && warnings > 0)) status = 1;
    if (console.json) {
      json list = json::array();
      for (const Finding& f : findings) list.push_back(json_finding(f));
      files.push_back(
          {{"file", file.string()}, {"errors", errors}, {"warnings", warnings}, {"notes", notes}, {"findings", list}});
    } else {
      console.out << file.string() << '\n';
      for (const Finding& f : findings) console.out << text_finding(f);
      console.out << fmt::format("  {} errors, {} warnings, {} notes\n", errors, warnings, notes);
    }
  }
  if (console.json) console.out << json{{"files", files}, {"status", status}}.dump(2) << '\n';
  return status;
}

}  // namespace froude
