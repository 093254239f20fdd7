#include "answers/cost.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "answers/picture.hpp"
#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

namespace fs = std::filesystem;

ErrorMeasure measure_of(const std::string& name) {
  for (const auto m : {ErrorMeasure::deviation, ErrorMeasure::extreme, ErrorMeasure::range})
    if (name_of(m) == name) return m;
  return ErrorMeasure::rms;
}

// What is asked

void check_tolerance(const std::optional<double>& tolerance) {
  constexpr double least = 1e-10;  // double precision, after the thousands of steps of a run
  if (tolerance && !(*tolerance >= least && *tolerance < 1))
    throw hydro::InputError(fmt::format("a tolerance of {:.6g} is none: it is a relative error", *tolerance),
                            {.file = "--tolerance"}, fmt::format("take one from {} to below 1, such as 1e-2", least));
}

/// Files that a scene names are looked for beside it, so its copy must stand there too.
void check_output(const CostArguments& arguments) {
  if (!arguments.output) return;
  const Path& file = *arguments.output;
  if (!arguments.tolerance)
    throw hydro::InputError("which settings to write is not said", {.file = file.string()},
                            "add --tolerance 1e-2, or leave -o out");
  if (file.extension() != ".toml")
    throw hydro::InputError(fmt::format("a scene is TOML, so its file cannot end in \"{}\"", file.extension().string()),
                            {.file = file.string()}, "end it in .toml");
  const auto folder = [](const Path& path) { return fs::weakly_canonical(fs::absolute(path).parent_path()); };
  if (folder(file) != folder(arguments.scene) && files_of_scene(arguments.scene).size() > 1)
    throw hydro::InputError("the scene names files, which are looked for beside it: not where its copy would be",
                            {.file = file.string()},
                            "write it to " + (arguments.scene.parent_path() / file.filename()).string());
}

// What is told

std::vector<ErrorMeasure> measures_of(const AnswerCost& answer) {
  if (answer.measure == ErrorMeasure::peak) return {ErrorMeasure::peak};
  return {ErrorMeasure::rms, ErrorMeasure::deviation, ErrorMeasure::extreme, ErrorMeasure::range};
}

const WorstSignal& error_of(const CostRung& rung, ErrorMeasure measure) {
  return rung.error[static_cast<std::size_t>(measure)];
}

Json json_of_errors(const CostRung& rung, const AnswerCost& answer) {
  Json out = Json::object();
  for (const ErrorMeasure m : measures_of(answer))
    out[name_of(m)] = {{"error", error_of(rung, m).error}, {"signal", error_of(rung, m).signal}};
  return out;
}

/// One line of the table, marked where it is on the front.
Report report_of(const CostRung& rung, const AnswerCost& answer) {
  Report out;
  out.keep("as_scene", rung.as_scene).keep("on_front", rung.on_front);
  const auto what = fact("approximation", rung.approximation);
  const auto setting = fact("setting", rung.setting, rung.setting + (rung.as_scene ? " (scene)" : ""));
  if (!rung.refused.empty())
    return out.say("  {:<24} {:<34} {:>9}", what, setting, fact("refused", rung.refused, "refused"));
  const bool by_itself = !rung.alone.signal.empty();
  const auto alone = fact("error_alone", by_itself ? std::optional(rung.alone.error) : std::nullopt,
                          by_itself ? fmt::format("{:.2g}", rung.alone.error) : "");
  std::string errors;
  for (const ErrorMeasure m : measures_of(answer)) errors += fmt::format(" {:>9.2g}", error_of(rung, m).error);
  out.say("{} {:<24} {:<34} {:>9.3g} {:>9.3g} {:>9}{}  {}", rung.on_front ? "*" : " ", what, setting,
          fact("time_s", rung.time_s()), fact("preparing_s", rung.preparing_s), alone, errors,
          error_of(rung, answer.measure).signal);
  return out.keep("errors", json_of_errors(rung, answer)).keep("repeats", rung.repeats);
}

Report table_of_rungs(const AnswerCost& answer) {
  Report out;
  std::string header;
  for (const ErrorMeasure m : measures_of(answer)) header += fmt::format(" {:>9}", name_of(m));
  out.say("  {:<24} {:<34} {:>9} {:>9} {:>9}{}  worst by {}", "approximation", "setting", "time [s]", "prepared",
          "alone", header, name_of(answer.measure));
  for (const CostRung& rung : answer.rungs) out.one_of("rungs", report_of(rung, answer));
  for (const CostOfComponents& c : answer.components)
    out.row("components", "  {:<24} {:<34} {:>9.3g}  deviation off by {:.2g} +- {:.1g} by chance  {}", "components",
            fact("setting", c.setting), fact("answering_s", c.answering_s), fact("deviation", c.error),
            fact("by_chance", c.by_chance), fact("signal", c.signal));
  return out;
}

std::string sentence(const CostRung& rung, ErrorMeasure measure) {
  return fmt::format("{} {}: {:.2g} off ({} of {}), {:.3g} s", rung.approximation, rung.setting,
                     error_of(rung, measure).error, name_of(measure), error_of(rung, measure).signal, rung.time_s());
}

/// What the table comes to.
Report summary_of(const AnswerCost& answer, const std::optional<double>& tolerance) {
  Report out;
  out.say("reference: {}; its next finest settings differ by {:.1g}, most of it from the {}",
          fact("reference", answer.reference), fact("uncertainty", answer.uncertainty.error),
          fact("uncertainty_from", answer.uncertainty.signal));
  const auto own = std::find_if(answer.rungs.begin(), answer.rungs.end(), [](const auto& r) { return r.as_scene; });
  out.say("the scene as it is: {:.2g} off ({} of {}), {:.3g} s", error_of(*own, answer.measure).error,
          name_of(answer.measure), error_of(*own, answer.measure).signal, own->time_s());
  if (answer.chosen) {
    const std::string cheapest = sentence(answer.rungs[*answer.chosen], answer.measure);
    out.keep("chosen", *answer.chosen);
    if (answer.by_chance)
      out.say("cheapest that is off by no more than chance: {}", cheapest)
          .say(
              "a run of this length leaves {:.1g} to chance; about {:.0f} times as long, or as many seeds, would tell "
              "{:.2g}",
              fact("by_chance", *answer.by_chance), fact("longer", std::pow(*answer.by_chance / *tolerance, 2)),
              *tolerance);
    else
      out.say("cheapest within {:.2g}: {}", *tolerance, cheapest);
  }
  std::vector<std::string> warnings;
  if (tolerance && answer.uncertainty.error > *tolerance && !answer.by_chance)
    warnings.push_back(
        fmt::format("errors below {:.1g} are not known: so much the reference itself may be off, by its {}",
                    answer.uncertainty.error, answer.uncertainty.signal));
  out.sentences("warnings", "warning: {}", warnings).sentences("notes", "note: {}", answer.notes);
  std::set<std::string> told;
  for (const CostRung& rung : answer.rungs)
    if (!rung.refused.empty() && told.insert(rung.refused).second)
      out.say("refused: {} {}: {}", rung.approximation, rung.setting, rung.refused);
  return out;
}

// What is drawn

plot::Panel panel_of(const AnswerCost& answer, const std::optional<double>& tolerance) {
  plot::Panel out{.x = {.label = "time of " + answer.ask, .unit = "s", .scale = plot::Scale::logarithmic},
                  .y = {.label = name_of(answer.measure) + " error, worst signal", .scale = plot::Scale::logarithmic},
                  .series = {{.name = "Pareto front", .x = {}, .y = {}}}};
  double first = std::numeric_limits<double>::infinity(), last = 0;
  for (const CostRung& rung : answer.rungs) {
    if (!rung.refused.empty() || error_of(rung, answer.measure).error == 0) continue;
    first = std::min(first, rung.time_s());
    last = std::max(last, rung.time_s());
    auto at = std::find_if(out.series.begin() + 1, out.series.end(),
                           [&](const auto& s) { return s.name == rung.approximation; });
    if (at == out.series.end())
      at = out.series.insert(at, {.name = rung.approximation, .x = {}, .y = {}, .line = false, .marks = true});
    at->x.push_back(rung.time_s());
    at->y.push_back(error_of(rung, answer.measure).error);
  }
  std::vector<const CostRung*> front;
  for (const CostRung& rung : answer.rungs)
    if (rung.on_front) front.push_back(&rung);
  std::sort(front.begin(), front.end(), [](auto a, auto b) { return a->time_s() < b->time_s(); });
  for (const CostRung* rung : front) {
    out.series.front().x.push_back(rung->time_s());
    out.series.front().y.push_back(error_of(*rung, answer.measure).error);
  }
  constexpr double margin = 1.2;  // marks at the ends stand inside the frame
  first /= margin;
  last *= margin;
  if (last > first) out.x.range = {first, last};
  if (tolerance)
    out.series.push_back({.name = "tolerance", .x = {first, last}, .y = {*tolerance, *tolerance}, .dashed = true});
  if (answer.uncertainty.error > 0)
    out.series.push_back({.name = "uncertainty of the reference",
                          .x = {first, last},
                          .y = {answer.uncertainty.error, answer.uncertainty.error},
                          .dashed = true});
  return out;
}

plot::Figure figure_of(const scene::Scene& scene, const Cost& cost, const std::optional<double>& tolerance) {
  plot::Figure out{.title = "What accuracy costs: " + scene.file.filename().string(), .panels = {}};
  for (const AnswerCost& answer : cost.answers) out.panels.push_back(panel_of(answer, tolerance));
  return out;
}

/// \throws hydro::InputError at an answer that has no setting within the tolerance
void require_chosen(const Cost& cost, double tolerance) {
  for (const AnswerCost& answer : cost.answers)
    if (!answer.chosen)
      throw hydro::InputError(fmt::format("no setting keeps the {} within {:.2g}; nearest is {}", answer.ask, tolerance,
                                          sentence(answer.most_accurate(), answer.measure)),
                              {.file = "--tolerance"},
                              answer.measure == ErrorMeasure::peak
                                  ? "ask for no less, or for responses without so sharp a peak"
                                  : "ask for no less, or by another measure: --by deviation");
}

}  // namespace

void cost(const CostArguments& arguments, const Console& console) {
  check_tolerance(arguments.tolerance);
  const scene::Scene scene = scene::read(arguments.scene);
  check_output(arguments);
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}), files_of_scene(arguments.scene));
  require_picture(arguments.picture);
  Progress progress(console.err, "cost", console.show_progress);
  const Cost found = cost(scene, {.tolerance = arguments.tolerance, .measure = measure_of(arguments.by)},
                          [&](double done) { progress.update(done); });
  Report out;
  for (const AnswerCost& answer : found.answers) {
    Report one;
    one.say("{} of {}: processor time; errors against the reference, worst signal; * nothing cheaper is as accurate",
            fact("ask", answer.ask), scene.file.filename().string());
    one.part("", table_of_rungs(answer)).part("", summary_of(answer, arguments.tolerance));
    out.one_of("answers", std::move(one));
  }
  if (arguments.picture) plot::write_picture(*arguments.picture, figure_of(scene, found, arguments.tolerance));
  if (arguments.output && found.scene) hydro::io::write_atomically(*arguments.output, *found.scene);
  out.wrote(arguments.picture);
  if (found.scene) out.wrote(arguments.output);
  tell(out, console);
  if (arguments.tolerance) require_chosen(found, *arguments.tolerance);
}

}  // namespace froude
