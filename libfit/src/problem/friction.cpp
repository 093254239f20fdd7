#include "fit/problem/friction.hpp"

#include <cmath>

#include "telling.hpp"

namespace fit::friction {
namespace {

Report told(const Source& source, const FrictionRamp& f, const std::string& unit) {
  Report report = begin_run(source);
  report.heading = fmt::format("{}: slips at {:.4g} s, after growing by {:.3g} {} a second; residual {:.3g} {} rms",
                               source.name(), f.slip_s, f.rate, unit, f.residual_rms, unit);
  append(report.facts,
         {{"slip_s", f.slip_s}, {"rate", f.rate}, {"slide_rate", f.slide_rate}, {"residual_rms", f.residual_rms}});
  for (const Coefficient* c : {&f.static_level, &f.dynamic_level, &f.drop}) report.estimates.push_back({*c, unit});
  report.say("dynamic over static {:.3g}; while it slides the load changes by {:.2g} {} a second",
             *f.dynamic_level.value / *f.static_level.value, f.slide_rate, unit);
  report.warn(f.caution);
  return report;
}

/// One level of all tests together. A brake that slips to either side has two signs and one level.
RandomEffects level_of_all(const std::vector<FrictionRamp>& fits, Coefficient FrictionRamp::*level,
                           const Problem& problem) {
  std::vector<Coefficient> runs;
  for (const FrictionRamp& f : fits) {
    runs.push_back(f.*level);
    // The same in all tests is the slope of the channel; when each slipped is its own.
    runs.back().systematic_error = std::abs(middle(runs.back())) * problem.load_slope.standard;
  }
  return together(runs, files_of(problem.runs), problem.options.confidence, true);
}

/// (F105) Levels are proportional to the load.
FrictionRamp fitted(const Run& run, const Problem& problem) {
  FrictionRamp out = fit_friction_ramp(run.time, run.load, problem.options);
  for (Coefficient* c : {&out.static_level, &out.dynamic_level, &out.drop})
    count_slope(problem.load_slope, middle(*c), *c);
  return out;
}

/// Adds each level of all tests together, and what a scene of motion may include.
void add_levels(const std::vector<FrictionRamp>& fits, const Problem& problem, Report& report) {
  Report together{.key = "together"};
  Facts coefficients;
  const std::string unit = unit_of_load(problem);
  const auto include = [&](const std::string& name, double value) {
    coefficients.emplace_back(name, fmt::format("{:.10g} {}", value, unit));
  };
  for (const auto level : {&FrictionRamp::static_level, &FrictionRamp::dynamic_level}) {
    const Coefficient& first = fits[0].*level;
    if (fits.size() == 1) include(first.name, std::abs(*first.value));
    if (fits.size() < 3) continue;
    const RandomEffects all = level_of_all(fits, level, problem);
    include(first.name, all.coefficients[0]);
    together.parts.push_back(over_runs(first.name, unit, all, "test", fits.size(), problem.options.confidence));
  }
  if (!coefficients.empty()) report.facts.emplace_back("coefficients", std::move(coefficients));
  if (!together.parts.empty()) report.parts.push_back(std::move(together));
}

}  // namespace

const char* unit_of_load(const Problem& problem) { return problem.slides ? "N" : "N m"; }

Solution solve(const Problem& problem) {
  hydro::require(!problem.runs.empty(), "a fit of friction needs one test at least");
  Solution out;
  for (const Run& run : problem.runs) {
    out.fits.push_back(of_run(run.source, [&] { return fitted(run, problem); }));
    out.report.parts.push_back(told(run.source, out.fits.back(), unit_of_load(problem)));
  }
  add_levels(out.fits, problem, out.report);
  return out;
}

}  // namespace fit::friction
