/// \file  `froude hydrostatics`: what still water does to a hull given as a mesh.
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/plot.hpp"
#include "hydro/hydrostatics/stability.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

namespace hh = hydro::hydrostatics;
using Eigen::Vector3d;
using nlohmann::json;

constexpr double degree = std::numbers::pi / 180;

/// All that is told, computed once.
struct Report {
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

void find_pose(const HydrostaticsArguments& a, const hh::Hull& hull, Report& r) {
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

void add_stability(const HydrostaticsArguments& a, const hh::Hull& hull, Report& r) {
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

Report report(const HydrostaticsArguments& a, const hh::Hull& hull) {
  Report r{};
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

json array(const Eigen::VectorXd& v) { return std::vector<double>(v.data(), v.data() + v.size()); }

json rows(const Eigen::MatrixXd& m) {
  json out = json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) out.push_back(array(m.row(i).transpose()));
  return out;
}

json curve_json(const hh::RightingCurve& curve) {
  json out = json::array();
  for (const auto& p : curve.arms)
    out.push_back(
        {{"heel_deg", p.heel / degree}, {"trim_deg", p.trim / degree}, {"gz_m", p.gz}, {"energy_m", p.energy}});
  return out;
}

json document(const HydrostaticsArguments& a, const hh::Hull& hull, const Report& r) {
  json j{{"mesh",
          {{"file", hull.source()},
           {"triangles", hull.triangles().size()},
           {"closed", hull.closed()},
           {"parts", hull.parts()},
           {"volume_m3", hull.volume()},
           {"area_m2", hull.area()},
           {"chord_volume_m3", hh::chord_volume(hull)}}},
         {"water", {{"density", a.water.density}, {"gravity", a.water.gravity}}},
         {"pose", {{"heave_m", r.pose.position.z()}, {"heel_deg", r.heel / degree}, {"trim_deg", r.trim / degree}}},
         {"volume_m3", r.im.volume},
         {"displacement_kg", a.water.density * r.im.volume},
         {"centre_of_buoyancy_m", array(*r.im.centre_of_buoyancy)},
         {"wetted_area_m2", r.im.wetted_area},
         {"draught_m", -r.lowest},
         {"reference_m", array(r.reference)},
         {"C", rows(r.C)},
         {"C_holds", r.body ? "water and gravity" : "water"},
         {"notes", r.notes}};
  if (r.im.waterplane)
    j["waterplane"] = {{"area_m2", r.im.waterplane->area},
                       {"centre_m", array(r.im.waterplane->centre)},
                       {"second_moment_m4", rows(r.im.waterplane->second_moment)}};
  if (r.body) {
    j["mass_kg"] = r.body->mass;
    j["centre_of_gravity_m"] = array(r.G);
  }
  if (r.equilibrium) j["equilibrium"] = {{"stable", r.equilibrium->stable}, {"why", r.equilibrium->why}};
  if (r.metacentre)
    j["metacentre"] = {{"bm_transverse_m", r.metacentre->bm_transverse},
                       {"bm_longitudinal_m", r.metacentre->bm_longitudinal},
                       {"gm_transverse_m", r.metacentre->gm_transverse},
                       {"gm_longitudinal_m", r.metacentre->gm_longitudinal},
                       {"gm_least_m", r.metacentre->gm_least}};
  if (r.curve) j["gz"] = curve_json(*r.curve);
  return j;
}

std::string point(const Eigen::VectorXd& p) { return fmt::format("({:.6g}) m", fmt::join(p, ", ")); }

void tell_immersion(const HydrostaticsArguments& a, const hh::Hull& hull, const Report& r, std::ostream& out) {
  const auto line = [&out](const char* what, const std::string& value) {
    out << fmt::format("  {:<26} {}\n", what, value);
  };
  out << fmt::format("{}: {} triangles, {}, volume {:.6g} m³\n", hull.source(), hull.triangles().size(),
                     hull.closed() ? "closed" : "open", hull.volume());
  line("flat triangles lack about",
       fmt::format("{:.2g} % of the volume", 100 * hh::chord_volume(hull) / hull.volume()));
  line("heave, heel, trim",
       fmt::format("{:.6g} m, {:.5g}°, {:.5g}°", r.pose.position.z(), r.heel / degree, r.trim / degree));
  if (r.equilibrium) line("equilibrium", r.equilibrium->why);
  line("volume displaced", fmt::format("{:.6g} m³ = {:.6g} kg", r.im.volume, a.water.density * r.im.volume));
  line("centre of buoyancy", point(*r.im.centre_of_buoyancy));
  line("wetted area", fmt::format("{:.6g} m²", r.im.wetted_area));
  line("draught", fmt::format("{:.6g} m", -r.lowest));
  if (const auto& w = r.im.waterplane) {
    line("waterplane", fmt::format("{:.6g} m², centre {}", w->area, point(w->centre)));
    line("  second moments", fmt::format("about x {:.6g}, about y {:.6g}, product {:.6g} m⁴", w->second_moment(1, 1),
                                         w->second_moment(0, 0), w->second_moment(0, 1)));
  }
  if (r.body) line("mass, centre of gravity", fmt::format("{:.6g} kg, {}", r.body->mass, point(r.G)));
  if (r.metacentre) {
    line("BM", fmt::format("transverse {:.6g} m, longitudinal {:.6g} m", r.metacentre->bm_transverse,
                           r.metacentre->bm_longitudinal));
    line("GM", fmt::format("transverse {:.6g} m, longitudinal {:.6g} m, least {:.6g} m", r.metacentre->gm_transverse,
                           r.metacentre->gm_longitudinal, r.metacentre->gm_least));
  }
}

void tell_matrix(const Report& r, std::ostream& out) {
  out << fmt::format("C about {} [N/m, N, N m], {}:\n", point(r.reference),
                     r.body ? "water and gravity" : "water alone");
  const double largest = r.C.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 2; i < 5; ++i) {  // the other rows are zero
    out << fmt::format("  {:<6}", hydro::mode_names[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < 6; ++j)
      out << fmt::format(" {:>12}", std::abs(r.C(i, j)) < 1e-12 * largest ? "0" : fmt::format("{:.5g}", r.C(i, j)));
    out << '\n';
  }
}

void tell_curve(const hh::RightingCurve& curve, bool free_trim, std::ostream& out) {
  out << fmt::format("righting arms, trim {}:\n  {:>9} {:>10} {:>9} {:>14}\n", free_trim ? "free" : "fixed", "heel [°]",
                     "GZ [m]", "trim [°]", "area [m rad]");
  for (const auto& p : curve.arms)
    out << fmt::format("  {:>9.4g} {:>10.4f} {:>9.3f} {:>14.5f}\n", p.heel / degree, p.gz, p.trim / degree, p.energy);
  const auto& most =
      *std::max_element(curve.arms.begin(), curve.arms.end(), [](const auto& a, const auto& b) { return a.gz < b.gz; });
  out << fmt::format("  largest of these: {:.4g} m at {:.4g}°\n", most.gz, most.heel / degree);
  for (std::size_t i = 1; i < curve.arms.size(); ++i) {
    const auto &p = curve.arms[i - 1], &q = curve.arms[i];
    if (p.gz > 0 && q.gz <= 0)
      out << fmt::format("  vanishes at {:.4g}° (straight line between the points)\n",
                         (p.heel + (q.heel - p.heel) * p.gz / (p.gz - q.gz)) / degree);
  }
}

void draw(const Path& path, const hh::Hull& hull, const Report& r) {
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
  hydro::io::write_atomically(path, plot::svg(figure));
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
}

}  // namespace

void hydrostatics(const HydrostaticsArguments& arguments, const Console& console) {
  check(arguments);
  hh::TriangleMesh mesh = hh::read_mesh(arguments.mesh, arguments.options);
  if (arguments.freeboard) mesh = hh::with_freeboard(std::move(mesh), *arguments.freeboard);
  const hh::Hull hull(std::move(mesh));
  const Report r = report(arguments, hull);
  if (arguments.picture) draw(*arguments.picture, hull, r);
  if (console.json) {
    console.out << document(arguments, hull, r).dump(1) << '\n';
    return;
  }
  tell_immersion(arguments, hull, r, console.out);
  tell_matrix(r, console.out);
  if (r.curve) tell_curve(*r.curve, arguments.free_trim, console.out);
  for (const auto& note : r.notes) console.out << "note: " << note << '\n';
  if (arguments.picture) console.out << "wrote " << arguments.picture->string() << '\n';
}

}  // namespace froude
