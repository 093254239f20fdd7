// What tangents_test.cpp leaves: loads of waves and of weight, blows, cylinders in closed form and lines from tables,
// and the constraints of joints and contacts. Each is written a second time from its formula and differentiated by
// machine.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dynamics/force/buoyancy.hpp"
#include "dynamics/force/catenary_mooring.hpp"
#include "dynamics/force/contact.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/slamming.hpp"
#include "dynamics/force/turning_excitation.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "dynamics/joint/constraints.hpp"
#include "dynamics/joint/coordinate.hpp"
#include "dynamics/joint/prescribed_motion.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/radiation/constant_memory.hpp"
#include "hydro/radiation/convolution.hpp"
#include "hydro/radiation/partitioned.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "laws/automatic_constraints.hpp"
#include "laws/automatic_tangents.hpp"
#include "laws/signal_laws.hpp"
#include "support/small_seas.hpp"

namespace more_tangents_test {
namespace {

using namespace dynamics;
using laws::Jet;
using laws::JetBody;
using laws::JetLoads;
using laws::jets;
using laws::JetVector;
using laws::length;
using laws::Once;
using laws::twice_body;
using laws::TwiceBody;
using std::numbers::pi;

const auto bodies = support::two_bodies();

/// f(ξ, weight) at Gauss's 20 points of 0 … 1.
template <class Function>
void over_unit_interval(Function f) {
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
    for (const double way : {-1.0, 1.0}) f((1 + way * Gauss::abscissa()[i]) / 2, Gauss::weights()[i] / 2);
}

/// At several states and times, with a memory that has a past.
template <class Law>
void expect_automatic_tangents_at(const ForceKind& kind, Memory* memory, const std::vector<double>& times, Law law) {
  for (const double time : times)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(testing::Message() << kind.effect() << ", time " << time << ", seed " << seed);
      State s = support::random_state(bodies, seed, 0.7);
      s.time = time;
      laws::expect_automatic_tangents(kind, s, memory, law);
    }
}

// No load, and none of its derivatives, may come from contact: it acts by multipliers.
TEST(Tangents, OfWeightAndOfContactAreNone) {
  laws::expect_automatic_tangents_everywhere(GravityKind(bodies, 9.81, {1}), bodies,
                                             [&](const JetBody&, const JetBody&, double) {
                                               JetLoads out;
                                               out.all[8] -= 900 * 9.81;
                                               return out;
                                             });
  const ContactKind contact({{"c", 0, 1, {Ball{{0, 0, 0}, 1}, Ball{{0, 0, 0}, 1}}}});
  laws::expect_automatic_tangents_everywhere(contact, bodies,
                                             [](const JetBody&, const JetBody&, double) { return JetLoads(); });
}

/// (D6): r(t) Σ |a| cos(ωt + arg a) of one signal, r grown by half a cosine.
double signal(const support::TwoWaves& waves, Eigen::Index row, double t, double ramp_s) {
  double sum = 0;
  for (Eigen::Index c = 0; c < 2; ++c) {
    const auto a = waves.amplitudes(row, c);
    sum += std::abs(a) * std::cos(waves.omega[static_cast<std::size_t>(c)] * t + std::arg(a));
  }
  return sum * (t < ramp_s ? (1 - std::cos(pi * t / ramp_s)) / 2 : 1);
}
constexpr double ramp_s = 0.6;
const std::vector<double> wave_times{0.1, 0.13, 0.2, 0.4, 7.7};  // of the table, between, in the ramp and after it

TEST(Tangents, OfExcitationAreNone) {  // (D6): waves meet bodies at rest
  const support::TwoWaves waves(12);
  expect_automatic_tangents_at(ExcitationKind({{{1, 0}, waves.signals(ramp_s)}}), nullptr, wave_times,
                               [&](const JetBody&, const JetBody&, double t) {
                                 JetLoads out;
                                 for (int i = 0; i < 12; ++i) out.all[(i + 6) % 12] += signal(waves, i, t, ramp_s);
                                 return out;
                               });
}

// The load follows the slow yaw, which moves between steps only: within a step it is a function of time, so that yaw is
// a number here and no derivative is claimed. Where a state has no memory the body's own yaw counts instead, and the
// derivative by it is not in add_jacobian(): that is not checked here.
TEST(Tangents, OfTurningExcitationAreNoneWhileTheSlowYawStays) {  // (D121)
  constexpr double first_yaw = -0.5, spacing = 0.4, tau = 5;
  constexpr int yaws = 5;
  const support::TwoWaves waves(6 * yaws);
  const TurningExcitationKind kind({{"b", 1, first_yaw, spacing, yaws, waves.signals(ramp_s), tau}});
  const auto memory = kind.make_memory(rest_state(bodies));
  double slow = 0, time = 0;
  for (const auto& [yaw, until] : {std::pair{0.9, 2.0}, std::pair{-0.3, 3.0}, std::pair{1.0, 7.0}}) {
    State turned = rest_state(bodies);
    turned.time = until;
    turned.pose[1].attitude = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()) *
                              Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX());
    memory->accept(turned);
    slow = yaw + (slow - yaw) * std::exp(-(until - time) / tau);  // ψ̄' = (ψ − ψ̄)/τ
    time = until;
    expect_automatic_tangents_at(kind, memory.get(), wave_times, [&](const JetBody&, const JetBody&, double t) {
      JetLoads out;
      for (int k = 0; k < yaws; ++k) {
        const double share = std::max(0.0, 1 - std::abs(slow - first_yaw - k * spacing) / spacing);
        for (int i = 0; i < 6; ++i) out.all[6 + i] += share * signal(waves, 6 * k + i, t, ramp_s);
      }
      return out;
    });
  }
}

/// The integral of memory: the history force, and what multiplies the velocity now.
struct MemoryIntegral {
  Eigen::VectorXd history_force;
  Eigen::MatrixXd weight;
};
constexpr double step = 0.1;
using Velocities = std::vector<Eigen::VectorXd>;  // at whole steps, the newest last
/// Of a time `fraction` of a step after the newest velocity.
using MemoryLaw = std::function<MemoryIntegral(const Velocities& past, double fraction)>;

/// Symmetric, no two modes alone.
Eigen::MatrixXd coupled(Eigen::Index n, double phase) {
  return Eigen::MatrixXd::NullaryExpr(
      n, n, [&](Eigen::Index i, Eigen::Index j) { return std::cos(phase + static_cast<double>(i * j + i + j)); });
}
const std::vector<int> radiating{0, 2, 4, 7, 8, 10, 11};
const hydro::radiation::PoleModel oscillations{
    {{0.3, 1.1}, {0.8, 0}}, {coupled(7, 0.1), coupled(7, 0.7)}, {coupled(7, 1.9), Eigen::MatrixXd::Zero(7, 7)}};

/// (R12)
Eigen::MatrixXd retardation(double t) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(7, 7);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& p = oscillations.poles[k];
    K += std::exp(-p.decay * t) *
         (std::cos(p.omega * t) * oscillations.C[k] + std::sin(p.omega * t) * oscillations.S[k]);
  }
  return K;
}

/// (R7): trapezia over velocities at whole steps, the first of which has half its weight; K is straight between its
/// samples.
MemoryIntegral by_trapezia(const Velocities& past, double f) {
  const auto K = [](std::size_t j, double part) {
    const double t = step * static_cast<double>(j);
    return Eigen::MatrixXd((1 - part) * retardation(t) + part * retardation(t + step));
  };
  MemoryIntegral out{(f + 1) / 2 * K(0, f) * past.back(), f / 2 * K(0, 0)};
  for (std::size_t j = 1; j < past.size(); ++j)
    out.history_force += (j + 1 < past.size() ? 1 : 0.5) * K(j, f) * past[past.size() - 1 - j];
  return {step * out.history_force, step * out.weight};
}

/// (R14): the integral itself, of a velocity that is straight from step to step.
MemoryIntegral by_straight_velocity(const Velocities& past, double f) {
  MemoryIntegral out{Eigen::VectorXd::Zero(7), Eigen::MatrixXd::Zero(7, 7)};
  over_unit_interval([&](double xi, double w) {
    const Eigen::MatrixXd K = w * f * step * retardation((1 - xi) * f * step);  // since the newest
    out.history_force += (1 - xi) * K * past.back();
    out.weight += xi * K;
    for (std::size_t j = 1; j < past.size(); ++j) {
      const std::size_t end = past.size() - j;
      out.history_force += w * step * retardation((f + static_cast<double>(j) - xi) * step) *
                           ((1 - xi) * past[end - 1] + xi * past[end]);
    }
  });
  return out;
}

TEST(Tangents, OfRadiationFollowFromTheIntegralOfItsMemory) {
  using namespace hydro::radiation;
  std::vector<Eigen::MatrixXd> samples;
  for (int i = 0; i < 31; ++i) samples.push_back(retardation(step * i));  // longer than the past below
  const auto kernel = RetardationKernel::from_samples(samples, step);
  const Eigen::MatrixXd B = coupled(7, 0.3) + Eigen::MatrixXd(Eigen::VectorXd::LinSpaced(7, 2, 5).asDiagonal());
  const std::pair<std::shared_ptr<const MemoryMethod>, MemoryLaw> methods[] = {
      {std::make_shared<DirectConvolution>(kernel), by_trapezia},
      {std::make_shared<PartitionedConvolution>(kernel, 8), by_trapezia},
      {std::make_shared<PoleMemory>(oscillations, step), by_straight_velocity},
      {std::make_shared<ConstantMemory>(B, 1.3, step), [&](const Velocities&, double) {
         return MemoryIntegral{Eigen::VectorXd::Zero(7), B};
       }}};
  for (const auto& [method, integral] : methods) {
    SCOPED_TRACE(method->describe());
    const RadiationKind kind({{radiating, method}});
    State s = support::random_state(bodies, 20);
    const auto memory = kind.make_memory(s);
    Velocities past{s.velocity(radiating)};
    for (int i = 1; i <= 20; ++i) {
      s = support::random_state(bodies, 20 + static_cast<std::uint64_t>(i));
      s.time = step * i;
      memory->accept(s);
      past.emplace_back(s.velocity(radiating));
    }
    const Velocities before(past.begin(), past.end() - 1);
    for (const double f : {0.0, 0.25, 0.8, 1.0}) {
      // At a whole step the velocity now stands for the newest, which ended a step.
      const MemoryIntegral at = f > 0 ? integral(past, f) : integral(before, 1);
      ASSERT_TRUE(f > 0 || at.history_force.norm() > 0 || method->describe().starts_with("constant"));
      expect_automatic_tangents_at(kind, memory.get(), {s.time + f * step},
                                   [&](const JetBody& a, const JetBody& b, double) {
                                     const auto velocity = [&](int mode) {
                                       const JetBody& body = mode < 6 ? a : b;
                                       return mode % 6 < 3 ? body.velocity[mode % 3] : body.omega[mode % 3];
                                     };
                                     JetLoads out;
                                     for (int i = 0; i < 7; ++i) {
                                       Jet& load = out.all[radiating[static_cast<std::size_t>(i)]];
                                       load -= at.history_force[i];
                                       for (int j = 0; j < 7; ++j)
                                         load -= at.weight(i, j) * velocity(radiating[static_cast<std::size_t>(j)]);
                                     }
                                     return out;
                                   });
    }
  }
}

/// (D47) with (W83) or (W82), which are one per length: pieces that stay as they were struck.
struct Blows {
  struct Blow {
    const SlammingMember* member;
    Eigen::Vector3d arm;  ///< body axes
    double begin, speed;
    Eigen::Vector3d along;  ///< unit
  };
  std::vector<Blow> blows;
  std::set<std::pair<const SlammingMember*, int>> under;

  /// What is under in a state, and the blows that it has met since the last.
  void accept(const std::vector<SlammingMember>& members, const Eigen::Vector3d& water, const State& s, bool strikes) {
    for (const SlammingMember& m : members)
      for (int j = 0; j < m.line.pieces; ++j) {
        const Eigen::Vector3d in_body = m.line.from + (j + 0.5) / m.line.pieces * (m.line.to - m.line.from);
        const auto& pose = s.pose[static_cast<std::size_t>(m.line.body)];
        const Eigen::Vector3d arm = pose.attitude * in_body, t = pose.attitude * (m.line.to - m.line.from).normalized();
        const double sine = std::hypot(t.x(), t.y()), depth = -(pose.centre + arm).z(),
                     half = m.line.diameter * sine / 2;
        const double level = m.begins == ImpactBegins::underside ? -half : m.begins == ImpactBegins::line ? 0 : half;
        if (depth <= level) continue;
        const auto twist = s.twist(m.line.body);
        Eigen::Vector3d w = water - (twist.head<3>() + twist.tail<3>().cross(arm));
        w -= t * t.dot(w);
        if (under.insert({&m, j}).second && strikes) blows.push_back({&m, in_body, s.time, w.norm(), w.normalized()});
      }
  }
  JetLoads at(double time, double h, const JetBody& a, const JetBody& b) const {
    JetLoads out;
    for (const Blow& blow : blows) {
      const SlenderMember& line = blow.member->line;
      const double R = line.diameter / 2;
      const auto impulse = [&](double t) {  // (W86)
        const double tau = std::clamp(blow.speed * t / R, 0.0, 1.0);
        return 1000 * pi * R * R * blow.speed * tau * (1 - tau / 2);
      };
      const double since = time - blow.begin, piece = (line.to - line.from).norm() / line.pieces;
      const double force = blow.member->factor * piece * (impulse(since) - impulse(since - h)) / h;
      out.force(line.body, (line.body == 0 ? a : b).arm(blow.arm), jets(force * blow.along));
    }
    return out;
  }
};

TEST(Tangents, OfSlammingAreThoseOfTheArmsOfBlowsThatStay) {
  constexpr double h = 0.01;
  const Eigen::Vector3d c = bodies[0].rest_centre(), current(0.4, -0.3, 0);
  const std::vector<SlammingMember> members{
      {{0, Eigen::Vector3d(-0.3, -1, 0.5) - c, Eigen::Vector3d(0.4, 1.2, 0.6) - c, 0.4, 8, Immersion::surface},
       hydro::waves::ImpactTheory::goda},
      {{1, {0.2, -1, 0.1}, {-0.3, 0.9, 0.3}, 0.5, 6, Immersion::still_water},
       hydro::waves::ImpactTheory::von_karman,
       ImpactBegins::underside,
       0.7},
      {{1, {1, -0.4, 0.3}, {1.2, 1.1, 0.1}, 0.3, 4, Immersion::surface},
       hydro::waves::ImpactTheory::goda,
       ImpactBegins::submerged}};
  const SlammingKind kind(members, support::still_water(hydro::waves::Current::uniform({0.4, -0.3})), h);
  State s = rest_state(bodies);
  const auto memory = kind.make_memory(s);
  Blows blows;
  blows.accept(members, current, s, false);
  EXPECT_TRUE(blows.under.empty());
  std::vector<std::size_t> struck;
  for (const double lower : {0.35, 0.7}) {  // one part of the pieces, then others
    s.time += h;
    for (std::size_t b = 0; b < 2; ++b) {
      s.pose[b].centre.z() = bodies[b].rest_centre().z() - lower;
      s.pose[b].attitude = rotation_exp({0.25, -0.1, 0.3});
    }
    s.velocity << 0.4, 0.2, -3, 0.1, -0.2, 0.3, -0.3, 0.5, -2.5, 0.2, 0.1, -0.1;
    s.velocity *= lower;
    memory->accept(s);
    blows.accept(members, current, s, true);
    struck.push_back(blows.blows.size());
  }
  EXPECT_GT(struck[0], 2u);
  EXPECT_GT(struck[1], struck[0] + 2);
  EXPECT_LT(struck[1], 18u) << "some have not been struck";
  expect_automatic_tangents_at(kind, memory.get(), {s.time + 0.4 * h, s.time + h, s.time + 5.3 * h},
                               [&](const JetBody& a, const JetBody& b, double t) { return blows.at(t, h, a, b); });
}

/// Which ends of a cylinder the surface cuts.
struct CutEnds {
  bool low, high;
  auto operator<=>(const CutEnds&) const = default;
};

/// (P80) as it is written there, for a cylinder that is neither upright nor level: ρgV up at the middle of what is wet.
CutEnds add_cylinder(JetLoads& out, int i, const JetBody& body, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                     double a) {
  JetVector low = body.arm(from), high = body.arm(to);
  if (low[2] > high[2]) std::swap(low, high);
  const Jet L = length(JetVector(high - low));
  const JetVector e = (high - low) / L;
  const Jet rise = e[2], slope = sqrt(e[0] * e[0] + e[1] * e[1]);
  const JetVector up(-rise * e[0] / slope, -rise * e[1] / slope, slope);
  const Jet z_low = body.centre[2] + low[2], z_high = body.centre[2] + high[2];
  const auto is_cut = [&](const Jet& z) { return abs(z) < slope * a; };
  const auto cut = [&](const Jet& z) { return is_cut(z) ? asin(-z / (slope * a)) : Jet(z.a < 0 ? pi / 2 : -pi / 2); };
  const Jet at_low = cut(z_low), at_high = cut(z_high);
  Jet V(0);
  JetVector first = jets(Eigen::Vector3d::Zero());  // ∫ r dV from the body's centre
  const auto integrate = [&](const Jet& begin, const Jet& end, auto wet) {
    over_unit_interval([&](double xi, double weight) {
      const Jet phi = begin + (end - begin) * xi, u = a * sin(phi), w = wet(u);
      const Jet dA = 2 * a * a * cos(phi) * cos(phi) * (end - begin) * weight;
      V += w * dA;
      first += (low * w + e * (w * w / 2.0) + up * (u * w)) * dA;
    });
  };
  integrate(Jet(-pi / 2), at_high, [&](const Jet&) { return L; });
  integrate(at_high, at_low, [&](const Jet& u) { return (-z_low - u * slope) / rise; });
  const double weight = 1000 * 9.81;
  out.all[6 * i + 2] += weight * V;
  out.all[6 * i + 3] += weight * first[1];
  out.all[6 * i + 4] -= weight * first[0];
  return {is_cut(z_low), is_cut(z_high)};
}

TEST(Tangents, OfBuoyancyOfTiltedCylindersFollowFromTheirSlices) {
  using hydro::hydrostatics::CircularCylinder;
  const Eigen::Vector3d cog(0.1, -0.2, 0.3);
  const auto shape = [](const CircularCylinder& c) { return std::make_shared<const FloatingShape>(c); };
  const CircularCylinder drum{{0.2, 0, -0.7}, {0.1, 0, 0.9}, 0.6}, pole{{-0.4, 0.3, 1.1}, {0.5, -0.2, -2.5}, 0.3},
      plate{{0.3, 0.1, -0.1}, {0.2, 0.2, 0.2}, 1.3};
  const BuoyancyKind kind(bodies, {{0, shape(drum)}, {1, shape(pole)}, {1, shape(plate)}},
                          hydro::Water{.density = 1000, .gravity = 9.81});
  std::set<CutEnds> seen;
  for (const double height : {0.0, -0.6, 0.5, -4.0, 4.0})
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
      for (const double angle : {0.3, 0.9}) {
        SCOPED_TRACE(testing::Message() << "height " << height << ", angle " << angle << ", seed " << seed);
        State s = support::random_state(bodies, seed, angle);
        for (Pose& pose : s.pose) pose.centre.z() += height;
        laws::expect_automatic_tangents(kind, s, nullptr, [&](const JetBody& a, const JetBody& b, double) {
          JetLoads out;
          seen.insert(add_cylinder(out, 0, a, drum.from - cog, drum.to - cog, drum.radius));
          for (const auto& c : {pole, plate}) seen.insert(add_cylinder(out, 1, b, c.from - cog, c.to - cog, c.radius));
          return out;
        });
      }
  EXPECT_EQ(seen.size(), 4u) << "neither end, each, and both";
}

/// A number with its derivatives by x and z, each of which has those by displacements: jets in jets.
using InPlane = ceres::Jet<Jet, 2>;

/// The cubic of values and slopes at both ends of h, at t h.
InPlane cubic(const InPlane& t, const Jet& h, const InPlane& f0, const InPlane& f1, const InPlane& s0,
              const InPlane& s1) {
  const InPlane rise = f1 - f0, one(Jet(1));
  return f0 + t * rise + t * (one - t) * ((one - t) * (s0 * h - rise) - t * (s1 * h - rise));
}

/// (D120): the energy, cubic in x between nodes and then in z.
InPlane tabled_energy(const CatenaryMooring& m, const InPlane& x, const InPlane& z) {
  const Reach& reach = m.table->reach();
  const int n = m.table->cells();
  const double width = (reach.x_high - reach.x_low) / n, height = (reach.z_high - reach.z_low) / n;
  const double i = std::floor((x.a.a - reach.x_low) / width), k = std::floor((z.a.a - reach.z_low) / height);
  const auto number = [](double y) { return InPlane(Jet(y)); };
  const InPlane t = (x - number(reach.x_low + i * width)) / Jet(width);
  std::array<InPlane, 2> E, slope;  // at both heights
  for (const int b : {0, 1}) {
    std::array<LineTension, 2> node;
    for (const int a : {0, 1})
      node[a] = catenary(m.line, reach.x_low + (i + a) * width, reach.z_low + (k + b) * height);
    E[b] = cubic(t, Jet(width), number(node[0].stored), number(node[1].stored), number(node[0].horizontal),
                 number(node[1].horizontal));
    slope[b] = cubic(t, Jet(width), number(node[0].vertical), number(node[1].vertical), number(node[0].stiffness(0, 1)),
                     number(node[1].stiffness(0, 1)));
  }
  return cubic((z - number(reach.z_low + k * height)) / Jet(height), Jet(height), E[0], E[1], slope[0], slope[1]);
}

/// One that rests in part, and one that hangs; fairleads stay within the tables.
std::vector<CatenaryMooring> tabled_lines() {
  const LineProperties resting{60, 700, 1e7, true}, hanging{34, 300, 1e6, false};
  const auto table = [](const LineProperties& line, const Reach& reach) {
    return std::make_shared<const CatenaryTable>(line, reach, 1e-2);
  };
  return {{{0, {1, 0.5, -1}}, {{50, 10, -20}}, resting, table(resting, {46, 56, 16, 25})},
          {{1, {0, 0, -1}}, {{-20, 3, -15}}, hanging, table(hanging, {20, 28, 11, 18})}};
}

TEST(Tangents, OfCatenariesFromATableAreThoseOfItsEnergy) {
  const auto lines = tabled_lines();
  laws::expect_automatic_tangents_everywhere(
      CatenaryMooringKind(lines), bodies, [&](const JetBody& a, const JetBody& b, double) {
        JetLoads out;
        for (const CatenaryMooring& m : lines) {
          const JetBody& body = m.fairlead.body == 0 ? a : b;
          const JetVector r = body.arm(m.fairlead.arm), d = body.centre + r - jets(m.anchor.place);
          const Jet x = sqrt(d[0] * d[0] + d[1] * d[1]);
          EXPECT_TRUE(m.table->reach().holds(x.a, d[2].a)) << "else it would be solved";
          const InPlane E = tabled_energy(m, InPlane(x, 0), InPlane(d[2], 1));
          const Jet &H = E.v[0], &V = E.v[1];
          out.force(m.fairlead.body, r, JetVector(-H * d[0] / x, -H * d[1] / x, -V));
        }
        return out;
      });
}

// T² = H² + V² at the fairlead; at the anchor V is smaller by the weight of the line, or zero where some of it rests.
TEST(Tangents, OfTensionsFromATableAreThoseOfItsEnergy) {
  for (const CatenaryMooring& m : tabled_lines())
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const State s = support::random_state(bodies, seed, 0.7);
      const JetVector d = laws::jet_body(s, m.fairlead.body).point(m.fairlead.arm) - jets(m.anchor.place);
      const InPlane E = tabled_energy(m, InPlane(sqrt(d[0] * d[0] + d[1] * d[1]), 0), InPlane(d[2], 1));
      const Jet &H = E.v[0], &V = E.v[1];
      const Jet low = V - m.line.weight * m.line.length, at_anchor = m.line.on_bed && low.a < 0 ? Jet(0) : low;
      const TensionGradient gradient = tension_gradient(m, s);
      const auto expect = [&](const Jet& T, const Eigen::Matrix<double, 1, 6>& by_q, const char* what) {
        const Eigen::Matrix<double, 1, 6> expected = T.v.segment<6>(6 * m.fairlead.body).transpose();
        EXPECT_LT((by_q - expected).norm(), 1e-11 * expected.norm()) << what;  // as of loads
      };
      expect(sqrt(H * H + V * V), gradient.fairlead, "at the fairlead");
      expect(sqrt(H * H + at_anchor * at_anchor), gradient.anchor, "at the anchor");
    }
}

constexpr JointKind all_kinds[] = {JointKind::fixed, JointKind::hinge,  JointKind::universal,
                                   JointKind::ball,  JointKind::slider, JointKind::planar};

/// The bodies of a joint; of none the ground.
struct Pair {
  int first;
  std::optional<int> second;
};
const Pair all_pairs[] = {{0, 1}, {1, 0}, {1, {}}};

Joint joint(JointKind kind, const Pair& pair = {0, 1}, PrescribedMotion motion = {}) {
  return {.name = "j",
          .kind = kind,
          .first = pair.first,
          .second = pair.second,
          .place = {2, 0.3, -0.2},
          .axis = {0.2, 1, 0.4},
          .second_axis = {-1, 0.2, 0},
          .prescribed = std::move(motion)};
}
std::string name_of(const Joint& j) {
  return dynamics::name_of(j.kind) + " on body " + std::to_string(j.first) + (j.second ? "" : " and the ground");
}

TEST(Tangents, OfJointsFollowFromWhatTheyHold) {  // (D13)-(D15)
  for (const JointKind kind : all_kinds)
    for (const Pair& pair : all_pairs)
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Joint j = joint(kind, pair);
        SCOPED_TRACE(testing::Message() << name_of(j) << ", seed " << seed);
        laws::expect_automatic_derivatives(bodies, JointSet(bodies, {j}), support::random_state(bodies, seed, 0.7));
      }
}

TEST(Tangents, OfJointsHaveNoPartInModesThatAreHeld) {
  auto first = bodies[0].properties(), second = bodies[1].properties();
  first.free = {true, false, true, true, false, false};
  second.free = {false, true, true, false, true, true};
  const std::vector<RigidBody> held{RigidBody(first), RigidBody(second)};
  for (const JointKind kind : all_kinds) {
    SCOPED_TRACE(dynamics::name_of(kind));
    laws::expect_automatic_derivatives(held, JointSet(held, {joint(kind)}), support::random_state(held, 3, 0.7));
  }
}

TEST(Tangents, OfPrescribedMotionsFollowFromTheCoordinate) {  // (D31), (D53)
  const PrescribedMotion motion = prescribed_harmonic(5, 1.3, 5);
  bool far = false;
  for (const JointKind kind : {JointKind::slider, JointKind::hinge})
    for (const Pair& pair : all_pairs)
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const Joint prescribed = joint(kind, pair, motion);
        SCOPED_TRACE(testing::Message() << name_of(prescribed) << ", seed " << seed);
        State s = support::random_state(bodies, seed, 0.7);
        s.time = 0.9 * static_cast<double>(seed);
        const JointSet set(bodies, {prescribed});
        laws::expect_automatic_derivatives(bodies, set, s);
        EXPECT_EQ(set.prescribed_rates(s.time).tail<1>()[0], motion(s.time).rate);
        far = far || (kind == JointKind::hinge && std::abs(set.coordinate(0, s) - motion(s.time).coordinate) > pi);
        laws::expect_automatic_derivatives(bodies, set.with_only(JointCoordinate(bodies, prescribed).holding(s)), s);
      }
  EXPECT_TRUE(far) << "some hinge is more than half a turn away from what is prescribed";
}

// What sticks is held by another constraint than the coordinate, with the coordinate's gradient where the joint is
// closed. (D19)
TEST(Tangents, OfWhatHoldsACoordinateAreThoseOfTheCoordinate) {
  for (const JointKind kind : {JointKind::slider, JointKind::hinge})
    for (const double gone : {0.7, -1.9}) {
      const Joint j = joint(kind);
      const bool turns = kind == JointKind::hinge;
      State s = support::random_state(bodies, 4, 0.7);
      const Eigen::Vector3d axis = j.axis.normalized();
      const Eigen::Quaterniond& R = s.pose[0].attitude;
      s.pose[1].attitude = R * Eigen::AngleAxisd(turns ? gone : 0, axis);
      s.pose[1].centre = s.pose[0].centre + R * (j.place - bodies[0].rest_centre() + (turns ? 0 : gone) * axis) +
                         s.pose[1].attitude * (bodies[1].rest_centre() - j.place);
      const auto coordinate = laws::coordinate_of(bodies, j, twice_body(s, 0), twice_body(s, 1));
      EXPECT_NEAR(coordinate.a.a, gone, laws::constraint_round_off);
      const JointSet holding = JointSet(bodies, {j}).with_only(JointCoordinate(bodies, j).holding(s));
      EXPECT_NEAR(holding.values(s)[0], 0, laws::constraint_round_off);
      const Eigen::MatrixXd row = holding.dense(holding.gradients(s));
      for (int k = 0; k < 12; ++k) EXPECT_NEAR(row(0, k), coordinate.v[k].a, laws::constraint_round_off) << k;
    }
}

TEST(Tangents, OfAPrescribedMotionAreThoseInTime) {  // (D31): a sin ωt, grown by half a cosine
  using Rate = ceres::Jet<double, 1>;
  using Acceleration = ceres::Jet<Rate, 1>;
  const PrescribedMotion motion = prescribed_harmonic(0.7, 1.3, 2.5), back = reversed(motion);
  for (const double at : {0.1, 1.31, 2.45, 2.55, 4.7}) {
    const Acceleration t(Rate(at, 0), 0);
    const Acceleration half(Rate(0.5));
    Acceleration s = sin(t * Rate(1.3)) * Rate(0.7);
    if (at < 2.5) s = s * (half - half * cos(t * Rate(pi / 2.5)));
    EXPECT_NEAR(motion(at).coordinate, s.a.a, 1e-15) << at;
    EXPECT_NEAR(motion(at).rate, s.v[0].a, 1e-14) << at;
    EXPECT_NEAR(motion(at).acceleration, s.v[0].v[0], 1e-14) << at;
    EXPECT_EQ(back(at).acceleration, -motion(at).acceleration);
  }
}

// Load on the body, −λ·∂g, about the joint's place and in the axes of the body, which turn. (D17)
TEST(Tangents, OfLoadsInJointsFollowFromTheirMultipliers) {
  using OnceVector = Eigen::Matrix<Once, 3, 1>;
  constexpr double tolerance = 10 * laws::constraint_round_off;  // loads of up to six constraints, arms of 3 m
  for (const JointKind kind : all_kinds)
    for (const End end : {End::first, End::second}) {
      SCOPED_TRACE(testing::Message() << dynamics::name_of(kind) << (end == End::first ? ", first" : ", second"));
      const Joint j = joint(kind);
      const JointSet set(bodies, {j});
      const State s = support::random_state(bodies, 5, 0.7);
      const Eigen::VectorXd lambda = laws::multipliers(set);
      const int b = end == End::first ? 0 : 1;
      Eigen::Matrix<Once, 6, 1> p = Eigen::Matrix<Once, 6, 1>::Constant(Once(0));
      const auto all = laws::laws_of(bodies, set, s);
      for (Eigen::Index i = 0; i < set.count(); ++i)
        for (int k = 0; k < 6; ++k) p[k] -= lambda[i] * all[static_cast<std::size_t>(i)].v[6 * b + k];
      const TwiceBody body = twice_body(s, b);
      OnceVector force, moment;
      for (int k = 0; k < 3; ++k) {
        const OnceVector axis = laws::once(body.axes[static_cast<std::size_t>(k)]);
        force[k] = axis.dot(OnceVector(p.head<3>()));
        moment[k] = axis.dot(OnceVector(p.tail<3>()));
      }
      const Eigen::Vector3d arm = j.place - bodies[static_cast<std::size_t>(b)].rest_centre();
      Eigen::Matrix<Once, 6, 1> load;
      load << force, OnceVector(moment - arm.cast<Once>().cross(force));
      const auto variation = laws::load_variations(set, 0, end, s, lambda);
      const Vector6 now = set.load_on(0, end, s, lambda);
      for (int k = 0; k < 6; ++k) {
        EXPECT_NEAR(now[k], load[k].a, tolerance) << k;
        EXPECT_LT((variation.by_motion.row(k) - load[k].v.transpose()).norm(), tolerance) << k;
        EXPECT_NEAR(variation.by_multiplier.row(k).dot(lambda), load[k].a, tolerance) << "linear in them, " << k;
      }
    }
}

/// A shape where it is, seen from a body.
Shape in_axes_of(const Shape& global, const Pose& pose) {
  const Eigen::Matrix3d back = pose.attitude.toRotationMatrix().transpose();
  return moved(global, back, -back * pose.centre);
}

// Parallel rods are left out: there the points that are closest jump, and the gap has no derivative.
TEST(Tangents, OfContactsFollowFromTheirGaps) {  // (D22)-(D24)
  struct Case {
    const char* what;
    Shape first, second;  // where the bodies have them
  };
  const Box box{{1.5, 0.2, -0.1}, {0.5, 0.4, 0.3}, rotation_exp({0.3, -0.4, 0.5}).toRotationMatrix()};
  const auto at_box = [&](double x, double y, double z) {
    return Eigen::Vector3d(box.centre + box.axes * Eigen::Vector3d(x, y, z));
  };
  const Rod rod{{1.2, -0.7, 0.1}, {1.6, 0.8, 0.3}, 0.1};
  const HalfSpace plane{{1.3, 0.1, 0}, Eigen::Vector3d(3, -1, 2).normalized()};
  const Case cases[] = {
      {"two balls", Ball{{1.4, 0.1, 0.2}, 0.2}, Ball{{2.3, -0.3, 0.1}, 0.3}},
      {"two balls that overlap", Ball{{1.4, 0.1, 0.2}, 0.7}, Ball{{2.3, -0.3, 0.1}, 0.6}},
      {"ball beside a rod", Ball{{2.2, 0.1, 0.9}, 0.2}, rod},
      {"rod and a ball past its end", rod, Ball{{1.9, 1.5, 0.8}, 0.2}},
      {"rods that cross", rod, Rod{{2.1, 0.2, -0.9}, {2.3, -0.1, 1.1}, 0.2}},
      {"rods that cross and overlap", rod, Rod{{1.65, 0.2, -0.9}, {1.8, -0.1, 1.1}, 0.4}},
      {"rod beside the end of a rod", rod, Rod{{2.1, 0.2, 0.4}, {3.3, 0.5, 0.9}, 0.2}},
      {"end of a rod beside a rod", Rod{{2.1, 0.2, 0.4}, {3.3, 0.5, 0.9}, 0.2}, rod},
      {"ends of two rods", rod, Rod{{2.0, 1.5, 0.5}, {3.1, 2.4, 0.9}, 0.2}},
      {"ball before a plane", plane, Ball{{2.2, -0.4, 0.8}, 0.3}},
      {"ball through a plane", Ball{{1.1, 0.3, 0.1}, 0.3}, plane},
      {"ball at a face", box, Ball{at_box(0.9, 0.1, -0.2), 0.2}},
      {"ball at a face, named first", Ball{at_box(0.1, 0.2, -0.7), 0.2}, box},
      {"ball at an edge", box, Ball{at_box(-0.8, 0.9, 0.1), 0.3}},
      {"ball at a corner", Ball{at_box(0.9, -0.8, 0.7), 0.3}, box},
      {"ball with its centre in a box", box, Ball{at_box(0.1, -0.3, 0.1), 0.2}},
  };
  // Gradients are known to 1e-16 of a metre or so, and their differences over 2e-5 m and rad to 1e-11; the differences
  // leave out the third derivative, 1.7e-11 of it, which is one over distance squared.
  constexpr double by_differences = 1e-8;
  for (const Case& c : cases)
    for (const bool ground : {false, true})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message() << c.what << (ground ? ", on the ground" : "") << ", seed " << seed);
        const State s = support::random_state(bodies, seed, 0.7);
        const std::optional<int> second = ground ? std::optional<int>() : std::optional<int>(1);
        const ContactKind kind(
            {{"c", 0, second, {in_axes_of(c.first, s.pose[0]), ground ? c.second : in_axes_of(c.second, s.pose[1])}}});
        JointSet set = JointSet(bodies, {}).with_only(kind.closed(0));
        laws::expect_automatic_derivatives(bodies, set, s, by_differences);
        for (const Constraint& stick : kind.sticking(0, s)) {
          SCOPED_TRACE("sticks");
          set = set.with_only(stick);
          laws::expect_automatic_derivatives(bodies, set, s, by_differences);
          // How the points slip while the contact does not stick is the same row.
          const Gradient along = kind.along(0, std::get<StickConstraint>(stick.what).direction, s),
                         row = set.gradients(s).front();
          EXPECT_EQ(along.first, row.first);
          EXPECT_EQ(along.second, row.second);
        }
      }
}

TEST(Tangents, OfConstraintsAreFoundWrongWhereTheyAre) {
  // A constraint whose arm or axis is off by a part in a million, and a curvature whose rotations come in the other
  // order.
  const State s = support::random_state(bodies, 3, 0.7);
  const TwiceBody a = twice_body(s, 0), b = twice_body(s, 1);
  const PointConstraint point{{1, 0.3, -0.2}, {-2, 0.3, -0.2}, Eigen::Vector3d(1, 2, 2) / 3, true};
  PointConstraint other = point;
  other.second_arm *= 1 + 1e-6;
  const ConstraintEnds at = ends_of({0, 0, 1, point}, s);
  const auto apart = [&](const PointConstraint& c) {
    return (curvature(c, at) - laws::curvature_of(laws::law_of(point, a, b))).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(apart(point), laws::constraint_round_off);
  EXPECT_GT(apart(other), 1e-7);
  EXPECT_GT((curvature(point, at).transpose() - laws::curvature_of(laws::law_of(point, a, b))).cwiseAbs().maxCoeff(),
            0.1);
}

}  // namespace
}  // namespace more_tangents_test
