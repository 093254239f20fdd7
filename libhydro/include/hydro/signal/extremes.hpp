#pragma once
/// \file  Peaks and largest values of stationary Gaussian signals, from the moments of their spectrum; (S12)-(S14),
/// (S19), docs/theory/signal.md.
#include <span>

#include "hydro/signal/spectrum.hpp"

namespace hydro::signal {

/// How the peaks of a signal are distributed.
enum class PeakLaw {
  rayleigh,  ///< one peak between two up-crossings of the mean: a narrow band
  rice       ///< every local maximum, of any bandwidth (Rice 1944; Cartwright & Longuet-Higgins 1956)
};

/// The local maxima of a Gaussian signal, above its mean, in the unit of the signal; independent of each other where
/// the largest of several is asked for, which makes that too high where they come in groups (S14).
class GaussianPeaks {
 public:
  /// \throws InputError unless m₀ and m₂ are finite and > 0, under Rice's law m₄ too
  GaussianPeaks(const Moments& moments, PeakLaw law);

  /// Of peaks: √(m₂/m₀), or √(m₄/m₂) under Rice's law.
  double rate_hz() const noexcept { return rate_hz_; }
  double deviation() const noexcept { return deviation_; }  ///< √m₀
  /// Share of the peaks that are above a level, 0 … 1; absolute error 1e-15.
  double share_above(double level) const;
  /// The level with this share of the peaks above it, 0 < share < 1; to 1e-12 of the standard deviation. \throws
  /// InputError
  double level_exceeded_by(double share) const;

  /// That the largest peak of a duration stays below with this probability, 0 < p < 1. \throws InputError, also for a
  /// duration of less than one peak; so do the next two
  double largest_not_exceeded(double duration_s, double probability) const;
  /// Mean of the largest peak of a duration; to 1e-9 of the standard deviation.
  double expected_largest(double duration_s) const;
  /// √(2 ln N⁺) standard deviations, N⁺ the up-crossings of the mean in the duration: where the density of the largest
  /// is highest, for many peaks.
  double most_probable_largest(double duration_s) const;

 private:
  double peaks_in(double duration_s) const;
  double deviation_, epsilon_, rate_hz_, crossing_rate_hz_;
};

/// A stationary part of a life, such as one sea of a scatter diagram.
struct StationaryPart {
  double share;  ///< of the time, 0 … 1
  GaussianPeaks peaks;
};

/// Peaks above a level in a duration over all parts, expected (S19).
double expected_peaks_above(std::span<const StationaryPart> life, double level, double duration_s);

/// The level that the largest peak of the duration stays below with this probability, peaks coming as in a Poisson
/// process; to 1e-12 of the largest standard deviation. \throws InputError without parts, for a share that is negative
/// or not finite, for all of them 0, unless 0 < p < 1, and where fewer peaks come than −ln p
double largest_of_life(std::span<const StationaryPart> life, double duration_s, double probability);

}  // namespace hydro::signal
