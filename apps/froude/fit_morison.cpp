#include <algorithm>
#include <cmath>

#include "froude/fit_morison.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using ::fit::Coefficient;
using Morison = scene::MorisonModel;

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

std::vector<::fit::ForceChannel> force_channels(const scene::FitScene& scene, const Morison& model,
                                                const hydro::io::CsvTable& table) {
  std::vector<::fit::ForceChannel> out;
  for (const auto& f : scene.force) {
    const auto& dimension = f.calibration ? dim::voltage : dim::force;
    ::fit::ForceChannel channel{f.column, turned(table.column(f.column, dimension), f.turned), {}};
    if (f.calibration) channel.calibration = calibration_of(*f.calibration, scene.confidence);
    // A channel that is turned round has its line through the same points with the voltage's sign changed.
    if (f.calibration && f.turned) channel.calibration->offset *= -1;
    if (model.zero_run)
      channel.zero_run = turned(hydro::io::CsvTable::read(model.zero_run->value).column(f.column, dimension), f.turned);
    out.push_back(std::move(channel));
  }
  return out;
}

::fit::RawRun raw_run(const scene::FitScene& scene, const Morison& model, const hydro::io::CsvTable& table) {
  const auto channel = [&](const char* role, const hydro::Dimension& dimension) -> std::vector<double> {
    const auto at = scene.channels.find(role);
    if (at == scene.channels.end()) return {};
    return table.column(at->second, dimension);
  };
  return {.time = channel("time", dim::time),
          .force = force_channels(scene, model, table),
          .position = channel("position", dim::length),
          .velocity = channel("velocity", dim::velocity),
          .acceleration = channel("acceleration", dim::acceleration),
          .cross_velocity = channel("cross_velocity", dim::velocity),
          .elevation = channel("elevation", dim::length),
          .probe = model.probe,
          .water_velocity = channel("water_velocity", dim::velocity),
          .water_acceleration = channel("water_acceleration", dim::acceleration)};
}

/// The fit of one raw run, with its delay where that is to be estimated.
MorisonRun fit_raw(const Morison& model, const std::string& force, ::fit::RawRun raw) {
  MorisonRun run;
  run.cylinder = model.cylinder;
  run.prepared = ::fit::prepare(std::move(raw), model.prepare);
  ::fit::MorisonOptions options = model.options;
  options.force_errors = run.prepared.force_errors;
  if (model.longest_delay) {
    auto delayed = ::fit::fit_morison_and_delay(run.cylinder, run.prepared.record, *model.longest_delay, options);
    run.fit = std::move(delayed.fit);
    run.prepared.record = std::move(delayed.aligned);
  } else {
    run.fit = ::fit::fit_morison(run.cylinder, run.prepared.record, options);
  }
  if (const std::string trouble = ::fit::sign_trouble(run.cylinder, run.fit); !trouble.empty())
    throw hydro::InputError(trouble, {},
                            fmt::format("write force = \"-{}\" among the channels, or turn the motion", force));
  return run;
}

/// The same fit with another cutoff, another bandwidth, and half of the window.
void vary(const Morison& model, const std::string& force, const ::fit::RawRun& raw, MorisonRun& run) {
  const auto add = [&](const std::string& what, Morison other) {
    // Values alone are asked, and half a window may hold few cycles.
    other.options.method = ::fit::IntervalMethod::effective_samples;
    const MorisonRun again = fit_raw(other, force, raw);
    const auto middle = [](const Coefficient& c) { return (c.interval.low + c.interval.high) / 2; };
    run.variants.push_back(
        {what, middle(again.fit.cd) - middle(run.fit.cd), middle(again.fit.inertia) - middle(run.fit.inertia)});
  };
  using Filter = ::fit::FilterChoice::Kind;
  for (const double factor : {0.7, 1.4}) {
    for (std::size_t i = 0; i < model.prepare.filters.size(); ++i) {
      if (const Filter kind = model.prepare.filters[i].kind; kind != Filter::butterworth && kind != Filter::finite)
        continue;
      Morison other = model;
      other.prepare.filters[i].hz *= factor;
      add(fmt::format("low pass at {:.3g} Hz", other.prepare.filters[i].hz), other);
    }
    if (!raw.velocity.empty() && !raw.acceleration.empty()) continue;
    Morison other = model;
    const double usual = 5 / run.fit.period, chosen = model.prepare.derivative_bandwidth_hz;
    other.prepare.derivative_bandwidth_hz = factor * (chosen > 0 ? chosen : usual);
    add(fmt::format("derivatives to {:.3g} Hz", other.prepare.derivative_bandwidth_hz), other);
  }
  const auto& t = run.prepared.record.time;
  if (t.back() - t.front() < 4 * run.fit.period) return;  // two periods a half at least
  Morison half = model;
  half.prepare.window.kind = ::fit::WindowChoice::Kind::span;
  half.prepare.average_cycles = false;  // half a window is read as it is: it may hold a cycle or two
  for (const bool first : {true, false}) {
    const double middle = (t.front() + t.back()) / 2;
    half.prepare.window.from = first ? t.front() : middle;
    half.prepare.window.to = first ? middle : t.back();
    add(first ? "first half of the window" : "second half of the window", half);
  }
}

MorisonRun fit_run(const scene::FitScene& scene, const Morison& model, const std::filesystem::path& file) try {
  ::fit::RawRun raw = raw_run(scene, model, hydro::io::CsvTable::read(file));
  const std::string& force = scene.force[0].column;
  MorisonRun run = model.sensitivity ? fit_raw(model, force, raw) : fit_raw(model, force, std::move(raw));
  run.name = file.filename().string();
  const auto& r = run.prepared.record;
  Eigen::VectorXd residuals = Eigen::Map<const Eigen::VectorXd>(r.force.data(), std::ssize(r.force));
  const double rms = std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
  residuals -= Eigen::Map<const Eigen::VectorXd>(run.fit.fitted.data(), residuals.size());
  run.left = ::fit::look_at_residuals(residuals, rms, r.time[1] - r.time[0], run.fit.period);
  run.fourier = ::fit::fourier_averages(run.cylinder, r, run.fit.period);
  if (model.cycles) run.cycles = ::fit::fit_cycles(run.cylinder, r, run.prepared.cycle_starts);
  if (model.sensitivity) vary(model, force, raw, run);
  for (const std::string& name : model.coefficients)
    run.asked.push_back(name == "cd" ? run.fit.cd : ::fit::inertia_as(run.fit, name));
  return run;
} catch (const hydro::InputError& e) {
  throw e.at({.file = file.string()});
}

/// The model with what one row of the table of runs says of its run.
Morison model_of_row(const Morison& model, const scene::Located<std::filesystem::path>& place,
                     const hydro::io::CsvTable& table, std::size_t row) {
  Morison one = model;
  const auto take = [&](const char* column, const hydro::Dimension& dimension, auto& value) {
    if (table.has(column)) value = table.column(column, dimension)[row];
  };
  take("diameter", dim::length, one.cylinder.diameter);
  take("length", dim::length, one.cylinder.length);
  take("density", dim::density, one.cylinder.density);
  take("mass_beyond_load_cells", dim::mass, one.cylinder.mass_beyond_load_cells);
  take("viscosity", dim::kinematic_viscosity, one.cylinder.viscosity);
  take("delay", dim::time, one.prepare.delay_s);
  if (table.has("zero")) one.zero_run = {{place.value.parent_path() / table.text_column("zero")[row], place.place}};
  return one;
}

std::vector<MorisonRun> fit_table(const scene::FitScene& scene, const Morison& model) {
  const auto table = hydro::io::CsvTable::read(scene.run_table->value);
  std::vector<MorisonRun> runs;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    runs.push_back(fit_run(scene, model_of_row(model, *scene.run_table, table, row),
                           scene.run_table->value.parent_path() / table.text_column("file")[row]));
    runs.back().labels = run_labels(
        table, row, {"file", "zero", "delay", "diameter", "length", "density", "viscosity", "mass_beyond_load_cells"});
  }
  return runs;
}

std::vector<MorisonRun> fit_all(const scene::FitScene& scene, const Morison& model) {
  if (scene.run_table) return fit_table(scene, model);
  std::vector<MorisonRun> runs;
  for (const auto& file : scene.files) runs.push_back(fit_run(scene, model, file.value));
  return runs;
}

std::vector<CoefficientLaw> laws_of(const Morison& model, const std::vector<MorisonRun>& runs) {
  std::vector<CoefficientLaw> out;
  if (!model.law) return out;
  const double confidence = model.options.confidence;
  for (std::size_t i = 0; i < model.coefficients.size(); ++i) {
    CoefficientLaw law{.coefficient = model.coefficients[i], .laws = {}, .runs = 0, .left_out = 0};
    std::vector<::fit::RunEstimate> estimates;
    for (const MorisonRun& run : runs) {
      const Coefficient& c = run.asked[i];
      const double re = run.fit.re.value_or(0);
      if (c.value)
        estimates.push_back({*c.value, c.standard_error, run.fit.kc, re, re / run.fit.kc});
      else
        ++law.left_out;
    }
    law.runs = estimates.size();
    if (model.law->only)
      law.laws = {::fit::fit_runs(estimates, *model.law->only, confidence)};
    else
      law.laws = ::fit::compare_laws(estimates, confidence);
    out.push_back(std::move(law));
  }
  return out;
}

}  // namespace

FitOutcome fit_model(const scene::FitScene& scene, const scene::MorisonModel& model) {
  const std::vector<MorisonRun> runs = fit_all(scene, model);
  const std::vector<CoefficientLaw> laws = laws_of(model, runs);
  return {summary_of(scene, model, runs, laws), runs_figure(scene, runs, laws), runs_table(runs)};
}

}  // namespace froude
