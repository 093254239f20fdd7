#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "compile/cylinders.hpp"
#include "compile/hulls.hpp"
#include "froude/bem/responses.hpp"
#include "froude/bem/solve_hulls.hpp"
#include "froude/coefficient_files.hpp"
#include "froude/commands.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

using hydro::potential::BodyData;
using hydro::potential::Coefficients;

/// The two numbers by which a person recognises a floating body.
struct HeaveFacts {
  std::optional<double> A33_infinite, C33;
};

HeaveFacts heave_of(const Coefficients& c, std::size_t body) {
  const Eigen::Index i = 6 * static_cast<Eigen::Index>(body) + 2;
  HeaveFacts facts;
  if (c.A_inf) facts.A33_infinite = (*c.A_inf)(i, i);
  if (c.C) facts.C33 = (*c.C)(i, i);
  return facts;
}

std::vector<double> headings_deg(const Coefficients& c) {
  std::vector<double> degrees;
  for (const double beta : c.heading) degrees.push_back(hydro::Angle::from_radians(beta).degrees());
  return degrees;
}

std::string point_text(const std::optional<Eigen::Vector3d>& p) {
  return p ? fmt::format("({:.4g}, {:.4g}, {:.4g})", p->x(), p->y(), p->z()) : "not stated";
}
std::string number_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "not stated";
}

void add_bodies(Report& report, const Coefficients& c) {
  std::size_t width = 4;
  for (const BodyData& body : c.body) width = std::max(width, body.name.size());
  report.say("  {:<{}}  {:>14}  {:>14}  {:>14}  {:<24}  {}", "body", width, "volume [m^3]", "A33(inf) [kg]",
             "C33 [N/m]", "reference point [m]", "centre of gravity [m]");
  for (std::size_t b = 0; b < c.body.size(); ++b) {
    const BodyData& body = c.body[b];
    const HeaveFacts heave = heave_of(c, b);
    Report one;
    one.say("  {:<{}}  {:>14}  {:>14}  {:>14}  {:<24}  {}", fact("name", body.name), width,
            number_text(body.displaced_volume), number_text(heave.A33_infinite), number_text(heave.C33),
            point_text(body.reference_point), point_text(body.centre_of_gravity));
    one.keep("reference_point_m", body.reference_point).keep("centre_of_gravity_m", body.centre_of_gravity);
    one.keep("centre_of_buoyancy_m", body.centre_of_buoyancy).keep("displaced_volume_m3", body.displaced_volume);
    one.keep("A33_infinite_kg", heave.A33_infinite).keep("C33_N_per_m", heave.C33);
    report.one_of("bodies", one);
  }
}

std::string heading_text(const Coefficients& c) {
  std::vector<std::string> shown;
  for (const double degrees : headings_deg(c)) shown.push_back(fmt::format("{:.4g}", degrees));
  constexpr std::size_t most = 8;
  if (shown.size() > most) return fmt::format("{} from {} to {} deg", shown.size(), shown.front(), shown.back());
  return shown.empty() ? "none" : fmt::format("{} deg", fmt::join(shown, ", "));
}

Report report_of(const Path& file, const Coefficients& c) {
  const auto [density, gravity, depth] = c.water;
  const double lowest = c.omega.front(), highest = c.omega.back();
  const auto presence = [](const auto& of) { return of ? "present" : "absent"; };
  Report out;
  out.say("{}", fact("file", file.string()));
  out.say("  format      {}", fact("source", c.source));
  out.say("  water       density {:.6g} kg/m^3, gravity {:.6g} m/s^2, depth {}", fact("density_kg_per_m3", density),
          fact("gravity_m_per_s2", gravity),
          depth.is_infinite() ? fact("depth_m", "infinite", std::string("infinite"))
                              : fact("depth_m", depth.metres(), fmt::format("{:.6g} m", depth.metres())));
  out.say("  frequencies {} from {:.4g} to {:.4g} rad/s (periods {:.4g} to {:.4g} s)",
          fact("omega_rad_per_s", c.omega, c.omega.size()), lowest, highest, 2 * std::numbers::pi / highest,
          2 * std::numbers::pi / lowest);
  out.say("  headings    {}", fact("heading_deg", headings_deg(c), heading_text(c)));
  out.say("  limits      A(0) {}, A(inf) {}", fact("has_A_zero", c.A_zero.has_value(), presence(c.A_zero)),
          fact("has_A_infinite", c.A_inf.has_value(), presence(c.A_inf)));
  out.say("  restoring   {}", fact("has_restoring", c.C.has_value(), presence(c.C)));
  out.keep("has_excitation", !c.X.empty());
  add_bodies(out, c);
  return out.sentences("notes", "  note        {}", c.notes);
}

Report report_of(const Path& file, const hydro::potential::ReadOptions& options) {
  if (hydro::potential::response_kind(file) != hydro::potential::ResponseKind::none)
    return response_report(file, options);
  return report_of(file, hydro::potential::read(file, options));
}

void require_a_file(const BemArguments& arguments) {
  hydro::require(!arguments.files.empty(), "no file is given; give at least one file of coefficients");
}

}  // namespace

void bem_info(const BemArguments& arguments, const Console& console) {
  require_a_file(arguments);
  Report all;
  for (const Path& file : arguments.files)
    all.one_of("files", tell_people(report_of(file, arguments.options), console));
  tell(all.untold(), console);
}

void bem_solve(const Path& file, const Path& output, const std::string& format, const Console& console) {
  const CoefficientFormat target = format_of(output, format);
  const scene::Scene scene = scene::read(file);
  require_outputs(files_to_write(target, output), files_of_scene(file));
  const std::vector<int> bodies = compile::bodies_of_cylinders(scene), hulls = compile::bodies_of_meshes(scene);
  if (bodies.empty() == hulls.empty())
    throw hydro::InputError(bodies.empty() ? "no body of the scene has cylinders or a mesh"
                                           : "some bodies of the scene have cylinders, others a mesh: they are solved "
                                             "apart, and one file would say that no waves pass between them",
                            {.file = file.string()},
                            bodies.empty() ? "add cylinders = { at = ..., diameter = ..., draught = ... }, or mesh = "
                                             "\"hull.stl\", to [body.hydrodynamics]"
                                           : "make a scene of each kind, or meshes of all");
  if (!hulls.empty()) {
    if (console.show_progress) console.err << compile::plan_hulls(scene, hulls).size() << '\n';
    return write_hulls(compile::solve_hulls(scene, hulls), target, output, console);
  }
  if (console.show_progress) console.err << compile::plan_cylinders(scene, bodies).size() << '\n';
  Progress progress(console.err, "solve", console.show_progress);
  const auto solution = compile::solve_cylinders(
      scene, bodies, [&](int done, int all) { progress.update(static_cast<double>(done) / all); });
  const WrittenCoefficients written = write_as(target, solution.coefficients, output);
  const auto& check = solution.check;
  Report out;
  out.say("wrote {}", fact("files", written.files, fmt::join(written.files, ", "))).keep("input", file.string());
  out.sentences("notes", "  {}", solution.coefficients.notes);
  out.sentences("left_out", "  left out or changed: {}", written.left_out);
  out.keep("self_check/energy", check.energy).keep("self_check/haskind", check.haskind);
  out.keep("self_check/reciprocity", check.reciprocity);
  tell(out.keep("self_check/change_with_doubled_resolution", check.doubling), console);
}

}  // namespace froude
