#pragma once
/// \file  Controllers of the caller's on connectors of a scene: the hook for programs and for Python.
#include <functional>
#include <optional>
#include <string>

#include "dynamics/state/body.hpp"

namespace froude {

/// What a controller may read at the end of each step, while it decides.
class Sample {
 public:
  virtual ~Sample() = default;
  virtual double time() const = 0;  ///< s
  /// A signal, called as in results: "m1.heave", "spring1.force", "wave.elevation"; SI. It is computed when it is asked
  /// for. \throws hydro::InputError if there is none of this name, with the nearest
  virtual double operator[](const std::string& signal) const = 0;
  /// Of a body's centre of gravity, m/s, and angular, rad/s; global axes. \throws hydro::InputError at another name
  virtual dynamics::Vector6 velocity(const std::string& body) const = 0;
};

/// A controller that sets the stiffness of axial connectors, in the place of a [connector.switch] if they have one.
/// Connectors that one name stands for have one stiffness, and begin with that of the scene.
struct Control {
  std::string connectors;  ///< a name; * stands for any characters
  /// Called at the end of each step, in order: the new stiffness, N/m, or nothing to leave it.
  std::function<std::optional<double>(const Sample&)> decide;
};

}  // namespace froude
