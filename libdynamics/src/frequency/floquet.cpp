#include "dynamics/frequency/floquet.hpp"

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <vector>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::frequency {

// (Q9)
Eigen::MatrixXd monodromy(const PeriodicMatrix& a, double period_s, double tolerance) {
  namespace odeint = boost::numeric::odeint;
  hydro::require(std::isfinite(period_s) && period_s > 0, "a period must be positive, got {} s", period_s);
  const Eigen::MatrixXd at_start = a(0);
  const Eigen::Index n = at_start.rows();
  hydro::require(n > 0 && at_start.cols() == n && at_start.allFinite(),
                 "the matrix of a periodic system must be square and finite, got {} x {}", n, at_start.cols());
  using Columns = std::vector<double>;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  Columns x(identity.data(), identity.data() + n * n);
  const auto rate = [&](const Columns& from, Columns& out, double t) {
    Eigen::Map<Eigen::MatrixXd>(out.data(), n, n) = a(t) * Eigen::Map<const Eigen::MatrixXd>(from.data(), n, n);
  };
  odeint::integrate_adaptive(odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<Columns>()),
                             rate, x, 0.0, period_s, period_s / 64);
  const Eigen::MatrixXd out = Eigen::Map<const Eigen::MatrixXd>(x.data(), n, n);
  if (!out.allFinite())
    throw hydro::NumericsError(
        fmt::format("a motion leaves the range of doubles within a period of {:.6g} s", period_s));
  return out;
}

Eigen::VectorXcd floquet_multipliers(const PeriodicMatrix& a, double period_s, double tolerance) {
  Eigen::VectorXcd out = hydro::dense::eigenvalues(monodromy(a, period_s, tolerance));
  std::sort(out.begin(), out.end(), [](const auto& x, const auto& y) { return std::abs(x) > std::abs(y); });
  return out;
}

}  // namespace dynamics::frequency
