// What the water meets at nodes: floats and sinkers, and cylinders that stand for what hangs there. (D113), (D153)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/line.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "loads.hpp"
#include "support/line_networks.hpp"

namespace bob_test {
namespace {

using namespace support;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81, pi = std::numbers::pi;

std::shared_ptr<const hydro::waves::WaveField> stream(double current) {
  const hydro::Water water{.density = 1000, .gravity = g, .depth = hydro::WaterDepth::from_metres(30)};
  return std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, water,
                                                       hydro::waves::HarmonicField::Options{},
                                                       hydro::waves::Current::uniform({current, 0}));
}

/// One rod without diameter, a sphere at its second node.
Description sphere_on_a_rod(Wet wet, double current) {
  Description d = rods(1, 2, 3, stiff);
  d.held = {{.node = 0}};
  d.nodes[1].mass = 20;
  d.nodes[1].bob = {.diameter = 0.6, .cd = 0.7, .ca = 0.5, .wet = wet, .buoyancy = true};
  d.water.field = stream(current);
  return d;
}

/// Of the second node in a stream: slopes by its place, velocity and acceleration, to `rounding`, and that what loads
/// do to it is what they are told to do.
void expect_slopes_and_powers(const Line& line, double height, double rounding) {
  Loads loads(line);
  Places x(3, 2), v(3, 2), a(3, 2);
  x << 0, 0.1, 0, 0.2, -2, height;
  v << 0, 0.7, 0, -0.2, 0, 0.5;
  a << 0, 0.3, 0, 0.9, 0, -1.1;
  const By by{.x = 0.6, .v = 1.7, .a = 2.9};
  const auto force = [&](double c, int axis) {
    Places at_x = x, at_v = v, at_a = a, out = Places::Zero(3, 2);
    at_x(axis, 1) += by.x * c;
    at_v(axis, 1) += by.v * c;
    at_a(axis, 1) += by.a * c;
    loads.add({0, at_x, at_v, at_a}, {0, 0, 0}, out, nullptr);
    return Vector3d(out.col(1));
  };
  Blocks blocks;
  blocks.set_zero(2, 1);
  Places sink = Places::Zero(3, 2);
  loads.add({0, x, v, a}, by, sink, &blocks);
  constexpr double e = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d slope = (force(e, axis) - force(-e, axis)) / (2 * e);
    EXPECT_LT((slope - blocks.diagonal[1].col(axis)).norm(), rounding) << height << ' ' << axis;
  }
  const LoadPowers p = loads.powers({0, x, v, a});
  EXPECT_NEAR((force(0, 0) - line.constant_load().col(1)).dot(v.col(1)),
              p.drag_supplied - p.drag_dissipated + p.inertia_supplied + p.buoyancy_supplied, 1e-10);
}

TEST(Sphere, HasTheDerivativesOfItsLoads) {
  for (const Wet wet : {Wet::all, Wet::below_surface})
    for (const double height : {-1.0, -0.1, 0.25, 0.9})
      expect_slopes_and_powers(Line(sphere_on_a_rod(wet, 0.4)), height, 1e-5);  // rounding of 1000 N over 2e-6
}

/// A node in a wave, where velocities and accelerations are of all sides.
Description cylinder_in_waves(bool by_component, bool relative_only) {
  Description d = rods(1, 2, 3, stiff);
  d.held = {{.node = 0}};
  d.nodes[1].mass = 20;
  d.nodes[1].bob = {.diameter = 0.2,
                    .cd = 1.4,
                    .ca = 0.8,
                    .length = 1.5,
                    .by_component = by_component,
                    .relative_only = relative_only};
  const hydro::Water water{.density = 1000, .gravity = g, .depth = hydro::WaterDepth::from_metres(30)};
  d.water.field = std::make_shared<hydro::waves::HarmonicField>(hydro::waves::linear_field(
      hydro::waves::Sea::regular(hydro::WaveAmplitude::from_metres(0.5), hydro::AngularFrequency::from_period_s(5),
                                 hydro::Angle::from_radians(0.7), water)));
  return d;
}

/// Equation 6.13 of Huijgen (2024) put down component by component, with the sign that its square has lost.
TEST(BobCylinder, IsHuijgensEquationAndMorisons) {
  for (const bool by_component : {false, true})
    for (const bool relative_only : {false, true}) {
      const Line line(cylinder_in_waves(by_component, relative_only));
      Loads loads(line);
      Places x(3, 2), v(3, 2), a(3, 2), out = Places::Zero(3, 2);
      x << 0, 0.3, 0, 0.4, -2, -2.2;
      v << 0, 0.7, 0, -0.9, 0, 0.1;
      a << 0, 0.3, 0, 0.9, 0, -1.1;
      loads.add({1.3, x, v, a}, {0, 0, 0}, out, nullptr);
      const auto water = line.description().water.field->at(1.3, Vector3d(x.col(1)));
      const Vector3d w = water.velocity - v.col(1), u_dot = water.material_acceleration();
      const double mass = pi / 4 * 1000 * 0.2 * 0.2 * 1.5, half = 0.5 * 1000 * 0.2 * 1.5 * 1.4;
      for (int i = 0; i < 3; ++i) {
        const double drag = half * (by_component ? std::abs(w[i]) : w.norm()) * w[i];
        const double inertia =
            relative_only ? 0.8 * mass * (u_dot[i] - a(i, 1)) : mass * (1.8 * u_dot[i] - 0.8 * a(i, 1));
        const double weight = line.constant_load()(i, 1);
        EXPECT_NEAR(out(i, 1), drag + inertia + weight, 1e-10) << i;  // rounding of some hundred newtons
      }
      EXPECT_EQ(line.constant_load()(2, 1), -(20 + 1.5) * g) << "no buoyancy";
    }
}

TEST(BobCylinder, HasTheDerivativesOfItsLoads) {
  for (const bool by_component : {false, true}) {
    Description d = sphere_on_a_rod(Wet::all, 0.4);
    d.nodes[1].bob = {.diameter = 0.2, .cd = 1.4, .ca = 0.8, .length = 1.5, .by_component = by_component};
    const Line line(d);
    expect_slopes_and_powers(line, -1, 1e-4);  // rounding of 1000 N over 2e-6
    EXPECT_EQ(Loads(line).powers({0, Places::Zero(3, 2), Places::Ones(3, 2), Places::Zero(3, 2)}).buoyancy_supplied, 0);
  }
}

TEST(BobCylinder, IsAlwaysWet) {
  Description d = sphere_on_a_rod(Wet::below_surface, 0);
  d.nodes[1].bob.length = 1;
  EXPECT_THAT([&] { const Line line(d); }, ThrowsMessage<hydro::InputError>(HasSubstr("always wet")));
}

TEST(Sphere, IsMorisonsInAStream) {
  Description d = sphere_on_a_rod(Wet::all, 0.5);
  const Line line(d);
  Loads loads(line);
  Places x = Places::Zero(3, 2), none = Places::Zero(3, 2), a = none, out = none;
  x(2, 1) = -2;
  a(2, 1) = 1;
  loads.add({0, x, none, a}, {0, 0, 0}, out, nullptr);
  const double V = pi / 6 * 0.216;
  EXPECT_NEAR(out(0, 1), 0.5 * 1000 * 0.7 * pi / 4 * 0.36 * 0.25, 1e-10);
  EXPECT_NEAR(out(2, 1), 1000 * V * (g - 0.5) - (20 + 1.5) * g, 1e-9);
}

// Half of it is wet where it weighs half of what it displaces; on a slack line it floats so.
TEST(Sphere, FloatsWhereItDisplacesItsWeight) {
  Description d = sphere_on_a_rod(Wet::below_surface, 0);
  d.segments.clear();
  for (int j = 0; j < 3; ++j) d.segments.push_back(Segment::rod(2, 1e-3));
  d.nodes.insert(d.nodes.begin(), 2, Node{});
  const double V = pi / 6 * 0.216;
  d.nodes[3].mass = 500 * V - 0.5e-3;
  d.held = {{.node = 0}};
  append(d, rods(1, 1, 1e-3, stiff));  // another line from there, so that it is a network
  d.held.push_back({.node = 5});
  d.ties = {{3, 4}};
  for (int j = 0; j < 4; ++j) {
    d.segments[static_cast<std::size_t>(j)].axial_stiffness = 1e5;
    d.segments[static_cast<std::size_t>(j)].tension_only = true;
  }
  const Line line(d);
  State places{.position = Places::Zero(3, 6), .velocity = Places::Zero(3, 6), .tension = VectorXd::Zero(4)};
  places.position.col(0) << 0, 0, -4;
  places.position.col(5) << 0, 0.99, 0;
  EXPECT_NEAR(equilibrium(line, hanging_shape(line, places)).position(2, 3), 0,
              1e-4);  // the lines weigh some 1e-5 of it
}

}  // namespace
}  // namespace bob_test
