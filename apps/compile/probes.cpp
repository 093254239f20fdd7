#include "compile/probes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "compile/signal_names.hpp"

namespace froude::compile {
namespace {

using dynamics::EnergyLedger;
using dynamics::Workspace;

/// Where the kind of force that `is_it` knows stands among the model's; their number if it is not there.
template <class IsIt>
std::size_t index_of(const dynamics::Model& model, IsIt is_it) {
  const auto& all = model.forces();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& kind) { return is_it(*kind); });
  return static_cast<std::size_t>(found - all.begin());
}

void add_motions(const scene::Scene& scene, const Prepared& p, std::vector<Probe>& out) {
  for (std::size_t b = 0; b < p.bodies.size(); ++b)
    for (int mode = 0; mode < 6; ++mode)
      if (p.bodies[b].is_free(mode))
        out.push_back({scene.bodies[b].name + "." + mode_name(mode), motion_unit(mode),
                       fmt::format("{} of {} from rest", mode_name(mode), scene.bodies[b].name),
                       [body = p.bodies[b], b, mode](const Workspace& w, const EnergyLedger&) {
                         return motion_from_rest(body, w.state.pose[b], mode);
                       }});
}

void add_connectors(const Prepared& p, std::vector<Probe>& out) {
  for (std::size_t i = 0; i < p.axial.size(); ++i)
    out.push_back({p.axial_names[i] + ".force", "N", "tension of " + p.axial_names[i],
                   [c = p.axial[i]](const Workspace& w, const EnergyLedger&) {
                     return dynamics::axial_state(c, w.state).tension;
                   }});
  for (std::size_t i = 0; i < p.bushing.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({p.bushing_names[i] + ".force_" + "xyz"[axis], "N",
                     fmt::format("force of {} on its first body along that body's {}", p.bushing_names[i], "xyz"[axis]),
                     [c = p.bushing[i], axis](const Workspace& w, const EnergyLedger&) {
                       return dynamics::bushing_force(c, w.state)[axis];
                     }});
}

/// Tension and stiffness of connectors that a controller rules.
void add_switched(const Prepared& p, const dynamics::Model& model, std::vector<Probe>& out) {
  const std::size_t kind =
      index_of(model, [](const dynamics::ForceKind& k) { return k.effect() == "connector.switched"; });
  for (std::size_t g = 0; g < p.switched.size(); ++g)
    for (std::size_t i = 0; i < p.switched[g].connectors.size(); ++i) {
      const std::string& name = p.switched_names[g][i];
      const auto stiffness = [kind, g](const Workspace& w) {
        return static_cast<const dynamics::SwitchMemory&>(*w.memory[kind]).stiffness[g];
      };
      out.push_back({name + ".force", "N", "tension of " + name,
                     [c = p.switched[g].connectors[i], stiffness](const Workspace& w, const EnergyLedger&) {
                       return dynamics::axial_state(dynamics::with_stiffness(c, stiffness(w)), w.state).tension;
                     }});
      out.push_back({name + ".stiffness", "N/m", "stiffness of " + name + " as its controller has set it",
                     [stiffness](const Workspace& w, const EnergyLedger&) { return stiffness(w); }});
    }
}

/// Tensions of catenaries, at the fairlead and at the anchor.
void add_lines(const scene::Scene& scene, const Prepared& p, std::vector<Probe>& out) {
  for (std::size_t i = 0; i < p.lines.size(); ++i) {
    const std::string& name = scene.lines[i].name;
    out.push_back({name + ".tension", "N", "tension of " + name + " at the fairlead",
                   [m = p.lines[i]](const Workspace& w, const EnergyLedger&) {
                     return dynamics::tension_of(m, w.state).fairlead();
                   }});
    out.push_back({name + ".anchor_tension", "N", "tension of " + name + " at the anchor",
                   [m = p.lines[i]](const Workspace& w, const EnergyLedger&) {
                     return dynamics::tension_of(m, w.state).anchor();
                   }});
  }
}

/// Load of a mooring about the body's origin from its load about the centre of gravity: moments move by the arm.
void add_moorings(const scene::Scene& scene, const Prepared& p, std::vector<Probe>& out) {
  for (std::size_t i = 0; i < p.moorings.size(); ++i)
    for (int mode = 0; mode < 6; ++mode) {
      if (scene.moorings[i].stiffness.row(mode).isZero() && scene.moorings[i].damping.row(mode).isZero()) continue;
      const auto body = static_cast<std::size_t>(p.moorings[i].body);
      out.push_back({p.mooring_names[i] + "." + mode_name(mode), load_unit(mode),
                     fmt::format("{} load of {} on {} about its origin", mode_name(mode), p.mooring_names[i],
                                 scene.bodies[body].name),
                     [m = p.moorings[i], b = p.bodies[body], body, mode](const Workspace& w, const EnergyLedger&) {
                       const auto& pose = w.state.pose[body];
                       dynamics::Vector6 load =
                           dynamics::restoring_load(m, pose.displacement(b), w.state.twist(m.body));
                       load.tail<3>() += (pose.attitude * b.properties().centre_of_gravity.xyz).cross(load.head<3>());
                       return load[mode];
                     }});
    }
}

/// "hinge" turns by an angle, "slider" goes a way; other joints have no single number.
void add_travels(const Prepared& p, const dynamics::Model& model, std::vector<Probe>& out) {
  for (std::size_t j = 0; j < p.joints.size(); ++j) {
    const bool turns = p.joints[j].kind == dynamics::JointKind::hinge;
    if (!turns && p.joints[j].kind != dynamics::JointKind::slider) continue;
    out.push_back({p.joints[j].name + (turns ? ".angle" : ".travel"), turns ? "rad" : "m",
                   fmt::format("{} of {}, the second against the first", turns ? "angle" : "travel", p.joints[j].name),
                   [&model, j, sign = p.joint_sign[j]](const Workspace& w, const EnergyLedger&) {
                     return sign * model.joints().travel(static_cast<int>(j), w.state);
                   }});
  }
}

/// Gap and load along the normal of contacts.
void add_contacts(const Prepared& p, const dynamics::Model& model, std::vector<Probe>& out) {
  const std::size_t kind = index_of(model, [](const dynamics::ForceKind& k) { return k.contact() != nullptr; });
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    const std::string& name = p.contacts[i].name;
    out.push_back({name + ".gap", "m", "shortest way between the shapes of " + name,
                   [&model, i, kind](const Workspace& w, const EnergyLedger&) {
                     return model.forces()[kind]->contact()->gap(i, w.state);
                   }});
    out.push_back({name + ".force", "N", "load along the normal of " + name + " while it is closed",
                   [&model, i, kind](const Workspace& w, const EnergyLedger&) {
                     return model.forces()[kind]->contact()->load(i, w.memory[kind].get(), w.multipliers);
                   }});
    out.push_back({name + ".impacts", "1", "impacts of " + name + " since the start",
                   [i, kind](const Workspace& w, const EnergyLedger&) {
                     const auto& memory = static_cast<const dynamics::ContactMemory&>(*w.memory[kind]);
                     return static_cast<double>(memory.contact[i].impacts);
                   }});
  }
}

/// Along the axis on the second of the joint as the scene writes it: what its friction does to it.
void add_friction(const Prepared& p, const dynamics::Model& model, std::vector<Probe>& out) {
  const std::size_t kind = index_of(model, [](const dynamics::ForceKind& k) { return k.friction() != nullptr; });
  for (std::size_t i = 0; i < p.friction.size(); ++i) {
    const std::string& name = p.friction[i].name;
    const auto joint = std::find_if(p.joints.begin(), p.joints.end(), [&](const auto& j) { return j.name == name; });
    const double sign = p.joint_sign[static_cast<std::size_t>(joint - p.joints.begin())];
    const char* what = p.friction[i].hold ? "latch" : "friction";
    out.push_back({fmt::format("{}.{}", name, what), p.friction[i].travel.turns() ? "N m" : "N",
                   fmt::format("load of the {} of {} on its second body along the axis", what, name),
                   [&model, i, kind, sign](const Workspace& w, const EnergyLedger&) {
                     return sign * model.forces()[kind]->friction()->load(i, w.state, w.memory[kind].get(),
                                                                          w.multipliers, model.joints().count());
                   }});
  }
}

/// What works on the travel of a joint: its force (or moment) against the travel, and the power that it takes.
void add_ptos(const scene::Scene& scene, const Prepared& p, std::vector<Probe>& out) {
  std::size_t next = 0;
  for (const auto& joint : scene.joints) {
    if (!joint.pto || !joint.pto->has_force()) continue;
    const dynamics::Pto pto = p.ptos[next++];
    const bool turns = joint.kind == scene::JointKind::hinge;
    out.push_back(
        {joint.name + (turns ? ".pto_moment" : ".pto_force"), turns ? "N m" : "N",
         fmt::format("{} of the power take-off against the travel of {}", turns ? "moment" : "force", joint.name),
         [pto](const Workspace& w, const EnergyLedger&) { return dynamics::pto_state(pto, w.state).force; }});
    out.push_back({joint.name + ".pto_power", "W",
                   fmt::format("power that the power take-off takes from {}, springs included", joint.name),
                   [pto](const Workspace& w, const EnergyLedger&) {
                     const auto s = dynamics::pto_state(pto, w.state);
                     return s.force * s.rate;
                   }});
  }
}

void add_joint_loads(const Prepared& p, const dynamics::Model& model, std::vector<Probe>& out) {
  for_each_end(p, [&](int joint, dynamics::End end, const std::string& name) {
    for (int i = 0; i < 6; ++i)
      out.push_back({fmt::format("{}.{}", name, joint_load(i)), load_unit(i),
                     fmt::format("load of the joint on {}, about the joint, body axes", name),
                     [&model, joint, end, i](const Workspace& w, const EnergyLedger&) {
                       return model.joints().load_on(joint, end, w.state, w.multipliers)[i];
                     }});
  });
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

/// The sums by which Van Zanten (2020), table 4.1, judges a structure that yields: what swings, what it has lost for
/// good, and both.
void add_sums_of_energy(std::vector<Probe>& out) {
  out.push_back({"energy.stored", "J", "potential energy of all effects",
                 [](const Workspace&, const EnergyLedger& l) { return stored(l); }});
  out.push_back({"energy.elastic", "J", "kinetic and potential energy: what motion can give back",
                 [](const Workspace&, const EnergyLedger& l) { return l.kinetic() + stored(l); }});
  out.push_back({"energy.dissipated", "J", "lost in the slip of friction and contacts, and in impacts",
                 [](const Workspace&, const EnergyLedger& l) { return lost_in_slip(l); }});
  out.push_back({"energy.absorbed", "J", "kinetic and potential energy and what slip has lost",
                 [](const Workspace&, const EnergyLedger& l) { return l.kinetic() + stored(l) + lost_in_slip(l); }});
}

void add_energies(const TimeModel& m, std::vector<Probe>& out) {
  out.push_back({"energy.kinetic", "J", "kinetic energy of bodies and added mass",
                 [](const Workspace&, const EnergyLedger& l) { return l.kinetic(); }});
  const std::vector<std::string> effects = dynamics::EnergyLedger::effects(m.model);
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const std::string& effect = effects[k];
    const auto add = [&](const char* what, double EnergyLedger::Entry::*member) {
      out.push_back({fmt::format("energy.{}.{}", effect, what), "J", fmt::format("energy {} by {}", what, effect),
                     [k, member](const Workspace&, const EnergyLedger& l) { return l.entries()[k].*member; }});
    };
    add("stored", &EnergyLedger::Entry::stored);
    add("supplied", &EnergyLedger::Entry::supplied);
    add("dissipated", &EnergyLedger::Entry::dissipated);
  }
  add_sums_of_energy(out);
  out.push_back({"energy.residual", "J", "energy that does not add up",
                 [](const Workspace&, const EnergyLedger& l) { return l.residual(); }});
}

/// The undisturbed water at the origin and at the scene's [[probe]]s, with the ramp of the loads.
void add_water(const scene::Scene& scene, const std::shared_ptr<const hydro::waves::WaveField>& field,
               std::vector<Probe>& out) {
  out.push_back({"wave.elevation", "m", "elevation of the undisturbed wave at the origin, with the ramp",
                 [field](const Workspace& w, const EnergyLedger&) { return field->elevation(w.state.time, 0, 0); }});
  for (const auto& p : scene.probes)
    for (const ProbeSignal& s : probe_signals(p))
      out.push_back(
          {s.name, s.unit, s.long_name, [field, at = p.at, take = s.take](const Workspace& w, const EnergyLedger&) {
             return take(field->at(w.state.time, at));
           }});
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

std::vector<Probe> run_probes(const scene::Scene& scene, const Prepared& prepared, const TimeModel& model) {
  std::vector<Probe> out;
  add_motions(scene, prepared, out);
  add_connectors(prepared, out);
  add_switched(prepared, model.model, out);
  add_moorings(scene, prepared, out);
  add_lines(scene, prepared, out);
  add_travels(prepared, model.model, out);
  add_friction(prepared, model.model, out);
  add_contacts(prepared, model.model, out);
  add_ptos(scene, prepared, out);
  add_joint_loads(prepared, model.model, out);
  if (scene.waves) add_water(scene, model.water.field, out);
  if (!prepared.bodies.empty()) add_energies(model, out);
  return out;
}

}  // namespace froude::compile
