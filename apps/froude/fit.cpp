#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/differentiate.hpp"
#include "fit/morison.hpp"
#include "fit/towing.hpp"
#include "froude/commands.hpp"
#include "froude/plot.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "scene/scene.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using fit::Coefficient;
using Json = nlohmann::ordered_json;  // results keep the order in which they are told

/// One file of a Morison fit.
struct Run {
  std::string name;  ///< of the file
  ::fit::ForceRecord record;
  std::optional<::fit::Motion> motion;  ///< where derivatives had to be taken
  std::string derivatives;              ///< how, in one sentence; empty where both were measured
  ::fit::MorisonFit fit;
  std::vector<Coefficient> asked;
};

::fit::Cylinder cylinder_of(const scene::FitScene& scene) {
  const auto& m = scene.model;
  return {.diameter = m.diameter,
          .length = m.length,
          .density = m.density,
          .viscosity = m.viscosity,
          .experiment = m.motion == "water moves" ? ::fit::Experiment::water_moves : ::fit::Experiment::body_moves,
          .mass_beyond_load_cells = m.mass_beyond_load_cells};
}

// ---- oscillation ----

std::vector<double> middle(const std::vector<double>& v, const ::fit::Motion& motion) {
  const auto first = v.begin() + static_cast<std::ptrdiff_t>(motion.first);
  return {first, first + static_cast<std::ptrdiff_t>(motion.velocity.size())};
}

/// Velocity and acceleration, measured where the scene names a channel, differentiated where it does not.
void add_motion(const scene::FitScene& scene, const hydro::io::CsvTable& table, Run& run) {
  const auto channel = [&](const char* role) { return scene.channels.find(role); };
  const auto none = scene.channels.end();
  const auto velocity = channel("velocity"), acceleration = channel("acceleration"), position = channel("position");
  if (velocity != none && acceleration != none) {
    run.record.velocity = table.column(velocity->second, dim::velocity);
    run.record.acceleration = table.column(acceleration->second, dim::acceleration);
    return;
  }
  if (velocity == none && position == none)
    throw hydro::InputError("drag needs the velocity, and an acceleration alone does not give it: its integral drifts",
                            scene.model.place, "name a velocity or a position among the channels");
  const double step = hydro::signal::even_step(run.record.time);
  const bool from_velocity = velocity != none;
  run.motion = from_velocity ? ::fit::from_velocity(table.column(velocity->second, dim::velocity), step)
                             : ::fit::from_position(table.column(position->second, dim::length), step);
  const ::fit::Motion& m = *run.motion;
  run.record.velocity = m.velocity;
  run.record.acceleration =
      acceleration != none ? middle(table.column(acceleration->second, dim::acceleration), m) : m.acceleration;
  run.record.time = middle(run.record.time, m);
  run.record.force = middle(run.record.force, m);
  run.derivatives = fmt::format(
      "derivatives of the {} by local polynomials of degree 4 over {} samples (no delay): 1 % to {:.3g} Hz, {:.2g} % "
      "at the main "
      "frequency; noise of velocity {:.2g} m/s, of acceleration {:.2g} m/s^2",
      from_velocity ? "velocity" : "position", 2 * m.half_width + 1, m.bandwidth_hz, 100 * m.gain_error_main,
      m.noise_velocity, m.noise_acceleration);
}

Run fit_run(const scene::FitScene& scene, const Path& file) {
  Run run;
  run.name = file.filename().string();
  const auto table = hydro::io::CsvTable::read(file);
  run.record.time = table.column(scene.channels.at("time"), dim::time);
  run.record.force = table.column(scene.channels.at("force"), dim::force);
  try {
    add_motion(scene, table, run);
    run.fit = ::fit::fit_morison(cylinder_of(scene), run.record, {.confidence = scene.confidence});
  } catch (const hydro::InputError& e) {
    throw e.at({.file = file.string()});
  }
  for (const std::string& name : scene.coefficients)
    run.asked.push_back(name == "cd" ? run.fit.cd : ::fit::inertia_as(run.fit, name));
  return run;
}

// ---- telling ----

std::string sentence(const Coefficient& c, double confidence, std::size_t samples) {
  const std::string worth = fmt::format("worth {:.0f} of {} samples; if they were independent: {:.4g} to {:.4g}",
                                        c.effective_samples, samples, c.white_interval.low, c.white_interval.high);
  if (!c.value)
    return fmt::format("  {:<3} not identifiable: {} ({:g} % interval {:.4g} to {:.4g}; {})\n", c.name, c.why_not,
                       100 * confidence, c.interval.low, c.interval.high, worth);
  return fmt::format(
      "  {:<3} {:.4g}, {:g} % interval {:.4g} to {:.4g} ({})\n      a force 1 degree late would shift it by {:.2g}\n",
      c.name, *c.value, 100 * confidence, c.interval.low, c.interval.high, worth, c.shift_per_degree);
}

void tell(const scene::FitScene& scene, const std::vector<Run>& runs, const Console& console) {
  const bool water = scene.model.motion == "water moves";
  console.out << (water ? "F = cm rho V du/dt + 1/2 rho D L cd |u| u, water moving past the body; cm = 1 + ca\n"
                        : "F = -(ca rho V + m) a - 1/2 rho D L cd |v| v, body moving in still water; cm = 1 + ca\n");
  for (const Run& run : runs) {
    const auto& f = run.fit;
    console.out << fmt::format(
        "{}: KC {:.4g}, {}T {:.4g} s, residual {:.4g} N rms, {:.2f} % of the force's variance explained\n", run.name,
        f.kc, f.re ? fmt::format("Re {:.4g}, ", *f.re) : "", f.period, f.residual_rms, 100 * f.explained);
    for (const Coefficient& c : run.asked) console.out << sentence(c, f.confidence, f.samples);
    console.out << fmt::format("  search: iterations {}, {}; singular values {:.3g} and {:.3g}; {}\n",
                               f.search.iterations, f.search.why, f.search.singular_values[0],
                               f.search.singular_values[1], f.search.identifiability);
    if (!run.derivatives.empty()) console.out << "  " << run.derivatives << '\n';
    if (!f.caution.empty()) console.out << "  caution: " << f.caution << '\n';
  }
}

void tell(const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs, const Console& console) {
  console.out << fmt::format("C_D = F/(1/2 rho U^2 D L)\n{:>10} {:>10} {:>10} {:>8} {:>8}\n", "U [m/s]", "F [N]", "Re",
                             "cd", "+-");
  for (std::size_t i = 0; i < runs.size(); ++i)
    console.out << fmt::format(
        "{:>10.4g} {:>10.4g} {:>10} {:>8.3f} {:>8}\n", runs[i].speed, runs[i].force,
        fit.points[i].re ? fmt::format("{:.3g}", *fit.points[i].re) : "-", fit.points[i].cd,
        fit.points[i].cd_deviation > 0 ? fmt::format("{:.3f}", fit.points[i].cd_deviation) : "-");
  console.out << fmt::format("together: cd {:.4f}, {:g} % interval {:.4f} to {:.4f}\n", *fit.cd.value,
                             100 * fit.confidence, fit.cd.interval.low, fit.cd.interval.high);
  if (std::isfinite(fit.scatter))
    console.out << fmt::format("the runs scatter {:.2f} times as much as their deviations say{}\n", fit.scatter,
                               fit.scatter > 1 ? "; the interval is widened by as much" : "");
}

// ---- writing ----

Json as_json(const Coefficient& c) {
  Json j{{"identifiable", c.value.has_value()},
         {"standard_error", c.standard_error},
         {"interval", {c.interval.low, c.interval.high}},
         {"interval_if_independent", {c.white_interval.low, c.white_interval.high}},
         {"effective_samples", c.effective_samples},
         {"shift_per_degree", c.shift_per_degree}};
  if (c.value) j["value"] = *c.value;
  if (!c.why_not.empty()) j["why_not"] = c.why_not;
  return j;
}

Json as_json(const scene::FitScene& scene, const std::vector<Run>& runs) {
  Json j{{"scene", scene.file.filename().string()},
         {"kind", "morison"},
         {"motion", scene.model.motion},
         {"confidence", scene.confidence},
         {"run", Json::array()}};
  for (const Run& run : runs) {
    Json r{{"file", run.name},
           {"kc", run.fit.kc},
           {"period_s", run.fit.period},
           {"residual_rms_N", run.fit.residual_rms},
           {"explained", run.fit.explained},
           {"samples", run.fit.samples},
           {"iterations", run.fit.search.iterations},
           {"search", run.fit.search.why},
           {"identifiability", run.fit.search.identifiability}};
    if (run.fit.re) r["re"] = *run.fit.re;
    if (!run.derivatives.empty()) r["derivatives"] = run.derivatives;
    if (!run.fit.caution.empty()) r["caution"] = run.fit.caution;
    for (const Coefficient& c : run.asked) r[c.name] = as_json(c);
    j["run"].push_back(r);
  }
  return j;
}

Json as_json(const scene::FitScene& scene, const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs) {
  Json cd = as_json(fit.cd);
  for (const char* time_series_only : {"effective_samples", "shift_per_degree", "interval_if_independent"})
    cd.erase(time_series_only);
  Json j{{"scene", scene.file.filename().string()},
         {"kind", "towing"},
         {"confidence", scene.confidence},
         {"cd", cd},
         {"run", Json::array()}};
  if (std::isfinite(fit.scatter)) j.update({{"chi_square", fit.chi_square}, {"scatter", fit.scatter}});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Json r{{"speed", runs[i].speed},
           {"force", runs[i].force},
           {"cd", fit.points[i].cd},
           {"cd_deviation", fit.points[i].cd_deviation}};
    if (fit.points[i].re) r["re"] = *fit.points[i].re;
    j["run"].push_back(r);
  }
  return j;
}

/// A JSON value as TOML; a string of JSON is a basic string of TOML, and a float stays a float.
std::string toml_value(const Json& value) {
  if (value.is_array()) {
    std::vector<std::string> parts;
    for (const auto& part : value) parts.push_back(toml_value(part));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (!value.is_number_float()) return value.dump();
  const std::string text = fmt::format("{}", value.get<double>());
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

void append_toml(std::string& out, const std::string& path, const Json& table) {
  for (const auto& [key, value] : table.items())
    if (!value.is_object() && !(value.is_array() && !value.empty() && value[0].is_object()))
      out += key + " = " + toml_value(value) + "\n";
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [key, value] : table.items()) {
    if (value.is_object()) {
      out += fmt::format("\n[{}{}]\n", prefix, key);
      append_toml(out, prefix + key, value);
    } else if (value.is_array() && !value.empty() && value[0].is_object()) {
      for (const auto& entry : value) {
        out += fmt::format("\n[[{}{}]]\n", prefix, key);
        append_toml(out, prefix + key, entry);
      }
    }
  }
}

void write_toml(const Path& path, const Json& results) {
  std::string out = fmt::format("# Estimates of `froude fit`, version {}. SI units.\n", FROUDE_VERSION);
  append_toml(out, "", results);
  hydro::io::write_atomically(path, out);
}

/// Measured and fitted force, the last five periods of each run.
plot::Figure figure(const scene::FitScene& scene, const std::vector<Run>& runs) {
  plot::Figure f{.title = scene.title.empty() ? scene.file.filename().string() : scene.title, .panels = {}};
  for (const Run& run : runs) {
    const auto& r = run.record;
    const auto from =
        std::lower_bound(r.time.begin(), r.time.end(), r.time.back() - 5 * run.fit.period) - r.time.begin();
    const auto tail = [&](const std::vector<double>& v) { return std::vector<double>(v.begin() + from, v.end()); };
    f.panels.push_back({.x = {"time", "s"},
                        .y = {"force", "N"},
                        .series = {{run.name + ": measured", tail(r.time), tail(r.force)},
                                   {"fitted", tail(r.time), tail(run.fit.fitted), true, false, true}}});
  }
  return f;
}

plot::Figure figure(const scene::FitScene& scene, const ::fit::TowingFit& fit, std::span<const ::fit::TowingRun> runs) {
  plot::Series points{"runs", {}, {}, false, true};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    points.x.push_back(runs[i].speed);
    points.y.push_back(fit.points[i].cd);
  }
  const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
  const std::vector<double> ends{*low, *high};
  return {.title = scene.title.empty() ? scene.file.filename().string() : scene.title,
          .panels = {{.x = {"speed", "m/s"},
                      .y = {"C_D"},
                      .series = {points, {"together", ends, {*fit.cd.value, *fit.cd.value}}},
                      .bands = {{fmt::format("{:g} %", 100 * fit.confidence),
                                 ends,
                                 {fit.cd.interval.low, fit.cd.interval.low},
                                 {fit.cd.interval.high, fit.cd.interval.high}}}}}};
}

// ---- the two kinds ----

std::vector<::fit::TowingRun> towing_runs(const scene::FitScene& scene) {
  std::vector<::fit::TowingRun> runs;
  for (const auto& file : scene.files) {
    const auto table = hydro::io::CsvTable::read(file.value);
    const std::vector<double> unknown(table.rows(), 0.0);
    const auto column = [&](const char* role, const hydro::Dimension& dimension) -> const std::vector<double>& {
      const auto at = scene.channels.find(role);
      return at == scene.channels.end() ? unknown : table.column(at->second, dimension);
    };
    const auto &speed = column("speed", dim::velocity), &speed_sd = column("speed_sd", dim::velocity);
    const auto &force = column("force", dim::force), &force_sd = column("force_sd", dim::force);
    for (std::size_t i = 0; i < table.rows(); ++i) runs.push_back({speed[i], speed_sd[i], force[i], force_sd[i]});
  }
  return runs;
}

void deliver(const FitArguments& arguments, const Console& console, const Json& results, const plot::Figure& picture) {
  if (arguments.output) write_toml(*arguments.output, results);
  if (arguments.picture) hydro::io::write_atomically(*arguments.picture, plot::svg(picture));
  if (console.json) {
    console.out << results.dump(1) << '\n';
    return;
  }
  if (arguments.output) console.out << "wrote " << arguments.output->string() << '\n';
  if (arguments.picture) console.out << "wrote " << arguments.picture->string() << '\n';
}

}  // namespace

void fit(const FitArguments& arguments, const Console& console) {
  const scene::FitScene scene = scene::read_fit(arguments.scene);
  if (arguments.output) hydro::io::require_writable(*arguments.output);
  if (arguments.picture) hydro::io::require_writable(*arguments.picture);
  if (scene.model.kind == "towing") {
    const auto runs = towing_runs(scene);
    const auto result = ::fit::fit_towing(cylinder_of(scene), runs, scene.confidence);
    if (!console.json) tell(result, runs, console);
    deliver(arguments, console, as_json(scene, result, runs), figure(scene, result, runs));
    return;
  }
  std::vector<Run> runs;
  for (const auto& file : scene.files) runs.push_back(fit_run(scene, file.value));
  if (!console.json) tell(scene, runs, console);
  deliver(arguments, console, as_json(scene, runs), figure(scene, runs));
}

}  // namespace froude
