#include "hydro/waves/sea.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/random.hpp"
#include "hydro/waves/dispersion.hpp"

namespace hydro::waves {
namespace {

struct IndexRange {
  std::size_t first, last;
};

// The multiples j ≥ 1 of Δω inside the band. A band edge that is a multiple but for rounding counts as inside.
IndexRange multiples_in_band(const Discretisation& grid, double d_omega) {
  require(std::isfinite(grid.omega_max) && grid.omega_min >= 0 && grid.omega_min < grid.omega_max,
          "a frequency band needs 0 <= omega_min < omega_max, got {} and {} rad/s", grid.omega_min, grid.omega_max);
  constexpr double rounding = 1e-9;
  const double first = std::max(1.0, std::ceil(grid.omega_min / d_omega - rounding));
  const double last = std::floor(grid.omega_max / d_omega + rounding);
  if (first > last)
    throw InputError(
        fmt::format("no multiple of {} rad/s (2π over the repetition period of {} s) lies between {} and {} rad/s",
                    d_omega, grid.repetition_s, grid.omega_min, grid.omega_max),
        {}, "give a longer repetition period or a wider band");
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

}  // namespace

Sea Sea::regular(WaveAmplitude amplitude, AngularFrequency omega, Angle heading, const Water& water, double phase_rad) {
  Sea sea(water, omega.period_s());
  sea.components_ = {{.omega = omega.rad_per_s(),
                      .k = wavenumber(omega.rad_per_s(), water),
                      .amplitude = amplitude.metres(),
                      .phase = phase_rad,
                      .heading = heading.radians()}};
  sea.index_ = {1};
  return sea;
}

Sea Sea::irregular(const Spectrum& spectrum, const Discretisation& grid, Angle heading, const Water& water) {
  require(std::isfinite(grid.repetition_s) && grid.repetition_s > 0,
          "the repetition period must be finite and positive, got {} s", grid.repetition_s);
  const double d_omega = 2 * std::numbers::pi / grid.repetition_s;
  const IndexRange range = multiples_in_band(grid, d_omega);
  const RandomStream phases(grid.seed, phase_stream);
  Sea sea(water, grid.repetition_s);
  double carried = 0;
  for (std::size_t j = range.first; j <= range.last; ++j) {
    const double centre = static_cast<double>(j);
    const double energy = spectrum.energy((centre - 0.5) * d_omega, (centre + 0.5) * d_omega);  // (W9)
    carried += energy;
    sea.index_.push_back(j);
    sea.components_.push_back({.omega = centre * d_omega,
                               .k = wavenumber(centre * d_omega, water),
                               .amplitude = std::sqrt(2 * energy),
                               .phase = 2 * std::numbers::pi * phases.uniform(j),
                               .heading = heading.radians()});
  }
  sea.fraction_left_out_ = 1 - carried / spectrum.moment(0);
  return sea;
}

double Sea::elevation(double t_s, double x_m, double y_m) const {
  double sum = 0;
  for (const Component& w : components_)
    sum +=
        w.amplitude * std::cos(w.omega * t_s - w.k * (x_m * std::cos(w.heading) + y_m * std::sin(w.heading)) + w.phase);
  return sum;
}

}  // namespace hydro::waves
