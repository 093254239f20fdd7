#pragma once
/// \file  The force of a spring and a damper by one number and its rate: an elongation or a joint coordinate.
/// (D50)-(D52)
#include <limits>
#include <optional>
#include <vector>

namespace dynamics {

/// The force of a spring and a damper at (x, ẋ), against x, its derivatives, the energy held, and the power lost.
struct SpringDamperForce {
  double force = 0, by_x = 0, by_rate = 0;
  double stored = 0, dissipated = 0;
};

/// A spring, straight (k₁x + k₃x³) or by a table, and a damper c₁ẋ + c₂|ẋ|ẋ. Units follow x: N, m, s or N m, rad, s.
struct LineLaw {
  double stiffness = 0, damping = 0;        ///< k₁, c₁
  double cubic = 0, quadratic_damping = 0;  ///< k₃, c₂
  std::vector<double> table_x = {},
                      table_force =
                          {};  ///< at least two, x increasing; straight between them and beyond, instead of k₁, k₃
  bool tension_only = false;   ///< nothing at x <= 0, and never a push: cables, end stops (D51)

  SpringDamperForce at(double x, double rate) const { return at(x, rate, stiffness); }
  /// With another k₁ in place of its own.
  SpringDamperForce at(double x, double rate, double k1) const;
  /// The steepest slope of the spring: of its table, or at x = 0 where it pulls.
  double stiffest() const;
};

/// A stop that a joint runs into: nothing before `at`, a spring with a damper that never pulls behind it.
struct EndStop {
  double at;
  double stiffness, damping;
};

/// What works along the coordinate of a joint: a spring and damper with a preload, all of which cannot exceed a limit,
/// and end stops, which can. (D52)
struct PtoLaw {
  LineLaw line;
  double preload = 0;
  double force_limit = std::numeric_limits<double>::infinity();
  std::optional<EndStop> lower, upper;

  struct Working : SpringDamperForce {
    double supplied = 0;  ///< W, where a limit keeps the force below what spring and damper would give
  };
  Working at(double x, double rate) const;
  /// The steepest slope of the spring and either stop together.
  double stiffest() const;
};

}  // namespace dynamics
