#include "fit/sensor_noise.hpp"

#include <algorithm>
#include <cmath>

#include "fit/sensor.hpp"
#include "hydro/base/random.hpp"

namespace fit {

double SensorNoise::total() const { return std::hypot(deviation, step / std::sqrt(12.0)); }

SensorNoise sensor_noise(double total, double step) {
  const double rounding = step / std::sqrt(12.0);
  return {total > rounding ? std::sqrt(total * total - rounding * rounding) : 0.0, step};
}

SensorNoise sure_noise(double total, double step) {
  return {std::sqrt(std::max(0.0, total * total - step * step / 6)), step};
}

double rounding_error(double value, double step) { return step * std::round(value / step) - value; }

std::vector<double> drawn_error(std::span<const double> signal, const SensorNoise& noise, DrawnError what,
                                std::uint64_t stream, std::uint64_t draw) {  // (F68)
  constexpr std::uint64_t seed = 68;
  const hydro::RandomStream random(seed, stream * 1000 + draw);
  std::vector<double> error(signal.size());
  const double place = noise.step * random.uniform(signal.size());
  for (std::size_t j = 0; j < signal.size(); ++j) {
    const double white = noise.deviation > 0 ? noise.deviation * random.normal(j) : 0.0;
    const double before = signal[j] + place + white;
    const double rounding = noise.step > 0 ? rounding_error(before, noise.step) : 0.0;
    error[j] = what == DrawnError::all ? white + rounding : rounding;
  }
  return error;
}

}  // namespace fit
