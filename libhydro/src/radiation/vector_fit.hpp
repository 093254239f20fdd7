#pragma once
/// \file  Private: poles by vector fitting, (R13).
#include <Eigen/Core>

#include <vector>

#include "hydro/radiation/rational.hpp"

namespace hydro::radiation::detail {

/// Samples of many functions of frequency, one column a function, weighted by row.
struct Samples {
  std::vector<double> omega;
  Eigen::VectorXd weight;   ///< (2 omega): of real parts, then of imaginary ones
  Eigen::MatrixXcd values;  ///< (omega, functions)
  /// Real parts above imaginary parts of functions at these frequencies, weighted.
  Eigen::MatrixXd weighted(const Eigen::MatrixXcd& functions) const;
};

/// The matrix whose columns span the coefficients with Σ c_k φ_k(0) = 0, (columns, columns − 1): K̂ vanishes at ω = 0.
Eigen::MatrixXd vanishing_at_rest(const std::vector<Pole>& poles);

/// As many samples with fewer columns, the same to every least-squares fit with common poles up to `relative` of the
/// largest.
Samples compressed(const Samples& samples, double relative);

/// At most so many columns, each a random mixture of all: sums of squares over the functions are kept in the mean, so a
/// search for poles sees all of them at the price of these.
Samples mixed(const Samples& samples, Eigen::Index most);

/// With pairs added where most is `missed`, a sum of squares at each of `omega`, until there are `order` states.
std::vector<Pole> grown(std::vector<Pole> poles, int order, const std::vector<double>& omega, Eigen::VectorXd missed);

/// Lightly damped pairs, evenly over the frequencies, of an even number of states.
std::vector<Pole> spread(const std::vector<double>& omega, int order);

/// Stable poles that the functions share, moved from these by so many rounds of relaxed vector fitting, in order of
/// frequency. None decays more slowly than `slowest`.
std::vector<Pole> settled(const Samples& samples, std::vector<Pole> poles, int rounds, double slowest);

}  // namespace hydro::radiation::detail
