#include "wave_records.hpp"

#include <Eigen/Core>
#include <numbers>
#include <utility>

#include "fit/prepare_channels.hpp"
#include "fit/sensor.hpp"
#include "harmonic_series.hpp"

namespace fit {
PrepareOptions with_band(const WaveRun& run, PrepareOptions options) {
  if (!options.band_about_waves) return options;
  PrepareOptions even = options;
  even.band_about_waves = false;
  const PreparedChannels p = prepare_channels(run.time, {{"elevation", run.elevation}}, even);
  const auto& surface = p.channels[0].values;
  const Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(surface.data(), std::ssize(surface));
  options.band_pass =
      band_about_waves(frequency_of((values.array() - values.mean()).matrix(), p.step) / (2 * std::numbers::pi));
  options.band_about_waves = false;
  return options;
}

WaveRecord prepared(const WaveRun& run, const PrepareOptions& options, Report& report) {
  std::vector<PreparedChannel> channels{{"elevation", run.elevation}};
  for (const WaveChannel& c : run.responses) channels.push_back({c.name, c.values});
  for (const PreparedChannel& c : channels) require_signal(c.name, c.values);
  PreparedChannels p = prepare_channels(run.time, std::move(channels), options);
  WaveRecord out{std::move(p.time), std::move(p.channels[0].values), {}};
  for (std::size_t i = 1; i < p.channels.size(); ++i) out.responses.push_back(std::move(p.channels[i].values));
  for (const std::string& caution : p.cautions) report.warn(caution);
  report.steps = std::move(p.steps);
  return out;
}

SlopeError slope_error_of(const SlopeError& elevation, const std::vector<SlopeError>& responses, std::size_t response) {
  const SlopeError own = responses.empty() ? SlopeError{} : responses.at(response);
  return slope_error_of({{own, 1}, {elevation, -1}});
}

}  // namespace fit
