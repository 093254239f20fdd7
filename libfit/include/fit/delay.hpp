#pragma once
/// \file  Channels that come too late; (F24), docs/theory/fit.md.
#include <cstddef>
#include <span>
#include <vector>

namespace fit {

/// The record as it would be had it come `lag` samples earlier: out_j = values(j + margin + lag), by the cubic through
/// the two samples on each side; error below 0.023 (ωΔt)⁴ of a sinusoid. Shape (n − 2 margin).
/// \throws hydro::InputError unless margin >= |lag| + 2 and samples are left
std::vector<double> later(std::span<const double> values, double lag, std::size_t margin);

}  // namespace fit
