#include <cmath>
#include <numbers>

#include "dynamics/force/contact.hpp"
#include "dynamics/force/friction.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "harness/case.hpp"

namespace froude::validation::stick {
namespace {

using dynamics::Event;
using Forces = std::vector<std::unique_ptr<const dynamics::ForceKind>>;
constexpr double g = 9.81, h = 1e-3, pi = std::numbers::pi;

/// A run of equal steps, and where something changed.
struct Run {
  dynamics::Workspace w;
  dynamics::GeneralizedAlpha integrator;
  std::vector<Event> events;

  Run(const dynamics::Model& model, dynamics::State start) : w(model, std::move(start)), integrator(model, {}) {
    integrator.start(w);
  }
  void step() {
    const auto report = integrator.step(w, h);
    events.insert(events.end(), report.events.begin(), report.events.end());
  }
};

/// A belt too heavy to be slowed, v = 0.1 m/s, drags 2 kg on a spring of 50 N/m: 3.5 N hold, 3 N resist.
double belt() {
  constexpr double k = 50, m = 2, v = 0.1, breakaway = 3.5, sliding = 3;
  const auto body = [](const char* name, double mass) {
    return dynamics::RigidBody({.name = name, .mass = mass, .inertia = mass * Eigen::Matrix3d::Identity()});
  };
  std::vector<dynamics::RigidBody> bodies{body("block", m), body("belt", 1e12)};
  const auto rail = [](const char* name, int first, std::optional<int> second) {
    return dynamics::Joint{
        .name = name, .kind = dynamics::JointKind::slider, .first = first, .second = second, .place = {0, 0, 0}};
  };
  const std::vector<dynamics::Joint> joints{rail("rail", 0, {}), rail("contact", 1, 0)};
  dynamics::Matrix6 spring = dynamics::Matrix6::Zero();
  spring(0, 0) = k;
  Forces forces;
  forces.push_back(
      std::make_unique<dynamics::RestoringKind>("mooring", bodies, std::vector<dynamics::Restoring>{{0, spring}}));
  forces.push_back(std::make_unique<dynamics::FrictionKind>(
      std::vector<dynamics::Friction>{{"contact", dynamics::JointCoordinate(bodies, joints[1]), breakaway, sliding}}));
  const dynamics::Model model(bodies, {}, std::move(forces), joints);
  dynamics::State start = dynamics::rest_state(bodies);
  start.velocity[0] = start.velocity[6] = v;
  Run run(model, start);
  while (run.events.size() < 10) run.step();
  const double omega = std::sqrt(k / m), a = (breakaway - sliding) / k;
  double worst = 0, exact = breakaway / k / v;
  for (std::size_t n = 0; n < 10; ++n) {
    worst = std::max(worst, std::abs(run.events[n].time - exact));
    exact += n % 2 == 0 ? 2 * (pi - std::atan(a * omega / v)) / omega : 2 * a / v;
  }
  return worst;
}

struct Ball {
  double worst, rest_in_steps;
};

Ball ball() {
  constexpr double height = 0.5, e = 0.8, radius = 0.1;
  std::vector<dynamics::RigidBody> bodies{
      dynamics::RigidBody({.name = "ball",
                           .mass = 2,
                           .inertia = 0.01 * Eigen::Matrix3d::Identity(),
                           .rest_position = {Eigen::Vector3d(0, 0, height + radius)}})};
  Forces forces;
  forces.push_back(std::make_unique<dynamics::GravityKind>(bodies, g));
  forces.push_back(std::make_unique<dynamics::ContactKind>(std::vector<dynamics::Contact>{
      {"floor", 0, {}, {dynamics::Ball{{0, 0, 0}, radius}, dynamics::HalfSpace{{0, 0, 0}, {0, 0, 1}}}, e, 0}}));
  const dynamics::Model model(bodies, {}, std::move(forces));
  Run run(model, dynamics::rest_state(bodies));
  const double t0 = std::sqrt(2 * height / g), end = t0 * (1 + e) / (1 - e);
  while (run.w.state.time < end - h) run.step();
  Ball out{};
  double exact = t0;
  for (std::size_t n = 0; n < 15; ++n) {
    out.worst = std::max(out.worst, std::abs(run.events[n].time - exact));
    exact += 2 * t0 * std::pow(e, static_cast<double>(n + 1));
  }
  while (run.w.state.velocity.norm() > 1e-9 && run.w.state.time < 2 * end) run.step();
  out.rest_in_steps = (run.w.state.time - end) / h;
  return out;
}

/// A uniform block b × 4b on two corners, let go where it leans by half of α.
struct Rocking {
  double b = 0.25, height = 1, m = 10;
  double R = std::hypot(b / 2, height / 2), alpha = std::atan2(b, height), inertia = m / 12 * (b * b + height * height);
  double p2 = m * g * R / (inertia + m * R * R);

  /// Rate when it has fallen from rest at `from`, and the time it takes: ½θ̇² = p²(cos(α − from) − cos(α − θ)).
  double rate(double from, double theta) const {
    return std::sqrt(2 * p2 * (std::cos(alpha - from) - std::cos(alpha - theta)));
  }
  double fall(double from) const {
    constexpr int parts = 20'000;
    double time = 0;
    for (int i = 0; i < parts; ++i) {  // θ = from (1 − s²) takes the root at the start away
      const double s = (i + 0.5) / parts;
      time += 2 * from * s / rate(from, from * (1 - s * s)) / parts;
    }
    return time;
  }
  /// The lean from which it would have fallen with this rate at the end.
  double lean_of(double final_rate) const {
    return alpha - std::acos(std::cos(alpha) + final_rate * final_rate / (2 * p2));
  }
  double kept() const { return 1 - 1.5 * std::sin(alpha) * std::sin(alpha); }
};

dynamics::Model rocking_model(const Rocking& r) {
  std::vector<dynamics::RigidBody> bodies{dynamics::RigidBody({.name = "block",
                                                               .mass = r.m,
                                                               .inertia = r.inertia * Eigen::Matrix3d::Identity(),
                                                               .rest_position = {Eigen::Vector3d(0, 0, r.height / 2)},
                                                               .free = {true, false, true, false, true, false}})};
  std::vector<dynamics::Contact> corners;
  for (const double x : {-r.b / 2, r.b / 2})
    corners.push_back({"corner",
                       0,
                       {},
                       {dynamics::Ball{{x, 0, -r.height / 2}, 0}, dynamics::HalfSpace{{0, 0, 0}, {0, 0, 1}}},
                       0,
                       0.9});
  Forces forces;
  forces.push_back(std::make_unique<dynamics::GravityKind>(bodies, g));
  forces.push_back(std::make_unique<dynamics::ContactKind>(std::move(corners)));
  return {std::move(bodies), {}, std::move(forces)};
}

struct Strikes {
  double first, second, kept, gained;
  std::vector<double> time, lean;
};

Strikes rock(const Rocking& r) {
  const double from = 0.5 * r.alpha;
  const dynamics::Model model = rocking_model(r);
  dynamics::State start = dynamics::rest_state(model.bodies());
  start.pose[0].centre = {r.b / 2 - r.R * std::sin(r.alpha - from), 0, r.R * std::cos(r.alpha - from)};
  start.pose[0].attitude = dynamics::rotation_exp({0, from, 0});
  Run run(model, start);
  Strikes out{};
  const auto energy_now = [&] {  // above that of lying flat
    return model.kinetic_energy(run.w.state) + r.m * g * (run.w.state.pose[0].centre.z() - r.height / 2);
  };
  double energy = energy_now(), strikes = 0;
  while (run.w.state.time < 3) {
    const std::size_t seen = run.events.size();
    run.step();
    const double now = energy_now();
    if (run.events.size() > seen && strikes < 2) {
      (strikes == 0 ? out.first : out.second) = run.events.back().time;
      if (strikes == 0) out.kept = std::sqrt(now / energy);  // all of it is motion where the block is flat
      ++strikes;
    }
    if (strikes > 0) out.gained = std::max(out.gained, now - energy);
    energy = now;
    out.time.push_back(run.w.state.time);
    out.lean.push_back(dynamics::rotation_log(run.w.state.pose[0].attitude).y());
  }
  out.gained /= r.m * g * (r.R - r.height / 2);
  return out;
}

}  // namespace

Outcome outcome(const Folders&) {
  const Rocking r;
  const Strikes s = rock(r);
  const Ball b = ball();
  const double first = r.fall(0.5 * r.alpha), lean = r.lean_of(r.kept() * r.rate(0.5 * r.alpha, 0));
  Outcome out;
  out.numbers = {
      {"block on a belt: time of the worst of 10 changes", belt(), "s"},
      {"bouncing ball: time of the worst of 15 impacts", b.worst, "s"},
      {"bouncing ball: rest, in steps after the end of the series", b.rest_in_steps, ""},
      {"rocking block: time of the first strike, less the quadrature", s.first - first, "s"},
      {"rocking block: time of the second strike, less the quadrature", s.second - (first + 2 * r.fall(lean)), "s"},
      {"rocking block: share of its rate that a strike leaves, relative to Housner's", s.kept / r.kept() - 1, ""},
      {"rocking block: energy gained at any step after the first strike, relative", s.gained, ""}};
  plot::Figure f{.title = "A block that rocks from corner to corner",
                 .panels = {{.x = {"time", "s"}, .y = {"lean", "rad"}, .series = {}}}};
  f.panels[0].series = {{.name = "lean", .x = s.time, .y = s.lean}};
  out.pictures.push_back(
      {"rocking", "Each strike takes a share of the rate; half-swings grow shorter as they grow smaller.", f});
  return out;
}

}  // namespace froude::validation::stick
