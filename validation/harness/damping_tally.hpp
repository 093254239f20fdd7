#pragma once
/// \file  What intervals of a linear and a quadratic damping come to over many seeds.
#include <cmath>

#include "fit/simulated.hpp"
#include "harness/case.hpp"

namespace froude::validation {

inline double half(const ::fit::Coefficient& c) { return (c.interval.high - c.interval.low) / 2; }
inline double middle(const ::fit::Coefficient& c) { return (c.interval.low + c.interval.high) / 2; }
inline bool holds(const ::fit::Coefficient& c, double value) { return std::abs(middle(c) - value) <= half(c); }

/// Sums over the seeds.
struct DampingTally {
  double b_l, b_q;         ///< the truth
  plot::Series estimates;  ///< b_q against b_l
  double drawn_in = 1;     ///< what the estimates are drawn in: 1e3 for g/s and g/m
  double both = 0, linear = 0, quadratic = 0, half_linear = 0, half_quadratic = 0, error = 0;

  void add(const ::fit::Coefficient& l, const ::fit::Coefficient& q) {
    linear += holds(l, b_l);
    quadratic += holds(q, b_q);
    both += holds(l, b_l) && holds(q, b_q);
    half_linear += half(l) / b_l;
    half_quadratic += half(q) / b_q;
    error += (middle(l) - b_l) / l.standard_error;
    estimates.x.push_back(drawn_in * middle(l));
    estimates.y.push_back(drawn_in * middle(q));
  }
};

}  // namespace froude::validation
