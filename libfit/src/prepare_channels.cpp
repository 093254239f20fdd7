#include "fit/prepare_channels.hpp"

#include "hydro/base/error.hpp"
#include "prepare_steps.hpp"

namespace fit {
namespace {

void check_for_channels(const std::vector<double>& time, const std::vector<PreparedChannel>& channels,
                        const PrepareOptions& options) {
  hydro::require(!channels.empty() && time.size() >= 3, "a record needs a channel and three samples, got {} and {}",
                 channels.size(), time.size());
  for (const PreparedChannel& c : channels)
    hydro::require(c.values.size() == time.size(), "{} has {} samples, time {}", c.name, c.values.size(), time.size());
  hydro::require(
      options.delay_s == 0 && !options.average_cycles && options.window.kind != WindowChoice::Kind::full_cycles &&
          !options.band_about_waves,
      "channels by themselves are not moved in time, cut into cycles or filtered about the frequency of waves");
}

void take_trend(RecordColumns& r, const WindowChoice& window) {
  for (const auto& [name, column] : r.columns) {
    const Trend trend(window, r.time, *column);
    trend.take_off(r.time, *column);
    r.log.steps.push_back(trend.told(name));
  }
}

void cut_record(RecordColumns& r, std::size_t from, std::size_t count) {
  keep_part(r.time, from, count);
  for (const auto& [name, column] : r.columns)
    if (column->size() != count) keep_part(*column, from, count);
}

/// Over all columns, whose ends are given up.
template <class Filter>
void filter_record(RecordColumns& r, const Filter& filter) {
  for (const auto& [name, column] : r.columns) *column = filter.apply(*column);
  cut_record(r, filter.settling(), r.time.size() - 2 * filter.settling());
}

void filter_with(RecordColumns& r, const FilterChoice& choice) {  // (F16)
  const ZeroPhaseFilter filter = filter_of(choice, r.step);
  filter_record(r, filter);
  r.log.steps.push_back(told(filter, filter.name(), r.step));
}

void pass_band(RecordColumns& r, const BandEdges& edges) {  // (F108)
  const BandPass band(edges.low_hz, edges.high_hz, r.step);
  filter_record(r, band);
  r.log.steps.push_back(told(band, band.name(), r.step));
}

void cut_span(RecordColumns& r, const WindowChoice& window) {
  if (window.kind == WindowChoice::Kind::all) return;
  const SampleSpan part = samples_within(window, r.time);
  cut_record(r, part.from, part.to - part.from);
  r.log.tell("window: from {:.4g} s to {:.4g} s", r.time.front(), r.time.back());
}

}  // namespace

PreparedChannels prepare_channels(std::vector<double> time, std::vector<PreparedChannel> channels,
                                  const PrepareOptions& options) {
  check_for_channels(time, channels, options);
  PreparedChannels out;
  out.time = std::move(time);
  out.channels = std::move(channels);
  StepLog log;
  RecordColumns record{out.time, out.step, {}, log};
  for (PreparedChannel& c : out.channels) record.columns.push_back({c.name, &c.values});
  const Replaced replaced = evened_and_cleaned(record, options);
  out.filled = replaced.filled;
  for (std::size_t i = 0; i < out.channels.size(); ++i) out.channels[i].outliers = replaced.outliers[i];
  resample(record, options.resample_hz);
  if (options.detrend) take_trend(record, options.window);
  for (const FilterChoice& choice : options.filters) filter_with(record, choice);
  if (options.band_pass) pass_band(record, *options.band_pass);
  out.steady_from_s = out.time.front();
  out.steady_to_s = out.time.back();
  cut_span(record, options.window);
  out.steps = std::move(log.steps);
  out.cautions = std::move(log.cautions);
  return out;
}

}  // namespace fit
