#include "impact.hpp"

#include <algorithm>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

/// One contact given the impulses of the others: the normal first, then what friction can hold of the slip.
void relax(const ImpactLaw& law, const Eigen::MatrixXd& W, const Eigen::VectorXd& before, Eigen::VectorXd& z) {
  const Eigen::Index n = law.row;
  const double wanted = -law.restitution * std::min(before[n], 0.0);
  const double speed = before[n] + W.row(n).dot(z);
  if (W(n, n) > 0) z[n] = std::max(0.0, z[n] - (speed - wanted) / W(n, n));
  if (law.friction == 0) return;
  const double mobility = std::max(W(n + 1, n + 1), W(n + 2, n + 2));
  if (!(mobility > 0)) return;
  const Eigen::Vector2d slip = before.segment<2>(n + 1) + W.middleRows<2>(n + 1) * z;
  Eigen::Vector2d held = z.segment<2>(n + 1) - slip / mobility;
  const double most = law.friction * z[n];
  if (held.norm() > most) held *= most / held.norm();
  z.segment<2>(n + 1) = held;
}

/// The least impulses that would turn all speeds as wanted and stop all slip. Where contacts are more than a body
/// needs, impulses are not unique: from here relaxation ends near those that equal contacts share evenly.
Eigen::VectorXd evenly_shared(const Eigen::MatrixXd& W, const Eigen::VectorXd& before,
                              const std::vector<ImpactLaw>& laws) {
  Eigen::VectorXd change = -before;
  for (const ImpactLaw& law : laws) change[law.row] -= law.restitution * std::min(before[law.row], 0.0);
  Eigen::VectorXd z = hydro::dense::CompleteQr(W, 1e-10).solve(change);
  for (const ImpactLaw& law : laws) z[law.row] = std::max(0.0, z[law.row]);
  return z;
}

}  // namespace

Eigen::VectorXd impulses(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const std::vector<ImpactLaw>& laws) {
  constexpr int most_sweeps = 100'000;
  constexpr double settled = 1e-15;  // of the largest speed, by each sweep
  Eigen::VectorXd z = evenly_shared(W, before, laws);
  const Eigen::VectorXd gain = W.diagonal();
  const double fastest = before.cwiseAbs().maxCoeff();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const Eigen::VectorXd was = z;
    for (const ImpactLaw& law : laws) relax(law, W, before, z);
    if ((z - was).cwiseProduct(gain).cwiseAbs().maxCoeff() <= settled * fastest) return z;
  }
  throw hydro::NumericsError(
      "the impulses of contacts that close together do not settle: too much friction, or too many "
      "contacts between the same bodies");
}

}  // namespace dynamics
