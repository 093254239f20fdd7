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
  constexpr double idle = 1e-7;  // of the largest: impulses that do less are those that rounding of places lets do it
  Eigen::VectorXd z = hydro::dense::CompleteQr(W, idle).solve(change);
  for (const ImpactLaw& law : laws) z[law.row] = std::max(0.0, z[law.row]);
  return z;
}

/// The largest of what speeds are sums of. Impulses may be large against the outcome: those that go down through a
/// stack and up again are larger than what the topmost gains.
double largest_sum(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const Eigen::VectorXd& z) {
  return (before.cwiseAbs() + W.cwiseAbs() * z.cwiseAbs()).maxCoeff();
}

/// What a round may still change of the largest sum. A sum of n products rounds 2n times, by half of ε, in the speed
/// that asks for a correction and in the next. Four corners of a rigid body that want speeds which it cannot have, by a
/// share δ, hand their loads on by δ a round until one of them is left without: what is so small that this takes for
/// ever is left, first what counts as no speed at all (1e-9), then what no coefficient of restitution is known to.
/// Friction that hands loads round among corners does so too.
double enough(int sweep, Eigen::Index size) {
  if (sweep < 1000) return 2 * static_cast<double>(size) * std::numeric_limits<double>::epsilon();
  if (sweep < 10'000) return 1e-9;
  return sweep < 20'000 ? 1e-6 : 1e-5;
}

}  // namespace

double relax(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const std::vector<ImpactLaw>& laws,
             Eigen::VectorXd& z, int most) {
  const Eigen::VectorXd gain = W.diagonal();
  z = evenly_shared(W, before, laws);
  double change = 0;
  for (int sweep = 0; sweep < most; ++sweep) {
    const Eigen::VectorXd was = z;
    for (const ImpactLaw& law : laws) relax(law, W, before, z);
    change = (z - was).cwiseProduct(gain).cwiseAbs().maxCoeff() / largest_sum(W, before, z);
    if (!(change > enough(sweep, before.size()))) return 0;
  }
  return change;
}

Eigen::VectorXd impulses(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const std::vector<ImpactLaw>& laws) {
  constexpr int most = 100'000;
  Eigen::VectorXd z;
  if (const double change = relax(W, before, laws, z, most); change > 0)
    throw hydro::NumericsError(
        fmt::format("the impulses of {} contacts that close together do not settle: after {} rounds speeds still "
                    "change by {:.3g} of what they are",
                    laws.size(), most, change));
  return z;
}

}  // namespace dynamics
