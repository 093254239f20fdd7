#include <algorithm>

#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/doctor/check.hpp"

namespace froude {
namespace {

using hydro::potential::Finding;
using hydro::potential::Severity;

Report report_of(const Finding& f) {
  Report out;
  out.say("  {:<8} {:<28} {}", fact("severity", to_string(f.severity)), fact("check", f.check),
          fact("message", f.message));
  out.keep("where", f.where).keep("why", f.why).keep("remedy", f.remedy);
  out.keep("body", f.body).keep("entry", f.entry).keep("omega_rad_per_s", f.omega);
  if (f.severity == Severity::note) return out;
  const std::string indent(40, ' ');
  out.say("{}at {}", indent, f.where);
  for (const std::string& more : {f.why, f.remedy})
    if (!more.empty()) out.say("{}{}", indent, more);
  return out;
}

std::size_t count(const std::vector<Finding>& findings, Severity severity) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.severity == severity; }));
}

}  // namespace

int bem_check(const BemArguments& arguments, const Console& console, bool strict) {
  hydro::require(!arguments.files.empty(), "no file is given; give at least one file of coefficients");
  Report all;
  int status = 0;
  for (const Path& file : arguments.files) {
    const std::vector<Finding> findings = hydro::potential::check(hydro::potential::read(file, arguments.options));
    const std::size_t errors = count(findings, Severity::error), warnings = count(findings, Severity::warning);
    if (errors > 0 || (strict && warnings > 0)) status = 1;
    Report one;
    one.say("{}", fact("file", file.string())).keep("findings", Json::array());
    for (const Finding& f : findings) one.one_of("findings", report_of(f));
    one.say("  {} errors, {} warnings, {} notes", fact("errors", errors), fact("warnings", warnings),
            fact("notes", count(findings, Severity::note)));
    all.one_of("files", tell_people(one, console));
  }
  tell(all.keep("status", status).untold(), console);
  return status;
}

}  // namespace froude
