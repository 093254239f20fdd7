#include <algorithm>
#include <cmath>

#include "fit/towing.hpp"
#include "harness/case.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::hendriksen_towing {

Outcome outcome(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.reference("towing.csv"));
  const std::vector<double>&speed = table.column("velocity_mean_m_s"), &speed_sd = table.column("velocity_sd"),
        &force = table.column("force_mean_N"), &force_sd = table.column("force_sd"), &printed = table.column("cd_mean"),
        &printed_sd = table.column("cd_sd");
  const fit::Cylinder cylinder{
      .diameter = 0.12, .length = 0.5, .density = 997, .viscosity = {}, .experiment = fit::Experiment::body_moves};
  std::vector<fit::TowingRun> runs;
  for (std::size_t i = 0; i < table.rows(); ++i)
    runs.push_back(
        {.speed = speed[i], .speed_deviation = speed_sd[i], .force = force[i], .force_deviation = force_sd[i]});
  const fit::TowingFit fit = fit::fit_towing(cylinder, runs);

  Outcome outcome;
  double worst = 0, worst_deviation = 0;
  plot::Series ours{.name = "from speed and force", .x = speed, .y = {}, .line = false, .marks = true};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const fit::TowingPoint& point = fit.points[i];
    outcome.numbers.push_back({fmt::format("cd at {} m/s", speed[i]), point.cd, ""});
    ours.y.push_back(point.cd);
    worst = std::max(worst, std::abs(point.cd - printed[i]) / printed_sd[i]);
    worst_deviation = std::max(worst_deviation, std::abs(point.cd_deviation / printed_sd[i] - 1));
  }
  outcome.numbers.push_back({"largest difference from the printed cd, in printed deviations", worst, ""});
  outcome.numbers.push_back({"largest relative difference of the deviation of cd", worst_deviation, ""});
  outcome.numbers.push_back({"weighted mean of cd", fit.cd.value.value_or(std::nan("")), ""});
  plot::Band band{.name = "printed, one deviation", .x = speed, .low = {}, .high = {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    band.low.push_back(printed[i] - printed_sd[i]);
    band.high.push_back(printed[i] + printed_sd[i]);
  }
  const plot::Series theirs{.name = "printed", .x = speed, .y = printed, .line = false, .marks = true};
  outcome.pictures = {{"cd",
                       "Drag coefficient over towing speed.",
                       {.title = "Towed cylinder",
                        .panels = {{.x = {.label = "speed", .unit = "m/s"},
                                    .y = {.label = "C_D"},
                                    .series = {ours, theirs},
                                    .bands = {band}}}}}};
  return outcome;
}

}  // namespace froude::validation::hendriksen_towing
