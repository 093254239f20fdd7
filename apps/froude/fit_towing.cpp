#include <algorithm>
#include <cmath>

#include "fit/towing.hpp"
#include "froude/fit_report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using Json = FitJson;
using Towing = scene::TowingModel;

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

bool is_refused(const Towing& model, const ::fit::TowingFit& fit) {
  return fit.scatter > fit.allowed && !model.accept_residuals;
}

/// (F66) Runs that differ by more than their deviations allow have no drag coefficient in common.
[[noreturn]] void refuse_mean(const scene::FitScene& scene, const ::fit::TowingFit& fit) {
  throw CheckFailed(hydro::InputError(
      fmt::format(
          "no cd of all runs together is told: they scatter {:.3g} times as much as their deviations say, which "
          "allow {:.3g} times",
          fit.scatter, fit.allowed),
      scene.model_place,
      "cd may depend on speed: fit fewer runs, or state the deviations that they have; to have their mean all the "
      "same: "
      "[ask] accept = [\"residuals\"]"));
}

void tell(const Towing& model, const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs,
          const Console& console) {
  console.out << fmt::format("C_D = F/(1/2 rho U^2 D L)\n{:>10} {:>10} {:>10} {:>8} {:>8}\n", "U [m/s]", "F [N]", "Re",
                             "cd", "+-");
  for (std::size_t i = 0; i < runs.size(); ++i)
    console.out << fmt::format(
        "{:>10.4g} {:>10.4g} {:>10} {:>8.3f} {:>8}\n", runs[i].speed, runs[i].force,
        fit.points[i].re ? fmt::format("{:.3g}", *fit.points[i].re) : "-", fit.points[i].cd,
        fit.points[i].cd_deviation > 0 ? fmt::format("{:.3f}", fit.points[i].cd_deviation) : "-");
  if (is_refused(model, fit)) return;
  console.out << fmt::format("together: cd {:.4f}, {:g} % interval {:.4f} to {:.4f}\n", *fit.cd.value,
                             100 * fit.confidence, fit.cd.interval.low, fit.cd.interval.high);
  if (std::isfinite(fit.scatter))
    console.out << fmt::format("{}the runs scatter {:.2f} times as much as their deviations say{}\n",
                               fit.scatter > fit.allowed ? "accepted: " : "", fit.scatter,
                               fit.scatter > 1 ? "; the interval is widened by as much" : "");
}

Json towed_as_json(const scene::FitScene& scene, const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs) {
  Json cd = froude::as_json(fit.cd);
  for (const char* time_series_only :
       {"effective_samples", "shift_per_degree", "systematic_error", "interval_if_independent"})
    cd.erase(time_series_only);
  Json j{{"scene", scene.file.filename().string()},
         {"kind", scene.kind()},
         {"confidence", scene.confidence},
         {"cd", cd},
         {"run", Json::array()}};
  if (std::isfinite(fit.scatter)) j.update({{"chi_square", fit.chi_square}, {"scatter", fit.scatter}});
  if (std::isfinite(fit.allowed)) j["scatter_allowed"] = fit.allowed;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Json r{{"speed", runs[i].speed},
           {"force", runs[i].force},
           {"cd", fit.points[i].cd},
           {"cd_deviation", fit.points[i].cd_deviation}};
    if (fit.points[i].re) r["re"] = *fit.points[i].re;
    j["run"].push_back(r);
  }
  return j;
}

plot::Figure figure(const scene::FitScene& scene, const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs) {
  plot::Series points{"runs", {}, {}, false, true};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    points.x.push_back(runs[i].speed);
    points.y.push_back(fit.points[i].cd);
  }
  const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
  const std::vector<double> ends{*low, *high};
  return {.title = scene.title.empty() ? scene.file.filename().string() : scene.title,
          .panels = {{.x = {"speed", "m/s"},
                      .y = {"C_D"},
                      .series = {points, {"together", ends, {*fit.cd.value, *fit.cd.value}}},
                      .bands = {{fmt::format("{:g} %", 100 * fit.confidence),
                                 ends,
                                 {fit.cd.interval.low, fit.cd.interval.low},
                                 {fit.cd.interval.high, fit.cd.interval.high}}}}}};
}

}  // namespace

void fit_model(const scene::FitScene& scene, const Towing& model, const FitArguments& arguments,
               const Console& console) {
  const auto runs = towing_runs(scene);
  const auto result = ::fit::fit_towing(model.cylinder, runs, scene.confidence);
  if (!console.json) tell(model, result, runs, console);
  if (is_refused(model, result)) refuse_mean(scene, result);
  deliver(arguments, console, towed_as_json(scene, result, runs), figure(scene, result, runs));
}

}  // namespace froude
