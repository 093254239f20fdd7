#pragma once
/// \file  Linear systems whose coefficients come back after a period: what a period makes of their motions. (Q9),
/// docs/theory/frequency.md.
#include <Eigen/Core>

#include <functional>

namespace dynamics::frequency {

/// A(t) of ẋ = A(t) x, shape (n, n), of one period.
using PeriodicMatrix = std::function<Eigen::MatrixXd(double t_s)>;

/// The matrix that takes x(0) to x(T), shape (n, n). By an explicit pair of orders 7 and 8 whose step keeps its own
/// error below `tolerance`, of each column: jumps of A inside the period are stepped over at a cost in steps. O(n³) a
/// step. \throws hydro::InputError unless T is finite and > 0 and A(0) is square and finite; hydro::NumericsError if a
/// motion leaves the doubles within the period
Eigen::MatrixXd monodromy(const PeriodicMatrix& a, double period_s, double tolerance = 1e-13);

/// Its eigenvalues, the largest first, shape (n): motions grow if one is larger than 1, with their sign alternating
/// from period to period if it is near −1 (period doubling). Relative error some hundred times the
/// tolerance where they are apart. \throws as monodromy()
Eigen::VectorXcd floquet_multipliers(const PeriodicMatrix& a, double period_s, double tolerance = 1e-13);

/// ẋ = P(t) x + Q(t) z, ż = A z + B V(t) x: a memory with states z, whose own equation does not vary, beside what does.
struct PeriodicWithMemory {
  struct Varying {
    Eigen::MatrixXd P, Q, V;  ///< (n, n), (n, z), (m, n)
  };
  std::function<Varying(double t_s)> at;
  Eigen::MatrixXd A, B;  ///< (z, z), (z, m); both empty without a memory
};

/// The same matrix, of (x, z), shape (n + z, n + z). By Gauss's collocation of order ten, in which the states of the
/// memory are eliminated; steps are halved until the next change would be less than the tolerance of the matrix's
/// norm, as the last two changes tell, and the last is taken. Fast states of the memory cost no steps. \throws
/// hydro::InputError unless T is finite and > 0; hydro::NumericsError if 16384 steps are too few, or a motion leaves
/// the doubles
Eigen::MatrixXd monodromy(const PeriodicWithMemory& system, double period_s, double tolerance);
/// \throws as monodromy()
Eigen::VectorXcd floquet_multipliers(const PeriodicWithMemory& system, double period_s, double tolerance);

}  // namespace dynamics::frequency
