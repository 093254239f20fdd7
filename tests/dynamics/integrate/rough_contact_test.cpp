// Rough contacts that are more than a body needs, against closed forms and slow references.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <numbers>

#include "dynamics/force/contact.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "support/motion.hpp"

namespace rough_contact_test {
namespace {

using namespace dynamics;
using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Motion;
constexpr double g = 9.81, mass = 100, high = 0.1;  // of the centre of gravity over the floor

/// A force at a point of the first body that grows with time, from `force` by `rate`.
class Push final : public ForceKind {
 public:
  Push(const Vector3d& force, const Vector3d& rate, const Vector3d& at) : force_(force), rate_(rate), at_(at) {}
  std::string effect() const override { return "push"; }
  std::size_t elements() const override { return 1; }
  std::string method() const override { return "given"; }
  void add_load(const Instant& now, LoadSink& out) const override {
    const Vector3d f = force_ + now.state.time * rate_;
    Vector6 load;
    load << f, (now.state.pose[0].attitude * at_).cross(f);
    out.add(0, load);
  }
  void add_jacobian(const Instant& now, JacobianSink& out) const override {
    const Vector3d f = force_ + now.state.time * rate_;
    Matrix6 by_displacement = Matrix6::Zero();
    by_displacement.bottomRightCorner<3, 3>() = cross_matrix(f) * cross_matrix(now.state.pose[0].attitude * at_);
    out.add(0, 0, by_displacement, Matrix6::Zero());
  }
  EnergyFlow energy(const Instant&) const override { return {}; }

 private:
  Vector3d force_, rate_, at_;
};

using Pads = std::vector<Vector2d>;
const Pads three{{0.4, 0}, {-0.4, 0.3}, {-0.4, -0.3}}, four{{0.4, 0.3}, {0.4, -0.3}, {-0.4, 0.3}, {-0.4, -0.3}},
    six{{0.4, 0.3}, {0.4, -0.3}, {-0.4, 0.3}, {-0.4, -0.3}, {0, 0.3}, {0, -0.3}};
/// Twelve around an ellipse.
Pads twelve() {
  Pads out;
  for (int i = 0; i < 12; ++i) {
    const double a = 2 * std::numbers::pi * i / 12;
    out.push_back({0.4 * std::cos(a), 0.3 * std::sin(a)});
  }
  return out;
}

struct Block {
  Pads pads;
  double friction;
  Vector3d normal = {0, 0, 1};
  Vector3d force = {0, 0, 0}, rate = {0, 0, 0}, at = {0, 0, 0};
  Vector3d inertia = {9, 12, 16};
  std::array<bool, 6> free = {true, true, true, true, true, true};

  Model model() const {
    std::vector<RigidBody> bodies{
        RigidBody({.name = "block", .mass = mass, .inertia = inertia.asDiagonal(), .free = free})};
    std::vector<Contact> contacts;
    // The floor leans, and the block lies on it with its own axes upright: pads are where the plane is.
    for (const Vector2d& p : pads) {
      const double z = -high - (normal.x() * p.x() + normal.y() * p.y()) / normal.z();
      contacts.push_back({"pad", 0, {}, {Ball{{p.x(), p.y(), z}, 0}, HalfSpace{{0, 0, -high}, normal}}, 0, friction});
    }
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(std::make_unique<GravityKind>(bodies, g));
    forces.push_back(std::make_unique<Push>(force, rate, at));
    forces.push_back(std::make_unique<ContactKind>(std::move(contacts)));
    return Model(std::move(bodies), {}, std::move(forces));
  }
};

double load(const Model& model, const Motion& run, std::size_t pad) {
  return model.forces().back()->contact()->load(pad, run.workspace.memory.back().get(), run.workspace.multipliers);
}
double yaw(const Motion& run) { return rotation_log(run.workspace.state.pose[0].attitude).z(); }

// (D130) What bears mg holds μmg, however many pads it has and whichever of them are loaded less: the front ones more.
TEST(RoughContact, HoldsWhatAnyShareOfItsPadsBears) {
  constexpr double mu = 0.5;
  for (const Pads& pads : {three, four, six, twelve()})
    for (const double part : {0.9, 0.95, 0.999})
      for (const double towards : {0.0, 0.5, 1.3}) {
        const Vector3d force = part * mu * mass * g * Vector3d(std::cos(towards), std::sin(towards), 0);
        const Model model = Block{.pads = pads, .friction = mu, .force = force}.model();
        Motion run(model, rest_state(model.bodies()));
        run.go(0.02, 20);
        EXPECT_LT(run.workspace.state.pose[0].centre.norm(), 1e-13) << pads.size() << " pads, " << part;
        EXPECT_EQ(run.changes(), 0);
        double sum = 0, moment = 0;
        for (std::size_t i = 0; i < pads.size(); ++i) {
          EXPECT_GE(load(model, run, i), 0);
          sum += load(model, run, i);
          moment += load(model, run, i) * pads[i].x();
        }
        EXPECT_NEAR(sum, mass * g, 1e-7 * mass * g);
        EXPECT_NEAR(moment, force.x() * high, 1e-6 * mass * g) << "the front ones are loaded more";
      }
}

TEST(RoughContact, HoldsOnASlopeBelowTheAngleOfFriction) {
  const double slope = 30 * std::numbers::pi / 180;
  for (const Pads& pads : {three, four, six})
    for (const double mu : {0.58, 0.57}) {  // tan 30° = 0.5774
      const Model model = Block{.pads = pads, .friction = mu, .normal = {std::sin(slope), 0, std::cos(slope)}}.model();
      Motion run(model, rest_state(model.bodies()));
      run.go(0.02, 50);
      const double a = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)));
      EXPECT_NEAR(run.workspace.state.pose[0].centre.x(), a / 2 * std::cos(slope), 1e-9) << pads.size() << ", " << mu;
      EXPECT_NEAR(run.workspace.state.pose[0].centre.y(), 0, 1e-9);
    }
}

TEST(RoughContact, SlidesByWhatExceedsFriction) {
  constexpr double mu = 0.5, t = 2;
  for (const Pads& pads : {three, four, six, twelve()})
    for (const double h : {0.05, 0.01}) {
      const Model model = Block{.pads = pads, .friction = mu, .force = {1.5 * mu * mass * g, 0, 0}}.model();
      Motion run(model, rest_state(model.bodies()));
      run.go(h, static_cast<int>(std::lround(t / h)));
      EXPECT_NEAR(run.workspace.state.pose[0].centre.x(), 0.5 * mu * g / 2 * t * t, 1e-8) << pads.size() << " pads";
      EXPECT_NEAR(run.workspace.state.pose[0].centre.y(), 0, 1e-9);
      EXPECT_NEAR(yaw(run), 0, 1e-9) << "symmetric, so it goes straight";
    }
}

// A push that grows: the instant is that of the whole body, not of its least loaded pad.
TEST(RoughContact, LetsGoWhenTheWholeBodyMust) {
  constexpr double mu = 0.5, rate = 1000, start = mu * mass * g / rate;
  for (const Pads& pads : {three, four, twelve()}) {
    const Model model = Block{.pads = pads, .friction = mu, .rate = {rate, 0, 0}}.model();
    Motion run(model, rest_state(model.bodies()));
    run.go(0.013, 60);
    const double t = run.workspace.state.time, since = t - start;
    ASSERT_FALSE(run.events.empty());
    EXPECT_NEAR(run.events.front().time, start, 1e-6) << "loads are known to 1e-8 of the heaviest";
    EXPECT_NEAR(run.workspace.state.pose[0].centre.x(), rate / mass * std::pow(since, 3) / 6, 6e-5)
        << pads.size() << " pads; of the step h^2 a' t/12 = 4e-5";
  }
}

/// The slow reference: the block on the floor as it slides and turns, by Runge and Kutta's method in steps far below
/// the creep with which friction is smoothed, −μp u/√(u² + creep²). Loads along the normal are p = α + βx + γy over
/// pads at (x, y), as equal pads have them, from heave, roll and pitch in balance.
struct Sliding {
  Block block;
  static constexpr double creep = 1e-4;         // m/s
  using Numbers = Eigen::Matrix<double, 6, 1>;  // x, y, yaw and their rates

  Numbers rates(const Numbers& q) const {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(q[2]).toRotationMatrix();
    Vector3d A = block.at;
    A.head<2>() = turn * block.at.head<2>();
    const Vector3d& F = block.force;
    Eigen::Matrix3d balance = Eigen::Matrix3d::Zero();
    std::vector<Vector2d> arm, drag;  // of each pad; the force of friction over p
    for (const Vector2d& pad : block.pads) {
      arm.emplace_back(turn * pad);
      const Vector2d u = q.segment<2>(3) + q[5] * Vector2d(-arm.back().y(), arm.back().x());
      drag.emplace_back(-block.friction * u / std::hypot(u.norm(), creep));
      const Eigen::RowVector3d p(1, arm.back().x(), arm.back().y());
      balance.row(0) += p;
      balance.row(1) += (arm.back().y() + high * drag.back().y()) * p;
      balance.row(2) += (arm.back().x() + high * drag.back().x()) * p;
    }
    const Vector3d p =
        balance.inverse() * Vector3d(mass * g - F.z(), A.z() * F.y() - A.y() * F.z(), A.z() * F.x() - A.x() * F.z());
    Vector2d force = F.head<2>();
    double moment = A.x() * F.y() - A.y() * F.x();
    for (std::size_t i = 0; i < arm.size(); ++i) {
      const Vector2d f = (p[0] + p[1] * arm[i].x() + p[2] * arm[i].y()) * drag[i];
      force += f;
      moment += arm[i].x() * f.y() - arm[i].y() * f.x();
    }
    Numbers out;
    out << q.tail<3>(), force / mass, moment / block.inertia.z();
    return out;
  }

  Numbers at(double t, Numbers q = Numbers::Zero()) const {
    const double h = creep / (2 * block.friction * g);
    const auto steps = static_cast<int>(std::ceil(t / h));
    for (int i = 0; i < steps; ++i) {
      const double dt = t / steps;
      const Numbers a = rates(q), b = rates(q + dt / 2 * a), c = rates(q + dt / 2 * b), d = rates(q + dt * c);
      q += dt / 6 * (a + 2 * b + 2 * c + d);
    }
    return q;
  }
};

// A push off the middle turns the block as it slides; one at the edge of what it bears, too. Against the reference to
// its creep and the second order of the step, which is seen by halving it.
TEST(RoughContact, TurnsUnderAPushOffTheMiddle) {
  constexpr double mu = 0.5, t = 0.5;
  for (const double off : {0.1, 0.25})
    for (const double part : {1.1, 1.6}) {
      const Block block{.pads = four, .friction = mu, .force = {part * mu * mass * g, 0, 0}, .at = {0, off, -high}};
      const Model model = block.model();
      const Sliding::Numbers slow = Sliding{block}.at(t);
      const auto by_step = [&](double h) {
        Motion run(model, rest_state(model.bodies()));
        run.go(h, static_cast<int>(std::lround(t / h)));
        const Vector3d x = run.workspace.state.pose[0].centre;
        EXPECT_NEAR(x.z(), 0, 1e-10);
        return Vector3d(x.x(), x.y(), yaw(run));
      };
      const Vector3d coarse = by_step(0.01), fine = by_step(0.0025);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(coarse[k], slow[k], 2e-3) << off << " m off, " << part << ", number " << k;
        EXPECT_NEAR(fine[k], slow[k], 3e-4) << off << " m off, " << part << ", number " << k;
      }
    }
}

struct Spin {
  double surge, sway, yaw;
};

// (D149) What slides and spins comes to rest in both at one instant, towards which slips of all pads turn faster and
// faster. Against the reference, after it has come to rest: to what leaps of h/128 leave, which falls with the step,
// and its creep; loads are those of equal pads wherever these are. No friction takes more than there is.
TEST(RoughContact, ComesToRestFromSlidingAndSpinning) {
  constexpr double mu = 0.3, t = 1;
  const Pads off_the_middle{{0.35, 0.28}, {0.35, -0.32}, {-0.45, 0.28}, {-0.45, -0.32}};
  for (const Pads& pads : {four, off_the_middle, three})
    for (const Spin& v : {Spin{2, 0, 1}, Spin{2, 0, 0}, Spin{0, 0, 1}, Spin{1, 0.5, 4}, Spin{0.3, 0, -3}}) {
      const Block block{.pads = pads, .friction = mu};
      const Model model = block.model();
      Sliding::Numbers start = Sliding::Numbers::Zero();
      start.tail<3>() << v.surge, v.sway, v.yaw;
      const Sliding::Numbers slow = Sliding{block}.at(t, start);
      ASSERT_LT(slow.tail<3>().norm(), 1e-3) << "the reference rests, but for its creep";
      const auto by_step = [&](double h) {
        State begin = rest_state(model.bodies());
        begin.velocity << v.surge, v.sway, 0, 0, 0, v.yaw;
        Motion run(model, begin);
        run.go(h, static_cast<int>(std::lround(t / h)));
        EXPECT_LT(run.workspace.state.velocity.norm(), 1e-12) << "rounding of the speeds that have ended";
        EXPECT_LT(std::abs(run.ledger.residual()), 2e-3 * run.ledger.turnover());
        const Vector3d x = run.workspace.state.pose[0].centre;
        return Vector3d(x.x(), x.y(), yaw(run));
      };
      const Vector3d coarse = by_step(0.01), fine = by_step(0.0025);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(coarse[k], slow[k], 1.5e-4) << pads.size() << " pads, " << v.surge << ' ' << v.yaw << ' ' << k;
        EXPECT_NEAR(fine[k], slow[k], 3e-5) << pads.size() << " pads, " << v.surge << ' ' << v.yaw << ' ' << k;
      }
    }
}

// Held against all turning but yaw, a body on two pads may load them as it likes: off the middle by less than half
// their distance it holds μmg all the same, and beyond that it turns about the farther pad.
TEST(RoughContact, LoadsAPadMoreToHoldMore) {
  constexpr double mu = 0.5;
  for (const double off : {0.0, 0.2, 0.29}) {
    Block block{
        .pads = {{0, 0.3}, {0, -0.3}}, .friction = mu, .force = {0.98 * mu * mass * g, 0, 0}, .at = {0, off, -high}};
    block.free = {true, true, true, false, false, true};
    const Model model = block.model();
    Motion run(model, rest_state(model.bodies()));
    run.go(0.02, 20);
    EXPECT_LT(run.workspace.state.pose[0].centre.norm() + std::abs(yaw(run)), 1e-12) << off;
    EXPECT_EQ(run.changes(), 0);
    const double upper = load(model, run, 0), lower = load(model, run, 1);
    EXPECT_NEAR(upper + lower, mass * g, 1e-7 * mass * g);
    EXPECT_GE(mu * upper, (0.5 + off / 0.6) * block.force.x() * (1 - 1e-6)) << "it has to hold that much";
  }
}

// Pushed above its middle the block tips about its front edge, which sticks: a pendulum upside down,
// Iθ̈ = F h(θ) − mg b(θ).
TEST(RoughContact, TipsAboutItsFrontEdge) {
  constexpr double mu = 0.9, up = 1.5, F = 450, t = 0.3;
  const Block block{.pads = four, .friction = mu, .force = {F, 0, 0}, .at = {0, 0, up}};
  const Model model = block.model();
  const double I = block.inertia.y() + mass * (0.4 * 0.4 + high * high);
  // From the edge, before it turns: the centre at (−0.4, high), the push at (−0.4, high + up).
  const auto acceleration = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return (F * ((high + up) * c + 0.4 * s) - mass * g * (0.4 * c - high * s)) / I;
  };
  double angle = 0, rate = 0;
  constexpr int steps = 3000;
  for (int i = 0; i < steps; ++i) {  // of second order, and far finer
    const double dt = t / steps, middle = angle + dt / 2 * rate;
    rate += dt * acceleration(middle);
    angle = middle + dt / 2 * rate;
  }
  for (const double h : {0.01, 0.005}) {
    Motion run(model, rest_state(model.bodies()));
    run.go(h, static_cast<int>(std::lround(t / h)));
    EXPECT_NEAR(rotation_log(run.workspace.state.pose[0].attitude).y(), angle, 20 * h * h) << "of a second-order step";
    EXPECT_NEAR(yaw(run), 0, 1e-10);
  }
}

// Two blocks one on the other, each on four corners: the upper is pushed, and what holds it goes through the lower to
// the floor. The lower contact bears more than the upper, so with one friction the upper slides alone.
TEST(RoughContact, HoldsInAStack) {
  constexpr double mu = 0.4;
  for (const double part : {0.97, 1.2}) {
    std::vector<RigidBody> bodies;
    for (const double z : {0.3, 0.1})  // the pushed one first
      bodies.push_back(RigidBody({.name = "block",
                                  .mass = mass,
                                  .inertia = Vector3d(9, 12, 16).asDiagonal(),
                                  .rest_position = {Vector3d(0, 0, z)}}));
    std::vector<Contact> contacts;
    for (const Vector2d& p : four) {
      contacts.push_back({"upper", 0, 1, {Ball{{p.x(), p.y(), -0.1}, 0}, HalfSpace{{0, 0, 0.1}, {0, 0, 1}}}, 0, mu});
      contacts.push_back({"lower", 1, {}, {Ball{{p.x(), p.y(), -0.1}, 0}, HalfSpace{{0, 0, 0}, {0, 0, 1}}}, 0, mu});
    }
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(std::make_unique<GravityKind>(bodies, g));
    forces.push_back(std::make_unique<Push>(Vector3d(part * mu * mass * g, 0, 0), Vector3d::Zero(), Vector3d::Zero()));
    forces.push_back(std::make_unique<ContactKind>(std::move(contacts)));
    const Model model(std::move(bodies), {}, std::move(forces));
    Motion run(model, rest_state(model.bodies()));
    run.go(0.02, 25);
    EXPECT_NEAR(run.workspace.state.pose[0].centre.x(), std::max(0.0, part - 1) * mu * g / 2 * 0.25, 1e-8) << part;
    EXPECT_NEAR(run.workspace.state.pose[1].centre.x(), 0, 1e-10);
    EXPECT_NEAR(yaw(run), 0, 1e-9);
  }
}

}  // namespace
}  // namespace rough_contact_test
