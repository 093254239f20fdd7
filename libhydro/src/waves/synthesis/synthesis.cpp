#include "hydro/waves/synthesis/synthesis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "hydro/signal/fft.hpp"
#include "synth_phase.hpp"
#include "synth_series.hpp"

namespace hydro::waves {
namespace {

using Complex = std::complex<double>;
using Phasors = std::span<const Complex>;
constexpr double last_digit = std::numeric_limits<double>::epsilon();

void require_one_per_component(std::size_t components, std::size_t amplitudes) {
  require(amplitudes == components, "{} complex amplitudes given for a sea of {} components", amplitudes, components);
}

void require_grid(std::span<const double> omega, const TimeGrid& grid, const Eigen::MatrixXcd& amplitudes) {
  require(std::isfinite(grid.dt_s) && grid.dt_s > 0, "a time step must be finite and positive, got {} s", grid.dt_s);
  require(std::isfinite(grid.start_s), "the first instant of a series must be finite, got {} s", grid.start_s);
  require(amplitudes.allFinite(), "an amplitude of a series is not finite");
  for (const double w : omega)
    if (!(std::abs(w) * grid.dt_s < std::numbers::pi * (1 - 1e-12)))
      throw InputError(fmt::format("a wave of period {} s cannot be sampled every {} s: less than two samples a period",
                                   2 * std::numbers::pi / std::abs(w), grid.dt_s),
                       {}, "give a smaller time step, or a sea with a lower highest frequency");
}

/// One repetition of a sea as a whole number of steps, and how far its components leave their bins.
struct Repetition {
  std::size_t samples;
  double drift;  ///< largest |ω_j t − 2πjn/m| at the end of the series, rad
};

std::optional<Repetition> repetition_of(const Sea& sea, const TimeGrid& grid) {
  if (std::isinf(sea.repetition_s()) || grid.start_s != 0) return {};
  const double steps = std::round(sea.repetition_s() / grid.dt_s);
  const double miss = std::abs(steps * grid.dt_s - sea.repetition_s());
  if (steps < 1 || steps > std::numeric_limits<int>::max() || miss > 4 * last_digit * sea.repetition_s()) return {};
  double drift = 0;  // in turns per repetition
  for (std::size_t i = 0; i < sea.components().size(); ++i) {
    const phase::Turns step = phase::of(sea.components()[i].omega, grid.dt_s);
    const double turns = std::fma(step.high, steps, -static_cast<double>(sea.grid_index()[i])) + step.low * steps;
    drift = std::max(drift, std::abs(turns));
  }
  return Repetition{static_cast<std::size_t>(steps),
                    2 * std::numbers::pi * drift * static_cast<double>(grid.samples) / steps};
}

/// Size of a job, for the cost model.
struct Size {
  double signals, components, samples;
  std::size_t decimation;

  Size thinned() const {
    Size out = *this;
    out.samples = static_cast<double>(series::decimated_samples(static_cast<std::size_t>(samples), decimation));
    out.decimation = 1;
    return out;
  }
};

// Seconds, fitted to docs/cost/synthesis.md; only their ratios matter.
double fft_cost(double length) { return 1.3e-9 * length * std::log2(length + 2); }
double expected_cost(SeriesMethod method, const Size& n, double period);

// What the samples left by decimation are summed by.
SeriesMethod coarse_method(const Size& n) {
  const auto cost = [&](SeriesMethod method) { return expected_cost(method, n.thinned(), 0); };
  return cost(SeriesMethod::blocked_phasors) < cost(SeriesMethod::nonuniform_fft) ? SeriesMethod::blocked_phasors
                                                                                  : SeriesMethod::nonuniform_fft;
}

double expected_cost(SeriesMethod method, const Size& n, double period) {
  switch (method) {
    case SeriesMethod::inverse_fft:
      return n.signals * (fft_cost(period) + 1e-9 * n.samples);
    case SeriesMethod::blocked_phasors: {
      const auto half = static_cast<double>(series::half_block(static_cast<std::size_t>(n.samples)));
      const double blocks = n.samples / (2 * half);
      return n.components * (1.5e-9 * (half + blocks) + 2e-7) +
             n.signals * (n.components * (6e-11 * n.samples + 1.5e-9 * blocks) + 2e-9 * n.samples);
    }
    case SeriesMethod::nonuniform_fft:
      return n.components * 2e-7 + 1e-8 * n.samples +
             n.signals * (fft_cost(1.5 * n.samples + 48) + 4e-8 * n.components + 1e-9 * n.samples);
    case SeriesMethod::decimated:
      return n.components * 1.5e-7 * (1 + 0.1 * n.signals) + 2e-9 * n.samples * n.signals +
             expected_cost(coarse_method(n), n.thinned(), 0);
    case SeriesMethod::plain_sum:
      break;
  }
  return 4e-8 * n.components * n.samples + 2e-9 * n.components * n.samples * n.signals;
}

// Bounds of |error|/Σ|c|, (W92), (W93), (W95), (W99). One rounding for each term that is added, and those of the
// phasors.
double error_of(SeriesMethod method, const Size& n, const std::optional<Repetition>& repetition) {
  const double summed = 0.5 * last_digit * (n.components + 16);
  switch (method) {
    case SeriesMethod::inverse_fft:
      return 2 * last_digit * std::log2(static_cast<double>(repetition->samples) + 2) + repetition->drift;
    case SeriesMethod::nonuniform_fft:
      return series::nonuniform_error() + 250 * last_digit * std::sqrt(std::log2(1.5 * n.samples + 48));
    case SeriesMethod::decimated:
      return series::decimation_error() +
             series::decimation_amplification() * error_of(coarse_method(n), n.thinned(), repetition);
    default:
      return summed;
  }
}

SeriesMethod cheapest(const Size& n, const std::optional<Repetition>& repetition) {
  auto best = SeriesMethod::blocked_phasors;
  const double period = repetition ? static_cast<double>(repetition->samples) : 0;
  const auto possible = [&](SeriesMethod method) {
    return (method != SeriesMethod::inverse_fft || repetition) &&
           (method != SeriesMethod::decimated || n.decimation > 1);
  };
  for (const auto method :
       {SeriesMethod::inverse_fft, SeriesMethod::nonuniform_fft, SeriesMethod::decimated, SeriesMethod::plain_sum})
    if (possible(method) && expected_cost(method, n, period) < expected_cost(best, n, period)) best = method;
  return best;
}

// Amplitudes at the first sample, so that the methods count time from there.
Eigen::MatrixXcd turned_to_start(std::span<const double> omega, double start, const Eigen::MatrixXcd& amplitudes) {
  Eigen::MatrixXcd out = amplitudes;
  if (start != 0)
    for (Eigen::Index j = 0; j < out.cols(); ++j)
      out.col(j) *= phase::unit(phase::of(omega[static_cast<std::size_t>(j)], start));
  return out;
}

void run(SeriesMethod method, const series::Task& task, const Size& size, const Sea* sea,
         const std::optional<Repetition>& repetition, Eigen::MatrixXd& out) {
  switch (method) {
    case SeriesMethod::inverse_fft:
      return series::inverse_fft(task, sea->grid_index(), repetition->samples, out);
    case SeriesMethod::blocked_phasors:
      return series::blocked_phasors(task, out);
    case SeriesMethod::nonuniform_fft:
      return series::nonuniform_fft(task, out);
    case SeriesMethod::decimated:
      return series::decimated(
          task, coarse_method(size) == SeriesMethod::blocked_phasors ? series::blocked_phasors : series::nonuniform_fft,
          out);
    case SeriesMethod::plain_sum:
      return series::plain(task, out);
  }
}

Synthesis summed(std::span<const double> omega, const Sea* sea, const TimeGrid& grid,
                 const Eigen::MatrixXcd& amplitudes, std::optional<SeriesMethod> asked) {
  require_one_per_component(omega.size(), static_cast<std::size_t>(amplitudes.cols()));
  require_grid(omega, grid, amplitudes);
  const auto repetition = sea != nullptr ? repetition_of(*sea, grid) : std::nullopt;
  if (asked == SeriesMethod::inverse_fft && !repetition)
    throw InputError(
        fmt::format("a step of {} s from {} s on does not suit an inverse FFT of this sea", grid.dt_s, grid.start_s),
        {}, "use a sea on an FFT grid, start at 0 s and divide its repetition by the step; or another method");
  const Size size{static_cast<double>(amplitudes.rows()), static_cast<double>(omega.size()),
                  static_cast<double>(grid.samples), series::decimation(omega, grid.dt_s)};
  if (asked == SeriesMethod::decimated && size.decimation == 1)
    throw InputError(
        fmt::format("with a step of {} s every sample of these waves is needed: none can be interpolated", grid.dt_s),
        {}, "use another method; this one wants eight samples or more in the shortest period");
  const SeriesMethod method = asked.value_or(cheapest(size, repetition));
  Synthesis out{Eigen::MatrixXd(static_cast<Eigen::Index>(grid.samples), amplitudes.rows()),
                {.method = method,
                 .relative_error = error_of(method, size, repetition),
                 .expected_s = expected_cost(method, size, repetition ? static_cast<double>(repetition->samples) : 0)}};
  if (out.series.size() == 0) return out;
  const Eigen::MatrixXcd turned = turned_to_start(omega, grid.start_s, amplitudes);
  run(method, {omega, grid.dt_s, grid.samples, turned}, size, sea, repetition, out.series);
  return out;
}

std::vector<double> frequencies(const Sea& sea) {
  std::vector<double> omega;
  for (const Component& wave : sea.components()) omega.push_back(wave.omega);
  return omega;
}

}  // namespace

void series::plain(const Task& task, Eigen::MatrixXd& out) {
  out.setZero();
  for (std::size_t j = 0; j < task.omega.size(); ++j) {
    const phase::Step step = phase::repeatable(phase::of(task.omega[j], task.dt));
    for (Eigen::Index n = 0; n < out.rows(); ++n) {
      const Complex phasor = phase::unit(phase::times(step, static_cast<double>(n)));
      for (Eigen::Index s = 0; s < out.cols(); ++s)
        out(n, s) += (task.amplitudes(s, static_cast<Eigen::Index>(j)) * phasor).real();
    }
  }
}

void series::inverse_fft(const Task& task, std::span<const std::size_t> index, std::size_t period,
                         Eigen::MatrixXd& out) {
  std::vector<Complex> half(period / 2 + 1);
  for (Eigen::Index s = 0; s < out.cols(); ++s) {
    std::fill(half.begin(), half.end(), 0.0);
    for (std::size_t i = 0; i < index.size(); ++i)
      half[index[i]] += 0.5 * task.amplitudes(s, static_cast<Eigen::Index>(i));
    const auto one = signal::inverse_real_fft(half, period);
    double* to = out.col(s).data();
    for (std::size_t n = 0; n < task.samples; n += period)
      std::copy_n(one.begin(), std::min(period, task.samples - n), to + n);
  }
}

std::string_view name_of(SeriesMethod method) {
  constexpr std::array<std::string_view, 5> names{"inverse FFT", "blocked phasors", "nonuniform FFT",
                                                  "decimated, interpolated", "plain sum"};
  return names[static_cast<std::size_t>(method)];
}

std::complex<double> elevation_transfer(const Component& wave, double x_m, double y_m) {
  return std::polar(1.0, -wave.k * (x_m * std::cos(wave.heading) + y_m * std::sin(wave.heading)));
}

std::vector<std::complex<double>> response_amplitudes(const Sea& sea, const Transfer& transfer) {
  std::vector<Complex> amplitudes;
  amplitudes.reserve(sea.components().size());
  for (const Component& wave : sea.components())
    amplitudes.push_back(std::polar(wave.amplitude, wave.phase) * transfer(wave));
  return amplitudes;
}

double sum_at(const Sea& sea, Phasors amplitudes, double t_s) {
  require_one_per_component(sea.components().size(), amplitudes.size());
  double sum = 0;
  for (std::size_t i = 0; i < amplitudes.size(); ++i)
    sum += (amplitudes[i] * phase::unit(phase::of(sea.components()[i].omega, t_s))).real();
  return sum;
}

Synthesis synthesise(const Sea& sea, const TimeGrid& grid, const Eigen::MatrixXcd& amplitudes,
                     std::optional<SeriesMethod> method) {
  return summed(frequencies(sea), &sea, grid, amplitudes, method);
}

Synthesis synthesise(std::span<const double> omega, const TimeGrid& grid, const Eigen::MatrixXcd& amplitudes,
                     std::optional<SeriesMethod> method) {
  return summed(omega, nullptr, grid, amplitudes, method);
}

std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, Phasors amplitudes) {
  const Eigen::MatrixXcd row =
      Eigen::Map<const Eigen::RowVectorXcd>(amplitudes.data(), static_cast<Eigen::Index>(amplitudes.size()));
  const Eigen::MatrixXd series = synthesise(sea, grid, row).series;
  return {series.data(), series.data() + series.size()};
}

std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, const Transfer& transfer) {
  return synthesise(sea, grid, response_amplitudes(sea, transfer));
}

}  // namespace hydro::waves
