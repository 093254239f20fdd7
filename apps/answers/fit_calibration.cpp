/// \file  Fits of kind "calibration": the line of a channel.
#include <algorithm>
#include <tuple>
#include <utility>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "fit/problem/channel.hpp"

namespace froude::scene {
namespace {

using CalibrationProblem = ::fit::channel::Problem;
using CalibrationOptions = ::fit::channel::Options;

class CalibrationFits final : public FitKindOf<CalibrationOptions, CalibrationProblem> {
 public:
  CalibrationFits()
      : FitKindOf({.word = "calibration",
                   .model = Binding<CalibrationOptions>(
                       "", "the line of a channel from readings at known references, one file each series of points"),
                   .channels = {text("reading", "what the channel gave"),
                                text("reference", "what was set: a level, an angle, a load"),
                                text("time", "when; with it a drift is told").optional()}}) {}

 private:
  void finish(const FitTables& t, const FitScene& scene, CalibrationOptions& options) const override {
    options.confidence = scene.confidence;
    if (scene.channels.at("reading") == scene.channels.at("reference"))
      throw t.channels().wrong("reference", "names the same column as reading", "name the column of what was set");
  }

  CalibrationProblem problem(const FitScene& scene, const CalibrationOptions& options) const override {
    CalibrationProblem out{.reading_unit = {}, .reference_unit = {}, .runs = {}, .options = options};
    for (const auto& [source, row] : runs_of(scene)) {
      const Measurements measured(scene, source.file);
      const std::string &reading = scene.channels.at("reading"), &reference = scene.channels.at("reference");
      const auto units = std::pair{measured.table.dimension(reading).si(), measured.table.dimension(reference).si()};
      if (!out.runs.empty() && units != std::pair{out.reading_unit, out.reference_unit})
        throw hydro::InputError("reading or reference has another unit than in the first file",
                                {.file = source.file.string()}, "calibrate one channel at a time");
      std::tie(out.reading_unit, out.reference_unit) = units;
      out.runs.push_back({source, {measured.table.column(reference), measured.table.column(reading), measured.time()}});
    }
    return out;
  }

  /// Points and lines, and what points lie off them.
  Panels panels(const CalibrationProblem& problem, const Solution& solution) const override {
    plot::Panel lines{.x = {"reference", problem.reference_unit}, .y = {"reading", problem.reading_unit}, .series = {}},
        left{.x = lines.x, .y = {"reading − line", problem.reading_unit}, .series = {}};
    for (std::size_t i = 0; i < problem.runs.size(); ++i) {
      const auto& [source, points] = problem.runs[i];
      const auto& line = solution.lines[i];
      const auto [low, high] = std::minmax_element(points.reference.begin(), points.reference.end());
      lines.series.push_back({source.name(), points.reference, points.reading, false, true});
      lines.series.push_back(
          {"line",
           {*low, *high},
           {*line.offset.value + *line.slope.value * *low, *line.offset.value + *line.slope.value * *high}});
      left.series.push_back({source.name(), points.reference, line.residuals, true, true});
    }
    return {std::move(lines), std::move(left)};
  }
};

}  // namespace

std::unique_ptr<const FitKind> calibration_fit() { return std::make_unique<CalibrationFits>(); }

}  // namespace froude::scene
