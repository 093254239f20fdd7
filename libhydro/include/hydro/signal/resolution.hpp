#pragma once
/// \file  What the resolution of segments does to transfer functions; (F118), docs/theory/fit.md.
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "hydro/signal/welch.hpp"

namespace hydro::signal {

/// By how much H₁ of an estimate would move, to first order, if its segments were endlessly long: a third of what half
/// the segment moves it by, smoothed over five frequencies. Records and step are those of the estimate, `options` too.
/// Empty: half of the segment is too short, below eight samples. \throws InputError as transfer()
std::vector<std::complex<double>> resolution_shift(const TransferEstimate& estimate, std::span<const InputOutput> runs,
                                                   double step_s, const WelchOptions& options);

/// The same of |H₁|, along frequency.
std::vector<double> resolution_shift_of_gain(const TransferEstimate& estimate, std::span<const InputOutput> runs,
                                             double step_s, const WelchOptions& options);

/// Where shifts exceed a fifth of the half-widths of the intervals of |H₁|, how many and the worst: "the gain of heave
/// is moved by …". Empty where none does. NaN half-widths are of gains that nobody tells.
std::string caution_of_resolution(const std::string& name, const TransferEstimate& estimate,
                                  const std::vector<double>& shift, const std::vector<double>& half_width);

}  // namespace hydro::signal
