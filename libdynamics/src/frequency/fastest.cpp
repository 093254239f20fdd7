#include "dynamics/frequency/fastest.hpp"

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace dynamics::frequency {
namespace {

/// [M Gᵀ; G 0] factored, and K, about a state at rest.
class FreeSystem {
 public:
  FreeSystem(const Model& model, State at_rest)
      : model_(model),
        at_rest_(std::move(at_rest)),
        mass_(model.pattern()),
        stiffness_(model.pattern()),
        solver_(model.pattern(), model.joints()) {
    model_.add_mass(at_rest_, 1, mass_);
    for (int m = 0; m < model_.modes(); ++m)
      if (!model_.is_free(m)) hold(m, mass_);
    gradients_ = model_.joints().gradients(at_rest_);
    if (!solver_.factorise(mass_, gradients_, gradients_, Eigen::VectorXd::Zero(model_.joints().count())))
      throw hydro::NumericsError("the masses of the bodies with their joints cannot be factored");
    began_ = solver_.solve(load(), Eigen::VectorXd::Zero(model_.joints().count()));
    JacobianSink sink(stiffness_, 1, 0);
    for (const auto& kind : model_.forces())
      if (kind->linear_at_rest()) kind->add_jacobian({at_rest_, nullptr}, sink);
    model_.joints().add_curvature(at_rest_, began_.lambda, 1, stiffness_);
  }

  /// The accelerations with which the bodies begin.
  const Eigen::VectorXd& began() const { return began_.x; }
  /// (M⁻¹ K) x in the motions that joints leave.
  Eigen::VectorXd restored(const Eigen::VectorXd& x) const {
    return solver_.solve(kept(stiffness_ * x), Eigen::VectorXd::Zero(model_.joints().count())).x;
  }
  double size(const Eigen::VectorXd& x) const { return std::sqrt(std::max(0.0, x.dot(mass_ * x))); }
  Eigen::VectorXd kept(Eigen::VectorXd x) const {
    for (int m = 0; m < model_.modes(); ++m)
      if (!model_.is_free(m)) x[m] = 0;
    return x;
  }
  int most_moving(const Eigen::VectorXd& x) const {
    Eigen::Index most = 0;
    double largest = -1;
    for (Eigen::Index m = 0; m < x.size(); ++m) {
      const int body = static_cast<int>(m / 6);
      const double weight = std::sqrt(mass_.block(body, body)(m % 6, m % 6)) * std::abs(x[m]);
      if (weight > largest) largest = weight, most = m;
    }
    return static_cast<int>(most);
  }

 private:
  void hold(int m, BlockMatrix& matrix) const {
    for (const int j : model_.pattern().columns(m / 6)) {
      matrix.block(m / 6, j).row(m % 6).setZero();
      matrix.block(j, m / 6).col(m % 6).setZero();
    }
    matrix.block(m / 6, m / 6)(m % 6, m % 6) = 1;
  }
  Eigen::VectorXd load() const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(model_.modes());
    LoadSink sink(out);
    for (const auto& kind : model_.forces())
      if (kind->linear_at_rest()) kind->add_load({at_rest_, nullptr}, sink);
    return kept(std::move(out));
  }

  const Model& model_;
  State at_rest_;
  BlockMatrix mass_, stiffness_;
  std::vector<Gradient> gradients_;
  KktSolver solver_;
  KktSolver::Solution began_;
};

/// Of M⁻¹K by powers: the growth of a motion from one to the next comes to |λ| of the largest from below.
FastestMotion fastest_restored(const FreeSystem& system, const Model& model) {
  constexpr int most = 300;
  constexpr double settled = 1e-4;  // a growth that changes by less is within a per cent or two of its limit
  const hydro::RandomStream random(1, 0);
  Eigen::VectorXd x(model.modes());
  for (Eigen::Index m = 0; m < x.size(); ++m) x[m] = random.normal(static_cast<std::uint64_t>(m));
  x = system.kept(std::move(x));
  double growth = 0;
  for (int i = 0; i < most; ++i) {
    x = system.restored(x);
    const double now = system.size(x);
    if (!(now > 0)) return {};
    x /= now;
    const bool ends = i > 5 && std::abs(now - growth) < settled * now;
    growth = now;
    if (ends) break;
  }
  return {std::sqrt(growth), system.most_moving(x)};
}

}  // namespace

FastestMotion fastest_motion(const Model& model, const State& about) {
  State at_rest = about;
  at_rest.velocity.setZero();
  const FreeSystem system(model, std::move(at_rest));
  FastestMotion out = fastest_restored(system, model);
  for (int body = 0; body < static_cast<int>(model.bodies().size()); ++body) {
    Eigen::Index axis = 0;
    const double turning = std::sqrt(system.began().segment<3>(6 * body + 3).cwiseAbs().maxCoeff(&axis));
    if (turning > out.omega) out = {turning, 6 * body + 3 + static_cast<int>(axis)};
  }
  return out;
}

}  // namespace dynamics::frequency
