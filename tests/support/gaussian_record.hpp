#pragma once
/// \file  Gaussian records of a given spectrum, for tests of what spectra say about records.
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "hydro/base/random.hpp"
#include "hydro/signal/fft.hpp"
#include "hydro/signal/spectrum.hpp"

namespace froude_test {

/// `n` samples of a Gaussian signal with this density (of Hz, one-sided), cyclic, amplitudes and phases random.
inline std::vector<double> gaussian_record(const std::function<double(double)>& density, std::size_t n, double step_s,
                                           std::uint64_t stream) {
  const hydro::RandomStream random(67, stream);
  const double df = 1 / (static_cast<double>(n) * step_s);
  std::vector<std::complex<double>> half(n / 2 + 1);
  for (std::size_t k = 1; k < half.size(); ++k) {
    const double s = density(static_cast<double>(k) * df);
    if (s > 0) half[k] = std::sqrt(s * df) / 2 * std::complex(random.normal(2 * k), random.normal(2 * k + 1));
  }
  return hydro::signal::inverse_real_fft(half, n);
}

/// A spectrum as high as 1 between two frequencies, on `n` intervals.
inline hydro::signal::SpectrumPerHz box_spectrum(double from_hz, double to_hz, std::size_t n = 4000) {
  hydro::signal::SpectrumPerHz s;
  for (std::size_t k = 0; k <= n; ++k) {
    s.frequency_hz.push_back(from_hz + (to_hz - from_hz) * static_cast<double>(k) / static_cast<double>(n));
    s.density.push_back(1);
  }
  return s;
}

}  // namespace froude_test
