// What acts one way only, against steps that do not resolve it. (D132)
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/pto.hpp"
#include "support/motion.hpp"

namespace snap_test {
namespace {

using namespace dynamics;
using Eigen::Vector3d;
using support::Motion;
constexpr double g = 9.81, omega = 50, fall = 0.3;

std::vector<RigidBody> bob(double mass) {
  return {RigidBody({.name = "bob",
                     .mass = mass,
                     .inertia = Eigen::Matrix3d::Identity(),
                     .free = {false, false, true, false, false, false}})};
}

/// A bob that falls by 0.3 m until a cable holds it.
Model on_cable(double mass) {
  auto bodies = bob(mass);
  std::vector<AxialConnector> cable{{.ends = {{0, {0, 0, 0}}, PointOnGround{{0, 0, 5}}},
                                     .law = {.stiffness = mass * omega * omega, .tension_only = true},
                                     .rest_length = 5 + fall}};
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, g));
  forces.push_back(std::make_unique<AxialConnectorKind>(std::move(cable)));
  return Model(std::move(bodies), {}, std::move(forces));
}

/// The same bob on a slider with a stop under it.
Model on_stop(double mass) {
  auto bodies = bob(mass);
  const Joint slider{"slide", JointKind::slider, 0, {}, {0, 0, 0}, {0, 0, 1}};
  // The coordinate is that of the ground against the bob: up where it falls.
  const PtoLaw law{.line = {}, .lower = {}, .upper = EndStop{fall, mass * omega * omega, 0}};
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, g));
  forces.push_back(std::make_unique<PtoKind>(std::vector<Pto>{{JointCoordinate(bodies, slider), law}}));
  return Model(std::move(bodies), {}, std::move(forces), {slider});
}

double energy(const Model& model, Motion& run) {
  Workspace& w = run.workspace;
  double sum = model.kinetic_energy(w.state) + model.bodies()[0].mass() * g * w.state.pose[0].centre.z();
  sum += model.forces()[1]->energy(w.instant(w.state, 1)).stored;
  return sum;
}

/// The largest rise of energy over the start, in units of what the fall gives, and the largest depth below the end of
/// the fall.
std::pair<double, double> bounces(const Model& model, double ratio, double rho) {
  Motion run(model, rest_state(model.bodies()), rho);
  const double start = energy(model, run), fallen = model.bodies()[0].mass() * g * fall;
  double most = 0, deepest = 0;
  for (int i = 0; i < std::min(20000, static_cast<int>(20 * omega / ratio)); ++i) {
    run.go(ratio / omega, 1);
    most = std::max(most, (energy(model, run) - start) / fallen);
    deepest = std::max(deepest, -run.workspace.state.pose[0].centre.z() - fall);
  }
  return {most, deepest};
}

// Up to steps of half a second, in which the bob falls by a metre.
TEST(Cable, GainsNoEnergyAtAnyStepWithoutMemory) {
  for (int i = 0; i < 40; ++i) {
    const double ratio = std::pow(10, -1 + 2.4 * i / 39);
    EXPECT_LE(bounces(on_cable(2), ratio, 0).first, 1e-9) << "omega h = " << ratio;
    EXPECT_LE(bounces(on_stop(2), ratio, 0).first, 1e-9) << "a stop, omega h = " << ratio;
  }
  EXPECT_GT(bounces(on_cable(2), 5, 0.8).first, 1) << "what scenes are kept from";
}

// v²= 2 g fall; then down by (g + √(g² + ω² v²))/ω² against the spring. ρ∞ = 0 is short of it by some (ωh)².
TEST(Cable, SnapsAsAnOscillatorThatIsResolved) {
  const double depth = (g + std::sqrt(g * g + omega * omega * 2 * g * fall)) / (omega * omega);
  for (const double mass : {0.1, 10.0, 1e4})
    for (const double ratio : {0.2, 0.1, 0.05})
      EXPECT_NEAR(bounces(on_cable(mass), ratio, 0).second, depth, ratio * ratio * depth) << mass << ' ' << ratio;
}

}  // namespace
}  // namespace snap_test
