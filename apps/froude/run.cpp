#include <nlohmann/json.hpp>

#include <cmath>

#include "compile/integrator.hpp"
#include "froude/progress.hpp"
#include "froude/scene_result.hpp"
#include "froude/series.hpp"
#include "froude/simulate.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

double found(const std::vector<std::pair<std::string, double>>& entries, const std::string& name) {
  for (const auto& [key, value] : entries)
    if (key == name) return value;
  return 0;
}

nlohmann::json snaps_json(const Record& record) {
  nlohmann::json out = nlohmann::json::array();
  for (const Snaps& s : record.snaps)
    out.push_back({{"line", s.line},
                   {"slack_share", s.slack_share},
                   {"snaps", s.snaps},
                   {"largest_tension_N", s.largest_tension},
                   {"link", s.link},
                   {"time_s", s.at}});
  return out;
}

std::string sentence(const Snaps& s) {
  return fmt::format("{}: slack {:.3g} % of the time, {} snap{}, largest tension {:.5g} N in link {} at {:.5g} s",
                     s.line, 100 * s.slack_share, s.snaps, s.snaps == 1 ? "" : "s", s.largest_tension, s.link, s.at);
}

nlohmann::json exponents_json(const Record& record) {
  nlohmann::json out = nlohmann::json::array();
  for (const auto& [line, e] : record.exponents)
    out.push_back({{"line", line},
                   {"lyapunov_per_s", e.value},
                   {"standard_error_per_s", e.error},
                   {"from_s", e.from},
                   {"to_s", e.to},
                   {"blocks", e.blocks},
                   {"block_correlation", e.block_correlation},
                   {"of_a_regular_motion_per_s", e.regular}});
  return out;
}

std::string sentence(const LineExponent& of) {
  const dynamics::Exponent& e = of.exponent;
  return fmt::format(
      "{}: largest Lyapunov exponent {:.4g} +- {:.2g} 1/s from {:.5g} to {:.5g} s; a regular motion would show up to "
      "{:.2g} 1/s{}",
      of.line, e.value, e.error, e.from, e.to, e.regular,
      e.has_lasted() ? ""
                     : fmt::format("; the error is too small, since blocks resemble their neighbours (correlation "
                                   "{:.2g}): let it run longer",
                                   e.block_correlation));
}

/// More of the energy turned over than the residual of sound runs; a motion whose energies are that far off is no
/// answer.
constexpr double tolerated_residual = 0.02;

std::vector<std::string> warnings(const Record& record) {
  const double turnover = found(record.energy, "turnover");
  const auto& [residual, at] = record.worst_residual;
  if (std::abs(residual) <= tolerated_residual * turnover) return {};
  return {
      fmt::format("warning: the energy residual is {:.2g} of the energy turned over at {:.5g} s: the step of {:.4g} s "
                  "is too long for "
                  "what moves; compare with a run of half the step, [solve] step = \"{:.6g} s\"",
                  std::abs(residual) / turnover, at, record.step, record.step / 2)};
}

void tell(const Console& console, const scene::Scene& scene, const Record& record, const Path& file) {
  const double turnover = found(record.energy, "turnover");
  const auto& [residual, at] = record.worst_residual;
  const double relative = turnover > 0 ? std::abs(residual) / turnover : 0;
  if (console.json) {
    nlohmann::json j{{"file", file.string()},
                     {"duration_s", record.time.back()},
                     {"step_s", record.step},
                     {"steps", record.steps},
                     {"newton_iterations", record.newton_iterations},
                     {"halvings", record.halvings},
                     {"parts", record.parts},
                     {"events", record.events},
                     {"wall_time_s", record.stepping_s},
                     {"energy_residual_relative", relative},
                     {"energy_residual_at_s", at},
                     {"stopped", record.stopped},
                     {"notes", record.notes},
                     {"warnings", warnings(record)}};
    if (!record.snaps.empty()) j["snaps"] = snaps_json(record);
    if (!record.exponents.empty()) j["lyapunov"] = exponents_json(record);
    j["signals"] = series_json(record.signals);
    console.out << j.dump(1) << '\n';
    return;
  }
  if (scene.run->steady)
    console.out << fmt::format("{}: {:.6g} s without stepping, {:.2f} s of work\n", scene.file.filename().string(),
                               record.time.back(), record.preparation_s);
  else
    console.out << fmt::format(
        "{}: {:.6g} s in {} steps of {:.4g} s{}, {:.2f} Newton iterations a step{}{}, {:.2f} s of work\n",
        scene.file.filename().string(), record.time.back(), record.steps, record.step,
        record.parts ? fmt::format(" cut into {} parts", record.parts) : "",
        static_cast<double>(record.newton_iterations) / static_cast<double>(std::max<std::size_t>(1, record.steps)),
        record.halvings ? fmt::format(", {} halvings", record.halvings) : "",
        record.events ? fmt::format(", {} stick-slip or contact events", record.events) : "", record.stepping_s);
  console.out << series_table(record.signals);
  if (!scene.run->steady)
    console.out << fmt::format(
        "energy residual: at most {:.3g} J, at {:.5g} s, {:.2g} of the {:.3g} J turned over "
        "(this tells how well energy is kept, not how accurate the motion is)\n",
        residual, at, relative, turnover);
  for (const Snaps& s : record.snaps) console.out << sentence(s) << '\n';
  for (const LineExponent& e : record.exponents) console.out << sentence(e) << '\n';
  for (const auto& note : record.notes) console.out << "note: " << note << '\n';
  for (const auto& warning : warnings(record)) console.out << warning << '\n';
  console.out << "wrote " << file.string() << '\n';
}

}  // namespace

void run(const SceneArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.run.has_value(), scene, "run", "run = { duration = \"600 s\", every = \"0.05 s\" }");
  const Path file = checked_output(arguments, ".run.h5");
  Progress progress(console.err, "run", console.show_progress);
  const Record record = simulate(scene, [&](double done) { progress.update(done); });
  Provenance provenance = provenance_of(scene, record.notes);
  provenance.wall_time = {{"preparation", record.preparation_s}, {"stepping", record.stepping_s}};
  provenance.settings.emplace_back("chosen.step", fmt::format("{} s", record.step));
  if (scene.solve.integrator == "generalized_alpha")
    provenance.settings.emplace_back("chosen.rho_infinity", fmt::format("{}", scene.solve.rho_infinity));
  if (compile::has_own_tolerance(scene.solve.integrator) && !scene.solve.tolerance)
    provenance.settings.emplace_back("chosen.tolerance", fmt::format("{}", compile::tolerance_of_pair));
  for (const auto& [effect, count] : record.evaluations)
    provenance.settings.emplace_back("evaluations." + effect, std::to_string(count));
  for (const Snaps& s : record.snaps) provenance.settings.emplace_back("snaps." + s.line, sentence(s));
  for (const LineExponent& e : record.exponents) provenance.settings.emplace_back("lyapunov." + e.line, sentence(e));
  for (const auto& warning : warnings(record)) provenance.notes.emplace_back("warning", warning);
  provenance.energy = record.energy;
  if (!record.stopped.empty()) provenance.notes.emplace_back("stopped", record.stopped);
  write_run(file, record.time, record.signals, provenance);
  if (arguments.csv) write_series_csv(*arguments.csv, record.time, record.signals);
  if (arguments.picture)
    hydro::io::write_atomically(*arguments.picture, plot::svg(series_figure(scene.title.empty() ? "Run" : scene.title,
                                                                            record.time, record.signals)));
  tell(console, scene, record, file);
  if (!record.stopped.empty())
    throw hydro::NumericsError(record.stopped + "; what was computed is in " + file.string());
}

}  // namespace froude
