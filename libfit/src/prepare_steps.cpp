#include "prepare_steps.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "fit/levels.hpp"
#include "fit/resample.hpp"
#include "fit/sensor.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/zero_crossings.hpp"

namespace fit {
namespace {

/// Half of the window about a sample, in samples of the record as it was given; 0 where outliers are not looked for.
int outlier_half_window(const std::vector<double>& time, const PrepareOptions& options) {
  if (options.outlier_window_s <= 0) return 0;
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1),
               half = options.outlier_window_s / (2 * step);
  if (!(half >= 2) || half > static_cast<double>(time.size()) / 4)
    throw hydro::InputError(
        fmt::format("outliers are looked for in a window of {:.4g} s: of a record with a sample every {:.4g} "
                    "s it must be {:.4g} s at least, and half of it, {:.4g} s, at most",
                    options.outlier_window_s, step, 4 * step, (time.back() - time.front()) / 2),
        {}, "give the outliers a window of some ten samples");
  return static_cast<int>(half);
}

std::size_t fill_gaps(RecordColumns& r, double longest_s) {  // (F22)
  const EvenGrid grid = even_grid(r.time, longest_s);
  r.step = grid.step;
  if (grid.filled.empty()) return 0;
  for (const auto& [name, column] : r.columns) *column = on_grid(grid, *column);
  r.time = grid.time;
  r.log.tell("gaps: {} of {} samples were missing and lie on straight lines", grid.filled.size(), grid.time.size());
  return grid.filled.size();
}

void look_at_sensors(RecordColumns& r, const std::vector<double>* rests) {  // (F19), (F20)
  for (const auto& [name, column] : r.columns) {
    if (const auto c = find_clipping(*column); c && column != rests)
      r.log.warn("{} stands at {} in {:.2g} % of its samples: the sensor was at its stop, and larger values are lost",
                 name,
                 c->at_low > 0 && c->at_high > 0 ? fmt::format("{:.4g} or {:.4g}", c->low, c->high)
                                                 : fmt::format("{:.4g}", c->at_low > 0 ? c->low : c->high),
                 100.0 * static_cast<double>(c->at_low + c->at_high) / static_cast<double>(column->size()));
    if (const auto q = find_quantisation(*column))
      r.log.tell("resolution: {} knows {} levels, {:.3g} apart, which is a noise of {:.2g}", name, q->levels, q->step,
                 q->noise());
  }
}

std::vector<std::size_t> take_outliers(RecordColumns& r, int half_window, double deviations) {  // (F22)
  std::vector<std::size_t> counts;
  for (const auto& [name, column] : r.columns) {
    const auto found = half_window == 0 ? std::vector<std::size_t>{} : find_outliers(*column, half_window, deviations);
    counts.push_back(found.size());
    if (half_window == 0) continue;
    bridge(*column, found);
    r.log.tell(
        "outliers: {} of {} samples of {} were more than {:g} deviations off their {} neighbours and are bridged",
        found.size(), column->size(), name, deviations, 2 * half_window);
  }
  return counts;
}

void take_levels(RecordColumns& r) {  // (F111)
  for (const auto& [name, column] : r.columns) {
    auto curve = through_levels(*column);
    if (!curve) {
      r.log.tell("levels: {} knows more than a thousand, or none, and stays as it is", name);
      continue;
    }
    *column = std::move(curve->values);
    r.log.tell(
        "levels: {} goes on a spline through {} places known by {} flat parts, {:.3g} apart; a sample was moved "
        "by {:.2g} of that at most",
        name, curve->knots, curve->flat_parts, curve->step, curve->largest_change);
  }
}

}  // namespace

Replaced evened_and_cleaned(RecordColumns& record, const PrepareOptions& options, const std::vector<double>* rests) {
  const int half_window = outlier_half_window(record.time, options);
  Replaced out;
  out.filled = fill_gaps(record, options.longest_gap_s);
  look_at_sensors(record, rests);
  out.outliers = take_outliers(record, half_window, options.outlier_deviations);
  if (options.through_levels) take_levels(record);
  return out;
}

void resample(RecordColumns& r, double hz) {  // (F48)
  if (hz == 0) return;
  hydro::require(hz > 0 && std::isfinite(hz), "a sampling rate must be positive, got {} Hz", hz);
  constexpr double most = 100;  // times the rate that was recorded: between samples there is nothing to be found
  if (hz * r.step > most)
    throw hydro::InputError(
        fmt::format("a sampling rate of {:.4g} Hz is more than {:g} times that of the record, {:.4g} Hz", hz, most,
                    1 / r.step),
        {}, "resample to the rate of the other records");
  const Resampler to(r.step, 1 / hz);
  const double first = r.time.front() + static_cast<double>(to.settling()) * r.step;
  for (const auto& [name, column] : r.columns) *column = to.apply(*column);
  r.time.resize(r.columns.front().second->size());
  for (std::size_t k = 0; k < r.time.size(); ++k) r.time[k] = first + static_cast<double>(k) / hz;
  r.log.tell(
      "resampling: from {:.5g} Hz to {:.5g} Hz, all channels alike: 0.2 % to {:.3g} Hz, closed from {:.3g} Hz, "
      "no delay, {:.3g} s given up at each end",
      1 / r.step, hz, to.bandwidth_hz(), to.closed_hz(), static_cast<double>(to.settling()) * r.step);
  r.step = 1 / hz;
}

Trend::Trend(const WindowChoice& window, const std::vector<double>& time, const std::vector<double>& values) {
  SampleSpan part{0, time.size()};
  if (window.kind == WindowChoice::Kind::span) part = samples_within(window, time);
  const std::size_t count = part.to - part.from;
  const auto line =
      hydro::signal::trend_of(std::span(time).subspan(part.from, count), std::span(values).subspan(part.from, count));
  slope_ = line.slope;
  middle_s_ = line.middle_s;
  share_ = line.share;
  from_s_ = time[part.from];
  to_s_ = time[part.to - 1];
}

void Trend::take_off(const std::vector<double>& time, std::vector<double>& values) const {
  for (std::size_t j = 0; j < values.size(); ++j) values[j] -= slope_ * (time[j] - middle_s_);
}

std::string Trend::told(const std::string& name) const {
  return fmt::format(
      "trend: {} changes by {:.4g} from {:.4g} s to {:.4g} s, {:.2g} % of its variance, which is taken off", name,
      slope_ * (to_s_ - from_s_), from_s_, to_s_, 100 * share_);
}

std::string told(const ZeroPhaseFilter& filter, const std::string& name, double step) {
  return fmt::format("{}: 1 % to {:.3g} Hz, no delay, {:.3g} s given up at each end", name, filter.bandwidth_hz(),
                     static_cast<double>(filter.settling()) * step);
}

std::string told(const BandPass& band, const std::string& name, double step) {
  const auto flat = band.flat_hz();
  return fmt::format("{}: {}, no delay, {:.4g} s given up at each end", name,
                     flat ? fmt::format("1 % from {:.3g} Hz to {:.3g} Hz", flat->first, flat->second)
                          : "its edges are too close for any frequency to keep 99 %",
                     static_cast<double>(band.settling()) * step);
}

double gain_of(const PrepareOptions& options, double step, double omega) {
  double out =
      options.band_pass ? BandPass(options.band_pass->low_hz, options.band_pass->high_hz, step).gain(omega) : 1;
  for (const FilterChoice& choice : options.filters) out *= filter_of(choice, step).gain(omega);
  return out;
}

ZeroPhaseFilter filter_of(const FilterChoice& c, double step) {
  switch (c.kind) {
    case FilterChoice::Kind::butterworth:
      return ZeroPhaseFilter::butterworth(c.order, c.hz, step);
    case FilterChoice::Kind::chebyshev:
      return ZeroPhaseFilter::chebyshev(c.order, c.ripple, c.hz, step);
    case FilterChoice::Kind::gaussian:
      return ZeroPhaseFilter::gaussian(c.hz, step);
    case FilterChoice::Kind::finite:
      return ZeroPhaseFilter::finite(c.hz, step);
    case FilterChoice::Kind::notch:
      return ZeroPhaseFilter::notch(c.hz, c.width, step);
    case FilterChoice::Kind::moving_average:
      break;
  }
  return ZeroPhaseFilter::moving_average(2 * static_cast<int>(c.seconds / (2 * step)) + 1, step);
}

SampleSpan samples_within(const WindowChoice& window, const std::vector<double>& t) {
  const auto from = std::lower_bound(t.begin(), t.end(), window.from),
             to = std::upper_bound(t.begin(), t.end(), window.to);
  if (!(from < to))
    throw hydro::InputError(
        fmt::format(
            "the window from {:.4g} s to {:.4g} s lies outside what is left of the record, {:.4g} s to {:.4g} s",
            window.from, window.to, t.front(), t.back()),
        {}, "give a window within that, or name filters that give up less at the ends");
  return {static_cast<std::size_t>(from - t.begin()), static_cast<std::size_t>(to - t.begin())};
}

void keep_part(std::vector<double>& column, std::size_t from, std::size_t count) {
  column = {column.begin() + static_cast<std::ptrdiff_t>(from),
            column.begin() + static_cast<std::ptrdiff_t>(from + count)};
}

}  // namespace fit
