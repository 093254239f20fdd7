#include <algorithm>
#include <cmath>

#include "fit/towing.hpp"
#include "froude/fit_summary.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;

std::vector<::fit::TowingRun> towing_runs(const scene::FitScene& scene) {
  std::vector<::fit::TowingRun> runs;
  for (const auto& file : scene.files) {
    const auto table = hydro::io::CsvTable::read(file.value);
    const std::vector<double> unknown(table.rows(), 0.0);
    const auto column = [&](const char* role, const hydro::Dimension& dimension) -> const std::vector<double>& {
      const auto at = scene.channels.find(role);
      return at == scene.channels.end() ? unknown : table.column(at->second, dimension);
    };
    const auto &speed = column("speed", dim::velocity), &speed_sd = column("speed_sd", dim::velocity);
    const auto &force = table.column(scene.force[0].column, dim::force), &force_sd = column("force_sd", dim::force);
    for (std::size_t i = 0; i < table.rows(); ++i)
      runs.push_back({speed[i], speed_sd[i], scene.force[0].turned ? -force[i] : force[i], force_sd[i]});
  }
  return runs;
}

/// (F66) Runs that differ by more than their deviations allow have no drag coefficient in common.
std::exception_ptr refusal_of(const scene::FitScene& scene, const ::fit::TowingFit& fit) {
  return std::make_exception_ptr(CheckFailed(hydro::InputError(
      fmt::format(
          "no cd of all runs together is told: they scatter {:.3g} times as much as their deviations say, which "
          "allow {:.3g} times",
          fit.scatter, fit.allowed),
      scene.model_place,
      "cd may depend on speed: fit fewer runs, or state the deviations that they have; to have their mean all the "
      "same: [ask] accept = [\"residuals\"]")));
}

/// The mean of all runs, and how they scatter about it.
void add_mean(const ::fit::TowingFit& fit, FitSummary& summary) {
  FitSummary mean;
  mean.heading = fmt::format("together: cd {:.4f}, {:g} % interval {:.4f} to {:.4f}", *fit.cd.value,
                             100 * fit.confidence, fit.cd.interval.low, fit.cd.interval.high);
  mean.facts["cd"] = tree_of(Estimate{.coefficient = fit.cd});
  if (std::isfinite(fit.scatter)) {
    mean.facts.update({{"chi_square", fit.chi_square}, {"scatter", fit.scatter}});
    mean.say("{}the runs scatter {:.2f} times as much as their deviations say{}",
             fit.scatter > fit.allowed ? "accepted: " : "", fit.scatter,
             fit.scatter > 1 ? "; the interval is widened by as much" : "");
  }
  if (std::isfinite(fit.allowed)) mean.facts["scatter_allowed"] = fit.allowed;
  summary.parts.push_back(std::move(mean));
}

FitSummary summary_of(const scene::FitScene& scene, const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs,
                      bool refused) {
  FitSummary summary = begin_summary(scene);
  summary.heading =
      fmt::format("C_D = F/(1/2 rho U^2 D L)\n{:>10} {:>10} {:>10} {:>8} {:>8}", "U [m/s]", "F [N]", "Re", "cd", "+-");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto& [cd, deviation, re] = fit.points[i];
    FitSummary run{.key = "run", .one_of_many = true};
    run.heading =
        fmt::format("{:>10.4g} {:>10.4g} {:>10} {:>8.3f} {:>8}", runs[i].speed, runs[i].force,
                    re ? fmt::format("{:.3g}", *re) : "-", cd, deviation > 0 ? fmt::format("{:.3f}", deviation) : "-");
    run.facts = {{"speed", runs[i].speed}, {"force", runs[i].force}, {"cd", cd}, {"cd_deviation", deviation}};
    if (re) run.facts["re"] = *re;
    summary.parts.push_back(std::move(run));
  }
  if (!refused) add_mean(fit, summary);
  return summary;
}

plot::Figure figure(const scene::FitScene& scene, const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs) {
  plot::Series points{"runs", {}, {}, false, true};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    points.x.push_back(runs[i].speed);
    points.y.push_back(fit.points[i].cd);
  }
  const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
  const std::vector<double> ends{*low, *high};
  return {.title = title_of(scene),
          .panels = {{.x = {"speed", "m/s"},
                      .y = {"C_D"},
                      .series = {points, {"together", ends, {*fit.cd.value, *fit.cd.value}}},
                      .bands = {{fmt::format("{:g} %", 100 * fit.confidence),
                                 ends,
                                 {fit.cd.interval.low, fit.cd.interval.low},
                                 {fit.cd.interval.high, fit.cd.interval.high}}}}}};
}

}  // namespace

FitOutcome fit_model(const scene::FitScene& scene, const scene::TowingModel& model) {
  const auto runs = towing_runs(scene);
  const auto fit = ::fit::fit_towing(model.cylinder, runs, scene.confidence);
  const bool refused = fit.scatter > fit.allowed && !model.accept_residuals;
  if (refused)
    return {.summary = summary_of(scene, fit, runs, refused), .picture = {}, .refused = refusal_of(scene, fit)};
  return {summary_of(scene, fit, runs, refused), figure(scene, fit, runs)};
}

}  // namespace froude
