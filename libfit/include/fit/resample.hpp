#pragma once
/// \file  A record at another sampling rate, without delay and with the band that it keeps; (F48), docs/theory/fit.md.
#include <cstddef>
#include <span>
#include <vector>

namespace fit {

/// Brings an even record from one step to another by a sinc under a Kaiser window of 60 dB, read at the new instants.
///
/// With f the lower of both sampling rates the gain is within 2e-3 of 1 up to 0.3 f and within 2e-3 of 0 from 0.5 f on:
/// what a coarser record could not hold does not come back as something else. Nothing is extrapolated: settling()
/// samples of the input are given up at each end. Cost: about 18 products a sample of the finer of both records.
class Resampler {
 public:
  /// \throws hydro::InputError unless both steps are positive
  Resampler(double step_s, double new_step_s);

  double bandwidth_hz() const { return 0.3 * slower_hz_; }  ///< to there the gain is within 2e-3 of 1
  double closed_hz() const { return 0.5 * slower_hz_; }     ///< from there it is within 2e-3 of 0
  std::size_t settling() const { return half_width_; }
  /// Output over input for e^{iωt}, where a new instant falls on an old one; between them it differs by less than 2e-3.
  double gain(double omega) const;
  /// Values at t_0 + settling()·step_s + k·new_step_s while there are neighbours enough.
  /// \throws hydro::InputError where fewer than two would be left
  std::vector<double> apply(std::span<const double> values) const;

 private:
  std::vector<double> weights(double fraction) const;  // of the samples −half_width + 1 … half_width about an instant
  double step_, ratio_, slower_hz_, reach_;
  std::size_t half_width_;
};

}  // namespace fit
