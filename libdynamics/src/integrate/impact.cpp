#include "impact.hpp"

#include <algorithm>
#include <limits>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

/// One that slides already: friction goes with the normal, z_t = −μ z_n s.
void relax_sliding(const ImpactLaw& law, const Eigen::MatrixXd& W, const Eigen::VectorXd& before, Eigen::VectorXd& z) {
  const Eigen::Index n = law.row;
  const double coupled = W(n, n) - law.friction * W.row(n).segment<2>(n + 1).dot(*law.slip);
  const double gain = coupled > 0 ? coupled : W(n, n);
  if (gain > 0) z[n] = std::max(0.0, z[n] - (before[n] + W.row(n).dot(z)) / gain);
  z.segment<2>(n + 1) = -law.friction * z[n] * *law.slip;
}

/// One contact given the impulses of the others: the normal first, then what friction can hold of the slip.
void relax(const ImpactLaw& law, const Eigen::MatrixXd& W, const Eigen::VectorXd& before, Eigen::VectorXd& z) {
  if (law.slip) return relax_sliding(law, W, before, z);
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

/// To what each speed is known: the rounding of the sum that it is. Impulses may be large against it: those that go
/// down through a stack and up again are larger than what the topmost gains.
double rounding(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const Eigen::VectorXd& z) {
  constexpr double roundings = 4;  // of products, sums, and of the share of an impulse that a correction is
  const Eigen::VectorXd summed = before.cwiseAbs() + W.cwiseAbs() * z.cwiseAbs();
  return roundings * std::numeric_limits<double>::epsilon() * summed.maxCoeff();
}

}  // namespace

Eigen::VectorXd impulses(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const std::vector<ImpactLaw>& laws) {
  constexpr int most_sweeps = 100'000;
  Eigen::VectorXd z = evenly_shared(W, before, laws);
  const Eigen::VectorXd gain = W.diagonal();
  double change = 0;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const Eigen::VectorXd was = z;
    for (const ImpactLaw& law : laws) relax(law, W, before, z);
    change = (z - was).cwiseProduct(gain).cwiseAbs().maxCoeff();
    if (change <= rounding(W, before, z)) return z;
  }
  throw hydro::NumericsError(fmt::format(
      "what {} contacts do together does not settle: after {} rounds speeds still change by {:.3g} of {:.3g} m/s",
      laws.size(), most_sweeps, change, before.cwiseAbs().maxCoeff()));
}

}  // namespace dynamics
