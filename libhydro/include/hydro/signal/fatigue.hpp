#pragma once
/// \file  Fatigue: cycles of a record by rainflow counting, S–N curves, Miner's sum, and the damage that a Gaussian
/// signal does according to its spectrum; (S15)-(S18), docs/theory/signal.md.
#include <optional>
#include <span>
#include <vector>

#include "hydro/signal/spectrum.hpp"

namespace hydro::signal {

/// A range from trough to crest, in the unit of the signal, that comes once or half a time.
struct Cycle {
  double range;
  double mean;   ///< of trough and crest
  double count;  ///< 1 or ½
};

/// Rainflow cycles of a record in the order in which they close, halves that are left at the end: ASTM E1049-85, 5.4.4.
/// First and last value count as turning points; equal neighbours as one. Cost O(n).
/// \throws InputError for a value that is not finite; a record that never changes has no cycles
std::vector<Cycle> rainflow(std::span<const double> values);

/// Cycles to failure over their range, N(S) = N_k (S/S_k)^{−m}, with one slope or two that meet at the knee (S_k, N_k).
struct SnCurve {
  double knee_range;                       ///< S_k, unit of the signal
  double knee_cycles;                      ///< N_k
  double slope;                            ///< m of ranges above the knee, and of all where there is no other
  std::optional<double> slope_below = {};  ///< m of ranges below the knee

  /// \throws InputError unless every member is finite and > 0
  void check() const;
  double cycles_to_failure(double range) const;  ///< +∞ for a range of 0
};

/// Miner's sum of count/N(S); 1 is failure. Mean stresses do not count. \throws InputError as SnCurve::check()
double damage(std::span<const Cycle> cycles, const SnCurve& curve);

/// Damage a second of a narrow-banded Gaussian signal: ranges are twice Rayleigh-distributed amplitudes, one each
/// up-crossing of the mean (S17). In broad bands it is on the safe side. \throws InputError as SnCurve::check() and
/// GaussianPeaks
double narrow_band_damage_rate(const Moments& moments, const SnCurve& curve);

/// Damage a second of a Gaussian signal with Dirlik's density of rainflow ranges (S18), an empirical one, made from
/// simulated signals of many spectra. Empty where its weights are no density, which happens for a few spectra of two
/// far peaks. Against rainflow counts of simulated records it is 0 to 4 % low for spectra of one hump, 7 to 12 %
/// between two peaks (tests). \throws InputError as above
std::optional<double> dirlik_damage_rate(const Moments& moments, const SnCurve& curve);

}  // namespace hydro::signal
