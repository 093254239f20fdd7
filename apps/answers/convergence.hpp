#pragma once
/// \file  What runs of one scene with longer and longer steps tell of the error of the first: (E1). Private to
///        apps.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "froude/result.hpp"

namespace froude {

/// A run and how many samples of the finest lie from one of its own to the next.
struct Beside {
  const Run* run;
  std::size_t stride;
};

/// True for a residual of energy: an error itself, it is not judged by its own error.
bool is_residual(const std::string& signal);

double rms(std::span<const double> values);
double deviation(std::span<const double> values);

/// Sizes of signals, one each, but none less than a thousandth of the largest of its unit: motions that symmetry
/// forbids are small, and matter to nobody. `unit`: the member of a signal that holds it.
template <class S>
std::vector<double> at_least_a_thousandth(std::vector<double> sizes, const std::vector<S>& signals,
                                          std::string S::*unit) {
  constexpr double share_of_largest = 1e-3;
  std::map<std::string, double> largest;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    double& of_unit = largest[signals[i].*unit];
    of_unit = std::max(of_unit, sizes[i]);
  }
  for (std::size_t i = 0; i < sizes.size(); ++i)
    sizes[i] = std::max(sizes[i], share_of_largest * largest[signals[i].*unit]);
  return sizes;
}

/// What the errors of signals are relative to: the signal's rms, but no less than a thousandth of the largest of its
/// unit, nor less than rounding leaves: 1e-9 in the SI unit, of what has N, J or W in it 1e-9 of `weight`, N, or 1e-9.
std::vector<double> scales(const Run& run, double weight);

/// rms of what two runs differ by in a signal up to a time, s, at the samples that they share.
double difference(const Beside& fine, const Beside& coarse, std::size_t signal,
                  double until = std::numeric_limits<double>::infinity());

/// The error of the first of runs with longer and longer steps.
struct Convergence {
  double error;
  double ratio;  ///< by which errors fall from one run to the next, as observed; 0 where it was not
  /// Errors fall by at least a half for a step halved.
  bool converges() const { return ratio >= 1.5; }
};
/// (E1): Richardson's extrapolation by the ratio observed, which is taken as no more than `largest`, that of the
/// method's order, and no less than √2. Without `coarsest` the ratio is taken to be 2.
/// [Roache 1994, J. Fluids Eng. 116, 405, eq. 2 and 10]
Convergence convergence(const Beside& fine, const Beside& coarse, const std::optional<Beside>& coarsest, double largest,
                        std::size_t signal, double until = std::numeric_limits<double>::infinity());

/// Until when the two runs tell the same of a signal: the start of the first of fifty blocks of time in which they
/// differ by more than `allowed`, rms; the end of the run where there is none.
double agrees_until(const Beside& fine, const Beside& coarse, std::size_t signal, double allowed);

/// (E2): by how much the distance between two runs that start as neighbours has grown in a signal: rms over the last
/// third of the run over rms of its first hundredth. `least` is the least distance that counts.
double growth(const Run& run, const Run& neighbour, std::size_t signal, double least);

/// Standard deviation of a signal from a time on.
double deviation(const Run& run, std::size_t signal, double from);

}  // namespace froude
