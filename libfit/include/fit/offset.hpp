#pragma once
/// \file  How late one record of a motion is behind another: two clocks, or two channels of one; (V18),
///        docs/theory/camera.md, and (F106), docs/theory/fit.md.
#include <limits>
#include <span>
#include <string>

namespace fit {

struct Offset {
  double lag;           ///< s: what is added to times of the first to have those of the second
  double deviation;     ///< s, standard, with the noise of both and its memory
  double half_width;    ///< s: of the interval about the lag, at the confidence asked for
  double correlation;   ///< at that lag
  double runner_up;     ///< the largest |correlation| on another swing, of the sign asked for; 0: there is none
  double level, scale;  ///< first(t) ≈ level + scale · second(t + lag)
  double chance;        ///< that two records of these spectra that have nothing in common correlate as much (F106)
};

struct OffsetOptions {
  enum class Sign { either, same, opposite } sign = Sign::either;        ///< of the second against the first
  double around = 0, longest = std::numeric_limits<double>::infinity();  ///< s: lags are looked for so far about that
  double confidence = 0.95;                                              ///< of the interval
  std::string first = "film", second = "record";                         ///< as messages name them
  /// Where two lags fit nearly alike.
  std::string remedy = "take more of both records: their beginning, a change, not the steady part alone";
};

/// What a search takes for known, in words: "supposed: an offset between 0.2 s and 1 s, and record goes as film".
/// "": nothing
std::string supposed(const OffsetOptions& options, const std::string& what);

/// What of two records shows the same, whatever its unit, its zero and its sign: value(t) against other(t + lag). Both
/// may have noise, with a memory or without, independent of the other's; of 400 made sets 92 to 97 % have the truth
/// within the interval. Lags are those at which half of the shorter lies within the other. Times ascend and need not be
/// even; NaN is a gap of the first. \throws hydro::InputError: fewer than 16 samples of either or of what stands beside
/// each other, a second record that is not finite, a |correlation| below 0.7, another lag that is nearly as good, on
/// another swing, a lag at an end of those that are looked for, and where none of these is such a lag
Offset offset_between(std::span<const double> time, std::span<const double> value, std::span<const double> other_time,
                      std::span<const double> other, const OffsetOptions& options = {});

}  // namespace fit
