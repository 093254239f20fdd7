// Sums of any frequencies by a uniform transform (W95).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/signal/fft.hpp"
#include "synth_phase.hpp"
#include "synth_series.hpp"
#include "synth_window.hpp"

namespace hydro::waves::series {
namespace {

using Complex = std::complex<double>;
constexpr double oversampling = 1.5;
constexpr std::size_t width = 20, doubled = 2 * width;

const Window& window() {
  static const Window w(width, oversampling);
  return w;
}

bool has_small_factors(std::size_t n) {
  for (const std::size_t p : {2ul, 3ul, 5ul})
    while (n % p == 0) n /= p;
  return n == 1;
}

/// Where components fall between the bins of the transform, and what they weigh there.
struct Spread {
  std::vector<std::ptrdiff_t> first;
  std::vector<Complex> turn;   // from the first to the middle sample
  std::vector<double> weight;  // (components, 2 · width): each twice, for real and imaginary part
  std::vector<bool> negative;  // frequencies below zero: conjugates stand for them
};

// Samples are counted from the middle of the record, where the division by ψ̂ amplifies rounding least.
Spread spread_of(const Task& task, std::size_t length, std::size_t middle) {
  const std::size_t count = task.omega.size();
  Spread out{std::vector<std::ptrdiff_t>(count), std::vector<Complex>(count), std::vector<double>(count * doubled),
             std::vector<bool>(count)};
  const auto bins = static_cast<double>(length);
  std::array<double, Window::stride> weight;
  for (std::size_t j = 0; j < count; ++j) {
    const phase::Turns per_sample = phase::of(std::abs(task.omega[j]), task.dt);
    // A bin and what is left of it, apart: one rounding of the position would show at the ends of a long record.
    const double position = phase::rounded_product(per_sample.high, bins), below = std::floor(position);
    const double rest = (position - below) + (std::fma(per_sample.high, bins, -position) + per_sample.low * bins);
    window().weights(rest, weight.data());
    for (std::size_t l = 0; l < doubled; ++l) out.weight[j * doubled + l] = weight[l / 2];
    out.first[j] = static_cast<std::ptrdiff_t>(below) + window().first(rest);
    out.turn[j] = phase::unit(phase::times(phase::repeatable(per_sample), static_cast<double>(middle)));
    out.negative[j] = task.omega[j] < 0;
  }
  return out;
}

// Bins beyond either end of the half spectrum stand for the conjugates of bins inside it.
void fold(std::vector<Complex>& half, std::size_t length, std::ptrdiff_t bin, Complex value) {
  const auto n = static_cast<std::ptrdiff_t>(length);
  if (bin < 0) bin = -bin, value = std::conj(value);
  if (2 * bin > n) bin = n - bin, value = std::conj(value);
  half[static_cast<std::size_t>(bin)] += bin == 0 || 2 * bin == n ? value.real() : 0.5 * value;
}

// Components well inside the half spectrum need no folding: bins are pairs of real and imaginary part.
FROUDE_KERNEL void add_inside(double* bins, const std::ptrdiff_t* first, const double* weight, const Complex* value,
                              std::size_t from, std::size_t to) {
  for (std::size_t j = from; j < to; ++j) {
    const double re = 0.5 * value[j].real(), im = 0.5 * value[j].imag();
    const simd::Pack c{{re, im, re, im}, {re, im, re, im}};
    double* at = bins + 2 * first[j];
    for (std::size_t l = 0; l < doubled; l += simd::lanes) {
      simd::Pack w, sum;
      simd::load(weight + j * doubled + l, w);
      simd::load(at + l, sum);
      simd::store(sum + c * w, at + l);
    }
  }
}

void add_to_bins(std::vector<Complex>& half, std::size_t length, const Spread& spread, const std::vector<Complex>& c) {
  const auto inside = [&](std::size_t j) {
    return spread.first[j] > 0 &&
           2 * (spread.first[j] + static_cast<std::ptrdiff_t>(width)) < static_cast<std::ptrdiff_t>(length);
  };
  for (std::size_t j = 0; j < c.size();) {
    std::size_t end = j;
    while (end < c.size() && inside(end)) ++end;
    add_inside(reinterpret_cast<double*>(half.data()), spread.first.data(), spread.weight.data(), c.data(), j, end);
    if (end < c.size())
      for (std::size_t l = 0; l < width; ++l)
        fold(half, length, spread.first[end] + static_cast<std::ptrdiff_t>(l),
             c[end] * spread.weight[end * doubled + 2 * l]);
    j = end + 1;
  }
}

}  // namespace

std::size_t nonuniform_length(std::size_t samples) {
  auto length = std::max<std::size_t>(
      48, 2 * static_cast<std::size_t>(std::ceil(0.5 * oversampling * static_cast<double>(samples))));
  while (!has_small_factors(length)) length += 2;
  return length;
}

double nonuniform_error() { return window().error(std::numbers::pi / oversampling, 1); }

void nonuniform_fft(const Task& task, Eigen::MatrixXd& out) {
  const std::size_t length = nonuniform_length(task.samples), middle = task.samples / 2;
  const auto spread = spread_of(task, length, middle);
  std::vector<double> correction(task.samples - middle + 1);  // 1/ψ̂, even in n
  window().inverse_transforms(2 * std::numbers::pi / static_cast<double>(length), correction);
  std::vector<Complex> half(length / 2 + 1), c(task.omega.size());
  for (Eigen::Index s = 0; s < out.cols(); ++s) {
    for (std::size_t j = 0; j < c.size(); ++j) {
      const Complex given = task.amplitudes(s, static_cast<Eigen::Index>(j));
      c[j] = (spread.negative[j] ? std::conj(given) : given) * spread.turn[j];
    }
    std::fill(half.begin(), half.end(), 0.0);
    add_to_bins(half, length, spread, c);
    const auto series = signal::inverse_real_fft(half, length);
    double* to = out.col(s).data();
    for (std::size_t n = 0; n < middle; ++n) to[n] = series[length - middle + n] * correction[middle - n];
    for (std::size_t n = middle; n < task.samples; ++n) to[n] = series[n - middle] * correction[n - middle];
  }
}

}  // namespace hydro::waves::series
