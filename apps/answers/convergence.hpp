#pragma once
/// \file  What runs of one scene with longer and longer steps tell of the error of the first: (E1). Private to
///        apps.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
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

/// A thousandth of the largest of its unit for each signal, of which `sizes` has one each: motions that symmetry
/// forbids are small, and matter to nobody. `unit`: the member of a signal that holds it.
template <class S>
std::vector<double> thousandth_of_largest(const std::vector<double>& sizes, const std::vector<S>& signals,
                                          std::string S::*unit) {
  constexpr double share = 1e-3;
  std::map<std::string, double> largest;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    double& of_unit = largest[signals[i].*unit];
    of_unit = std::max(of_unit, sizes[i]);
  }
  std::vector<double> out;
  for (const S& signal : signals) out.push_back(share * largest[signal.*unit]);
  return out;
}
/// Sizes of signals, one each, but none less than that.
template <class S>
std::vector<double> at_least_a_thousandth(std::vector<double> sizes, const std::vector<S>& signals,
                                          std::string S::*unit) {
  const std::vector<double> least = thousandth_of_largest(sizes, signals, unit);
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::max(sizes[i], least[i]);
  return sizes;
}

/// What errors of a signal are relative to: its rms; those of its statistics its standard deviation, and whichever of
/// its lowest and highest value is farther from 0.
struct Sizes {
  double rms, deviation, extreme;
};
/// Of each signal. None is less than a thousandth of the largest rms of its unit, of energies of the kinetic one, nor
/// than rounding leaves: 1e-9 in the
/// SI unit, of what has N, J or W in it 1e-9 of `weight`, N, or 1e-9.
std::vector<Sizes> sizes_of(const Run& run, double weight);

/// What two runs differ by in a signal, over its sizes.
struct Difference {
  double rms = 0;         ///< of the difference at each sample
  double statistics = 0;  ///< of their standard deviations, their lowest or their highest values, whichever is largest

  double most() const { return std::max(rms, statistics); }
};
/// Up to a time, s, at the samples that both share, and share with a run of this stride.
Difference difference(const Beside& fine, const Beside& coarse, std::size_t signal, const Sizes& sizes,
                      double until = std::numeric_limits<double>::infinity(), std::size_t stride = 1);

/// The error of the first of runs with longer and longer steps, over the sizes of the signal.
struct Convergence {
  double error;
  double ratio;  ///< by which rms of errors falls from one run to the next, as observed; 0 where it was not
  /// Errors fall by at least a half for a step halved.
  bool converges() const { return ratio >= 1.5; }
};
/// (E1): Richardson's extrapolation by the ratio observed, which is taken as no more than `largest`, that of the
/// method's order, and no less than √2; times a safety of 1.25, and as if no difference fell by more than the method's
/// order. Without `coarsest` the ratio is taken to be 2. Statistics of two runs may agree
/// by chance: theirs is the larger of the differences from run to run, as far as both errors fall alike.
/// [Roache 1994, J. Fluids Eng. 116, 405, eq. 2 and 10]
Convergence convergence(const Beside& fine, const Beside& coarse, const std::optional<Beside>& coarsest, double largest,
                        std::size_t signal, const Sizes& sizes, double until = std::numeric_limits<double>::infinity());

/// Until when the two runs tell the same of a signal: the start of the first of fifty blocks of time in which they
/// differ by more than `allowed`, rms, in the signal's unit; the end of the run where there is none.
double agrees_until(const Beside& fine, const Beside& coarse, std::size_t signal, double allowed);

/// (E2): by how much the distance between two runs that start as neighbours has grown in a signal: rms over the last
/// third of the run over rms of its first hundredth. `least` is the least distance that counts.
double growth(const Run& run, const Run& neighbour, std::size_t signal, double least);

/// Standard deviation of a signal from a time on.
double deviation(const Run& run, std::size_t signal, double from);

}  // namespace froude
