#include "dynamics/integrate/generalized_alpha.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "hydro/base/error.hpp"
#include "support/force_law_models.hpp"

namespace generalized_alpha_test {
namespace {

using namespace dynamics;

RigidBody top() {
  return RigidBody({.name = "top", .mass = 2, .inertia = Eigen::Vector3d(1.0, 2.0, 2.5).asDiagonal()});
}

std::unique_ptr<const ForceKind> spring(const std::vector<RigidBody>& bodies, double k, double c = 0) {
  return std::make_unique<RestoringKind>("mooring", bodies,
                                         std::vector<Restoring>{{0, k * Matrix6::Identity(), c * Matrix6::Identity()}});
}

Model sprung_model(double k, double c = 0) {
  std::vector<RigidBody> bodies{top()};
  std::vector<std::unique_ptr<const ForceKind>> f;
  f.push_back(spring(bodies, k, c));
  return Model(bodies, {}, std::move(f));
}

State integrate(const Model& model, State start, double h, int steps, double rho) {
  Workspace w(model, std::move(start));
  GeneralizedAlpha integrator(model, {.rho_infinity = rho});
  integrator.start(w);
  for (int i = 0; i < steps; ++i) integrator.step(w, h);
  return w.state;
}

// m x″ + c x′ + k x = 0 from x = 1: closed form.
TEST(GeneralizedAlpha, FollowsADampedOscillator) {
  const double k = 8, c = 0.4, m = 2, zeta = c / (2 * std::sqrt(k * m)), w0 = std::sqrt(k / m),
               wd = w0 * std::sqrt(1 - zeta * zeta);
  const Model model = sprung_model(k, c);
  State start = rest_state(model.bodies());
  start.pose[0].centre.z() = 1;
  const double t = 5;
  const double exact = std::exp(-zeta * w0 * t) * (std::cos(wd * t) + zeta * w0 / wd * std::sin(wd * t));
  // Period error (ωh)²/12 at ρ∞ = 1: 3.3e-5 at h = 0.01, times the ten radians passed.
  EXPECT_NEAR(integrate(model, start, 0.01, 500, 1).pose[0].centre.z(), exact, 4e-4);
}

TEST(GeneralizedAlpha, IsOfSecondOrderInTranslationAndRotation) {
  const Model model = sprung_model(8, 0.4);
  State start = rest_state(model.bodies());
  start.pose[0].centre = Eigen::Vector3d(1, -0.5, 0.2);
  start.pose[0].attitude = rotation_exp(Eigen::Vector3d(0.8, 0.3, -0.5));
  start.velocity << 0, 1, 0, 2, -1, 0.5;
  for (const double rho : {0.0, 0.5, 0.8, 1.0}) {
    const auto at = [&](double h) {
      const State s = integrate(model, start, h, static_cast<int>(std::lround(2 / h)), rho);
      Eigen::VectorXd x(6);
      x << s.pose[0].centre, rotation_log(s.pose[0].attitude);
      return x;
    };
    const Eigen::VectorXd coarse = at(0.02), middle = at(0.01), fine = at(0.005);
    const double order = std::log2((coarse - middle).norm() / (middle - fine).norm());
    EXPECT_NEAR(order, 2, 0.1) << "rho " << rho;  // the next term of the error is smaller by about h
  }
}

// A free body turning about no principal axis: angular momentum is constant in space, and kinetic energy too.
TEST(GeneralizedAlpha, KeepsTheMomentumOfAFreeTop) {
  const Model model({top()}, {}, {});
  State start = rest_state(model.bodies());
  start.velocity << 0.3, 0, 0, 1.0, 2.0, 0.5;
  const auto momentum = [&](const State& s) { return Eigen::Vector3d(model.mass_times(s, s.velocity).tail<3>()); };
  const auto drift = [&](double h) {
    const State end = integrate(model, start, h, static_cast<int>(std::lround(10 / h)), 1);
    EXPECT_NEAR(end.pose[0].centre.x(), 3, 1e-10);
    return (momentum(end) - momentum(start)).norm() / momentum(start).norm();
  };
  const double coarse = drift(0.02), fine = drift(0.01);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.6);  // second order
}

TEST(GeneralizedAlpha, DampsAnUnresolvedOscillationByRhoInfinityEachStep) {
  const Model model = sprung_model(2e10);  // 1e5 rad/s, h = 0.1: ωh = 1e4
  State start = rest_state(model.bodies());
  start.pose[0].centre.x() = 1e-3;
  Workspace w(model, start);
  GeneralizedAlpha integrator(model, {.rho_infinity = 0.5});
  integrator.start(w);
  for (int i = 0; i < 40; ++i) integrator.step(w, 0.1);
  EXPECT_LT(std::abs(w.state.pose[0].centre.x()), 1e-3 * 40 * 40 * std::pow(0.5, 37));  // a triple root: n² ρⁿ⁻²
}

TEST(GeneralizedAlpha, SolvesALinearProblemInOneIteration) {
  const Model model = sprung_model(8);
  State start = rest_state(model.bodies());
  start.pose[0].centre.x() = 0.5;
  Workspace w(model, start);
  GeneralizedAlpha integrator(model, {});
  integrator.start(w);
  for (int i = 0; i < 5; ++i)
    EXPECT_LE(integrator.step(w, 0.05).newton_iterations, 2);  // the second one sees that it is done
}

/// Pushes with a force that no step can resolve, or that is not a number.
class Wall final : public ForceKind {
 public:
  explicit Wall(double from) : from_(from) {}
  std::string effect() const override { return "wall"; }
  std::size_t elements() const override { return 1; }
  std::string method() const override { return "not a number beyond a place"; }
  void add_load(const Instant& now, LoadSink& out) const override {
    Vector6 f = Vector6::Zero();
    if (now.state.pose[0].centre.x() > from_) f[0] = std::nan("");
    out.add(0, f);
  }
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant&) const override { return {}; }

 private:
  double from_;
};

TEST(GeneralizedAlpha, StopsWithAReasonAndTheLastGoodState) {
  std::vector<RigidBody> bodies{top()};
  std::vector<std::unique_ptr<const ForceKind>> f;
  f.push_back(std::make_unique<Wall>(0.5));
  const Model model(bodies, {}, std::move(f));
  State start = rest_state(bodies);
  start.velocity[0] = 1;
  Workspace w(model, start);
  GeneralizedAlpha integrator(model, {});
  integrator.start(w);
  EXPECT_THAT(
      [&] {
        for (int i = 0; i < 10; ++i) integrator.step(w, 0.1);
      },
      testing::ThrowsMessage<hydro::NumericsError>(
          testing::AllOf(testing::HasSubstr("cannot go on from t = 0.5"), testing::HasSubstr("not finite"))));
  EXPECT_TRUE(w.state.velocity.allFinite());
  EXPECT_LE(w.state.pose[0].centre.x(), 0.5);
}

TEST(EnergyLedger, ClosesForASwingingDampedPair) {
  const auto bodies = support::two_bodies();
  const auto residual = [&](double h) {
    std::vector<std::unique_ptr<const ForceKind>> f;
    const Matrix6 C = 4000 * Matrix6::Identity();
    f.push_back(std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, C, 0.02 * C}, {1, C}}));
    f.push_back(std::make_unique<AxialConnectorKind>(
        std::vector<AxialConnector>{{{{0, {1, 0.5, 0}}, PointOnBody{1, {-1, 0.5, 0}}}, {2500, 100}, 2}}));
    const Model model(bodies, {}, std::move(f));
    State start = rest_state(bodies);
    start.pose[0].centre.x() += 0.4;
    start.pose[1].attitude = rotation_exp(Eigen::Vector3d(0.3, 0.4, 0.2));
    Workspace w(model, start);
    GeneralizedAlpha integrator(model, {.rho_infinity = 1});
    integrator.start(w);
    EnergyLedger ledger(model, w);
    for (int i = 0; i < static_cast<int>(std::lround(4 / h)); ++i) {
      integrator.step(w, h);
      ledger.note(w);
    }
    EXPECT_GT(ledger.turnover(), 100);
    return std::abs(ledger.residual()) / ledger.turnover();
  };
  const double coarse = residual(0.02), fine = residual(0.01);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.7);  // second order; a single number may pass near a zero of the error
}

}  // namespace
}  // namespace generalized_alpha_test
