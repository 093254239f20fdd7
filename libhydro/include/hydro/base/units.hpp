#pragma once
/// \file  Quantities as people write them: "29.3 kN/m", "22.5 deg", "(0, 0, 1.31) m". SI doubles come out.
///
/// Grammar of a unit:  factor { ("/" | " " | "*" | "·") factor },  factor = symbol [ "^" integer ].
/// Every "/" divides by the one factor after it, so "N m/rad" is N·m·rad⁻¹ and "kg/m/s" is kg·m⁻¹·s⁻¹.
/// Hertz is one cycle per second: 1 Hz = 2π rad/s, so a frequency may be given either way and nothing is off by 2π.
#include <Eigen/Core>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/base/error.hpp"

namespace hydro {

/// Exponents of metre, kilogram, second, radian and volt.
///
/// The radian counts as a base unit where it is the only thing that tells two quantities apart (an angle from a
/// number, rad/s from 1/s); where mass is present it does not ("N m" is accepted for "N m/rad").
struct Dimension {
  int length = 0, mass = 0, time = 0, angle = 0, voltage = 0;

  friend bool operator==(const Dimension&, const Dimension&) = default;
  friend constexpr Dimension operator*(Dimension a, Dimension b) {
    return {a.length + b.length, a.mass + b.mass, a.time + b.time, a.angle + b.angle, a.voltage + b.voltage};
  }
  friend constexpr Dimension operator/(Dimension a, Dimension b) {
    return {a.length - b.length, a.mass - b.mass, a.time - b.time, a.angle - b.angle, a.voltage - b.voltage};
  }
  /// The SI unit as text, "kg/s^2"; "" for a number.
  std::string si() const;
  /// The field's word for it with an article, "a stiffness"; the SI unit where there is no such word.
  std::string name() const;
  /// An example in a usual unit, "29.3 kN/m".
  std::string example() const;
};

namespace dim {
inline constexpr Dimension none{};
inline constexpr Dimension length{.length = 1};
inline constexpr Dimension area{.length = 2};
inline constexpr Dimension volume{.length = 3};
inline constexpr Dimension mass{.mass = 1};
inline constexpr Dimension time{.time = 1};
inline constexpr Dimension angle{.angle = 1};
inline constexpr Dimension voltage{.voltage = 1};
inline constexpr Dimension velocity = length / time;
inline constexpr Dimension acceleration = velocity / time;
inline constexpr Dimension angular_velocity = angle / time;  ///< also of a frequency, see the note on hertz
inline constexpr Dimension force = mass * acceleration;
inline constexpr Dimension moment = force * length;
inline constexpr Dimension pressure = force / area;
inline constexpr Dimension density = mass / volume;
inline constexpr Dimension inertia = mass * area;
inline constexpr Dimension stiffness = force / length;
inline constexpr Dimension rotational_stiffness = moment / angle;
inline constexpr Dimension damping = force / velocity;
inline constexpr Dimension rotational_damping = moment / angular_velocity;
inline constexpr Dimension kinematic_viscosity = area / time;
}  // namespace dim

/// A number with its unit, converted: value in SI.
struct Quantity {
  double si = 0;
  Dimension dimension;
};

/// A unit alone: what one of it is in SI.
struct Unit {
  double factor = 1;
  Dimension dimension;
};

/// Parses "kN/m". \throws InputError naming the unknown symbol and the nearest known one.
Unit parse_unit(std::string_view text);

/// Parses "29.3 kN/m". \throws InputError if the number or the unit cannot be read, or the number is not finite.
Quantity parse_quantity(std::string_view text);

/// True if a quantity of dimension `given` may stand where `needed` is asked for (see Dimension on the radian).
bool compatible(const Dimension& given, const Dimension& needed);

/// Parses "29.3 kN/m" where a stiffness is needed and returns SI. \throws InputError saying both dimensions.
double parse_si(std::string_view text, const Dimension& needed);

/// Parses "(0, 0, 1.31) m" with exactly three components, SI. \throws InputError
Eigen::Vector3d parse_vector(std::string_view text, const Dimension& needed);

/// As parse_vector, but "±" before a component stands for both signs: "(6, ±5, 0) m" is two vectors, + first.
std::vector<Eigen::Vector3d> parse_vectors(std::string_view text, const Dimension& needed);

/// "2 s .. 8 s, 61 values": evenly spaced values, both ends included. \throws InputError
std::vector<double> parse_range(std::string_view text, const Dimension& needed);

/// A finite double from exactly this text. \throws InputError
double parse_number(std::string_view text);

/// Text without the blanks around it.
std::string_view trimmed(std::string_view text);

}  // namespace hydro
