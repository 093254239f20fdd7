#pragma once
/// \file  A coefficient whose error has two parts: what scatters, and what is the same throughout; (F26),
///        docs/theory/fit.md.
#include <initializer_list>
#include <string>

#include "fit/coefficient.hpp"

namespace fit {

/// Student's t of the scatter and the normal quantile of what is the same throughout, in one half width. `t` belongs to
/// the same confidence.
Coefficient with_parts(const std::string& name, double value, double scatter, double t, double systematic,
                       double confidence);

/// Of the slope of a channel's line (F100), over the slope: what the channel gives is that much too small or too large,
/// throughout all runs.
struct SlopeError {
  double standard = 0;    ///< standard error
  double half_width = 0;  ///< of its interval at the confidence of the fit
};
/// Of a product of powers of what channels give: `power` is 1 for an amplitude, −1 for what is divided by one.
struct SlopeOfChannel {
  SlopeError error;
  double power;
};
SlopeError slope_error_of(std::initializer_list<SlopeOfChannel> channels);
/// (F105) Counts the error of a slope in a coefficient that changes by `sensitivity` for each unit of relative error:
/// the coefficient itself where it is proportional to what the channel gives.
void count_slope(const SlopeError& slope, double sensitivity, Coefficient& c);
/// The same for an interval about `middle`.
Interval with_slope(const SlopeError& slope, double sensitivity, double middle, const Interval& interval);
/// Counts a bias of known size and sign, as of steps (F117) or of resolution (F118): what is free of it lies `shift`
/// from the value, and the interval reaches over both.
void count_shift(double shift, Coefficient& c);
/// The same for an interval alone.
Interval with_shift(double shift, const Interval& interval);

}  // namespace fit
