#include <algorithm>
#include <cmath>
#include <optional>

#include "answers/checkpoint.hpp"
#include "answers/picture.hpp"
#include "answers/simulate.hpp"
#include "froude/outputs.hpp"
#include "froude/progress.hpp"
#include "froude/scene_result.hpp"
#include "froude/series.hpp"
#include "froude/shares.hpp"
#include "froude/signals.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"

namespace froude {
namespace {

Report report_of(const Snaps& s) {
  return Report().say("{}: slack {:.3g} % of the time, {} snap{}, largest tension {:.5g} N in link {} at {:.5g} s",
                      fact("line", s.line), fact("slack_share", s.slack_share, 100 * s.slack_share),
                      fact("snaps", s.snaps), s.snaps == 1 ? "" : "s", fact("largest_tension_N", s.largest_tension),
                      fact("link", s.link), fact("time_s", s.at));
}

Report report_of(const LineExponent& of) {
  const dynamics::Exponent& e = of.exponent;
  const std::string doubt = e.has_lasted()
                                ? ""
                                : fmt::format(
                                      "; the error is too small, since blocks resemble their neighbours (correlation "
                                      "{:.2g}): let it run longer",
                                      e.block_correlation);
  return Report()
      .say(
          "{}: largest Lyapunov exponent {:.4g} +- {:.2g} 1/s from {:.5g} to {:.5g} s; a regular motion would show up "
          "to {:.2g} 1/s{}",
          fact("line", of.line), fact("lyapunov_per_s", e.value), fact("standard_error_per_s", e.error),
          fact("from_s", e.from), fact("to_s", e.to), fact("of_a_regular_motion_per_s", e.regular),
          fact("block_correlation", e.block_correlation, doubt))
      .keep("blocks", e.blocks);
}

/// How the run was stepped.
Report steps_of(const Run& record, const std::string& scene) {
  const auto if_any = [](auto count, const char* format) {
    return count > 0 ? fmt::format(fmt::runtime(format), count) : std::string();
  };
  const double a_step =
      static_cast<double>(record.newton_iterations) / static_cast<double>(std::max<std::size_t>(1, record.steps));
  return Report().say("{}: {:.6g} s in {} steps of {:.4g} s{}, {:.2f} Newton iterations a step{}{}{}, {:.2f} s of work",
                      scene, fact("duration_s", record.time.back()), fact("steps", record.steps),
                      fact("step_s", record.step),
                      fact("parts", record.parts, if_any(record.parts, " cut into {} parts")),
                      fact("newton_iterations", record.newton_iterations, a_step),
                      fact("halvings", record.halvings, if_any(record.halvings, ", {} halvings")),
                      fact("events", record.events, if_any(record.events, ", {} stick-slip or contact events")),
                      fact("leaps", record.leaps, if_any(record.leaps, ", {} leaps of rough contacts to rest")),
                      fact("wall_time_s", record.stepping_s));
}

Report energy_of(const Run& record) {
  const auto& [residual, at] = record.worst_residual;
  return Report().say(
      "energy residual: at most {:.3g} J, at {:.5g} s, {:.2g} of the {:.3g} J turned over "
      "(this tells how well energy is kept, not how accurate the motion is)",
      fact("energy_residual_J", residual), fact("energy_residual_at_s", at),
      fact("energy_residual_relative", record.relative_residual()), fact("energy_turnover_J", record.turnover()));
}

/// Those of a result lie beside it.
std::optional<Checkpoints> checkpoints_of(const scene::Scene& scene, const SceneArguments& arguments,
                                          const Path& result) {
  if (!scene.run->checkpoint) return std::nullopt;
  std::vector<Path> data;
  for (const NamedFile& file : files_of_scene(arguments.scene)) data.push_back(file.path);
  return std::optional<Checkpoints>(std::in_place, result.string() + ".checkpoints", scene, data);
}

/// A signal that came after numerics had ended the run, or with its last step, has changed nothing.
bool was_interrupted(const Run& record) {
  return asks_to_end(&Signals::asked()) && record.stopped.starts_with(sentence(Signals::asked()));
}

/// \throws hydro::NumericsError or EndedBySignal, as the run was stopped
[[noreturn]] void tell_stop(const Run& record, const Path& file, bool has_checkpoints) {
  const std::string what = record.stopped + "; what was computed is in " + file.string();
  if (!was_interrupted(record)) throw hydro::NumericsError(what);
  throw EndedBySignal(Signals::asked(),
                      what + (has_checkpoints ? "; the same command goes on from the last checkpoint" : ""));
}

Report report_of(const scene::Scene& scene, const Run& record, const Shares& shares, const Path& file) {
  const std::string name = scene.file.filename().string();
  const Report steps = steps_of(record, name), energy = energy_of(record);
  const bool stepped = !scene.run->steady;
  Report out;
  if (!stepped)
    out.say("{}: {:.6g} s without stepping, {:.2f} s of work", name, record.time.back(), record.preparation_s);
  out.part("", stepped ? steps : steps.untold());
  add_series(out, record.signals);
  out.part("", stepped ? energy : energy.untold());
  out.part("error", error_of(record));
  for (const Snaps& s : record.snaps) out.one_of("snaps", report_of(s));
  for (const LineExponent& e : record.exponents) out.one_of("lyapunov", report_of(e));
  out.keep("stopped", record.stopped);
  out.sentences("notes", "note: {}", record.notes).sentences("warnings", "{}", record.warnings());
  out.part("", shares.report());
  return out.say("wrote {}", fact("file", file.string()));
}

}  // namespace

void run(const SceneArguments& arguments, const Console& console) {
  Shares shares;
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.run.has_value(), scene, "a run", "run = { duration = \"600 s\", every = \"0.05 s\" }");
  const Path file = checked_output(arguments, ".run.h5");
  std::optional<Checkpoints> checkpoints = checkpoints_of(scene, arguments, file);
  Progress progress(console.err, "run", console.show_progress);
  shares.end("reading");
  const int threads = std::min(2, hydro::all_processors());
  std::optional<Signals> signals;  // a steady run has no step at which it could end
  if (!scene.run->steady) signals.emplace();
  const Run record = simulate(
      scene, [&](double done) { progress.update(done); }, {}, nullptr, threads, checkpoints ? &*checkpoints : nullptr,
      &Signals::asked());
  if (scene.run->steady)
    shares.end("answering");
  else
    shares.end("estimating", {{"preparing", record.preparation_s}, {"stepping", record.stepping_s}});
  record.write(file);
  if (arguments.csv) write_series_csv(*arguments.csv, record.time, record.signals);
  if (arguments.picture)
    plot::write_picture(*arguments.picture,
                        series_figure(scene.title.empty() ? "Run" : scene.title, record.time, record.signals));
  if (checkpoints && !was_interrupted(record)) checkpoints->remove();
  shares.end("writing");
  Report report = report_of(scene, record, shares, file);
  if (checkpoints) report.sentences("checkpoints", "note: {}", checkpoints->sentences());
  tell(report, console);
  if (!record.stopped.empty()) tell_stop(record, file, checkpoints.has_value());
}

}  // namespace froude
