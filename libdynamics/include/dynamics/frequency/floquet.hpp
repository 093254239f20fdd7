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

}  // namespace dynamics::frequency
