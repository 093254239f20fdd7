#include "hydro/signal/multitaper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/signal/fft.hpp"

namespace hydro::signal {

WelchSpectrum multitaper(std::span<const double> values, double step_s, std::size_t tapers) {  // (S20)
  require(values.size() >= 8, "a spectrum by tapers needs at least 8 samples, got {}", values.size());
  require(std::isfinite(step_s) && step_s > 0, "the sampling step must be positive, got {} s", step_s);
  const std::size_t n = values.size() / 2 * 2;
  require(tapers >= 1 && tapers <= n / 4, "a record of {} samples takes 1 to {} tapers, got {}", n, n / 4, tapers);
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  require(bad == values.end(), "sample {} of the record is not a finite number", bad - values.begin() + 1);
  const auto used = values.first(n);
  const auto count = static_cast<double>(n), several = static_cast<double>(tapers);
  WelchSpectrum out;
  out.dof = 2 * several;
  out.segments = tapers;
  out.samples_used = n;
  out.mean = std::accumulate(used.begin(), used.end(), 0.0) / count;
  out.variance = 0;
  for (const double v : used) out.variance += (v - out.mean) * (v - out.mean) / count;
  out.resolution_hz = (several + 1) / ((count + 1) * step_s);
  for (std::size_t k = 0; k <= n / 2; ++k)
    out.spectrum.frequency_hz.push_back(static_cast<double>(k) / (count * step_s));
  out.spectrum.density.assign(n / 2 + 1, 0.0);
  std::vector<double> tapered(n);
  for (std::size_t taper = 1; taper <= tapers; ++taper) {
    const double turn = std::numbers::pi * static_cast<double>(taper) / (count + 1), size = std::sqrt(2 / (count + 1));
    for (std::size_t j = 0; j < n; ++j)
      tapered[j] = size * std::sin(turn * static_cast<double>(j + 1)) * (used[j] - out.mean);
    const auto x = real_fft(tapered);
    for (std::size_t k = 0; k < x.size(); ++k) out.spectrum.density[k] += 2 * step_s / several * std::norm(x[k]);
  }
  return out;
}

}  // namespace hydro::signal
