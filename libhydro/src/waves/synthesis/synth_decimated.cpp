// A record that is sampled far more densely than its waves need: few samples are summed, the rest interpolated (W99).
#include <cmath>
#include <numbers>
#include <vector>

#include "synth_phase.hpp"
#include "synth_series.hpp"
#include "synth_window.hpp"

namespace hydro::waves::series {
namespace {

constexpr std::size_t width = 16, taps = width + 1;
constexpr double oversampling = 2;

const Window& window() {
  static const Window w(width, oversampling);
  return w;
}

// Weight of coarse sample i + l for the fine sample `factor`·i + p, shape (taps, padded factor).
std::vector<double> tap_weights(std::size_t factor) {
  std::vector<double> out(taps * simd::padded(factor), 0.0);
  Window::Weights weight;
  for (std::size_t p = 0; p < factor; ++p) {
    const double position = static_cast<double>(width / 2) + static_cast<double>(p) / static_cast<double>(factor);
    window().weights(position, 1, weight);
    for (std::size_t l = 0; l < width; ++l)
      out[(l + static_cast<std::size_t>(window().first(position))) * simd::padded(factor) + p] = weight[0][l];
  }
  return out;
}

// out[factor·i + p] for i = 0 … count − 1; `out` has room for whole packs beyond the last.
FROUDE_KERNEL void interpolate(const double* coarse, std::size_t count, const double* weights, std::size_t factor,
                               double* out) {
  const std::size_t stride = simd::padded(factor);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t p = 0; p < stride; p += simd::lanes) {
      simd::Pack even{}, odd{}, w;
      for (std::size_t l = 0; l + 1 < taps; l += 2) {
        simd::load(weights + l * stride + p, w);
        even += coarse[i + l] * w;
        simd::load(weights + (l + 1) * stride + p, w);
        odd += coarse[i + l + 1] * w;
      }
      simd::load(weights + (taps - 1) * stride + p, w);
      even += coarse[i + taps - 1] * w;
      simd::store(even + odd, out + i * factor + p);
    }
}

}  // namespace

std::size_t decimation(std::span<const double> omega, double dt) {
  double highest = 0;
  for (const double w : omega) highest = std::max(highest, std::abs(w));
  std::size_t factor = 1;  // powers of two, so that factor·dt is exact
  while (factor < 64 && 2 * static_cast<double>(factor) * highest * dt <= std::numbers::pi / oversampling) factor *= 2;
  return factor;
}

std::size_t decimated_samples(std::size_t samples, std::size_t factor) {
  return (samples + factor - 1) / factor + width;
}

double decimation_error() { return window().error(std::numbers::pi / oversampling, 1); }
double decimation_amplification() {
  return window().transform(0) / window().transform(std::numbers::pi / oversampling);
}

void decimated(const Task& task, Summation coarse_method, Eigen::MatrixXd& out) {
  const std::size_t factor = decimation(task.omega, task.dt), count = (task.samples + factor - 1) / factor;
  const double dt = static_cast<double>(factor) * task.dt, before = -static_cast<double>(factor * (width / 2));
  Eigen::MatrixXcd amplitudes = task.amplitudes;
  for (Eigen::Index j = 0; j < amplitudes.cols(); ++j) {
    const double omega = task.omega[static_cast<std::size_t>(j)];
    const auto back = phase::unit(phase::times(phase::repeatable(phase::of(omega, task.dt)), before));
    amplitudes.col(j) *= back / window().transform(omega * dt);
  }
  Eigen::MatrixXd coarse(static_cast<Eigen::Index>(decimated_samples(task.samples, factor)), out.cols());
  coarse_method({task.omega, dt, static_cast<std::size_t>(coarse.rows()), amplitudes}, coarse);
  const auto weights = tap_weights(factor);
  std::vector<double> fine(count * factor + simd::padded(factor));
  for (Eigen::Index s = 0; s < out.cols(); ++s) {
    interpolate(coarse.col(s).data(), count, weights.data(), factor, fine.data());
    std::copy_n(fine.begin(), task.samples, out.col(s).data());
  }
}

}  // namespace hydro::waves::series
