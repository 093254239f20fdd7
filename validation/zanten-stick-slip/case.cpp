#include <cmath>
#include <numbers>

#include "dynamics/force/friction.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "harness/case.hpp"
#include "support/ramp_load.hpp"

namespace froude::validation::zanten_stick_slip {
namespace {

// The hinge of the experiment: 3.70 N m holds, 0.81 of it resists. A torque that grows at `rate` drags an arm that a
// spring holds back: the pull on the hinge is rate · t − k θ.
constexpr double breakaway = 3.70, sliding = 0.81 * 3.70, inertia = 2.0, rate = 0.5, k = 12.0, duration = 60;

/// y = rate t / k − θ obeys I y'' + k (y − T_d/k) = 0 while the hinge slips; it sticks while k y < T_s.
struct ClosedForm {
  double omega = std::sqrt(k / inertia), speed = rate / k, half = (breakaway - sliding) / k;
  double first = breakaway / rate;
  double slip = 2 * (std::numbers::pi - std::atan(half * omega / speed)) / omega;
  double stick = 2 * half / speed;

  /// Time of the n-th change, from 0: slips at even n, sticks at odd.
  double change(std::size_t n) const {
    return first + static_cast<double>(n / 2) * (slip + stick) + (n % 2 == 1 ? slip : 0);
  }
};

dynamics::Model hinge() {
  dynamics::Matrix6 spring = dynamics::Matrix6::Zero();
  spring(4, 4) = k;
  std::vector<dynamics::RigidBody> bodies;
  bodies.emplace_back(
      dynamics::RigidBody::Properties{.name = "arm", .mass = 1, .inertia = inertia * Eigen::Matrix3d::Identity()});
  const dynamics::Joint pin{.name = "hinge",
                            .kind = dynamics::JointKind::hinge,
                            .first = 0,
                            .second = {},
                            .place = {0, 0, 0},
                            .axis = Eigen::Vector3d::UnitY()};
  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  forces.push_back(std::make_unique<support::RampLoad>(0, rate));
  forces.push_back(std::make_unique<dynamics::RestoringKind>(
      "mooring", bodies, std::vector<dynamics::Restoring>{{.body = 0, .stiffness = spring}}));
  forces.push_back(std::make_unique<dynamics::FrictionKind>(
      std::vector<dynamics::Friction>{{pin.name, dynamics::JointCoordinate(bodies, pin), breakaway, sliding}}));
  return dynamics::Model(std::move(bodies), {}, std::move(forces), {pin});
}

struct Slips {
  std::vector<double> time, angle, changes;
  double angle_at_end, dissipated;
};

Slips run(double step) {
  const dynamics::Model model = hinge();
  dynamics::Workspace w(model, dynamics::rest_state(model.bodies()));
  dynamics::GeneralizedAlpha integrator(model, {.rho_infinity = 1});
  integrator.start(w);
  dynamics::EnergyLedger ledger(model, w);
  Slips out{};
  const auto steps = static_cast<int>(std::lround(duration / step));
  for (int i = 0; i < steps; ++i) {
    for (const auto& event : integrator.step(w, step).events) out.changes.push_back(event.time);
    ledger.note(w);
    out.time.push_back(w.state.time);
    out.angle.push_back(dynamics::rotation_log(w.state.pose[0].attitude).y());
  }
  // The hinge turns by less than half a turn in all, so the angle needs no counting of turns.
  out.angle_at_end = out.angle.back();
  out.dissipated = ledger.entries().back().dissipated;
  return out;
}

/// The largest difference of the times of all changes.
double latest(const Slips& s, const ClosedForm& exact) {
  double worst = 0;
  for (std::size_t n = 0; n < s.changes.size(); ++n) worst = std::max(worst, std::abs(s.changes[n] - exact.change(n)));
  return worst;
}

}  // namespace

Outcome outcome(const Folders&) {
  const ClosedForm exact;
  std::size_t changes = 0;
  while (exact.change(changes) < duration) ++changes;
  const Slips coarse = run(0.02), fine = run(0.01);
  Outcome out;
  out.numbers = {{"torque at which the hinge first slips, relative to the static level",
                  coarse.changes.at(0) * rate / breakaway - 1, ""},
                 {"stick/slip changes less the analytic number",
                  static_cast<double>(coarse.changes.size()) - static_cast<double>(changes), ""},
                 {"stick/slip changes in 60 s", static_cast<double>(changes), ""},
                 {"all times of changes, step 0.02 s, worst", latest(coarse, exact), "s"},
                 {"ratio of that to the same at half the step", latest(coarse, exact) / latest(fine, exact), ""},
                 {"work of friction less dynamic torque times angle, relative",
                  coarse.dissipated / (sliding * coarse.angle_at_end) - 1, ""}};
  plot::Figure f{.title = "A hinge that sticks and slips under a growing torque",
                 .panels = {{.x = {"time", "s"}, .y = {"angle", "rad"}, .series = {}}}};
  f.panels[0].series = {{.name = "angle", .x = coarse.time, .y = coarse.angle}};
  out.pictures.push_back({"angle", "Each stair is one stick, each riser one slip.", f});
  return out;
}

}  // namespace froude::validation::zanten_stick_slip
