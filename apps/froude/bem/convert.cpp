// froude bem convert: reads, changes by exact laws in one fixed order, writes.
#include "froude/coefficient_files.hpp"
#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/potential/operations/transformations.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

using hydro::potential::BodyData;
using hydro::potential::Coefficients;

/// What `parse` makes of an option's text; its complaint names the option.
template <class Parse>
auto of_option(const char* option, const std::string& text, Parse parse) {
  return scene::placed({.file = option}, [&] { return parse(text); });
}

Coefficients read_all(const BemConvertArguments& a) {
  std::vector<Coefficients> runs;
  for (const Path& file : a.bem.files) runs.push_back(hydro::potential::read(file, a.bem.options));
  if (a.merge) return hydro::potential::merged(runs);
  if (runs.size() != 1)
    throw hydro::InputError(fmt::format("one file can be converted at a time; {} are given", runs.size()), {},
                            "convert them one by one, or state --merge if they are runs of the same bodies");
  return runs.front();
}

/// The points asked for, one a body: `cog`, or a point for each.
std::vector<Eigen::Vector3d> points_asked_for(const Coefficients& c, const std::vector<std::string>& about) {
  std::vector<Eigen::Vector3d> points;
  for (const std::string& text : about) {
    if (text != "cog") {
      points.push_back(
          of_option("--about", text, [](const std::string& t) { return hydro::parse_vector(t, hydro::dim::length); }));
      continue;
    }
    for (const BodyData& body : c.body) {
      if (!body.centre_of_gravity)
        throw hydro::InputError(fmt::format("the data do not say where the centre of gravity of \"{}\" is", body.name),
                                {.file = "--about"}, "state the point: --about \"(0, 0, -1.5) m\"");
      points.push_back(*body.centre_of_gravity);
    }
  }
  hydro::require(points.size() == c.body.size(), "--about gives {} points for {} bodies; state one for each",
                 points.size(), c.body.size());
  return points;
}

Coefficients about_points(const Coefficients& c, const std::vector<std::string>& about) {
  std::vector<Eigen::Vector3d> from;
  for (const BodyData& body : c.body) {
    if (!body.reference_point)
      throw hydro::InputError(fmt::format("the data do not say about which point \"{}\" rotates", body.name),
                              {.file = "--about"}, "give a format that states it, or a .out file beside WAMIT's");
    from.push_back(*body.reference_point);
  }
  return hydro::potential::about(c, from, points_asked_for(c, about));
}

Eigen::Vector2d on_the_water(const char* option, const Eigen::Vector3d& p) {
  hydro::require(p.z() == 0, "{}: bodies move along the water; z must be 0, got {} m", option, p.z());
  return p.head<2>();
}

Coefficients copies(const Coefficients& c, const std::vector<std::string>& array) {
  std::vector<Eigen::Vector2d> places;
  for (const std::string& text : array)
    for (const Eigen::Vector3d& p :
         of_option("--array", text, [](const std::string& t) { return hydro::parse_vectors(t, hydro::dim::length); }))
      places.push_back(on_the_water("--array", p));
  return hydro::potential::repeated(c, places);
}

/// In the order of the guide: later options speak of what earlier ones made.
Coefficients changed(Coefficients c, const BemConvertArguments& a) {
  using namespace hydro::potential;
  for (const std::string& plane : a.symmetric)
    c = completed_by_symmetry(std::move(c), plane == "y" ? MirrorPlane::y0 : MirrorPlane::x0);
  if (!a.about.empty()) c = about_points(c, a.about);
  if (a.translate)
    c = translated(std::move(c),
                   on_the_water("--translate", of_option("--translate", *a.translate, [](const std::string& t) {
                                  return hydro::parse_vector(t, hydro::dim::length);
                                })));
  if (a.turn)
    c = turned(std::move(c), of_option("--turn", *a.turn,
                                       [](const std::string& t) { return hydro::parse_si(t, hydro::dim::angle); }));
  if (!a.array.empty()) c = copies(c, a.array);
  if (a.scale || a.density_ratio) c = scaled(std::move(c), a.scale.value_or(1), a.density_ratio.value_or(1));
  if (a.frequencies)
    c = resampled(c,
                  of_option("--frequencies", *a.frequencies,
                            [](const std::string& t) { return hydro::parse_range(t, hydro::dim::angular_velocity); }))
            .coefficients;
  return c;
}

}  // namespace

void bem_convert(const BemConvertArguments& arguments, const Console& console) {
  hydro::require(!arguments.bem.files.empty(), "no file is given; give at least one file of coefficients");
  const CoefficientFormat target = format_of(arguments.output, arguments.format);
  require_outputs(files_to_write(target, arguments.output), files_of_coefficients(arguments.bem.files));
  const Coefficients original = read_all(arguments), c = changed(original, arguments);
  const std::vector<std::string> done(c.notes.begin() + static_cast<std::ptrdiff_t>(original.notes.size()),
                                      c.notes.end());
  const WrittenCoefficients written = write_as(target, c, arguments.output);
  const Json input = arguments.bem.files;
  Report out;
  out.keep("input", arguments.merge ? input : input.front());
  out.say("wrote {}", fact("files", written.files, fmt::join(written.files, ", ")));
  out.sentences("changed", "  {}", done);
  tell(out.sentences("left_out", "  left out or changed: {}", written.left_out), console);
}

}  // namespace froude
