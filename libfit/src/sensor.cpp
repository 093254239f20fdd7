#include "fit/sensor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <unordered_set>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"

namespace fit {
namespace {

double median(std::vector<double>& v) {  // leaves v in another order
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

void require_finite(std::span<const double> values) {
  hydro::require(std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }),
                 "a sample of the sensor is not finite");
}

/// An end of a record's range: how often it occurs, the value next to it, and how often that one does.
struct End {
  double value, next;
  std::size_t count = 0, next_count = 0;
};
/// `before(a, b)`: a lies nearer to that end.
template <class Before>
End end_of(std::span<const double> values, Before before) {
  End out{values.front(), values.front()};
  for (const double x : values) {
    if (x == out.value) {
      ++out.count;
    } else if (before(x, out.value)) {
      out = {x, out.value, 1, out.count};
    } else if (out.next_count == 0 || before(x, out.next)) {
      out.next = x;
      out.next_count = 1;
    } else if (x == out.next) {
      ++out.next_count;
    }
  }
  return out;
}

std::size_t most_in_a_row(std::span<const double> values, double at) {
  std::size_t most = 0, now = 0;
  for (const double x : values) {
    now = x < at || x > at ? 0 : now + 1;
    most = std::max(most, now);
  }
  return most;
}

/// The different values of a record in increasing order; none where they are more than `most`.
std::vector<double> levels_of(std::span<const double> values, std::size_t most) {
  std::unordered_set<double> seen;
  for (const double x : values)
    if (seen.insert(x).second && seen.size() > most) return {};
  std::vector<double> out(seen.begin(), seen.end());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::optional<Clipping> find_clipping(std::span<const double> values) {  // (F19)
  require_finite(values);
  if (values.empty()) return {};
  const End low = end_of(values, std::less<>()), high = end_of(values, std::greater<>());
  if (low.next_count == 0 || low.next == high.value) return {};  // fewer than three levels
  const auto stops = [](const End& end) { return end.count >= 5 && end.count > 5 * end.next_count; };
  Clipping c{.low = low.value, .high = high.value};
  if (stops(low)) c.at_low = low.count;
  if (stops(high)) c.at_high = high.count;
  if (c.at_low + c.at_high == 0) return {};
  if (c.at_low > 0) c.low_in_a_row = most_in_a_row(values, c.low);
  if (c.at_high > 0) c.high_in_a_row = most_in_a_row(values, c.high);
  return c;
}

double Quantisation::noise() const { return step / std::sqrt(12.0); }

std::optional<Quantisation> find_quantisation(std::span<const double> values) {  // (F20)
  constexpr std::size_t most_steps = 999;  // over the range: finer ones are far below any noise
  require_finite(values);
  const std::vector<double> level = levels_of(values, most_steps + 1);
  if (level.size() < 3) return {};
  const double range = level.back() - level.front();
  double least = range;
  for (std::size_t i = 1; i < level.size(); ++i) least = std::min(least, level[i] - level[i - 1]);
  if (range > (most_steps + 0.5) * least) return {};
  // The mean of all steps over the multiple that each is: better than one difference of two rounded numbers.
  double multiples = 0;
  for (std::size_t i = 1; i < level.size(); ++i) {
    const double multiple = (level[i] - level[i - 1]) / least;
    if (std::abs(multiple - std::round(multiple)) > 0.05 * std::max(1.0, multiple)) return {};
    multiples += std::round(multiple);
  }
  return Quantisation{range / multiples, static_cast<std::size_t>(multiples) + 1};
}

std::vector<SpectralLine> find_lines(std::span<const double> values, double step_s, double from_hz) {  // (F21)
  hydro::require(values.size() >= 64, "lines need a spectrum of at least 64 samples, got {}", values.size());
  const auto w = hydro::signal::welch(values, step_s, hydro::signal::fifteen_segments(values.size()));
  const std::vector<double>&f = w.spectrum.frequency_hz, &s = w.spectrum.density;
  constexpr std::size_t width = 2, around = 12;  // bins that a Hann window spreads a line over; bins asked each side
  std::vector<SpectralLine> lines;
  for (std::size_t k = width; k + width < f.size(); ++k) {
    if (f[k] < from_hz || s[k] < s[k - 1] || s[k] < s[k + 1]) continue;
    std::vector<double> floor;
    for (std::size_t j = k > around ? k - around : 1; j < std::min(k + around + 1, f.size() - 1); ++j)
      if (j + width < k || j > k + width) floor.push_back(s[j]);
    if (floor.size() < around || s[k] <= 30 * median(floor)) continue;
    double variance = 0;
    for (std::size_t j = k - width; j <= k + width; ++j) variance += s[j] * (f[1] - f[0]);
    lines.push_back({f[k], std::sqrt(2 * variance)});
  }
  std::sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  if (lines.size() > 10) lines.resize(10);
  return lines;
}

std::vector<std::size_t> find_outliers(std::span<const double> values, int half_window, double deviations) {  // (F22)
  hydro::require(half_window >= 2 && deviations >= 3,
                 "outliers need at least 2 neighbours on each side and 3 deviations, got {} and {}", half_window,
                 deviations);
  const std::ptrdiff_t n = std::ssize(values), m = half_window;
  const double* x = values.data();
  std::vector<double> off(values.size(), 0.0), near;
  // Off the median of the means of pairs, one sample before and one as far behind: a slope leaves it alone.
  for (std::ptrdiff_t j = 1; j + 1 < n; ++j) {
    near.clear();
    for (std::ptrdiff_t k = 1; k <= std::min({m, j, n - 1 - j}); ++k) near.push_back((x[j - k] + x[j + k]) / 2);
    off[static_cast<std::size_t>(j)] = std::abs(x[j] - median(near));
  }
  std::vector<std::size_t> found;
  for (std::ptrdiff_t j = 1; j + 1 < n; ++j) {
    near.assign(off.begin() + std::max<std::ptrdiff_t>(0, j - m), off.begin() + std::min(n, j + m + 1));
    const double spread = 1.4826 * median(near);
    if (spread > 0 && off[static_cast<std::size_t>(j)] > deviations * spread)
      found.push_back(static_cast<std::size_t>(j));
  }
  return found;
}

void bridge(std::vector<double>& values, std::span<const std::size_t> indices) {
  for (std::size_t i = 0; i < indices.size();) {
    std::size_t last = i;
    while (last + 1 < indices.size() && indices[last + 1] == indices[last] + 1) ++last;
    const std::size_t from = indices[i], to = indices[last];
    hydro::require(from > 0 && to + 1 < values.size(), "the first or last sample is an outlier: cut the record there");
    const double step = (values[to + 1] - values[from - 1]) / static_cast<double>(to - from + 2);
    for (std::size_t j = from; j <= to; ++j) values[j] = values[from - 1] + step * static_cast<double>(j - from + 1);
    i = last + 1;
  }
}

namespace {

/// The last digit that all times have, a power of ten; 0 for finer ones than a microsecond.
double last_digit(std::span<const double> time) {
  for (double digit = 1; digit > 0.5e-6; digit /= 10) {
    constexpr double rounding = 1e-6;  // of a digit: times of a day have their own
    const auto is_whole = [&](double t) { return std::abs(t / digit - std::round(t / digit)) < rounding; };
    if (std::all_of(time.begin(), time.end(), is_whole)) return digit;
  }
  return 0;
}

/// (F123) The step of times that are even but for their last digit, to which they were rounded. None where they are
/// even to 2 % as they stand, or are not even with that.
std::optional<double> step_of_rounded(std::span<const double> time) {
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  double farthest = 0;
  for (std::size_t j = 0; j < time.size(); ++j)
    farthest = std::max(farthest, std::abs(time[j] - time[0] - step * static_cast<double>(j)));
  if (!(step > 0) || farthest < 0.02 * step) return std::nullopt;
  const double digit = last_digit(time);
  // Half of it where it stands, and half at the ends, between which the grid is laid; less than half a step is
  // rounding.
  if (digit >= step / 2 || farthest > digit * (1 + 1e-6)) return std::nullopt;
  return step;
}

}  // namespace

EvenGrid even_grid(std::span<const double> time_s, double longest_gap_s) {  // (F22)
  hydro::require(time_s.size() >= 3, "a record needs at least three samples, got {}", time_s.size());
  if (const auto step = step_of_rounded(time_s)) {
    EvenGrid rounded{.step = *step, .time = std::vector<double>(time_s.size()), .filled = {}};
    for (std::size_t k = 0; k < time_s.size(); ++k) rounded.time[k] = time_s[0] + *step * static_cast<double>(k);
    return rounded;
  }
  std::vector<double> steps;
  for (std::size_t j = 1; j < time_s.size(); ++j) steps.push_back(time_s[j] - time_s[j - 1]);
  std::vector<double> order = steps;
  const double rough = median(order);
  hydro::require(rough > 0, "time does not increase");
  EvenGrid grid{.step = rough, .time = {time_s[0]}, .filled = {}};
  std::vector<std::size_t> index{0};
  for (std::size_t j = 0; j < steps.size(); ++j) {
    const double multiple = steps[j] / rough;
    hydro::require(multiple > 0.5, "time does not increase after {:.6g} s", time_s[j]);
    if (!(multiple < 1.5 || steps[j] <= longest_gap_s))
      throw hydro::InputError(
          fmt::format("{:.4g} s are missing after {:.6g} s{}", steps[j], time_s[j],
                      longest_gap_s > 0 ? fmt::format("; gaps may be {:.4g} s long", longest_gap_s) : ""),
          {}, fmt::format("a longest gap of {:.4g} s bridges it with a straight line", steps[j]));
    index.push_back(index.back() + static_cast<std::size_t>(std::lround(multiple)));
  }
  grid.step = (time_s.back() - time_s.front()) / static_cast<double>(index.back());
  for (std::size_t j = 1; j < time_s.size(); ++j) {
    const double off = time_s[j] - time_s[0] - grid.step * static_cast<double>(index[j]);
    hydro::require(std::abs(off) < 0.02 * grid.step, "the sample at {:.6g} s is {:.2g} of a step off the even grid",
                   time_s[j], off / grid.step);
    for (std::size_t k = index[j - 1] + 1; k < index[j]; ++k) grid.filled.push_back(k);
  }
  grid.time.resize(index.back() + 1);
  for (std::size_t k = 0; k < grid.time.size(); ++k) grid.time[k] = time_s[0] + grid.step * static_cast<double>(k);
  return grid;
}

std::vector<double> on_grid(const EvenGrid& grid, std::span<const double> values) {
  std::vector<double> out(grid.time.size());
  std::size_t next = 0, source = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (next < grid.filled.size() && grid.filled[next] == k)
      ++next;
    else
      out[k] = values[source++];
  }
  bridge(out, grid.filled);
  return out;
}

void require_signal(const std::string& name, std::span<const double> values) {
  const auto is_finite = [](double v) { return std::isfinite(v); };
  const auto first = std::find_if(values.begin(), values.end(), is_finite);
  if (std::count_if(first, values.end(), is_finite) < 2) return;
  if (std::any_of(first, values.end(), [&](double v) { return std::abs(v - *first) > 0; })) return;
  throw hydro::InputError(fmt::format("{} is {:.6g} throughout: the sensor gave no signal", name, *first), {},
                          "look whether it was connected, or leave the channel out");
}

}  // namespace fit
