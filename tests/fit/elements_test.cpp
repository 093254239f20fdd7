// The loads that a fit knows are those of the elements that a run is made of: what an element gives, a fit finds, and
// what is changed in the one is found changed by the other.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/force_law.hpp"
#include "dynamics/force/friction.hpp"
#include "dynamics/force/morison.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "fit/decay.hpp"
#include "fit/forced_radiation.hpp"
#include "fit/friction_ramp.hpp"
#include "fit/morison.hpp"
#include "fit/shooting.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "support/two_pole_body.hpp"

namespace fitted_elements_test {
namespace {

using Eigen::Vector3d;
using fit::Experiment;

constexpr double diameter = 0.12, length = 0.5, density = 997, mass = 5.9;

/// Water that moves alike everywhere.
class UniformFlow final : public hydro::waves::WaveField {
 public:
  UniformFlow(double velocity, double acceleration) : velocity_(velocity), acceleration_(acceleration) {}
  const hydro::Water& water() const noexcept override { return water_; }
  double elevation(double, double, double) const override { return 0; }
  using WaveField::at;
  hydro::waves::Kinematics at(double, const Vector3d&) const override {
    return {0, velocity_ * Vector3d::UnitX(), acceleration_ * Vector3d::UnitX(), Eigen::Matrix3d::Zero(), 0};
  }

 private:
  hydro::Water water_{.density = density, .gravity = 9.81, .depth = hydro::WaterDepth::infinite()};
  double velocity_, acceleration_;
};

/// One instant of water and cylinder along x.
struct Motion {
  double water_velocity, water_acceleration, velocity, acceleration;
};

/// What MorisonKind gives an upright cylinder: its load, less the added mass that it puts on the left.
double load_of_the_element(double cd, double ca, const Motion& m) {
  const std::vector<dynamics::RigidBody> bodies{dynamics::RigidBody(
      {.name = "cylinder", .mass = mass, .inertia = Eigen::Matrix3d::Identity(), .rest_position = {{0, 0, -2}}})};
  const Vector3d half(0, 0, length / 2);
  const dynamics::MorisonKind kind({{{0, -half, half, diameter, 3, dynamics::Immersion::whole}, cd, ca}},
                                   std::make_shared<UniformFlow>(m.water_velocity, m.water_acceleration));
  dynamics::State state = dynamics::rest_state(bodies);
  state.velocity[0] = m.velocity;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6), on_the_left = Eigen::VectorXd::Zero(6);
  dynamics::LoadSink loads(load);
  kind.add_load({state, nullptr}, loads);
  const Eigen::VectorXd acceleration = m.acceleration * Eigen::VectorXd::Unit(6, 0);
  dynamics::MassSink added(acceleration, on_the_left);
  kind.add_mass(state, added);
  return load[0] - on_the_left[0];
}

fit::Cylinder cylinder(Experiment experiment) {
  return {.diameter = diameter,
          .length = length,
          .density = density,
          .viscosity = {},
          .experiment = experiment,
          .mass_beyond_load_cells = experiment == Experiment::water_moves ? 0 : mass};
}

// The length is cut into three pieces and the load of 1e3 N summed: a few roundings of it.
constexpr double rounding = 1e-11;

TEST(FittedElements, MorisonForceIsThatOfTheMemberInARun) {
  const auto held = cylinder(Experiment::water_moves), moved = cylinder(Experiment::body_moves),
             both = cylinder(Experiment::both_move);
  for (const double u : {-2.5, -0.3, 0.0, 1.7})
    for (const double a : {-4.0, 0.0, 2.5})
      for (const double cd : {0.0, 1.2})
        for (const double ca : {0.0, 0.8}) {
          SCOPED_TRACE(fmt::format("u {} a {} cd {} ca {}", u, a, cd, ca));
          EXPECT_NEAR(fit::morison_force(held, cd, 1 + ca, u, a), load_of_the_element(cd, ca, {u, a, 0, 0}), rounding);
          EXPECT_NEAR(fit::morison_force(moved, cd, ca, u, a), load_of_the_element(cd, ca, {0, 0, u, a}) - mass * a,
                      rounding);
          // Water with velocity 0.4 and acceleration 1.1, the body so that the relative motion is u and a.
          EXPECT_NEAR(fit::morison_force(both, cd, ca, u, a, 1.1),
                      load_of_the_element(cd, ca, {0.4, 1.1, 0.4 - u, 1.1 - a}) - mass * (1.1 - a), rounding);
        }
}

TEST(FittedElements, AMorisonFitFindsTheCoefficientsOfTheMember) {
  for (const double cd : {0.7, 1.4})
    for (const double ca : {0.5, 1.1}) {
      fit::ForceRecord r;
      for (int j = 0; j < 400; ++j) {
        const double t = 0.02 * j, omega = std::numbers::pi / 2, v = 0.6 * std::cos(omega * t),
                     a = -0.6 * omega * std::sin(omega * t);
        r.time.push_back(t);
        r.velocity.push_back(v);
        r.acceleration.push_back(a);
        r.force.push_back(load_of_the_element(cd, ca, {0, 0, v, a}) - mass * a);
      }
      const auto f = fit::fit_morison(cylinder(Experiment::body_moves), r);
      EXPECT_NEAR(*f.cd.value, cd, 1e-9);
      EXPECT_NEAR(*f.inertia.value, ca, 1e-9);
    }
}

/// A body on a spring and damper of a run, let go at 0.3 m: small Runge-Kutta steps, of which the error is below 1e-9.
fit::Window let_go(const dynamics::LineLaw& law, double inertia, double step, Eigen::Index samples) {
  constexpr int substeps = 20;
  const double h = step / substeps;
  const auto rate = [&](const Eigen::Vector2d& y) {
    return Eigen::Vector2d(y[1], -law.at(y[0], y[1]).force / inertia);
  };
  fit::Window out{step, Eigen::MatrixXd(samples, 1)};
  Eigen::Vector2d y(0.3, 0);
  for (Eigen::Index j = 0; j < samples; ++j) {
    out.values(j, 0) = y[0];
    for (int k = 0; k < substeps; ++k) {
      const Eigen::Vector2d k1 = rate(y), k2 = rate(y + h / 2 * k1), k3 = rate(y + h / 2 * k2), k4 = rate(y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
  return out;
}

TEST(FittedElements, ADecayMovesAsTheSpringAndDamperOfARun) {
  const dynamics::LineLaw law{.stiffness = 480, .damping = 6, .quadratic_damping = 40};
  const auto window = let_go(law, 120, 0.05, 400);
  const std::vector<double> parameters{2, 6.0 / 120, 40.0 / 120, 0, 0, 0};
  const auto followed = fit::follow(fit::MotionLaw::oscillator, parameters, Eigen::Vector2d(0.3, 0), 0.05, 400, 20);
  EXPECT_LT((followed - window.values).cwiseAbs().maxCoeff(), 1e-8);
  // A hidden oscillator without strength leaves the same damper.
  const std::vector<double> without_memory{2, 6.0 / 120, 40.0 / 120, 0, 0, 0, 1, 2};
  const auto with_memory =
      fit::follow(fit::MotionLaw::with_radiation_memory, without_memory, Eigen::Vector4d(0.3, 0, 0, 0), 0.05, 400, 20);
  EXPECT_LT((with_memory - window.values).cwiseAbs().maxCoeff(), 1e-7)
      << "steps that hold a turning are of lower order";
}

TEST(FittedElements, ADecayFitFindsWhatIsChangedInTheDamper) {
  const auto fitted = [](const dynamics::LineLaw& law) {
    return fit::fit_decay(std::vector{let_go(law, 120, 0.05, 600)});
  };
  const auto as_it_is = fitted({.stiffness = 480, .damping = 6, .quadratic_damping = 40}),
             changed = fitted({.stiffness = 480, .damping = 6.6, .quadratic_damping = 36}),
             stiffening = fitted({.stiffness = 480, .damping = 6, .cubic = 300, .quadratic_damping = 40});
  EXPECT_NEAR(*as_it_is.damping[0].value, 0.05, 1e-6);
  EXPECT_NEAR(*as_it_is.damping[1].value, 40.0 / 120, 1e-6);
  EXPECT_NEAR(*changed.damping[0].value, 0.055, 1e-6);
  EXPECT_NEAR(*changed.damping[1].value, 0.3, 1e-6);
  EXPECT_LT(as_it_is.motion.rms[0], 1e-7);
  EXPECT_GT(stiffening.motion.rms[0], 1e-4) << "another exponent of the spring is no motion of this model";
}

TEST(FittedElements, AFrictionRampGivesTheLevelsThatFrictionOfARunHas) {
  const dynamics::Joint rail{"rail", dynamics::JointKind::slider, 0, {}, Vector3d::Zero()};
  for (const double breakaway : {3.7, 4.4}) {
    const dynamics::Friction law{.name = "rail",
                                 .coordinate = dynamics::JointCoordinate(rail, {Vector3d::Zero(), Vector3d::Zero()}),
                                 .breakaway = breakaway,
                                 .sliding = 3.0,
                                 .stribeck = 0.5};
    const dynamics::FrictionKind kind({law});
    const dynamics::FrictionMemory sticks(1);
    constexpr double rate = 0.8, step = 0.01, slide_speed = 0.4;
    std::vector<double> time, load;
    for (int j = 0; j < 1000; ++j) {
      const double t = step * j, carried = rate * t;
      time.push_back(t);
      // Driven at a steady speed once it has slipped.
      load.push_back(kind.utilisation(0, carried, sticks, t) < 1 ? carried : law.level(slide_speed));
    }
    const auto f = fit::fit_friction_ramp(time, load, {.ramp_s = 2, .slide_s = 2.5});
    // The slip is known to half a sample, in which the load grows by 0.004 N.
    EXPECT_NEAR(*f.static_level.value, breakaway, rate * step / 2 + 1e-9);
    EXPECT_NEAR(*f.dynamic_level.value, 3 + (breakaway - 3) * std::exp(-0.64), 1e-9);
  }
}

TEST(FittedElements, AForcedOscillationFindsTheRadiationOfARun) {
  constexpr double inertia = 120, stiffness = 2500, limit = 60, step = 0.01, omega = 2.5;
  const support::TwoPoleBody waves{.decay = 1.2, .frequency = 2.8};
  for (const double strength : {400.0, 500.0}) {
    auto poles = waves.model();
    poles.C[0] *= strength;
    poles.S[0] *= strength;
    const dynamics::RadiationKind kind({{{0}, std::make_shared<hydro::radiation::PoleMemory>(poles, step)}});
    dynamics::State state = dynamics::rest_state({dynamics::RigidBody(
        {.name = "buoy", .mass = inertia, .inertia = Eigen::Matrix3d::Identity(), .rest_position = {{0, 0, 0}}})});
    std::unique_ptr<dynamics::Memory> memory;
    std::vector<double> time, motion, force;
    for (int j = 0; j < 4500; ++j) {
      state.time = step * j;
      const double x = 0.05 * std::sin(omega * state.time);
      state.velocity[0] = 0.05 * omega * std::cos(omega * state.time);
      if (!memory) {
        memory = kind.make_memory(state);
        continue;
      }
      Eigen::VectorXd load = Eigen::VectorXd::Zero(6);
      dynamics::LoadSink sink(load);
      kind.add_load({state, memory.get()}, sink);
      memory->accept(state);
      if (j < 2000) continue;  // of the start e^{-24} is left
      time.push_back(state.time);
      motion.push_back(x);
      force.push_back(load[0] + (inertia + limit) * omega * omega * x - stiffness * x);
    }
    const auto p = fit::fit_radiation(time, motion, force, {inertia, stiffness});
    // The frequency is known to 1e-5 over ten cycles; velocities that are straight over a step are 5e-5 too small.
    EXPECT_NEAR(*p.added_mass.value, limit + strength * waves.A_minus_A_inf(omega), 0.05);
    EXPECT_NEAR(*p.damping.value, strength * waves.B(omega), 0.05 * omega);
  }
}

}  // namespace
}  // namespace fitted_elements_test
