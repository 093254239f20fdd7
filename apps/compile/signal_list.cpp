#include "compile/signal_list.hpp"

#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "compile/connections.hpp"
#include "compile/sections.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/kinematics/sea.hpp"

namespace froude::compile {
namespace {

using dynamics::EnergyLedger;

/// Of what the model holds.
void add(const std::vector<dynamics::Signal>& signals, std::vector<Signal>& out) {
  for (const dynamics::Signal& s : signals)
    out.push_back({s.name, s.unit, s.meaning, [s](const Moment& m) { return m.workspace.read(s, m.model); },
                   s.variation, s.no_variation});
}

double stored(const EnergyLedger& ledger) {
  double sum = 0;
  for (const auto& e : ledger.entries()) sum += e.stored;
  return sum;
}

/// What has been lost where friction slips and in impacts: in what yields.
double lost_in_slip(const EnergyLedger& ledger) {
  double sum = 0;
  for (const auto& e : ledger.entries())
    if (e.effect == "friction" || e.effect == "contact") sum += e.dissipated;
  return sum;
}

template <class Read>
Signal energy(const std::string& name, const std::string& meaning, Read read) {
  return {"energy." + name,
          "J",
          meaning,
          [read](const Moment& m) { return read(m.ledger); },
          {},
          "energies are of second order in the motions"};
}

/// The last four are the sums by which Van Zanten (2020), table 4.1, judges a structure that yields: what swings, what
/// it has lost for good, and both.
void add_energies(const dynamics::Model& model, std::vector<Signal>& out) {
  out.push_back(
      energy("kinetic", "kinetic energy of bodies and added mass", [](const EnergyLedger& l) { return l.kinetic(); }));
  const std::vector<std::string> effects = EnergyLedger::effects(model);
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const auto add = [&](const char* what, double EnergyLedger::Entry::*member) {
      out.push_back(energy(fmt::format("{}.{}", effects[k], what), fmt::format("energy {} by {}", what, effects[k]),
                           [k, member](const EnergyLedger& l) { return l.entries()[k].*member; }));
    };
    add("stored", &EnergyLedger::Entry::stored);
    add("supplied", &EnergyLedger::Entry::supplied);
    add("dissipated", &EnergyLedger::Entry::dissipated);
  }
  out.push_back(energy("stored", "potential energy of all effects", &stored));
  out.push_back(energy("elastic", "kinetic and potential energy: what motion can give back",
                       [](const EnergyLedger& l) { return l.kinetic() + stored(l); }));
  out.push_back(energy("dissipated", "lost in the slip of friction and contacts, and in impacts", &lost_in_slip));
  out.push_back(energy("absorbed", "kinetic and potential energy and what slip has lost",
                       [](const EnergyLedger& l) { return l.kinetic() + stored(l) + lost_in_slip(l); }));
  out.push_back(energy("residual", "energy residual: what the sums of the ledger differ by",
                       [](const EnergyLedger& l) { return l.residual(); }));
}

/// What a wave of one metre does at a point, (real, imaginary part): its kinematics at t = 0 and a quarter period
/// before.
dynamics::Variation wave_variation(const hydro::Water& water, const Eigen::Vector3d& at,
                                   std::function<double(const hydro::waves::Kinematics&)> take) {
  return {.by_wave = [water, at, take](double omega, double heading) {
    const auto unit = hydro::waves::linear_field(
        hydro::waves::Sea::regular(hydro::WaveAmplitude::from_metres(1), hydro::AngularFrequency::from_rad_per_s(omega),
                                   hydro::Angle::from_radians(heading), water),
        {.stretching = hydro::waves::Stretching::none});
    return std::complex<double>(take(unit.at(0, at)), take(unit.at(-std::numbers::pi / (2 * omega), at)));
  }};
}

/// A number of the undisturbed water at a fixed point. `field` is empty where there is no run.
Signal water_signal(const scene::Scene& scene, const std::shared_ptr<const hydro::waves::WaveField>& field,
                    const Eigen::Vector3d& at, const ProbeSignal& s) {
  Signal out{s.name, s.unit, s.long_name,
             [field, at, take = s.take](const Moment& m) { return take(field->at(m.workspace.state.time, at)); }};
  if (s.of_surface)  // a sum of cosines alone, which costs far less than the flow
    out.value = [field, at](const Moment& m) { return field->elevation(m.workspace.state.time, at.x(), at.y()); };
  if (scene.current_place)
    out.no_variation = "waves on a current are those of a run";
  else if (at.z() > 0 && !s.of_surface)
    out.no_variation = "the point is above still water, where linear waves have no water";
  else
    out.variation = [water = scene.water, at = Eigen::Vector3d(at.x(), at.y(), std::min(at.z(), 0.0)),
                     take = s.take](const dynamics::Still&) { return wave_variation(water, at, take); };
  return out;
}

/// The undisturbed water at the origin and at the scene's [[probe]]s, in a run with the ramp of the loads.
void add_water(const scene::Scene& scene, const std::shared_ptr<const hydro::waves::WaveField>& field,
               std::vector<Signal>& out) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  out.push_back(water_signal(scene, field, origin,
                             {"wave.elevation", "m", "elevation of the undisturbed wave at the origin",
                              [](const hydro::waves::Kinematics& k) { return k.elevation; }, true}));
  for (const auto& p : scene.probes)
    for (const ProbeSignal& s : probe_signals(p)) out.push_back(water_signal(scene, field, p.at, s));
}

/// How far a point of a body is above the undisturbed surface there.
Signal air_gap(const scene::Scene& scene, const std::shared_ptr<const hydro::waves::WaveField>& field,
               const std::string& name, const dynamics::PointOnBody& point) {
  Signal out{name + ".air_gap", "m", fmt::format("height of {} above the undisturbed surface", name),
             [field, point](const Moment& m) {
               const dynamics::State& now = m.workspace.state;
               const Eigen::Vector3d at = dynamics::place_of(point, now);
               return at.z() - field->elevation(now.time, at.x(), at.y());
             }};
  if (scene.current_place) {
    out.no_variation = "waves on a current are those of a run";
    return out;
  }
  out.variation = [water = scene.water, point, name](const dynamics::Still& still) {
    Eigen::Vector3d at = dynamics::place_of(point, still.state);
    at.z() = 0;
    dynamics::Variation gap = dynamics::place_signals(name, point)[2].variation(still);
    gap.by_wave = wave_variation(water, at, [](const hydro::waves::Kinematics& k) { return -k.elevation; }).by_wave;
    return gap;
  };
  return out;
}

/// Of the body's mass alone: energies of the ledger count added mass besides, and are of all bodies together.
void add_own_energy(const scene::Scene& scene, const dynamics::RigidBody& body, std::size_t index,
                    std::vector<Signal>& out) {
  const char* why = "energies are of second order in the motions";
  out.push_back({body.name() + ".energy.kinetic",
                 "J",
                 fmt::format("kinetic energy of {}, of its mass alone", body.name()),
                 [body, index](const Moment& m) {
                   const dynamics::Vector6 v = m.workspace.state.twist(static_cast<int>(index));
                   const Eigen::Vector3d spin =
                       m.workspace.state.pose[index].attitude.conjugate() * Eigen::Vector3d(v.tail<3>());  // body axes
                   return (body.mass() * v.head<3>().squaredNorm() + spin.dot(body.inertia() * spin)) / 2;
                 },
                 {},
                 why});
  if (!scene.bodies[index].weight) return;
  out.push_back({body.name() + ".energy.potential",
                 "J",
                 fmt::format("weight of {} times the height of its centre of gravity above that at rest", body.name()),
                 [weight = body.mass() * scene.water.gravity, rest = body.rest_centre().z(), index](const Moment& m) {
                   return weight * (m.workspace.state.pose[index].centre.z() - rest);
                 },
                 {},
                 why});
}

/// What the scene names beside what its elements tell.
void add_named(const scene::Scene& scene, const dynamics::Model& model,
               const std::shared_ptr<const hydro::waves::WaveField>& field, std::vector<Signal>& out) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].net_load) add(dynamics::net_load_signals(model.bodies()[b], static_cast<int>(b)), out);
    if (scene.bodies[b].energy) add_own_energy(scene, model.bodies()[b], b, out);
  }
  for (const scene::Point& p : scene.points) {
    const dynamics::PointOnBody point = point_on(scene, p.body, p.at);
    if (p.position) add(dynamics::place_signals(p.name, point), out);
    if (p.velocity) add(dynamics::velocity_signals(p.name, point), out);
    if (p.acceleration) add(dynamics::acceleration_signals(p.name, point), out);
    if (p.air_gap) out.push_back(air_gap(scene, field, p.name, point));
  }
  for (const scene::PointPair& pair : scene.relative_motions)
    add(dynamics::relative_motion_signals(pair.name, ends_of(scene, pair), offset_of(scene, pair)), out);
}

std::vector<std::string> names_of(const std::vector<Signal>& all) {
  std::vector<std::string> out;
  for (const Signal& s : all) out.push_back(s.name);
  return out;
}

/// "hinge.pto_power and hinge.friction have no response: …", one sentence a reason.
void tell_without(const std::vector<Signal>& without, std::vector<std::string>& notes) {
  std::vector<std::string> told;
  for (const Signal& s : without) {
    if (std::find(told.begin(), told.end(), s.no_variation) != told.end()) continue;
    told.push_back(s.no_variation);
    std::vector<std::string> names;
    for (const Signal& other : without)
      if (other.no_variation == s.no_variation) names.push_back(other.name);
    notes.push_back(fmt::format("no response per metre of wave: {}: {}", fmt::join(names, ", "), s.no_variation));
  }
}

}  // namespace

std::vector<ProbeSignal> probe_signals(const scene::Probe& probe) {
  using hydro::waves::Kinematics;
  std::vector<ProbeSignal> out;
  const auto add = [&](const std::string& what, const char* unit, const std::string& meaning,
                       std::function<double(const Kinematics&)> take) {
    out.push_back({probe.name + "." + what, unit, fmt::format("{} at {}", meaning, probe.name), std::move(take)});
  };
  if (probe.elevation) add("elevation", "m", "elevation of the water", [](const Kinematics& k) { return k.elevation; });
  for (ProbeSignal& s : out) s.of_surface = true;
  for (int axis = 0; axis < 3 && probe.velocity; ++axis)
    add(std::string("velocity_") + "xyz"[axis], "m/s", fmt::format("velocity of the water along {}", "xyz"[axis]),
        [axis](const Kinematics& k) { return k.velocity[axis]; });
  for (int axis = 0; axis < 3 && probe.acceleration; ++axis)
    add(std::string("acceleration_") + "xyz"[axis], "m/s^2",
        fmt::format("rate of the water's velocity along {} at this fixed point", "xyz"[axis]),
        [axis](const Kinematics& k) { return k.acceleration[axis]; });
  if (probe.pressure)
    add("pressure", "Pa", "dynamic pressure p + rho g z", [](const Kinematics& k) { return k.dynamic_pressure; });
  return out;
}

std::vector<Signal> signal_list(const scene::Scene& scene, const TimeModel& model) {
  std::vector<Signal> out;
  add(model.model.signals(), out);
  add_named(scene, model.model, model.water.field, out);
  if (scene.waves) add_water(scene, model.water.field, out);
  if (!model.model.bodies().empty()) add_energies(model.model, out);
  add_line_signals(model.lines, out);
  return out;
}

std::vector<Signal> signal_list(const scene::Scene& scene, const Prepared& prepared, const dynamics::Model& model) {
  std::vector<Signal> out;
  add(model.signals(), out);
  if (!prepared.friction.empty()) add(dynamics::FrictionKind(prepared.friction).signals(), out);
  if (!prepared.contacts.empty()) add(dynamics::ContactKind(prepared.contacts).signals(), out);
  add_named(scene, model, nullptr, out);
  add_water(scene, nullptr, out);
  add_energies(model, out);
  add_line_signals(lines_as_placed(scene), out);
  add_section_signals(scene, prepared, model, out);
  for (Signal& s : out) s.value = {};
  return out;
}

std::vector<Signal> chosen(const std::vector<Signal>& all, const std::vector<std::string>& patterns,
                           const std::vector<scene::Place>& places) {
  scene::check_patterns(patterns, places, names_of(all));
  std::vector<Signal> out;
  for (const Signal& s : all)
    if (is_chosen(s.name, patterns)) out.push_back(s);
  return out;
}

std::vector<Signal> chosen_responses(const std::vector<Signal>& all, const std::vector<std::string>& patterns,
                                     const std::vector<scene::Place>& places, std::vector<std::string>& notes) {
  std::vector<Signal> out, without;
  for (const Signal& s : chosen(all, patterns, places)) (s.variation ? out : without).push_back(s);
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    const auto fits = [&](const Signal& s) { return scene::matches(patterns[i], s.name); };
    const auto why = std::find_if(without.begin(), without.end(), fits);
    if (why != without.end() && std::none_of(out.begin(), out.end(), fits))
      throw hydro::InputError(fmt::format("\"{}\" has no response per metre of wave: {}", why->name, why->no_variation),
                              places[i], "take it out of `of`, or ask for a run");
  }
  if (!patterns.empty()) tell_without(without, notes);
  return out;
}

}  // namespace froude::compile
