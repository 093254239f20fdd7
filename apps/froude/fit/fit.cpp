#include <ostream>
#include <vector>

#include "answers/fit_kind.hpp"
#include "answers/picture.hpp"
#include "froude/fit/report.hpp"
#include "froude/outputs.hpp"
#include "froude/shares.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

/// All that comes of a fit. Where it is refused, text and picture are all that is told.
struct Outcome {
  Report report;
  plot::Figure picture;
  std::string table;           ///< CSV
  std::exception_ptr refused;  ///< null where values may be told
};

/// What a report of any kind begins with: what was asked.
Report begun(const scene::FitScene& scene) {
  Report out;
  out.keep("scene", scene.file.filename().string()).keep("kind", scene.kind()).keep("confidence", scene.confidence);
  for (const auto& [name, value] : scene.of->settings(scene)) out.keep(name, value);
  return out;
}

std::exception_ptr exception_of(const ::fit::Refusal& refusal, const scene::Remedy& remedy) {
  const hydro::InputError error(refusal.why, remedy.place, remedy.text);
  switch (refusal.reason) {
    case ::fit::Refusal::Reason::residuals_too_large:
    case ::fit::Refusal::Reason::halves_differ:
      return std::make_exception_ptr(CheckFailed(error));
    case ::fit::Refusal::Reason::wrong_sign:
      return std::make_exception_ptr(error.at({.file = refusal.source}));
    case ::fit::Refusal::Reason::search_without_end:
      break;
    case ::fit::Refusal::Reason::profile_without_an_end:
      return std::make_exception_ptr(hydro::NumericsError(refusal.why));
  }
  const std::string of = refusal.source.empty() ? "" : refusal.source + ": ";
  return std::make_exception_ptr(hydro::NumericsError(fmt::format("{}{}. {}", of, refusal.why, remedy.text)));
}

Outcome outcome_of(const scene::FitScene& scene, const FitArguments& arguments) {
  scene::FitAnswer answer = arguments.predict ? scene.of->predict(scene, arguments.at) : scene.of->answer(scene);
  const ::fit::Report& report = answer.report;
  Outcome out{.report = begun(scene).part("", told(report, scene.confidence)),
              .picture = {.title = scene.title.empty() ? scene.file.filename().string() : scene.title,
                          .panels = std::move(answer.panels)},
              .table = std::move(answer.table),
              .refused = {}};
  if (!report.refused) return out;
  out.refused = exception_of(*report.refused, answer.remedy);
  if (report.refused->reason != ::fit::Refusal::Reason::profile_without_an_end) out.picture.title += ": no fit";
  return out;
}

/// Prints, and writes what the arguments ask for: TOML, table, picture. \throws what `outcome` was refused for
void deliver(const Outcome& outcome, const FitArguments& arguments, Shares& shares, const Console& console) {
  if (!console.json) console.out << outcome.report.text();
  const auto write = [&](const std::optional<Path>& file, const std::string& content) {
    if (!file || content.empty()) return;
    hydro::io::write_atomically(*file, content);
    if (!console.json && !outcome.refused) console.out << "wrote " << file->string() << '\n';
  };
  const bool drawn = arguments.picture && !outcome.picture.panels.empty();
  if (drawn) plot::write_picture(*arguments.picture, outcome.picture);
  if (outcome.refused) std::rethrow_exception(outcome.refused);
  write(arguments.table, outcome.table);
  const std::string comment = fmt::format("{} of `froude fit`, version {}. SI units.",
                                          arguments.predict ? "Prediction" : "Estimates", FROUDE_VERSION);
  if (arguments.output) write(arguments.output, toml_of(outcome.report.tree(), comment));
  if (drawn && !console.json) console.out << "wrote " << arguments.picture->string() << '\n';
  shares.end("writing");
  if (console.json)
    tell(Report(outcome.report).part("", shares.report()), console);
  else
    tell_people(shares.report(), console);
}

}  // namespace

void fit(const FitArguments& arguments, const Console& console) {
  Shares shares;
  const scene::FitScene scene = scene::read_fit(arguments.scene);
  std::vector<NamedFile> inputs = files_of_scene(arguments.scene);
  if (arguments.at) inputs.push_back({"the values of an earlier fit", *arguments.at});
  require_outputs(named({{"-o", arguments.output}, {"--table", arguments.table}, {"--picture", arguments.picture}}),
                  inputs);
  require_picture(arguments.picture);
  if (arguments.table && !scene.of->has_table())
    throw hydro::InputError(fmt::format("a fit of kind \"{}\" has no table of runs", scene.kind()), {},
                            "leave out --table");
  shares.end("reading");
  const Outcome outcome = outcome_of(scene, arguments);
  shares.end("fitting");
  deliver(outcome, arguments, shares, console);
}

}  // namespace froude
