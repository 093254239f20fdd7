#pragma once
/// \file  Cylinders and made records of forces that tests, cases and price lists of fits share.
#include <cmath>
#include <numbers>

#include "fit/morison.hpp"
#include "support/coloured_noise.hpp"

namespace froude_test {

/// The body of Hendriksen (2023), moved in still water.
inline const fit::Cylinder moved_cylinder{.diameter = 0.12,
                                          .length = 0.5,
                                          .density = 997,
                                          .viscosity = {},
                                          .experiment = fit::Experiment::body_moves,
                                          .mass_beyond_load_cells = 5.9};
/// The same held in moving water.
inline const fit::Cylinder held_cylinder{
    .diameter = 0.12, .length = 0.5, .density = 997, .viscosity = {}, .experiment = fit::Experiment::water_moves};

/// Water that swings by 0.4 m with a period of 4 s about the held cylinder, C_D = 1.2, C_M = 1.8, with AR(1) noise of 3
/// N.
inline fit::ForceRecord swinging_water(std::size_t samples, double step, double phi, std::uint64_t stream) {
  fit::ForceRecord r;
  const double omega = 2 * std::numbers::pi / 4;
  const auto noise = ar1_noise(samples, phi, 3, stream);
  for (std::size_t j = 0; j < samples; ++j) {
    const double t = step * static_cast<double>(j);
    r.time.push_back(t);
    r.velocity.push_back(0.4 * omega * std::cos(omega * t));
    r.acceleration.push_back(-0.4 * omega * omega * std::sin(omega * t));
    r.force.push_back(fit::morison_force(held_cylinder, 1.2, 1.8, r.velocity[j], r.acceleration[j]) + noise[j]);
  }
  return r;
}

}  // namespace froude_test
