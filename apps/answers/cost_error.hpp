#pragma once
/// \file  How far one answer is from another, signal by signal. Private to apps.
#include <set>
#include <span>
#include <string>
#include <vector>

#include "froude/cost.hpp"
#include "froude/result.hpp"

namespace froude {

/// The size of a signal by a measure; its peak is the largest amplitude.
double size_of(ErrorMeasure measure, std::span<const double> values);

/// Rms of the difference of each signal over its scale: the reference's own rms, but no less than a thousandth of the
/// largest of its unit. Residuals of energy, which are errors themselves, and what has no size have none: 0.
std::vector<double> rms_errors(const std::vector<Signal>& answer, const std::vector<Signal>& reference);

/// Of the signals that are worst, by each measure: those of a run, or the peak alone of responses' amplitudes, over
/// scales as above. By rms those that `unpredictable` names count with the error of their deviation. Signals are those
/// of the reference, in its order.
CostErrors errors_of(const std::vector<Signal>& answer, const std::vector<Signal>& reference, bool responses,
                     const std::set<std::string>& unpredictable = {});

}  // namespace froude
