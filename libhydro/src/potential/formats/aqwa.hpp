#pragma once
/// \file  Private: what the two AQWA readers share.
#include <complex>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// A load that AQWA writes as modulus and lag in degrees behind the wave at the structure's centre of gravity, in our
/// convention (P22).
std::complex<double> aqwa_load(double modulus, double lag_deg, double omega, double heading,
                               const Eigen::Vector3d& centre_of_gravity, const Water& water);

}  // namespace hydro::potential
