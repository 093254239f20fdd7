#include "fit/parts.hpp"

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

}  // namespace fit
