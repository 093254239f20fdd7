// Rough contacts that are more than a body needs, against closed forms and slow references.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/constant_load.hpp"
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

  Model model() const {
    std::vector<RigidBody> bodies{RigidBody({.name = "block", .mass = mass, .inertia = inertia.asDiagonal()})};
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
    EXPECT_NEAR(run.workspace.state.pose[0].centre.x(), rate / mass * std::pow(since, 3) / 6, 2e-5)
        << pads.size() << " pads; of a second-order step";
  }
}

}  // namespace
}  // namespace rough_contact_test
