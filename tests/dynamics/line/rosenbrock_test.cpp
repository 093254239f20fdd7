#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "chain_balance.hpp"
#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/node_damping.hpp"
#include "dynamics/line/perturbed_trajectory.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "support/line_models.hpp"

namespace rosenbrock_test {
namespace {

using namespace support;
namespace hw = hydro::waves;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81, pi = std::numbers::pi;
constexpr double whatever = 1e9;  // an error that no sub-step has

const hydro::Water sea_water{.density = 1025, .gravity = g, .depth = hydro::WaterDepth::from_metres(30)};
std::shared_ptr<const hw::WaveField> still_water() {
  return std::make_shared<hw::HarmonicField>(std::vector<hw::Harmonic>{}, sea_water, hw::HarmonicField::Options{});
}
std::shared_ptr<const hw::WaveField> waves() {
  return std::make_shared<hw::HarmonicField>(
      hw::linear_field(hw::Sea::regular(hydro::WaveAmplitude::from_metres(1), hydro::AngularFrequency::from_period_s(6),
                                        hydro::Angle::from_degrees(20), sea_water)));
}

/// Goes to and fro along a direction.
class ToAndFro final : public Path {
 public:
  ToAndFro(const Vector3d& place, const Vector3d& way, double omega) : place_(place), way_(way), omega_(omega) {}
  Place at(double t) const override {
    const double w = omega_;
    return {place_ + std::sin(w * t) * way_, w * std::cos(w * t) * way_, -w * w * std::sin(w * t) * way_};
  }

 private:
  Vector3d place_, way_;
  double omega_;
};

/// A chain of 60 m that lies on a bed and rises to an end that is moved.
Description mooring(int segments, bool catenary = true) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(segments) + 1, Node{});
  Segment s = Segment::rod(60.0 / segments, 20 * 60.0 / segments);
  s.axial_stiffness = 2e6;
  s.axial_damping = 1e4;
  s.diameter = 0.06;
  s.cd = 1.5;
  s.cd_tangential = 0.1;
  s.ca = 1;
  s.catenary = catenary;
  d.segments.assign(static_cast<std::size_t>(segments), s);
  d.held = {{.node = 0},
            {.node = segments, .path = std::make_shared<ToAndFro>(Vector3d(52, 0, -8), Vector3d(1, 0, 0.5), 1.5)}};
  d.gravity = g;
  d.bed = {{.z = -30, .stiffness = 3e5, .damping = 3e4}};
  d.water = {.field = still_water(), .wet = Wet::all, .buoyancy = true};
  return d;
}

State at_rest(const Line& line) {
  State s = ends_at(line, {52, 0, -8});
  s.position.col(0) = Vector3d(0, 0, -30);
  return equilibrium(line, hanging_shape(line, s));
}

Places run(const Line& line, const Stepper::Settings& settings, double duration, double h,
           StepReport* report = nullptr) {
  State s = at_rest(line);
  Stepper stepper(line, settings);
  stepper.start(s);
  for (int i = 0; i < static_cast<int>(std::lround(duration / h)); ++i) {
    const StepReport r = stepper.step(s, h);
    if (report == nullptr) continue;
    report->newton_iterations += r.newton_iterations;
    report->halvings += r.halvings;
  }
  return s.position;
}

// A bob on a spring with a damper, whose upper end goes up and down: m z̈ + c ż + k z = k Z sin wt + c Z w cos wt about
// its rest, from rest.
TEST(Rosenbrock, HasOrderFourOnADrivenSpring) {
  constexpr double m = 2, k = 80, c = 1.5, w = 3, Z = 0.05;
  Description d = pendulums(1, 1, m);
  d.segments[0].axial_stiffness = k;
  d.segments[0].axial_damping = c;
  d.held[0].path = std::make_shared<ToAndFro>(Vector3d::Zero(), Vector3d(0, 0, Z), w);
  const Line line(d);
  // z = Re(A e^{iwt}) + e^{−dt} (p cos bt + q sin bt).
  using Complex = std::complex<double>;
  const Complex A = Z * Complex(k, c * w) / Complex(k - m * w * w, c * w) * Complex(0, -1);
  const double decay = c / (2 * m), b = std::sqrt(k / m - decay * decay);
  const double p = -A.real(), q = (A.imag() * w + decay * p) / b;
  const auto exact = [&](double t) {
    return (A * std::exp(Complex(0, w * t))).real() +
           std::exp(-decay * t) * (p * std::cos(b * t) + q * std::sin(b * t));
  };
  const double length = 1 + m * g / k;
  const auto error = [&](double h) {
    State s = in_plane(line, {pi / 2});
    s.position(2, 1) = -length;
    s.position(0, 1) = 0;
    Stepper stepper(line, {.scheme = Scheme::rosenbrock, .local_error = whatever});
    stepper.start(s);
    double worst = 0;
    for (int i = 1; i <= static_cast<int>(std::lround(4 / h)); ++i) {
      stepper.step(s, h);
      worst = std::max(worst, std::abs(s.position(2, 1) + length - exact(i * h)));
    }
    return worst;
  };
  const double coarse = error(0.05), fine = error(0.025);
  EXPECT_LT(coarse, 1e-4 * Z * 10);
  EXPECT_NEAR(coarse / fine, 16, 2);
}

TEST(Rosenbrock, MovesAMooringAsGeneralisedAlphaInTinySteps) {
  for (const bool catenary : {true, false}) {
    const Line line(mooring(12, catenary));
    const Places alpha = run(line, {.scheme = Scheme::generalised_alpha, .tolerance = 1e-11}, 3, 2.5e-4);
    const Places own = run(line, {.scheme = Scheme::rosenbrock, .local_error = 1e-7}, 3, 0.1);
    EXPECT_LT((own - alpha).cwiseAbs().maxCoeff(), 2e-5) << catenary;  // of 2 m of way; the rest is generalised-α's
  }
}

// The tolerance is a promise about sub-steps; over the run the error falls with it.
TEST(Rosenbrock, LeavesErrorsThatFallWithItsTolerance) {
  const Line line(mooring(12));
  const Places exact = run(line, {.scheme = Scheme::rosenbrock, .local_error = 1e-9}, 6, 0.1);
  double before = 1;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const double error =
        (run(line, {.scheme = Scheme::rosenbrock, .local_error = tolerance}, 6, 0.1) - exact).cwiseAbs().maxCoeff();
    EXPECT_LT(error, 5 * tolerance);  // m, of segments of 5 m
    EXPECT_LT(error, before / 2);
    before = error;
  }
}

// In waves the flow is foreseen, which leaves order three.
TEST(Rosenbrock, HasOrderThreeInWaves) {
  Description d = mooring(8, false);
  d.bed.clear();
  d.water.field = waves();
  const Line line(d);
  const auto after = [&](double h) { return run(line, {.scheme = Scheme::rosenbrock, .local_error = whatever}, 2, h); };
  const Places coarse = after(0.02), middle = after(0.01), fine = after(0.005);
  EXPECT_GT((coarse - middle).norm() / (middle - fine).norm(), 7);
}

/// Wet segments of each kind over a bed that some nodes are in, with dampers and floats at nodes.
Description everything() {
  Description d = mooring(6);
  d.segments[1].catenary = d.segments[4].catenary = false;
  d.segments[4].tension_only = true;
  d.held = {{.node = 0}};
  d.nodes[3] = {.mass = 5, .bob = {.diameter = 0.4, .cd = 1, .ca = 0.5, .wet = Wet::all, .buoyancy = true}};
  d.nodes[2].forces = {std::make_shared<NodeDamping>(NodeDamping::Coefficients{30, 20, false})};
  d.water.field = std::make_shared<hw::HarmonicField>(std::vector<hw::Harmonic>{}, sea_water,
                                                      hw::HarmonicField::Options{}, hw::Current::uniform({0.4, 0.3}));
  return d;
}

TEST(ChainBalance, SolvesWithTheDerivativesOfWhatItLeavesOver) {
  const Line line(everything());
  ChainBalance balance(line);
  const hydro::RandomStream random(5, 1);
  std::uint64_t count = 0;
  const auto noise = [&](double size) {
    return Places(Places::NullaryExpr(3, line.nodes(), [&] { return size * random.normal(count++); }));
  };
  Places x = noise(0.3);
  for (int i = 0; i < line.nodes(); ++i) x.col(i) += Vector3d(9.6 * i, 0, -30.2 + 0.1 * i * i * i);
  const Places v = noise(0.3), a = noise(0.5);
  Eigen::VectorXd T(6);
  T << 4e4, 5e4, 6e4, 5.5e4, 4.5e4, 7e4;
  Balance here{Places(3, 7), Eigen::VectorXd(6)}, there = here, right = here;
  Powers powers;
  balance.linearise({{0, x, v, a}, T}, here, powers);
  constexpr double by = 40, small = 1e-6;
  ASSERT_TRUE(balance.factorise(by));
  right.force = noise(500);
  right.law = Eigen::VectorXd::NullaryExpr(6, [&] { return 0.01 * random.normal(count++); });
  const Balance asked = right;
  Places dx(3, 7);
  Eigen::VectorXd dT(6);
  balance.solve(right, dx, dT);
  const auto moved = [&](double e, Balance& out) {
    balance.evaluate({{0, x + e * dx, v + e * by * dx, a + e * by * by * dx}, T + e * dT}, out);
  };
  moved(small, there);
  moved(-small, here);
  const Places force = (there.force - here.force) / (2 * small) - asked.force;
  EXPECT_LT(force.rightCols(6).cwiseAbs().maxCoeff(), 1e-2);  // of 500 N: what the bed's and the damper's laws bend
  EXPECT_LT(((there.law - here.law) / (2 * small) - asked.law).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(dx.col(0).norm(), 0);
}

TEST(ChainBalance, AddsRatesAsTheyChangeWhatIsLeftOver) {
  const Line line(everything());
  ChainBalance balance(line);
  State s = at_rest(line);
  const hydro::RandomStream random(6, 1);
  std::uint64_t count = 0;
  const auto noise = [&] {
    return Places(Places::NullaryExpr(3, line.nodes(), [&] { return 0.3 * random.normal(count++); }));
  };
  const Places v = noise(), a = noise(), dv = noise(), da = noise();
  Balance here{Places(3, 7), Eigen::VectorXd(6)}, there = here, rates = here;
  Powers powers;
  balance.linearise({{0, s.position, v, a}, s.tension}, here, powers);
  rates.force.setZero();
  rates.law.setZero();
  balance.add_rates(dv, da, rates);
  constexpr double small = 1e-6;
  balance.evaluate({{0, s.position, v + small * dv, a + small * da}, s.tension}, there);
  balance.evaluate({{0, s.position, v - small * dv, a - small * da}, s.tension}, here);
  const Balance slope{(there.force - here.force) / (2 * small), (there.law - here.law) / (2 * small)};
  EXPECT_LT((slope.force - rates.force).cwiseAbs().maxCoeff(), 1e-4 * slope.force.cwiseAbs().maxCoeff());
  EXPECT_LT((slope.law - rates.law).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ChainBalance, IsZeroWhereTheAccelerationsAreThoseOfTheState) {
  const Line line(everything());
  State s = at_rest(line);
  s.velocity.row(1).setConstant(0.2);
  s.velocity.col(0).setZero();
  Stepper stepper(line, {.scheme = Scheme::rosenbrock});
  const Stepper::Balance found = *stepper.balance(s);
  ChainBalance balance(line);
  Balance out{Places(3, 7), Eigen::VectorXd(6)};
  balance.evaluate({{0, s.position, s.velocity, found.acceleration}, found.tension}, out);
  EXPECT_LT(out.force.rightCols(6).cwiseAbs().maxCoeff(), 1e-6 * found.tension.maxCoeff());
  EXPECT_LT(out.law.cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((out.force.col(0) - found.holding.col(0)).norm(), 1e-6 * found.tension.maxCoeff());
}

// Straight segments: what catenary ones store leaves their couple out (D88).
TEST(Rosenbrock, ClosesTheLedger) {
  const Line line(mooring(12, false));
  double before = 1;
  for (const double tolerance : {1e-4, 1e-5}) {
    State s = at_rest(line);
    Stepper stepper(line, {.scheme = Scheme::rosenbrock, .local_error = tolerance});
    stepper.start(s);
    for (int i = 0; i < 100; ++i) stepper.step(s, 0.1);
    const Energies& e = stepper.energies();
    EXPECT_GT(e.lost_drag, 100);
    EXPECT_GT(e.lost_bed, 1);
    const double left = std::abs(e.residual()) / e.dissipated();
    EXPECT_LT(left, 2e-3);
    EXPECT_LT(left, before / 2) << tolerance;
    before = left;
  }
}

// A stiff chain is let go a metre above a stiff bed with tension-only segments, and falls on it: nodes strike one after
// the other, segments go slack and snap taut. It comes to lie, and energy is never made.
TEST(Rosenbrock, LetsAStiffChainFallOnAStiffBed) {
  Description d = mooring(20, false);
  for (Segment& s : d.segments) {
    s.axial_stiffness = 2e8;
    s.axial_damping = 1e3;
    s.tension_only = true;
  }
  d.bed.front() = {.z = -30, .stiffness = 1e8, .damping = 1e6};
  d.held = {{.node = 0}};
  const Line line(d);
  State s{.position = Places::Zero(3, 21), .velocity = Places::Zero(3, 21), .tension = Eigen::VectorXd::Zero(20)};
  for (int i = 0; i <= 20; ++i) s.position.col(i) = Vector3d(2.9 * i, 0, -29 + (i % 2 == 0 ? 0.3 : 0));
  Stepper stepper(line, {.scheme = Scheme::rosenbrock});
  stepper.start(s);
  for (int i = 0; i < 100; ++i) {
    stepper.step(s, 0.1);
    ASSERT_TRUE(s.position.allFinite() && s.velocity.allFinite() && s.tension.allFinite());
    ASSERT_LT(stepper.energies().total(), stepper.energies().at_start + stepper.energies().supplied() + 100);
  }
  EXPECT_LT(s.position.row(2).rightCols(19).maxCoeff(), -29.9);
  EXPECT_LT(stepper.energies().kinetic, 10);  // of 11 kJ
  EXPECT_LT(std::abs(stepper.energies().residual()), 0.01 * stepper.energies().dissipated());
}

TEST(Rosenbrock, TakesTheSameStepAgainFromWhereItWasKept) {
  const Line line(mooring(12));
  State s = at_rest(line);
  Stepper stepper(line, {.scheme = Scheme::rosenbrock});
  stepper.start(s);
  stepper.step(s, 0.3);
  stepper.keep(s);
  const State kept = s;
  stepper.try_step(s, 0.1);
  State other = kept;
  stepper.try_step(other, 0.07);
  other = kept;
  stepper.try_step(other, 0.1);
  EXPECT_EQ(other.position, s.position);
  EXPECT_EQ(other.tension, s.tension);
  EXPECT_EQ(other.time, s.time);
  stepper.keep(other);
  Stepper straight(line, {.scheme = Scheme::rosenbrock});
  State along = at_rest(line);
  straight.start(along);
  straight.step(along, 0.3);
  straight.step(along, 0.1);
  EXPECT_EQ(along.position, s.position);
  EXPECT_DOUBLE_EQ(straight.energies().residual(), stepper.energies().residual());
}

TEST(Rosenbrock, TellsWhatItTook) {
  StepReport report;
  run(Line(mooring(12)), {.scheme = Scheme::rosenbrock, .local_error = 1e-6}, 1, 0.1, &report);
  EXPECT_GT(report.newton_iterations, 20);
  EXPECT_GT(report.halvings, 0);
}

/// Nowhere after a while.
class Lost final : public Path {
 public:
  Place at(double t) const override {
    const double x = t < 0.5 ? 0 : std::numeric_limits<double>::quiet_NaN();
    return {Vector3d(x, 0, 0), Vector3d::Zero(), Vector3d::Zero()};
  }
};

TEST(Rosenbrock, StopsWithAReasonAndALastGoodState) {
  Description d = pendulums(3);
  for (Segment& s : d.segments) s.axial_stiffness = 1e4;
  d.held[0].path = std::make_shared<Lost>();
  const Line line(d);
  State s = in_plane(line, {0.3, 0.4, 0.5});
  Stepper stepper(line, {.scheme = Scheme::rosenbrock});
  stepper.start(s);
  EXPECT_THAT([&] { stepper.step(s, 1); },
              ThrowsMessage<hydro::NumericsError>(AllOf(HasSubstr("cannot go on from t = 0.5"), HasSubstr("finite"))));
  EXPECT_TRUE(s.position.allFinite() && s.velocity.allFinite() && s.tension.allFinite());
  EXPECT_NEAR(s.time, 0.5, 1e-3);
}

TEST(Rosenbrock, RefusesLinesThatItCannotStep) {
  const auto refused = [](const Description& d, const char* why, const char* remedy) {
    const Line line(d);
    EXPECT_THAT([&] { Stepper(line, {.scheme = Scheme::rosenbrock}); },
                ThrowsMessage<hydro::InputError>(AllOf(HasSubstr(why), HasSubstr(remedy))));
  };
  refused(pendulums(2), "inextensible", "axial stiffness");
  Description d = mooring(4, false);
  for (Segment& s : d.segments) s.bending_stiffness = 10;
  refused(d, "bending", "generalized_alpha");
  d = mooring(4);
  d.bed.front().friction = 0.5;
  refused(d, "friction", "generalized_alpha");
  d = pendulums(2);
  for (Segment& s : d.segments) s.axial_stiffness = 1e4;
  d.nodes[1].mass = 0;
  refused(d, "no mass", "energy_momentum");
  const Line line(mooring(4));
  EXPECT_THAT([&] { Stepper(line, {.scheme = Scheme::rosenbrock, .local_error = 0}); },
              ThrowsMessage<hydro::InputError>(HasSubstr("local_error")));
  const State s = at_rest(line);
  EXPECT_THAT([&] { PerturbedTrajectory(line, {.scheme = Scheme::rosenbrock}, s); },
              ThrowsMessage<hydro::InputError>(HasSubstr("energy_momentum")));
}

}  // namespace
}  // namespace rosenbrock_test
