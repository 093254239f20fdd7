#include "froude/fit_decay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/decay.hpp"
#include "fit/forced_radiation.hpp"
#include "fit/prepare.hpp"
#include "fit/verdict.hpp"
#include "froude/fit_summary.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using ::fit::Coefficient;
using Json = FitJson;
using Decay = scene::DecayModel;

DecayRecord read_record(const scene::FitScene& scene, const Decay& model, const std::filesystem::path& file) {
  const auto table = hydro::io::CsvTable::read(file);
  const bool angle = scene.turns();
  const auto& time = table.column(scene.channels.at("time"), dim::time);
  auto motion = ::fit::prepare_motion(angle ? "angle" : "position", time,
                                      angle ? table.column(scene.channels.at("angle"), dim::angle)
                                            : table.column(scene.channels.at("position"), dim::length),
                                      model.prepare);
  return {file.filename().string(), std::move(motion.time), std::move(motion.values), std::move(motion.steps),
          std::move(motion.cautions)};
}

/// Of the fit without a memory, which a memory is set against.
::fit::DecayOptions plain_options(const Decay& model) {
  ::fit::DecayOptions options = model.options;
  if (options.terms.count() == 0) options.terms.linear = true;
  return options;
}

/// The same fit of each half of the record: where they differ by many errors, damping is not what the terms say.
void vary(const Decay& model, const ::fit::Window& whole, DecayRun& run) {
  const Eigen::Index n = whole.values.rows(), half = n / 2;
  for (const bool first : {true, false}) {
    DecayVariant v{first ? "the first half of the record" : "the second half of the record", {}, {}};
    const Eigen::MatrixXd part = whole.values.middleRows(first ? 0 : half, first ? half : n - half);
    try {
      const auto again = ::fit::fit_decay(std::vector{::fit::Window{whole.step, part}}, plain_options(model));
      const auto add = [&](const Coefficient& a, const Coefficient& b) {
        const auto middle = [](const Coefficient& c) { return (c.interval.low + c.interval.high) / 2; };
        v.changes.push_back((middle(a) - middle(b)) / b.standard_error);
      };
      add(again.period, run.fit.period);
      for (std::size_t k = 0; k < again.damping.size(); ++k) add(again.damping[k], run.fit.damping[k]);
    } catch (const hydro::InputError& e) {
      v.why_not = e.rule();
    } catch (const hydro::NumericsError& e) {
      v.why_not = e.what();
    }
    run.variants.push_back(std::move(v));
  }
}

/// (F67) Nobody has stated how large residuals of a decay may be; larger than what is explained is too large.
void require_explained(const scene::FitScene& scene, const Decay& model, const DecayRun& run,
                       const ::fit::ShootingFit& motion) {
  if (motion.explained[0] >= ::fit::least_explained || model.accept_residuals) return;
  const char* unit = scene.turns() ? "rad" : "m";
  throw CheckFailed(hydro::InputError(
      fmt::format("no value is told: the motion fitted differs by {:.3g} {} rms from {} and explains {:.3g} % of its "
                  "variance; {:g} % are the least",
                  motion.rms[0], unit, run.records.size() == 1 ? run.name : "the records together",
                  100 * motion.explained[0], 100 * ::fit::least_explained),
      scene.model_place,
      "take the part of the record that swings (window of [prepare]), or other terms; to have values all the same: "
      "[ask] accept = [\"residuals\"]"));
}

/// The memory, and what it makes of the body where that is known.
void add_memory(const scene::FitScene& scene, const Decay& model, const std::vector<::fit::Window>& windows,
                DecayRun& run) {
  run.memory = ::fit::fit_decay_memory(windows, *model.memory);
  require_explained(scene, model, run, run.memory->motion);
  if (!model.body) return;
  const auto at = [&](double omega) { return ::fit::radiation_of(*run.memory, *model.body, omega, scene.confidence); };
  run.swing = at(run.memory->omega);
  run.limit = at(std::numeric_limits<double>::infinity());
  for (int k = 1; k <= 100; ++k) run.curve.push_back(at(0.03 * k * run.memory->omega));
}

/// Fits the records of `run` with one set of coefficients.
void fit_records(const scene::FitScene& scene, const Decay& model, DecayRun& run) {
  std::vector<::fit::Window> windows;
  for (const DecayRecord& r : run.records)
    windows.push_back(
        {hydro::signal::even_step(r.time), Eigen::Map<const Eigen::VectorXd>(r.values.data(), std::ssize(r.values))});
  run.decrement = ::fit::logarithmic_decrement(::fit::find_extremes(run.records[0].time, run.records[0].values));
  run.fit = ::fit::fit_decay(windows, plain_options(model));
  require_explained(scene, model, run, run.fit.motion);
  if (model.sensitivity && windows.size() == 1) vary(model, windows[0], run);
  if (model.body) run.water = ::fit::added_mass(run.fit, *model.body, scene.confidence);
  if (model.memory) add_memory(scene, model, windows, run);
  // Of the model that holds what was asked for. The scale of harmonics is that of the record.
  const Eigen::VectorXd measured = windows[0].values.col(0);
  if (windows.size() == 1 && measured.size() >= 64 && run.fit.period.value)
    run.left = ::fit::look_at_residuals(measured - (run.memory ? run.memory->motion : run.fit.motion).motion[0].col(0),
                                        std::sqrt((measured.array() - measured.mean()).square().mean()),
                                        windows[0].step, *run.fit.period.value);
  const auto names = ::fit::parameters_of(run.fit.problem.law);
  for (const Coefficient& c : run.fit.damping) {
    if (!model.profile) break;
    const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), c.name) - names.begin());
    run.profiles.push_back(::fit::profile_interval(run.fit.problem, run.fit.motion, at));
  }
}

DecayRun fit_file(const scene::FitScene& scene, const Decay& model, const std::filesystem::path& file) try {
  DecayRun run{
      .name = file.filename().string(), .records = {read_record(scene, model, file)}, .decrement = {}, .fit = {}};
  fit_records(scene, model, run);
  return run;
} catch (const hydro::InputError& e) {
  throw e.at({.file = file.string()});
} catch (const ::fit::SearchFailed& e) {
  throw hydro::NumericsError(
      fmt::format("{}: no value is told: {}. Take the part of the record that swings (window of [prepare]), or other "
                  "terms",
                  file.string(), e.what()));
}

std::vector<DecayRun> fit_each(const scene::FitScene& scene, const Decay& model) {
  std::vector<DecayRun> runs;
  for (const auto& file : scene.files) runs.push_back(fit_file(scene, model, file.value));
  if (!scene.run_table) return runs;
  const auto table = hydro::io::CsvTable::read(scene.run_table->value);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    runs.push_back(fit_file(scene, model, scene.run_table->value.parent_path() / table.text_column("file")[row]));
    runs.back().labels = run_labels(table, row, {"file"});
  }
  return runs;
}

/// (F63) All runs with one set of coefficients; each keeps the rest position that its own best fit has.
std::optional<DecayRun> fit_together(const scene::FitScene& scene, const Decay& model,
                                     const std::vector<DecayRun>& runs) {
  if (!model.together) return {};
  hydro::require(runs.size() >= 2, "one run cannot be fitted together with others");
  DecayRun all{.name = "together", .records = {}, .decrement = {}, .fit = {}};
  for (const DecayRun& run : runs) {
    DecayRecord r = run.records[0];
    const double rest = run.memory ? run.memory->motion.ended[4] : run.fit.motion.ended[5];
    for (double& x : r.values) x -= rest;
    all.records.push_back(std::move(r));
  }
  fit_records(scene, model, all);
  return all;
}

/// Each coefficient over three runs and more that were fitted alone, those that cannot tell it from zero among them.
FitSummary summary_over(const scene::FitScene& scene, const std::vector<DecayRun>& runs) {
  FitSummary summary{.key = "over_runs"};
  if (runs.size() < 3) return summary;
  const auto add = [&](const std::string& name, const auto& coefficient_of) {
    std::vector<::fit::RunEstimate> estimates;
    for (const DecayRun& run : runs)
      if (const Coefficient& c = coefficient_of(run); c.standard_error > 0)
        estimates.push_back({(c.interval.low + c.interval.high) / 2, c.standard_error, 0, 0, 0});
    if (estimates.size() == runs.size())
      summary.parts.push_back(over_runs(name, unit_of_decay(name, scene.turns()),
                                        ::fit::fit_runs(estimates, ::fit::Law::constant, scene.confidence), "run",
                                        runs.size(), scene.confidence));
  };
  add("period", [](const DecayRun& run) -> const Coefficient& { return run.fit.period; });
  for (std::size_t k = 0; k < runs[0].fit.damping.size(); ++k)
    add(runs[0].fit.damping[k].name, [k](const DecayRun& run) -> const Coefficient& { return run.fit.damping[k]; });
  return summary;
}

/// What a scene of motion may include, of one run or of all together.
Json coefficients_of(const DecayRun& run) {
  Json j = Json::object();
  const auto put = [&](const Coefficient& c) {
    if (c.value) j[c.name] = *c.value;
  };
  put(run.fit.period);
  for (const Coefficient& c : run.fit.damping) put(c);
  if (run.water) put(run.water->added_mass);
  if (!run.memory) return j;
  for (const Coefficient& c : run.memory->memory) put(c);
  return j;
}

}  // namespace

FitOutcome fit_model(const scene::FitScene& scene, const scene::DecayModel& model) {
  const std::vector<DecayRun> runs = fit_each(scene, model);
  const std::optional<DecayRun> together = fit_together(scene, model, runs);
  FitSummary summary = begin_summary(scene), over = summary_over(scene, runs);
  if (together || runs.size() == 1) {
    summary.facts["coefficients"] = coefficients_of(together ? *together : runs[0]);
  } else {
    for (const FitSummary& law : over.parts) summary.facts["coefficients"][law.key] = law.facts["value"];
  }
  for (const DecayRun& run : runs) summary.parts.push_back(summary_of(scene, run));
  if (together) {
    summary.parts.push_back(summary_of(scene, *together));
    summary.parts.back().key = "together";
    summary.parts.back().one_of_many = false;
  }
  if (!over.parts.empty()) summary.parts.push_back(std::move(over));
  return {std::move(summary), decay_figure(scene, together ? std::vector{*together} : runs), decay_table(scene, runs)};
}

}  // namespace froude
