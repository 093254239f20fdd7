#include <algorithm>
#include <cmath>

#include "froude/fit_report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using Json = FitJson;

std::string sentence(const Coefficient& c, double confidence, std::size_t samples) {
  const std::string worth = fmt::format("worth {:.0f} of {} samples; if they were independent: {:.4g} to {:.4g}",
                                        c.effective_samples, samples, c.white_interval.low, c.white_interval.high);
  if (!c.value)
    return fmt::format("  {:<3} not identifiable: {} ({:g} % interval {:.4g} to {:.4g}; {})\n", c.name, c.why_not,
                       100 * confidence, c.interval.low, c.interval.high, worth);
  return fmt::format(
      "  {:<3} {:.4g}, {:g} % interval {:.4g} to {:.4g} ({})\n      a force 1 degree late would shift it by {:.2g}\n",
      c.name, *c.value, 100 * confidence, c.interval.low, c.interval.high, worth, c.shift_per_degree);
}

std::string delay_sentence(const Coefficient& d, double confidence) {
  if (!d.value) return fmt::format("  delay of the force not identifiable: {}\n", d.why_not);
  return fmt::format("  delay of the force {:.4g} s, {:g} % interval {:.4g} s to {:.4g} s\n", *d.value,
                     100 * confidence, d.interval.low, d.interval.high);
}

std::vector<std::string> cautions_of(const FitRun& run) {
  auto all = run.prepared.cautions;
  if (!run.fit.caution.empty()) all.push_back(run.fit.caution);
  return all;
}

}  // namespace

void tell_runs(const scene::FitScene& scene, const std::vector<FitRun>& runs, const Console& console) {
  const bool water = scene.model.motion == "water moves";
  console.out << (water ? "F = cm rho V du/dt + 1/2 rho D L cd |u| u, water moving past the body; cm = 1 + ca\n"
                        : "F = -(ca rho V + m) a - 1/2 rho D L cd |v| v, body moving in still water; cm = 1 + ca\n");
  for (const FitRun& run : runs) {
    const auto& f = run.fit;
    console.out << fmt::format(
        "{}: KC {:.4g}, {}T {:.4g} s, residual {:.4g} N rms, {:.2f} % of the force's variance explained\n", run.name,
        f.kc, f.re ? fmt::format("Re {:.4g}, ", *f.re) : "", f.period, f.residual_rms, 100 * f.explained);
    for (const Coefficient& c : run.asked) console.out << sentence(c, f.confidence, f.samples);
    console.out << fmt::format("  search: iterations {}, {}; singular values {:.3g} and {:.3g}; {}\n",
                               f.search.iterations, f.search.why, f.search.singular_values[0],
                               f.search.singular_values[1], f.search.identifiability);
    if (f.delay) console.out << delay_sentence(*f.delay, f.confidence);
    for (const auto& e : f.budget)
      console.out << fmt::format("  one deviation of the {}: cd {:+.2g}, {} {:+.2g}\n", e.source, e.cd, f.inertia.name,
                                 e.inertia);
    for (const std::string& step : run.prepared.steps) console.out << "  " << step << '\n';
    for (const std::string& caution : cautions_of(run)) console.out << "  caution: " << caution << '\n';
  }
}

Json as_json(const Coefficient& c) {
  Json j{{"identifiable", c.value.has_value()},
         {"standard_error", c.standard_error},
         {"systematic_error", c.systematic_error},
         {"interval", {c.interval.low, c.interval.high}},
         {"interval_if_independent", {c.white_interval.low, c.white_interval.high}},
         {"effective_samples", c.effective_samples},
         {"shift_per_degree", c.shift_per_degree}};
  if (c.value) j["value"] = *c.value;
  if (!c.why_not.empty()) j["why_not"] = c.why_not;
  return j;
}

Json runs_as_json(const scene::FitScene& scene, const std::vector<FitRun>& runs) {
  Json j{{"scene", scene.file.filename().string()},
         {"kind", "morison"},
         {"motion", scene.model.motion},
         {"confidence", scene.confidence},
         {"run", Json::array()}};
  for (const FitRun& run : runs) {
    Json r{{"file", run.name},
           {"kc", run.fit.kc},
           {"period_s", run.fit.period},
           {"residual_rms_N", run.fit.residual_rms},
           {"explained", run.fit.explained},
           {"samples", run.fit.samples},
           {"iterations", run.fit.search.iterations},
           {"search", run.fit.search.why},
           {"identifiability", run.fit.search.identifiability}};
    if (run.fit.re) r["re"] = *run.fit.re;
    r["correlation"] = run.fit.correlation;
    r["steps"] = run.prepared.steps;
    r["cautions"] = cautions_of(run);
    for (const auto& e : run.fit.budget)
      r["one_deviation"].push_back({{"of", e.source}, {"cd", e.cd}, {run.fit.inertia.name, e.inertia}});
    if (run.fit.delay) r["delay"] = as_json(*run.fit.delay);
    for (const Coefficient& c : run.asked) r[c.name] = as_json(c);
    j["run"].push_back(r);
  }
  return j;
}

/// Measured and fitted force, the last five periods of each run.
plot::Figure runs_figure(const scene::FitScene& scene, const std::vector<FitRun>& runs) {
  plot::Figure f{.title = scene.title.empty() ? scene.file.filename().string() : scene.title, .panels = {}};
  for (const FitRun& run : runs) {
    const auto& r = run.prepared.record;
    const auto from =
        std::lower_bound(r.time.begin(), r.time.end(), r.time.back() - 5 * run.fit.period) - r.time.begin();
    const auto tail = [&](const std::vector<double>& v) { return std::vector<double>(v.begin() + from, v.end()); };
    f.panels.push_back({.x = {"time", "s"},
                        .y = {"force", "N"},
                        .series = {{run.name + ": measured", tail(r.time), tail(r.force)},
                                   {"fitted", tail(r.time), tail(run.fit.fitted), true, false, true}}});
  }
  return f;
}

}  // namespace froude
