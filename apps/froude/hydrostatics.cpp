/// \file  `froude hydrostatics`: what still water does to a hull given as a mesh.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "answers/picture.hpp"
#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/report.hpp"
#include "hydro/hydrostatics/stability.hpp"

namespace froude {
namespace {

namespace hh = hydro::hydrostatics;
using Eigen::Vector3d;

/// All that is told, computed once.
struct Hydrostatics {
  hh::Pose pose;
  double heel, trim;
  hh::Immersion im;
  std::optional<hh::MassPoint> body;
  std::optional<hh::Equilibrium> equilibrium;
  std::optional<hh::Metacentre> metacentre;
  hh::Matrix6 C;
  Vector3d reference, G = Vector3d::Zero();
  std::optional<hh::RightingCurve> curve;
  double lowest;  ///< z of the hull's lowest point
  std::vector<std::string> notes;
};

void find_pose(const HydrostaticsArguments& a, const hh::Hull& hull, Hydrostatics& r) {
  r.heel = a.heel.radians();
  r.trim = a.trim.radians();
  r.pose = {.attitude = hh::attitude_of(a.heel, a.trim), .position = {0, 0, a.heave.value_or(0)}};
  if (!a.mass) return;
  r.body = hh::MassPoint{*a.mass, *a.centre_of_gravity};
  r.equilibrium = hh::equilibrium(hull, *r.body, a.water, r.pose.attitude);
  if (!r.equilibrium->converged) throw hydro::NumericsError(r.equilibrium->why);
  r.pose = r.equilibrium->pose;
  r.heel = r.equilibrium->heel;
  r.trim = r.equilibrium->trim;
}

void add_stability(const HydrostaticsArguments& a, const hh::Hull& hull, Hydrostatics& r) {
  r.C = hh::buoyancy_stiffness(r.im, a.water, r.reference);
  if (!r.body) {
    r.notes.push_back("no centre of gravity is given: C is the water's part alone, and there are no GM and no GZ");
    return;
  }
  r.G = r.pose * r.body->centre;
  r.C += hh::gravity_stiffness(r.body->mass * a.water.gravity, r.G, r.reference);
  if (r.im.waterplane) r.metacentre = hh::metacentre(r.im, r.G);
  const double off = (*r.im.centre_of_buoyancy - r.G).head<2>().norm();
  if (off > 1e-6 * hull.diagonal())
    r.notes.push_back(
        fmt::format("G is {:.4g} m beside the centre of buoyancy: the hull would not stay as it is; with "
                    "--mass it floats where it wants to",
                    off));
  r.curve = hh::righting_arms(hull, *r.body, a.water, a.heels, a.free_trim ? hh::Trim::free : hh::Trim::fixed,
                              hydro::Angle::from_radians(r.trim));
  if (!r.curve->ended.empty()) r.notes.push_back("the curve of GZ ends " + r.curve->ended);
}

Hydrostatics hydrostatics_of(const HydrostaticsArguments& a, const hh::Hull& hull) {
  Hydrostatics r{};
  r.notes = hull.notes();
  if (hull.slivers() > 0) r.notes.push_back(fmt::format("{} triangles have no area", hull.slivers()));
  find_pose(a, hull, r);
  r.im = hh::immersion(hull, r.pose);
  hydro::require(r.im.centre_of_buoyancy.has_value(), "{}: nothing of the hull is under water (z < 0)", hull.source());
  if (!r.body && a.centre_of_gravity) r.body = hh::MassPoint{a.water.density * r.im.volume, *a.centre_of_gravity};
  if (r.im.area_in_surface > 0)
    r.notes.push_back(
        fmt::format("{:.6g} m² of faces lie in the water surface and count as dry; C is that of a hull that "
                    "rises",
                    r.im.area_in_surface));
  if (!r.im.waterplane) r.notes.push_back("the hull is wholly under water: it has no waterplane");
  r.reference = a.reference.value_or(Vector3d::Zero());
  r.lowest = r.pose.position.z();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& v : hull.vertices()) lowest = std::min(lowest, (r.pose * v).z());
  r.lowest = lowest;
  add_stability(a, hull, r);
  return r;
}

std::string point(const Eigen::VectorXd& p) { return fmt::format("({:.6g}) m", fmt::join(p, ", ")); }

void add_hull(const HydrostaticsArguments& a, const hh::Hull& hull, Report& report) {
  const double lacking = hh::chord_volume(hull);
  report.say("{}: {} triangles, {}, volume {:.6g} m³", fact("mesh/file", hull.source()),
             fact("mesh/triangles", hull.triangles().size()),
             fact("mesh/closed", hull.closed(), hull.closed() ? "closed" : "open"),
             fact("mesh/volume_m3", hull.volume()));
  report.say("  flat triangles lack about  {:.2g} % of the volume",
             fact("mesh/chord_volume_m3", lacking, 100 * lacking / hull.volume()));
  report.keep("mesh/parts", hull.parts()).keep("mesh/area_m2", hull.area());
  report.keep("water/density", a.water.density).keep("water/gravity", a.water.gravity);
}

void add_immersion(const HydrostaticsArguments& a, const Hydrostatics& r, Report& report) {
  report.say("  heave, heel, trim          {:.6g} m, {:.5g}°, {:.5g}°", fact("pose/heave_m", r.pose.position.z()),
             fact("pose/heel_deg", r.heel / degree), fact("pose/trim_deg", r.trim / degree));
  if (r.equilibrium)
    report.say("  equilibrium                {}", fact("equilibrium/why", r.equilibrium->why))
        .keep("equilibrium/stable", r.equilibrium->stable);
  report.say("  volume displaced           {:.6g} m³ = {:.6g} kg", fact("volume_m3", r.im.volume),
             fact("displacement_kg", a.water.density * r.im.volume));
  report.say("  centre of buoyancy         {}",
             fact("centre_of_buoyancy_m", *r.im.centre_of_buoyancy, point(*r.im.centre_of_buoyancy)));
  report.say("  wetted area                {:.6g} m²", fact("wetted_area_m2", r.im.wetted_area));
  report.say("  draught                    {:.6g} m", fact("draught_m", -r.lowest));
  if (!r.im.waterplane) return;
  const auto& [area, centre, second] = *r.im.waterplane;
  report.say("  waterplane                 {:.6g} m², centre {}", fact("waterplane/area_m2", area),
             fact("waterplane/centre_m", centre, point(centre)));
  report.say("    second moments           about x {:.6g}, about y {:.6g}, product {:.6g} m⁴", second(1, 1),
             second(0, 0), second(0, 1));
  report.keep("waterplane/second_moment_m4", second);
}

void add_centres(const Hydrostatics& r, Report& report) {
  if (r.body)
    report.say("  mass, centre of gravity    {:.6g} kg, {}", fact("mass_kg", r.body->mass),
               fact("centre_of_gravity_m", r.G, point(r.G)));
  if (!r.metacentre) return;
  report.say("  BM                         transverse {:.6g} m, longitudinal {:.6g} m",
             fact("metacentre/bm_transverse_m", r.metacentre->bm_transverse),
             fact("metacentre/bm_longitudinal_m", r.metacentre->bm_longitudinal));
  report.say("  GM                         transverse {:.6g} m, longitudinal {:.6g} m, least {:.6g} m",
             fact("metacentre/gm_transverse_m", r.metacentre->gm_transverse),
             fact("metacentre/gm_longitudinal_m", r.metacentre->gm_longitudinal),
             fact("metacentre/gm_least_m", r.metacentre->gm_least));
}

void add_matrix(const Hydrostatics& r, Report& report) {
  report.say(
      "C about {} [N/m, N, N m], {}:", fact("reference_m", r.reference, point(r.reference)),
      r.body ? fact("C_holds", "water and gravity", "water and gravity") : fact("C_holds", "water", "water alone"));
  report.keep("C", r.C);
  const double largest = r.C.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 2; i < 5; ++i) {  // the other rows are zero
    std::string row = fmt::format("  {:<6}", hydro::mode_names[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < 6; ++j)
      row += fmt::format(" {:>12}", std::abs(r.C(i, j)) < 1e-12 * largest ? "0" : fmt::format("{:.5g}", r.C(i, j)));
    report.say("{}", row);
  }
}

void add_curve(const hh::RightingCurve& curve, bool free_trim, Report& report) {
  report.say("righting arms, trim {}:", free_trim ? "free" : "fixed");
  report.say("  {:>9} {:>10} {:>9} {:>14}", "heel [°]", "GZ [m]", "trim [°]", "area [m rad]").keep("gz", Json::array());
  for (const auto& p : curve.arms)
    report.row("gz", "  {:>9.4g} {:>10.4f} {:>9.3f} {:>14.5f}", fact("heel_deg", p.heel / degree), fact("gz_m", p.gz),
               fact("trim_deg", p.trim / degree), fact("energy_m", p.energy));
  if (curve.arms.empty()) return;
  const auto& most =
      *std::max_element(curve.arms.begin(), curve.arms.end(), [](const auto& a, const auto& b) { return a.gz < b.gz; });
  report.say("  largest of these: {:.4g} m at {:.4g}°", fact("largest_gz/gz_m", most.gz),
             fact("largest_gz/heel_deg", most.heel / degree));
  // An arm of rounding alone, as the one at rest, crosses nothing.
  const double rounding = 1e-9 * std::abs(most.gz);
  for (std::size_t i = 1; i < curve.arms.size(); ++i) {
    const auto &p = curve.arms[i - 1], &q = curve.arms[i];
    if (p.gz > rounding && q.gz <= 0)
      report.row("vanishing_gz", "  vanishes at {:.4g}° (straight line between the points)",
                 fact("heel_deg", (p.heel + (q.heel - p.heel) * p.gz / (p.gz - q.gz)) / degree));
  }
}

void draw(const Path& path, const hh::Hull& hull, const Hydrostatics& r) {
  plot::Series gz{.name = "GZ", .x = {}, .y = {}}, tangent{.name = "GM · heel", .x = {}, .y = {}, .dashed = true},
      area{.name = "area under GZ", .x = {}, .y = {}};
  double top = 0;
  for (const auto& p : r.curve->arms) top = std::max(top, std::abs(p.gz));
  for (const auto& p : r.curve->arms) {
    gz.x.push_back(p.heel / degree);
    gz.y.push_back(p.gz);
    area.x.push_back(p.heel / degree);
    area.y.push_back(p.energy);
    const double line = r.metacentre ? r.metacentre->gm_transverse * (p.heel - r.heel) : 0;
    if (!r.metacentre || std::abs(line) > 1.2 * top) continue;  // the tangent as far as the curve is high
    tangent.x.push_back(p.heel / degree);
    tangent.y.push_back(line);
  }
  const plot::Axis heel{.label = "heel", .unit = "deg"};
  plot::Figure figure{.title = "Righting arm of " + Path(hull.source()).filename().string(), .panels = {}};
  figure.panels.push_back({.x = heel, .y = {.label = "GZ", .unit = "m"}, .series = {gz, tangent}});
  figure.panels.push_back({.x = heel, .y = {.label = "area", .unit = "m rad"}, .series = {area}});
  plot::write_picture(path, figure);
}

void check(const HydrostaticsArguments& a) {
  hydro::require(!a.mass || a.centre_of_gravity,
                 "--mass without --cog: where a hull floats depends on its centre of "
                 "gravity");
  hydro::require(!a.mass || !a.heave,
                 "--heave and --mass exclude each other: a hull with a mass finds its own draught");
  hydro::require(!a.picture || a.centre_of_gravity, "--picture draws the righting arms, which need --cog");
  hydro::require(!a.heels.empty(), "--gz has no heels");
  require_outputs(named({{"--picture", a.picture}}), {{"the mesh", a.mesh}});
  require_picture(a.picture);
}

}  // namespace

void hydrostatics(const HydrostaticsArguments& arguments, const Console& console) {
  check(arguments);
  hh::TriangleMesh mesh = hh::read_mesh(arguments.mesh, arguments.options);
  if (arguments.freeboard) mesh = hh::with_freeboard(std::move(mesh), *arguments.freeboard);
  const hh::Hull hull(std::move(mesh));
  const Hydrostatics r = hydrostatics_of(arguments, hull);
  if (arguments.picture) draw(*arguments.picture, hull, r);
  Report report;
  add_hull(arguments, hull, report);
  add_immersion(arguments, r, report);
  add_centres(r, report);
  add_matrix(r, report);
  if (r.curve) add_curve(*r.curve, arguments.free_trim, report);
  tell(report.sentences("notes", "note: {}", r.notes).wrote(arguments.picture), console);
}

}  // namespace froude
