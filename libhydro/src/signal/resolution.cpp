#include "hydro/signal/resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hydro::signal {
namespace {

using Complexes = std::vector<std::complex<double>>;

/// At a frequency, straight between its neighbours.
std::complex<double> between(const TransferEstimate& t, double frequency_hz) {
  const double place = frequency_hz / t.frequency_hz[1];
  const auto below = std::min(static_cast<std::size_t>(place), t.h1.size() - 2);
  const double share = place - static_cast<double>(below);
  return (1 - share) * t.h1[below] + share * t.h1[below + 1];
}

/// Weights 1, 2, 3, 2, 1 of what is finite: the shift changes over some frequencies, its noise from one to the next.
Complexes smoothed(const Complexes& values) {
  constexpr std::array<double, 5> weights{1, 2, 3, 2, 1};
  Complexes out(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    double all = 0;
    for (std::size_t j = 0; j < weights.size(); ++j) {
      if (k + j < 2 || k + j - 2 >= values.size()) continue;
      const std::complex<double> one = values[k + j - 2];
      if (!std::isfinite(std::norm(one))) continue;
      out[k] += weights[j] * one;
      all += weights[j];
    }
    if (all > 0) out[k] /= all;
  }
  return out;
}

}  // namespace

std::vector<std::complex<double>> resolution_shift(const TransferEstimate& estimate, std::span<const InputOutput> runs,
                                                   double step_s, const WelchOptions& options) {
  WelchOptions halved = options;
  halved.segment = options.segment / 4 * 2;  // even
  if (halved.segment < 8) return {};
  const TransferEstimate half = transfer(runs, step_s, halved);
  // The bias goes with the square of the bandwidth: of half the segment it is r² times as large. Richardson.
  const double r = static_cast<double>(options.segment) / static_cast<double>(halved.segment);
  Complexes out;
  for (std::size_t k = 0; k < estimate.h1.size(); ++k)
    out.push_back((estimate.h1[k] - between(half, estimate.frequency_hz[k])) / (r * r - 1));
  return smoothed(out);
}

std::vector<double> resolution_shift_of_gain(const TransferEstimate& estimate, std::span<const InputOutput> runs,
                                             double step_s, const WelchOptions& options) {
  std::vector<double> out;
  for (const auto shift = resolution_shift(estimate, runs, step_s, options); const auto& one : shift) {
    const std::complex<double> h1 = estimate.h1[out.size()];
    out.push_back(std::abs(h1) > 0 ? (std::conj(h1) * one).real() / std::abs(h1) : 0);  // the part along H₁
  }
  return out;
}

std::string caution_of_resolution(const std::string& name, const TransferEstimate& estimate,
                                  const std::vector<double>& shift, const std::vector<double>& half_width) {
  constexpr double small = 0.2;
  double most = small;
  std::size_t at = 0, many = 0, all = 0;
  for (std::size_t k = 1; k < shift.size(); ++k) {  // the first is the mean
    if (!(half_width[k] > 0)) continue;
    const double share = std::abs(shift[k]) / half_width[k];
    ++all;
    many += share > small ? 1 : 0;
    if (share > most) most = share, at = k;
  }
  if (at == 0) return {};
  return fmt::format(
      "the resolution of the segments moves the gain of {} at {} of {} frequencies by more than a fifth of the "
      "half-width of its interval, at {:.3g} Hz by {:.2g} of it: the gain is {:.2g} % too {} there; intervals reach "
      "over that, and segments twice as long have a quarter of it",
      name, many, all, estimate.frequency_hz[at], most, 100 * std::abs(shift[at]) / std::abs(estimate.h1[at]),
      shift[at] < 0 ? "large" : "small");
}

}  // namespace hydro::signal
