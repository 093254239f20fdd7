#pragma once
/// \file  Frequencies put where responses bend: (Q15), docs/theory/frequency.md. Private to apps.
#include <functional>
#include <vector>

#include "froude/result.hpp"

namespace froude {

/// Responses whose straight lines between neighbouring frequencies, of real and imaginary parts, are within an accuracy
/// of the signal's peak.
struct Refined {
  std::vector<double> omega;           ///< rad/s, increasing: those given, and what was put between them
  std::vector<ComplexSignal> signals;  ///< heading by heading
  std::vector<double> error;           ///< of each signal, of its peak: what straight lines leave, estimated
};

/// `at` answers at any frequencies, in `headings` headings; `omega`, two at least, is what it begins with. Peaks of
/// less than a thousandth of the largest of their unit count as that thousandth. \throws hydro::NumericsError where a
/// response is too sharp, as one without damping is
Refined refined(const std::vector<double>& omega, std::size_t headings, double accuracy,
                const std::function<std::vector<ComplexSignal>(const std::vector<double>&)>& at);

}  // namespace froude
