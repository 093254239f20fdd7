#pragma once
/// \file  The imaginary unit, named so that no counter hides it. Not installed.
#include <complex>

namespace hydro::waves {

inline constexpr std::complex<double> imaginary(0, 1);

}  // namespace hydro::waves
