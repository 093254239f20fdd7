#include "froude/fit_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using Json = FitJson;

Json pair_of(const ::fit::Interval& i) { return {i.low, i.high}; }

std::string line_of(const Estimate& e, double confidence) {
  const Coefficient& c = e.coefficient;
  const auto& [low, high] = c.interval;
  const std::string interval = fmt::format("{:g} % interval {:.5g} to {:.5g}", 100 * confidence, low, high);
  std::string out = fmt::format("  {:<10} ", c.name);
  if (c.value)
    out += fmt::format("{:.5g}{}{}, {}", *c.value, e.unit.empty() ? "" : " ", e.unit, interval);
  else
    out += "not identifiable: " + c.why_not + (std::isfinite(high - low) ? "; " + interval : "");
  out += e.more + '\n';
  if (e.profile)
    out += fmt::format("  {:<10} by profile likelihood {:.5g} to {:.5g}\n", c.name, e.profile->low, e.profile->high);
  return out;
}

/// A JSON value as TOML; a string of JSON is a basic string of TOML, and a float stays a float.
std::string toml_value(const Json& value) {
  if (value.is_array()) {
    std::vector<std::string> parts;
    for (const auto& part : value) parts.push_back(toml_value(part));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (!value.is_number_float()) return value.dump();
  const std::string text = fmt::format("{}", value.get<double>());
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

void append_toml(std::string& out, const std::string& path, const Json& table) {
  for (const auto& [key, value] : table.items())
    if (!value.is_object() && !(value.is_array() && !value.empty() && value[0].is_object()))
      out += key + " = " + toml_value(value) + "\n";
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [key, value] : table.items()) {
    if (value.is_object()) {
      out += fmt::format("\n[{}{}]\n", prefix, key);
      append_toml(out, prefix + key, value);
    } else if (value.is_array() && !value.empty() && value[0].is_object()) {
      for (const auto& entry : value) {
        out += fmt::format("\n[[{}{}]]\n", prefix, key);
        append_toml(out, prefix + key, entry);
      }
    }
  }
}

}  // namespace

FitSummary begin_summary(const scene::FitScene& scene) {
  FitSummary out;
  out.facts = {{"scene", scene.file.filename().string()}, {"kind", scene.kind()}, {"confidence", scene.confidence}};
  return out;
}

void add_residuals(FitSummary& summary, const ::fit::ResidualReport& left, const std::string& unit) {
  std::string harmonics;
  for (const auto& h : left.harmonics)
    if (!unit.empty() && h.relative > 0.01)
      harmonics += fmt::format("{}{} ({:.2g} {})", harmonics.empty() ? "" : ", ", h.number, h.amplitude, unit);
  summary.say(
      "residuals: {:.0f} % of their variance in harmonics{}; neighbouring fortieths of a period correlate by {:.2f} "
      "(white with p = {:.2g})",
      100 * left.harmonic_share, harmonics.empty() ? "" : ", above 1 % of the force in number " + harmonics,
      left.lag_one, left.ljung_box_p);
  Json& j = summary.facts["residuals"] = {
      {"harmonic_share", left.harmonic_share}, {"lag_one", left.lag_one}, {"ljung_box_p", left.ljung_box_p}};
  if (unit.empty()) return;
  for (const auto& h : left.harmonics) j["harmonic_amplitudes_" + unit].push_back(h.amplitude);
}

FitSummary over_runs(const std::string& name, const std::string& unit, const ::fit::RandomEffects& law,
                     const std::string& runs, std::size_t count, double confidence) {
  FitSummary out{.key = name};
  out.heading = fmt::format(
      "{} over {} {}s: {:.4g} {}, {:g} % interval {:.4g} to {:.4g}; from {} to {} ±{:.2g}; the next between {:.4g} "
      "and {:.4g}",
      name, count, runs, law.coefficients[0], unit, 100 * confidence, law.intervals[0].low, law.intervals[0].high, runs,
      runs, law.between, law.prediction.low, law.prediction.high);
  out.facts = {{"value", law.coefficients[0]},
               {"interval", pair_of(law.intervals[0])},
               {"between_" + runs + "s", law.between},
               {"prediction", pair_of(law.prediction)}};
  return out;
}

void print(const FitSummary& summary, double confidence, std::ostream& out) {
  if (!summary.heading.empty()) out << summary.heading << '\n';
  for (const Estimate& e : summary.estimates) out << line_of(e, confidence);
  for (const std::string& remark : summary.remarks) out << "  " << remark << '\n';
  if (summary.steps)
    for (const std::string& step : *summary.steps) out << "  " << step << '\n';
  for (const std::string& caution : summary.cautions) out << "  caution: " << caution << '\n';
  for (const FitSummary& part : summary.parts) print(part, confidence, out);
}

FitJson tree_of(const Estimate& e) {
  const Coefficient& c = e.coefficient;
  Json j{{"identifiable", c.value.has_value()},
         {"standard_error", c.standard_error},
         {"systematic_error", c.systematic_error},
         {"interval", pair_of(c.interval)}};
  if (c.effective_samples > 0)
    j.update({{"interval_if_independent", pair_of(c.white_interval)}, {"effective_samples", c.effective_samples}});
  if (c.shift_per_degree != 0) j["shift_per_degree"] = c.shift_per_degree;
  if (c.value) j["value"] = *c.value;
  if (!c.why_not.empty()) j["why_not"] = c.why_not;
  if (e.profile) j["profile_interval"] = pair_of(*e.profile);
  j.update(e.facts);
  return j;
}

FitJson tree_of(const FitSummary& summary) {
  Json j = summary.facts;
  Json& estimates = summary.group.empty() ? j : j[summary.group];
  for (const Estimate& e : summary.estimates) estimates[e.key.empty() ? e.coefficient.name : e.key].update(tree_of(e));
  if (summary.steps) j["steps"] = *summary.steps;
  if (summary.steps || !summary.cautions.empty()) j["cautions"] = summary.cautions;
  for (const FitSummary& part : summary.parts) {
    if (part.one_of_many)
      j[part.key].push_back(tree_of(part));
    else
      (part.key.empty() ? j : j[part.key]).update(tree_of(part));
  }
  return j;
}

RunLabels run_labels(const hydro::io::CsvTable& table, std::size_t row, const std::vector<std::string>& taken) {
  RunLabels out;
  for (const std::string& name : table.names())
    if (std::find(taken.begin(), taken.end(), name) == taken.end())
      out.push_back(
          {name, table.is_text(name) ? table.text_column(name)[row] : fmt::format("{:.6g}", table.column(name)[row])});
  return out;
}

std::string title_of(const scene::FitScene& scene) {
  return scene.title.empty() ? scene.file.filename().string() : scene.title;
}

plot::Series band_outline(const std::string& name, const std::vector<double>& t, const std::vector<double>& half,
                          bool dashed) {
  plot::Series out{name, t, half, true, false, dashed};
  for (std::size_t i = t.size(); i-- > 0;) {
    out.x.push_back(t[i]);
    out.y.push_back(-half[i]);
  }
  return out;
}

std::vector<plot::Series> with_bars(const std::string& name, double confidence, const std::vector<double>& x,
                                    const std::vector<const Coefficient*>& y) {
  plot::Series values{name, x, {}, false, true}, bars{fmt::format("{:g} % interval", 100 * confidence), {}, {}};
  for (std::size_t i = 0; i < x.size(); ++i) {
    values.y.push_back(*y[i]->value);
    for (const double end : {y[i]->interval.low, y[i]->interval.high, std::numeric_limits<double>::quiet_NaN()}) {
      bars.x.push_back(x[i]);
      bars.y.push_back(end);
    }
  }
  return {values, bars};
}

void deliver(const FitOutcome& outcome, double confidence, const FitArguments& arguments, const Console& console) {
  if (!console.json) print(outcome.summary, confidence, console.out);
  const auto write = [&](const std::optional<Path>& file, const std::string& content) {
    if (!file || content.empty()) return;
    hydro::io::write_atomically(*file, content);
    if (!console.json && !outcome.refused) console.out << "wrote " << file->string() << '\n';
  };
  const std::string picture =
      arguments.picture && !outcome.picture.panels.empty() ? plot::svg(outcome.picture) : std::string();
  if (outcome.refused) {
    write(arguments.picture, picture);
    std::rethrow_exception(outcome.refused);
  }
  const Json tree = tree_of(outcome.summary);
  write(arguments.table, outcome.table);
  if (arguments.output) {
    std::string toml = fmt::format("# Estimates of `froude fit`, version {}. SI units.\n", FROUDE_VERSION);
    append_toml(toml, "", tree);
    write(arguments.output, toml);
  }
  write(arguments.picture, picture);
  if (console.json) console.out << tree.dump(1) << '\n';
}

}  // namespace froude
