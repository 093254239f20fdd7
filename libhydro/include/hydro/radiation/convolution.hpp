#pragma once
/// \file  The memory integral ∫₀ᵗ K(t−τ) v(τ) dτ by direct summation: the plain method, and the reference for every
/// other.
///
/// Trapezium rule over velocities at past steps (R7). A sampled kernel whose transform has a non-negative real part
/// keeps it under this rule, because sampling in time only folds the spectrum onto itself (R8): the sum takes energy
/// out, or none.
#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "hydro/radiation/kernel.hpp"
#include "hydro/radiation/memory.hpp"

namespace hydro::radiation {

/// Velocities at the steps behind us, newest first, as far back as the kernel reaches. Before the first of them:
/// rest.
class VelocityHistory {
 public:
  VelocityHistory(int modes, std::size_t samples);

  void push(const Eigen::VectorXd& velocity);  ///< the velocity at a newly completed step
  /// Stored velocities, newest first: one column a mode, (samples, modes), columns `stride()` apart.
  const double* newest_first(int mode) const { return twice_.data() + stride() * mode + head_; }
  Eigen::Index stride() const { return twice_.rows(); }
  std::size_t samples() const { return samples_; }
  void keep_state(StateBytes& bytes) { bytes.pass(twice_, head_); }
  Eigen::VectorXd newest() const { return twice_.row(static_cast<Eigen::Index>(head_)).transpose(); }

 private:
  // Kept twice, one buffer apart, so that any window of `samples` rows is contiguous.
  Eigen::MatrixXd twice_;
  std::size_t samples_, head_ = 0;
};

/// Samples of a symmetric kernel, K(first·h), K((first+1)·h), …, pair by pair, so that each number is read once for the
/// two loads that it makes: the sum is bound by reading K, and half of it need not be read.
class KernelSum {
 public:
  /// Samples first … last−1. \throws InputError if a sample is not symmetric within 1e-9 of its largest entry
  KernelSum(const RetardationKernel& kernel, std::size_t first, std::size_t last);

  std::size_t samples() const { return samples_; }
  /// out_i += Σ_l Σ_j K_ij(first + l) v_j(l + later), l = 0, 1, … over the samples held; v_j(0) is the newest velocity.
  void add(const VelocityHistory& history, std::size_t later, Eigen::VectorXd& out) const;

 private:
  int modes_;
  std::size_t samples_;
  std::vector<double> numbers_;  // by blocks of lags, in each by pairs (0,0) (0,1) (1,1) (0,2) …, in each by lag
};

/// Direct convolution with a sampled kernel. Const and shareable; the history belongs to the caller.
class DirectConvolution final : public MemoryMethod {
 public:
  /// \throws InputError as KernelSum
  explicit DirectConvolution(const RetardationKernel& kernel);

  int modes() const override { return static_cast<int>(K0_.rows()); }
  double step() const override { return step_; }
  double length() const { return step_ * static_cast<double>(samples_); }
  std::string describe() const override;
  VelocityHistory make_history() const { return {modes(), samples_ + 1}; }
  std::unique_ptr<MemoryState> start(const Eigen::VectorXd& velocity) const override;

  /// The history force: the part of the integral that only the past makes, at the time `fraction`·h after the newest
  /// stored step, 0 < fraction <= 1, N. Between samples K is taken as straight. Cost: n(n+1)/2 numbers a lag read once;
  /// twice where fraction < 1.
  Eigen::VectorXd history_force(const VelocityHistory& history, double fraction) const;

  /// What multiplies the velocity now: K(0) · fraction · h / 2, (n, n), N s/m.
  Eigen::MatrixXd instantaneous(double fraction) const override { return K0_ * (fraction * step_ / 2); }

 private:
  std::size_t samples_;
  double step_;
  Eigen::MatrixXd K0_, K1_;
  KernelSum sum_;  // from K(0) on
};

}  // namespace hydro::radiation
