#pragma once
/// \file  Types at the border, where two quantities of one kind are easily taken for each other.
/// Inside kernels everything is a double in SI.
#include <array>
#include <limits>
#include <string_view>

#include "hydro/base/error.hpp"

namespace hydro {

/// Frequency of a wave or motion; rad/s inside, but a caller must say which of the three he holds.
class AngularFrequency {
 public:
  static AngularFrequency from_rad_per_s(double omega);  ///< \throws InputError unless finite and > 0; so do the others
  static AngularFrequency from_hertz(double f);
  static AngularFrequency from_period_s(double period);
  double rad_per_s() const noexcept { return omega_; }
  double hertz() const noexcept;
  double period_s() const noexcept;

 private:
  explicit AngularFrequency(double omega);
  double omega_;
};

/// An angle; radians inside. Of a wave: the direction it propagates towards, from +x towards +y.
class Angle {
 public:
  static constexpr Angle from_radians(double value) { return Angle(value); }
  static constexpr Angle from_degrees(double value) { return Angle(value * 0.017453292519943295769); }
  constexpr double radians() const noexcept { return value_; }
  constexpr double degrees() const noexcept { return value_ / 0.017453292519943295769; }

 private:
  explicit constexpr Angle(double value) : value_(value) {}
  double value_;
};

/// Depth of still water, positive down; may be infinite.
class WaterDepth {
 public:
  static WaterDepth from_metres(double depth);  ///< \throws InputError unless > 0
  static WaterDepth infinite() { return WaterDepth(std::numeric_limits<double>::infinity()); }
  bool is_infinite() const noexcept { return depth_ == std::numeric_limits<double>::infinity(); }
  double metres() const noexcept { return depth_; }  ///< +∞ in deep water

 private:
  explicit WaterDepth(double depth) : depth_(depth) {}
  double depth_;
};

/// Amplitude of a regular wave; a height is twice that.
class WaveAmplitude {
 public:
  static WaveAmplitude from_metres(double amplitude);  ///< \throws InputError unless finite and >= 0
  static WaveAmplitude from_height(double height_m) { return from_metres(height_m / 2); }
  double metres() const noexcept { return amplitude_; }

 private:
  explicit WaveAmplitude(double amplitude) : amplitude_(amplitude) {}
  double amplitude_;
};

/// The six rigid-body modes in the order of every 6-vector here: translations along x, y, z, rotations about x, y, z.
enum class Mode : int { surge, sway, heave, roll, pitch, yaw };
inline constexpr std::array<std::string_view, 6> mode_names{"surge", "sway", "heave", "roll", "pitch", "yaw"};
constexpr bool is_rotation(Mode mode) { return static_cast<int>(mode) >= 3; }
/// \throws InputError naming the nearest mode
Mode parse_mode(std::string_view name);

/// Which time factor a set of complex amplitudes was written with. Ours is plus: Re(X e^{+iωt}).
enum class TimeFactor { plus_i_omega_t, minus_i_omega_t };

/// Water as linear theory knows it.
struct Water {
  double density = 1025.0;  ///< ρ, kg/m³
  double gravity = 9.81;    ///< g, m/s²
  WaterDepth depth = WaterDepth::infinite();
};

}  // namespace hydro
