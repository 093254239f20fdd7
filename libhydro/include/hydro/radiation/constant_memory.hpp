#pragma once
/// \file  Radiation of a body that moves at one frequency only: no memory, but a damping.
#include <Eigen/Core>

#include "hydro/radiation/memory.hpp"

namespace hydro::radiation {

/// F = −B(ω) v, to go with A(ω) in place of A∞ in the mass matrix. Exact for the steady motion of a linear body in a
/// regular wave of frequency ω; wrong while it begins, and for every other frequency in the motion.
class ConstantMemory final : public MemoryMethod {
 public:
  /// \throws InputError unless B is square and omega and step are positive
  ConstantMemory(Eigen::MatrixXd B, double omega, double step);

  int modes() const override { return static_cast<int>(B_.rows()); }
  bool has_past() const override { return false; }
  double step() const override { return step_; }
  std::string describe() const override;
  std::unique_ptr<MemoryState> start(const Eigen::VectorXd& velocity) const override;
  Eigen::MatrixXd instantaneous(double) const override { return B_; }

 private:
  Eigen::MatrixXd B_;
  double omega_, step_;
};

}  // namespace hydro::radiation
