#include "apps/scene/scenes.hpp"

namespace froude::scene::bodies_test {
namespace {

using hydro::Mode;

/// The sphere, free to rotate, with these lines about its inertia.
std::string rotating(const std::string& lines) {
  return with(sphere, "free = [\"heave\"]\n", "centre_of_gravity = \"(0, 0, -1) m\"\n" + lines + "\n");
}

TEST(SceneBodies, ComputesInertiaFromRadii) {
  const Body body = parse(rotating("radii_of_gyration = \"(2, 3, 3.5) m\""), "scene.toml").bodies.at(0);
  const Eigen::Vector3d expected = 261.8e3 * Eigen::Vector3d(4, 9, 12.25);
  EXPECT_TRUE(body.inertia.isApprox(Eigen::Matrix3d(expected.asDiagonal()), 1e-14)) << body.inertia;  // round-off
  EXPECT_EQ(body.mass, 261800);
  EXPECT_EQ(body.centre_of_gravity, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(body.position, Eigen::Vector3d::Zero());
}

TEST(SceneBodies, PutsProductsOfInertiaIntoTheMatrixWithAMinus) {
  // Two masses of 1 kg at ±(1, 2, 0) m and two at ±(0, 0, 3) m: Ixx = 2·4 + 2·9, Iyy = 2·1 + 2·9, Izz = 2·5, ∫xy dm
  // = 4.
  const Body body =
      parse(rotating("inertia = \"(26, 20, 10) kg m^2\"\nproducts_of_inertia = \"(4, 0, 0) kg m^2\""), "scene.toml")
          .bodies.at(0);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& r : {Eigen::Vector3d(1, 2, 0), Eigen::Vector3d(0, 0, 3)})
    expected += 2 * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  EXPECT_TRUE(body.inertia.isApprox(expected, 1e-14)) << body.inertia;  // round-off
}

TEST(SceneBodies, RefusesMomentsThatNoRigidBodyHas) {
  EXPECT_THAT(
      refusal(rotating("inertia = \"(1, 1, 2.01) kg m^2\"")),
      AllOf(
          StartsWith(
              "scene.toml:15:11: error: [[body]] inertia = \"(1, 1, 2.01) kg m^2\" gives principal moments 1, 1, 2.01"),
          HasSubstr("none exceeds the sum of the other two")));
  EXPECT_THAT(refusal(rotating("radii_of_gyration = \"(1, 1, 1.5) m\"")), StartsWith("scene.toml:15:21: "));
  EXPECT_THAT(refusal(rotating("inertia = \"(1, 1, 1) kg m^2\"\nproducts_of_inertia = \"(2, 0, 0) kg m^2\"")),
              AllOf(StartsWith("scene.toml:16:23: "), HasSubstr("gives a principal moment of inertia of -1 kg m^2")));
  EXPECT_THAT(refusal(rotating("inertia = \"(1, 0, 1) kg m^2\"")), HasSubstr("must be positive"));
  // A thin disc meets the bound exactly; rounding to four digits must not refuse it.
  EXPECT_NO_THROW(parse(rotating("inertia = \"(1.666, 1.666, 3.333) kg m^2\""), "scene.toml"));
}

TEST(SceneBodies, NeedsInertiaAndCentreOnlyIfARotationIsFree) {
  EXPECT_NO_THROW(parse(sphere, "scene.toml"));
  EXPECT_THAT(refusal(with(sphere, "[\"heave\"]", "[\"heave\", \"pitch\"]")),
              AllOf(StartsWith("scene.toml:11:1: error: [[body]] may rotate and needs centre_of_gravity")));
  EXPECT_THAT(refusal(rotating("")),
              StartsWith("scene.toml:11:1: error: [[body]] may rotate and needs radii_of_gyration or inertia"));
}

TEST(SceneBodies, TakesInertiaInOneWayOnly) {
  EXPECT_THAT(refusal(rotating("radii_of_gyration = \"(1, 1, 1) m\"\ninertia = \"(1, 1, 1) kg m^2\"")),
              AllOf(StartsWith("scene.toml:16:1: "),
                    HasSubstr("may hold only one of radii_of_gyration, inertia; radii_of_gyration stands at line 15")));
  EXPECT_THAT(refusal(rotating("radii_of_gyration = \"(1, 1, 1) m\"\nproducts_of_inertia = \"(0, 0, 0) kg m^2\"")),
              AllOf(StartsWith("scene.toml:16:1: "), HasSubstr("products_of_inertia acts only beside \"inertia\"")));
}

TEST(SceneBodies, FreesTheModesNamedAndAllByDefault) {
  EXPECT_EQ(parse(sphere, "scene.toml").bodies[0].free, (std::array{false, false, true, false, false, false}));
  EXPECT_EQ(parse(pontoons, "scene.toml").bodies[0].free, (std::array{true, true, true, true, true, true}));
  EXPECT_THAT(refusal(with(sphere, "[\"heave\"]", "[]")), HasSubstr("free = [] is empty"));
  EXPECT_THAT(refusal(with(sphere, "[\"heave\"]", "[\"heave\", \"heave\"]")), StartsWith("scene.toml:14:18: "));
}

TEST(SceneBodies, FeelGravityWhereTheSceneSaysSoAndNothingHoldsTheWeightAlready) {
  EXPECT_FALSE(parse(sphere, "scene.toml").bodies.at(0).weight);
  const std::string heavy = with(sphere, "free = [\"heave\"]\n", "free = [\"heave\"]\nweight = true\n");
  EXPECT_THAT(refusal(heavy), AllOf(HasSubstr("weight = true would act twice"), HasSubstr("leave out `weight`")));
  EXPECT_TRUE(parse(with(heavy, "hydrostatics = true\n", ""), "scene.toml").bodies.at(0).weight);
}

TEST(SceneBodies, ShowStillWaterTheHullThatTheSceneNames) {
  const std::string afloat = with(with(sphere, "hydrostatics = true\n", ""), "[body.hydrodynamics]\n",
                                  "[body.buoyancy]\nspheres = { at = \"(0, ±2, -1) m\", diameter = \"3 m\" }\n"
                                  "mesh = \"hull.stl\"\nunit = \"1 mm\"\n[body.hydrodynamics]\n");
  const Buoyancy b = parse(afloat, "/scenes/scene.toml").bodies.at(0).buoyancy.value();
  ASSERT_EQ(b.spheres.size(), 2u);
  EXPECT_EQ(b.spheres[1].radius, 1.5);
  EXPECT_EQ(b.mesh->value, "/scenes/hull.stl");
  EXPECT_EQ(b.unit, 1e-3);
  EXPECT_THAT(refusal(with(afloat, "radiation = {}\n", "radiation = {}\nhydrostatics = true\n")),
              AllOf(HasSubstr("[body.buoyancy] would act twice"), HasSubstr("weight = true")));
  EXPECT_THAT(refusal(with(afloat, "mesh = \"hull.stl\"\n", "")), HasSubstr("mesh"));
  EXPECT_THAT(refusal(with(afloat, "spheres = { at = \"(0, ±2, -1) m\"",
                           "cylinders = { from = \"(0, ±2, -1) m\", to = \"(0, 2, 1) m\"")),
              HasSubstr("gives 1 points, `from` gives 2"));
}

TEST(SceneBodies, StartsWhereTheSceneSays) {
  const auto text =
      with(sphere, "free =", "initial = { heave = \"50 cm\" }\ninitial_velocity = { heave = \"-1 m/s\" }\nfree =");
  const Body body = parse(text, "scene.toml").bodies[0];
  EXPECT_EQ(body.initial, (std::map<Mode, double>{{Mode::heave, 0.5}}));
  EXPECT_EQ(body.initial_velocity, (std::map<Mode, double>{{Mode::heave, -1}}));
  EXPECT_NEAR(parse(pontoons, "scene.toml").bodies[4].initial.at(Mode::pitch), 5 * 0.017453292519943295,
              1e-16);  // round-off
  EXPECT_THAT(refusal(with(sphere, "free =", "initial = { heave = \"5 deg\" }\nfree =")),
              HasSubstr("is an angle; a length is needed"));
  EXPECT_THAT(refusal(with(sphere, "free =", "initial = { surge = \"1 m\" }\nfree =")),
              AllOf(StartsWith("scene.toml:14:21: "), HasSubstr("moves a mode that is held")));
  EXPECT_THAT(refusal(with(sphere, "free =", "initial = {}\nfree =")), HasSubstr("needs at least one of surge, sway"));
}

TEST(SceneBodies, MakesCopiesOneStepApart) {
  const Scene scene = parse(with(pontoons, "mass =", "position = \"(-26, 1, 0) m\"\nmass ="), "scene.toml");
  ASSERT_EQ(scene.bodies.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    const Body& body = scene.bodies[static_cast<std::size_t>(i)];
    EXPECT_EQ(body.name, "m" + std::to_string(i + 1));
    EXPECT_EQ(body.family, "m");
    EXPECT_EQ(body.copy, i + 1);
    EXPECT_EQ(body.position, Eigen::Vector3d(-26 + 13 * i, 1, 0));
  }
  EXPECT_EQ(parse(sphere, "scene.toml").bodies[0].copy, 0);
}

TEST(SceneBodies, GivesEachBodyItsOwnName) {
  const std::string second = "[[body]]\nname = \"sphere\"\nmass = \"1 t\"\nfree = [\"heave\"]\n";
  EXPECT_THAT(refusal(with(sphere, "[ask]", second + "[ask]")),
              AllOf(StartsWith("scene.toml:21:8: error: the name \"sphere\" is taken at scene.toml:12:8"),
                    HasSubstr("name = \"sphere\"")));
  const std::string copy = with(second, "sphere", "m3");
  EXPECT_THAT(refusal(with(pontoons, "[[member]]", copy + "[[member]]")),
              HasSubstr("the name \"m3\" is taken at scene.toml:12:8"));
}

TEST(SceneBodies, WantsNamesThatSignalsCanCarry) {
  for (const char* name : {"1m", "m.x", "m*", "é", "", "-m"})
    EXPECT_THAT(refusal(with(sphere, "name = \"sphere\"", std::string("name = \"") + name + "\"")),
                AllOf(StartsWith("scene.toml:12:8: "), HasSubstr("is not a name")));
  for (const char* name : {"ground", "wave", "energy", "time"})
    EXPECT_THAT(refusal(with(sphere, "name = \"sphere\"", std::string("name = \"") + name + "\"")),
                HasSubstr("a meaning of its own"));
  EXPECT_NO_THROW(parse(with(sphere, "name = \"sphere\"", "name = \"a_B-9\""), "scene.toml"));
}

TEST(SceneHydrodynamics, NamesTheEffects) {
  const Hydrodynamics all = *parse(sphere, "/somewhere/scene.toml").bodies[0].hydrodynamics;
  EXPECT_EQ(all.file.value, "/somewhere/sphere.nc");
  EXPECT_EQ(all.file.place.line, 16);
  EXPECT_TRUE(all.excitation && all.radiation && all.hydrostatics && all.interaction == Interaction::full);
  EXPECT_EQ(all.memory.tolerance, 1e-3);
  const auto some =
      *parse(with(sphere, "excitation = true\nradiation = {}\n", ""), "scene.toml").bodies[0].hydrodynamics;
  EXPECT_FALSE(some.excitation || some.radiation);
  EXPECT_THAT(
      refusal(with(sphere, "excitation = true\nradiation = {}\nhydrostatics = true\n", "")),
      AllOf(
          StartsWith(
              "scene.toml:15:1: error: [body.hydrodynamics] needs at least one of excitation, radiation, hydrostatics"),
          HasSubstr("name what shall act")));
}

TEST(SceneHydrodynamics, SetsTheMemoryInOneWay) {
  const auto memory = [](const std::string& keys) {
    return with(sphere, "radiation = {}", "radiation = { " + keys + " }");
  };
  EXPECT_EQ(parse(memory("memory = \"1 min\""), "scene.toml").bodies[0].hydrodynamics->memory.length, 60);
  for (const Echo& e : parse(memory("memory = \"1 min\""), "scene.toml").echo)
    EXPECT_NE(e.key, "body[1].hydrodynamics.radiation.memory_tolerance")
        << "a tolerance does not act on a fixed length";
  EXPECT_EQ(parse(memory("memory_tolerance = 0.01"), "scene.toml").bodies[0].hydrodynamics->memory.tolerance, 0.01);
  EXPECT_THAT(refusal(memory("memory = \"60 s\", memory_tolerance = 1e-3")),
              AllOf(StartsWith("scene.toml:18:32: "),
                    HasSubstr("may hold only one of memory_tolerance, memory; memory stands at line 18")));
}

TEST(SceneHydrodynamics, NamesTheMethodOfItsMemory) {
  const auto method = [](const std::string& keys) {
    return with(sphere, "radiation = {}", "radiation = { " + keys + " }");
  };
  using enum Memory::Method;
  EXPECT_EQ(parse(sphere, "scene.toml").bodies[0].hydrodynamics->memory.method, automatic);
  EXPECT_EQ(parse(method("method = \"poles\""), "scene.toml").bodies[0].hydrodynamics->memory.method, poles);
  EXPECT_THAT(refusal(method("method = \"pols\"")), HasSubstr("poles"));
  EXPECT_THAT(refusal(method("method = \"poles\", memory = \"60 s\"")),
              AllOf(StartsWith("scene.toml:18:24: "), HasSubstr("has no length of memory")));
}

TEST(SceneHydrodynamics, ReadsWhatFilesLeaveUnsaid) {
  const auto text = with(
      sphere, "excitation",
      "body = 2\nreference_point = \"(0, 0, -2) m\"\nulen = \"5 m\"\niperout = 3\ninteraction = \"self\"\nexcitation");
  const Hydrodynamics h = *parse(text, "scene.toml").bodies[0].hydrodynamics;
  EXPECT_EQ(h.body->value, 2);
  EXPECT_EQ(h.body->place.line, 17);
  EXPECT_EQ(*h.reference_point, Eigen::Vector3d(0, 0, -2));
  EXPECT_EQ(h.ulen, 5);
  EXPECT_EQ(h.iperout, 3);
  EXPECT_EQ(h.interaction, Interaction::self);
  EXPECT_EQ(h.interaction_place.line, 21);
  EXPECT_THAT(refusal(with(text, "iperout = 3", "iperout = 5")), HasSubstr("is more than 4"));
  EXPECT_NO_THROW(parse(with(text, "radiation = {}\n", ""), "scene.toml"));  // waves that are scattered
  EXPECT_THAT(refusal(with(with(text, "radiation = {}\n", ""), "excitation = true\n", "")),
              AllOf(StartsWith("scene.toml:21:1: "),
                    HasSubstr("interaction acts only beside \"radiation\" or \"excitation\"")));
}

}  // namespace
}  // namespace froude::scene::bodies_test
