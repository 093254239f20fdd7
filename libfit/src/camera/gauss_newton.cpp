#include "gauss_newton.hpp"

#include "hydro/base/dense.hpp"

namespace fit::camera {

std::optional<LeastSquares> least_squares(const FewNumbers& sought) {
  constexpr int most = 60, halvings = 20;
  constexpr double settled = 1e-6;  // of a standard deviation
  Eigen::VectorXd missed;
  Eigen::MatrixXd slope;
  if (!sought.model(missed, slope)) return std::nullopt;
  for (int round = 0; round < most; ++round) {
    const double before = missed.squaredNorm();
    const Eigen::MatrixXd information = slope.transpose() * slope;
    const hydro::dense::Cholesky normal(information);
    if (!normal) return std::nullopt;
    Eigen::VectorXd step = normal.solve(slope.transpose() * missed);
    if (step.dot(information * step) < settled * settled)
      return LeastSquares{before, normal.solve(Eigen::MatrixXd::Identity(step.size(), step.size()))};
    sought.move(step);
    // Near the end rounding keeps the sum from falling.
    for (int k = 0; !sought.model(missed, slope) || missed.squaredNorm() > before * (1 + 1e-9); ++k) {
      if (k == halvings) return std::nullopt;
      sought.move(-step / 2);
      step /= 2;
    }
  }
  return std::nullopt;
}

}  // namespace fit::camera
