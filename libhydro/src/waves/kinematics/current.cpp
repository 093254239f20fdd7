#include "hydro/waves/kinematics/current.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/field.hpp"
#include "waves/gauss_legendre.hpp"

namespace hydro::waves {

Current Current::uniform(const Eigen::Vector2d& velocity) {
  require(velocity.allFinite(), "the velocity of a current must be finite, got ({}, {}) m/s", velocity.x(),
          velocity.y());
  return Current({0.0}, {velocity});
}

Current Current::profile(std::vector<double> z, std::vector<Eigen::Vector2d> velocity) {
  require(z.size() == velocity.size() && z.size() >= 2,
          "a current profile needs at least two heights with a velocity each, got {} heights and {} velocities",
          z.size(), velocity.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    require(std::isfinite(z[i]) && velocity[i].allFinite(), "row {} of the current profile is not finite", i + 1);
    require(z[i] <= 0, "a current profile ends at the still water, but has a height of {} m", z[i]);
    require(i == 0 || z[i] > z[i - 1], "heights of a current profile must increase, but {} m is followed by {} m",
            i ? z[i - 1] : 0.0, z[i]);
  }
  return {std::move(z), std::move(velocity)};
}

namespace {

// The stretch [i, i + 1] of increasing `z` that holds `at`; the caller has ruled out the ends.
std::size_t stretch(const std::vector<double>& z, double at) {
  return static_cast<std::size_t>(std::upper_bound(z.begin(), z.end(), at) - z.begin()) - 1;
}

}  // namespace

Eigen::Vector2d Current::at(double z) const {
  if (is_none()) return Eigen::Vector2d::Zero();
  if (is_uniform() || z <= z_.front()) return velocity_.front();
  if (z >= z_.back()) return velocity_.back();
  const std::size_t i = stretch(z_, z);
  const double share = (z - z_[i]) / (z_[i + 1] - z_[i]);
  return (1 - share) * velocity_[i] + share * velocity_[i + 1];
}

Eigen::Vector2d Current::gradient(double z) const {
  if (is_none() || is_uniform() || z <= z_.front() || z >= z_.back()) return Eigen::Vector2d::Zero();
  const std::size_t i = stretch(z_, z);
  return (velocity_[i + 1] - velocity_[i]) / (z_[i + 1] - z_[i]);
}

double Current::felt_by(double k, Angle heading, double depth_m) const {
  if (is_none()) return 0;
  const Eigen::Vector2d along(std::cos(heading.radians()), std::sin(heading.radians()));
  if (is_uniform()) return velocity_.front().dot(along);
  // (W21) by parts: the weight 2k cosh 2k(z+h)/sinh 2kh integrates to sinh 2k(z+h)/sinh 2kh, which is one at z = 0, so
  // Ũ = U(0) − ∫ U′ sinh 2k(z+h)/sinh 2kh dz, with U′ constant on each stretch.
  const double at_surface = depth_profile(2 * k, depth_m, 0).sinh;
  double sum = velocity_.back().dot(along);
  for (std::size_t i = 0; i + 1 < z_.size(); ++i) {
    const double bottom = std::max(z_[i], -depth_m), top = std::max(z_[i + 1], -depth_m);
    if (!(bottom < top)) continue;
    const double shear = (velocity_[i + 1] - velocity_[i]).dot(along) / (z_[i + 1] - z_[i]);
    const double difference = depth_profile(2 * k, depth_m, top).cosh - depth_profile(2 * k, depth_m, bottom).cosh;
    sum -= shear * difference / (2 * k * at_surface);
  }
  return sum;
}

namespace {

// ω at a fixed point of the wave with this wavenumber, (W20).
double apparent_frequency(double k, Angle heading, const Current& current, const Water& water) {
  return angular_frequency(k, water) + k * current.felt_by(k, heading, water.depth.metres());
}

}  // namespace

DopplerWave doppler(double omega, Angle heading, const Current& current, const Water& water) {
  const double k_still = wavenumber(omega, water);
  if (current.is_none()) return {k_still, omega};
  // From long waves, whose frequency is below any ω > 0, upwards until ω is passed: the first crossing is the wave
  // whose energy still travels its own way. Steps of 2 % cannot jump over the maximum without showing a fall.
  constexpr double stride = 1.02;
  double below = 1e-3 * k_still, above = below;
  double last = apparent_frequency(above, heading, current, water);
  require(last < omega, "a following current of {} m/s leaves no wave of {} rad/s",
          current.felt_by(above, heading, water.depth.metres()), omega);
  while (last < omega) {
    below = above;
    above *= stride;
    const double next = apparent_frequency(above, heading, current, water);
    if (next <= last)
      throw InputError(
          fmt::format(
              "a current of {:.4g} m/s against them stops waves of {:.4g} s: the longest that can run up it have a "
              "period of {:.4g} s",
              current.felt_by(below, heading, water.depth.metres()), 2 * std::numbers::pi / omega,
              2 * std::numbers::pi / last),
          {}, "use a weaker current, or longer waves");
    last = next;
  }
  for (int i = 0; i < 200 && above - below > 4 * std::numeric_limits<double>::epsilon() * above; ++i) {
    const double middle = 0.5 * (below + above);
    (apparent_frequency(middle, heading, current, water) < omega ? below : above) = middle;
  }
  const double k = 0.5 * (below + above);
  return {k, angular_frequency(k, water)};
}

}  // namespace hydro::waves
