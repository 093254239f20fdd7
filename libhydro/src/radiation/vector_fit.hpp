#pragma once
/// \file  Private: poles by vector fitting, (R13).
#include <Eigen/Core>

#include <vector>

#include "hydro/radiation/rational.hpp"

namespace hydro::radiation::detail {

/// Samples of many functions of frequency, one column a function, weighted by row.
struct Samples {
  std::vector<double> omega;
  Eigen::VectorXd weight;   ///< (omega)
  Eigen::MatrixXcd values;  ///< (omega, functions)
};

/// The matrix whose columns span the coefficients with Σ c_k φ_k(0) = 0, (columns, columns − 1): K̂ vanishes at ω = 0.
Eigen::MatrixXd vanishing_at_rest(const std::vector<Pole>& poles);

/// As many samples with fewer columns, the same to every least-squares fit with common poles up to `relative` of the
/// largest.
Samples compressed(const Samples& samples, double relative);

/// `order` stable poles that the functions share, from pairs spread over the frequencies, by relaxed vector fitting.
/// No pole decays more slowly than `slowest`.
std::vector<Pole> fitted_poles(const Samples& compressed, int order, double slowest);

}  // namespace hydro::radiation::detail
