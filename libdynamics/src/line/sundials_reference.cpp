#include "dynamics/line/sundials_reference.hpp"

#include <fmt/format.h>

#include "hydro/base/error.hpp"
#include "time/cvode.hpp"

namespace dynamics::line {

void run_by_sundials(const Line& line, State& state, double duration, double tolerance) {
  hydro::require(tolerance > 0, "the tolerance of a run must be positive, got {}", tolerance);
  Stepper balances(line, {});
  balances.start(state);
  const Eigen::Index n = state.position.size();
  const auto put = [&](const auto& y, double t, State& out) {
    out.position = y.head(n).reshaped(3, n / 3);
    out.velocity = y.tail(n).reshaped(3, n / 3);
    out.time = t;
  };
  const double begin = state.time;
  State there = state;
  const auto rates = [&](double t, Eigen::Map<Eigen::VectorXd> y, Eigen::Map<Eigen::VectorXd> dy) {
    put(y, begin + t, there);
    const auto balance = balances.balance(there);
    if (!balance || !balance->acceleration.allFinite()) return false;
    dy << y.tail(n), balance->acceleration.reshaped();
    return true;
  };
  Eigen::VectorXd y(2 * n);
  y << state.position.reshaped(), state.velocity.reshaped();
  detail::Cvode solver(2 * n);
  const auto outcome = solver.run(rates, y, Eigen::VectorXd::Constant(2 * n, tolerance), duration);
  if (!outcome.good)
    throw hydro::NumericsError(fmt::format("CVODE gives up after {:.3g} s of {:.6g} s", outcome.reached, duration));
  put(y, begin + duration, state);
  balances.go_on(state);
}

}  // namespace dynamics::line
