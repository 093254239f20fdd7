#include "compile/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compile/integrator.hpp"
#include "compile/waves.hpp"
#include "dynamics/force/constant_load.hpp"
#include "dynamics/frequency/fastest.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;
using scene::Scene;

/// Something that moves, and how fast.
struct Mover {
  double omega = 0;  // rad/s
  std::string what;
};

/// What springs may still gain in stiffness, with no load where the bodies are: slack lines drawn taut, tables at their
/// steepest, stops run into.
void add_stiffening(const Prepared& p, const dynamics::State& at,
                    std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces) {
  std::vector<dynamics::AxialConnector> taut;
  const auto consider = [&](dynamics::AxialConnector c) {
    const double length = dynamics::axial_state(c, at).length;
    const double more = c.law.stiffest() - c.law.at(length - c.rest_length, 0).by_x;
    if (more <= 0) return;
    c.law = {.stiffness = more};
    c.rest_length = length;
    taut.push_back(std::move(c));
  };
  for (const auto& c : p.axial) consider(c);
  for (const auto& group : p.switched)
    for (const auto& c : group.connectors) consider(c);
  for (std::size_t i = 0, all = forces.size(); i < all; ++i)
    if (auto more = forces[i]->stiffer_than_at(at)) forces.push_back(std::move(more));
  if (!taut.empty()) forces.push_back(std::make_unique<dynamics::AxialConnectorKind>(std::move(taut)));
}

/// Added mass at infinite frequency of each group that radiates, or what its file has that is nearest to it.
std::vector<dynamics::AddedMass> added_mass(const Prepared& p) {
  std::vector<dynamics::AddedMass> out;
  for (const auto& g : p.groups) {
    if (!g.radiation) continue;
    const auto& c = g.table.coefficients();
    const Eigen::MatrixXd A = c.A_inf ? *c.A_inf : c.A.back();
    out.push_back({g.bodies, hydro::dense::symmetric_part(A)});
  }
  return out;
}

/// Bodies on their springs, which are as stiff about `at` as they ever become.
dynamics::Model model_of_springs(const Prepared& p, const dynamics::State& at) {
  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  add_springs(p, forces);
  add_stiffening(p, at, forces);
  if (!p.fastened.empty()) forces.push_back(std::make_unique<dynamics::FastenedLineKind>(p.fastened));
  return {p.bodies, added_mass(p), std::move(forces), p.joints};
}

/// The bodies' own motions about one state.
Mover own_motion(const dynamics::Model& model, const dynamics::State& about) {
  const auto fastest = dynamics::frequency::fastest_motion(model, about);
  return {fastest.omega, fmt::format("the bodies' own motion of {1:.4g} s, mostly {0}", model.mode_name(fastest.mode),
                                     2 * std::numbers::pi / fastest.omega)};
}

Mover turning(const Prepared& p, const dynamics::State& start) {
  Mover out;
  for (std::size_t i = 0; i < p.bodies.size(); ++i)
    if (const double rate = start.twist(static_cast<int>(i)).tail<3>().norm(); rate > out.omega)
      out = {rate, fmt::format("{}, which starts turning at {:.4g} rad/s", p.bodies[i].name(), rate)};
  return out;
}

/// What bodies and a line of the kind that goes slack do that is drawn taut at once, √(k/m), m of what both of its ends
/// move.
Mover snap(const Scene& scene) {
  Mover out;
  for (const scene::Line& l : scene.lines) {
    if (!l.common.tension_only || !l.fastened()) continue;
    double compliance = 0, mobility = 0;
    for (const auto& segment : l.segments) compliance += segment.length / segment.axial_stiffness;
    for (const auto& body : {l.from.body, l.to.body})
      if (body) mobility += 1 / scene.bodies[static_cast<std::size_t>(*body)].mass;
    if (const double omega = std::sqrt(mobility / compliance); omega > out.omega)
      out = {omega, fmt::format("line {} where it is drawn taut, {:.4g} s", l.name, 2 * std::numbers::pi / omega)};
  }
  return out;
}

/// The shortest ramp of a load on bodies, s; ∞: none rises or falls.
double shortest_ramp(const Prepared& p) {
  double out = std::numeric_limits<double>::infinity();
  for (const auto& elements : p.elements) {
    const auto force = elements->force({p.bodies, p.water, p.joints});
    if (const auto* load = dynamic_cast<const dynamics::ConstantLoadKind*>(force.get()))
      out = std::min(out, load->shortest_ramp());
  }
  return out;
}

Mover fastest_mover(const Scene& scene, const Prepared& p) {
  Mover out;
  const auto compare = [&](Mover other) {
    if (other.omega > out.omega) out = std::move(other);
  };
  if (scene.waves)
    if (const double omega = highest_relevant_frequency(*scene.waves); omega > 0)
      compare({omega, fmt::format("waves of {:.4g} s, the shortest that matter", 2 * std::numbers::pi / omega)});
  for (const auto& joint : scene.joints)
    if (joint.prescribed && joint.prescribed->omega > 0)
      compare({joint.prescribed->omega, fmt::format("the prescribed motion of joint {}, {:.4g} s", joint.name,
                                                    2 * std::numbers::pi / joint.prescribed->omega)});
  if (p.bodies.empty()) return out;
  const dynamics::State rest = dynamics::rest_state(p.bodies);
  const dynamics::Model model = model_of_springs(p, rest);
  compare(own_motion(model, rest));
  std::vector<std::string> told_with_the_run;
  const dynamics::State start = placed_state(scene, p, model, told_with_the_run);
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const auto& b) { return !b.initial.empty(); }))
    compare(own_motion(model_of_springs(p, start), start));
  if (const double ramp = shortest_ramp(p); std::isfinite(ramp))  // half a period
    compare({std::numbers::pi / ramp, fmt::format("a load that rises or falls over {:.4g} s", ramp)});
  compare(turning(p, start));
  compare(snap(scene));
  return out;
}

/// \throws InputError unless the scene's step divides the distance of samples
double given_step(const Scene& scene) {
  const double every = scene.run->every, ratio = every / scene.solve.step->value;
  if (std::abs(ratio - std::round(ratio)) > 1e-9 * ratio || ratio < 1 - 1e-9)
    throw InputError(
        fmt::format("a step of {} s does not divide the distance of samples, {} s", scene.solve.step->value, every),
        scene.solve.step->place, fmt::format("use \"{:.6g} s\"", every / std::max(1.0, std::ceil(ratio))));
  return every / std::round(ratio);
}

/// \throws InputError if a run takes so many steps that it would not end: at the 1e-7 s of the smallest scene, and with
/// the wave loads of every step in memory, 1e9 are minutes and gigabytes
void check_count(const Scene& scene, double step, const std::string& follows) {
  constexpr double most = 1e9;
  const double steps = scene.run->duration / step;
  if (steps <= most) return;
  throw InputError(fmt::format("a run of {:.6g} s takes {:.3g} steps of {:.3g} s; {:g} are the limit; {}",
                               scene.run->duration, steps, step, most, follows),
                   scene.run->place, "look at the units of stiffness and mass, or state [solve] step");
}

}  // namespace

ChosenStep choose_step(const Scene& scene, const Prepared& prepared) {
  const Mover fastest = fastest_mover(scene, prepared);
  const double every = scene.run->every;
  const double longest = fastest.omega > 0 ? std::sqrt(12 * scene.accuracy) / 4 / fastest.omega : every;
  const std::string follows =
      fastest.omega > 0 ? "fastest: " + fastest.what : "no body swings by itself, and there are no waves";
  const auto size = [&](double step) {
    return fmt::format("{:.4g} s, period error (omega h)^2 / 12 of {:.2g}", step,
                       std::pow(fastest.omega * step, 2) / 12);
  };
  if (!scene.solve.step) {
    const double step = every / std::max(1.0, std::ceil(every / longest - 1e-9));
    check_count(scene, step, follows);
    return {step, {"step", follows, size(step), true}, {}};
  }
  const double step = given_step(scene);
  if (const double ramp = shortest_ramp(prepared); step > ramp)
    throw InputError(fmt::format("a step of {:.4g} s misses a load that rises or falls over {:.4g} s", step, ramp),
                     scene.solve.step->place, "take a shorter step, or leave it out, or let the load take longer");
  check_count(scene, step, follows);
  ChosenStep out{step, {"step", "as the scene gives it; " + follows, size(step), true}, {}};
  const bool cuts = has_steps_by_tolerance(scene.solve);
  if (step > longest * (1 + 1e-9) && !cuts)
    out.note = fmt::format(
        "the step that the scene gives, {:.4g} s, is longer than the {:.4g} s that an accuracy of {:.2g} asks for; "
        "fastest: {}",
        step, longest, scene.accuracy.value, fastest.what);
  return out;
}

}  // namespace froude::compile
