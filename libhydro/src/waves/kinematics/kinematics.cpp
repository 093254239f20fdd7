#include "hydro/waves/kinematics/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace hydro::waves {

Eigen::Vector3cd velocity_transfer(const Component& wave, const Water& water, const Eigen::Vector3d& point) {
  const double h = water.depth.metres();
  require(point.z() >= -h, "a point at z = {} m lies below the bed at z = {} m", point.z(), -h);
  const double z = std::min(point.z(), 0.0);  // (W13)
  // cosh k(z+h)/sinh kh and sinh k(z+h)/sinh kh with the growing exponentials divided out, (W12).
  const double decay = std::exp(wave.k * z);
  const double mirrored = std::expm1(-2 * wave.k * (z + h));  // −1 in infinitely deep water
  const double denominator = std::expm1(-2 * wave.k * h);
  const double along = -decay * (2 + mirrored) / denominator;
  const double up = decay * mirrored / denominator;
  const std::complex<double> unit = elevation_transfer(wave, point.x(), point.y()) * wave.sigma;
  constexpr std::complex<double> i(0, 1);
  return {unit * along * std::cos(wave.heading), unit * along * std::sin(wave.heading), i * unit * up};
}

}  // namespace hydro::waves
