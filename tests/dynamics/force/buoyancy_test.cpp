// Exact buoyancy as a load: at rest, for small motions, and in large free rolling.
#include "dynamics/force/buoyancy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/gravity.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/hydrostatics/stability.hpp"
#include "support/hull_meshes.hpp"

namespace buoyancy_test {
namespace {

using namespace dynamics;
namespace hh = hydro::hydrostatics;
using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

const hydro::Water water{.density = 1000, .gravity = 9.81};

/// A barge of 10 m × 4 m × 2 m with a draught of 0.8 m, drawn about the middle of its bottom; origin at z = −0.8 m.
const Eigen::Vector3d cog(0, 0, 1.1);
constexpr double draught = 0.8, mass = 1000 * 10 * 4 * draught;
std::shared_ptr<const FloatingShape> barge(double top = 2) {
  return std::make_shared<const FloatingShape>(hh::Hull(support::box_mesh({-5, -2, 0}, {5, 2, top})));
}
std::vector<RigidBody> floating() {
  return {RigidBody({.name = "barge",
                     .mass = mass,
                     .inertia = Eigen::Vector3d(mass * 1.6, mass * 9, mass * 9.5).asDiagonal(),
                     .rest_position = {Eigen::Vector3d(3, 1, -draught)},
                     .centre_of_gravity = {cog}})};
}
Model afloat() {
  auto bodies = floating();
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, water.gravity));
  forces.push_back(std::make_unique<BuoyancyKind>(bodies, std::vector<Buoyancy>{{0, barge()}}, water));
  return Model(std::move(bodies), {}, std::move(forces));
}

TEST(Buoyancy, CarriesTheWeightOfABodyThatFloatsAsPlaced) {
  EXPECT_LT(afloat().linear_at_rest().unbalanced.norm(), 1e-12 * mass * 9.81 * 10);  // round-off of the integrals
}

TEST(Buoyancy, WithWeightIsForSmallMotionsTheRestoringMatrixOfTheHull) {
  const hh::Hull hull = std::get<hh::Hull>(*barge());
  const hh::Pose placed{.position = {3, 1, -draught}};
  const Eigen::Vector3d G = placed * cog;
  const hh::Matrix6 C =
      hh::buoyancy_stiffness(hh::immersion(hull, placed), water, G) + hh::gravity_stiffness(mass * 9.81, G, G);
  const auto linear = afloat().linear_at_rest();
  EXPECT_LT((linear.stiffness - C).norm(), 1e-12 * C.norm());
  EXPECT_EQ(linear.damping.norm(), 0);
  EXPECT_NEAR(C(3, 3), mass * 9.81 * (16 / (12 * draught) + draught / 2 - cog.z()), 1e-9 * C.norm());  // W·GM
}

/// Free rolling from `heel` for `seconds`; the largest residual of energy over what is turned over, and the period.
struct Rolling {
  double residual, period;
};
Rolling roll(double heel, double h, double seconds) {
  const Model model = afloat();
  State start = rest_state(model.bodies());
  start.pose[0].attitude = rotation_exp({heel, 0, 0});
  Workspace w(model, start);
  GeneralizedAlpha integrator(model, {.rho_infinity = 1});
  integrator.start(w);
  EnergyLedger ledger(model, w);
  Rolling out{0, 0};
  double before = heel, first = 0, last = 0;
  int crossings = 0;
  for (double t = 0; t < seconds; t += h) {
    integrator.step(w, h);
    ledger.note(w);
    out.residual = std::max(out.residual, std::abs(ledger.residual()) / ledger.turnover());
    const double now = rotation_log(w.state.pose[0].attitude).x();
    if (before > 0 && now <= 0) {
      last = t + h * before / (before - now);
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  out.period = (last - first) / (crossings - 1);
  return out;
}

TEST(Buoyancy, ConservesEnergyInALargeFreeRollToTheErrorOfTheStep) {
  // From 40° the deck edge (31° of tan φ = 2·1.2/4) and the bilge go under and out: the residual is that of the step,
  // which falls with its square until kinks of the righting arm show; a quarter, with a third of margin.
  const double coarse = roll(40 * pi / 180, 0.02, 20).residual, fine = roll(40 * pi / 180, 0.01, 20).residual;
  EXPECT_LT(coarse, 2e-3);
  EXPECT_LT(fine, coarse / 3);
}

TEST(Buoyancy, RollsSlowlyAtThePeriodOfTheMetacentre) {
  // About G: I φ̈ + W GM φ = 0, roll and sway do not couple without added mass. 1°: the arm differs from GM φ by
  // (1 + BM/(2 GM)) φ²/…: 4e-4, the period by less than half of it; and (ωh)²/12 of the step.
  const double GM = 16 / (12 * draught) + draught / 2 - cog.z();
  EXPECT_NEAR(roll(pi / 180, 0.01, 30).period, 2 * pi * std::sqrt(1.6 / (9.81 * GM)), 4e-4 * 3);
}

TEST(Buoyancy, EndsTheModelWhereWaterComesInThroughAnOpening) {
  hh::TriangleMesh open = support::box_mesh({-5, -2, 0}, {5, 2, 1});
  std::erase_if(open.triangles, [&](const auto& t) {  // the deck
    return std::all_of(t.begin(), t.end(), [&](int v) { return open.vertices[static_cast<std::size_t>(v)].z() == 1; });
  });
  const auto shape = std::make_shared<const FloatingShape>(hh::Hull(open));
  const auto bodies = floating();
  const BuoyancyKind kind(bodies, {{0, shape}}, water);
  State state = rest_state(bodies);
  state.time = 7.5;
  state.pose[0].attitude = rotation_exp({0.3, 0, 0});
  Eigen::VectorXd F = Eigen::VectorXd::Zero(6);
  LoadSink sink(F);
  EXPECT_THAT(
      [&] {
        kind.add_load({state, nullptr}, sink);
      },
      ThrowsMessage<hydro::NumericsError>(testing::AllOf(HasSubstr("barge at 7.5 s"), HasSubstr("opening"))));
  auto sunk = floating();
  sunk[0] = RigidBody({.name = "sunk",
                       .mass = mass,
                       .inertia = Eigen::Matrix3d::Identity(),
                       .rest_position = {Eigen::Vector3d(0, 0, -1.1)}});
  EXPECT_THROW(BuoyancyKind(sunk, {{0, shape}}, water), hydro::InputError);
}

}  // namespace
}  // namespace buoyancy_test
