// Laws of force that depend on where bodies are and how they move, written a second time from their formulas and
// differentiated by machine. Loads of waves and of weight, slamming, cylinders in closed form, lines from tables, and
// the constraints of joints and contacts are in more_tangents_test.cpp. What remains without such a law: lines of nodes
// (tests/dynamics/line), Morison members in stretched or nonlinear waves (differences in morison_test.cpp), prescribed
// motions through points (prescribed_motion_test.cpp), and parallel rods that touch, whose gap has no derivative.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "dynamics/force/buoyancy.hpp"
#include "dynamics/force/catenary_mooring.hpp"
#include "dynamics/force/connector.hpp"
#include "dynamics/force/constant_load.hpp"
#include "dynamics/force/drag.hpp"
#include "dynamics/force/friction.hpp"
#include "dynamics/force/morison.hpp"
#include "dynamics/force/pto.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/force/switched_connector.hpp"
#include "dynamics/joint/constraints.hpp"
#include "hydro/waves/dispersion.hpp"
#include "laws/automatic_tangents.hpp"
#include "support/hull_meshes.hpp"
#include "support/small_seas.hpp"

namespace tangents_test {
namespace {

using namespace dynamics;
using laws::Jet;
using laws::JetBody;
using laws::JetLoads;
using laws::JetMatrix;
using laws::jets;
using laws::JetVector;
using laws::length;
using std::numbers::pi;

const auto bodies = support::two_bodies();

JetMatrix cross(const JetVector& v) {
  JetMatrix m;
  m << Jet(0), -v[2], v[1], v[2], Jet(0), -v[0], -v[1], v[0], Jet(0);
  return m;
}
/// Components scaled one by one.
JetVector times(const Eigen::Vector3d& factors, const JetVector& v) {
  return {factors[0] * v[0], factors[1] * v[1], factors[2] * v[2]};
}

/// Rotation vector of R, from its antisymmetric part and its trace; not near 0 or π.
JetVector rotation_vector(const JetMatrix& R) {
  const JetVector a =
      JetVector(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)) * Jet(0.5);  // sin θ times the axis
  const Jet s = length(a), c = (R(0, 0) + R(1, 1) + R(2, 2) - 1.0) * 0.5;
  return a * (atan2(s, c) / s);
}
/// J(φ)⁻¹ = 1 − ½[φ]× + (1/θ² − (1 + cos θ)/(2θ sin θ))[φ]×² (Solà et al. 2018).
JetMatrix inverse_jacobian(const JetVector& phi) {
  const Jet theta = length(phi);
  const JetMatrix S = cross(phi);
  const Jet factor = 1.0 / (theta * theta) - (1.0 + cos(theta)) / (2.0 * theta * sin(theta));
  return JetMatrix::Identity() - S * Jet(0.5) + S * S * factor;
}

TEST(Tangents, OfRestoringFollowFromItsPotential) {  // (D2)
  Matrix6 C = Matrix6::Zero(), D;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) C(i, j) = C(j, i) = 300.0 * (i == j) + 20 * i - 7 * j;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) D(i, j) = 40.0 * (i == j) + i - 2 * j;
  const RestoringKind kind("mooring", bodies, {{0, C, D}, {1, 2 * C}});
  laws::expect_automatic_tangents_everywhere(kind, bodies, [&](const JetBody& a, const JetBody& b, double) {
    JetLoads out;
    for (const auto& [body, i] : {std::pair{&a, 0}, {&b, 1}}) {
      Eigen::Matrix<Jet, 6, 1> delta, v;
      const JetVector phi = rotation_vector(body->attitude);
      delta << body->centre - jets(bodies[static_cast<std::size_t>(i)].rest_centre()), phi;
      v << body->velocity, body->omega;
      const Eigen::Matrix<Jet, 6, 1> g = ((1.0 + i) * C).cast<Jet>() * delta;
      Eigen::Matrix<Jet, 6, 1> F;
      F << JetVector(-g.head<3>()), JetVector(-(inverse_jacobian(phi).transpose() * JetVector(g.tail<3>())));
      if (i == 0) F -= D.cast<Jet>() * v;
      out.all.segment<6>(6 * i) += F;
    }
    return out;
  });
}

TEST(Tangents, OfConstantLoadsAreThoseOfTheirArms) {
  const Eigen::Vector3d arm(1, 2, 3), force(10, -20, 30), moment(5, 6, -7);
  laws::expect_automatic_tangents_everywhere(ConstantLoadKind({{{0, arm}, force, moment}}), bodies,
                                             [&](const JetBody& a, const JetBody&, double) {
                                               JetLoads out;
                                               out.force(0, a.arm(arm), jets(force));
                                               out.moment(0, jets(moment));
                                               return out;
                                             });
}

const Ends between{{0, Eigen::Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Eigen::Vector3d(-1, 0.5, -0.1)}};
const Ends to_ground{{1, Eigen::Vector3d(1, 0, 0)}, PointOnGround{Eigen::Vector3d(9, 1, -2)}};

/// An end and its velocity.
struct JetEnd {
  JetVector arm, place, velocity;
};
JetEnd end_of(const JetBody& body, const Eigen::Vector3d& at) {
  const JetVector arm = body.arm(at);
  return {arm, body.centre + arm, body.velocity_at(arm)};
}
JetEnd on_ground(const Eigen::Vector3d& at) { return {jets(at), jets(at), jets(Eigen::Vector3d::Zero())}; }

/// A pull T(L − L₀, dL/dt) along the line between two ends. (D3)
template <class Tension>
void pull(JetLoads& out, const Ends& ends, const JetBody& a, const JetBody& b, double rest, Tension tension) {
  const auto on_body = [&](const PointOnBody& end) { return end_of(end.body == 0 ? a : b, end.arm); };
  const auto* second = std::get_if<PointOnBody>(&ends.second);
  const JetEnd p = on_body(ends.first),
               q = second != nullptr ? on_body(*second) : on_ground(std::get<PointOnGround>(ends.second).place);
  const JetVector d = q.place - p.place;
  const Jet L = length(d);
  const JetVector u = d / L, f = u * tension(L - rest, u.dot(JetVector(q.velocity - p.velocity)));
  out.force(ends.first.body, p.arm, f);
  if (second != nullptr) out.force(second->body, q.arm, -f);
}

TEST(Tangents, OfAxialConnectorsFollowFromTheirLength) {
  const LineLaw cubic{.stiffness = 200, .damping = 30, .cubic = 50, .quadratic_damping = 12},
      cable{.stiffness = 200, .damping = 90, .tension_only = true},
      table{.damping = 5, .table_x = {-1, 0.1, 0.6, 2}, .table_force = {-300, 0, 100, 700}};
  const AxialConnectorKind kind({{between, cubic, 1.5}, {to_ground, cable, 2}, {between, table, 1.6}});
  laws::expect_automatic_tangents_everywhere(kind, bodies, [&](const JetBody& a, const JetBody& b, double) {
    JetLoads out;
    pull(out, between, a, b, 1.5, [](const Jet& x, const Jet& rate) {  // (D50)
      return 200.0 * x + 50.0 * x * x * x + 30.0 * rate + 12.0 * abs(rate) * rate;
    });
    pull(out, to_ground, a, b, 2, [](const Jet& x, const Jet& rate) {  // (D51)
      const Jet S = 200.0 * x, d = 90.0 * rate;
      return x > Jet(0) ? S + S * d / (S + abs(d)) : Jet(0);
    });
    pull(out, between, a, b, 1.6, [](const Jet& x, const Jet& rate) {
      const Jet spring = x < Jet(0.1)   ? (x - 0.1) * (300 / 1.1)
                         : x < Jet(0.6) ? (x - 0.1) * 200.0
                                        : 100.0 + (x - 0.6) * (600 / 1.4);
      return spring + 5.0 * rate;
    });
    return out;
  });
}

TEST(Tangents, OfSwitchedConnectorsAreThoseOfTheStiffnessThatIsSet) {
  const SwitchedConnectorKind kind({SwitchedConnectors{{between, {3000, 200}, 1.5}}});
  laws::expect_automatic_tangents_everywhere(kind, bodies, [&](const JetBody& a, const JetBody& b, double) {
    JetLoads out;
    pull(out, between, a, b, 1.5, [](const Jet& x, const Jet& rate) { return 3000.0 * x + 200.0 * rate; });
    return out;
  });
}

TEST(Tangents, OfBushingsFollowFromStrainAndTurn) {  // (D4)
  const Eigen::Vector3d k(1000, 2000, 500), c(30, 10, 60), kr(300, 200, 100), cr(5, 8, 3), rest(2, 0, 0);
  const BushingConnectorKind kind({{between, k, c, kr, cr, rest}});
  laws::expect_automatic_tangents_everywhere(kind, bodies, [&](const JetBody& a, const JetBody& b, double) {
    const JetEnd p = end_of(a, between.first.arm), q = end_of(b, std::get<PointOnBody>(between.second).arm);
    const JetMatrix back = a.attitude.transpose();
    const JetVector d = q.place - p.place, arm = q.place - a.centre;
    const JetVector shift = back * d - jets(rest),
                    shift_rate = back * JetVector(q.velocity - a.velocity - a.omega.cross(arm));
    const JetVector turn = rotation_vector(back * b.attitude), turn_rate = back * JetVector(b.omega - a.omega);
    const JetVector f = a.attitude * JetVector(times(k, shift) + times(c, shift_rate));
    const JetVector m =
        a.attitude * JetVector(inverse_jacobian(turn).transpose() * times(kr, turn) + times(cr, turn_rate));
    JetLoads out;
    out.force(0, arm, f);
    out.force(1, q.arm, -f);
    out.moment(0, m);
    out.moment(1, -m);
    return out;
  });
}

TEST(Tangents, OfDragFollowFromTheFlowAcross) {  // (D7)
  const Eigen::Vector3d arm(0.4, -0.3, -1.2), axis = Eigen::Vector3d(1, 2, -2) / 3, current(0.7, -0.2, 0.1);
  const DragKind kind({{0, arm, axis, 35, current}, {1, -arm, axis, 20}}, std::nullopt);
  laws::expect_automatic_tangents_everywhere(kind, bodies, [&](const JetBody& a, const JetBody& b, double) {
    JetLoads out;
    const auto piece = [&](int i, const JetBody& body, const Eigen::Vector3d& at, double factor,
                           const Eigen::Vector3d& water) {
      const JetVector r = body.arm(at), t = body.arm(axis), w = jets(water) - body.velocity_at(r),
                      across = w - t * t.dot(w);
      out.force(i, r, across * (factor * length(across)));
    };
    piece(0, a, arm, 35, current);
    piece(1, b, -arm, 20, Eigen::Vector3d::Zero());
    return out;
  });
}

Joint joint(JointKind kind) {
  return {.name = "j", .kind = kind, .first = 0, .second = 1, .place = {2, 0.3, -0.2}, .axis = {0.2, 1, 0.4}};
}

/// Coordinate, its rate, and the load T against it. (D53)
template <class Force>
JetLoads against_coordinate(const Joint& j, const JetBody& a, const JetBody& b, Force T) {
  const Eigen::Matrix3d frame = frame_of(j);
  const Eigen::Vector3d first = j.place - bodies[0].rest_centre(), second = j.place - bodies[1].rest_centre();
  JetLoads out;
  if (j.kind == JointKind::slider) {
    const JetVector n = a.arm(frame.col(0)), pa = a.point(first), rb = b.arm(second), pb = b.centre + rb,
                    from_a = pb - a.centre;
    const JetVector f = n * T(n.dot(JetVector(pb - pa)), n.dot(JetVector(b.velocity_at(rb) - a.velocity_at(from_a))));
    out.force(0, from_a, f);
    out.force(1, rb, -f);
    return out;
  }
  const JetVector y1 = a.arm(frame.col(1)), z1 = a.arm(frame.col(2)), y2 = b.arm(frame.col(1));
  const Jet c = y1.dot(y2), s = z1.dot(y2);
  // ċ = (ω₁ − ω₂)·(y₁ × y₂) and ṡ alike, so that dx/dt = g·(ω₁ − ω₂).
  const JetVector g = (z1.cross(y2) * c - y1.cross(y2) * s) / (c * c + s * s);
  const JetVector m = g * T(atan2(s, c), g.dot(JetVector(a.omega - b.omega)));
  out.moment(0, -m);
  out.moment(1, m);
  return out;
}

TEST(Tangents, OfPowerTakeOffFollowFromTheCoordinate) {
  const PtoLaw law{.line = {.stiffness = 200, .damping = 30, .cubic = 50, .quadratic_damping = 12},
                   .preload = 40,
                   .lower = {},
                   .upper = {}};
  for (const JointKind of : {JointKind::slider, JointKind::hinge})
    laws::expect_automatic_tangents_everywhere(
        PtoKind({{JointCoordinate(bodies, joint(of), 0), law}}), bodies,
        [&](const JetBody& a, const JetBody& b, double) {
          return against_coordinate(joint(of), a, b, [](const Jet& x, const Jet& rate) {
            return 40.0 + 200.0 * x + 50.0 * x * x * x + 30.0 * rate + 12.0 * abs(rate) * rate;
          });
        });
}

TEST(Tangents, OfPowerTakeOffKeepToItsLimitAndItsStops) {  // (D51), (D52)
  const PtoLaw law{.line = {.stiffness = 200, .damping = 30},
                   .preload = 40,
                   .force_limit = 150,
                   .lower = EndStop{-0.1, 3000, 200},
                   .upper = EndStop{0.1, 3000, 200}};
  const auto stop = [](const Jet& into, const Jet& rate) {  // never pulls
    const Jet S = 3000.0 * into, d = 200.0 * rate;
    return into.a > 0 ? S + S * d / (S + abs(d)) : Jet(0);
  };
  for (const JointKind of : {JointKind::slider, JointKind::hinge})
    laws::expect_automatic_tangents_everywhere(
        PtoKind({{JointCoordinate(bodies, joint(of), 0), law}}), bodies,
        [&](const JetBody& a, const JetBody& b, double) {
          return against_coordinate(joint(of), a, b, [&](const Jet& x, const Jet& rate) {
            const Jet T = 40.0 + 200.0 * x + 30.0 * rate;
            const Jet held = T.a > 150 ? Jet(150) : T.a < -150 ? Jet(-150) : T;
            return held + stop(x - 0.1, rate) - stop(-0.1 - x, -rate);
          });
        });
}

TEST(Tangents, OfFrictionThatSlipsFollowFromTheCoordinate) {  // (D19), (D32)
  for (const JointKind of : {JointKind::slider, JointKind::hinge}) {
    const FrictionKind kind({{.name = "j",
                              .coordinate = JointCoordinate(bodies, joint(of)),
                              .breakaway = 5,
                              .sliding = 3,
                              .stribeck = 1.2}});
    FrictionMemory memory(1);
    for (const double direction : {1.0, -1.0})
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        memory.direction = {direction > 0 ? 1 : -1};
        laws::expect_automatic_tangents(kind, support::random_state(bodies, seed, 0.7), &memory,
                                        [&](const JetBody& a, const JetBody& b, double) {
                                          return against_coordinate(joint(of), a, b, [&](const Jet&, const Jet& rate) {
                                            return direction * (3.0 + 2.0 * exp(-rate * rate / 1.44));
                                          });
                                        });
      }
  }
}

/// (D60): the span of a line for its pull at the fairlead.
std::array<Jet, 2> span_of(const LineProperties& line, const Jet& H, const Jet& V) {
  const double w = line.weight, EA = line.axial_stiffness;
  const auto arsinh = [](const Jet& x) { return log(x + sqrt(x * x + 1.0)); };
  Jet low = V - w * line.length;
  Jet resting(0);
  if (line.on_bed && low < Jet(0)) {  // (D61): what lies on the bed is stretched by H alone
    resting = -low / w;
    low = Jet(0);
  }
  return {resting + (arsinh(V / H) - arsinh(low / H)) * H / w + H * line.length / EA,
          (sqrt(H * H + V * V) - sqrt(H * H + low * low)) / w + (V * V - low * low) / (2 * EA * w)};
}

/// H and V for a span: Newton in doubles by the derivatives of the jets, then once in jets for theirs.
std::array<Jet, 2> tension_for(const LineProperties& line, const Jet& x, const Jet& z, double H, double V) {
  Eigen::Matrix2d J;
  for (int i = 0; i < 4; ++i) {
    const auto at = span_of(line, Jet(H, 0), Jet(V, 1));
    J << at[0].v[0], at[0].v[1], at[1].v[0], at[1].v[1];
    const Eigen::Vector2d step = J.inverse() * Eigen::Vector2d(x.a - at[0].a, z.a - at[1].a);
    H += step[0], V += step[1];
  }
  const auto at = span_of(line, Jet(H), Jet(V));
  const Eigen::Matrix2d K = J.inverse();
  return {H + K(0, 0) * (x - at[0]) + K(0, 1) * (z - at[1]), V + K(1, 0) * (x - at[0]) + K(1, 1) * (z - at[1])};
}

TEST(Tangents, OfCatenariesFollowFromTheirSpan) {  // (D60)-(D63)
  const std::vector<CatenaryMooring> lines{{{0, {1, 0.5, -1}}, {{50, 10, -20}}, {60, 700, 1e7, true}},
                                           {{1, {0, 0, -1}}, {{-20, 3, -15}}, {34, 300, 1e6, false}}};
  // The line is solved to 1e-12 of its length, which is round-off of its stretch HL/EA a hundredfold: 1e-9 of the pull.
  laws::expect_automatic_tangents_everywhere(
      CatenaryMooringKind(lines), bodies,
      [&](const JetBody& a, const JetBody& b, double) {
        JetLoads out;
        for (const CatenaryMooring& m : lines) {
          const JetBody& body = m.fairlead.body == 0 ? a : b;
          const JetVector r = body.arm(m.fairlead.arm), d = body.centre + r - jets(m.anchor.place);
          const Jet x = sqrt(d[0] * d[0] + d[1] * d[1]);
          const auto start = catenary(m.line, x.a, d[2].a);
          const auto [H, V] = tension_for(m.line, x, d[2], start.horizontal, start.vertical);
          out.force(m.fairlead.body, r, JetVector(-H * d[0] / x, -H * d[1] / x, -V));
        }
        return out;
      },
      {.load = 1e-9, .tangent = 1e-9});
}

/// ∫∫ f z n_z dA over the part of a triangle below z = 0, f = 1, x, y: volume and its first moments about the z axis,
/// since the plane z = 0 that closes the shape adds nothing. Midpoints of edges integrate squares exactly.
void add_wet_triangle(const std::array<JetVector, 3>& corner, std::array<Jet, 3>& out) {
  std::vector<JetVector> wet;
  for (std::size_t i = 0; i < 3; ++i) {
    const JetVector &p = corner[i], &q = corner[(i + 1) % 3];
    if (p[2].a < 0) wet.push_back(p);
    if (p[2].a * q[2].a < 0) wet.push_back(p + (q - p) * (p[2] / (p[2] - q[2])));
  }
  for (std::size_t i = 1; i + 1 < wet.size(); ++i) {
    const JetVector &p = wet[0], &q = wet[i], &r = wet[i + 1];
    const Jet area_up = JetVector(q - p).cross(JetVector(r - p))[2] * 0.5;  // n_z dA
    for (const JetVector& m :
         {JetVector((p + q) * Jet(0.5)), JetVector((q + r) * Jet(0.5)), JetVector((r + p) * Jet(0.5))}) {
      out[0] += area_up * m[2] / 3.0;
      out[1] += area_up * m[2] * m[0] / 3.0;
      out[2] += area_up * m[2] * m[1] / 3.0;
    }
  }
}

TEST(Tangents, OfBuoyancyFollowFromTheWetVolume) {  // (D30)
  namespace hh = hydro::hydrostatics;
  const auto mesh = support::box_mesh({-1, -0.5, -0.6}, {1.2, 0.6, 0.5});
  const Eigen::Vector3d middle(-0.9, 0.3, -0.2), cog(0.1, -0.2, 0.3);
  const double radius = 0.9, weight = 1000 * 9.81;
  const BuoyancyKind kind(bodies,
                          {{0, std::make_shared<const FloatingShape>(hh::Hull(mesh))},
                           {1, std::make_shared<const FloatingShape>(hh::Sphere{middle, radius})}},
                          hydro::Water{.density = 1000, .gravity = 9.81});
  laws::expect_automatic_tangents_everywhere(kind, bodies, [&](const JetBody& a, const JetBody& b, double) {
    std::array<Jet, 3> hull{Jet(0), Jet(0), Jet(0)};
    for (const auto& t : mesh.triangles) {
      const auto corner = [&](int i) { return a.point(mesh.vertices[static_cast<std::size_t>(i)] - cog); };
      add_wet_triangle({corner(t[0]), corner(t[1]), corner(t[2])}, hull);
    }
    JetLoads out;
    out.all[2] += weight * hull[0];
    out.all[3] += weight * (hull[2] - a.centre[1] * hull[0]);
    out.all[4] -= weight * (hull[1] - a.centre[0] * hull[0]);
    // A cap of the depth h under the plane: V = πh²(3r − h)/3; pressure goes through the middle.
    const JetVector arm = b.arm(middle - cog);
    const Jet h = radius - (b.centre[2] + arm[2]);
    const Jet V = h.a <= 0            ? Jet(0)
                  : h.a >= 2 * radius ? Jet(4 * pi / 3 * radius * radius * radius)
                                      : pi / 3 * h * h * (3 * radius - h);
    out.force(1, arm, JetVector(Jet(0), Jet(0), weight * V));
    return out;
  });
}

/// (D42): ∫β dg and ∫∫β dg dg of the wetness β of a section of height h.
Jet wet_once(const Jet& g, const Jet& h) {
  if (g.a <= -h.a / 2) return Jet(0);
  return g.a >= h.a / 2 ? g : (g + h / 2.0) * (g + h / 2.0) / (2.0 * h);
}
Jet wet_twice(const Jet& g, const Jet& h) {
  if (g.a <= -h.a / 2) return Jet(0);
  const Jet s = g + h / 2.0;
  return g.a >= h.a / 2 ? g * g / 2.0 + h * h / 24.0 : s * s * s / (6.0 * h);
}

/// Water at a place: velocity, and acceleration of its particles.
struct JetWater {
  JetVector velocity, acceleration;
};

struct StillSurface {
  Jet operator()(const JetVector&) const { return Jet(0); }
};

/// (D43) on a member.
template <class Water, class Surface = StillSurface>
JetLoads morison(const MorisonMember& m, const JetBody& body, Water water_at, Surface surface_at = {}) {
  const double D = m.line.diameter, displaced = 1000 * pi / 4 * D * D;
  const JetVector from = body.arm(m.line.from), along = body.arm(m.line.to - m.line.from);
  const double whole = (m.line.to - m.line.from).norm();
  const JetVector t = along / Jet(whole);
  const Jet rise = D * sqrt(1.0 - t[2] * t[2] + 1e-12);
  JetLoads out;
  const auto add = [&](const Jet& place, const Jet& share) {
    const JetVector r = from + along * place;
    const JetWater water = water_at(JetVector(body.centre + r));
    const JetVector w = water.velocity - body.velocity_at(r), lengthwise = t * t.dot(w), across = w - lengthwise;
    // Of ẇ, ω × (ω × r) is here and the rest on the left.
    const JetVector turning = body.omega.cross(JetVector(body.omega.cross(r)));
    const JetVector y = water.acceleration * Jet((1 + m.ca) * displaced) - turning * Jet(m.ca * displaced);
    const JetVector per_length = across * (500 * m.cd * D * length(across)) +
                                 lengthwise * (500 * m.cd_tangential * pi * D * length(lengthwise)) + y - t * t.dot(y);
    out.force(m.line.body, r, per_length * (share * whole));
  };
  const auto add_gauss = [&](const Jet& f0, const Jet& f1) {
    for (const double g : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)})
      add((f0 + f1) * 0.5 + (f1 - f0) * (0.5 * g), (f1 - f0) * 0.5);
  };
  for (int i = 0; i < m.line.pieces; ++i) {
    const double f0 = static_cast<double>(i) / m.line.pieces, part = 1.0 / m.line.pieces;
    if (m.line.immersion == Immersion::whole) {
      const Jet still = -(body.centre[2] + from[2]) / along[2];  // where the axis goes through still water
      const bool cut = still.a > f0 && still.a < f0 + part;
      add_gauss(Jet(f0), cut ? still : Jet(f0 + part));
      if (cut) add_gauss(still, Jet(f0 + part));
      continue;
    }
    const auto height = [&](double f) {
      const JetVector at = body.centre + from + along * Jet(f);
      return surface_at(at) - at[2];
    };
    const Jet g0 = height(f0), g1 = height(f0 + part), d = g1 - g0;
    const Jet share = (wet_once(g1, rise) - wet_once(g0, rise)) / d;
    if (share.a <= 0) continue;
    const Jet place = (wet_once(g1, rise) / d - (wet_twice(g1, rise) - wet_twice(g0, rise)) / (d * d)) / share;
    add(f0 + part * place, share * part);
  }
  return out;
}

/// A current that is straight in z up to the surface, and goes on as there. No water accelerates: it flows along the
/// planes on which it is constant.
JetWater straight_current(const JetVector& at, const Eigen::Vector3d& u0, const Eigen::Vector3d& shear) {
  const Jet z = at[2].a < 0 ? at[2] : Jet(0);
  return {jets(u0) + jets(shear) * z, jets(Eigen::Vector3d::Zero())};
}

/// The linear wave of support::steep_wave() (Airy), η = a cos(ωt − ks + ψ), s along 20 degrees.
const Eigen::Vector3d ahead(std::cos(20 * pi / 180), std::sin(20 * pi / 180), 0);
constexpr double omega = 2 * pi / 4;
double airy_wavenumber() { return hydro::waves::wavenumber(omega, support::fresh_water); }
Jet airy_phase(const JetVector& at, double t) { return omega * t + 0.3 - airy_wavenumber() * jets(ahead).dot(at); }
JetWater airy(const JetVector& at, double t, double amplitude) {
  const double h = 20, k = airy_wavenumber();
  const Jet theta = airy_phase(at, t), up = k * (at[2] + h);
  const double A = amplitude * omega / std::sinh(k * h);
  const Jet C = A * cosh(up) * cos(theta), S = A * sinh(up) * sin(theta);  // u and −w
  const Jet c = A * cosh(up) * sin(theta), s = A * sinh(up) * cos(theta);  // −u̇/ω and −ẇ/ω
  const Jet u = C, w = -S;
  const Jet du = -omega * c + u * (k * c) + w * (k * s), dw = -omega * s + u * (k * s) - w * (k * c);
  return {jets(ahead) * u + jets(Eigen::Vector3d::UnitZ()) * w, jets(ahead) * du + jets(Eigen::Vector3d::UnitZ()) * dw};
}

MorisonMember member(Immersion immersion, const Eigen::Vector3d& to) {
  const Eigen::Vector3d c = bodies[0].rest_centre();
  return MorisonMember{{0, Eigen::Vector3d(-1, 0.3, -3) - c, to - c, 0.4, 5, immersion}, 1.1, 0.9, 0.02};
}

// The water's gradients are one-sided differences over a millionth of the diameter, as (D45) says, so that no wave
// theory need give second derivatives: the tangent is deliberately good to κD 10⁻⁶ in waves.
TEST(Tangents, OfMorisonMembersInAWaveFollowFromItsPotential) {
  const MorisonMember m = member(Immersion::whole, {1, -0.2, -1.4});
  const MorisonKind kind({m}, support::steep_wave(hydro::waves::Stretching::none));
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    State s = support::random_state(bodies, seed, 0.15);  // all of it stays below still water
    s.time = 0.7 * static_cast<double>(seed);
    laws::expect_automatic_tangents(kind, s, nullptr,
                                    [&](const JetBody& a, const JetBody&, double t) {
                                      return morison(m, a, [&](const JetVector& at) { return airy(at, t, 0.6); });
                                    },
                                    {.load = 1e-11, .tangent = 1e-6});
  }
}

// The slope of the surface is such a difference too.
TEST(Tangents, OfMorisonMembersThroughAWaveFollowFromItsSurface) {
  const MorisonMember m = member(Immersion::surface, {1, -0.2, 0.8});
  const MorisonKind kind({m}, support::steep_wave(hydro::waves::Stretching::none));
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    State s = support::random_state(bodies, seed, 0.3);
    s.time = 0.7 * static_cast<double>(seed);
    laws::expect_automatic_tangents(kind, s, nullptr,
                                    [&](const JetBody& a, const JetBody&, double t) {
                                      return morison(
                                          m, a, [&](const JetVector& at) { return airy(at, t, 0.6); },
                                          [&](const JetVector& at) { return 0.6 * cos(airy_phase(at, t)); });
                                    },
                                    {.load = 1e-11, .tangent = 1e-6});
  }
}

TEST(Tangents, OfMorisonMembersFollowFromTheFlow) {  // (D42)-(D45)
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const auto current = hydro::waves::Current::profile({-20, 0}, {{0.1, 0}, {0.5, 0.2}});
  struct Case {
    const char* what;
    MorisonMember member;
    std::shared_ptr<const hydro::waves::WaveField> water;
    Eigen::Vector3d u0, shear;
    double tangent;
  };
  const Case cases[] = {
      {"under still water", member(Immersion::whole, {1, -0.2, -1.4}), support::still_water(), none, none, 1e-11},
      {"through still water", member(Immersion::still_water, {1, -0.2, 0.8}), support::still_water(), none, none,
       1e-11},
      // Of a straight current a difference has no error but round-off of u over 4e-7 m.
      {"in a current",
       member(Immersion::whole, {1, -0.2, -1.4}),
       support::still_water(current),
       {0.5, 0.2, 0},
       {0.02, 0.01, 0},
       1e-8},
      {"always wet, through still water, where the current bends",
       member(Immersion::whole, {1, -0.2, 0.8}),
       support::still_water(current),
       {0.5, 0.2, 0},
       {0.02, 0.01, 0},
       1e-8}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    laws::expect_automatic_tangents_everywhere(
        MorisonKind({c.member}, c.water), bodies,
        [&](const JetBody& a, const JetBody&, double) {
          return morison(c.member, a, [&](const JetVector& at) { return straight_current(at, c.u0, c.shear); });
        },
        {.load = 1e-11, .tangent = c.tangent});
  }
}

TEST(Tangents, AreFoundWrongByTheSuiteWhereTheyAre) {
  // A law that differs from the kind's in one sign of its damper, and in one part in a million of its stiffness.
  const AxialConnectorKind kind({{between, {3000, 200}, 1.5}});
  const State s = support::random_state(bodies, 3, 0.5);
  const auto tangents_of = [&](double k, double c) {
    JetLoads out;
    pull(out, between, laws::jet_body(s, 0), laws::jet_body(s, 1), 1.5,
         [&](const Jet& x, const Jet& rate) { return k * x + c * rate; });
    return out;
  };
  const Eigen::MatrixXd by_q = laws::jacobian(kind, s, nullptr, 1, 0);
  const auto apart = [&](const JetLoads& loads) {
    double worst = 0;
    for (Eigen::Index i = 0; i < 12; ++i)
      worst = std::max(worst, (loads.all[i].v.head<12>().transpose() - by_q.row(i)).cwiseAbs().maxCoeff());
    return worst / by_q.cwiseAbs().maxCoeff();
  };
  EXPECT_LT(apart(tangents_of(3000, 200)), 1e-10);
  EXPECT_GT(apart(tangents_of(3000, -200)), 1e-3);
  EXPECT_GT(apart(tangents_of(3000 * (1 + 1e-6), 200)), 1e-8);
}

}  // namespace
}  // namespace tangents_test
