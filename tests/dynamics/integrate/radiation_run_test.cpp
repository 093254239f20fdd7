#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/restoring.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "hydro/radiation/convolution.hpp"
#include "support/two_pole_body.hpp"

namespace radiation_run_test {
namespace {

using namespace dynamics;
const support::TwoPoleBody water{};

/// A floating point that only heaves, with the memory of the two-pole body scaled by `strength`.
struct Floater {
  std::vector<RigidBody> bodies;
  Model model;
  static std::vector<RigidBody> body(double mass) {
    return {RigidBody({.name = "buoy",
                       .mass = mass,
                       .inertia = Eigen::Matrix3d::Identity(),
                       .free = {false, false, true, false, false, false}})};
  }
  static std::vector<std::unique_ptr<const ForceKind>> forces(const std::vector<RigidBody>& b, double stiffness,
                                                              double strength, double h) {
    std::vector<std::unique_ptr<const ForceKind>> f;
    f.push_back(std::make_unique<RestoringKind>("hydrostatics", b,
                                                std::vector<Restoring>{{0, stiffness * Matrix6::Identity()}}));
    auto table = water.damping_table(30, 750);
    for (auto& B : table.B) B *= strength;
    f.push_back(std::make_unique<RadiationKind>(
        std::vector<RadiationMemory>{{{2},
                                      std::make_shared<hydro::radiation::DirectConvolution>(
                                          hydro::radiation::RetardationKernel::from_damping(table, {h, 30}))}}));
    return f;
  }
  Floater(double mass, double added_mass, double stiffness, double strength, double h)
      : bodies(body(mass)),
        model(bodies, {{{0}, added_mass * Eigen::MatrixXd::Identity(6, 6)}}, forces(bodies, stiffness, strength, h)) {}
};

/// The same motion with the memory as two states: y = ∫K(t−τ)v dτ with K = e^{−at}(cos bt − a/b sin bt), by a fine
/// Runge–Kutta.
double reference_decay(double mass, double stiffness, double strength, double end) {
  const double a = water.decay, w2 = water.w2();
  // K(s) = s/((s+a)² + b²): y″ + 2a y′ + w² y = v′, so y = q′ with q″ + 2a q′ + w² q = v.
  Eigen::Vector4d x(1, 0, 0, 0);  // z, v, q, q′
  const auto rate = [&](const Eigen::Vector4d& s) {
    return Eigen::Vector4d(s[1], (-stiffness * s[0] - strength * s[3]) / mass, s[3], s[1] - 2 * a * s[3] - w2 * s[2]);
  };
  const int steps = 20000;
  const double h = end / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector4d k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2), k4 = rate(x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return x[0];
}

double decay(double mass, double added, double stiffness, double strength, double h, double end) {
  Floater f(mass, added, stiffness, strength, h);
  State start = rest_state(f.bodies);
  start.pose[0].centre.z() = 1;
  Workspace w(f.model, start);
  GeneralizedAlpha integrator(f.model, {.rho_infinity = 1});
  integrator.start(w);
  EnergyLedger ledger(f.model, w);
  for (int i = 0; i < static_cast<int>(std::lround(end / h)); ++i) {
    integrator.step(w, h);
    ledger.note(w);
  }
  EXPECT_LT(std::abs(ledger.residual()), 0.02 * ledger.turnover());
  EXPECT_GT(ledger.entries()[1].dissipated, 0);
  return w.state.pose[0].centre.z();
}

TEST(RadiationInARun, DecaysLikeTheStateSpaceOfTheSameBody) {
  for (const double end : {3.0, 7.0, 12.0})
    // Period error (ωh)²/12 and the trapezium rule: 1e-4 each at h = 0.03; the table ends at 30 rad/s: 0.4·2/30/π of
    // K(0).
    EXPECT_NEAR(decay(2, 1, 3, 1.5, 0.03, end), reference_decay(3, 3, 1.5, end), 6e-3) << end;
}

// The instantaneous part of the memory is in the Newton matrix and the added mass on the left: a light body with a
// large added mass and strong damping stays stable at a step of a third of its period.
TEST(RadiationInARun, StaysStableWithALightBodyAndALargeStep) {
  EXPECT_LT(std::abs(decay(0.1, 10, 12, 30, 0.25, 60)), 0.05);
}

/// Spoils the first evaluation at the end of one step, as a load that Newton cannot follow would.
class Stubborn final : public ForceKind {
 public:
  explicit Stubborn(double at) : at_(at) {}
  std::string effect() const override { return "stubborn"; }
  std::size_t elements() const override { return 1; }
  std::string method() const override { return "not a number, once"; }
  void add_load(const Instant& now, LoadSink& out) const override {
    Vector6 f = Vector6::Zero();
    if (!spoilt_ && std::abs(now.state.time - at_) < 1e-6) {
      spoilt_ = true;
      f[2] = std::nan("");
    }
    out.add(0, f);
  }
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant&) const override { return {}; }

 private:
  double at_;
  mutable bool spoilt_ = false;
};

TEST(RadiationInARun, AnswersAtHalfAStepAndLeavesTheMemoryWhole) {
  const double h = 0.05;
  const auto height_after = [&](double spoilt_at, int expected_halvings) {
    auto bodies = Floater::body(2);
    auto forces = Floater::forces(bodies, 3, 1.5, h);
    forces.push_back(std::make_unique<Stubborn>(spoilt_at));
    const Model model(bodies, {{{0}, Eigen::MatrixXd::Identity(6, 6)}}, std::move(forces));
    State start = rest_state(bodies);
    start.pose[0].centre.z() = 1;
    Workspace w(model, start);
    GeneralizedAlpha integrator(model, {.rho_infinity = 1});
    integrator.start(w);
    int halvings = 0;
    for (int i = 0; i < 60; ++i) halvings += integrator.step(w, h).halvings;
    EXPECT_EQ(halvings, expected_halvings);
    return w.state.pose[0].centre.z();
  };
  // One step of sixty taken as two: the local error of that step, h³ z‴/12 = 2e-5, is all that may differ.
  EXPECT_NEAR(height_after(1.05, 1), height_after(-1, 0), 5e-5);
  EXPECT_NE(height_after(1.05, 1), height_after(-1, 0));
}

}  // namespace
}  // namespace radiation_run_test
