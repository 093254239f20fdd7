#pragma once
/// \file  The line of any channel: a wave gauge, a potentiometer, a torque cell, from readings at known references;
///        (F100), docs/theory/fit.md.
#include <optional>
#include <span>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/sensor.hpp"

namespace fit {

/// Readings in the order in which they were taken.
struct LinePoints {
  std::vector<double> reference;  ///< what was set: taken as exact
  std::vector<double> reading;    ///< what the channel gave
  std::vector<double> time = {};  ///< s; empty: not known, and then a drift is not seen
};

/// reading = offset + slope · reference + drift · (t − t̄), and what the points do besides.
struct ChannelLine {
  Coefficient slope;   ///< reading per reference
  Coefficient offset;  ///< reading at the reference 0
  std::optional<Coefficient>
      drift;                  ///< of the reading, per s, where times are known; without a value where it may be none
  double residual_deviation;  ///< of the reading
  double nonlinearity;        ///< largest |residual| over the range of the readings
  std::optional<double> hysteresis;  ///< largest |up − down| at one reference over that range; none: no reference was
                                     ///< reached from both sides
  std::size_t pairs;                 ///< references that were
  std::optional<Quantisation> steps;  ///< where the channel knows few levels
  double range;                       ///< largest minus smallest reading
  std::vector<double> residuals;      ///< of the reading, at the points

  /// The reference of a reading; the drift is not counted.
  double reference(double reading) const;
};

/// By least squares, errors of single points independent and alike. A point is on the way up where its reference is
/// above that of the point before, the first where the second is; references are equal if they differ by less than 1e-6
/// of their range. A drift is fitted where times are given and the line has four points at least. \throws
/// hydro::InputError: lengths differ, fewer than three points (four with times), a value that is not finite, references
/// that are all the same, readings that are, a slope whose interval holds zero, times that do not increase, or times so
/// along with the references that a drift cannot be told from the slope
ChannelLine fit_channel_line(const LinePoints& points, double confidence = 0.95);

}  // namespace fit
