#include "compile/compile.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "compile/buoyancy.hpp"
#include "compile/connections.hpp"
#include "compile/excitation.hpp"
#include "compile/hydrodynamics.hpp"
#include "compile/kept.hpp"
#include "compile/members.hpp"
#include "compile/radiation.hpp"
#include "compile/second_order.hpp"
#include "compile/sections.hpp"
#include "compile/signals.hpp"
#include "compile/step.hpp"
#include "compile/waves.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/ramped_field.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "dynamics/model/equilibrium.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;
using scene::Scene;

dynamics::RigidBody rigid_body(const scene::Body& b) {
  return scene::placed(b.place, [&] {
    return dynamics::RigidBody({.name = b.name,
                                .mass = b.mass,
                                .inertia = b.inertia,
                                .rest_position = {b.position},
                                .centre_of_gravity = {b.centre_of_gravity},
                                .free = b.free});
  });
}

}  // namespace

void add_springs(const Prepared& p, std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces) {
  if (!p.with_gravity.empty())
    forces.push_back(std::make_unique<dynamics::GravityKind>(p.bodies, p.water.gravity, p.with_gravity));
  if (!p.buoyancy.empty()) forces.push_back(std::make_unique<dynamics::BuoyancyKind>(p.bodies, p.buoyancy, p.water));
  if (!p.hydrostatics.empty()) forces.push_back(std::make_unique<dynamics::HydrostaticsKind>(p.bodies, p.hydrostatics));
  if (!p.moorings.empty()) forces.push_back(std::make_unique<dynamics::RestoringKind>("mooring", p.bodies, p.moorings));
  if (!p.catenaries.empty()) forces.push_back(std::make_unique<dynamics::CatenaryMooringKind>(p.catenaries));
  if (!p.axial.empty()) forces.push_back(std::make_unique<dynamics::AxialConnectorKind>(p.axial));
  if (!p.switched.empty()) {
    std::vector<dynamics::SwitchedConnectors> groups;
    for (const RuledConnectors& group : p.switched) groups.push_back(group.connectors);
    forces.push_back(std::make_unique<dynamics::SwitchedConnectorKind>(std::move(groups)));
  }
  if (!p.bushing.empty()) forces.push_back(std::make_unique<dynamics::BushingConnectorKind>(p.bushing));
  if (!p.ptos.empty()) forces.push_back(std::make_unique<dynamics::PtoKind>(p.ptos));
  for (const auto& elements : p.elements) forces.push_back(elements->force({p.bodies, p.water, p.joints}));
}

Prepared prepare(const Scene& scene, std::shared_ptr<Kept> kept) {
  Prepared out;
  out.kept = kept ? std::move(kept) : std::make_shared<Kept>();
  for (const auto& b : scene.bodies) {
    if (b.weight) out.with_gravity.push_back(static_cast<int>(out.bodies.size()));
    out.bodies.push_back(rigid_body(b));
  }
  out.water = scene.water;
  check_ends(scene);
  add_buoyancy(scene, out);
  add_hydrodynamics(scene, out);
  add_sections(scene, out);
  add_connections(scene, out);
  out.elements = scene.elements;
  add_fastened_lines(scene, out);
  if (scene.waves || scene.rao)
    for (std::string& note : ends_without_pressure(scene)) out.notes.push_back(std::move(note));
  return out;
}

namespace {

/// Pretension that does not cancel, or weight that does not float, would shift the rest position about which everything
/// is linearised.
void require_rest(const Prepared& prepared, const dynamics::Model& model) {
  const Eigen::VectorXd load = model.linear_at_rest().unbalanced;
  double weight = 0;
  for (const auto& b : prepared.bodies) weight += b.mass() * prepared.water.gravity;
  // Masses are given to some four digits and meshes hold 32-bit numbers: a hull that sinks by 1e-4 of its draught is at
  // rest. Springs alone can be placed without error.
  const bool floats = !prepared.buoyancy.empty() || !prepared.hydrostatics.empty();
  const double limit = (floats ? 1e-4 : 1e-6) * weight;
  Eigen::Index worst = 0;
  if (load.size() == 0 || load.cwiseAbs().maxCoeff(&worst) <= limit) return;
  const auto why = out_of_balance(prepared);
  throw InputError(
      fmt::format(
          "the scene is not in equilibrium as placed: {} feels {:.4g} {}, more than {:g} of the weight, {:.4g} N{}{}",
          model.mode_name(static_cast<int>(worst)), load[worst], worst % 6 < 3 ? "N" : "N m", floats ? 1e-4 : 1e-6,
          limit, why.empty() ? "" : "; ", fmt::join(why, "; ")),
      {},
      why.empty() ? "give connectors rest_length = \"as placed\", place the bodies where they balance, or ask about = "
                    "\"equilibrium\""
                  : "change mass, centre_of_gravity or position until the body floats as placed: `froude "
                    "hydrostatics --mass` tells where it does");
}

}  // namespace

dynamics::Model frequency_model(const Prepared& prepared, const scene::About& about) {
  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  add_springs(prepared, forces);
  if (!prepared.fastened.empty()) forces.push_back(std::make_unique<dynamics::FastenedLineKind>(prepared.fastened));
  dynamics::Model model(prepared.bodies, {}, std::move(forces), prepared.joints);
  if (!about.equilibrium) require_rest(prepared, model);
  return model;
}

namespace {

/// "m1.heave −0.12 m, m1.pitch 0.02 rad": the largest ways from where bodies are placed, metres and radians alike.
std::string farthest(const dynamics::Model& model, const dynamics::State& state) {
  constexpr std::size_t most = 6;
  std::vector<std::pair<double, int>> ways;
  for (int m = 0; m < model.modes(); ++m) {
    const auto body = static_cast<std::size_t>(m / 6);
    if (model.is_free(m))
      ways.emplace_back(dynamics::motion_from_rest(model.bodies()[body], state.pose[body], m % 6), m);
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  std::string out;
  for (std::size_t i = 0; i < std::min(most, ways.size()) && std::abs(ways[i].first) > 1e-6; ++i)
    out += fmt::format("{}{} {:.4g} {}", out.empty() ? "" : ", ", model.mode_name(ways[i].second), ways[i].first,
                       ways[i].second % 6 < 3 ? "m" : "rad");
  return out.empty() ? "where the bodies are placed" : out;
}

}  // namespace

void require_still_water(const Scene& scene, std::string_view what) {
  const bool reached = !scene.members.empty() || std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                                             [](const auto& b) { return b.hydrodynamics.has_value(); });
  if (scene.current_place && reached)
    throw InputError(fmt::format("{} have no part for a current, which changes the waves that bodies meet and pushes "
                                 "members along",
                                 what),
                     *scene.current_place, "take [current] out, or step a run of members, which have it");
}

namespace {

/// Where bodies float so much deeper or higher than the water line of their matrix that its roll or pitch is off by
/// more than the accuracy asked: with upright sides both have C₃₃ s (r + s/2) more, s deeper with the centre of gravity
/// r below the water line at rest (D156).
void note_other_waterlines(const dynamics::Model& model, const dynamics::State& still, double accuracy,
                           std::vector<std::string>& notes) {
  for (const auto& kind : model.forces()) {
    const auto* hydrostatics = dynamic_cast<const dynamics::HydrostaticsKind*>(kind.get());
    if (!hydrostatics) continue;
    for (const dynamics::Hydrostatics& e : hydrostatics->all()) {
      const dynamics::RigidBody& body = model.bodies()[static_cast<std::size_t>(e.body)];
      const double r = -body.rest_centre().z(), s = -r - still.pose[static_cast<std::size_t>(e.body)].centre.z(),
                   more = e.stiffness(0, 0) * s * (r + s / 2), least = e.stiffness.diagonal().tail<2>().minCoeff();
      if (least <= 0 || std::abs(more) <= accuracy * least) continue;
      notes.push_back(
          fmt::format("{} balances {:.3g} m {} the water line that its restoring matrix is for; with upright sides its "
                      "stiffness in roll or pitch is {:.2g} % {} there: [body.buoyancy] takes the hull as it floats",
                      body.name(), std::abs(s), s > 0 ? "below" : "above", 100 * std::abs(more) / least,
                      more > 0 ? "more" : "less"));
    }
  }
}

}  // namespace

void require_stable(const dynamics::frequency::SmallMotions& about, const scene::Place& place, const char* remedy) {
  const auto toppling = dynamics::frequency::toppling_motions(about);
  if (toppling.empty()) return;
  std::vector<std::string> moves;
  for (int m = 0; m < about.model.modes(); ++m)
    if (std::abs(toppling.front()[m]) > 0.1 && moves.size() < 3) moves.push_back(about.model.mode_name(m));
  throw InputError(
      fmt::format("rest is no stable equilibrium: a motion of {} has negative stiffness, so that bodies which come off "
                  "it do not come back",
                  fmt::join(moves, ", ")),
      place, remedy);
}

dynamics::frequency::SmallMotions small_motions(const Scene& scene, const dynamics::Model& model,
                                                const scene::About& about, std::vector<std::string>& notes) {
  require_still_water(scene, "small motions");
  auto inertia = inertia_of_responses(scene, model.bodies());
  if (!about.equilibrium) return {model, dynamics::rest_state(model.bodies()), std::move(inertia)};
  return scene::placed(about.place, [&] {
    dynamics::State still = dynamics::equilibrium(model, dynamics::rest_state(model.bodies()));
    notes.push_back(fmt::format("small motions are about the equilibrium, {}; coefficients stay those as placed",
                                farthest(model, still)));
    note_other_waterlines(model, still, scene.accuracy, notes);
    return dynamics::frequency::SmallMotions(model, std::move(still), std::move(inertia));
  });
}

namespace {

/// The band where every group that feels the waves has coefficients; none if no group does.
std::optional<Band> band_of_data(const Prepared& prepared) {
  std::optional<Band> band;
  for (const auto& g : prepared.groups) {
    if (!g.excitation) continue;
    if (!band) band = Band{g.table.lowest(), g.table.highest()};
    band = Band{std::max(band->low, g.table.lowest()), std::min(band->high, g.table.highest())};
  }
  return band;
}

/// Beyond its record nobody knows the waves, and its components would repeat.
void require_recorded(const Scene& scene) {
  const auto* list = std::get_if<scene::WaveList>(&scene.waves->kind);
  if (list == nullptr || !list->recorded) return;
  const auto& [begin, end, left_out] = *list->recorded;
  if (begin > 1e-9 || scene.run->duration > end + 1e-9)
    throw InputError(
        fmt::format("the waves were recorded from {:.6g} s to {:.6g} s, and the run goes from 0 s to {:.6g} s", begin,
                    end, scene.run->duration),
        scene.waves->place, "ask for a shorter run, or give a record whose time covers it");
}

/// The sea of a run, where a load that is linear in the waves, or the same sea for all that move in it, needs one.
hydro::waves::Sea run_sea(const Scene& scene, const std::optional<Band>& band) {
  const scene::Waves& waves = *scene.waves;
  if (band && scene.current_place)
    throw InputError("the wave loads come from coefficients for water without a current", *scene.current_place,
                     "take [current] out, or the bodies' excitation");
  hydro::waves::Sea sea = make_sea(scene, band);
  require_recorded(scene);
  if (sea.components().size() > 1 && sea.repetition_s() < scene.run->duration * (1 - 1e-9))
    throw InputError(fmt::format("the sea repeats after {:.6g} s, before the run of {:.6g} s ends", sea.repetition_s(),
                                 scene.run->duration),
                     waves.place,
                     fmt::format("add components = {{ repetition = \"{:.6g} s\" }} to [waves]", scene.run->duration));
  return sea;
}

std::optional<double> lowest_of(const hydro::waves::Sea& sea) {
  std::optional<double> out;
  for (const auto& c : sea.components()) out = std::min(c.omega, out.value_or(c.omega));
  return out;
}

/// Waves of any kind: as a sum of linear waves where they are one, and as a field. Loads by coefficients and drag at
/// rest are linear in the waves or in their velocities, and take such a sum only.
RunWater run_water(const Scene& scene, const Prepared& prepared, double step) {
  const auto band = band_of_data(prepared);
  const bool needs_sum = band || any_drag_at_rest(scene);
  RunWater out;
  std::shared_ptr<const hydro::waves::WaveField> field, of_lines;
  if (scene.waves && (needs_sum || is_linear_sum(*scene.waves))) {
    out.sea = run_sea(scene, band);
    const auto waves = hydro::waves::linear_field(*out.sea, {.stretching = scene.waves->stretching});
    if (const auto use = water_of_members(scene, out.sea->hs(), step)) {
      field = out.around_members = prepared.kept->water_of_members().of(waves, *use);
    } else {
      field = std::make_shared<hydro::waves::SummedField>(waves);
    }
    if (const auto use = water_of_lines(scene, prepared, *out.sea, step))
      of_lines = out.around_lines = prepared.kept->water_of_lines().of(waves, *use);
  } else if (scene.waves) {
    field = make_field(scene);
  } else {
    field = std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, scene.water,
                                                          hydro::waves::HarmonicField::Options{}, scene.current);
  }
  const double ramp = scene.waves ? scene.waves->ramp : 0;
  out.field = std::make_shared<dynamics::RampedField>(std::move(field), ramp, scene.current);
  out.of_lines =
      of_lines ? std::make_shared<dynamics::RampedField>(std::move(of_lines), ramp, scene.current) : out.field;
  return out;
}

/// How waves are found around what moves in them.
std::string method_of(const hydro::waves::BoxedField& field, const char* what, double duration) {
  if (field.tables() == 0) return fmt::format("; around {} summed", what);
  const double megabytes = static_cast<double>(field.bytes_of_table()) / 1e6;
  if (field.tables() == 1) return fmt::format("; around {} from a table of {:.3g} MB", what, megabytes);
  return fmt::format("; around {} from tables of {:.3g} MB, one for each {:.3g} s, three at a time", what, megabytes,
                     duration / field.tables());
}

PlanLine waves_line(const RunWater& water, double duration) {
  const auto& sea = water.sea;
  if (!sea) return {"waves", "nonlinear or made by a paddle: a field, asked where members are", "", true};
  std::string method = fmt::format("components on a grid, repeating after {:.6g} s", sea->repetition_s());
  if (std::isinf(sea->repetition_s())) method = "components that never repeat";
  if (sea->components().size() == 1) method = "one regular wave";
  if (water.around_members) method += method_of(*water.around_members, "members", duration);
  if (water.around_lines) method += method_of(*water.around_lines, "lines", duration);
  return {
      "waves", std::move(method),
      fmt::format("{} components, {:.2g} of the energy left out", sea->components().size(), sea->fraction_left_out()),
      true};
}

/// Where they balance without waves, with the velocities that the scene gives them there.
dynamics::State in_equilibrium(const Scene& scene, const dynamics::Model& model, dynamics::State start) {
  require_still_water(scene, "starts in equilibrium");
  dynamics::State out = scene::placed(scene.run->place, [&] { return dynamics::equilibrium_before_run(model, start); });
  dynamics::frequency::SmallMotions about(model, out);
  about.linear = model.linear_before_runs(out);
  require_stable(about, scene.run->place,
                 "give bodies `initial` places nearer to the equilibrium that you mean, or begin with start = \"as "
                 "placed\"");
  out.velocity = start.velocity;
  return out;
}

/// The lines of a plan for kinds of force that one line would not tell.
using ToldInParts = std::map<const dynamics::ForceKind*, std::vector<PlanLine>>;

void plan_forces(const std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces,
                 const ToldInParts& told_in_parts, std::vector<PlanLine>& plan) {
  for (const auto& kind : forces) {
    if (const auto parts = told_in_parts.find(kind.get()); parts != told_in_parts.end())
      plan.insert(plan.end(), parts->second.begin(), parts->second.end());
    else
      plan.push_back({kind->effect(), kind->method(),
                      fmt::format("{} element{}", kind->elements(), kind->elements() == 1 ? "" : "s"), true});
  }
}

}  // namespace

hydro::waves::Sea sea_of_run(const Scene& scene, const Prepared& prepared, std::vector<std::string>& notes) {
  if (!is_linear_sum(*scene.waves))
    throw InputError("a linear answer needs waves that are a sum of linear ones", scene.waves->place,
                     "take theory = \"linear\", or leave `second_order` out");
  hydro::waves::Sea sea = run_sea(scene, band_of_data(prepared));
  note_other_depths(scene, prepared, used_by_run(scene, prepared, lowest_of(sea)), notes);
  return sea;
}

TimeModel time_model(const Scene& scene, const Prepared& prepared, const std::vector<LoadRecord>& put_back,
                     bool memory_apart) {
  require_no_sections(scene);
  const ChosenStep chosen = choose_step(scene, prepared);
  const double step = chosen.value;
  const auto per_sample = static_cast<std::size_t>(std::llround(scene.run->every / step));
  const auto steps = static_cast<std::size_t>(std::llround(scene.run->duration / scene.run->every)) * per_sample;
  std::vector<std::string> notes = prepared.notes;
  if (!chosen.note.empty()) notes.push_back(chosen.note);
  std::vector<PlanLine> plan{chosen.plan};
  RunWater water = run_water(scene, prepared, step);
  if (scene.waves) {
    for (const auto& warning : wave_warnings(scene)) notes.push_back(warning);
    plan.push_back(waves_line(water, scene.run->duration));
  }
  if (scene.solve.integrator == "generalized_alpha" && scene.solve.rho_infinity > 0 && scene::acts_one_way(scene))
    notes.push_back(fmt::format(
        "rho_infinity = {:.3g} with what acts one way only (cables, tables, stops, lines that go slack): a snap that "
        "the step does not resolve comes back with more energy than it had; 0 keeps it",
        scene.solve.rho_infinity));
  const hydro::waves::Sea* sea = water.sea ? &*water.sea : nullptr;
  note_other_depths(scene, prepared, used_by_run(scene, prepared, sea ? lowest_of(*sea) : std::nullopt), notes);

  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  std::vector<dynamics::AddedMass> added_mass;
  add_springs(prepared, forces);
  ToldInParts told_in_parts;
  if (auto kind = fastened_kind(scene, prepared, water)) {
    told_in_parts[kind.get()] = {};  // each line is told by itself, below
    forces.push_back(std::move(kind));
  }
  std::vector<dynamics::RadiationMemory> memories;
  std::vector<MemoryInRun> in_run;
  std::vector<PlanLine> memory_lines;
  Radiation radiation(prepared, step, sea);
  for (std::size_t i = 0; i < prepared.groups.size(); ++i) {
    if (!prepared.groups[i].radiation) continue;
    auto parts = radiation.of(i, notes);
    added_mass.push_back(std::move(parts.added_mass));
    memories.push_back(std::move(parts.memory));
    in_run.push_back(std::move(parts.in_run));
    memory_lines.insert(memory_lines.end(), parts.lines.begin(), parts.lines.end());
  }
  if (!memories.empty() && !memory_apart) {
    forces.push_back(std::make_unique<dynamics::RadiationKind>(std::move(memories)));
    told_in_parts[forces.back().get()] = std::move(memory_lines);
  }
  if (sea) add_excitation(scene, prepared, *sea, {step, steps + 1}, forces);
  add_second_order(scene, prepared.bodies, sea, {step, steps + 1}, notes, forces);
  add_members(scene, prepared.bodies, water, {step, steps + 1}, forces);

  if (!prepared.friction.empty()) forces.push_back(std::make_unique<dynamics::FrictionKind>(prepared.friction));
  if (!prepared.contacts.empty()) forces.push_back(std::make_unique<dynamics::ContactKind>(prepared.contacts));

  if (!put_back.empty()) forces.push_back(std::make_unique<dynamics::RecordedLoadKind>(put_back));

  plan_forces(forces, told_in_parts, plan);
  dynamics::Model model(prepared.bodies, std::move(added_mass), std::move(forces), prepared.joints);
  if (!prepared.joints.empty())
    plan.push_back({"joint", "constraints held exactly, with the loads that this takes as unknowns",
                    fmt::format("{} joints, {} constraints", prepared.joints.size(), model.joints().count()), true});
  notes.insert(notes.end(), model.redundant().begin(), model.redundant().end());
  dynamics::State start = placed_state(scene, prepared, model, notes);
  if (scene.run->from_equilibrium) start = in_equilibrium(scene, model, std::move(start));
  std::vector<LineModel> lines = line_models(scene, prepared, water, start);
  for (const LineModel& line : lines) {
    plan.push_back(plan_line(line));
    for (const LineModel::Part& part : line.parts)
      for (const std::string* told : {&part.coefficients, &part.released})
        if (!told->empty()) notes.push_back(fmt::format("line {}: {}", part.name, *told));
  }
  std::vector<Rule> rules;
  for (const RuledConnectors& group : prepared.switched) rules.push_back(group.rule);
  return {.model = std::move(model),
          .start = std::move(start),
          .water = std::move(water),
          .lines = std::move(lines),
          .memories = std::move(in_run),
          .rules = std::move(rules),
          .step = step,
          .steps = steps,
          .steps_per_sample = per_sample,
          .plan = std::move(plan),
          .notes = std::move(notes)};
}

}  // namespace froude::compile
