// Signals of bodies, joints and of kinds that the laws of forces do not reach.
#include "dynamics/state/signal.hpp"

#include <gtest/gtest.h>

#include "dynamics/force/catenary_mooring.hpp"
#include "dynamics/force/connector.hpp"
#include "dynamics/force/contact.hpp"
#include "dynamics/force/pto.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/model/model.hpp"
#include "laws/signal_laws.hpp"
#include "support/force_law_models.hpp"

namespace signal_test {
namespace {

using namespace dynamics;
using Eigen::Vector3d;
const auto bodies = support::two_bodies();

State still(std::uint64_t seed) {
  State s = support::random_state(bodies, seed, 0.3);
  s.velocity.setZero();
  return s;
}

TEST(Signals, OfMotionsVaryAsTheyAre) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) laws::expect_true_variations(motion_signals(bodies), still(seed));
}

// Loads and angles of each kind of joint, whatever its multipliers are: a joint need not be closed for the laws.
TEST(Signals, OfJointsVaryAsTheyAre) {
  for (const JointKind kind : {JointKind::fixed, JointKind::hinge, JointKind::universal, JointKind::ball,
                               JointKind::slider, JointKind::planar}) {
    const JointSet joints(bodies, {{.name = "j",
                                    .kind = kind,
                                    .first = 0,
                                    .second = 1,
                                    .place = Vector3d(2, 0.1, 0.2),
                                    .axis = Vector3d(0, 1, 0),
                                    .second_axis = Vector3d(1, 0, 0),
                                    .sign = -1}});
    const Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(joints.count(), -20, 30);
    laws::expect_true_variations(joints.signals(bodies), still(4), lambda);
  }
}

TEST(Signals, OfMooringsConnectorsAndTakeOffsVaryAsTheyAre) {
  const std::array<bool, 6> all{true, true, true, true, true, true};
  Matrix6 K = Matrix6::Identity() * 300;
  K(0, 4) = K(4, 0) = 50;
  const RestoringKind mooring("mooring", bodies,
                              {{.body = 1, .stiffness = K, .damping = 0.2 * K, .name = "m", .told = all}});
  const CatenaryMooringKind lines({{.fairlead = {0, Vector3d(1, 0.3, -0.5)},
                                    .anchor = {Vector3d(60, 20, -40)},
                                    .line = {.length = 90, .weight = 300, .axial_stiffness = 1e7, .on_bed = true},
                                    .name = "c"}});
  const Ends ends{{0, Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Vector3d(-1, 0.5, -0.1)}};
  const AxialConnectorKind axial({{ends, {.stiffness = 2000, .damping = 100}, 1.5, "a"}});
  const BushingConnectorKind bushing({{ends, Vector3d(100, 200, 300), Vector3d(10, 20, 30), Vector3d(1, 2, 3),
                                       Vector3d(1, 1, 1), Vector3d(2, 0, 0), "b"}});
  const Joint hinge{.name = "h",
                    .kind = JointKind::hinge,
                    .first = 0,
                    .second = 1,
                    .place = Vector3d(2, 0, 0),
                    .axis = Vector3d(0, 1, 0)};
  const PtoKind pto({{JointCoordinate(bodies, hinge, 0),
                      {.line = {.stiffness = 50, .damping = 7}, .lower = {}, .upper = {}},
                      -1,
                      "h"}});
  const GapConstraint shapes{Ball{Vector3d(1, 0, 0), 0.3}, Ball{Vector3d(-1, 0.2, 0), 0.4}};
  const ContactKind contact({{"t", 0, 1, shapes}});
  const auto all_told = {mooring.signals().size(), lines.signals().size(), axial.signals().size(),
                         bushing.signals().size(), pto.signals().size(),   contact.signals().size()};
  EXPECT_EQ(std::vector<std::size_t>(all_told), (std::vector<std::size_t>{6, 2, 1, 3, 2, 3}));
  for (const ForceKind* kind :
       std::initializer_list<const ForceKind*>{&mooring, &lines, &axial, &bushing, &pto, &contact})
    laws::expect_true_variations(kind->signals(), still(5));
}

TEST(Signals, OfPointsRelativeMotionsAndNetLoadsVaryAsTheyAre) {
  const PointOnBody bow{1, Vector3d(2, -0.4, 0.7)};
  const Ends ends{{0, Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Vector3d(-1, 0.5, -0.1)}};
  for (const auto& signals : {place_signals("bow", bow), velocity_signals("bow", bow), acceleration_signals("bow", bow),
                              relative_motion_signals("gap", ends, Vector3d(2, 0, 0)), net_load_signals(bodies[1], 1)})
    laws::expect_true_variations(signals, still(6));
}

// What turns about its centre at ω: a point at r has ω × (ω × r), the net load is that of the mass at the arm, and no
// moment about the centre but ω × Iω.
TEST(Signals, OfATurningBodyAreThoseOfCircles) {
  State s = rest_state(bodies);
  const Vector3d omega(0, 0, 2), arm = bodies[0].properties().centre_of_gravity.xyz, point(3, 0, 0);
  s.velocity.segment<3>(3) = omega;
  Eigen::VectorXd a = Eigen::VectorXd::Zero(12);
  a[0] = 5;
  const Eigen::VectorXd none;
  const auto tell = [&](const std::vector<Signal>& signals, std::size_t i) {
    return signals[i].value({s, a, none, 0, nullptr});
  };
  EXPECT_NEAR(tell(velocity_signals("p", {0, point}), 1), 6, 1e-14);             // ω r
  EXPECT_NEAR(tell(acceleration_signals("p", {0, point}), 0), 5 - 12, 1e-14);    // a − ω² r
  EXPECT_NEAR(tell(net_load_signals(bodies[0], 0), 0), 900 * 5, 1e-10);          // m a
  EXPECT_NEAR(tell(net_load_signals(bodies[0], 0), 5), -arm.y() * 4500, 1e-10);  // of m a at the arm, about the origin
}

// (row · ξ) by hand, with each part once.
TEST(Signals, AmplitudesAddMotionVelocityAccelerationMultiplierAndWave) {
  Variation v{.parts = {{.body = 1}}, .by_multiplier = {{0, 3}}, .by_wave = [](double, double) { return 7.0; }};
  v.parts[0].by_motion[2] = 2;
  v.parts[0].by_velocity[2] = 5;
  v.parts[0].by_acceleration[2] = 11;
  Eigen::VectorXcd xi = Eigen::VectorXcd::Zero(12), lambda(1);
  xi[8] = {0.1, 0.2};
  lambda << std::complex<double>(1, -1);
  const double omega = 1.5;
  const std::complex<double> i(0, 1),
      expected = (2.0 + 5.0 * i * omega - 11 * omega * omega) * xi[8] + 3.0 * lambda[0] + 7.0;
  EXPECT_LT(std::abs(amplitude(v, xi, lambda, omega, 0) - expected), 1e-14);
}

}  // namespace
}  // namespace signal_test
