#include "hydro/signal/welch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/fft.hpp"

namespace hydro::signal {
namespace {

std::vector<double> window_of(const WelchOptions& options) {
  std::vector<double> w(options.segment, 1.0);
  if (options.window == Window::rectangular) return w;
  // The periodic Hann window: its transform has three lines, so a line on a bin leaks into two neighbours only.
  for (std::size_t j = 0; j < w.size(); ++j)
    w[j] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(w.size()));
  return w;
}

std::size_t hop_of(const WelchOptions& options) {
  const double kept = static_cast<double>(options.segment) * (1 - options.overlap);
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kept)));
}

double mean_of(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

void check(std::span<const double> values, double step_s, const WelchOptions& options) {
  require(std::isfinite(step_s) && step_s > 0, "the sampling step must be positive, got {} s", step_s);
  require(options.segment >= 4 && options.segment % 2 == 0,
          "a Welch segment needs an even number of samples, 4 or more, got {}", options.segment);
  require(options.overlap >= 0 && options.overlap < 1, "the overlap must be at least 0 and below 1, got {}",
          options.overlap);
  require(values.size() >= options.segment, "the record has {} samples ({:.6g} s), a segment needs {} ({:.6g} s)",
          values.size(), static_cast<double>(values.size()) * step_s, options.segment,
          static_cast<double>(options.segment) * step_s);
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  require(bad == values.end(), "sample {} of the record is not a finite number", bad - values.begin());
}

std::size_t segments_in(std::size_t n, const WelchOptions& options) {
  return 1 + (n - options.segment) / hop_of(options);
}

/// Fourier coefficients of segment `index`, mean removed, window applied.
std::vector<std::complex<double>> segment_fft(std::span<const double> values, double record_mean, std::size_t index,
                                              std::span<const double> window, const WelchOptions& options) {
  const auto segment = values.subspan(index * hop_of(options), options.segment);
  const double mean = options.detrend == Detrend::segment_mean ? mean_of(segment) : record_mean;
  std::vector<double> tapered(segment.size());
  for (std::size_t j = 0; j < segment.size(); ++j) tapered[j] = window[j] * (segment[j] - mean);
  return real_fft(tapered);
}

std::vector<double> frequencies(const WelchOptions& options, double step_s) {
  std::vector<double> f(options.segment / 2 + 1);
  for (std::size_t k = 0; k < f.size(); ++k)
    f[k] = static_cast<double>(k) / (static_cast<double>(options.segment) * step_s);
  return f;
}

/// Names the first step that is not as most are: the mean step of a record with a gap is nowhere in it.
[[noreturn]] void refuse_uneven(std::span<const double> time_s, double slack) {
  std::vector<double> steps;
  for (std::size_t j = 1; j < time_s.size(); ++j) steps.push_back(time_s[j] - time_s[j - 1]);
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const auto odd = std::find_if(steps.begin(), steps.end(),
                                [&](double h) { return !(std::abs(h - *middle) <= slack * std::abs(*middle)); });
  const std::size_t j = odd == steps.end() ? 0 : static_cast<std::size_t>(odd - steps.begin());
  throw InputError(
      fmt::format("the record is not evenly sampled: from sample {} at {:.9g} s to the next {:.6g} s pass, "
                  "where most steps take {:.6g} s",
                  j + 1, time_s[j], steps[j], *middle),
      {},
      "bridge the gap or interpolate to an even step first (--longest-gap, --resample, or these keys of a fit), "
      "or cut the record there; `froude psd --uneven` takes it as it is");
}

}  // namespace

double even_step(std::span<const double> time_s) {
  require(time_s.size() >= 2, "a record needs at least two samples, got {}", time_s.size());
  const double step = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  require(std::isfinite(step) && step > 0, "time must increase, but goes from {} s to {} s", time_s.front(),
          time_s.back());
  constexpr double slack = 0.02;  // of a step
  for (std::size_t j = 0; j < time_s.size(); ++j)
    if (!(std::abs(time_s[j] - time_s.front() - static_cast<double>(j) * step) <= slack * step))
      refuse_uneven(time_s, slack);
  return step;
}

WelchOptions fifteen_segments(std::size_t n) {
  require(n >= 32, "a spectrum needs at least 32 samples, got {}", n);
  return {.segment = n / 8 / 2 * 2};
}

double welch_dof(std::size_t segments, const WelchOptions& options) {  // (S6)
  const std::vector<double> w = window_of(options);
  const std::size_t hop = hop_of(options);
  const double square = std::inner_product(w.begin(), w.end(), w.begin(), 0.0);
  const auto k = static_cast<double>(segments);
  double sum = 1;
  for (std::size_t j = 1; j < segments && j * hop < w.size(); ++j) {
    const auto shift = static_cast<std::ptrdiff_t>(j * hop);
    const double rho = std::inner_product(w.begin() + shift, w.end(), w.begin(), 0.0) / square;
    sum += 2 * (k - static_cast<double>(j)) / k * rho * rho;
  }
  return 2 * k / sum;
}

WelchSpectrum welch(std::span<const double> values, double step_s, const WelchOptions& options) {  // (S5)
  check(values, step_s, options);
  const std::vector<double> w = window_of(options);
  const double square = std::inner_product(w.begin(), w.end(), w.begin(), 0.0);
  const double sum = std::accumulate(w.begin(), w.end(), 0.0);
  WelchSpectrum result;
  result.segments = segments_in(values.size(), options);
  result.samples_used = (result.segments - 1) * hop_of(options) + options.segment;
  result.dof = welch_dof(result.segments, options);
  result.mean = mean_of(values);
  result.variance = 0;
  for (const double v : values)
    result.variance += (v - result.mean) * (v - result.mean) / static_cast<double>(values.size());
  result.resolution_hz = square / (sum * sum * step_s);
  result.spectrum.frequency_hz = frequencies(options, step_s);
  auto& density = result.spectrum.density;
  density.assign(options.segment / 2 + 1, 0.0);
  const double scale = 2 * step_s / (square * static_cast<double>(result.segments));
  for (std::size_t i = 0; i < result.segments; ++i) {
    const auto x = segment_fft(values, result.mean, i, w, options);
    for (std::size_t k = 0; k < x.size(); ++k) density[k] += scale * std::norm(x[k]);
  }
  return result;
}

BandFactors confidence_band(double dof, double level) {  // (S7)
  require(level > 0 && level < 1, "a confidence level must lie between 0 and 1, got {}", level);
  return {dof / chi_square_quantile((1 + level) / 2, dof), dof / chi_square_quantile((1 - level) / 2, dof)};
}

double coherence_threshold(double averages, double level) {  // (S10)
  require(level > 0 && level < 1, "a confidence level must lie between 0 and 1, got {}", level);
  require(averages > 1, "the coherence of {} averages tells nothing; two segments are needed", averages);
  return 1 - std::pow(1 - level, 1 / (averages - 1));
}

double welch_dof(std::span<const std::size_t> segments, const WelchOptions& options) {  // (S21)
  double all = 0, sum = 0;
  for (const std::size_t k : segments) {
    const auto of_run = static_cast<double>(k);
    all += of_run;
    sum += of_run * of_run / welch_dof(k, options);
  }
  return all * all / sum;
}

namespace {

/// Sums over segments: |X|², |Y|² and conj(X) Y.
struct CrossSums {
  std::vector<double> xx, yy;
  std::vector<std::complex<double>> xy;
};

void add_segments(const InputOutput& run, std::size_t segments, std::span<const double> window,
                  const WelchOptions& options, CrossSums& sums) {
  const double input_mean = mean_of(run.input), output_mean = mean_of(run.output);
  for (std::size_t i = 0; i < segments; ++i) {
    const auto x = segment_fft(run.input, input_mean, i, window, options);
    const auto y = segment_fft(run.output, output_mean, i, window, options);
    for (std::size_t k = 0; k < sums.xx.size(); ++k) {
      sums.xx[k] += std::norm(x[k]);
      sums.yy[k] += std::norm(y[k]);
      sums.xy[k] += std::conj(x[k]) * y[k];
    }
  }
}

}  // namespace

TransferEstimate transfer(std::span<const InputOutput> runs, double step_s, const WelchOptions& options) {
  require(!runs.empty(), "a transfer function needs a record");
  std::vector<std::size_t> segments;
  for (const auto& [input, output] : runs) {
    require(input.size() == output.size(), "the input has {} samples, the output {}", input.size(), output.size());
    check(input, step_s, options);
    check(output, step_s, options);
    segments.push_back(segments_in(input.size(), options));
  }
  require(std::accumulate(segments.begin(), segments.end(), std::size_t{0}) >= 2,
          "a transfer function needs at least two segments of {} samples, the record of {} holds one", options.segment,
          runs[0].input.size());
  const std::vector<double> w = window_of(options);
  const std::size_t bins = options.segment / 2 + 1;
  CrossSums sums{std::vector<double>(bins), std::vector<double>(bins), std::vector<std::complex<double>>(bins)};
  for (std::size_t r = 0; r < runs.size(); ++r) add_segments(runs[r], segments[r], w, options, sums);
  TransferEstimate t{frequencies(options, step_s), {}, {}, {}, {}, welch_dof(segments, options) / 2, 0};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < bins; ++k) {
    const double cross = std::norm(sums.xy[k]);
    const double coherence =
        cross > 0 ? std::min(1.0, cross / (sums.xx[k] * sums.yy[k])) : 0.0;  // 1 is exceeded by rounding only
    t.coherence.push_back(coherence);
    t.h1.push_back(sums.xx[k] > 0 ? sums.xy[k] / sums.xx[k] : nan);        // (S8)
    t.h2.push_back(cross > 0 ? sums.yy[k] / std::conj(sums.xy[k]) : nan);  // (S8)
    t.gain_relative_error.push_back(cross > 0 ? std::sqrt((1 - coherence) / (2 * coherence * t.averages))
                                              : nan);  // (S9)
  }
  t.coherence_threshold = coherence_threshold(t.averages, 0.95);
  return t;
}

TransferEstimate transfer(std::span<const double> input, std::span<const double> output, double step_s,
                          const WelchOptions& options) {
  const InputOutput run{input, output};
  return transfer(std::span(&run, 1), step_s, options);
}

double total_gain(const TransferEstimate& e, std::size_t k) { return std::sqrt(std::abs(e.h1[k]) * std::abs(e.h2[k])); }

}  // namespace hydro::signal
