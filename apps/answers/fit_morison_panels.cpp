#include "answers/fit_morison.hpp"

#include <algorithm>
#include <cmath>

#include "answers/fit_measurements.hpp"

namespace froude::scene {
namespace {

using ::fit::Coefficient;
using MorisonRun = ::fit::morison::FittedRun;

/// The mean of all cycles with its standard error, and the fit over one of them. Where the delay was estimated, cycles
/// begin elsewhere in the record that was fitted, and the fit is left out.
void add_mean_cycle(const MorisonRun& run, const ::fit::MeanForce& mean, Panels& panels) {
  plot::Panel panel{.x = {"time in the cycle", "s"},
                    .y = {"mean force", "N"},
                    .series = {{fmt::format("mean of {} cycles", mean.cycles), mean.time, mean.force}},
                    .bands = {{"± standard error", mean.time, mean.force, mean.force}}};
  for (std::size_t k = 0; k < mean.force.size(); ++k) {
    panel.bands[0].low[k] -= mean.standard_error[k];
    panel.bands[0].high[k] += mean.standard_error[k];
  }
  if (!run.fit.delay) {
    const auto& fitted = run.fit.fitted;
    panel.series.push_back(
        {"fitted", mean.time, {fitted.begin(), fitted.begin() + std::ssize(mean.time)}, true, false, true});
  }
  panels.push_back(std::move(panel));
}

/// Measured and fitted force and what is left, the last five periods of one run.
void add_run(const MorisonRun& run, Panels& panels) {
  const auto& r = run.prepared.record;
  const auto from = std::lower_bound(r.time.begin(), r.time.end(), r.time.back() - 5 * run.fit.period) - r.time.begin();
  const auto tail = [&](const std::vector<double>& v) {
    return v.empty() ? v : std::vector<double>(v.begin() + from, v.end());
  };
  const ::fit::MorisonFit& f = run.fit;
  const Panels both = panels_of(FittedRecord{.legend = run.source.name() + ": measured",
                                             .axis = {"force", "N"},
                                             .confidence = f.confidence,
                                             .time = tail(r.time),
                                             .measured = tail(r.force),
                                             .fitted = tail(f.fitted),
                                             .sample_band = tail(f.sample_band),
                                             .fit_band = tail(f.fit_band)});
  panels.insert(panels.end(), both.begin(), both.end());
  if (run.prepared.mean_force) add_mean_cycle(run, *run.prepared.mean_force, panels);
}

/// An axis with room beside the first and last point.
plot::Axis roomy(const std::string& label, const std::vector<double>& x) {
  plot::Axis axis{.label = label};
  if (x.empty()) return axis;
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  const double room = 0.05 * (*high > *low ? *high - *low : std::abs(*high) + 1);
  axis.range = {{*low - room, *high + room}};
  return axis;
}

/// One coefficient over KC with its intervals, and the law where it asks for KC alone.
plot::Panel coefficient_panel(const std::vector<MorisonRun>& runs, std::size_t i,
                              const ::fit::morison::CoefficientLaw* law) {
  const std::string name = runs[0].asked[i].name;
  std::vector<double> kc;
  std::vector<const Coefficient*> told;
  for (const MorisonRun& run : runs) {
    if (!run.asked[i].value) continue;
    kc.push_back(run.fit.kc);
    told.push_back(&run.asked[i]);
  }
  plot::Panel panel{.x = roomy("KC", kc), .y = {name}, .series = with_bars(name, runs[0].fit.confidence, kc, told)};
  if (law == nullptr || kc.empty()) return panel;
  const auto& best = law->laws.front();
  if (best.law != ::fit::Law::kc && best.law != ::fit::Law::constant) return panel;
  double middle = 0;
  for (const double x : kc) middle += std::log(x) / static_cast<double>(kc.size());
  plot::Series line{"law", {}, {}};
  const auto [low, high] = std::minmax_element(kc.begin(), kc.end());
  for (int k = 0; k <= 50; ++k) {
    const double x = *low * std::pow(*high / *low, k / 50.0);
    line.x.push_back(x);
    line.y.push_back(best.coefficients[0] +
                     (best.law == ::fit::Law::kc ? best.coefficients[1] * (std::log(x) - middle) : 0.0));
  }
  panel.series.push_back(line);
  return panel;
}

}  // namespace

Panels morison_panels(const ::fit::morison::Solution& solution) {
  const auto& [report, runs, laws] = solution;
  Panels out;
  if (runs.size() < 3) {
    for (const MorisonRun& run : runs) add_run(run, out);
    return out;
  }
  for (std::size_t i = 0; i < runs[0].asked.size(); ++i)
    out.push_back(coefficient_panel(runs, i, laws.empty() ? nullptr : &laws[i]));
  plot::Series map{"runs", {}, {}, false, true};
  for (const MorisonRun& run : runs) {
    if (!run.fit.re) continue;
    map.x.push_back(run.fit.kc);
    map.y.push_back(*run.fit.re);
  }
  if (!map.x.empty()) out.push_back({.x = roomy("KC", map.x), .y = roomy("Re", map.y), .series = {map}});
  return out;
}

std::string morison_table(const ::fit::morison::Solution& solution) {
  const auto& runs = solution.runs;
  std::string out =
      "# One row for each run; a coefficient that the run does not tell has an empty value and its interval.\nfile";
  for (const auto& [name, value] : runs[0].source.labels) out += "," + name;
  out += ",KC,Re,beta,period [s]";
  for (const Coefficient& c : runs[0].asked) out += fmt::format(",{0},{0}_low,{0}_high,{0}_error", c.name);
  out += ",residual_rms [N],explained,cautions\n";
  for (const MorisonRun& run : runs) {
    out += run.source.name();
    for (const auto& [name, value] : run.source.labels) out += "," + value;
    const auto& f = run.fit;
    out += fmt::format(",{:.6g},{},{},{:.6g}", f.kc, f.re ? fmt::format("{:.6g}", *f.re) : "",
                       f.re ? fmt::format("{:.6g}", *f.re / f.kc) : "", f.period);
    for (const Coefficient& c : run.asked)
      out += fmt::format(",{},{:.6g},{:.6g},{:.3g}", c.value ? fmt::format("{:.6g}", *c.value) : "", c.interval.low,
                         c.interval.high, c.standard_error);
    out += fmt::format(",{:.4g},{:.6g},{}\n", f.residual_rms, f.explained,
                       run.prepared.cautions.size() + (f.caution.empty() ? 0 : 1));
  }
  return out;
}

}  // namespace froude::scene
