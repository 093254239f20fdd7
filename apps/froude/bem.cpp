#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

#include "compile/cylinders.hpp"
#include "froude/bem_responses.hpp"
#include "froude/coefficient_files.hpp"
#include "froude/commands.hpp"
#include "froude/optional_json.hpp"
#include "froude/progress.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

using hydro::potential::BodyData;
using hydro::potential::Coefficients;
using nlohmann::json;

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

std::string depth_text(const Coefficients& c) {
  return c.water.depth.is_infinite() ? "infinite" : fmt::format("{:.6g} m", c.water.depth.metres());
}

json json_point(const std::optional<Eigen::Vector3d>& p) {
  return p ? json::array({p->x(), p->y(), p->z()}) : json(nullptr);
}

json json_info(const Path& file, const Coefficients& c) {
  json bodies = json::array();
  for (std::size_t b = 0; b < c.body.size(); ++b) {
    const BodyData& body = c.body[b];
    const HeaveFacts heave = heave_of(c, b);
    bodies.push_back({{"name", body.name},
                      {"reference_point_m", json_point(body.reference_point)},
                      {"centre_of_gravity_m", json_point(body.centre_of_gravity)},
                      {"centre_of_buoyancy_m", json_point(body.centre_of_buoyancy)},
                      {"displaced_volume_m3", json_or_null(body.displaced_volume)},
                      {"A33_infinite_kg", json_or_null(heave.A33_infinite)},
                      {"C33_N_per_m", json_or_null(heave.C33)}});
  }
  return {{"file", file.string()},
          {"source", c.source},
          {"bodies", bodies},
          {"omega_rad_per_s", c.omega},
          {"heading_deg", headings_deg(c)},
          {"density_kg_per_m3", c.water.density},
          {"gravity_m_per_s2", c.water.gravity},
          {"depth_m", c.water.depth.is_infinite() ? json("infinite") : json(c.water.depth.metres())},
          {"has_A_zero", c.A_zero.has_value()},
          {"has_A_infinite", c.A_inf.has_value()},
          {"has_excitation", !c.X.empty()},
          {"has_restoring", c.C.has_value()},
          {"notes", c.notes}};
}

std::string point_text(const std::optional<Eigen::Vector3d>& p) {
  return p ? fmt::format("({:.4g}, {:.4g}, {:.4g})", p->x(), p->y(), p->z()) : "not stated";
}
std::string number_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "not stated";
}

std::string body_table(const Coefficients& c) {
  std::size_t width = 4;
  for (const BodyData& body : c.body) width = std::max(width, body.name.size());
  std::string out = fmt::format("  {:<{}}  {:>14}  {:>14}  {:>14}  {:<24}  {}\n", "body", width, "volume [m^3]",
                                "A33(inf) [kg]", "C33 [N/m]", "reference point [m]", "centre of gravity [m]");
  for (std::size_t b = 0; b < c.body.size(); ++b) {
    const BodyData& body = c.body[b];
    const HeaveFacts heave = heave_of(c, b);
    out += fmt::format("  {:<{}}  {:>14}  {:>14}  {:>14}  {:<24}  {}\n", body.name, width,
                       number_text(body.displaced_volume), number_text(heave.A33_infinite), number_text(heave.C33),
                       point_text(body.reference_point), point_text(body.centre_of_gravity));
  }
  return out;
}

std::string heading_text(const Coefficients& c) {
  std::vector<std::string> shown;
  for (const double degrees : headings_deg(c)) shown.push_back(fmt::format("{:.4g}", degrees));
  constexpr std::size_t most = 8;
  if (shown.size() > most) return fmt::format("{} from {} to {} deg", shown.size(), shown.front(), shown.back());
  return shown.empty() ? "none" : fmt::format("{} deg", fmt::join(shown, ", "));
}

std::string text_info(const Path& file, const Coefficients& c) {
  const double lowest = c.omega.front(), highest = c.omega.back();
  std::string out = fmt::format("{}\n", file.string());
  const auto line = [&](const char* what, const std::string& value) {
    out += fmt::format("  {:<12}{}\n", what, value);
  };
  line("format", c.source);
  line("water", fmt::format("density {:.6g} kg/m^3, gravity {:.6g} m/s^2, depth {}", c.water.density, c.water.gravity,
                            depth_text(c)));
  line("frequencies", fmt::format("{} from {:.4g} to {:.4g} rad/s (periods {:.4g} to {:.4g} s)", c.omega.size(), lowest,
                                  highest, 2 * std::numbers::pi / highest, 2 * std::numbers::pi / lowest));
  line("headings", heading_text(c));
  line("limits", fmt::format("A(0) {}, A(inf) {}", c.A_zero ? "present" : "absent", c.A_inf ? "present" : "absent"));
  line("restoring", c.C ? "present" : "absent");
  out += body_table(c);
  for (const std::string& note : c.notes) line("note", note);
  return out;
}

void require_a_file(const BemArguments& arguments) {
  hydro::require(!arguments.files.empty(), "no file is given; give at least one file of coefficients");
}

}  // namespace

void bem_info(const BemArguments& arguments, const Console& console) {
  require_a_file(arguments);
  json files = json::array();
  for (const Path& file : arguments.files) {
    if (hydro::potential::response_kind(file) != hydro::potential::ResponseKind::none) {
      if (console.json) {
        files.push_back(response_info(file, arguments.options));
      } else {
        console.out << response_text(file, arguments.options);
      }
      continue;
    }
    const Coefficients c = hydro::potential::read(file, arguments.options);
    if (console.json) {
      files.push_back(json_info(file, c));
    } else {
      console.out << text_info(file, c);
    }
  }
  if (console.json) console.out << json{{"files", files}}.dump(2) << '\n';
}

void bem_solve(const Path& file, const Path& output, const std::string& format, const Console& console) {
  const CoefficientFormat target = format_of(output, format);
  const scene::Scene scene = scene::read(file);
  require_outputs(files_to_write(target, output), files_of_scene(file));
  const std::vector<int> bodies = compile::bodies_of_cylinders(scene);
  if (bodies.empty())
    throw hydro::InputError("no body of the scene has cylinders", {.file = file.string()},
                            "add cylinders = { at = [...], diameter = ..., draught = ... } to [body.hydrodynamics]");
  if (console.show_progress) console.err << compile::plan_cylinders(scene, bodies).size() << '\n';
  Progress progress(console.err, "solve", console.show_progress);
  const auto solution = compile::solve_cylinders(
      scene, bodies, [&](int done, int all) { progress.update(static_cast<double>(done) / all); });
  const WrittenCoefficients written = write_as(target, solution.coefficients, output);
  const auto& check = solution.check;
  if (console.json) {
    console.out << json{{"input", file.string()},
                        {"files", written.files},
                        {"left_out", written.left_out},
                        {"self_check",
                         {{"energy", check.energy},
                          {"haskind", check.haskind},
                          {"reciprocity", check.reciprocity},
                          {"change_with_doubled_resolution", check.doubling}}}}
                       .dump(2)
                << '\n';
    return;
  }
  console.out << fmt::format("wrote {}\n", fmt::join(written.files, ", "));
  for (const std::string& note : solution.coefficients.notes) console.out << "  " << note << '\n';
  for (const std::string& sentence : written.left_out) console.out << "  left out or changed: " << sentence << '\n';
}

}  // namespace froude
