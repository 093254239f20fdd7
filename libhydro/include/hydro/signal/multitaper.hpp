#pragma once
/// \file  Spectra of short records by several orthogonal tapers over all of it, beside Welch's segments; (S20),
/// docs/theory/signal.md.
#include <cstddef>
#include <span>

#include "hydro/signal/welch.hpp"

namespace hydro::signal {

/// One-sided variance density of an evenly sampled record by K sine tapers (Riedel & Sidorenko 1995), each over the
/// whole record, whose mean is taken off. Frequencies 0, 1/(NΔt) …; `dof` is 2K, `segments` is K, and the resolution is
/// the band that the tapers fill, (K + 1)/((N + 1)Δt). ∫ S df by trapezium is the mean of the tapered variances: of a
/// stationary record the variance, in expectation. Uses an even number of samples: of an odd one the last is left out.
/// \throws InputError: fewer than 8 samples, no taper or more than a quarter of the samples, a value that is not
/// finite, a step that is not positive
WelchSpectrum multitaper(std::span<const double> values, double step_s, std::size_t tapers);

}  // namespace hydro::signal
