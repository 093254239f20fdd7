#include "fit/robust.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fit/least_squares.hpp"
#include "hydro/base/error.hpp"

namespace fit {
namespace {

/// Median distance from zero over that of a Gaussian of deviation 1.
double spread(const Eigen::VectorXd& e, std::vector<double>& scratch) {
  scratch.resize(static_cast<std::size_t>(e.size()));
  for (Eigen::Index j = 0; j < e.size(); ++j) scratch[static_cast<std::size_t>(j)] = std::abs(e[j]);
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  return *middle / 0.6745;
}

}  // namespace

// The gradient Jᵀψ has the derivative JᵀJ times about the share of samples inside, so one factorisation serves all
// rounds. Where such a Newton step does not bring the gradient down, the plain step (JᵀJ alone) is sure to: it bounds
// the curvature from above.
RobustFit fit_huber(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target) {  // (F39)
  constexpr double bound = 1.345;
  constexpr int rounds_of_scale = 3;  // afterwards the median hardly moves, and a fixed one lets the search settle
  const Compressed problem = compress(columns, target);
  const auto r = problem.columns.triangularView<Eigen::Upper>();
  RobustFit fit{r.solve(problem.target), target, 0, 1, 0};
  std::vector<double> scratch;
  Eigen::VectorXd e = target - columns * fit.x;
  double before = std::numeric_limits<double>::infinity();
  for (fit.rounds = 1; fit.rounds <= 100; ++fit.rounds) {
    if (fit.rounds <= rounds_of_scale) fit.deviation = spread(e, scratch);
    const double limit = bound * fit.deviation;
    fit.influence = e.cwiseMax(-limit).cwiseMin(limit);
    fit.share_inside = static_cast<double>((e.array().abs() < limit).count()) / static_cast<double>(e.size());
    if (!(limit > 0) || !(fit.share_inside > 0)) return fit;  // more than half of the residuals are zero
    const Eigen::VectorXd gradient = columns.transpose() * fit.influence;
    const Eigen::VectorXd scaled = r.transpose().solve(gradient);  // in units of one sample's error
    if (fit.rounds > rounds_of_scale && scaled.norm() <= 1e-8 * fit.deviation) return fit;
    const Eigen::VectorXd step = r.solve(scaled) / (scaled.norm() < before ? fit.share_inside : 1.0);
    before = scaled.norm();
    fit.x += step;
    e.noalias() -= columns * step;
  }
  throw hydro::NumericsError("the robust fit does not settle: more than half of the samples may be wild");
}

}  // namespace fit
