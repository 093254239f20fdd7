#pragma once
/// \file  What is wrong with a measured column before anything is done to it; (F19)-(F22), docs/theory/fit.md.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fit {

/// A sensor at its stop: the same extreme value again and again.
struct Clipping {
  double low, high;                                 ///< the extreme values
  std::size_t at_low = 0, at_high = 0;              ///< samples that stand there, 0 where that side is free
  std::size_t low_in_a_row = 0, high_in_a_row = 0;  ///< the most of them one after the other
};
/// Empty unless one of the extremes is taken by at least 5 samples and 5 times as often as the value next to it; (F19).
/// Noise added after the stop hides it. \throws hydro::InputError for a value that is not finite
std::optional<Clipping> find_clipping(std::span<const double> values);

/// A sensor that knows few values.
struct Quantisation {
  double step;           ///< least difference between two values that occur
  std::size_t levels;    ///< range/step + 1
  double noise() const;  ///< step/√12: standard deviation, if the signal crosses many steps
};
/// Empty where there are more than 1000 levels or values do not lie on a grid; (F20).
std::optional<Quantisation> find_quantisation(std::span<const double> values);

/// A line in a spectrum: a structural frequency, or hum from the mains.
struct SpectralLine {
  double frequency_hz;
  double amplitude;  ///< of the sinusoid, unit of the values
};
/// Peaks above `from_hz` that stand 30 times higher than the median density around them, highest first, ten at most;
/// (F21). A hum of 50 Hz sampled at less than 100 Hz shows at its alias. \throws hydro::InputError for n < 64
std::vector<SpectralLine> find_lines(std::span<const double> values, double step_s, double from_hz);

/// Samples further from their neighbours (the median of the means of pairs as far before as behind) than `deviations`
/// times what is usual around them (1.4826 times the median of those distances, a standard deviation for Gaussian
/// noise); (F22).
/// `half_window` samples on each side are asked. \throws hydro::InputError unless half_window >= 2, deviations >= 3
std::vector<std::size_t> find_outliers(std::span<const double> values, int half_window, double deviations);

/// Replaces the samples at `indices` (in increasing order) by the straight line between their neighbours.
/// \throws hydro::InputError if the first or last sample is among them
void bridge(std::vector<double>& values, std::span<const std::size_t> indices);

/// Columns brought to an even grid where rows are missing.
struct EvenGrid {
  double step;                      ///< the median step of the record, s
  std::vector<double> time;         ///< s
  std::vector<std::size_t> filled;  ///< samples of the new grid that were missing
};
/// The even grid of a record that lacks rows; each gap may be `longest_gap_s` long. Samples must otherwise be even
/// within 2 % of a step, or but for their last digit, to which they were rounded (F123). \throws hydro::InputError for
/// a longer gap, naming the time, or time that does not increase
EvenGrid even_grid(std::span<const double> time_s, double longest_gap_s);
/// A column on that grid: straight lines over the gaps, everything else unchanged.
std::vector<double> on_grid(const EvenGrid& grid, std::span<const double> values);

/// Values that are no numbers are gaps, and fewer than two others tell nothing. \throws hydro::InputError, with the
/// name, where all others are the same
void require_signal(const std::string& name, std::span<const double> values);

}  // namespace fit
