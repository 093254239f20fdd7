#pragma once
/// \file  Amplitudes of signals at many frequencies and headings at once.
#include <Eigen/Core>

#include <complex>
#include <vector>

#include "dynamics/frequency/amplitudes.hpp"
#include "dynamics/state/signal.hpp"

namespace dynamics::frequency {

/// Motions and multipliers of all cells (frequency, heading) in the order that sums over cells run through: a signal
/// costs one pass over the few motions that it varies with.
class SignalAmplitudes {
 public:
  /// `found` at these frequencies, rad/s, and headings, rad.
  SignalAmplitudes(const Amplitudes& found, std::vector<double> omega, std::vector<double> headings);

  /// What dynamics::amplitude() tells of each cell, heading by heading, to the same bits. (Q7)
  std::vector<std::complex<double>> of(const Variation& variation) const;

 private:
  void add_radiation(const Variation::Radiated& part, std::vector<std::complex<double>>& out) const;
  void add_motion(const Variation::Part& part, int mode, std::vector<std::complex<double>>& out) const;

  std::vector<double> omega_, headings_;
  Eigen::MatrixXcd xi_, lambda_;  // (cells, 6N) and (cells, m), cells heading by heading
};

}  // namespace dynamics::frequency
