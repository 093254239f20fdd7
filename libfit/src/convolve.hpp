#pragma once
/// \file  Weighted sums that slide along a record.
#include <span>
#include <vector>

namespace fit {

/// out_j = Σ_i weights_i values_{j+i}, shape (n − m + 1) for n values and m weights: only whole sums.
/// Directly for few weights, by Fourier transform for many (rounding then 1e-15 of the largest value times Σ|w|).
std::vector<double> sliding_sum(std::span<const double> values, std::span<const double> weights);

}  // namespace fit
