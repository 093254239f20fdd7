/// \file  `froude field`: the free surface about the bodies of a scene in one regular wave.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "answers/answers.hpp"
#include "answers/picture.hpp"
#include "froude/hull_pressures.hpp"
#include "froude/report.hpp"
#include "froude/scene_result.hpp"
#include "hydro/base/types.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

/// A point of the grid and its amplitude.
struct Extreme {
  double amplitude, x, y;
};
Extreme extreme(const FreeSurface& surface, bool highest) {
  Extreme out{highest ? -1.0 : std::numeric_limits<double>::infinity(), 0, 0};
  for (std::size_t p = 0; p < surface.elevation().size(); ++p) {
    const double amplitude = std::abs(surface.elevation()[p]);
    if (std::isfinite(amplitude) && (highest ? amplitude > out.amplitude : amplitude < out.amplitude))
      out = {amplitude, surface.x[p % surface.x.size()], surface.y[p / surface.x.size()]};
  }
  return out;
}

/// The panel with the largest dynamic pressure.
Report highest_pressure(const HullPressures& hulls) {
  Eigen::Index at = 0;
  const double highest = hulls.on.dynamic.cwiseAbs().maxCoeff(&at);
  const auto& panel = hulls.on.panel[static_cast<std::size_t>(at)];
  Report out;
  out.say(
      "pressure at {} panels, highest {:.4g} Pa per metre of wave amplitude, on {} at ({:.4g}, {:.4g}, {:.4g}) m; "
      "estimated error {:.2g} of that",
      fact("panels", hulls.on.panel.size()), fact("amplitude_Pa_m", highest),
      fact("body", hulls.bodies[static_cast<std::size_t>(panel.body)]), fact("x_m", panel.centre.x()),
      fact("y_m", panel.centre.y()), fact("z_m", panel.centre.z()), fact("error", hulls.on.estimate));
  return out;
}

Report body_drift(const FreeSurface& surface) {
  Report out;
  for (const FreeSurface::BodyDrift& one : surface.body_drift) {
    Report of;
    of.say("mean drift on {} ({:.4g}, {:.4g}) N per m^2, {:.4g} N m about the vertical through its origin",
           fact("body", one.body), fact("x_N_m2", one.x), fact("y_N_m2", one.y), fact("moment_Nm_m2", one.moment));
    out.part(one.body, std::move(of));
  }
  return out.say("estimated error of the mean drift of bodies {:.2g} of the largest",
                 fact("error", surface.body_drift_error));
}

Report report_of(const scene::Scene& scene, const FreeSurface& surface, const Path& file) {
  const auto told = std::count_if(surface.elevation().begin(), surface.elevation().end(),
                                  [](const auto& eta) { return std::isfinite(eta.real()); });
  Report out;
  out.say("{}: the free surface at {} of {} points, waves of {:.4g} s going to {:.4g} deg, bodies {}",
          scene.file.filename().string(), fact("points_told", told), fact("points", surface.elevation().size()),
          fact("period_s", 2 * std::numbers::pi / surface.omega), hydro::Angle::from_radians(surface.heading).degrees(),
          surface.held ? "held still" : "moving");
  out.keep("held", surface.held).keep("heading_rad", surface.heading);
  if (told > 0)
    for (const bool highest : {true, false}) {
      const Extreme at = extreme(surface, highest);
      Report one;
      one.say("{} {:.4g} m per metre of wave amplitude, at ({:.4g}, {:.4g}) m", highest ? "highest" : "lowest",
              fact("amplitude", at.amplitude), fact("x_m", at.x), fact("y_m", at.y));
      out.part(highest ? "highest" : "lowest", std::move(one));
    }
  Report mean;
  mean.say(
      "mean drift on all bodies ({:.4g}, {:.4g}) N per m^2 of wave amplitude; they take {:.3g} W/m^2 from the waves "
      "and send out {:.4g}",
      fact("x_N_m2", surface.drift_x), fact("y_N_m2", surface.drift_y), fact("taken_W_m2", surface.power_taken),
      fact("sent_out_W_m2", surface.power_sent_out));
  if (surface.body_drift.empty()) mean.keep("error", surface.body_drift_error);  // else with that of each body
  out.part("mean_drift", std::move(mean));
  if (!surface.body_drift.empty()) out.part("body_drift", body_drift(surface));
  if (surface.pressure) out.part("pressure", highest_pressure(*surface.pressure));
  out.say("estimated error {:.2g} of the highest, accuracy asked {:.2g}", fact("error", surface.estimate),
          fact("asked", scene.accuracy.value));
  return out.sentences("notes", "note: {}", surface.notes).say("wrote {}", fact("file", file.string()));
}

void write_csv(const Path& path, const FreeSurface& surface) {
  std::vector<double> x, y, amplitude, phase;
  for (std::size_t p = 0; p < surface.elevation().size(); ++p) {
    const auto& eta = surface.elevation()[p];
    if (!std::isfinite(eta.real())) continue;
    x.push_back(surface.x[p % surface.x.size()]);
    y.push_back(surface.y[p / surface.x.size()]);
    amplitude.push_back(std::abs(eta));
    phase.push_back(std::arg(eta));
  }
  hydro::io::write_csv(path,
                       {{"x", "m", &x}, {"y", "m", &y}, {"amplitude", "m/m", &amplitude}, {"phase", "rad", &phase}},
                       {"points in bodies, and where nothing is told, have no row"});
}

void write_pressure_csv(const Path& path, const HullPressures& hulls) {
  std::vector<double> body, area, amplitude, phase, hydrostatic, phase_of_hydrostatic;
  std::array<std::vector<double>, 3> centre, normal;
  for (std::size_t i = 0; i < hulls.on.panel.size(); ++i) {
    const hydro::potential::WetPanel& panel = hulls.on.panel[i];
    const auto at = static_cast<Eigen::Index>(i);
    body.push_back(panel.body + 1.0);
    area.push_back(panel.area);
    for (std::size_t k = 0; k < 3; ++k) {
      centre[k].push_back(panel.centre[static_cast<Eigen::Index>(k)]);
      normal[k].push_back(panel.normal[static_cast<Eigen::Index>(k)]);
    }
    amplitude.push_back(std::abs(hulls.on.dynamic[at]));
    phase.push_back(std::arg(hulls.on.dynamic[at]));
    hydrostatic.push_back(std::abs(hulls.on.hydrostatic[at]));
    phase_of_hydrostatic.push_back(std::arg(hulls.on.hydrostatic[at]));
  }
  std::vector<std::string> comments{
      "pressures per metre of wave amplitude, Re(p exp(+i omega t)), of a wave with its crest at the origin at t = 0"};
  for (std::size_t b = 0; b < hulls.bodies.size(); ++b)
    comments.push_back(fmt::format("body {} is {}", b + 1, hulls.bodies[b]));
  hydro::io::write_csv(path,
                       {{"body", "", &body},
                        {"x", "m", &centre[0]},
                        {"y", "m", &centre[1]},
                        {"z", "m", &centre[2]},
                        {"normal_x", "", &normal[0]},
                        {"normal_y", "", &normal[1]},
                        {"normal_z", "", &normal[2]},
                        {"area", "m^2", &area},
                        {"pressure", "Pa/m", &amplitude},
                        {"phase", "rad", &phase},
                        {"hydrostatic_pressure", "Pa/m", &hydrostatic},
                        {"phase_of_hydrostatic_pressure", "rad", &phase_of_hydrostatic}},
                       comments);
}

/// Of each point of the grid one number.
template <class Number>
plot::Panel panel(const FreeSurface& surface, const std::string& label, const Number& number) {
  plot::Field field{.value = {label, "m/m"}, .xs = surface.x, .ys = surface.y, .values = {}};
  for (std::size_t j = 0; j < surface.y.size(); ++j) {
    field.values.emplace_back();
    for (std::size_t i = 0; i < surface.x.size(); ++i)
      field.values.back().push_back(number(surface.elevation()[j * surface.x.size() + i]));
  }
  return {.x = {"x", "m"}, .y = {"y", "m"}, .series = {}, .field = std::move(field), .equal_scales = true};
}

plot::Figure figure(const scene::Scene& scene, const FreeSurface& surface) {
  plot::Figure out{.title = scene.title.empty() ? "Free surface" : scene.title, .panels = {}};
  out.panels.push_back(panel(surface, "amplitude", [](const auto& eta) { return std::abs(eta); }));
  out.panels.push_back(panel(surface, "elevation at t = 0", [](const auto& eta) { return eta.real(); }));
  out.panel_height = 560;
  return out;
}

}  // namespace

void field(const FieldArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.field.has_value(), scene, "a field",
                "field = { period = \"4 s\", x = \"-30 m .. 30 m, 61 values\", y = \"-30 m .. 30 m, 61 values\" }");
  require_asked(scene.field->pressure || !arguments.pressure_csv, scene,
                "pressure on hulls, which --pressure-csv writes", "field = { …, pressure = true }");
  const Path file = checked_output(arguments, ".field.h5", {{"--pressure-csv", arguments.pressure_csv}});
  const FreeSurface surface = free_surface(scene);
  surface.write(file);
  if (arguments.csv) write_csv(*arguments.csv, surface);
  if (arguments.pressure_csv) write_pressure_csv(*arguments.pressure_csv, *surface.pressure);
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(scene, surface));
  tell(report_of(scene, surface, file), console);
}

}  // namespace froude
