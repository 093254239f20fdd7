#pragma once
/// \file  The steady part of a record that begins and ends otherwise, and the mean of it with its uncertainty;
///        (F90)-(F92), docs/theory/fit.md.
#include <cstddef>
#include <optional>
#include <span>

namespace fit {

/// Samples [from, to) of a record.
struct Stretch {
  std::size_t from, to;
  std::size_t size() const { return to - from; }
};

/// One tow among what a carriage did.
struct Tow {
  Stretch motion;      ///< the carriage moves: from above a tenth of the largest speed until below it again
  Stretch even_speed;  ///< therein the longest stretch at one speed
  double speed;        ///< the median there, unit of the values
  bool moves_again;    ///< the record has another such motion after it, which is not looked at
};
/// The first motion in which the speed comes above half of the largest of the record, so that a slower way back, or one
/// told as negative, is none, and in it the longest stretch in which means over a 500th of the record stay within
/// `tolerance` (relative) of their median; (F90). \throws hydro::InputError for fewer than 64 samples, a value that is
/// not finite, no positive speed, a tolerance not between 0 and 1, or no stretch of 64 samples at one speed
Tow find_tow(std::span<const double> speed, double tolerance);

/// From which sample on a record that settles has settled: there the mean of what follows is known best, with less of
/// it scatter makes the mean worse, with more of it the way there does (marginal standard error rule); (F91). It is
/// sought in the first half in steps of a 200th. Empty: the best is the end of that half, so the record does not settle
/// in time to say so. \throws hydro::InputError for fewer than 16 samples or a value that is not finite
std::optional<std::size_t> settled_from(std::span<const double> values);

/// The mean of a steady record.
struct SteadyMean {
  double value;
  double deviation;          ///< of single samples about it
  double error;              ///< standard error of the mean, the memory of the samples counted (F3), (F4)
  double effective_samples;  ///< independent ones that would tell as much
  double dof;                ///< of Student's t with `error`
  double drift;              ///< what a straight line through it changes by, from its beginning to its end
  double drift_error;        ///< standard error of that
  double coefficient_of_variation() const;  ///< deviation over the size of the mean
};
/// (F92). \throws hydro::InputError for fewer than 64 samples or a value that is not finite
SteadyMean steady_mean(std::span<const double> values);

}  // namespace fit
