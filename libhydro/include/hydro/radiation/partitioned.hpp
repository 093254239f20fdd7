#pragma once
/// \file  The sum of direct convolution, regrouped so that most of it is done by Fourier transforms: the same numbers
/// to round-off, without a step of delay, (R18).
#include <Eigen/Core>

#include <memory>

#include "hydro/radiation/convolution.hpp"

namespace hydro::radiation {

/// A direct head of N lags, then a part of N lags, of 2N, of 4N, …, each as long as all before it. A part of P lags is
/// summed once in P steps, for the P newest velocities, by transforms of length 2P; what it gives is due from the very
/// next step on.
///
/// Cost of a step, on average: n² (N/2 + 2 log₂(lags/N)) products and n (log₂ lags)² of transforms. The steps at which
/// long parts fall due cost more, the worst of them several times a step of direct convolution; worst_step() says.
class PartitionedConvolution final : public MemoryMethod {
 public:
  /// `head`: lags summed directly, a power of two from 4 on.
  /// \throws InputError if it is not, or if the kernel is not symmetric
  explicit PartitionedConvolution(const RetardationKernel& kernel, std::size_t head = 32);
  ~PartitionedConvolution() override;
  PartitionedConvolution(PartitionedConvolution&&) noexcept;

  int modes() const override;
  double step() const override;
  std::string describe() const override;
  std::unique_ptr<MemoryState> start(const Eigen::VectorXd& velocity) const override;
  Eigen::MatrixXd instantaneous(double fraction) const override;

  /// Products of real numbers in a mean step and in the worst one, transforms included: a model of cost for so many
  /// modes and samples of the kernel.
  static double mean_step(int modes, std::size_t samples, std::size_t head = 32);
  static double worst_step(int modes, std::size_t samples, std::size_t head = 32);

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace hydro::radiation
