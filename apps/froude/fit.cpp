#include <algorithm>
#include <cmath>

#include "froude/fit_report.hpp"
#include "froude/outputs.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using ::fit::Coefficient;

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
  std::optional<::fit::ProbeToBody> probe;
  if (const auto& wave = scene.model.wave)
    probe = {.water = {.density = scene.model.density, .gravity = wave->gravity, .depth = wave->depth},
             .level = wave->level,
             .ahead = wave->ahead,
             .regular = wave->regular,
             .follow = wave->follow};
  return {.time = channel("time", dim::time),
          .force = force_channels(scene, table),
          .position = channel("position", dim::length),
          .velocity = channel("velocity", dim::velocity),
          .acceleration = channel("acceleration", dim::acceleration),
          .cross_velocity = channel("cross_velocity", dim::velocity),
          .elevation = channel("elevation", dim::length),
          .probe = probe,
          .water_velocity = channel("water_velocity", dim::velocity),
          .water_acceleration = channel("water_acceleration", dim::acceleration)};
}

::fit::FilterChoice filter_of(const scene::FitScene::Filter& f) {
  using Kind = ::fit::FilterChoice::Kind;
  const Kind kind = f.kind == "butterworth"      ? Kind::butterworth
                    : f.kind == "notch"          ? Kind::notch
                    : f.kind == "moving average" ? Kind::moving_average
                                                 : Kind::finite;
  return {.kind = kind, .order = f.order, .hz = f.hz, .width = f.width_hz, .seconds = f.seconds};
}

::fit::PrepareOptions options_of(const scene::FitScene::Prepare& p, bool linear_drag, double step) {
  using ::fit::Derivative;
  ::fit::PrepareOptions out{.longest_gap_s = p.longest_gap,
                            .outlier_half_window = 0,
                            .outlier_deviations = p.outlier_deviations,
                            .resample_hz = p.resample_hz,
                            .delay_s = p.delay,
                            .derivative_bandwidth_hz = p.derivative_bandwidth,
                            .derivative = p.derivative_method == "smoothing spline" ? Derivative::smoothing_spline
                                          : p.derivative_method == "fourier series" ? Derivative::fourier_series
                                                                                    : Derivative::local_polynomial};
  out.outlier_half_window = outlier_half_window(p, step);
  for (const auto& f : p.filters) out.filters.push_back(filter_of(f));
  using Kind = ::fit::WindowChoice::Kind;
  out.window = {.kind = p.window == "span"          ? Kind::span
                        : p.window == "full cycles" ? Kind::full_cycles
                                                    : Kind::all,
                .from = p.from,
                .to = p.to,
                .cycles = p.cycles,
                .tolerance = p.tolerance};
  out.average_cycles = p.mean_cycle;
  out.linear_drag = linear_drag;
  return out;
}

::fit::IntervalMethod method_of(const std::string& name) {
  if (name == "cycle clusters") return ::fit::IntervalMethod::cycle_clusters;
  if (name == "block bootstrap") return ::fit::IntervalMethod::block_bootstrap;
  return ::fit::IntervalMethod::effective_samples;
}

/// Fits a prepared run, with its delay where that is to be estimated.
void fit_prepared(const scene::FitScene& scene, FitRun& run) {
  const auto& m = scene.model;
  std::vector<::fit::ForceLine> lines;
  for (const auto& line : m.lines) lines.push_back({line.hz, line.multiple});
  const ::fit::MorisonOptions options{
      .confidence = scene.confidence,
      .method = method_of(scene.interval_method),
      .force_offset = m.offset,
      .linear_drag = m.linear_drag,
      .lines = lines,
      .bands = true,
      .robust = scene.robust,
      .cylinder_errors = {m.diameter_error, m.length_error, m.density_error, m.mass_error},
      .force_errors = run.prepared.force_errors,
      .delay_error_s = scene.prepare.delay_error};
  if (scene.prepare.longest_delay) {
    auto delayed =
        ::fit::fit_morison_and_delay(run.cylinder, run.prepared.record, *scene.prepare.longest_delay, options);
    run.fit = std::move(delayed.fit);
    run.prepared.record = std::move(delayed.aligned);
  } else {
    run.fit = ::fit::fit_morison(run.cylinder, run.prepared.record, options);
  }
  if (const std::string trouble = ::fit::sign_trouble(run.cylinder, run.fit); !trouble.empty())
    throw hydro::InputError(
        trouble, {},
        fmt::format("write force = \"-{}\" among the channels, or turn the motion", scene.force[0].column));
}

/// The fit of one raw run as the scene has it.
FitRun fit_raw(const scene::FitScene& scene, ::fit::RawRun raw) {
  FitRun run;
  run.cylinder = cylinder_of(scene);
  hydro::require(raw.time.size() >= 3, "a record needs at least three samples, got {}", raw.time.size());
  const double rough_step = (raw.time.back() - raw.time.front()) / static_cast<double>(raw.time.size() - 1);
  run.prepared = ::fit::prepare(std::move(raw), options_of(scene.prepare, scene.model.linear_drag, rough_step));
  fit_prepared(scene, run);
  return run;
}

/// The same fit with another cutoff, another bandwidth, and half of the window.
void vary(const scene::FitScene& scene, const ::fit::RawRun& raw, FitRun& run) {
  const auto add = [&](const std::string& what, scene::FitScene other) {
    other.interval_method = "effective samples";  // values alone are asked, and half a window may hold few cycles
    const FitRun again = fit_raw(other, raw);
    const auto middle = [](const Coefficient& c) { return (c.interval.low + c.interval.high) / 2; };
    run.variants.push_back(
        {what, middle(again.fit.cd) - middle(run.fit.cd), middle(again.fit.inertia) - middle(run.fit.inertia)});
  };
  for (const double factor : {0.7, 1.4}) {
    for (std::size_t i = 0; i < scene.prepare.filters.size(); ++i) {
      if (scene.prepare.filters[i].kind != "butterworth" && scene.prepare.filters[i].kind != "symmetric weights")
        continue;
      scene::FitScene other = scene;
      other.prepare.filters[i].hz *= factor;
      add(fmt::format("low pass at {:.3g} Hz", other.prepare.filters[i].hz), other);
    }
    if (!raw.velocity.empty() && !raw.acceleration.empty()) continue;
    scene::FitScene other = scene;
    const double usual = 5 / run.fit.period;
    other.prepare.derivative_bandwidth =
        factor * (scene.prepare.derivative_bandwidth > 0 ? scene.prepare.derivative_bandwidth : usual);
    add(fmt::format("derivatives to {:.3g} Hz", other.prepare.derivative_bandwidth), other);
  }
  const auto& t = run.prepared.record.time;
  if (t.back() - t.front() < 4 * run.fit.period) return;  // two periods a half at least
  scene::FitScene half = scene;
  half.prepare.window = "span";
  half.prepare.mean_cycle = false;  // half a window is read as it is: it may hold a cycle or two
  for (const bool first : {true, false}) {
    const double middle = (t.front() + t.back()) / 2;
    half.prepare.from = first ? t.front() : middle;
    half.prepare.to = first ? middle : t.back();
    add(first ? "first half of the window" : "second half of the window", half);
  }
}

FitRun fit_run(const scene::FitScene& scene, const std::filesystem::path& file) try {
  ::fit::RawRun raw = raw_run(scene, hydro::io::CsvTable::read(file));
  FitRun run = scene.sensitivity ? fit_raw(scene, raw) : fit_raw(scene, std::move(raw));
  run.name = file.filename().string();
  const auto& r = run.prepared.record;
  Eigen::VectorXd residuals = Eigen::Map<const Eigen::VectorXd>(r.force.data(), std::ssize(r.force));
  const double rms = std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
  residuals -= Eigen::Map<const Eigen::VectorXd>(run.fit.fitted.data(), residuals.size());
  run.left = ::fit::look_at_residuals(residuals, rms, r.time[1] - r.time[0], run.fit.period);
  run.fourier = ::fit::fourier_averages(run.cylinder, r, run.fit.period);
  if (scene.cycles) run.cycles = ::fit::fit_cycles(run.cylinder, r, run.prepared.cycle_starts);
  if (scene.sensitivity) vary(scene, raw, run);
  for (const std::string& name : scene.coefficients)
    run.asked.push_back(name == "cd" ? run.fit.cd : ::fit::inertia_as(run.fit, name));
  return run;
} catch (const hydro::InputError& e) {
  throw e.at({.file = file.string()});
}

/// The scene with what one row of the table of runs says of its run.
scene::FitScene scene_of_row(const scene::FitScene& scene, const hydro::io::CsvTable& table, std::size_t row) {
  scene::FitScene one = scene;
  const auto take = [&](const char* column, const hydro::Dimension& dimension, double& value) {
    if (table.has(column)) value = table.column(column, dimension)[row];
  };
  take("diameter", dim::length, one.model.diameter);
  take("length", dim::length, one.model.length);
  take("density", dim::density, one.model.density);
  take("mass_beyond_load_cells", dim::mass, one.model.mass_beyond_load_cells);
  take("delay", dim::time, one.prepare.delay);
  if (table.has("viscosity")) one.model.viscosity = table.column("viscosity", dim::kinematic_viscosity)[row];
  if (table.has("zero"))
    one.zero_run = {{scene.run_table->value.parent_path() / table.text_column("zero")[row], scene.run_table->place}};
  return one;
}

std::vector<FitRun> fit_table(const scene::FitScene& scene) {
  const auto table = hydro::io::CsvTable::read(scene.run_table->value);
  std::vector<FitRun> runs;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    runs.push_back(fit_run(scene_of_row(scene, table, row),
                           scene.run_table->value.parent_path() / table.text_column("file")[row]));
    runs.back().labels = run_labels(
        table, row, {"file", "zero", "delay", "diameter", "length", "density", "viscosity", "mass_beyond_load_cells"});
  }
  return runs;
}

}  // namespace

RunLabels run_labels(const hydro::io::CsvTable& table, std::size_t row, const std::vector<std::string>& taken) {
  RunLabels out;
  for (const std::string& name : table.names())
    if (std::find(taken.begin(), taken.end(), name) == taken.end())
      out.push_back(
          {name, table.is_text(name) ? table.text_column(name)[row] : fmt::format("{:.6g}", table.column(name)[row])});
  return out;
}

int outlier_half_window(const scene::FitScene::Prepare& p, double step) {
  return p.outlier_window > 0 ? std::max(2, static_cast<int>(p.outlier_window / (2 * step))) : 0;
}

::fit::Cylinder cylinder_of(const scene::FitScene& scene) {
  const auto& m = scene.model;
  return {.diameter = m.diameter,
          .length = m.length,
          .density = m.density,
          .viscosity = m.viscosity,
          .experiment = m.motion == "water moves"  ? ::fit::Experiment::water_moves
                        : m.motion == "body moves" ? ::fit::Experiment::body_moves
                                                   : ::fit::Experiment::both_move,
          .mass_beyond_load_cells = m.mass_beyond_load_cells};
}

std::vector<FitRun> fit_all(const scene::FitScene& scene) {
  if (scene.run_table) return fit_table(scene);
  std::vector<FitRun> runs;
  for (const auto& file : scene.files) runs.push_back(fit_run(scene, file.value));
  return runs;
}

std::vector<FitLaw> laws_of(const scene::FitScene& scene, const std::vector<FitRun>& runs) {
  std::vector<FitLaw> out;
  if (scene.law.empty()) return out;
  for (std::size_t i = 0; i < scene.coefficients.size(); ++i) {
    FitLaw law{.coefficient = scene.coefficients[i], .laws = {}, .runs = 0, .left_out = 0};
    std::vector<::fit::RunEstimate> estimates;
    for (const FitRun& run : runs) {
      const Coefficient& c = run.asked[i];
      const double re = run.fit.re.value_or(0);
      if (c.value)
        estimates.push_back({*c.value, c.standard_error, run.fit.kc, re, re / run.fit.kc});
      else
        ++law.left_out;
    }
    law.runs = estimates.size();
    using ::fit::Law;
    if (scene.law == "best")
      law.laws = ::fit::compare_laws(estimates, scene.confidence);
    else
      law.laws = {::fit::fit_runs(estimates,
                                  scene.law == "constant" ? Law::constant
                                  : scene.law == "kc"     ? Law::kc
                                  : scene.law == "re"     ? Law::re
                                  : scene.law == "beta"   ? Law::beta
                                                          : Law::kc_and_re,
                                  scene.confidence)};
    out.push_back(std::move(law));
  }
  return out;
}

void fit(const FitArguments& arguments, const Console& console) {
  const scene::FitScene scene = scene::read_fit(arguments.scene);
  require_outputs(named({{"-o", arguments.output}, {"--table", arguments.table}, {"--picture", arguments.picture}}),
                  files_of_scene(arguments.scene));
  if (arguments.table && scene.model.kind != "morison" && scene.model.kind != "radiation" &&
      scene.model.kind != "decay")
    throw hydro::InputError(fmt::format("a fit of kind \"{}\" has no table of runs", scene.model.kind), {},
                            "leave out --table");
  if (scene.model.kind == "towing") return fit_towed(scene, arguments, console);
  if (scene.model.kind == "motion") return fit_motions(scene, arguments, console);
  if (scene.model.kind == "decay") return fit_decays(scene, arguments, console);
  if (scene.model.kind == "radiation") return fit_radiations(scene, arguments, console);
  if (scene.model.kind == "friction ramp") return fit_friction_ramps(scene, arguments, console);
  const std::vector<FitRun> runs = fit_all(scene);
  const std::vector<FitLaw> laws = laws_of(scene, runs);
  if (!console.json) tell_runs(scene, runs, console);
  if (!console.json) tell_laws(laws, console);
  if (arguments.table) hydro::io::write_atomically(*arguments.table, runs_table(runs));
  if (arguments.table && !console.json) console.out << "wrote " << arguments.table->string() << '\n';
  deliver(arguments, console, runs_as_json(scene, runs, laws), runs_figure(scene, runs, laws));
}

}  // namespace froude
