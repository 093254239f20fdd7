#pragma once
/// \file  The largest values that a record lets one expect: peaks over a threshold, and maxima of blocks. No law of the
/// signal is supposed, as GaussianPeaks does; (S22), (S23), docs/theory/signal.md.
#include <cstdint>
#include <span>
#include <vector>

namespace hydro::signal {

/// The largest value between each two up-crossings of the mean, in time order. \throws InputError as single_waves()
std::vector<double> crests(std::span<const double> time_s, std::span<const double> values);

/// Peaks above a threshold: they come `rate_hz` times a second, and P(peak − threshold > y) = (1 + ξ y/σ)^{−1/ξ}, for
/// ξ = 0 e^{−y/σ} (generalised Pareto).
struct ParetoTail {
  double threshold, scale, shape;  ///< scale σ > 0 in the unit of the signal; shape ξ: above 0 heavy, below 0 bounded
  double rate_hz;

  double share_above(double level) const;  ///< of the peaks above the threshold
  /// What the largest peak of a duration stays below with this probability, peaks as in a Poisson process: −∞ if with
  /// so much of it none comes above the threshold.
  double largest_not_exceeded(double duration_s, double probability) const;
};

/// By probability-weighted moments of the exceedances (Hosking & Wallis 1987). \throws InputError for fewer than 10
/// peaks above the threshold, or such that are all alike
ParetoTail fit_tail(std::span<const double> peaks, double threshold, double duration_s);

/// The largest value of a block stays below x with the probability exp(−e^{−(x − location)/scale}) (Gumbel).
struct BlockMaxima {
  double location, scale;
  double block_s;

  /// Of blocks that are independent; the duration need not be a whole number of them.
  double largest_not_exceeded(double duration_s, double probability) const;
};

/// The largest value of each whole block of the record; what is left over at the end takes no part. Where samples are
/// missing for more than half of a block, it is left out. \throws InputError as trend_of(), for a block that is not > 0
std::vector<double> block_maxima(std::span<const double> time_s, std::span<const double> values, double block_s);

/// By L-moments: scale λ₂/ln 2, location λ₁ − γ scale. \throws InputError for fewer than 5 maxima, or such that are all
/// alike
BlockMaxima fit_maxima(std::span<const double> maxima, double block_s);

/// Between which the estimate lies in this share of records that follow the fit, about the fit: parametric bootstrap of
/// 1000 draws. What the law leaves out is not in it. Every draw depends on the seed alone.
struct Interval {
  double low, high;
};
Interval interval_of(const ParetoTail& tail, std::size_t peaks, double duration_s, double probability,
                     double confidence, std::uint64_t seed = 1);
Interval interval_of(const BlockMaxima& fit, std::size_t blocks, double duration_s, double probability,
                     double confidence, std::uint64_t seed = 1);

}  // namespace hydro::signal
