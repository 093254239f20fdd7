#pragma once
/// \file  Private to apps: densities over frequency, with frequencies put where they bend. (Q8)
#include <Eigen/Core>

#include <functional>
#include <vector>

#include "hydro/signal/spectrum.hpp"

namespace froude {

/// Densities at one frequency.
struct Column {
  double omega;             ///< rad/s
  Eigen::VectorXd density;  ///< of each row, per rad/s
};

/// Rows of densities at frequencies that are halved until straight lines between them have the moments m₀, m₂ and m₄ of
/// every row to a tolerance.
class RefinedDensities {
 public:
  /// Densities at these frequencies, in their order.
  using At = std::function<std::vector<Column>(const std::vector<double>& omega)>;

  /// From two or more frequencies on, rad/s, increasing. \throws hydro::NumericsError for a density too sharp; as `at`
  RefinedDensities(const std::vector<double>& omega, double tolerance, const At& at);

  std::vector<double> omega() const;
  double error() const { return error_; }  ///< estimated, of the moments, relative
  hydro::signal::SpectrumPerHz spectrum(Eigen::Index row) const;
  /// ∫ ωⁿ S dω of each row.
  Eigen::VectorXd moment(int order) const;

 private:
  std::vector<double> halve(const std::vector<double>& lower_ends, const At& at);

  double tolerance_, error_ = 0;
  std::vector<Column> columns_;
};

/// The largest relative change of what is not zero: of variances, and squares of offsets.
double largest_change(const Eigen::VectorXd& before, const Eigen::VectorXd& now);

}  // namespace froude
