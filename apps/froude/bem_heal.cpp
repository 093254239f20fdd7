#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>

#include "froude/coefficient_files.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/check.hpp"

namespace froude {
namespace {

using hydro::potential::HealStep;
using hydro::potential::Severity;
using nlohmann::json;

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

json json_counts(const Counts& c) { return {{"errors", c.errors}, {"warnings", c.warnings}}; }

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
  if (console.json) {
    json steps = json::array();
    for (const HealStep& s : healed.steps)
      steps.push_back({{"step", s.name}, {"what", s.what}, {"largest_relative_change", s.largest_change}});
    console.out << json{{"input", files.front().string()}, {"files", written.files},
                        {"left_out", written.left_out},    {"steps", steps},
                        {"before", json_counts(was)},      {"after", json_counts(is)}}
                       .dump(2)
                << '\n';
    return;
  }
  for (const HealStep& s : healed.steps)
    console.out << fmt::format("  {:<10} largest change {:<9.2g} {}\n", s.name, s.largest_change, s.what);
  console.out << fmt::format("  the doctor had {} errors and {} warnings, and has {} and {}\n", was.errors,
                             was.warnings, is.errors, is.warnings);
  console.out << fmt::format("wrote {}\n", fmt::join(written.files, ", "));
  for (const std::string& sentence : written.left_out) console.out << "  left out or changed: " << sentence << '\n';
}

}  // namespace froude
