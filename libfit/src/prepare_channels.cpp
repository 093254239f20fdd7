#include "fit/prepare_channels.hpp"

#include <span>

#include "fit/band_pass.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/zero_crossings.hpp"
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
      options.delay_s == 0 && !options.average_cycles && options.window.kind != WindowChoice::Kind::full_cycles,
      "channels by themselves are not moved in time or cut into cycles");
}

/// The line through the window, of a record that may be longer. (F108)
void take_trend(RecordColumns& r, const WindowChoice& window) {
  SampleSpan part{0, r.time.size()};
  if (window.kind == WindowChoice::Kind::span) part = samples_within(window, r.time);
  const std::span<const double> time = std::span(r.time).subspan(part.from, part.to - part.from);
  for (const auto& [name, column] : r.columns) {
    const auto trend = hydro::signal::trend_of(time, std::span(*column).subspan(part.from, part.to - part.from));
    for (std::size_t j = 0; j < column->size(); ++j) (*column)[j] -= trend.slope * (r.time[j] - trend.middle_s);
    r.log.tell("trend: {} changes by {:.4g} from {:.4g} s to {:.4g} s, {:.2g} % of its variance, which is taken off",
               name, trend.slope * (time.back() - time.front()), time.front(), time.back(), 100 * trend.share);
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
  r.log.tell("{}: 1 % to {:.3g} Hz, no delay, {:.3g} s given up at each end", filter.name(), filter.bandwidth_hz(),
             static_cast<double>(filter.settling()) * r.step);
}

void pass_band(RecordColumns& r, const BandEdges& edges) {  // (F108)
  const BandPass band(edges.low_hz, edges.high_hz, r.step);
  filter_record(r, band);
  const auto flat = band.flat_hz();
  r.log.tell("{}: {}, no delay, {:.4g} s given up at each end", band.name(),
             flat ? fmt::format("1 % from {:.3g} Hz to {:.3g} Hz", flat->first, flat->second)
                  : "its edges are too close for any frequency to keep 99 %",
             static_cast<double>(band.settling()) * r.step);
}

void cut_span(RecordColumns& r, const WindowChoice& window) {
  if (window.kind == WindowChoice::Kind::all) return;
  const SampleSpan part = samples_within(window, r.time);
  cut_record(r, part.from, part.to - part.from);
  r.log.tell("window: from {:.4g} s to {:.4g} s", r.time.front(), r.time.back());
}

}  // namespace

PreparedChannels prepare_channels(std::vector<double> time, std::vector<PreparedChannel> channels,
                                  const ChannelSteps& steps) {
  check_for_channels(time, channels, steps.prepare);
  PreparedChannels out;
  out.time = std::move(time);
  out.channels = std::move(channels);
  StepLog log;
  RecordColumns record{out.time, out.step, {}, log};
  for (PreparedChannel& c : out.channels) record.columns.push_back({c.name, &c.values});
  const Replaced replaced = evened_and_cleaned(record, steps.prepare);
  out.filled = replaced.filled;
  for (std::size_t i = 0; i < out.channels.size(); ++i) out.channels[i].outliers = replaced.outliers[i];
  resample(record, steps.prepare.resample_hz);
  if (steps.detrend) take_trend(record, steps.prepare.window);
  for (const FilterChoice& choice : steps.prepare.filters) filter_with(record, choice);
  if (steps.band_pass) pass_band(record, *steps.band_pass);
  out.steady_from_s = out.time.front();
  out.steady_to_s = out.time.back();
  cut_span(record, steps.prepare.window);
  out.steps = std::move(log.steps);
  out.cautions = std::move(log.cautions);
  return out;
}

}  // namespace fit
