#include "fit/problem/towing.hpp"

#include <cmath>

#include "towing_records.hpp"

namespace fit::towing {
namespace {

Report told(const TowingRun& run, const TowingPoint& point) {
  const auto& [cd, deviation, re] = point;
  Report report{.key = "run", .one_of_many = true};
  report.heading =
      fmt::format("{:>10.4g} {:>10.4g} {:>10} {:>8.3f} {:>8}", run.speed, run.force,
                  re ? fmt::format("{:.3g}", *re) : "-", cd, deviation > 0 ? fmt::format("{:.3f}", deviation) : "-");
  report.facts = {{"speed", run.speed}, {"force", run.force}, {"cd", cd}, {"cd_deviation", deviation}};
  if (re) report.facts.emplace_back("re", *re);
  return report;
}

/// The mean of all runs, and how they scatter about it.
Report told_mean(const TowingFit& fit) {
  Report scatter, mean;
  mean.heading = fmt::format("together: cd {:.4f}, {:g} % interval {:.4f} to {:.4f}", *fit.cd.value,
                             100 * fit.confidence, fit.cd.interval.low, fit.cd.interval.high);
  mean.estimates = {{.coefficient = fit.cd, .in_words = true}};
  if (std::isfinite(fit.scatter) && fit.points.size() > 1) {
    scatter.facts = {{"chi_square", fit.chi_square}, {"scatter", fit.scatter}};
    scatter.say("{}the runs scatter {:.2f} times as much as their deviations say{}",
                fit.scatter > fit.allowed ? "accepted: " : "", fit.scatter,
                fit.scatter > 1 ? "; the interval is widened by as much" : "");
  }
  if (std::isfinite(fit.allowed)) scatter.facts.emplace_back("scatter_allowed", fit.allowed);
  mean.parts = {std::move(scatter)};
  return mean;
}

/// (F66) Runs that differ by more than their deviations allow have no drag coefficient in common.
std::optional<Refusal> refusal_of(const TowingFit& fit, const Options& options) {
  if (!(fit.scatter > fit.allowed) || options.accept_residuals) return {};
  return Refusal{
      Refusal::Reason::residuals_too_large,
      fmt::format("no cd of all runs together is told: they scatter {:.3g} times as much as their deviations say, "
                  "which allow {:.3g} times",
                  fit.scatter, fit.allowed)};
}

}  // namespace

Solution solve(const Problem& problem) {
  if (!problem.records.empty()) return solve_records(problem);
  Solution out{.report = {},
               .fit = fit_towing(problem.cylinder, problem.runs, problem.options.confidence),
               .records = {},
               .law = {}};
  count_slope(slope_error_of({{problem.options.force_slope, 1}, {problem.options.speed_slope, -2}}), *out.fit.cd.value,
              out.fit.cd);  // (F105)
  Report& report = out.report;
  report.refused = refusal_of(out.fit, problem.options);
  report.heading =
      fmt::format("C_D = F/(1/2 rho U^2 D L)\n{:>10} {:>10} {:>10} {:>8} {:>8}", "U [m/s]", "F [N]", "Re", "cd", "+-");
  for (std::size_t i = 0; i < problem.runs.size(); ++i)
    report.parts.push_back(told(problem.runs[i], out.fit.points[i]));
  if (!report.refused) report.parts.push_back(told_mean(out.fit));
  return out;
}

}  // namespace fit::towing
