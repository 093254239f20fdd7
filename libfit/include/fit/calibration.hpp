#pragma once
/// \file  The line of a load cell, its uncertainty and its hysteresis; (F14)-(F15), docs/theory/fit.md.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"

namespace fit {

/// One loading cycle in the order of its steps: load taken up to its largest magnitude, then down again.
/// Tension and compression are two cycles; signs are kept (compression negative).
struct LoadCycle {
  std::vector<double> force;    ///< N
  std::vector<double> voltage;  ///< V
};

struct Calibration {
  double slope;                      ///< b, V/N
  double offset;                     ///< a, V
  double slope_error, offset_error;  ///< standard errors
  Interval slope_interval;           ///< Student, n − 2 degrees of freedom
  double residual_deviation;         ///< √(RSS/(n − 2)), V
  double nonlinearity;               ///< largest |residual| over the range of voltages
  double hysteresis;                 ///< largest |V_up − V_down| at equal load, over the range of voltages; 0 … 1
  std::size_t pairs;                 ///< loads that occur on both branches
  double range;                      ///< largest minus smallest voltage, V
  std::string unit = "V/N";          ///< of the slope, where readings are no volts

  /// Force for a voltage, N.
  double force(double volt) const { return (volt - offset) / slope; }
};

/// Fits V = a + b F through all cycles by least squares; forces are taken as exact.
/// Loads on the two branches are equal if they differ by less than 1e-6 of the largest.
/// \throws hydro::InputError: lengths differ, fewer than three points or two different loads, a value that is not
/// finite, a cycle that does not go up and then down, or no load that occurs on both branches
Calibration calibrate(std::span<const LoadCycle> cycles, double confidence = 0.95);

}  // namespace fit
