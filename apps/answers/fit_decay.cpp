#include <cmath>
#include <limits>

#include "answers/fit_kinds.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using DecayRun = ::fit::decay::FittedRun;

std::vector<double> column_of(const Eigen::MatrixXd& band) {
  return std::vector<double>(band.data(), band.data() + band.rows());
}

/// A coefficient over frequency with its interval; the swing's frequency is marked.
plot::Panel panel_over_frequency(const DecayRun& run, bool damping, const char* unit, double confidence) {
  plot::Series value{"by the memory", {}, {}}, low{fmt::format("{:g} % interval", 100 * confidence), {}, {}, true},
      swing{"at the swing", {}, {}, false, true};
  const auto part = [&](const ::fit::DecayRadiation& r) { return damping ? r.damping : r.added_mass; };
  for (const auto& r : run.curve) {
    value.x.push_back(r.omega);
    value.y.push_back(*part(r).value);
    low.x.push_back(r.omega);
    low.y.push_back(part(r).interval.low);
  }
  low.x.push_back(low.x.back());
  low.y.push_back(std::numeric_limits<double>::quiet_NaN());
  for (const auto& r : run.curve) {
    low.x.push_back(r.omega);
    low.y.push_back(part(r).interval.high);
  }
  swing.x = {run.swing->omega};
  swing.y = {*part(*run.swing).value};
  return {.x = {"frequency", "rad/s"},
          .y = {run.name() + ": " + (damping ? "damping" : "added mass"), unit},
          .series = {value, low, swing}};
}

/// One record, what was fitted to it and what is left of it, by the memory too.
void add_record(const ::fit::decay::Problem& problem, const DecayRun& run, std::size_t w, Panels& panels) {
  const auto& m = run.fit.motion;
  const ::fit::decay::Record& r = run.records[w];
  const auto band = [&](const auto& of) { return of.empty() ? std::vector<double>() : column_of(of[w]); };
  Panels both = panels_of(FittedRecord{.legend = r.name + ": measured",
                                       .axis = {problem.turns ? "angle" : "position", problem.turns ? "rad" : "m"},
                                       .confidence = problem.options.motion.confidence,
                                       .time = r.time,
                                       .measured = r.values,
                                       .fitted = column_of(m.motion[w]),
                                       .sample_band = band(m.sample_band),
                                       .fit_band = band(m.fit_band)});
  if (run.memory) {
    std::vector<double> by_memory = column_of(run.memory->motion.motion[w]);
    for (std::size_t i = 0; i < by_memory.size(); ++i) by_memory[i] = r.values[i] - by_memory[i];
    both[1].series.push_back({"measured − fitted with a memory", r.time, by_memory});
  }
  panels.insert(panels.end(), both.begin(), both.end());
}

std::vector<Coefficient> in_table(const DecayRun& run) {
  std::vector<Coefficient> all{run.fit.period};
  all.insert(all.end(), run.fit.damping.begin(), run.fit.damping.end());
  if (run.memory) all.insert(all.end(), run.memory->memory.begin(), run.memory->memory.end());
  return all;
}

}  // namespace

::fit::decay::Problem problem_of(const scene::FitScene& scene, const scene::DecayModel& model) {
  ::fit::decay::Problem out{.turns = scene.turns(), .runs = {}, .body = model.body, .options = model};
  for (const auto& [source, row] : runs_of(scene, {"file"})) {
    const Measurements measured(scene, source.file);
    out.runs.push_back({source, measured.time(), measured.motion()});
  }
  return out;
}

Remedy remedy_of(const scene::FitScene& scene, const ::fit::decay::Problem&, const ::fit::decay::Solution& solution) {
  using enum ::fit::Refusal::Reason;
  if (solution.report.refused->reason == halves_differ)
    return {scene.model_place,
            "take other terms, or the part of the record in which one set of them holds (window of [prepare]); to have "
            "values all the same: [ask] accept = [\"residuals\"]"};
  if (solution.report.refused->reason == search_without_end)
    return {.text = "Take the part of the record that swings (window of [prepare]), or other terms"};
  return {scene.model_place,
          "take the part of the record that swings (window of [prepare]), or other terms; to have values all the same: "
          "[ask] accept = [\"residuals\"]"};
}

std::string table_of(const ::fit::decay::Problem& problem, const ::fit::decay::Solution& solution) {
  const auto& runs = solution.runs;
  std::string out = "file";
  for (const auto& [name, value] : runs[0].source.labels) out += "," + name;
  out += fmt::format(",first_amplitude [{}]", problem.turns ? "rad" : "m");
  for (const Coefficient& c : in_table(runs[0]))
    out += fmt::format(",{0} [{1}],{0}_low [{1}],{0}_high [{1}]", c.name, ::fit::decay::unit_of(c.name, problem.turns));
  out += '\n';
  for (const DecayRun& run : runs) {
    out += run.name();
    for (const auto& [name, value] : run.source.labels) out += "," + value;
    out += fmt::format(",{:.6g}", run.decrement.amplitude.front());
    for (const Coefficient& c : in_table(run)) {
      out += c.value ? fmt::format(",{:.6g}", *c.value) : ",";
      // An interval is told for what cannot be told from zero, and is none where a direction is not seen.
      out += std::isfinite(c.interval.low) && std::isfinite(c.interval.high)
                 ? fmt::format(",{:.6g},{:.6g}", c.interval.low, c.interval.high)
                 : ",,";
    }
    out += '\n';
  }
  return out;
}

Panels panels_of(const ::fit::decay::Problem& problem, const ::fit::decay::Solution& solution) {
  const double confidence = problem.options.motion.confidence;
  Panels out;
  for (const DecayRun& run : solution.together ? std::vector{*solution.together} : solution.runs) {
    for (std::size_t w = 0; w < run.records.size(); ++w) add_record(problem, run, w, out);
    if (!run.swing || !run.swing->damping.value) continue;
    const auto unit = [&](const char* of) { return ::fit::decay::unit_with_mass(of, problem.turns); };
    out.push_back(panel_over_frequency(run, false, unit("added_mass"), confidence));
    out.push_back(panel_over_frequency(run, true, unit("damping"), confidence));
  }
  return out;
}

}  // namespace froude
