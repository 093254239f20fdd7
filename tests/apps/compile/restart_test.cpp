// Runs that begin anywhere, and the numbers that describe where.
#include "compile/restart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"

namespace restart_test {
namespace {

using namespace froude;
using froude_test::parse;

const std::string begin = "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"14 m\"\n";
const std::string ask = "[ask]\nrun = { duration = \"2 s\", every = \"0.01 s\" }\n";
const std::string chain =
    "[[line]]\nname = \"d\"\nfrom = \"(0, 0, 0) m\"\nto = \"(1.2, 0, 0) m\"\nlength = \"2 m\"\nsegments = 5\n"
    "mass_per_length = \"1 kg/m\"\n[line.damping]\nlinear = \"0.05 kg/s\"\n[line.release]\nnode = 2\n"
    "at = \"(0.4, 0.2, -0.5) m\"\n";
const std::string pendulum =
    "[[body]]\nname = \"bob\"\nposition = \"(0, 0, -1) m\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nmass = \"2 "
    "kg\"\nradii_of_gyration = \"(0.2, 0.2, 0.2) "
    "m\"\n"
    "weight = true\ninitial = { roll = \"20 deg\", sway = \"0.34202014332567 m\", heave = \"0.06030737921409 m\" "
    "}\n[[joint]]\nkind = \"hinge\"\nbetween = [\"bob\", \"ground\"]\n"
    "at = \"(0, 0, 0) m\"\naxis = \"x\"\n";

struct Ready {
  scene::Scene scene;
  compile::Prepared prepared;
  compile::TimeModel model;
  explicit Ready(const std::string& text)
      : scene(parse(text)), prepared(compile::prepare(scene)), model(compile::time_model(scene, prepared)) {}
  froude::Run run(std::size_t steps, compile::MovingState* end = nullptr) {
    model.steps = steps * model.steps_per_sample;
    return run_model(scene, model, {}, end);
  }
};

TEST(Restart, GoesOnWhereARunEnded) {
  for (const std::string& moving : {chain, pendulum}) {
    Ready whole(begin + moving + ask), half(begin + moving + ask);
    const froude::Run all = whole.run(200);
    compile::MovingState middle;
    half.run(100, &middle);
    compile::start_from(middle, half.model);
    const froude::Run rest = half.run(100);
    EXPECT_DOUBLE_EQ(rest.time.front(), 1.0);
    for (const auto& s : rest.signals) {
      if (s.name.starts_with("energy") || s.name.find("tension") != std::string::npos)
        continue;  // counted from the start
      // Generalised-alpha begins anew with the true acceleration: h^2 times its change in a step, and loads with it.
      EXPECT_NEAR(s.values.back(), all.signal(s.name).back(), 1e-3 * std::max(1.0, std::abs(s.values.back())))
          << s.name;
    }
  }
}

TEST(Restart, KeepsTheTurnsOfAHinge) {
  const std::string wound =
      "[[body]]\nname = \"wheel\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nmass = \"2 kg\"\n"
      "radii_of_gyration = \"(0.5, 0.5, 0.5) m\"\ninitial = { pitch = \"400 deg\" }\n"
      "[[joint]]\nname = \"hub\"\nkind = \"hinge\"\nbetween = [\"ground\", \"wheel\"]\nat = \"(0, 0, 0) m\"\n"
      "axis = \"y\"\npto = { stiffness = \"0.1 N m/rad\" }\n";
  Ready first(begin + wound + ask), second(begin + wound + ask);
  compile::MovingState middle;
  const froude::Run before = first.run(20, &middle);
  const compile::StateChart chart(second.model, middle);
  compile::start_from(chart.at(second.model, Eigen::VectorXd::Zero(chart.coordinates())), second.model);
  const froude::Run after = second.run(20);
  for (const char* name : {"hub.angle", "wheel.pitch", "hub.pto_moment"})
    EXPECT_NEAR(after.signal(name).front(), before.signal(name).back(), 1e-12) << name;
  EXPECT_GT(after.signal("hub.angle").front(), 6.9);
}

TEST(Restart, NumbersOfAStartKeepLengthsAndJoints) {
  Ready r(begin + chain + ask);
  const compile::MovingState middle = compile::start_of(r.model);
  const compile::StateChart chart(r.model, middle);
  ASSERT_EQ(chart.coordinates(), 2 * (4 * 3 - 5));  // four free nodes, five lengths
  const Eigen::VectorXd z = 0.05 * Eigen::VectorXd::LinSpaced(chart.coordinates(), -1, 1);
  const auto moved = chart.at(r.model, z).lines[0];
  for (int j = 0; j < 5; ++j) {
    const Eigen::Vector3d way = moved.position.col(j + 1) - moved.position.col(j);
    EXPECT_NEAR(way.norm(), 0.4, 1e-12);
    EXPECT_NEAR(way.dot(moved.velocity.col(j + 1) - moved.velocity.col(j)), 0, 1e-12);
  }
  EXPECT_GT((moved.position - middle.lines[0].position).norm(), 0.05);
  EXPECT_EQ(chart.at(r.model, 0 * z).lines[0].position, middle.lines[0].position);
}

TEST(Restart, APendulumOfABodyHasOneAngleAndOneRate) {
  Ready r(begin + pendulum + ask);
  const compile::StateChart chart(r.model, compile::start_of(r.model));
  ASSERT_EQ(chart.coordinates(), 2);
  const auto moved = chart.at(r.model, Eigen::Vector2d(0.1, 0.3)).bodies;
  EXPECT_LT(r.model.model.joints().values(moved).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(r.model.model.joints().times(r.model.model.joints().gradients(moved), moved.velocity).cwiseAbs().maxCoeff(),
            1e-12);
  EXPECT_GT(moved.velocity.norm(), 0.1);
}

}  // namespace
}  // namespace restart_test
