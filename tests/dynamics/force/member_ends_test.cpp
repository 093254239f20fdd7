// Loads on the ends of members: closed forms, the laws of forces, and what responses have of them. (D171)
#include "dynamics/force/member_ends.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/force/restoring.hpp"
#include "dynamics/frequency/linear_drag.hpp"
#include "dynamics/frequency/member_inertia.hpp"
#include "dynamics/frequency/rao.hpp"
#include "hydro/waves/dispersion.hpp"
#include "laws/force_kind_laws.hpp"
#include "support/small_seas.hpp"

namespace member_ends_test {
namespace {

using namespace dynamics;
using hydro::waves::Stretching;
using std::numbers::pi;

const auto bodies = support::two_bodies();

/// Of the member between two points, global, at rest; loads on its first end, or on both.
MemberEnds member(int body, const Eigen::Vector3d& from, const Eigen::Vector3d& to, bool both, double pressed,
                  double added, double drag) {
  const Eigen::Vector3d c = bodies[static_cast<std::size_t>(body)].rest_centre(), along = (to - from).normalized();
  MemberEnds out{.name = "m", .body = body, .ends = {}};
  out.ends.push_back({.arm = from - c, .inward = along, .pressed = pressed, .added = added, .drag = drag});
  if (both) out.ends.push_back({.arm = to - c, .inward = -along, .pressed = pressed, .added = added, .drag = drag});
  return out;
}

Vector6 load_at(const MemberEndsKind& kind, double t) {
  State s = rest_state(bodies);
  s.time = t;
  return laws::load(kind, s, nullptr).head<6>();
}

TEST(ForceLaws, HoldForEndsOfMembers) {
  const auto current = hydro::waves::Current::profile({-20, 0}, {{0.1, 0}, {0.5, 0.2}});
  for (const auto& water : {support::still_water(current), support::steep_wave(Stretching::wheeler),
                            support::steep_wave(Stretching::none, current)}) {
    SCOPED_TRACE(water->elevation(0, 0, 0));
    laws::expect_force_laws(MemberEndsKind({member(0, {-1, 0.3, -3}, {1, -0.2, -1.6}, true, 0.4, 70, 110),
                                            member(1, {2, 1, -4}, {2, 1.5, -2}, false, 0.2, 0, 30)},
                                           water),
                            bodies);
  }
}

// Under still water at an end at depth z a wave of amplitude a has the pressure ρ g a cosh k(z+h)/cosh kh.
TEST(MemberEnds, OfAVerticalMemberAreLiftedByThePressureAtItsFoot) {
  constexpr double a = 0.6, area = 0.5, foot = -3;
  const MemberEndsKind kind({member(0, {0, 0, foot}, {0, 0, 0.5}, false, area, 0, 0)},
                            support::steep_wave(Stretching::none));
  const double k = hydro::waves::wavenumber(2 * pi / 4, support::fresh_water), h = 20;
  const double amplitude = 1000 * 9.81 * a * std::cosh(k * (foot + h)) / std::cosh(k * h) * area;
  std::complex<double> sum = 0;
  constexpr int samples = 16;  // of one harmonic, exactly
  for (int i = 0; i < samples; ++i)
    sum += load_at(kind, 4.0 * i / samples)[2] * std::polar(2.0 / samples, -2 * pi * i / samples);
  EXPECT_NEAR(std::abs(sum), amplitude, 1e-9 * amplitude);
  EXPECT_GT(load_at(kind, 0)[2] * std::cos(0.3), 0) << "a crest lifts";
}

// Gauss: with both ends of a short member closed, the pressure has the resultant −V ∂p/∂s = ρV (∂u/∂t)·t of linear
// waves, as Morison's Froude–Krylov part has across it.
TEST(MemberEnds, OfBothEndsTogetherAreTheFroudeKrylovLoadAlongTheMember) {
  const Eigen::Vector3d middle(0.4, -0.7, -2.5), along = Eigen::Vector3d(1, 0.5, -0.8).normalized();
  constexpr double length = 0.1, area = 0.3;
  const auto water = support::steep_wave(Stretching::none, hydro::waves::Current::none(), 1e-3);
  const MemberEndsKind kind({member(0, middle - length / 2 * along, middle + length / 2 * along, true, area, 0, 0)},
                            water);
  const Eigen::Vector3d force = load_at(kind, 0.9).head<3>();
  const Eigen::Vector3d wanted = 1000 * area * length * along * along.dot(water->at(0.9, middle).acceleration);
  // (κℓ)²/24 = 3e-5 with κ = 0.25 rad/m.
  EXPECT_NEAR((force - wanted).norm(), 0, 1e-4 * wanted.norm());
}

// A plate that moves along its axis through still water: −½ρ C_D A w|w| and the mass of the water on the left.
TEST(MemberEnds, BrakeAndLoadAPlateAlongItsAxisAlone) {
  const double added = end_added_mass(2 / pi, 3, 1000), drag = 0.5 * 1000 * 4 * pi / 4 * 9;
  EXPECT_NEAR(2 * added, 8.0 / 3 * 1000 * std::pow(1.5, 3), 1e-9 * added) << "Lamb's disc, both faces";
  const Eigen::Vector3d c = bodies[0].rest_centre();
  const MemberEndsKind kind(
      {member(0, Eigen::Vector3d(c.x(), c.y(), -3), Eigen::Vector3d(c.x(), c.y(), -1), false, 0, added, drag)},
      support::still_water());
  State s = rest_state(bodies);
  s.velocity.segment<3>(0) = Eigen::Vector3d(0.7, -0.4, -0.5);
  const Vector6 load = laws::load(kind, s, nullptr).head<6>();
  EXPECT_NEAR(load[2], drag * 0.25, 1e-12 * drag);
  EXPECT_NEAR(load.head<2>().norm() + load.tail<3>().norm(), 0, 1e-12 * drag);
  Eigen::VectorXd product = Eigen::VectorXd::Zero(12);
  const Eigen::VectorXd up = Eigen::VectorXd::Unit(12, 2);
  MassSink sink(up, product);
  kind.add_mass(s, sink);
  EXPECT_NEAR((product - added * up).norm(), 0, 1e-12 * added);
}

TEST(MemberEnds, EndTheRunWhereTheyComeOutOfTheWater) {
  const MemberEndsKind kind({member(0, {0, 0, -1}, {0, 0, 0}, false, 1, 0, 0)}, support::still_water());
  State before = rest_state(bodies), after = before;
  EXPECT_EQ(kind.breaks_off(before, after), "");
  after.pose[0].centre.z() += 1.001;
  EXPECT_NE(kind.breaks_off(before, after).find("an end of m comes out of the water"), std::string::npos);
}

// What responses have of ends is what the kind puts on a body that is held in a small wave.
TEST(MemberInertia, OfEndsIsTheLoadOnABodyThatIsHeld) {
  constexpr double a = 1e-3, omega = 2 * pi / 4;
  const MemberEnds ends = member(0, {-1, 0.3, -3}, {1, -0.2, -1.6}, true, 0.4, 70, 0);
  const MemberEndsKind kind({ends}, support::steep_wave(Stretching::none, hydro::waves::Current::none(), a));
  frequency::MemberInertia inertia{.pieces = {}, .water = support::fresh_water, .ends = {}};
  for (const MemberEnd& e : ends.ends)
    inertia.ends.push_back(
        {{.body = 0, .arm = e.arm, .axis = e.inward, .factor = 0, .along = true}, e.pressed, e.added});
  const Eigen::VectorXcd X = inertia.excitation(bodies, rest_state(bodies), omega, pi / 9);
  for (const double t : {0.0, 0.7, 2.1}) {
    const Eigen::VectorXd wanted = (X * std::polar(a, omega * t + 0.3)).real();
    // (u·∇)u is beside ∂u/∂t as k a, 2.5e-4.
    EXPECT_NEAR((load_at(kind, t) - wanted.head<6>()).norm(), 0, 1e-3 * a * X.norm()) << t;
  }
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(12, 12);
  inertia.add_mass(rest_state(bodies), mass);
  BlockPattern pattern(2);
  pattern.freeze();
  BlockMatrix wanted(pattern);
  MassSink sink(wanted, 1);
  kind.add_mass(rest_state(bodies), sink);
  EXPECT_NEAR((mass - wanted.dense()).norm(), 0, 1e-12 * mass.norm());
}

// (Q5) along the axis: heave near resonance, without waves at the plate, (D² + (g|ξ|)²) |ξ|² = |X|² with D = K − ω²M
// and g = 8ω²c/(3π).
TEST(LinearDrag, OfAPlateLimitsHeaveByItsSpeedAlongTheAxis) {
  const auto one = std::vector<RigidBody>{bodies[0]};
  constexpr double c = 5e3;
  const Eigen::Vector3d arm(0, 0, -4000);  // below all waves
  const std::vector<DragPiece> plate{
      {.body = 0, .arm = arm, .axis = Eigen::Vector3d::UnitZ(), .factor = c, .along = true}};
  const double mass = one[0].properties().mass, omega = 0.9;
  frequency::MemberInertia inertia{.pieces = {}, .water = {.density = 1000}, .ends = {}};
  inertia.ends.push_back(
      {{.body = 0, .arm = {0, 0, -3}, .axis = Eigen::Vector3d::UnitZ(), .factor = 0, .along = true}, 2, 0});
  std::vector<std::unique_ptr<const ForceKind>> springs;
  Matrix6 K = Matrix6::Zero();
  K(2, 2) = 1.05 * omega * omega * mass;
  springs.push_back(std::make_unique<RestoringKind>("mooring", one, std::vector<Restoring>{{0, K, Matrix6::Zero()}}));
  const Model model(one, {}, std::move(springs));
  const frequency::SmallMotions about(model, rest_state(one), inertia);
  const auto drag = frequency::linearised_drag(about, {}, {omega}, plate,
                                               {.water = {.density = 1000}, .heading = 0, .amplitude = {0.5}});
  const double X = std::abs(inertia.excitation(one, about.still, omega, 0)[2]) * 0.5;
  const double xi = 0.5 * std::abs(frequency::response_amplitudes(about, {}, {omega}, 0, &drag)(2, 0));
  const double D2 = std::pow(0.05 * omega * omega * mass, 2), g2 = std::pow(8 * omega * omega * c / (3 * pi), 2);
  const double wanted = std::sqrt((std::sqrt(D2 * D2 + 4 * g2 * X * X) - D2) / (2 * g2));
  EXPECT_NEAR(xi / wanted, 1, 1e-5);  // coefficients stop at 1e-6
}

}  // namespace
}  // namespace member_ends_test
