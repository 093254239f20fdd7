#pragma once
/// \file  What every way of computing the memory integral ∫₀ᵗ K(t−τ) v(τ) dτ promises.
///
/// Between two steps the velocity is not known, so the integral at fraction·h after the newest step is split: the
/// history force, which only the past makes, and a matrix times the velocity now. The matrix enters the implicit step.
/// Both are pure functions of what has been accepted: asked again, they answer the same.
#include <Eigen/Core>

#include <memory>
#include <string>

#include "hydro/base/state_bytes.hpp"

namespace hydro::radiation {

/// The past of one run, as far as its method needs it. Belongs to one thread.
class MemoryState {
 public:
  virtual ~MemoryState() = default;
  /// A full step has been completed with this velocity, (n).
  virtual void accept(const Eigen::VectorXd& velocity) = 0;
  /// The history force at fraction·h after the newest step, 0 < fraction <= 1, (n), N.
  Eigen::VectorXd history_force(double fraction) const {
    Eigen::VectorXd out;
    find_history_force(fraction, out);
    return out;
  }
  /// The same, into a vector that has room.
  virtual void find_history_force(double fraction, Eigen::VectorXd& out) const = 0;
  /// What has been accepted, as far as it counts: taken up, or given back to a state that the same method has made.
  virtual void keep_state(StateBytes& bytes) = 0;
};

/// One way of computing. Const and shareable; outlives the states it makes.
class MemoryMethod {
 public:
  virtual ~MemoryMethod() = default;
  virtual int modes() const = 0;
  /// Whether velocities of the past count. Where they do not, the load is that of the velocity now, at any instant.
  virtual bool has_past() const { return true; }
  virtual double step() const = 0;           ///< s
  virtual std::string describe() const = 0;  ///< for `froude plan`
  /// At rest before now, moving with `velocity` from now on.
  virtual std::unique_ptr<MemoryState> start(const Eigen::VectorXd& velocity) const = 0;
  /// What multiplies the velocity at fraction·h after the newest step, (n, n), N s/m; no negative eigenvalue of its
  /// symmetric part for a passive kernel.
  virtual Eigen::MatrixXd instantaneous(double fraction) const = 0;
};

}  // namespace hydro::radiation
