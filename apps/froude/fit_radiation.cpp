#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/forced_radiation.hpp"
#include "froude/fit_summary.hpp"
#include "hydro/base/error.hpp"
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

FitSummary summary_of(const RadiationRun& run, const RadiationUnits& unit) {
  const auto& p = run.point;
  FitSummary summary{.key = "run", .one_of_many = true};
  summary.heading = fmt::format(
      "{}: {:.4g} rad/s, amplitude {:.4g} {}; harmonics of the force: second {:.2g} %, third {:.2g} %; rest {:.3g} {} "
      "rms",
      run.name, p.omega, p.amplitude, unit.motion, 100 * p.second_harmonic, 100 * p.third_harmonic, p.residual_rms,
      unit.force);
  summary.facts = {{"file", run.name},
                   {"omega_rad_s", p.omega},
                   {"amplitude", p.amplitude},
                   {"second_harmonic", p.second_harmonic},
                   {"third_harmonic", p.third_harmonic},
                   {"residual_rms", p.residual_rms}};
  summary.estimates = {{p.added_mass, unit.added_mass}, {p.damping, unit.damping}};
  summary.warn(p.caution);
  return summary;
}

FitSummary summary_of(const ::fit::RadiationMemory& m, const RadiationUnits& unit, double confidence) {
  FitSummary summary{.key = "memory"};
  if (!m.refused.empty()) {
    summary.heading = "memory: none: " + m.refused;
    summary.facts["why_not"] = m.refused;
    return summary;
  }
  const auto& r = m.poles.report;
  const double limit = m.poles.A_inf(0, 0);
  summary.heading = fmt::format(
      "memory: order {}, {}; differs from the points by {:.2g} of the largest damping, they are known to {:.2g}; {}",
      r.order, r.why, r.error, m.tolerance, r.passive ? "passive" : "not certified passive");
  Json& j = summary.facts = {{"order", r.order},     {"error", r.error},          {"known_to", m.tolerance},
                             {"passive", r.passive}, {"added_mass_limit", limit}, {"why", r.why}};
  if (m.limit.value) j["added_mass_limit_interval"] = {m.limit.interval.low, m.limit.interval.high};
  summary.say("added mass at infinite frequency {:.5g} {}, {}", limit, unit.added_mass,
              m.limit.value ? fmt::format("{:g} % interval {:.5g} to {:.5g}", 100 * confidence, m.limit.interval.low,
                                          m.limit.interval.high)
                            : "without interval: " + m.limit.why_not);
  const auto& [poles, cosine, sine] = m.poles.model;
  for (std::size_t k = 0; k < poles.size(); ++k) {
    j["pole"].push_back({{"decay_1_s", poles[k].decay},
                         {"omega_rad_s", poles[k].omega},
                         {"cosine", cosine[k](0, 0)},
                         {"sine", sine[k](0, 0)}});
    summary.say("pole: decays by {:.4g}/s, turns by {:.4g} rad/s", poles[k].decay, poles[k].omega);
  }
  return summary;
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
  std::vector<double> omega;
  std::vector<const Coefficient*> told;
  for (const RadiationRun& run : runs) {
    omega.push_back(run.point.omega);
    told.push_back(damping ? &run.point.damping : &run.point.added_mass);
  }
  plot::Panel panel{.x = {"frequency", "rad/s"},
                    .y = {damping ? "damping" : "added mass", unit},
                    .series = with_bars("measured", confidence, omega, told)};
  if (!memory || !memory->refused.empty()) return panel;
  plot::Series curve{"poles", {}, {}, true, false, true};
  for (int k = 1; k <= 200; ++k) {
    const double at = 1.2 * omega.back() * k / 200;  // runs are in the order of their frequencies
    const auto value = memory->poles.model.transform(at)(0, 0);
    curve.x.push_back(at);
    curve.y.push_back(damping ? value.real() : memory->poles.A_inf(0, 0) + value.imag() / at);
  }
  panel.series.push_back(curve);
  return panel;
}

}  // namespace

FitOutcome fit_model(const scene::FitScene& scene, const scene::RadiationModel& model) {
  const RadiationUnits unit = units_of(scene.turns());
  std::vector<RadiationRun> runs;
  for (const auto& file : scene.files) runs.push_back(fit_run_of(scene, model.body, file.value));
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.point.omega < b.point.omega; });
  const auto memory = memory_of(runs, scene.confidence);
  FitSummary summary = begin_summary(scene);
  summary.heading = "F = -(M + A) a - B v - C x, what the load cells carry of a body moved in still water";
  if (runs.size() == 1)  // what a scene of motion may include
    summary.facts["coefficients"] = {{"added_mass", *runs[0].point.added_mass.value},
                                     {"damping", *runs[0].point.damping.value}};
  for (const RadiationRun& run : runs) summary.parts.push_back(summary_of(run, unit));
  if (memory) summary.parts.push_back(summary_of(*memory, unit, scene.confidence));
  return {.summary = std::move(summary),
          .picture = {.title = title_of(scene),
                      .panels = {panel_of(runs, memory, false, unit.added_mass, scene.confidence),
                                 panel_of(runs, memory, true, unit.damping, scene.confidence)}},
          .table = table_of(runs, unit)};
}

}  // namespace froude
