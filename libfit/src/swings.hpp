#pragma once
/// \file  Swings of a decay that stand out of its noise; (F34), docs/theory/fit.md. Private to libfit.
#include <span>
#include <vector>

#include "fit/decay.hpp"

namespace fit {

/// The extremes of a record with noise: of what a moving polynomial leaves of it (F5), and only those beyond five
/// deviations of the noise that this leaves, on either side of the rest position. Where such a polynomial would take
/// more than 1e-3 off the swings, as it would of few samples in each, the record is taken as it is.
/// \throws hydro::InputError as find_extremes()
std::vector<Extreme> find_swings(std::span<const double> time, std::span<const double> values);

}  // namespace fit
