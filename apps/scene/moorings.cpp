/// \file  `[[mooring]]`
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using dynamics::Matrix6;

bool rotates(std::size_t mode) { return hydro::is_rotation(static_cast<hydro::Mode>(mode)); }

/// The entry of a symmetric matrix between two modes, both of which name its key: surge, surge_pitch.
Key entry_key(std::size_t i, std::size_t j, const hydro::Dimension& translation, const std::string& what) {
  auto dimension = translation;  // N/m → N/rad → N m/rad
  if (rotates(i) != rotates(j)) dimension = translation * dim::length / dim::angle;
  if (rotates(i) && rotates(j)) dimension = translation * dim::area / dim::angle;
  const std::string row(hydro::mode_names[i]), column(hydro::mode_names[j]);
  const std::string meaning = "load in " + row + " per " + what + " in " + column;
  return (i == j ? quantity(row, dimension, meaning)
                 : quantity(row + "_" + column, dimension, meaning + ", and the reverse"))
      .optional();
}

/// The six diagonal and fifteen other entries of a symmetric 6 × 6 matrix: surge, …, yaw, surge_sway, …, pitch_yaw.
Binding<Matrix6> matrix(const std::string& title, const std::string& meaning, const hydro::Dimension& translation,
                        const std::string& what) {
  Binding<Matrix6> out(title, meaning);
  out.then([](const Record&, Matrix6& m) { m.setZero(); });
  std::vector<std::string> names;
  const auto add = [&](std::size_t i, std::size_t j) {
    const Key key = entry_key(i, j, translation, what);
    names.push_back(key.name);
    out.key(key).then([name = key.name, i, j](const Record& record, Matrix6& m) {
      if (!record.has(name)) return;
      const double value = record.si(name);
      if (value == 0) throw record.wrong(name, "is zero", "leave the key out: what is not named does not act");
      if (i == j && value < 0)
        throw record.wrong(name, "is negative: it would push the body away from rest",
                           "give it without the minus; what restores or damps is positive");
      m(static_cast<int>(i), static_cast<int>(j)) = m(static_cast<int>(j), static_cast<int>(i)) = value;
    });
  };
  for (std::size_t i = 0; i < 6; ++i) add(i, i);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j) add(i, j);
  return out.at_least_one_of(names);
}

/// v·Dv >= 0 for every v, or the mooring would be a source of power. Scaled to a unit diagonal, as the units differ.
void check_dissipates(const Record& record, const Matrix6& damping) {
  Matrix6 scaled = damping;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(damping(i, i) * damping(j, j));
      if (scale > 0) scaled(i, j) /= scale;
    }
  const double least = hydro::dense::symmetric_eigenvalues(scaled)[0];
  if (least < -1e-9)  // round-off of numbers of order one
    throw record.refused("gives power to some motion",
                         "every entry a_b must keep a_b² <= a · b, and the whole must be positive semidefinite");
}

Binding<dynamics::Restoring> linear() {
  using dynamics::Restoring;
  const auto stiffness =
      matrix("[mooring.stiffness]", "about the body's origin, at rest; symmetric", dim::stiffness, "displacement");
  const auto damping = matrix("[mooring.damping]", "about the body's origin; symmetric", dim::damping, "velocity")
                           .then(check_dissipates);
  return Binding<Restoring>("", "load proportional to displacement and velocity")
      .table("stiffness", stiffness, &Restoring::stiffness)
      .optional()
      .table("damping", damping, &Restoring::damping)
      .optional()
      .at_least_one_of({"stiffness", "damping"});
}

Binding<CatenaryLine> catenary() {
  using Line = dynamics::LineProperties;
  using Asked = CatenaryLine::Table;
  const auto table =
      Binding<Asked>("[mooring.table]",
                     "the shape is looked up where the fairlead is near its place at rest, and solved elsewhere")
          .key(positive("reach", dim::length, "of the table about rest, horizontally and vertically"), &Asked::reach)
          .key(number("tolerance", "largest error of the pull, of the largest pull in reach")
                   .within(Limit::open_fraction)
                   .or_default("1e-4",
                               "far below what drag and friction on the bed, which a catenary leaves out, amount to"),
               &Asked::tolerance)
          .place(&Asked::place);
  const auto line =
      Binding<Line>("", "")
          .key(positive("length", dim::length, "of the line without tension"), &Line::length)
          .key(positive("mass_per_length", dim::mass / dim::length, "of the line, in air"))
          .key(positive("diameter", dim::length, "of the line, by the water that it displaces"))
          .key(positive("axial_stiffness", dim::force, "EA: tension per strain"), &Line::axial_stiffness)
          .optional(effect("on_bed", "the anchor lies on a flat bed, on which the line may rest, without friction"),
                    &Line::on_bed);
  return Binding<CatenaryLine>("", "elastic lines in their static shape, from each body to the ground")
      .key(points("from", "fairlead, body axes; each ± makes two lines"))
      .key(points("to", "anchor, global; as many as `from`, taken in pairs"))
      .part(line, &CatenaryLine::line)
      .table("table", table, &CatenaryLine::table)
      .place(&CatenaryLine::place);
}

/// What one table says, by its kind.
struct Mooring {
  std::variant<dynamics::Restoring, CatenaryLine> kind;
};

const Binding<Mooring>& mooring() {
  static const auto binding =
      Binding<Mooring>("[[mooring]]", "what holds a body in place")
          .keys({name_key("mooring", "of the mooring"),
                 texts("on", "bodies it holds, by name; * stands for any characters"), text("kind", "of mooring")})
          .variant("linear", linear(), &Mooring::kind)
          .variant("catenary", catenary(), &Mooring::kind);
  return binding;
}

void build_catenaries(const Record& record, CatenaryLine line, Names& names, Scene& scene) {
  const auto& from = record["from"].points.front();
  const auto& to = record["to"].points.front();
  if (from.size() != to.size())
    throw record.wrong("to", fmt::format("stands for {} points and from for {}", to.size(), from.size()),
                       "use as many ± in one as in the other");
  const double mass = record.si("mass_per_length");
  const double displaced = scene.water.density * std::numbers::pi / 4 * std::pow(record.si("diameter"), 2);
  if (!(mass > displaced))
    throw record.wrong(
        "mass_per_length",
        fmt::format("is less than the {:.4g} kg/m of water that the line displaces: it floats", displaced),
        "a catenary hangs; give a heavier or a thinner line");
  line.line.weight = (mass - displaced) * scene.water.gravity;
  const auto on = bodies_on(record, "on", scene.bodies);
  const auto name = names.of(record, on.size() * from.size());
  for (std::size_t b = 0, n = 0; b < on.size(); ++b)
    for (std::size_t k = 0; k < from.size(); ++k) {
      line.name = name[n++];
      line.body = on[b];
      line.fairlead = from[k];
      line.anchor = to[k];
      scene.catenaries.push_back(line);
    }
}

}  // namespace

const Table& mooring_table() { return mooring().table(); }

void build_moorings(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("mooring")) {
    const Mooring made = mooring().read(record);
    if (const auto* line = std::get_if<CatenaryLine>(&made.kind))
      build_catenaries(record, *line, names, scene);
    else
      on_each_body(record, names, scene.bodies, std::get<dynamics::Restoring>(made.kind), scene.moorings);
  }
}

}  // namespace froude::scene
