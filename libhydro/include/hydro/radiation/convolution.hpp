#pragma once
/// \file  The memory integral ∫₀ᵗ K(t−τ) v(τ) dτ by direct summation: the plain method, and the reference for every
/// other.
///
/// Trapezium rule over velocities at past steps (R7). A sampled kernel whose transform has a non-negative real part
/// keeps it under this rule, because sampling in time only folds the spectrum onto itself (R8): the sum takes energy
/// out, or none.
#include <Eigen/Core>

#include <cstddef>

#include "hydro/radiation/kernel.hpp"

namespace hydro::radiation {

/// Velocities at the steps behind us, newest first, as far back as the kernel remembers. Before the first of them:
/// rest.
class VelocityHistory {
 public:
  VelocityHistory(int modes, std::size_t samples);

  void push(const Eigen::VectorXd& velocity);  ///< the velocity at a newly completed step
  /// All stored velocities, newest first, as one column of modes × samples numbers.
  Eigen::Map<const Eigen::VectorXd> newest_first() const;
  std::size_t pushed() const { return pushed_; }

 private:
  // Kept twice, half a buffer apart, so that any window of `samples` columns is contiguous.
  Eigen::MatrixXd twice_;
  std::size_t samples_, head_ = 0, pushed_ = 0;
};

/// Direct convolution with a sampled kernel. Const and shareable; the history belongs to the caller.
class DirectConvolution {
 public:
  explicit DirectConvolution(const RetardationKernel& kernel);

  int modes() const { return modes_; }
  double step() const { return step_; }
  double length() const { return step_ * static_cast<double>(samples_); }
  VelocityHistory make_history() const { return {modes_, samples_}; }

  /// The part of the integral that the past has decided, at the time `fraction`·h after the newest stored step,
  /// 0 < fraction <= 1, N. Between samples K is taken as straight. Cost: one product with an (n, n·samples) matrix, two
  /// where fraction < 1.
  Eigen::VectorXd decided(const VelocityHistory& history, double fraction) const;

  /// What multiplies the velocity now: K(0) · fraction · h / 2, (n, n), N s/m.
  Eigen::MatrixXd instantaneous(double fraction) const { return K0_ * (fraction * step_ / 2); }

 private:
  int modes_;
  std::size_t samples_;
  double step_;
  Eigen::MatrixXd K0_;
  Eigen::MatrixXd late_;   // [K(h) K(2h) …], (n, n·samples): for a full step
  Eigen::MatrixXd early_;  // [K(0) K(h) …]: together with late_, for part of a step
};

}  // namespace hydro::radiation
