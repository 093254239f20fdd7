#pragma once
/// \file  SUNDIALS' CVODE with dense matrices by differences, for vectors of numbers. Not installed.
#include <Eigen/Core>

#include <functional>
#include <memory>

namespace dynamics::detail {

/// Backward differences of orders 1 to 5. Begins anew with every call.
class Cvode {
 public:
  /// dy/dt at (t, y) into the third; false where there is none, and a shorter step is tried.
  using Rates = std::function<bool(double, Eigen::Map<Eigen::VectorXd>, Eigen::Map<Eigen::VectorXd>)>;

  /// \throws hydro::NumericsError if SUNDIALS refuses
  explicit Cvode(Eigen::Index size);
  ~Cvode();

  struct Outcome {
    bool good;
    double reached;       ///< s
    long iterations = 0;  ///< of Newton
  };
  /// From `y` at t = 0 to t = h, with local errors of each number below `allowed`.
  Outcome run(const Rates& rates, Eigen::VectorXd& y, const Eigen::VectorXd& allowed, double h);

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace dynamics::detail
