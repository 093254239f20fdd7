#include <algorithm>
#include <cmath>

#include "froude/fit_report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;

/// Loading cycles of a load cell: columns force and voltage, and cycle where there are several.
::fit::Calibration calibration_of(const scene::Located<std::filesystem::path>& file, double confidence) {
  const auto table = hydro::io::CsvTable::read(file.value);
  const auto &force = table.column("force", dim::force), &volt = table.column("voltage", dim::voltage);
  std::vector<::fit::LoadCycle> cycles(1);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (i > 0 && table.has("cycle") && table.column("cycle")[i] != table.column("cycle")[i - 1]) cycles.emplace_back();
    cycles.back().force.push_back(force[i]);
    cycles.back().voltage.push_back(volt[i]);
  }
  return ::fit::calibrate(cycles, confidence);
}

std::vector<double> turned(std::vector<double> values, bool turn) {
  if (turn)
    for (double& v : values) v = -v;
  return values;
}

std::vector<::fit::ForceChannel> force_channels(const scene::FitScene& scene, const hydro::io::CsvTable& table) {
  std::vector<::fit::ForceChannel> out;
  for (const auto& f : scene.force) {
    const auto& dimension = f.calibration ? dim::voltage : dim::force;
    ::fit::ForceChannel channel{f.column, turned(table.column(f.column, dimension), f.turned), {}};
    if (f.calibration) channel.calibration = calibration_of(*f.calibration, scene.confidence);
    // A channel that is turned round has its line through the same points with the voltage's sign changed.
    if (f.calibration && f.turned) channel.calibration->offset *= -1;
    if (scene.zero_run)
      channel.zero_run = turned(hydro::io::CsvTable::read(scene.zero_run->value).column(f.column, dimension), f.turned);
    out.push_back(std::move(channel));
  }
  return out;
}

::fit::RawRun raw_run(const scene::FitScene& scene, const hydro::io::CsvTable& table) {
  const auto channel = [&](const char* role, const hydro::Dimension& dimension) -> std::vector<double> {
    const auto at = scene.channels.find(role);
    if (at == scene.channels.end()) return {};
    return table.column(at->second, dimension);
  };
  return {.time = channel("time", dim::time),
          .force = force_channels(scene, table),
          .position = channel("position", dim::length),
          .velocity = channel("velocity", dim::velocity),
          .acceleration = channel("acceleration", dim::acceleration)};
}

::fit::FilterChoice filter_of(const scene::FitScene::Filter& f) {
  using Kind = ::fit::FilterChoice::Kind;
  const Kind kind = f.kind == "butterworth"      ? Kind::butterworth
                    : f.kind == "notch"          ? Kind::notch
                    : f.kind == "moving average" ? Kind::moving_average
                                                 : Kind::finite;
  return {.kind = kind, .order = f.order, .hz = f.hz, .width = f.width_hz, .seconds = f.seconds};
}

::fit::PrepareOptions options_of(const scene::FitScene::Prepare& p, double step) {
  ::fit::PrepareOptions out{.longest_gap_s = p.longest_gap,
                            .outlier_half_window = 0,
                            .outlier_deviations = p.outlier_deviations,
                            .delay_s = p.delay,
                            .derivative_bandwidth_hz = p.derivative_bandwidth};
  if (p.outlier_window > 0) out.outlier_half_window = std::max(2, static_cast<int>(p.outlier_window / (2 * step)));
  for (const auto& f : p.filters) out.filters.push_back(filter_of(f));
  using Kind = ::fit::WindowChoice::Kind;
  out.window = {.kind = p.window == "span"          ? Kind::span
                        : p.window == "full cycles" ? Kind::full_cycles
                                                    : Kind::all,
                .from = p.from,
                .to = p.to,
                .cycles = p.cycles,
                .tolerance = p.tolerance};
  return out;
}

/// Fits a prepared run, with its delay where that is to be estimated.
void fit_prepared(const scene::FitScene& scene, FitRun& run) {
  const auto& m = scene.model;
  const ::fit::MorisonOptions options{
      .confidence = scene.confidence,
      .cylinder_errors = {m.diameter_error, m.length_error, m.density_error, m.mass_error},
      .force_errors = run.prepared.force_errors,
      .delay_error_s = scene.prepare.delay_error};
  const auto cylinder = cylinder_of(scene);
  if (scene.prepare.longest_delay) {
    auto delayed = ::fit::fit_morison_and_delay(cylinder, run.prepared.record, *scene.prepare.longest_delay, options);
    run.fit = std::move(delayed.fit);
    run.prepared.record = std::move(delayed.aligned);
  } else {
    run.fit = ::fit::fit_morison(cylinder, run.prepared.record, options);
  }
  if (const std::string trouble = ::fit::sign_trouble(cylinder, run.fit); !trouble.empty())
    throw hydro::InputError(
        trouble, {},
        fmt::format("write force = \"-{}\" among the channels, or turn the motion", scene.force[0].column));
}

}  // namespace

::fit::Cylinder cylinder_of(const scene::FitScene& scene) {
  const auto& m = scene.model;
  return {.diameter = m.diameter,
          .length = m.length,
          .density = m.density,
          .viscosity = m.viscosity,
          .experiment = m.motion == "water moves" ? ::fit::Experiment::water_moves : ::fit::Experiment::body_moves,
          .mass_beyond_load_cells = m.mass_beyond_load_cells};
}

FitRun fit_run(const scene::FitScene& scene, const std::filesystem::path& file) {
  FitRun run;
  run.name = file.filename().string();
  const ::fit::RawRun raw = raw_run(scene, hydro::io::CsvTable::read(file));
  try {
    hydro::require(raw.time.size() >= 3, "a record needs at least three samples, got {}", raw.time.size());
    const double rough_step = (raw.time.back() - raw.time.front()) / static_cast<double>(raw.time.size() - 1);
    run.prepared = ::fit::prepare(raw, options_of(scene.prepare, rough_step));
    fit_prepared(scene, run);
  } catch (const hydro::InputError& e) {
    throw e.at({.file = file.string()});
  }
  for (const std::string& name : scene.coefficients)
    run.asked.push_back(name == "cd" ? run.fit.cd : ::fit::inertia_as(run.fit, name));
  return run;
}

void fit(const FitArguments& arguments, const Console& console) {
  const scene::FitScene scene = scene::read_fit(arguments.scene);
  if (arguments.output) hydro::io::require_writable(*arguments.output);
  if (arguments.picture) hydro::io::require_writable(*arguments.picture);
  if (scene.model.kind == "towing") return fit_towed(scene, arguments, console);
  std::vector<FitRun> runs;
  for (const auto& file : scene.files) runs.push_back(fit_run(scene, file.value));
  if (!console.json) tell_runs(scene, runs, console);
  deliver(arguments, console, runs_as_json(scene, runs), runs_figure(scene, runs));
}

}  // namespace froude
