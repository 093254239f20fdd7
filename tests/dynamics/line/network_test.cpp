// Lines that meet: one system, whatever their ends are tied to. (D110)-(D113)
#include "dynamics/line/line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "loads.hpp"
#include "network_solver.hpp"
#include "support/line_networks.hpp"

namespace network_test {
namespace {

using namespace support;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81, pi = std::numbers::pi;

State rest(const Line& line, const State& places) { return equilibrium(line, hanging_shape(line, places)); }

/// A longline: held at both ends, with droppers that hang from every fourth node of it.
Description longline(int droppers, double axial_stiffness = stiff) {
  const int n = 4 * (droppers + 1);
  Description d = rods(n, n, 2.0 * n, axial_stiffness);
  d.held = {{.node = 0}, {.node = n}};
  for (int k = 1; k <= droppers; ++k) {
    const int first = append(d, rods(3, 1.5, 1, axial_stiffness));
    d.ties.push_back({4 * k, first});
  }
  return d;
}
State with_ends(const Description& d, double apart) {
  State s{.position = Places::Zero(3, std::ssize(d.nodes)),
          .velocity = Places::Zero(3, std::ssize(d.nodes)),
          .tension = VectorXd::Zero(std::ssize(d.segments))};
  s.position.col(d.held[1].node) << apart, 0, 0;
  return s;
}

/// Two strands between two knots, each hung from the ground.
Description ring() {
  Description d = rods(6, 6, 12, stiff);
  const int lower = append(d, rods(8, 8, 8, stiff)), left = append(d, rods(3, 3, 3, stiff)),
            right = append(d, rods(3, 3, 3, stiff));
  d.held = {{.node = left}, {.node = right}};
  d.ties = {{0, lower, left + 3}, {6, lower + 8, right + 3}};
  return d;
}

/// A Y, a longline, a ring with two tails, a ladder whose rungs are single segments.
std::vector<Description> networks() {
  std::vector<Description> out{bridle(3, stiff).d, longline(3)};
  Description chained = rods(5, 5, 5, stiff);
  const int side = append(chained, rods(3, 3, 3, stiff)), up = append(chained, rods(2, 2, 2, stiff)),
            down = append(chained, rods(1, 1, 1, stiff)), round = append(chained, rods(4, 4, 4, stiff));
  chained.held = {{.node = up}};
  chained.ties = {{0, side, up + 2}, {5, side + 3, down}, {down + 1, round, round + 4}};
  out.push_back(chained);
  Description ladder = rods(6, 6, 6, stiff);
  const int other = append(ladder, rods(6, 6, 6, stiff));
  ladder.held = {{.node = 0}, {.node = other}};
  for (int i = 1; i <= 6; ++i) {
    const int rung = append(ladder, rods(1, 1, 0.3, stiff));
    ladder.ties.push_back({i, rung});
    ladder.ties.push_back({other + i, rung + 1});
  }
  out.push_back(ladder);
  return out;
}

/// What a network asks, in full: random numbers where a line has any, rows of held nodes and of no tension as they are.
struct Dense {
  MatrixXd matrix;
  BandMatrix band;
};
Dense random_system(const Line& line, std::uint64_t seed, bool dense = true) {
  const int size = 4 * line.nodes(), whole = dense ? size : 0;
  Dense out{MatrixXd::Zero(whole, whole), BandMatrix(size, Reach::neighbours)};
  const hydro::RandomStream random(seed, 0);
  std::uint64_t k = 0;
  const auto set = [&](int r, int c, double value) {
    out.band(r, c) = value;
    if (dense) out.matrix(r, c) = value;
  };
  const auto is_held = [&](int i) { return line.held(i) != nullptr; };
  for (int i = 0; i < line.nodes(); ++i)
    for (int r = 0; r < 3; ++r) {
      const int row = 4 * i + 1 + r;
      for (int m = std::max(i - 1, 0); m <= std::min(i + 1, line.nodes() - 1); ++m) {
        const bool joined = m == i || (m < i ? line.before(i) : line.after(i)) >= 0;
        for (int c = 0; joined && c < 3; ++c)
          set(row, 4 * m + 1 + c, is_held(i) ? (m == i && c == r) : random.normal(k++) + 3 * (m == i && c == r));
      }
      for (const int t : {4 * i, 4 * i + 4}) {
        const bool there = t == 4 * i ? line.before(i) >= 0 : line.after(i) >= 0;
        if (there && !is_held(i)) set(row, t, random.normal(k++));
      }
    }
  for (int i = 0; i < line.nodes(); ++i) {
    if (line.before(i) < 0) set(4 * i, 4 * i, 1);
    for (int m = i - 1; line.before(i) >= 0 && m <= i; ++m)
      for (int c = 0; c < 3; ++c) set(4 * i, 4 * m + 1 + c, random.normal(k++));
  }
  return out;
}

/// The same with tied nodes as one unknown each, by elimination of everything at once.
VectorXd solve_densely(const Line& line, const MatrixXd& matrix, const VectorXd& b) {
  std::vector<int> unknown(static_cast<std::size_t>(b.size()), -1);
  int count = 0;
  for (int q = 0; q < b.size(); ++q)
    if (q % 4 == 0 || line.same_as(q / 4) == q / 4) unknown[static_cast<std::size_t>(q)] = count++;
  for (int q = 0; q < b.size(); ++q)
    if (unknown[static_cast<std::size_t>(q)] < 0)
      unknown[static_cast<std::size_t>(q)] = unknown[static_cast<std::size_t>(4 * line.same_as(q / 4) + q % 4)];
  MatrixXd P = MatrixXd::Zero(b.size(), count);
  for (int q = 0; q < b.size(); ++q) P(q, unknown[static_cast<std::size_t>(q)]) = 1;
  return P * (P.transpose() * matrix * P).partialPivLu().solve(P.transpose() * b);
}

TEST(NetworkSolver, SolvesWhatADenseMatrixDoes) {
  std::uint64_t seed = 1;
  for (const Description& d : networks()) {
    const Line line(d);
    NetworkSolver solver(line);
    for (int again = 0; again < 3; ++again) {  // its ordering is made once
      Dense system = random_system(line, ++seed);
      const hydro::RandomStream random(seed, 1);
      BandMatrix::Columns b(4 * line.nodes(), 2);
      for (Eigen::Index i = 0; i < b.size(); ++i) b.data()[i] = random.normal(static_cast<std::uint64_t>(i));
      for (const Held& h : d.held) b.middleRows<3>(4 * h.node + 1).setZero();
      for (int c = 0; c < line.chains(); ++c) b.row(4 * line.first_of_chain(c)).setZero();
      const VectorXd one = solve_densely(line, system.matrix, b.col(0)),
                     two = solve_densely(line, system.matrix, b.col(1));
      ASSERT_TRUE(solver.solve(system.band, b));
      EXPECT_LT((b.col(0) - one).norm(), 1e-9 * one.norm()) << seed;  // conditions of some 1e4 to 1e6
      EXPECT_LT((b.col(1) - two).norm(), 1e-9 * two.norm()) << seed;
    }
  }
}

// Counted, not timed: the band grows with the nodes, and so must the border with the droppers, and its factors.
TEST(NetworkSolver, CostsInProportionToTheDroppers) {
  const auto entries = [](int droppers) {
    const Line line(longline(droppers));
    NetworkSolver solver(line);
    Dense system = random_system(line, 7, false);
    VectorXd b = VectorXd::Ones(4 * line.nodes());
    EXPECT_TRUE(solver.solve(system.band, b));
    return std::pair{static_cast<double>(solver.border()), static_cast<double>(solver.factor_entries())};
  };
  const auto [border50, factors50] = entries(50);
  const auto [border400, factors400] = entries(400);
  EXPECT_NEAR(border400 / border50, 8, 0.1);
  EXPECT_LT(factors400 / factors50, 8.5);
}

// --- a line cut in two

/// The cut line beside the whole one, from the same start, by one scheme.
void expect_no_difference(const Description& whole, int node, const State& from, const Stepper::Settings& settings,
                          double h, int steps, double tolerance) {
  const Line one(whole), two(cut_at(whole, node));
  State a = from, b = from;
  b.position = cut_at(a.position, node);
  b.velocity = cut_at(a.velocity, node);
  Stepper first(one, settings), second(two, settings);
  first.start(a);
  second.start(b);
  EXPECT_LT((a.tension - b.tension).norm(), 1e-9 * a.tension.norm() + 1e-10);  // N: springs begin without tension
  for (int i = 0; i < steps; ++i) {
    first.step(a, h);
    second.step(b, h);
  }
  EXPECT_LT((cut_at(a.position, node) - b.position).norm(), tolerance) << name_of(settings.scheme);
  EXPECT_LT(std::abs(first.energies().total() - second.energies().total()), 1e-6 * first.energies().kinetic + 1e-9);
}

TEST(Junction, OfAMasslessKnotMakesNoDifferenceUnderAnyScheme) {
  for (const double stiffness : {stiff, 2e4}) {
    Description d = rods(8, 5, 10, stiffness);
    d.held = {{.node = 0}};
    const Line line(d);
    State s = in_plane(line, {0.2, 0.3, 0.9, 1.2, 1.5, 1.1, 0.7, 0.2});
    for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha, Scheme::gamma,
                                Scheme::semi_implicit_euler, Scheme::explicit_euler}) {
      const bool explicit_step = scheme == Scheme::semi_implicit_euler || scheme == Scheme::explicit_euler;
      // A whip of eight links doubles differences some ten times a second: 1e-14 m become 1e-9 m at most.
      expect_no_difference(d, 3, s, {.scheme = scheme}, explicit_step ? 5e-4 : 5e-3, explicit_step ? 400 : 100, 1e-7);
    }
  }
}

TEST(Junction, OfAMasslessKnotMakesNoDifferenceAtRest) {
  for (const double stiffness : {stiff, 1e3, 1e9}) {
    Description d = rods(10, 12, 24, stiffness);
    d.held = {{.node = 0}, {.node = 10}};
    d.nodes[4].mass = 3;
    const Line whole(d), cut(cut_at(d, 4));
    State ends = ends_at(whole, {10, 0, -1}), cut_ends = ends;
    cut_ends.position = cut_at(ends.position, 4);
    const State a = rest(whole, ends), b = rest(cut, cut_ends);
    EXPECT_LT((cut_at(a.position, 4) - b.position).norm(), 1e-8) << stiffness;  // 1e-10 of Newton's correction
    EXPECT_LT((a.tension - b.tension).norm(), 1e-8 * a.tension.norm()) << stiffness;
  }
}

// --- at rest

/// What segments and loads leave over at every place that is free, N.
double worst_balance(const Line& line, const State& s) {
  Places sum = Places::Zero(3, line.nodes());
  for (int i = 0; i < line.nodes(); ++i) sum.col(line.same_as(i)) += line.constant_load().col(i);
  for (int j = 0; j < line.segments(); ++j) {
    const int i = line.first(j);
    const Vector3d pull = s.tension[j] * (s.position.col(i + 1) - s.position.col(i)).normalized();
    sum.col(line.same_as(i)) += pull;
    sum.col(line.same_as(i + 1)) -= pull;
  }
  double worst = 0;
  for (int i = 0; i < line.nodes(); ++i)
    if (line.moves(i)) worst = std::max(worst, sum.col(i).norm());
  return worst;
}

// The legs of a Y without weight are straight: its knot is √(4² − 3²) m deep, and they pull with P/2 each, up.
TEST(NetworkAtRest, OfAYWithoutWeightIsGeometry) {
  for (const int n : {1, 4}) {
    Bridle y = bridle(n, stiff);
    for (Segment& s : y.d.segments) s.mass = s.inertia = 0;
    const Line line(y.d);
    const State s = rest(line, y.places);
    const double depth = std::sqrt(7.0);
    EXPECT_LT((s.position.col(y.knot) - Vector3d(0, 0, -depth)).norm(), 1e-9);
    EXPECT_LT((s.position.rightCols<1>() - Vector3d(0, 0, -depth - 2)).norm(), 1e-9);
    for (int j = 0; j < 2 * n; ++j) EXPECT_NEAR(s.tension[j], 5 * g / 2 * 4 / depth, 1e-8) << j;
    for (int j = 2 * n; j < 3 * n; ++j) EXPECT_NEAR(s.tension[j], 5 * g, 1e-8) << j;
  }
}

// With weight its legs are halves of one line that carries the third's weight in its middle, which (D85) has in closed
// form.
TEST(NetworkAtRest, OfAYIsThatOfALineWithABobInItsMiddle) {
  for (const double stiffness : {stiff, 5e3}) {
    const Bridle y = bridle(4, stiffness);
    const Line line(y.d);
    const State s = rest(line, y.places);
    Description both = rods(8, 8, 16, stiffness);
    both.held = {{.node = 0}, {.node = 8}};
    both.nodes[4].mass = 4 + 5;
    const Line middle(both);
    State ends = ends_at(middle, {-3, 0, 0});
    ends.position.col(0) << 3, 0, 0;
    const State closed = hanging_shape(middle, ends);
    EXPECT_LT((s.position.leftCols(5) - closed.position.leftCols(5)).norm(), 1e-8);
    EXPECT_LT((s.tension.head(4) - closed.tension.head(4)).norm(), 1e-8 * closed.tension.norm());
    EXPECT_LT(worst_balance(line, s), 1e-8);
    EXPECT_NEAR(s.tension[8], (5 + 4 - 0.5) * g, 1e-7);  // half a segment of 1 kg hangs on the knot itself
  }
}

// Between its knots each side of a ring hangs as a line between two points does.
TEST(NetworkAtRest, OfARingIsTwoCatenariesThatBalance) {
  const Description d = ring();
  constexpr int lower = 7;
  State places = with_ends(d, 7);
  const Line line(d);
  const State s = rest(line, places);
  EXPECT_LT(worst_length_of(line, s), 1e-13);
  EXPECT_LT(worst_balance(line, s), 1e-8);
  EXPECT_GT((s.position.col(6) - s.position.col(0)).norm(), 2) << "the ring is open";
  Description alone = rods(8, 8, 8, stiff);
  alone.held = {{.node = 0}, {.node = 8}};
  const Line side(alone);
  State ends = ends_at(side, s.position.col(6));
  ends.position.col(0) = s.position.col(0);
  EXPECT_LT((hanging_shape(side, ends).position - s.position.middleCols(lower, 9)).norm(), 1e-8);
}

TEST(NetworkAtRest, FindsALonglineWithDroppersAndFloats) {
  Description d = longline(8);
  for (std::size_t k = 0; k < d.ties.size(); k += 2) d.nodes[static_cast<std::size_t>(d.ties[k][0])].force.z() = 160;
  const Line line(d);
  const State s = rest(line, with_ends(d, 34));
  EXPECT_LT(worst_length_of(line, s), 1e-12);
  EXPECT_LT(worst_balance(line, s), 1e-7);
  for (const auto& tie : d.ties) EXPECT_EQ(s.position.col(tie[0]), s.position.col(tie[1]));
  for (const auto& tie : d.ties)  // droppers hang straight down
    EXPECT_LT((s.position.col(tie[1] + 3) - s.position.col(tie[1]) + Vector3d(0, 0, 1.5)).norm(), 1e-8);
}

// A mooring that rests on the bed in part, with catenary segments: where it is cut, in the air or on the bed, tells
// nothing.
TEST(NetworkAtRest, RestsOnABedAsTheUncutLine) {
  Description d = rods(20, 59, 8 * 59, 30e6);
  for (Segment& s : d.segments) {
    s.catenary = true;
    s.diameter = 0.036;
  }
  d.held = {{.node = 0}, {.node = 20}};
  d.bed = {{.z = -14, .stiffness = 3e6, .damping = 0, .friction = 0.5}};
  const Line whole(d);
  State ends = ends_at(whole, {0, 0, -1.1});
  ends.position.col(0) << 56, 0, -14;
  const State a = rest(whole, ends);
  for (const int node : {3, 15}) {
    const Line cut(cut_at(d, node));
    State cut_ends = ends;
    cut_ends.position = cut_at(ends.position, node);
    const State b = rest(cut, cut_ends);
    EXPECT_LT((a.tension - b.tension).norm(), 1e-7 * a.tension.norm()) << node;  // 1e-10 of Newton, EA ten thousand T
    EXPECT_LT((cut_at(a.position, node) - b.position).norm(), 1e-6) << node;
  }
}

// Legs as straight as steel draws them: tensions thousands of times the weight.
TEST(NetworkAtRest, FindsTautLegs) {
  for (const double stiffness : {1e5, 1e8}) {
    Bridle y = bridle(4, stiffness);
    y.places.position.col(0) << 4.004, 0, 0;
    y.places.position.col(5) << -4.004, 0, 0;
    const Line line(y.d);
    const State s = rest(line, y.places);
    EXPECT_LT(worst_balance(line, s), 1e-9 * s.tension.maxCoeff()) << stiffness;
    if (stiffness > 1e6) {
      EXPECT_NEAR(s.tension[0] / stiffness, 1e-3, 1e-5);  // (4.004 - 4)/4, and a hundredth of it by the weight
    }
  }
}

TEST(NetworkAtRest, SaysWhatDoesNotReachAndWhatNothingHolds) {
  Description d = longline(2);
  const Line line(d);
  const State far = with_ends(d, 12.4);
  EXPECT_THAT([&] { rest(line, far); }, ThrowsMessage<hydro::InputError>(HasSubstr("0.4 m too short")));
  Description loose = rods(2, 2, 2, stiff);
  append(loose, rods(2, 2, 2, stiff));
  loose.ties = {{2, 3}};
  const Line nowhere(loose);
  State any{.position = Places::Zero(3, 6), .velocity = Places::Zero(3, 6), .tension = VectorXd::Zero(4)};
  EXPECT_THAT([&] { rest(nowhere, any); }, ThrowsMessage<hydro::InputError>(HasSubstr("nothing holds")));
}

TEST(Network, RefusesWhatCannotBeTied) {
  const auto refuses = [](Description d, const std::string& what) {
    EXPECT_THAT([&] { Line{std::move(d)}; }, ThrowsMessage<hydro::InputError>(HasSubstr(what)));
  };
  Description d = bridle(2, stiff).d;
  d.ties.push_back({4});
  refuses(d, "tied to nothing");
  d.ties.back() = {2, 4};
  refuses(d, "tied twice");
  d.ties.back() = {0, 4};
  refuses(d, "held");
  d.ties.back() = {4, 99};
  refuses(d, "no node 99");
  d = bridle(2, stiff).d;
  d.begins[1] = d.begins[0];
  refuses(d, "no segment");
  d = cut_at(rods(4, 4, 4, stiff), 2);
  for (Segment& s : d.segments) s.bending_stiffness = 3;
  append(d, rods(1, 1, 1, stiff));
  d.ties.push_back({1, 6});
  refuses(d, "resists bending");
}

// --- in motion

/// As it hangs, set off across its plane, which no length resists.
State swung(const Line& line, const State& places, double speed) {
  State s = rest(line, places);
  s.velocity.row(1).setConstant(speed);
  for (const Held& h : line.description().held) s.velocity.col(h.node).setZero();
  return s;
}

TEST(Network, OfATreeThatNothingDampsKeepsItsEnergy) {
  for (const double stiffness : {stiff, 1e4}) {
    const Bridle y = bridle(4, stiffness);
    const Line line(y.d);
    State s = swung(line, y.places, 1.2);
    Stepper stepper(line, {});
    stepper.start(s);
    double liveliest = 0, worst = 0;
    for (int i = 0; i < 3000; ++i) {
      stepper.step(s, 0.01);
      liveliest = std::max(liveliest, stepper.energies().kinetic);
      worst = std::max(worst, std::abs(stepper.energies().residual()));
    }
    EXPECT_GT(liveliest, 5);
    EXPECT_LT(worst, 1e-9 * liveliest) << stiffness;  // rounding and Newton's 1e-9 of 3000 steps
    if (stiffness == stiff) {
      EXPECT_LT(worst_length_of(line, s), 1e-13);
    }
    for (const int i : y.d.ties[0]) EXPECT_EQ(s.position.col(i), s.position.col(y.knot));
  }
}

TEST(Network, OfARingThatNothingDampsKeepsItsEnergy) {
  const Description d = ring();
  const Line line(d);
  State s = swung(line, with_ends(d, 7), 1.5);
  Stepper stepper(line, {});
  stepper.start(s);
  double liveliest = 0, worst = 0;
  for (int i = 0; i < 1000; ++i) {
    stepper.step(s, 0.01);
    liveliest = std::max(liveliest, stepper.energies().kinetic);
    worst = std::max(worst, std::abs(stepper.energies().residual()));
  }
  EXPECT_GT(liveliest, 20);
  EXPECT_LT(worst, 1e-9 * liveliest);
  EXPECT_LT(worst_length_of(line, s), 1e-13);
}

TEST(Network, ThatIsFreeKeepsItsMomentumAndItsSpin) {
  Description d = bridle(3, stiff).d;
  d.held.clear();
  d.gravity = 0;
  const Line line(d);
  // Flat, its three arms at 120 degrees, in a turn about a place beside it, with a whirl across.
  State s{.position = Places(3, line.nodes()), .velocity = Places(3, line.nodes()), .tension = VectorXd(9)};
  for (int arm = 0; arm < 3; ++arm)
    for (int k = 0; k <= 3; ++k) {
      const double angle = 2 * pi / 3 * arm, length = arm < 2 ? 4.0 * (3 - k) / 3 : 2.0 * k / 3;
      s.position.col(4 * arm + k) = length * Vector3d(std::cos(angle), std::sin(angle), 0);
    }
  for (int i = 0; i < line.nodes(); ++i)
    s.velocity.col(i) = Vector3d(0.4, -0.2, 0.6) + Vector3d(0.5, 0.9, 2).cross(s.position.col(i)) +
                        Vector3d(0, 0, i == 0 || i == 11 ? 1 : 0);
  const auto momenta = [&] {
    Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
    const auto add = [&](int at, double mass, int with) {
      linear += mass * s.velocity.col(with);
      angular += mass * s.position.col(at).cross(s.velocity.col(with));
    };
    for (int i = 0; i < line.nodes(); ++i) add(i, line.mass(i), i);
    for (int j = 0; j < line.segments(); ++j) {
      add(line.first(j), line.mass_between(j), line.first(j) + 1);
      add(line.first(j) + 1, line.mass_between(j), line.first(j));
    }
    return std::pair{linear, angular};
  };
  const auto [linear, angular] = momenta();
  Stepper stepper(line, {});
  stepper.start(s);
  for (int i = 0; i < 1000; ++i) stepper.step(s, 0.02);
  const auto [after, spin] = momenta();
  EXPECT_LT((after - linear).norm(), 1e-10 * linear.norm());
  EXPECT_LT((spin - angular).norm(), 1e-9 * angular.norm());  // Newton's 1e-9 of a step
}

/// Where the bob of a Y is after a second of a swing, and how fast: from rest, places alone of semi-implicit Euler are
/// of second order.
Vector3d end_of_swing(const Stepper::Settings& settings, double h) {
  const Bridle y = bridle(2, stiff);
  const Line line(y.d);
  State s = swung(line, y.places, 0.8);
  Stepper stepper(line, settings);
  stepper.start(s);
  for (int i = 0; i < std::lround(1 / h); ++i) stepper.step(s, h);
  return s.position.rightCols<1>() + s.velocity.rightCols<1>();
}

TEST(Network, HasTheOrderOfItsScheme) {
  struct Expected {
    Stepper::Settings settings;
    double ratio;
  };
  const std::vector<Expected> all{
      {{.scheme = Scheme::energy_momentum}, 4},     {{.scheme = Scheme::generalised_alpha, .rho_infinity = 0.8}, 4},
      {{.scheme = Scheme::gamma, .gamma = 0.5}, 4}, {{.scheme = Scheme::gamma, .gamma = 1}, 2},
      {{.scheme = Scheme::semi_implicit_euler}, 2}, {{.scheme = Scheme::explicit_euler}, 2}};
  for (const Expected& e : all) {
    const double h = e.ratio == 4 ? 1e-2 : 2e-3;
    const Vector3d coarse = end_of_swing(e.settings, h), middle = end_of_swing(e.settings, h / 2),
                   fine = end_of_swing(e.settings, h / 4);
    EXPECT_NEAR((coarse - middle).norm() / (middle - fine).norm(), e.ratio, 0.15 * e.ratio)
        << name_of(e.settings.scheme) << ' ' << e.settings.gamma;
  }
}

// A knot of nothing, and one of a tonne, between lines of some kilograms: no ratio of masses is worse than another.
TEST(Network, TakesAsManyIterationsForLightKnotsAsForHeavyOnes) {
  for (const double mass : {0.0, 1e-6, 1.0, 1e3}) {
    Bridle y = bridle(4, stiff);
    y.d.nodes[static_cast<std::size_t>(y.knot)].mass = mass;
    const Line line(y.d);
    State s = swung(line, y.places, 1);
    Stepper stepper(line, {});
    stepper.start(s);
    int iterations = 0, halvings = 0;
    for (int i = 0; i < 200; ++i) {
      const StepReport r = stepper.step(s, 0.02);
      iterations += r.newton_iterations;
      halvings += r.halvings;
    }
    EXPECT_EQ(halvings, 0) << mass;
    EXPECT_LT(iterations, 200 * 6) << mass;
  }
}

TEST(Network, TakesAsManyIterationsForLonglinesOfAnyLength) {
  std::vector<int> took;
  for (const int droppers : {5, 50}) {
    const Description d = longline(droppers);
    const Line line(d);
    State s = swung(line, with_ends(d, 3.8 * (droppers + 1)), 1);
    Stepper stepper(line, {});
    stepper.start(s);
    took.push_back(0);
    for (int i = 0; i < 20; ++i) took.back() += stepper.step(s, 0.02).newton_iterations;
  }
  EXPECT_LE(took[1], took[0] + 20);  // one more a step at most
}

}  // namespace
}  // namespace network_test
