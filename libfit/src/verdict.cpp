#include "fit/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/correlated.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {

std::string why_unended(const SearchReport& search) {  // (F65)
  switch (search.outcome) {
    case SearchReport::Outcome::converged:
      return {};
    case SearchReport::Outcome::stuck:
      return fmt::format(
          "after {} iterations no step lowers the squares of the residuals, though their derivatives promise {:.2g} % "
          "less",
          search.iterations, 100 * search.promised);
    case SearchReport::Outcome::out_of_iterations:
      return fmt::format(
          "all {} of its iterations are used up, and the derivatives still promise {:.2g} % less of the squares of the "
          "residuals",
          search.iterations, 100 * search.promised);
    case SearchReport::Outcome::not_finite:
      break;
  }
  return search.why;
}

void require_ended(const SearchReport& search, const std::string& what) {
  if (!search.ended())
    throw SearchFailed(fmt::format("the search for {} has no end: {}", what, why_unended(search)), search.cost_last);
}

double allowed_ratio(double squares) {  // (F66)
  constexpr double chance = 1e-3, one_digit = 1.25;
  return one_digit * std::sqrt(hydro::signal::chi_square_quantile(1 - chance, squares) / squares);
}

StatedResiduals against_stated(const Eigen::VectorXd& residuals, double stated, double taken) {
  const auto n = static_cast<double>(residuals.size());
  const double left = n * std::clamp(1 - taken, 1 / n, 1.0), rms = residuals.norm() / std::sqrt(left);
  if (rms == 0) return {stated, rms, stated * allowed_ratio(left), left};
  const auto memory = fit_autoregression(residuals).autocovariance;
  const double rho = memory.tail(memory.size() - 1).squaredNorm() / (memory[0] * memory[0]),
               squares = std::max(1.0, left / (1 + 2 * rho));
  return {stated, rms, stated * allowed_ratio(squares), squares};
}

void withhold(Coefficient& c, const std::string& why) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  c.value.reset();
  c.standard_error = unknown;
  c.interval = c.white_interval = {-unknown, unknown};
  c.why_not = why;
}

}  // namespace fit
