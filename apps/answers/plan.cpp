#include "answers/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/control.hpp"
#include "compile/cylinders.hpp"
#include "compile/hulls.hpp"
#include "compile/hydrodynamics.hpp"
#include "compile/integrator.hpp"
#include "compile/members.hpp"
#include "compile/sections.hpp"
#include "compile/waves.hpp"
#include "hydro/base/machine.hpp"

namespace froude {
namespace {

using Section = Plan::Section;

/// What the scene does not name, and therefore is neither allocated nor stepped.
void add_absent(const scene::Scene& scene, const compile::Prepared& p, std::vector<PlanLine>& lines) {
  const auto absent = [&](bool present, const std::string& effect, const std::string& key) {
    if (!present) lines.push_back({effect, "not named in the scene (" + key + ")", "", false});
  };
  bool radiation = false, excitation = false;
  for (const auto& g : p.groups) {
    radiation = radiation || g.radiation;
    excitation = excitation || g.excitation;
  }
  absent(scene.waves.has_value(), "waves", "[waves]");
  absent(!p.with_gravity.empty(), "weight", "weight = true; linear hydrostatics hold it already");
  absent(!p.buoyancy.empty(), "buoyancy", "[body.buoyancy]");
  absent(!p.hydrostatics.empty(), "hydrostatics", "hydrostatics = true");
  absent(!p.moorings.empty() || !p.catenaries.empty(), "mooring", "[[mooring]]");
  absent(!p.axial.empty() || !p.bushing.empty() || !p.switched.empty(), "connector", "[[connector]]");
  absent(!p.contacts.empty(), "contact", "[[contact]]");
  absent(!p.joints.empty(), "joint", "[[joint]]");
  absent(!p.friction.empty(), "friction", "friction = { … } of a [[joint]]");
  absent(!p.ptos.empty(), "pto", "[joint.pto]");
  for (const auto& table : scene::element_tables())
    absent(
        std::any_of(p.elements.begin(), p.elements.end(), [&](const auto& e) { return e->table() == table->name(); }),
        table->name(), fmt::format("[[{}]]", table->name()));
  absent(radiation, "radiation", "radiation = {}");
  absent(excitation, "excitation", "excitation = true");
  const auto named = [&](auto key) {
    return std::any_of(scene.members.begin(), scene.members.end(), [&](const auto& m) { return (m.*key).has_value(); });
  };
  absent(named(&scene::Member::cd), "drag", "[member.drag]");
  absent(named(&scene::Member::morison), "morison", "[member.morison]");
  absent(named(&scene::Member::slamming), "slamming", "[member.slamming]");
  absent(named(&scene::Member::ends), "ends", "[member.ends]");
}

/// Whose waves reach whom, of several bodies that make waves.
Section plan_sharing(const scene::Scene& scene, const compile::Prepared& p) {
  Section s{"waves that bodies make:", {}};
  std::vector<int> alone;
  for (const auto& set : p.sharing_waves)
    if (set.size() > 1)
      s.lines.push_back({"shared", compile::listed_bodies(scene, set) + " feel each other's", "", true});
    else
      alone.push_back(set.front());
  if (!alone.empty())
    s.lines.push_back({"by itself", compile::listed_bodies(scene, alone) + ": no other's waves reach it", "", true});
  return s;
}

Section plan_rao(const scene::Scene& scene, const compile::Prepared& p, std::vector<std::string>& notes) {
  compile::check_waves_of_rao(scene, p, notes);
  const std::size_t headings = scene.rao->headings.size();
  Section s{fmt::format("rao: {} frequencies{}, {} unknowns, complex dense solves", scene.rao->omega.size(),
                        headings == 1 ? "" : fmt::format(", {} headings", headings), 6 * p.bodies.size()),
            {}};
  if (headings > 1)
    s.lines.push_back({"headings",
                       scene.rao->drag ? "each by itself, with factors of its own: linear drag depends on it"
                                       : "one factorisation at each frequency serves all",
                       "", true});
  for (const auto& g : p.groups) {
    const auto error = g.table.interpolation_error();
    s.lines.push_back(
        {"coefficients", "cubic between the frequencies of the data",
         fmt::format("{} bodies, {} frequencies; error of interpolation: A {:.1g}, B {:.1g}, X {:.1g}", g.bodies.size(),
                     g.table.coefficients().omega.size(), error.added_mass, error.damping, error.excitation),
         true});
  }
  const auto one = [&](auto has) { return std::any_of(scene.members.begin(), scene.members.end(), has); };
  if (compile::any_drag(scene))
    s.lines.push_back({"drag",
                       scene.rao->drag ? "equivalent linearisation, settled at each frequency"
                                       : "quadratic: no place in a response per metre of wave",
                       "", scene.rao->drag.has_value()});
  if (one([](const auto& m) { return m.morison.has_value(); }))
    s.lines.push_back({"members", "Morison's inertia, linear on what is wet at rest", "", true});
  if (one([](const auto& m) { return m.ends.has_value(); }))
    s.lines.push_back({"ends", "of members: pressure of the waves and added mass", "", true});
  if (one([](const auto& m) { return m.slamming.has_value(); }))
    s.lines.push_back({"impact", "in runs only", "", false});
  return s;
}

Section plan_modes(const compile::Prepared& p) {
  std::size_t frequencies = 1;
  for (const auto& g : p.groups)
    if (g.radiation) frequencies += g.table.coefficients().omega.size();
  return {fmt::format("modes: {} unknowns, symmetric eigenvalues at {} frequencies, then each root by itself",
                      6 * p.bodies.size(), frequencies),
          {}};
}

Section plan_field(const scene::Scene& scene) {
  const scene::AskField& asked = *scene.field;
  const std::size_t cylinders = compile::bodies_of_cylinders(scene).size(),
                    meshes = compile::bodies_of_meshes(scene).size();
  const std::string bodies = fmt::format("{} bod{}", cylinders + meshes, cylinders + meshes == 1 ? "y" : "ies");
  return {
      fmt::format("free surface: {} x {} points, a wave of {:.4g} s", asked.x.size(), asked.y.size(),
                  2 * std::numbers::pi / asked.omega),
      {{"scattered waves", meshes > 0 ? "panels, and again with each cut in four" : "partial waves of each cylinder",
        bodies, true},
       {"radiated waves", asked.held ? "not named in the scene (bodies are held)" : "of the motion that responses have",
        asked.held ? "" : bodies, !asked.held}}};
}

std::string integrator_text(const scene::Solve& solve) {
  if (solve.integrator == "explicit_pair")
    return fmt::format("explicit pair of orders 5 and 4, tolerance {:.3g}",
                       solve.tolerance.value_or(compile::tolerance_of_pair));
  if (solve.integrator == "sundials_bdf")
    return fmt::format("backward differences of CVODE, tolerance {:.3g}",
                       solve.tolerance.value_or(compile::tolerance_of_pair));
  const std::string name = solve.integrator == "generalized_alpha"
                               ? fmt::format("generalised-alpha rho_infinity {:.3g}", solve.rho_infinity)
                               : solve.integrator;
  return solve.tolerance ? fmt::format("{} with steps cut to a tolerance of {:.3g}", name, *solve.tolerance) : name;
}

Section plan_steady(const scene::Scene& scene, const compile::Prepared& p, std::vector<std::string>& notes) {
  const auto sea = compile::sea_of_run(scene, p, notes);
  return {
      fmt::format("run: answered without stepping, {} unknowns", 6 * p.bodies.size()),
      {{"waves", "transfer functions of all signals × the sea, by Fourier transform where it repeats",
        fmt::format("{} components, {:.2g} of the energy left out", sea.components().size(), sea.fraction_left_out()),
        true},
       {"stepping", "the scene is linear and asks for steady motions", "", false}}};
}

Section plan_run(const scene::Scene& scene, const compile::Prepared& p, std::vector<std::string>& notes) {
  if (scene.run->steady) return plan_steady(scene, p, notes);
  compile::TimeModel m = compile::time_model(scene, p);
  notes.insert(notes.end(), m.notes.begin() + std::ssize(p.notes), m.notes.end());  // those of `p` it begins with
  const bool sparse = dynamics::BlockSolver(m.model.pattern()).is_sparse();
  const std::string title = fmt::format("run: {} steps of {:.4g} s", m.steps, m.step);
  compile::make_integrator(scene, m.model);                       // tells now what it could not step,
  compile::Controllers(m.rules, compile::signal_list(scene, m));  // and what it could not watch
  Section s{p.bodies.empty() ? title
                             : fmt::format("{}, {} unknowns, {}, {} factors", title, m.model.modes(),
                                           integrator_text(scene.solve), sparse ? "sparse" : "dense"),
            std::move(m.plan)};
  return s;
}

Section plan_waves(const scene::Scene& scene) {
  const auto& ask = *scene.ask_waves;
  Section s{fmt::format("waves: {:.6g} s every {:.4g} s", ask.duration, ask.every), {}};
  if (is_synthesised(scene)) {
    const auto sea = compile::free_waves(scene);
    s.lines.push_back(
        {"waves",
         std::isinf(sea.repetition_s())
             ? "components that never repeat"
             : fmt::format("components on a grid, repeating after {:.6g} s", sea.repetition_s()),
         fmt::format("{} components, {:.2g} of the energy left out", sea.components().size(), sea.fraction_left_out()),
         true});
  }
  s.lines.push_back({"probe", is_synthesised(scene) ? "whole series at once" : "the field at each instant",
                     fmt::format("{} point{}", scene.probes.size(), scene.probes.size() == 1 ? "" : "s"), true});
  const bool bound = compile::has_bound_waves(*scene.waves);
  s.lines.push_back({"second order",
                     bound ? "sums and differences of all pairs" : "not named in the scene (second_order = true)", "",
                     bound});
  s.lines.push_back({"current",
                     scene.current_place ? "waves on it, Doppler's relation" : "not named in the scene ([current])", "",
                     scene.current_place.has_value()});
  return s;
}

/// Coefficients that the scene has the program compute, before any is. \return how long that takes, s
double plan_coefficients(const scene::Scene& scene, std::vector<Section>& sections) {
  double seconds = 0;
  const auto add = [&](const std::string& of, const auto& plan, double takes) {
    sections.push_back({fmt::format("coefficients of {}, computed when a run starts:", of),
                        {{"potential", plan.method(), plan.size(), true}}});
    seconds += takes;
  };
  if (const auto bodies = compile::bodies_of_cylinders(scene); !bodies.empty()) {
    const compile::CylinderPlan plan = compile::plan_cylinders(scene, bodies);
    add("cylinders", plan, plan.seconds());
  }
  if (const auto bodies = compile::bodies_of_meshes(scene); !bodies.empty()) {
    const compile::HullPlan plan = compile::plan_hulls(scene, bodies);
    add("meshes", plan, plan.seconds());
  }
  return seconds;
}

}  // namespace

Plan plan(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept) {
  Plan out;
  if (scene.run && !scene.run->steady) compile::require_no_sections(scene);
  constexpr double patience_s = 60;
  if (plan_coefficients(scene, out.sections) > patience_s) {
    out.notes = {
        "the rest of the plan depends on these coefficients, which take longer than a plan should: compute "
        "them with `froude bem solve`, name the file in the scene, and plan again"};
    return out;
  }
  const compile::Prepared prepared = compile::prepare(scene, kept);
  if (prepared.sharing_waves.size() > 1 || (!prepared.sharing_waves.empty() && prepared.sharing_waves[0].size() > 1))
    out.sections.push_back(plan_sharing(scene, prepared));
  out.notes = prepared.notes;
  if (scene.rao || scene.ask_modes || scene.field) compile::require_still_water(scene, "small motions");
  if (scene.rao) out.sections.push_back(plan_rao(scene, prepared, out.notes));
  if (scene.ask_modes) out.sections.push_back(plan_modes(prepared));
  if (scene.field) out.sections.push_back(plan_field(scene));
  if (scene.run) out.sections.push_back(plan_run(scene, prepared, out.notes));
  if (scene.ask_waves) out.sections.push_back(plan_waves(scene));
  out.sections.push_back({"this machine:", {{"inner loops", hydro::instructions_of_loops(), {}}}});
  if (scene.bodies.empty()) return out;
  Section left_out{"left out, at no cost:", {}};
  add_absent(scene, prepared, left_out.lines);
  if (!left_out.lines.empty()) out.sections.push_back(std::move(left_out));
  return out;
}

}  // namespace froude
