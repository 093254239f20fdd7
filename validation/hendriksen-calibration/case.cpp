#include "harness/case.hpp"
#include "fit/calibration.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::hendriksen_calibration {
namespace {

// Tension (positive loads) and compression are one loading cycle each.
std::vector<fit::LoadCycle> cycles_of(const hydro::io::CsvTable& table) {
  const std::vector<double>&force = table.column("force_N"), &voltage = table.column("volt_corrected");
  std::vector<fit::LoadCycle> cycles(2);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    fit::LoadCycle& cycle = cycles[force[i] < 0 ? 1 : 0];
    cycle.force.push_back(force[i]);
    cycle.voltage.push_back(voltage[i]);
  }
  return cycles;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  Outcome outcome;
  plot::Panel residuals{
      .x = {.label = "force", .unit = "N"}, .y = {.label = "voltage less line", .unit = "V"}, .series = {}};
  for (const int cell : {1, 2}) {
    const auto table = hydro::io::CsvTable::read(folders.reference(fmt::format("load_cell_{}.csv", cell)));
    const auto cycles = cycles_of(table);
    const fit::Calibration line = fit::calibrate(cycles);
    outcome.numbers.push_back({fmt::format("slope of load cell {}", cell), line.slope, "V/N"});
    outcome.numbers.push_back({fmt::format("standard error of slope {}", cell), line.slope_error, "V/N"});
    outcome.numbers.push_back({fmt::format("hysteresis of load cell {}", cell), line.hysteresis, ""});
    outcome.numbers.push_back({fmt::format("nonlinearity of load cell {}", cell), line.nonlinearity, ""});
    plot::Series series{.name = fmt::format("cell {}", cell), .x = {}, .y = {}, .line = false, .marks = true};
    for (const fit::LoadCycle& cycle : cycles)
      for (std::size_t i = 0; i < cycle.force.size(); ++i) {
        series.x.push_back(cycle.force[i]);
        series.y.push_back(cycle.voltage[i] - line.offset - line.slope * cycle.force[i]);
      }
    residuals.series.push_back(std::move(series));
  }
  outcome.pictures = {{"residuals", "What the straight lines leave.", {.title = "Load cells", .panels = {residuals}}}};
  return outcome;
}

}  // namespace froude::validation::hendriksen_calibration
