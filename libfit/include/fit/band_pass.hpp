#pragma once
/// \file  A band-pass without delay; (F108), docs/theory/fit.md.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fit/filter.hpp"

namespace fit {

/// Where half of the amplitude passes, Hz.
struct BandEdges {
  double low_hz, high_hz;
};
/// From 0.2 to 4 times the frequency of waves: slow drift is below, the third harmonic inside.
BandEdges band_about_waves(double hz);

/// One Butterworth low pass of order 4 (F17) less another: no delay, and a gain of G_high − G_low at each frequency.
///
/// Half of the amplitude passes at each edge where the other edge is far away. Means and straight lines do not pass.
/// Nothing is extrapolated: samples whose value would lean on what lies beyond the record are given up.
class BandPass {
 public:
  /// Hz and s. Without an upper edge all passes that is faster than the lower one.
  /// \throws hydro::InputError unless 0 < low < high < 1/(2Δt)
  BandPass(double low_hz, std::optional<double> high_hz, double step_s);

  /// Output over input for e^{iωt}: real, 0 at ω = 0.
  double gain(double omega) const;
  /// From where to where the gain is within 1 % of 1, Hz; empty where the edges are too close for that.
  std::optional<std::pair<double, double>> flat_hz() const;
  /// Samples given up at each end: there less than 1e-4 of the filter's memory is left.
  std::size_t settling() const;
  /// "band-pass from 0.025 Hz to 0.5 Hz".
  std::string name() const;
  /// Shape (n − 2 settling()), the first sample belonging to sample settling() of the input.
  /// \throws hydro::InputError if nothing would be left
  std::vector<double> apply(std::span<const double> values) const;

 private:
  double low_hz_, step_;
  std::optional<double> high_hz_;
  ZeroPhaseFilter slow_;
  std::optional<ZeroPhaseFilter> fast_;
};

}  // namespace fit
