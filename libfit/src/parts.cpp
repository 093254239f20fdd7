#include "fit/parts.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/signal/distributions.hpp"

namespace fit {

Coefficient with_parts(const std::string& name, double value, double scatter, double t, double systematic,
                       double confidence) {
  Coefficient c;
  c.name = name;
  c.value = value;
  c.systematic_error = systematic;
  c.standard_error = std::hypot(scatter, systematic);
  const double half = std::hypot(t * scatter, hydro::signal::normal_quantile((1 + confidence) / 2) * systematic);
  c.interval = {value - half, value + half};
  c.white_interval = c.interval;
  return c;
}

SlopeError slope_error_of(std::initializer_list<SlopeOfChannel> channels) {  // (F105)
  SlopeError out;
  for (const auto& [error, power] : channels) {
    out.standard = std::hypot(out.standard, power * error.standard);
    out.half_width = std::hypot(out.half_width, power * error.half_width);
  }
  return out;
}

Interval with_slope(const SlopeError& slope, double sensitivity, double middle, const Interval& i) {
  const double half = sensitivity * slope.half_width;
  return {middle - std::hypot(middle - i.low, half), middle + std::hypot(i.high - middle, half)};
}

void count_slope(const SlopeError& slope, double sensitivity, Coefficient& c) {
  const double own = std::abs(sensitivity) * slope.standard;
  c.systematic_error = std::hypot(c.systematic_error, own);
  c.standard_error = std::hypot(c.standard_error, own);
  c.interval = with_slope(slope, sensitivity, c.value.value_or((c.interval.low + c.interval.high) / 2), c.interval);
}

Interval with_shift(double shift, const Interval& i) {
  return {i.low + std::min(0.0, shift), i.high + std::max(0.0, shift)};
}

void count_shift(double shift, Coefficient& c) {
  c.systematic_error = std::hypot(c.systematic_error, shift);
  c.standard_error = std::hypot(c.standard_error, shift);
  c.interval = with_shift(shift, c.interval);
}

}  // namespace fit
