#include "wave_records.hpp"

#include <algorithm>

#include "fit/sensor.hpp"

namespace fit {

WaveRecord prepared(const WaveRun& run, const PrepareOptions& options, Report& report) {
  WaveRecord out;
  std::vector<std::string> done;
  const auto on_grid = [&](const std::string& name, const std::vector<double>& values) {
    require_signal(name, values);
    PreparedMotion p = prepare_motion(name, run.time, values, options);
    out.time = std::move(p.time);
    for (std::string& step : p.steps)
      if (std::find(done.begin(), done.end(), step) == done.end()) done.push_back(std::move(step));
    for (const std::string& caution : p.cautions) report.warn(caution);
    return std::move(p.values);
  };
  out.elevation = on_grid("elevation", run.elevation);
  for (const WaveChannel& c : run.responses) out.responses.push_back(on_grid(c.name, c.values));
  report.steps = std::move(done);
  return out;
}

SlopeError slope_error_of(const SlopeError& elevation, const std::vector<SlopeError>& responses, std::size_t response) {
  const SlopeError own = responses.empty() ? SlopeError{} : responses.at(response);
  return slope_error_of({{own, 1}, {elevation, -1}});
}

}  // namespace fit
