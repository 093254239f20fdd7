#include "hydro/base/types.hpp"

#include <cmath>
#include <numbers>

namespace hydro {

AngularFrequency::AngularFrequency(double omega) : omega_(omega) {
  require(std::isfinite(omega) && omega > 0, "a frequency must be finite and positive, got {} rad/s", omega);
}
AngularFrequency AngularFrequency::from_rad_per_s(double omega) { return AngularFrequency(omega); }
AngularFrequency AngularFrequency::from_hertz(double f) { return AngularFrequency(2 * std::numbers::pi * f); }
AngularFrequency AngularFrequency::from_period_s(double period) {
  require(std::isfinite(period) && period > 0, "a period must be finite and positive, got {} s", period);
  return AngularFrequency(2 * std::numbers::pi / period);
}
double AngularFrequency::hertz() const noexcept { return omega_ / (2 * std::numbers::pi); }
double AngularFrequency::period_s() const noexcept { return 2 * std::numbers::pi / omega_; }

WaterDepth WaterDepth::from_metres(double depth) {
  require(depth > 0, "water depth must be positive, got {} m", depth);
  return WaterDepth(depth);
}

WaveAmplitude WaveAmplitude::from_metres(double amplitude) {
  require(std::isfinite(amplitude) && amplitude >= 0, "a wave amplitude must be finite and not negative, got {} m",
          amplitude);
  return WaveAmplitude(amplitude);
}

Mode parse_mode(std::string_view name) {
  for (std::size_t i = 0; i < mode_names.size(); ++i)
    if (mode_names[i] == name) return static_cast<Mode>(i);
  const std::string near = nearest(name, mode_names);
  throw InputError(
      fmt::format("\"{}\" is not a rigid-body mode", name), {},
      near.empty() ? "modes are surge, sway, heave, roll, pitch, yaw" : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace hydro
