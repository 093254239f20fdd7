// Excitation that follows a slow yaw.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "dynamics/force/turning_excitation.hpp"
#include "hydro/base/error.hpp"
#include "scenes.hpp"

namespace turning_test {
namespace {

using namespace froude;
using testing::AllOf, testing::HasSubstr, testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;

/// A module away from the origin, in a wave along x; `turning` goes into [body.hydrodynamics], `of_body` above it.
scene::Scene module(const std::string& turning, const std::string& of_body = "") {
  return froude_test::parse(froude_test::water + R"([waves]
kind = "regular"
height = "0.5 m"
period = "6 s"
heading = "0 deg"
[[body]]
name = "m"
position = "(20, 7, 0) m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
)" + of_body + R"([body.hydrodynamics]
file = "pontoon1.nc"
hydrostatics = true
excitation = true
)" + turning + R"([ask]
run = { duration = "20 s", every = "0.1 s" }
accuracy = 1e-2
)");
}
const std::string quarter =
    "turning = { from = \"-90 deg\", to = \"0 deg\", spacing = \"45 deg\", slower_than = \"30 s\" }\n";

/// The load of the waves on the body, turned by `yaw`, without a memory.
dynamics::Vector6 load(const scene::Scene& scene, double yaw, double t) {
  const compile::Prepared prepared = compile::prepare(scene);
  const compile::TimeModel model = compile::time_model(scene, prepared);
  dynamics::State state = model.start;
  state.time = t;
  state.pose[0].attitude = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(6);
  dynamics::LoadSink sink(out);
  for (const auto& kind : model.model.forces())
    if (kind->effect().rfind("excitation", 0) == 0) kind->add_load({state, nullptr}, sink);
  return out;
}

TEST(TurningExcitation, UnturnedIsThatOfTheBodyAsPlaced) {
  for (const double t : {1.0, 2.3, 11.0})
    EXPECT_LT((load(module(quarter), 0, t) - load(module(""), 0, t)).norm(), 1e-6);
}

// Four cylinders at the corners of a square look the same after a quarter turn, and the wave pushes as before.
TEST(TurningExcitation, OfASquareIsTheSameAfterAQuarterTurn) {
  const scene::Scene scene = module(quarter);
  for (const double t : {1.0, 2.3, 11.0}) {
    const dynamics::Vector6 straight = load(scene, 0, t), turned = load(scene, -90 * degree, t);
    EXPECT_LT((turned - straight).norm(), 2e-3 * straight.norm()) << "the data's own symmetry";
    EXPECT_GT((load(scene, -45 * degree, t) - straight).norm(), 0.005 * straight.norm()) << "half way it is another";
  }
}

// Between the yaws of a table the load is straight.
TEST(TurningExcitation, IsStraightBetweenYaws) {
  const scene::Scene scene = module(quarter);
  const dynamics::Vector6 middle = load(scene, -30 * degree, 2.3);
  const dynamics::Vector6 mean = (load(scene, 0, 2.3) + 2 * load(scene, -45 * degree, 2.3)) / 3;
  EXPECT_LT((middle - mean).norm(), 1e-9 * mean.norm());
}

TEST(TurningExcitation, FollowsTheSlowPartOfTheYaw) {
  const scene::Scene scene = module(quarter);
  const compile::TimeModel model = compile::time_model(scene, compile::prepare(scene));
  for (const auto& kind : model.model.forces()) {
    if (kind->effect() != "excitation.turning") continue;
    const auto memory = kind->make_memory(model.start);
    auto& slow = static_cast<dynamics::SlowYaw&>(*memory);
    EXPECT_EQ(slow.yaw[0], 0);
    dynamics::State turned = model.start;
    turned.pose[0].attitude = Eigen::AngleAxisd(-20 * degree, Eigen::Vector3d::UnitZ());
    for (int i = 1; i <= 100; ++i) {
      turned.time = 0.1 * i;
      slow.accept(turned);
    }
    EXPECT_NEAR(slow.yaw[0], -20 * degree * (1 - std::exp(-10 * 2 * std::numbers::pi / 30)), 1e-12);
    return;
  }
  FAIL() << "no such effect";
}

TEST(TurningExcitation, StopsARunThatTurnsTooFar) {
  // A push that turns the module by more than the table holds.
  const froude::Run run =
      simulate(module("turning = { from = \"-1 deg\", to = \"0 deg\", spacing = \"1 deg\", slower_than = \"1 s\" }\n",
                      "initial_velocity = { yaw = \"-0.01 rad/s\" }\n"));
  EXPECT_THAT(run.stopped, AllOf(HasSubstr("m has turned by -1"), HasSubstr("from -1 to 0 deg")));
  EXPECT_GT(run.time.size(), 5u) << "what was computed is kept";
}

TEST(TurningExcitation, RefusesWhatCannotTurn) {
  EXPECT_THAT([&] { module("turning = { from = \"5 deg\", to = \"5 deg\", slower_than = \"30 s\" }\n"); },
              ThrowsMessage<hydro::InputError>(HasSubstr("not beyond")));
  const scene::Scene no_data = module("turning = { from = \"0 deg\", to = \"20 deg\", slower_than = \"30 s\" }\n");
  EXPECT_THAT([&] { compile::time_model(no_data, compile::prepare(no_data)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("heading")));
}

// 15 degrees are the limit; what is said is of the loads that know no other attitude.
TEST(FarFromPlace, TellsWhatKnowsNoOtherYaw) {
  const auto told = [](const std::string& turning, const std::string& yaw) {
    return testing::PrintToString(simulate(module(turning, "initial = { yaw = \"" + yaw + "\" }\n")).warnings());
  };
  const std::string at_rest = "no error is estimated";
  EXPECT_THAT(told("", "10 deg"), testing::Not(HasSubstr(at_rest)));
  EXPECT_THAT(told("", "-30 deg"), HasSubstr("no error is estimated of the excitation of m as it turns, by 30"));
  EXPECT_THAT(told(quarter, "-30 deg"), testing::Not(HasSubstr(at_rest)));
  EXPECT_THAT(told(quarter + "radiation = { memory_tolerance = 0.2 }\n", "-30 deg"),
              AllOf(HasSubstr("the radiation of m as it turns"), testing::Not(HasSubstr("excitation"))));
}

// A quarter of the wave, 52 m long in 14 m of water, is 13 m; of the way 5.5 m are what a wave gives that begins at
// once.
TEST(FarFromPlace, TellsOfPhasesWhereABodyGoesAway) {
  const auto told = [](const std::string& speed) {
    return testing::PrintToString(
        simulate(module("", "initial_velocity = { surge = \"" + speed + "\" }\n")).warnings());
  };
  EXPECT_THAT(told("0.2 m/s"), testing::Not(HasSubstr("phases of waves")));
  EXPECT_THAT(told("1 m/s"), HasSubstr("the phases of waves at m as it goes away, by 25"));
}

}  // namespace
}  // namespace turning_test
