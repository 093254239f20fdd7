#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

#include "compile/cylinders.hpp"
#include "froude/commands.hpp"
#include "froude/progress.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/check.hpp"
#include "hydro/potential/writers.hpp"

namespace froude {
namespace {

using hydro::potential::BodyData;
using hydro::potential::Coefficients;
using hydro::potential::Finding;
using hydro::potential::Severity;
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

template <class T>
json json_or_null(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
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

json json_finding(const Finding& f) {
  return {{"severity", to_string(f.severity)},
          {"check", f.check},
          {"where", f.where},
          {"message", f.message},
          {"remedy", f.remedy}};
}

std::string text_finding(const Finding& f) {
  std::string out = fmt::format("  {:<8} {:<18} {}\n", to_string(f.severity), f.check, f.message);
  const std::string indent(30, ' ');
  out += fmt::format("{}at {}\n", indent, f.where);
  if (!f.remedy.empty()) out += fmt::format("{}{}\n", indent, f.remedy);
  return out;
}

std::string summary(const std::vector<Finding>& findings) {
  const auto count = [&](Severity s) {
    return std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.severity == s; });
  };
  return fmt::format("  {} errors, {} warnings, {} notes\n", count(Severity::error), count(Severity::warning),
                     count(Severity::note));
}

enum class Format { froude, bemio, wamit };

bool ends_with(const std::string& text, std::string_view end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

Format format_of(const Path& output, const std::string& format) {
  const std::vector<std::string> known{"froude", "bemio", "wamit"};
  if (!format.empty()) {
    const auto at = std::find(known.begin(), known.end(), format);
    if (at == known.end())
      throw hydro::InputError(fmt::format("there is no format \"{}\"", format), {},
                              fmt::format("the formats are {}", fmt::join(known, ", ")));
    return static_cast<Format>(at - known.begin());
  }
  const std::string name = output.filename().string();
  if (ends_with(name, ".bemio.h5")) return Format::bemio;
  if (ends_with(name, ".h5") || ends_with(name, ".nc")) return Format::froude;
  if (ends_with(name, ".1")) return Format::wamit;
  throw hydro::InputError(fmt::format("the name \"{}\" does not tell a format", name), {},
                          "end it with .h5 (Froude), .bemio.h5 (BEMIO) or .1 (WAMIT set), or state --format");
}

struct Written {
  std::vector<std::string> files, left_out;
};

Written write_as(Format format, const Coefficients& c, const Path& output) {
  if (format == Format::froude) return {{output.string()}, hydro::potential::write_froude(c, output)};
  if (format == Format::bemio) return {{output.string()}, hydro::potential::write_bemio(c, output)};
  std::string stem = output.string();
  if (ends_with(stem, ".1")) stem.resize(stem.size() - 2);
  Written w{{stem + ".1"}, hydro::potential::write_wamit(c, stem)};
  if (!c.X.empty()) w.files.push_back(stem + ".3");
  if (c.C) w.files.push_back(stem + ".hst");
  return w;
}

void require_a_file(const BemArguments& arguments) {
  hydro::require(!arguments.files.empty(), "no file is given; give at least one file of coefficients");
}

}  // namespace

void bem_info(const BemArguments& arguments, const Console& console) {
  require_a_file(arguments);
  json files = json::array();
  for (const Path& file : arguments.files) {
    const Coefficients c = hydro::potential::read(file, arguments.options);
    if (console.json) {
      files.push_back(json_info(file, c));
    } else {
      console.out << text_info(file, c);
    }
  }
  if (console.json) console.out << json{{"files", files}}.dump(2) << '\n';
}

int bem_check(const BemArguments& arguments, const Console& console) {
  require_a_file(arguments);
  json files = json::array();
  int status = 0;
  for (const Path& file : arguments.files) {
    const std::vector<Finding> findings = hydro::potential::check(hydro::potential::read(file, arguments.options));
    for (const Finding& f : findings)
      if (f.severity == Severity::error) status = 1;
    if (console.json) {
      json list = json::array();
      for (const Finding& f : findings) list.push_back(json_finding(f));
      files.push_back({{"file", file.string()}, {"findings", list}});
    } else {
      console.out << file.string() << '\n';
      for (const Finding& f : findings) console.out << text_finding(f);
      console.out << summary(findings);
    }
  }
  if (console.json) console.out << json{{"files", files}, {"status", status}}.dump(2) << '\n';
  return status;
}

void bem_convert(const BemArguments& arguments, const Path& output, const std::string& format, const Console& console) {
  require_a_file(arguments);
  hydro::require(arguments.files.size() == 1, "one file can be converted at a time; {} are given",
                 arguments.files.size());
  const Format target = format_of(output, format);
  const Coefficients c = hydro::potential::read(arguments.files.front(), arguments.options);
  const Written written = write_as(target, c, output);
  if (console.json) {
    console.out << json{{"input", arguments.files.front().string()},
                        {"files", written.files},
                        {"left_out", written.left_out}}
                       .dump(2)
                << '\n';
    return;
  }
  console.out << fmt::format("wrote {}\n", fmt::join(written.files, ", "));
  for (const std::string& sentence : written.left_out) console.out << "  left out or changed: " << sentence << '\n';
}

void bem_solve(const Path& file, const Path& output, const std::string& format, const Console& console) {
  const Format target = format_of(output, format);
  const scene::Scene scene = scene::read(file);
  const std::vector<int> bodies = compile::bodies_of_cylinders(scene);
  if (bodies.empty())
    throw hydro::InputError("no body of the scene has cylinders", {.file = file.string()},
                            "add cylinders = { at = [...], diameter = ..., draught = ... } to [body.hydrodynamics]");
  Progress progress(console.err, "solve", console.show_progress);
  const auto solution = compile::solve_cylinders(
      scene, bodies, [&](int done, int all) { progress.update(static_cast<double>(done) / all); });
  const Written written = write_as(target, solution.coefficients, output);
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
