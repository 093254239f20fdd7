#pragma once
/// \file  The wind sea of Donelan, Hamilton and Hui, whose tail falls as ω^−4. (W100)
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/waves/spectra/spectrum.hpp"

namespace hydro::waves {

/// Young and growing seas under a wind that blows at U, 10 m above them, with waves of phase speed c_p at the peak: the
/// height follows. Donelan, Hamilton & Hui 1985, Phil. Trans. R. Soc. A 315, from waves on Lake Ontario and in a tank.
/// m_n exists for n < 3. \throws InputError unless U/c_p is 0.83 … 5, as measured
inline PeakedSpectrum donelan(double wind, double tp_s, double gravity = 9.81) {
  require(std::isfinite(tp_s) && tp_s > 0 && std::isfinite(wind), "peak period {} s and wind {} m/s must be positive",
          tp_s, wind);
  const double omega_p = 2 * std::numbers::pi / tp_s, age = wind * omega_p / gravity;  // c_p of deep water
  require(age >= 0.83 && age <= 5,
          "the wind of {} m/s blows {:.3g} times as fast as waves of {} s go; 0.83 to 5 times was measured", wind, age,
          tp_s);
  const double gamma = 1.7 + (age > 1 ? 6 * std::log10(age) : 0), sigma = 0.08 * (1 + 4 / (age * age * age)),
               alpha = 0.006 * std::pow(age, 0.55);
  const PeakShape shape{.p = 4, .q = 4, .gamma = gamma, .sigma_below = sigma, .sigma_above = sigma};
  const PeakedSpectrum unit(4, tp_s, shape);  // m_0 = 1 m²
  const double at_peak = alpha * gravity * gravity * std::pow(omega_p, -5) * gamma / std::numbers::e;
  return {4 * std::sqrt(at_peak / unit.density(omega_p)), tp_s, shape};
}

}  // namespace hydro::waves
