#include <gtest/gtest.h>

#include "dynamics/force/buoyancy.hpp"
#include "dynamics/force/connector.hpp"
#include "dynamics/force/drag.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/hydrostatics.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/force/switched_connector.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "hydro/radiation/constant_memory.hpp"
#include "hydro/radiation/convolution.hpp"
#include "hydro/radiation/partitioned.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "laws/force_kind_laws.hpp"
#include "support/hull_meshes.hpp"
#include "support/two_pole_body.hpp"

namespace force_laws_test {
namespace {

using namespace dynamics;
const auto bodies = support::two_bodies();

Matrix6 random_spd(std::uint64_t seed) {
  const hydro::RandomStream random(seed, 5);
  std::uint64_t n = 0;
  const Matrix6 m = Matrix6::NullaryExpr([&] { return random.normal(n++); });
  return 100 * m * m.transpose();
}

TEST(ForceLaws, HoldForRestoring) {
  laws::expect_force_laws(RestoringKind("mooring", bodies,
                                        {{0, random_spd(1), random_spd(2)},
                                         {1, random_spd(3), random_spd(6), Eigen::Vector3d(0.7, -0.4, 1.1)}}),
                          bodies);
}

TEST(ForceLaws, HoldForHydrostatics) {
  const Eigen::Matrix3d C = random_spd(4).topLeftCorner<3, 3>(), D = random_spd(5).topLeftCorner<3, 3>();
  laws::expect_force_laws(HydrostaticsKind(bodies, {{0, C}, {1, D, 700, Eigen::Vector2d(300, -200)}}), bodies);
}

TEST(ForceLaws, HoldForWeight) {
  laws::expect_force_laws(GravityKind(bodies, 9.81), bodies);
  laws::expect_force_laws(GravityKind(bodies, 9.81, {1}), bodies);
}

TEST(ForceLaws, HoldForBuoyancy) {
  namespace hh = hydro::hydrostatics;
  const auto shape = [](FloatingShape s) { return std::make_shared<const FloatingShape>(std::move(s)); };
  const BuoyancyKind kind(bodies,
                          {{0, shape(hh::Hull(support::box_mesh({-1, -0.5, -0.6}, {1.2, 0.6, 0.5})))},
                           {1, shape(hh::CircularCylinder{{0.2, 0, -0.7}, {0.1, 0, 0.9}, 0.6})},
                           {1, shape(hh::Sphere{{-0.9, 0.3, -0.2}, 0.5})}},
                          hydro::Water{.density = 1000, .gravity = 9.81});
  laws::expect_force_laws(kind, bodies);
}

TEST(Weight, ActsOnTheBodiesThatFeelItAlone) {
  const Eigen::VectorXd F = laws::load(GravityKind(bodies, 9.81, {1}), rest_state(bodies), nullptr);
  EXPECT_EQ(F, -900 * 9.81 * Eigen::VectorXd::Unit(12, 8));
}

TEST(ForceLaws, HoldForAxialConnectors) {
  const Ends between{{0, Eigen::Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Eigen::Vector3d(-1, 0.5, -0.1)}};
  const Ends to_ground{{1, Eigen::Vector3d(1, 0, 0)}, PointOnGround{Eigen::Vector3d(9, 1, -2)}};
  laws::expect_force_laws(AxialConnectorKind({{between, {3000, 200}, 1.5}, {to_ground, {500, 0}, 2}}), bodies);
}

TEST(ForceLaws, HoldForConnectorsThatAControllerSets) {
  const Ends between{{0, Eigen::Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Eigen::Vector3d(-1, 0.5, -0.1)}};
  laws::expect_force_laws(SwitchedConnectorKind({SwitchedConnectors{{between, {3000, 200}, 1.5}}}), bodies);
}

TEST(ForceLaws, HoldForBushings) {
  const Ends between{{0, Eigen::Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Eigen::Vector3d(-1, 0.5, -0.1)}};
  const Ends to_ground{{1, Eigen::Vector3d(1, 0, 0)}, PointOnGround{Eigen::Vector3d(5.5, 0, 0.3)}};
  const Eigen::Vector3d k(1000, 2000, 500), c(30, 10, 60), kr(300, 200, 100), cr(5, 8, 3);
  laws::expect_force_laws(BushingConnectorKind({{between, k, c, kr, cr, Eigen::Vector3d(2, 0, 0)},
                                                {to_ground, k, c, kr, cr, Eigen::Vector3d(0.4, 0, 0)}}),
                          bodies);
}

TEST(ForceLaws, HoldForDragInMovingAndStillWater) {
  const auto pieces =
      drag_pieces(bodies, 1, Eigen::Vector3d(-1, 0.3, -2), Eigen::Vector3d(1, -0.2, -0.5), 0.4, 1.1, 1025);
  ASSERT_EQ(pieces.size(), 3u);
  laws::expect_force_laws(DragKind(pieces, std::nullopt), bodies);
  laws::expect_force_laws(DragKind(pieces, support::TwoWaves(9).signals()), bodies);
}

TEST(ForceLaws, HoldForExcitation) {
  laws::expect_force_laws(ExcitationKind({{{1, 0}, support::TwoWaves(12).signals()}}), bodies);
}

/// Every way of computing the memory of twelve modes, step 0.1 s.
std::vector<std::shared_ptr<const hydro::radiation::MemoryMethod>> memory_methods() {
  using namespace hydro::radiation;
  const support::TwoPoleBody body{};
  const auto kernel = RetardationKernel::from_damping(body.damping_table(20, 400, 12), {0.1, 5});
  return {std::make_shared<DirectConvolution>(kernel), std::make_shared<PartitionedConvolution>(kernel, 8),
          std::make_shared<PoleMemory>(body.model(12), 0.1),
          std::make_shared<ConstantMemory>(0.7 * Eigen::MatrixXd::Identity(12, 12), 1.3, 0.1)};
}

TEST(ForceLaws, HoldForEveryMemoryOfRadiationWithinAStep) {
  for (const auto& method : memory_methods()) {
    SCOPED_TRACE(method->describe());
    const RadiationKind kind({{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, method}});
    const auto memory = kind.make_memory(rest_state(bodies));
    for (int i = 1; i <= 20; ++i) {
      State s = support::random_state(bodies, static_cast<std::uint64_t>(i));
      s.time = 0.1 * i;
      memory->accept(s);
    }
    for (const double fraction : {0.0, 0.25, 1.0}) {
      State state = support::random_state(bodies, 50), other = support::random_state(bodies, 51);
      state.time = other.time = 2 + 0.1 * fraction;
      laws::expect_pure(kind, state, other, memory.get());
      laws::expect_true_jacobians(kind, state, memory.get());
      laws::expect_energy_balance(kind, state, memory.get());
    }
  }
}

// Newton's third law: what two bodies do to each other has no net force and no net moment about the origin.
TEST(ForceLaws, InternalForcesCancel) {
  const Ends between{{0, Eigen::Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Eigen::Vector3d(-1, 0.5, -0.1)}};
  const AxialConnectorKind axial({{between, {3000, 200}, 1.5}});
  const Eigen::Vector3d k(1000, 2000, 500), c(30, 10, 60), kr(300, 200, 100), cr(5, 8, 3);
  const BushingConnectorKind bushing({{between, k, c, kr, cr, Eigen::Vector3d(2, 0, 0)}});
  for (const ForceKind* kind : {static_cast<const ForceKind*>(&axial), static_cast<const ForceKind*>(&bushing)}) {
    const State s = support::random_state(bodies, 9);
    const Eigen::VectorXd F = laws::load(*kind, s, nullptr);
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
    for (int i = 0; i < 2; ++i) {
      force += F.segment<3>(6 * i);
      moment += F.segment<3>(6 * i + 3) +
                s.pose[static_cast<std::size_t>(i)].centre.cross(Eigen::Vector3d(F.segment<3>(6 * i)));
    }
    EXPECT_LT(force.norm(), 1e-12 * F.norm()) << kind->effect();
    EXPECT_LT(moment.norm(), 1e-12 * F.norm()) << kind->effect();
  }
}

}  // namespace
}  // namespace force_laws_test
