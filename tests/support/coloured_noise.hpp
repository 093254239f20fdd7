#pragma once
/// \file  Noise with a memory, for tests of spectra and intervals.
#include <cmath>
#include <vector>

#include "hydro/base/random.hpp"

namespace froude_test {

/// Stationary AR(1) noise e_t = φ e_{t−1} + w_t with standard deviation `sigma`; white for φ = 0.
inline std::vector<double> ar1_noise(std::size_t n, double phi, double sigma, std::uint64_t stream) {
  const hydro::RandomStream random(61, stream);
  std::vector<double> e(n);
  const double drive = sigma * std::sqrt(1 - phi * phi);
  for (std::size_t j = 0; j < n; ++j)
    e[j] = j == 0 ? sigma * random.normal(0) : phi * e[j - 1] + drive * random.normal(j);
  return e;
}

}  // namespace froude_test
