#include "froude/coefficient_files.hpp"
#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/doctor/check.hpp"

namespace froude {
namespace {

using hydro::potential::HealStep;
using hydro::potential::Severity;

struct Counts {
  std::size_t errors = 0, warnings = 0;
};

Counts counts(const hydro::potential::Coefficients& c) {
  Counts out;
  for (const auto& f : hydro::potential::check(c)) {
    if (f.severity == Severity::error) ++out.errors;
    if (f.severity == Severity::warning) ++out.warnings;
  }
  return out;
}

}  // namespace

void bem_heal(const BemHealArguments& arguments, const Console& console) {
  const auto& files = arguments.bem.files;
  hydro::require(files.size() == 1, "one file can be healed at a time; {} are given", files.size());
  const CoefficientFormat format = format_of(arguments.output, arguments.format);
  require_outputs(files_to_write(format, arguments.output), files_of_coefficients(files));
  const auto before = hydro::potential::read(files.front(), arguments.bem.options);
  const auto healed = hydro::potential::heal(before, arguments.steps);
  const Counts was = counts(before), is = counts(healed.coefficients);
  const WrittenCoefficients written = write_as(format, healed.coefficients, arguments.output);
  Report out;
  out.keep("input", files.front().string()).keep("steps", Json::array());
  for (const HealStep& s : healed.steps)
    out.row("steps", "  {:<10} largest change {:<9.2g} {}", fact("step", s.name),
            fact("largest_relative_change", s.largest_change), fact("what", s.what));
  out.say("  the doctor had {} errors and {} warnings, and has {} and {}", fact("before/errors", was.errors),
          fact("before/warnings", was.warnings), fact("after/errors", is.errors), fact("after/warnings", is.warnings));
  out.say("wrote {}", fact("files", written.files, fmt::join(written.files, ", ")));
  tell(out.sentences("left_out", "  left out or changed: {}", written.left_out), console);
}

}  // namespace froude
