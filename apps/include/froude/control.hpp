#pragma once
/// \file  Controllers of the caller's on connectors of a scene: the hook for programs and for Python.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/state/body.hpp"

namespace froude {

/// What a controller is told at the end of each step: a copy, which may be kept.
class Sample {
 public:
  Sample(std::shared_ptr<const std::vector<dynamics::RigidBody>> bodies, dynamics::State state)
      : bodies_(std::move(bodies)), state_(std::move(state)) {}
  double time() const { return state_.time; }  ///< s
  /// A motion of a body's origin from rest, called like "m1.heave", m or rad. \throws hydro::InputError at another name
  double motion(const std::string& name) const;
  /// Of the centre of gravity, m/s, and angular, rad/s; global axes. \throws hydro::InputError at another name
  dynamics::Vector6 velocity(const std::string& body) const;

 private:
  int index(const std::string& body) const;
  std::shared_ptr<const std::vector<dynamics::RigidBody>> bodies_;
  dynamics::State state_;
};

/// A controller that sets the stiffness of axial connectors, in the place of a [connector.switch] if they have one.
/// Connectors that one name stands for have one stiffness, and begin with that of the scene.
struct Control {
  std::string connectors;  ///< a name; * stands for any characters
  /// Called at the end of each step, in order: the new stiffness, N/m, or nothing to leave it.
  std::function<std::optional<double>(const Sample&)> decide;
};

}  // namespace froude
