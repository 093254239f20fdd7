// Exact buoyancy in scenes: linear in responses and modes, exact in a run, beside bodies with linear hydrostatics.
#include "compile/buoyancy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "hydro/base/error.hpp"
#include "hydro/cylinders/layout.hpp"
#include "support/source_dir.hpp"

namespace buoyancy_test {
namespace {

using namespace froude;
using froude_test::parse;
using froude_test::water;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string ask = R"([ask]
modes = {}
)";

/// A module on four pontoons of 1.6 m, drawn 1.13 m: it displaces 4 π 0.64 · 1.13 = 9.087999 m³.
std::string module_on_pontoons(const std::string& mass = "9088 kg", const std::string& extra = "") {
  return fmt::format(R"([[body]]
name = "buoy"
position = "(3, 1, 0) m"
mass = "{}"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
weight = true
[body.buoyancy]
cylinders = {{ from = "(±5.2, ±5.2, -1.13) m", to = "(±5.2, ±5.2, 1) m", diameter = "1.6 m" }}
{})",
                     mass, extra);
}

const std::string linear_module = R"([[body]]
name = "linear"
position = "(30, 0, 0) m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
hydrodynamics = { file = "pontoon1.nc", hydrostatics = true }
)";

TEST(BuoyancyInAScene, IsLinearlyTheRestoringMatrixOfThePontoons) {
  const auto prepared = compile::prepare(parse(water + module_on_pontoons() + ask));
  const auto linear = compile::frequency_model(prepared).linear_at_rest();
  hydro::cylinders::CylinderBody body{"buoy", {3, 1, 1.31}, Eigen::Vector3d(3, 1, 1.31), {}};
  for (const double x : {-5.2, 5.2})
    for (const double y : {-5.2, 5.2}) body.cylinders.push_back({{3 + x, 1 + y}, 0.8, 1.13});
  const Eigen::MatrixXd C = hydro::cylinders::restoring(
      body, {.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(14)});
  // The mass is given to seven digits.
  EXPECT_LT((linear.stiffness - C).norm(), 1e-6 * C.norm()) << linear.stiffness << "\n\n" << C;
}

TEST(BuoyancyInAScene, ActsOnItsBodyBesideOneWithLinearHydrostatics) {
  const auto prepared = compile::prepare(parse(water + linear_module + module_on_pontoons() + ask));
  EXPECT_EQ(prepared.with_gravity, std::vector<int>{1});
  ASSERT_EQ(prepared.hydrostatics.size(), 1u);
  EXPECT_EQ(prepared.hydrostatics[0].body, 0);
  const auto model = compile::frequency_model(prepared);
  const auto K = model.linear_at_rest().stiffness;
  // The same pontoons, by the mesh of a panel code and exactly: heave, roll and pitch to the mesh's 0.3 %.
  for (const int i : {2, 3, 4}) EXPECT_NEAR(K(6 + i, 6 + i), K(i, i), 0.005 * K(i, i)) << i;
}

TEST(BuoyancyInAScene, SaysWhatKeepsABodyFromFloatingAsPlaced) {
  EXPECT_THAT(
      [&] { compile::frequency_model(compile::prepare(parse(water + module_on_pontoons("9200 kg") + ask))); },
      ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("not in equilibrium as placed: buoy.heave feels"),
                                             HasSubstr("buoy displaces 9087.999 kg as placed and weighs 9200 kg"),
                                             HasSubstr("froude hydrostatics"))));
  std::string text = water + module_on_pontoons() + ask;
  text.replace(text.find("(0, 0, 1.31)"), 12, "(0.1, 0, 1.31)");
  EXPECT_THAT([&] { compile::frequency_model(compile::prepare(parse(text))); },
              ThrowsMessage<hydro::InputError>(HasSubstr("centre of buoyancy is (-0.1, ")));
}

TEST(BuoyancyInAScene, IsNotedWhereNoWeightActs) {
  std::string text = water + module_on_pontoons() + ask;
  text.erase(text.find("weight = true\n"), 14);
  EXPECT_THAT(compile::prepare(parse(text)).notes, testing::Contains(HasSubstr("buoyancy acts but no weight does")));
}

TEST(BuoyancyInAScene, RefusesAMeshThatIsNotThereAtItsPlace) {
  const auto text = water + module_on_pontoons("9088 kg", "mesh = \"nowhere.stl\"\n") + ask;
  EXPECT_THAT([&] { compile::prepare(parse(text)); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:"), HasSubstr("nowhere.stl"))));
}

TEST(BuoyancyInAScene, OfAMeshTurnsTheWorkboatBackFromALargeHeelWithoutLossOfEnergy) {
  const auto scene = scene::read(froude_test::source_dir() / "examples/roll.toml");
  EXPECT_NO_THROW(compile::frequency_model(compile::prepare(scene)));  // it floats as placed
  const froude::Run run = simulate(scene);
  ASSERT_EQ(run.stopped, "");
  const auto& roll = run.signal("boat.roll");
  const auto [low, high] = std::minmax_element(roll.begin(), roll.end());
  // Nothing damps: it swings to the other side and back. Held at 40° it would rise, and what heave gives and takes
  // makes single swings a few degrees larger or smaller.
  constexpr double degree = std::numbers::pi / 180;
  EXPECT_NEAR(roll.front(), 40 * degree, 1e-12);
  EXPECT_LT(*high, 45 * degree);
  EXPECT_LT(*low, -35 * degree);
  double residual = 0, turnover = 0;
  for (const auto& [name, value] : run.energy) {
    if (name == "residual") residual = std::abs(value);
    if (name == "turnover") turnover = value;
  }
  EXPECT_LT(residual, 2e-3 * turnover);  // of the step and of what generalised-alpha damps
}

}  // namespace
}  // namespace buoyancy_test
