// Bodies on joints in motion, against closed forms and conservation laws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/gravity.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace joint_motion_test {
namespace {

using namespace dynamics;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;

RigidBody body(const std::string& name, const Eigen::Vector3d& at, double mass = 3,
               const Eigen::Vector3d& inertia = {1, 2, 2.5}) {
  return RigidBody({.name = name, .mass = mass, .inertia = inertia.asDiagonal(), .rest_position = {at}});
}

Model under_gravity(std::vector<RigidBody> bodies, std::vector<Joint> joints) {
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, g));
  return Model(std::move(bodies), {}, std::move(forces), std::move(joints));
}

Joint hinge(const std::string& name, int first, std::optional<int> second, const Eigen::Vector3d& place) {
  return {.name = name,
          .kind = JointKind::hinge,
          .first = first,
          .second = second,
          .place = place,
          .axis = Eigen::Vector3d::UnitY()};
}

/// A compound pendulum of 3 kg, 2 m below its hinge at the origin, turned out by an angle about y.
constexpr double arm = 2, inertia_about_hinge = 2 + 3 * arm * arm;
Model pendulum() { return under_gravity({body("bob", {0, 0, -arm})}, {hinge("pivot", 0, {}, {0, 0, 0})}); }
State turned_out(const Model& model, double angle) {
  State out = rest_state(model.bodies());
  const Eigen::Quaterniond R = rotation_exp(Eigen::Vector3d(0, angle, 0));
  out.pose[0].centre = R * out.pose[0].centre;
  out.pose[0].attitude = R;
  return out;
}
double angle_of(const State& s) { return rotation_log(s.pose[0].attitude).y(); }

struct Outcome {
  State state;
  Eigen::VectorXd multipliers;
  double largest_opening = 0;
};
Outcome run(const Model& model, State start, double h, int steps, double rho) {
  Workspace w(model, std::move(start));
  GeneralizedAlpha integrator(model, {.rho_infinity = rho});
  integrator.start(w);
  Outcome out;
  for (int i = 0; i < steps; ++i) {
    integrator.step(w, h);
    out.largest_opening = std::max(out.largest_opening, model.joints().values(w.state).norm());
  }
  out.state = w.state;
  out.multipliers = w.multipliers;
  return out;
}

TEST(JointMotion, APendulumSwingsWithItsEllipticPeriodAndConvergesInSecondOrder) {
  // T = 4 √(I/(m g l)) K(sin(θ₀/2)); released at 2 rad it is back there after T.
  const Model model = pendulum();
  const double start = 2, period = 4 * std::sqrt(inertia_about_hinge / (3 * g * arm)) * std::comp_ellint_1(std::sin(1));
  double errors[2];
  for (const int k : {0, 1}) {
    const int steps = 400 << k;
    // A quarter of a period later it hangs down: there an error in time shows at once.
    const Outcome quarter = run(model, turned_out(model, start), period / 4 / steps, steps, 0.8);
    errors[k] = angle_of(quarter.state);
    EXPECT_LT(quarter.largest_opening, 1e-13);
  }
  EXPECT_LT(std::abs(errors[0]), 5e-5);  // some (2π/1600)², of 2 rad
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
}

TEST(JointMotion, AHingeCarriesWeightAndCentrifugalForce) {
  // Along the arm m g cos θ + m l θ'², across m g sin θ (1 − m l²/I): the loads on the bob in its own axes.
  const Model model = pendulum();
  const Outcome swung = run(model, turned_out(model, 1.5), 1e-3, 700, 0.8);
  const double theta = angle_of(swung.state), rate = swung.state.velocity[4];
  const Vector6 load = model.joints().load_on(0, End::first, swung.state, swung.multipliers);
  ASSERT_GT(std::abs(rate), 0.3);
  EXPECT_NEAR(load[2], 3 * g * std::cos(theta) + 3 * arm * rate * rate, 1e-3);  // of 30 N; second order in h
  EXPECT_NEAR(std::abs(load[0]), std::abs(3 * g * std::sin(theta) * (1 - 3 * arm * arm / inertia_about_hinge)), 1e-3);
  EXPECT_NEAR(load[1], 0, 1e-9);
  EXPECT_NEAR(load.tail<3>().norm(), 0, 1e-6) << "about its own place a hinge that is not bent has no moment";
}

TEST(JointMotion, ASliderGoesDownItsInclineFreely) {
  const Eigen::Vector3d down = Eigen::Vector3d(2, 0, -1).normalized();
  const Model model = under_gravity(
      {body("sledge", {1, 1, 1})},
      {{.name = "rail", .kind = JointKind::slider, .first = 0, .second = {}, .place = {1, 1, 1}, .axis = down}});
  const Outcome slid = run(model, rest_state(model.bodies()), 0.01, 200, 0.8);
  const double way = 0.5 * g / std::sqrt(5.0) * 4;  // ½ g sin α t², which the method follows exactly
  EXPECT_LT((slid.state.pose[0].centre - Eigen::Vector3d(1, 1, 1) - way * down).norm(), 1e-9);
  EXPECT_LT(slid.largest_opening, 1e-13);
}

TEST(JointMotion, TwoHalvesFixedToEachOtherTumbleAsOneBody) {
  // One body, and the same cut in two: each half 1 m off the centre, its own inertia what the axes theorem leaves.
  const RigidBody whole = body("whole", {0, 0, 0}, 6, {2.0, 9.0, 10.0});
  const auto half = [](const char* name, double x) { return body(name, {x, 0, 0}, 3, {1.0, 1.5, 2.0}); };
  const Model one({whole}, {}, {}),
      two({half("a", 1), half("b", -1)}, {}, {},
          {{.name = "weld", .kind = JointKind::fixed, .first = 0, .second = 1, .place = {0, 0, 0}}});
  const Eigen::Vector3d spin(0.4, 2.0, 0.3);  // about the middle axis: the motion that is not stable
  State start_one = rest_state(one.bodies()), start_two = rest_state(two.bodies());
  start_one.velocity.tail<3>() = spin;
  for (int i = 0; i < 2; ++i) {
    start_two.velocity.segment<3>(6 * i) = spin.cross(Eigen::Vector3d(i == 0 ? 1 : -1, 0, 0));
    start_two.velocity.segment<3>(6 * i + 3) = spin;
  }
  const Outcome cut = run(two, start_two, 1e-3, 3000, 0.8);
  const State uncut = run(one, start_one, 1e-3, 3000, 0.8).state;
  const double apart = uncut.pose[0].attitude.angularDistance(cut.state.pose[0].attitude);
  // Both have errors of second order, (2 rad/s · 1e-3)²/12 · 6 rad.
  EXPECT_LT(apart, 1e-5);
  EXPECT_GT(uncut.pose[0].attitude.angularDistance(Eigen::Quaterniond::Identity()), 0.3) << "it has turned";
  EXPECT_LT(cut.largest_opening, 1e-13);
}

TEST(JointMotion, FreeBodiesOnABallJointKeepTheirMomentum) {
  const Model model({body("a", {1, 0, 0}), body("b", {-1, 0.5, 0}, 5)}, {}, {},
                    {{.name = "ball", .kind = JointKind::ball, .first = 0, .second = 1, .place = {0, 0, 0}}});
  State start = rest_state(model.bodies());
  const Eigen::Vector3d spins[]{{1, -2, 0.5}, {-0.7, 0.4, 1.5}}, joint_speed(0.3, -0.2, 0.1);
  for (int i = 0; i < 2; ++i) {
    start.velocity.segment<3>(6 * i) = joint_speed + spins[i].cross(start.pose[static_cast<std::size_t>(i)].centre);
    start.velocity.segment<3>(6 * i + 3) = spins[i];
  }
  const auto momentum = [&](const State& s) {
    return Eigen::Vector3d(3 * s.velocity.segment<3>(0) + 5 * s.velocity.segment<3>(6));
  };
  const auto spin_of = [&](const State& s) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < 2; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Matrix3d R = s.pose[k].attitude.toRotationMatrix();
      sum += R * model.bodies()[k].inertia() * R.transpose() * s.velocity.segment<3>(6 * i + 3) +
             model.bodies()[k].mass() * s.pose[k].centre.cross(Eigen::Vector3d(s.velocity.segment<3>(6 * i)));
    }
    return sum;
  };
  const Outcome after = run(model, start, 2e-3, 1000, 0.8);
  EXPECT_LT((momentum(after.state) - momentum(start)).norm(), 1e-9) << "the joint's loads are equal and opposite";
  // Angular momentum: to the order of the step.
  EXPECT_LT((spin_of(after.state) - spin_of(start)).norm(), 1e-3 * spin_of(start).norm());
  EXPECT_LT(after.largest_opening, 1e-13);
}

TEST(JointMotion, ADoublePendulumKeepsItsEnergyToTheOrderOfTheStep) {
  const Model model = under_gravity({body("upper", {0, 0, -1}), body("lower", {0, 0, -3})},
                                    {hinge("top", 0, {}, {0, 0, 0}), hinge("middle", 0, 1, {0, 0, -2})});
  State start = rest_state(model.bodies());
  const Eigen::Quaterniond R = rotation_exp(Eigen::Vector3d(0, 2.2, 0));
  for (auto& pose : start.pose) {
    pose.centre = R * pose.centre;
    pose.attitude = R;
  }
  double residual[2];
  for (const int k : {0, 1}) {
    Workspace w(model, start);
    GeneralizedAlpha integrator(model, {.rho_infinity = 0.9});
    integrator.start(w);
    EnergyLedger ledger(model, w);
    for (int i = 0; i < 1000 << k; ++i) {
      integrator.step(w, 2e-3 / (1 << k));
      ledger.note(w);
    }
    residual[k] = std::abs(ledger.residual());
    EXPECT_LT(model.joints().values(w.state).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_GT(ledger.kinetic(), 1) << "it swings";
  }
  EXPECT_LT(residual[0], 1e-2);  // of 3·9.81·4 J
  EXPECT_GT(residual[0] / residual[1], 3) << "second order or better";
}

TEST(JointMotion, ADoorOnTwoHingesSwingsAsOnOne) {
  const auto model_with = [](bool both) {
    std::vector<Joint> joints{hinge("near", 0, {}, {0, 0, 0})};
    if (both) joints.push_back(hinge("far", 0, {}, {0, 1.5, 0}));
    return under_gravity({body("bob", {0, 0, -arm})}, std::move(joints));
  };
  const Model one = model_with(false), two = model_with(true);
  EXPECT_EQ(two.redundant().size(), 1u);
  const State a = run(one, turned_out(one, 1), 0.01, 200, 0.8).state,
              b = run(two, turned_out(two, 1), 0.01, 200, 0.8).state;
  EXPECT_NEAR(angle_of(a), angle_of(b), 1e-12);
}

TEST(JointMotion, AnOpenJointAtTheStartIsRefusedByName) {
  const Model model = pendulum();
  State apart = rest_state(model.bodies());
  apart.pose[0].centre.x() += 0.2;
  Workspace open(model, apart);
  GeneralizedAlpha integrator(model, {});
  EXPECT_THAT([&] { integrator.start(open); },
              ThrowsMessage<hydro::InputError>(testing::AllOf(HasSubstr("\"pivot\""), HasSubstr("off by 0.2"))));
  State pulled = rest_state(model.bodies());
  pulled.velocity[2] = 0.5;
  Workspace pulling(model, pulled);
  EXPECT_THAT([&] { integrator.start(pulling); },
              ThrowsMessage<hydro::InputError>(testing::AllOf(HasSubstr("\"pivot\""), HasSubstr("0.5 per second"))));
}

TEST(JointMotion, AChainOfFortyHingesIsSolvedSparselyAndAsTheDenseOne) {
  // Free fall of a horizontal chain hung at one end; total energy is kept, whichever factors are used.
  std::vector<RigidBody> links;
  std::vector<Joint> joints;
  for (int i = 0; i < 40; ++i) {
    links.push_back(body(fmt::format("l{}", i + 1), {0.5 + i, 0, 0}, 1, {0.02, 0.09, 0.09}));
    joints.push_back(hinge(fmt::format("h{}", i + 1), i, i == 0 ? std::nullopt : std::optional<int>(i - 1),
                           {static_cast<double>(i), 0, 0}));
  }
  const Model model = under_gravity(links, joints);
  Workspace w(model, rest_state(model.bodies()));
  EXPECT_TRUE(w.solver.is_sparse());
  GeneralizedAlpha integrator(model, {.rho_infinity = 0.8});
  integrator.start(w);
  EnergyLedger ledger(model, w);
  for (int i = 0; i < 300; ++i) {
    integrator.step(w, 1e-3);
    ledger.note(w);
  }
  EXPECT_LT(model.joints().values(w.state).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(ledger.kinetic(), 50);
  EXPECT_LT(std::abs(ledger.residual()), 1e-4 * ledger.kinetic());
}

TEST(JointMotion, BodiesFarFromTheOriginThatHardlyMoveAreNoReasonToGiveUp) {
  // 1 km away a joint's place is rounded to 1e-13 m, which a step of 1 ms makes an acceleration of 1e-6 m/s²: more than
  // the bodies have. The start pulls with a thousandth of a newton.
  const Model model = under_gravity(
      {body("a", {1000, 0, 0}, 1e-4, {1e-4, 1e-4, 1e-4}), body("b", {1010, 0, 0}, 1e-4, {1e-4, 1e-4, 1e-4})},
      {hinge("between", 0, 1, {1005, 0, 0}), hinge("hung", 0, {}, {1000, 0, 3})});
  EXPECT_NO_THROW(run(model, rest_state(model.bodies()), 1e-3, 20, 0.8));
}

}  // namespace
}  // namespace joint_motion_test
