#pragma once
/// \file  The curve behind a record in steps: a potentiometer stays at a level and jumps to the next. (F111)
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace fit {

/// A natural cubic spline through what is known of the signal, at the samples.
struct LevelCurve {
  std::vector<double> values;  ///< one a sample, of the unit of the record
  double step;                 ///< between two levels
  std::size_t flat_parts;      ///< runs of samples on one level
  std::size_t knots;           ///< that the spline goes through
  double largest_change;       ///< of a sample, in steps: half of one is what a level leaves open
};

/// Where a record goes from one level to the next, halfway between two samples, the signal is halfway between the
/// levels; amid a flat part that it goes through, from one level to another, it is at the level. Where a flat part is a
/// crest or a trough nothing more is taken, unless the spline leaves what the level leaves open: then it is held there.
/// Values must be even in time. Empty where find_quantisation() knows no levels. Cost: O(n log n).
/// \throws hydro::InputError for a value that is not finite
std::optional<LevelCurve> through_levels(std::span<const double> values);

}  // namespace fit
