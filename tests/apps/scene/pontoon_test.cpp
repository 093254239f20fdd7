#include "apps/scene/scenes.hpp"

namespace froude::scene::pontoon_test {
namespace {

TEST(PontoonScene, IsReadAsItIsMeant) {
  const Scene scene = parse(pontoons, "/scenes/five.toml");
  EXPECT_EQ(scene.title, "Five modules, moored at both ends");
  EXPECT_EQ(scene.text, pontoons);
  EXPECT_EQ(scene.water.density, 1000);
  EXPECT_EQ(scene.water.gravity, 9.81);
  EXPECT_EQ(scene.water.depth.metres(), 14);
  EXPECT_EQ(scene.bodies[4].position, Eigen::Vector3d(52, 0, 0));
  EXPECT_EQ(scene.bodies[4].hydrodynamics->file.value, "/scenes/data/pontoon5.nc");
  EXPECT_EQ(scene.moorings.size(), 2u);
  EXPECT_EQ(scene.connectors.size(), 8u);
  EXPECT_EQ(scene.accuracy, 1e-2);
  EXPECT_EQ(scene.rao->of.size(), 3u);
}

TEST(PontoonScene, IsEchoedWithEveryDefault) {
  std::string echo;
  for (const Echo& e : parse(pontoons, "scene.toml").echo)
    echo += e.key + " = " + e.value + (e.defaulted ? "  (default)\n" : "\n");
  EXPECT_EQ(echo,
            "schema = 1\n"
            "title = Five modules, moored at both ends\n"
            "water.density = 1000 kg/m^3\n"
            "water.gravity = 9.81 m/s^2  (default)\n"
            "water.depth = 14 m\n"
            "waves.kind = jonswap\n"
            "waves.heading = 30 deg\n"
            "waves.ramp = 0 s  (default)\n"
            "waves.kinematics.above_still_water = vertical  (default)\n"
            "waves.hs = 1.2 m\n"
            "waves.gamma = 3.3  (default)\n"
            "waves.tp = 6 s\n"
            "waves.seed = 1  (default)\n"
            "waves.components.repetition = 30 min  (default)\n"
            "waves.components.amplitudes = fixed  (default)\n"
            "body[1].name = m\n"
            "body[1].copies.count = 5\n"
            "body[1].copies.step = (13, 0, 0) m\n"
            "body[1].position = (0, 0, 0) m  (default)\n"
            "body[1].mass = 9088 kg\n"
            "body[1].centre_of_gravity = (0, 0, 1.31) m\n"
            "body[1].radii_of_gyration = (4.6, 4.6, 6.4) m\n"
            "body[1].free = [surge, sway, heave, roll, pitch, yaw]  (default)\n"
            "body[1].initial.heave = 10 cm\n"
            "body[1].initial.pitch = 5 deg\n"
            "body[1].hydrodynamics.file = data/pontoon5.nc\n"
            "body[1].hydrodynamics.excitation = true\n"
            "body[1].hydrodynamics.radiation.memory_tolerance = 1e-3\n"
            "body[1].hydrodynamics.radiation.method = automatic  (default)\n"
            "body[1].hydrodynamics.hydrostatics = true\n"
            "body[1].hydrodynamics.interaction = full  (default)\n"
            "member[1].name = member  (default)\n"
            "member[1].on = m*\n"
            "member[1].from = (±5.2, ±5.2, -1.13) m\n"
            "member[1].to = (±5.2, ±5.2, 0) m\n"
            "member[1].diameter = 1.6 m\n"
            "member[1].drag.cd = 1.0\n"
            "mooring[1].name = mooring  (default)\n"
            "mooring[1].on = [m1, m5]\n"
            "mooring[1].kind = linear\n"
            "mooring[1].stiffness.surge = 4280 N/m\n"
            "mooring[1].stiffness.sway = 10348 N/m\n"
            "mooring[1].stiffness.yaw = 15839 N m/rad\n"
            "connector[1].name = connector  (default)\n"
            "connector[1].between = neighbours of m\n"
            "connector[1].ends = [(6, ±5, 0.5) m, (-6, ±5, 0.5) m]\n"
            "connector[1].kind = axial\n"
            "connector[1].stiffness = 29332 N/m\n"
            "connector[1].rest_length = as placed\n"
            "ask.rao.periods = 2 s .. 8 s, 61 values\n"
            "ask.rao.about = as placed  (default)\n"
            "ask.rao.heading = 30 deg  (default)\n"
            "ask.rao.of = [m*.surge, m*.heave, connector*.force]\n"
            "ask.run.duration = 600 s\n"
            "ask.run.every = 0.05 s\n"
            "ask.run.start = as placed  (default)\n"
            "ask.run.of = [*]  (default)\n"
            "ask.accuracy = 1e-2\n"
            "solve.step = automatic  (default)\n"
            "solve.integrator.name = generalized_alpha  (default)\n");
}

TEST(PontoonScene, OrderOfTablesDoesNotMatter) {
  const auto ask = pontoons.find("[ask]"), water = pontoons.find("[water]");
  const Scene turned =
      parse(pontoons.substr(0, water) + pontoons.substr(ask) + pontoons.substr(water, ask - water), "scene.toml");
  const Scene straight = parse(pontoons, "scene.toml");
  ASSERT_EQ(turned.echo.size(), straight.echo.size());
  for (std::size_t i = 0; i < turned.echo.size(); ++i) EXPECT_EQ(turned.echo[i].key, straight.echo[i].key);
}

}  // namespace
}  // namespace froude::scene::pontoon_test
