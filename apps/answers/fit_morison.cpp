/// \file  Fits of kind "morison": drag and inertia of a cylinder in unsteady flow.
#include "answers/fit_morison.hpp"
#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_models.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using ::fit::Cylinder;
using ::fit::Experiment;
using ::fit::ForceLine;
using ::fit::MorisonOptions;
using ::fit::ProbeToBody;

const Words<Experiment> experiments{{"water moves", Experiment::water_moves},
                                    {"body moves", Experiment::body_moves},
                                    {"both move", Experiment::both_move}};

void check_mass(const Record& model, Cylinder& cylinder) {
  const bool known = model.has("mass_beyond_load_cells"), moves = cylinder.experiment != Experiment::water_moves;
  if (known && !moves)
    throw model.wrong("mass_beyond_load_cells", "does not act: the body does not move",
                      "leave it out, or set motion = \"body moves\"");
  if (!known && moves)
    throw model.refused(
        "needs \"mass_beyond_load_cells\" where the body moves: its inertia is part of the measured force",
        "add mass_beyond_load_cells = \"5.9 kg\", contained water included; \"0 kg\" if it is taken off already");
}

Binding<Cylinder> cylinder_in_flow() {
  return Binding<Cylinder>(cylinder_keys())
      .words(text("motion",
                  "\"water moves\": waves on a fixed body; \"body moves\": forced oscillation in still water; \"both "
                  "move\": a body that moves in waves"),
             experiments, &Cylinder::experiment)
      .optional(quantity("mass_beyond_load_cells", dim::mass,
                         "where the body moves: all that the load cells accelerate, contained water included")
                    .within(Limit::not_negative),
                &Cylinder::mass_beyond_load_cells)
      .then(check_mass);
}

Binding<ForceLine> force_line() {
  return Binding<ForceLine>("[[model.line]]",
                            "morison: a force of one frequency beside drag and inertia (lift, vortices, a vibration), "
                            "fitted with them so that it widens no interval")
      .optional(positive("frequency", dim::angular_velocity, "of the line"), in_hertz(&ForceLine::hz))
      .optional(number("multiple", "of the main frequency of the motion: 2 for lift").positive(), &ForceLine::multiple)
      .exactly_one_of({"frequency", "multiple"});
}

Binding<ProbeToBody> probe_to_body() {
  using P = ProbeToBody;
  return Binding<P>("[model.wave]",
                    "from the surface at a probe to the water at the body, by linear waves of one direction")
      .key(quantity("depth", dim::length, "of the tank").one_of({"infinite"}).positive(), &P::water,
           &hydro::Water::depth)
      .key(positive("level", dim::length, "of the body's axis below still water"),
           [](const Value& v, P& probe) { probe.level = -v.number; })
      .key(quantity("ahead", dim::length, "of the body in front of the probe, the way waves go")
               .or_default("0 m", "beside each other"),
           &P::ahead)
      .key(positive("gravity", dim::acceleration, "acceleration of free fall")
               .or_default("9.81 m/s^2", "what hydrodynamic data are mostly computed with"),
           &P::water, &hydro::Water::gravity)
      .key(effect("regular", "the surface is one sinusoid, fitted to the probe: noise averages out, no ends are lost"),
           &P::regular)
      .key(effect("follow",
                  "both move: the water is taken where the body is; its position counts along the waves from where "
                  "\"ahead\" puts it; needs the channel position"),
           &P::follow);
}

Binding<::fit::CylinderErrors> cylinder_errors_with_mass() {
  return Binding<::fit::CylinderErrors>(cylinder_errors())
      .optional(positive("mass", dim::mass, "of the mass beyond the load cells"), &::fit::CylinderErrors::mass);
}

/// What only moving water, or only a moving body, has.
void check_water_channels(const Record& channels, Experiment experiment) {
  using enum Experiment;
  if (experiment == body_moves)
    for (const char* role : {"cross_velocity", "elevation"})
      if (channels.has(role))
        throw channels.wrong(role, "has no part where the body moves in still water", "leave it out");
  for (const char* role : {"water_velocity", "water_acceleration"})
    if (channels.has(role) && experiment != both_move)
      throw channels.wrong(role, fmt::format("has no part with motion = \"{}\"", word_for(experiments, experiment)),
                           "leave it out, or set motion = \"both move\"");
  if (experiment == both_move && channels.has("elevation") == channels.has("water_velocity"))
    throw channels.refused("needs either water_velocity or elevation where both move",
                           "name the column of the water's motion; velocity and position are the body's");
}

/// Exactly one of the motion's channels, which others must not contradict.
void check_motion_channels(const Record& channels, Experiment experiment) {
  check_water_channels(channels, experiment);
  const auto refuse_beside_elevation = [&](std::initializer_list<const char*> others) {
    for (const char* other : others)
      if (channels.has(other)) throw channels.wrong(other, "does not act beside the elevation", "keep one of the two");
  };
  if (channels.has("elevation") && experiment != Experiment::both_move)
    return refuse_beside_elevation({"velocity", "position", "acceleration", "cross_velocity"});
  if (channels.has("elevation")) refuse_beside_elevation({"water_acceleration", "cross_velocity"});
  if (!channels.has("velocity") && !channels.has("position"))
    throw channels.refused("needs velocity or position for a fit of kind \"morison\": drag needs the velocity",
                           "add one of them; an acceleration alone does not give it, its integral drifts");
  if (channels.has("velocity") && channels.has("position"))
    throw channels.wrong("position", "does not act beside the velocity", "keep one of the two");
}

void finish_probe(const FitTables& t, MorisonModel& morison) {
  const Record &model = t.model(), &channels = t.channels();
  if (!morison.probe && channels.has("elevation"))
    throw model.refused("needs \"wave\" for the channel elevation",
                        "add wave = { depth = \"1.25 m\", level = \"0.48 m\" }");
  if (!morison.probe) return;
  const Record& wave = model.table("wave");
  ProbeToBody& probe = *morison.probe;
  probe.water.density = morison.cylinder.density;
  if (probe.follow && !(morison.cylinder.experiment == Experiment::both_move && channels.has("position")))
    throw wave.wrong("follow", "needs to know where the body is",
                     "set motion = \"both move\" with the channel position, or leave it out");
  if (!probe.water.depth.is_infinite() && -probe.level >= probe.water.depth.metres())
    throw wave.wrong("level", "lies below the bottom", "give the depth of the axis below still water");
  if (!channels.has("elevation"))
    throw model.wrong("wave", "does not act: there is no channel elevation", "leave it out");
}

void read_delay(const Record& prepare, MorisonModel& out) {
  if (!prepare.has("delay")) return;
  const bool estimate = prepare.text("delay") == "estimate";
  if (estimate && prepare.has("delay_error"))
    throw prepare.wrong("delay_error", "does not act where the delay is estimated: its error is then estimated too",
                        "leave it out");
  if (!estimate && prepare.has("longest_delay"))
    throw prepare.wrong("longest_delay", "does not act where the delay is given",
                        "leave it out, or set delay = \"estimate\"");
  if (!estimate) out.prepare.delay_s = prepare.si("delay");
  if (prepare.has("delay_error")) out.force.delay_error_s = prepare.si("delay_error");
  if (!estimate) return;
  if (!prepare.has("longest_delay"))
    throw prepare.wrong(
        "delay", "needs \"longest_delay\"",
        "add longest_delay = \"1 s\": less than half the main period, which would be the force turned round");
  out.longest_delay = prepare.si("longest_delay");
}

/// What is made of cycles needs them.
void check_cycles(const FitTables& t, const MorisonModel& morison) {
  const bool cut = morison.prepare.window.kind == ::fit::WindowChoice::Kind::full_cycles;
  if (morison.prepare.average_cycles && !cut)
    throw t.root.table("prepare").wrong("mean_cycle", "needs cycles", "set window = { kind = \"full cycles\" }");
  if (morison.cycles && !cut)
    throw t.ask().wrong("cycles", "needs cycles", "set [prepare] window = { kind = \"full cycles\" }");
  if (morison.cycles && morison.longest_delay)
    throw t.ask().wrong("cycles", "cannot be had while the delay is being estimated",
                        "give the delay that was estimated");
}

::fit::RawRun raw_run(const MorisonModel& model, const Measurements& measured) {
  return {.time = measured.time(),
          .force = measured.force_channels(model.zero_run),
          .position = measured.of_role("position", dim::length),
          .velocity = measured.of_role("velocity", dim::velocity),
          .acceleration = measured.of_role("acceleration", dim::acceleration),
          .cross_velocity = measured.of_role("cross_velocity", dim::velocity),
          .elevation = measured.of_role("elevation", dim::length),
          .probe = model.probe,
          .water_velocity = measured.of_role("water_velocity", dim::velocity),
          .water_acceleration = measured.of_role("water_acceleration", dim::acceleration)};
}

/// Takes what one row of the table of runs says of its run.
void take_row(const Located<std::filesystem::path>& place, std::size_t row, MorisonModel& model,
              ::fit::morison::Run& run) {
  const auto table = hydro::io::CsvTable::read(place.value);
  const auto take = [&](const char* column, const hydro::Dimension& dimension, auto& value) {
    if (table.has(column)) value = table.column(column, dimension)[row];
  };
  for (const char* column : {"diameter", "length", "density", "viscosity"})
    if (table.has(column) && !(table.column(column)[row] > 0))
      throw hydro::InputError(
          fmt::format("the {} of a run must be positive, got {:g}", column, table.column(column)[row]),
          table.place_of(column, row), "leave the column out where the scene says it");
  take("diameter", dim::length, run.cylinder.diameter);
  take("length", dim::length, run.cylinder.length);
  take("density", dim::density, run.cylinder.density);
  take("mass_beyond_load_cells", dim::mass, run.cylinder.mass_beyond_load_cells);
  take("viscosity", dim::kinematic_viscosity, run.cylinder.viscosity);
  take("delay", dim::time, run.delay_s);
  if (const auto found = too_uncertain(run.cylinder, model.force.cylinder_errors); found && table.has(found->key))
    throw hydro::InputError(fmt::format("the {} of a run, {:g} in SI, is no larger than its uncertainty, {:g}",
                                        found->key, found->size, found->error),
                            table.place_of(found->key, row),
                            fmt::format("look at its unit, and at {} in [model.uncertainty]", found->name));
  if (table.has("zero")) model.zero_run = {{place.value.parent_path() / table.text_column("zero")[row], place.place}};
}

/// (F105) What velocity and acceleration are from.
void add_slopes(const FitScene& scene, MorisonOptions& options) {
  if (scene.lines.empty() || scene.model<MorisonModel>().cylinder.experiment == Experiment::both_move) return;
  const auto of = [&](std::initializer_list<const char*> roles) { return slope_error_of(scene, roles).standard; };
  options.velocity_slope = of({"velocity", "position", "elevation"});
  options.acceleration_slope = of({"acceleration", "velocity", "position", "elevation"});
  options.one_motion = scene.channels.count("acceleration") == 0;
}

::fit::morison::Run read_run(const FitScene& scene, MorisonModel model, const RunOfScene& of) {
  ::fit::morison::Run run{.source = of.source, .cylinder = model.cylinder, .raw = {}};
  if (scene.run_table) take_row(*scene.run_table, of.row, model, run);
  placed({.file = of.source.file.string()}, [&] { run.raw = raw_run(model, Measurements(scene, of.source.file)); });
  return run;
}

Binding<MorisonModel> morison_keys() {
  using M = MorisonModel;
  using O = MorisonOptions;
  return Binding<M>("", "drag and inertia in unsteady flow (Morison et al., 1950)")
      .part(cylinder_in_flow(), &M::cylinder)
      .part(Binding<O>("", "")
                .key(effect("linear_drag", "a drag that goes with the velocity is fitted as well"), &O::linear_drag)
                .key(effect("offset", "a constant force is fitted as well"), &O::force_offset)
                .tables("line", force_line(), &O::lines)
                .optional(),
            &M::force)
      .table("wave", probe_to_body(), &M::probe)
      .part(Binding<O>("", "").table("uncertainty", cylinder_errors_with_mass(), &O::cylinder_errors).optional(),
            &M::force);
}

const Words<::fit::RobustLoss> robust_losses{{"huber", ::fit::RobustLoss::huber},
                                             {"bisquare", ::fit::RobustLoss::bisquare},
                                             {"least absolute residuals", ::fit::RobustLoss::least_absolute}};
const Words<::fit::IntervalMethod> interval_methods{{"effective samples", ::fit::IntervalMethod::effective_samples},
                                                    {"cycle clusters", ::fit::IntervalMethod::cycle_clusters},
                                                    {"block bootstrap", ::fit::IntervalMethod::block_bootstrap}};
const Words<std::optional<::fit::Law>> laws{
    {"constant", ::fit::Law::constant},   {"kc", ::fit::Law::kc}, {"re", ::fit::Law::re}, {"beta", ::fit::Law::beta},
    {"kc and re", ::fit::Law::kc_and_re}, {"best", std::nullopt}};

std::vector<Key> morison_channels() {
  return {
      text("time", "time"),
      texts("force",
            "measured force, positive along positive velocity: of the water on a fixed body, or what load cells "
            "carry; several columns are added up, and \"-F2\" is F2 turned round"),
      text("velocity", "of the water, or of the body, whichever moves; where both move, of the body").optional(),
      text("acceleration", "as velocity; left out: from the velocity or position").optional(),
      text("position", "as velocity, instead of it").optional(),
      text("cross_velocity",
           "where water moves: velocity across both the force and the axis: drag is then sqrt(u^2 + w^2) u")
          .optional(),
      text("elevation", "where water moves: surface at a probe, in place of the water's velocity; needs [model] wave")
          .optional(),
      text("water_velocity", "both move: of the water where the body is").optional(),
      text("water_acceleration", "both move: as water_velocity; left out: from it").optional()};
}

Binding<MorisonModel> morison_data() {
  return Binding<MorisonModel>("", "")
      .optional(text("runs",
                     "CSV with one row for each run: the column file, and any of zero, delay, diameter, length, "
                     "density, viscosity and mass_beyond_load_cells, which then hold for that run; other columns are "
                     "carried into the results"))
      .optional(calibration_key())
      .optional(zero_key(), &MorisonModel::zero_run);
}

Binding<MorisonModel> morison_intervals() {
  return Binding<MorisonModel>("", "").key(
      text("method", "how the residuals' memory is counted")
          .one_of(words_of(interval_methods))
          .or_default("effective samples", "sharpest where residuals are stationary"),
      [](const Value& v, MorisonModel& out) { out.force.method = value_for(interval_methods, v.text); });
}

Binding<MorisonModel> asked_of_forces() {
  using M = MorisonModel;
  return Binding<M>("", "")
      .optional(texts("coefficients", "drag cd, inertia cm, added mass ca").one_of({"cd", "cm", "ca"}))
      .optional(
          text("robust",
               "wild samples of the force pull less: beyond 1.345 deviations no more than there (huber), less and "
               "less (bisquare), or all by their distance and not its square")
              .one_of(words_of(robust_losses)),
          [](const Value& v, M& out) { out.force.robust = value_for(robust_losses, v.text); })
      .key(effect("cycles", "coefficients of each cycle too; needs [prepare] window in full cycles"), &M::cycles)
      .optional(text("law", "coefficients of all runs against KC, Re or beta = Re/KC, with runs that differ by chance")
                    .one_of(words_of(laws)),
                [](const Value& v, M& out) {
                  out.law = {value_for(laws, v.text)};
                  out.law_asked = v.place;
                })
      .key(effect("sensitivity", "the fit repeated with other cutoffs, bandwidths and halves of the window"),
           &M::sensitivity);
}

class MorisonFits final : public FitKindOf<MorisonModel, ::fit::morison::Problem> {
 public:
  MorisonFits()
      : FitKindOf({.word = "morison",
                   .model = morison_keys(),
                   .channels = morison_channels(),
                   .data = morison_data(),
                   .intervals = morison_intervals(),
                   .ask = asked_of_forces()}) {}
  bool has_table() const override { return true; }
  std::string said_of_line(const FitScene& scene, const std::string& column) const override {
    for (const auto& force : scene.force)
      if (force.column == column) return " and in the intervals";
    const bool both = scene.model<MorisonModel>().cylinder.experiment == Experiment::both_move;
    const auto across = scene.channels.find("cross_velocity");
    return both || (across != scene.channels.end() && across->second == column) ? " and in no interval"
                                                                                : " and in the intervals";
  }
  std::vector<std::pair<std::string, std::string>> settings(const FitScene& scene) const override {
    const auto& model = scene.model<MorisonModel>();
    return {{"motion", word_for(experiments, model.cylinder.experiment)},
            {"intervals", word_for(interval_methods, model.force.method)}};
  }

 private:
  void finish(const FitTables& t, const FitScene& scene, MorisonModel& morison) const override {
    morison.force.bands = true;
    morison.force.confidence = scene.confidence;
    morison.prepare.linear_drag = morison.force.linear_drag;
    check_motion_channels(t.channels(), morison.cylinder.experiment);
    if (morison.cylinder.experiment == Experiment::water_moves && morison.force.cylinder_errors.mass != 0)
      throw t.model().table("uncertainty").wrong("mass", "does not act: the body does not move", "leave it out");
    check_errors(t.model(), morison.cylinder, morison.force.cylinder_errors);
    finish_probe(t, morison);
    if (t.root.has("prepare")) read_delay(t.root.table("prepare"), morison);
    check_cycles(t, morison);
    const auto& coefficients = wanted(t, {"cd", "cm", "ca"}, "[\"cd\"]", "ask for cd, cm or ca");
    morison.coefficients.assign(coefficients.begin(), coefficients.end());
  }

  ::fit::morison::Problem problem(const FitScene& scene, const MorisonModel& model) const override {
    ::fit::morison::Problem out{.runs = {}, .options = model};
    add_slopes(scene, out.options.force);
    for (const RunOfScene& of : runs_of(
             scene, {"file", "zero", "delay", "diameter", "length", "density", "viscosity", "mass_beyond_load_cells"}))
      out.runs.push_back(read_run(scene, model, of));
    return out;
  }

  Place asked_at(const FitScene& scene) const override {
    return scene.model<MorisonModel>().law_asked.value_or(scene.model_place);
  }

  Remedy remedy(const FitScene& scene, const ::fit::morison::Problem&, const Solution&) const override {
    return {.text =
                fmt::format("write force = \"-{}\" among the channels, turn the motion, or give the header of {} the "
                            "unit that its numbers are in",
                            scene.force[0].column, scene.force[0].column)};
  }

  std::string table(const ::fit::morison::Problem&, const Solution& solution) const override {
    return morison_table(solution);
  }
  Panels panels(const ::fit::morison::Problem&, const Solution& solution) const override {
    return morison_panels(solution);
  }
};

}  // namespace

std::unique_ptr<const FitKind> morison_fit() { return std::make_unique<MorisonFits>(); }

}  // namespace froude::scene
