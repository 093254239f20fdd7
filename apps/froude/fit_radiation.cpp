#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/forced_radiation.hpp"
#include "froude/fit_report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using ::fit::Coefficient;
using Json = FitJson;
constexpr std::size_t least_for_poles = 5;

struct RadiationRun {
  std::string name;
  ::fit::RadiationPoint point;
};

/// Units of what is told, of a translation or a turn.
struct RadiationUnits {
  const char *motion, *force, *added_mass, *damping;
};
RadiationUnits units_of(bool angle) {
  if (angle) return {"rad", "N m", "kg m^2", "N m s/rad"};
  return {"m", "N", "kg", "N s/m"};
}

RadiationRun fit_run_of(const scene::FitScene& scene, const ::fit::RestoredBody& body,
                        const std::filesystem::path& file) try {
  const bool angle = scene.turns();
  const auto table = hydro::io::CsvTable::read(file);
  const auto& motion = angle ? table.column(scene.channels.at("angle"), dim::angle)
                             : table.column(scene.channels.at("position"), dim::length);
  std::vector<double> force =
      angle ? table.column(scene.channels.at("torque"), dim::moment) : table.column(scene.force[0].column, dim::force);
  if (!angle && scene.force[0].turned)
    for (double& f : force) f = -f;
  return {file.filename().string(), ::fit::fit_radiation(table.column(scene.channels.at("time"), dim::time), motion,
                                                         force, body, scene.confidence)};
} catch (const hydro::InputError& e) {
  throw e.at({.file = file.string()});
}

std::optional<::fit::RadiationMemory> memory_of(const std::vector<RadiationRun>& runs, double confidence) {
  if (runs.size() < least_for_poles) return {};
  std::vector<::fit::RadiationPoint> points;
  for (const RadiationRun& run : runs) points.push_back(run.point);
  return ::fit::fit_radiation_memory(points, confidence);
}

void tell(const RadiationRun& run, const RadiationUnits& unit, double confidence, const Console& console) {
  const auto& p = run.point;
  console.out << fmt::format(
      "{}: {:.4g} rad/s, amplitude {:.4g} {}; harmonics of the force: second {:.2g} %, third {:.2g} %; rest {:.3g} {} "
      "rms\n",
      run.name, p.omega, p.amplitude, unit.motion, 100 * p.second_harmonic, 100 * p.third_harmonic, p.residual_rms,
      unit.force);
  for (const auto& [c, in] : {std::pair{&p.added_mass, unit.added_mass}, {&p.damping, unit.damping}})
    console.out << fmt::format("  {:<10} {:.5g} {}, {:g} % interval {:.5g} to {:.5g}\n", c->name, *c->value, in,
                               100 * confidence, c->interval.low, c->interval.high);
  if (!p.caution.empty()) console.out << "  caution: " << p.caution << '\n';
}

void tell(const ::fit::RadiationMemory& m, const RadiationUnits& unit, double confidence, const Console& console) {
  const auto& r = m.poles.report;
  if (!m.refused.empty()) {
    console.out << fmt::format("memory: none: {}\n", m.refused);
    return;
  }
  console.out << fmt::format(
      "memory: order {}, {}; differs from the points by {:.2g} of the largest damping, they are known to {:.2g}; {}\n",
      r.order, r.why, r.error, m.tolerance, r.passive ? "passive" : "not certified passive");
  if (m.limit.value)
    console.out << fmt::format("  added mass at infinite frequency {:.5g} {}, {:g} % interval {:.5g} to {:.5g}\n",
                               *m.limit.value, unit.added_mass, 100 * confidence, m.limit.interval.low,
                               m.limit.interval.high);
  else
    console.out << fmt::format("  added mass at infinite frequency {:.5g} {}, without interval: {}\n",
                               m.poles.A_inf(0, 0), unit.added_mass, m.limit.why_not);
  for (const auto& pole : m.poles.model.poles)
    console.out << fmt::format("  pole: decays by {:.4g}/s, turns by {:.4g} rad/s\n", pole.decay, pole.omega);
}

Json as_json_of(const scene::FitScene& scene, const std::vector<RadiationRun>& runs,
                const std::optional<::fit::RadiationMemory>& memory) {
  Json j{{"scene", scene.file.filename().string()}, {"kind", scene.kind()}, {"confidence", scene.confidence}};
  const auto put = [](Json& at, const Coefficient& c) {
    at[c.name] = as_json(c);
    for (const char* of_series : {"shift_per_degree", "effective_samples", "interval_if_independent"})
      at[c.name].erase(of_series);
  };
  if (runs.size() == 1)
    j["coefficients"] = {{"added_mass", *runs[0].point.added_mass.value}, {"damping", *runs[0].point.damping.value}};
  if (memory && !memory->refused.empty()) j["memory"] = {{"why_not", memory->refused}};
  if (memory && memory->refused.empty()) {
    const auto& m = memory->poles;
    j["memory"] = {{"order", m.report.order},     {"error", m.report.error},           {"known_to", memory->tolerance},
                   {"passive", m.report.passive}, {"added_mass_limit", m.A_inf(0, 0)}, {"why", m.report.why}};
    if (memory->limit.value)
      j["memory"]["added_mass_limit_interval"] = {memory->limit.interval.low, memory->limit.interval.high};
    for (std::size_t k = 0; k < m.model.poles.size(); ++k)
      j["memory"]["pole"].push_back({{"decay_1_s", m.model.poles[k].decay},
                                     {"omega_rad_s", m.model.poles[k].omega},
                                     {"cosine", m.model.C[k](0, 0)},
                                     {"sine", m.model.S[k](0, 0)}});
  }
  for (const RadiationRun& run : runs) {
    Json r{{"file", run.name},
           {"omega_rad_s", run.point.omega},
           {"amplitude", run.point.amplitude},
           {"second_harmonic", run.point.second_harmonic},
           {"third_harmonic", run.point.third_harmonic},
           {"residual_rms", run.point.residual_rms}};
    if (!run.point.caution.empty()) r["caution"] = run.point.caution;
    put(r, run.point.added_mass);
    put(r, run.point.damping);
    j["run"].push_back(r);
  }
  return j;
}

std::string table_of(const std::vector<RadiationRun>& runs, const RadiationUnits& unit) {
  std::string out = fmt::format(
      "file,omega [rad/s],amplitude [{0}],added_mass [{1}],added_mass_low [{1}],added_mass_high [{1}],damping "
      "[{2}],damping_low [{2}],damping_high [{2}]\n",
      unit.motion, unit.added_mass, unit.damping);
  for (const RadiationRun& run : runs) {
    const auto& p = run.point;
    out += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", run.name, p.omega, p.amplitude,
                       *p.added_mass.value, p.added_mass.interval.low, p.added_mass.interval.high, *p.damping.value,
                       p.damping.interval.low, p.damping.interval.high);
  }
  return out;
}

/// Points with their intervals, and the curve of the poles.
plot::Panel panel_of(const std::vector<RadiationRun>& runs, const std::optional<::fit::RadiationMemory>& memory,
                     bool damping, const char* unit, double confidence) {
  plot::Series points{"measured", {}, {}, false, true}, bars{fmt::format("{:g} % interval", 100 * confidence), {}, {}};
  double highest = 0;
  for (const RadiationRun& run : runs) {
    const Coefficient& c = damping ? run.point.damping : run.point.added_mass;
    points.x.push_back(run.point.omega);
    points.y.push_back(*c.value);
    for (const double y : {c.interval.low, c.interval.high, std::numeric_limits<double>::quiet_NaN()}) {
      bars.x.push_back(run.point.omega);
      bars.y.push_back(y);
    }
    highest = std::max(highest, run.point.omega);
  }
  plot::Panel panel{
      .x = {"frequency", "rad/s"}, .y = {damping ? "damping" : "added mass", unit}, .series = {points, bars}};
  if (!memory || !memory->refused.empty()) return panel;
  plot::Series curve{"poles", {}, {}, true, false, true};
  for (int k = 1; k <= 200; ++k) {
    const double omega = 1.2 * highest * k / 200;
    const auto value = memory->poles.model.transform(omega)(0, 0);
    curve.x.push_back(omega);
    curve.y.push_back(damping ? value.real() : memory->poles.A_inf(0, 0) + value.imag() / omega);
  }
  panel.series.push_back(curve);
  return panel;
}

}  // namespace

void fit_model(const scene::FitScene& scene, const scene::RadiationModel& model, const FitArguments& arguments,
               const Console& console) {
  const RadiationUnits unit = units_of(scene.turns());
  std::vector<RadiationRun> runs;
  for (const auto& file : scene.files) runs.push_back(fit_run_of(scene, model.body, file.value));
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.point.omega < b.point.omega; });
  const auto memory = memory_of(runs, scene.confidence);
  if (!console.json) {
    console.out << "F = -(M + A) a - B v - C x, what the load cells carry of a body moved in still water\n";
    for (const RadiationRun& run : runs) tell(run, unit, scene.confidence, console);
    if (memory) tell(*memory, unit, scene.confidence, console);
  }
  if (arguments.table) hydro::io::write_atomically(*arguments.table, table_of(runs, unit));
  if (arguments.table && !console.json) console.out << "wrote " << arguments.table->string() << '\n';
  deliver(arguments, console, as_json_of(scene, runs, memory),
          {.title = scene.title.empty() ? scene.file.filename().string() : scene.title,
           .panels = {panel_of(runs, memory, false, unit.added_mass, scene.confidence),
                      panel_of(runs, memory, true, unit.damping, scene.confidence)}});
}

}  // namespace froude
