#pragma once
/// \file  Errors that a sensor may have made, drawn from their law; (F68), docs/theory/fit.md.
#include <cstdint>
#include <span>
#include <vector>

namespace fit {

/// White noise, then rounding to steps.
struct SensorNoise {
  double deviation;  ///< of the white noise
  double step;       ///< of the sensor; 0: it does not round
  /// Of white noise and rounding, were they independent.
  double total() const;
  /// White noise of half a step and more makes rounding one more white noise (Widrow & Kollár 2008, chapter 19), and
  /// residuals tell all of it; less leaves rounding its memory.
  bool rounds_with_memory() const { return deviation < step / 2; }
};
/// The noise whose deviation is `total` in all, of a sensor with these steps.
SensorNoise sensor_noise(double total, double step);

/// The same with as much white noise as is sure to be there: the variance of rounding that repeats itself comes out up
/// to twice as large as δ²/12 of a step δ, and white noise that is taken for larger than it is would hide that.
SensorNoise sure_noise(double total, double step);

/// What rounding to a step adds to a value: between ±step/2.
double rounding_error(double value, double step);

/// What of the error is drawn.
enum class DrawnError { all, rounding };
/// Draw number `draw` of the error of a signal: the place of the signal within a step is drawn, even in it, and white
/// noise for each sample. Draws are a pure function of (stream, draw).
std::vector<double> drawn_error(std::span<const double> signal, const SensorNoise& noise, DrawnError what,
                                std::uint64_t stream, std::uint64_t draw);

/// Draws that intervals are made from: a variance is then known to a quarter.
constexpr int noise_draws = 32;

}  // namespace fit
