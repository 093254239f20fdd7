/// \file  `[[body]]`: rigid bodies, how they begin, and what they show the water.
#include <fmt/format.h>

#include <cmath>

#include "hydro/base/dense.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
namespace hh = hydro::hydrostatics;

/// `copies`.
struct Copies {
  int count = 0;
  Eigen::Vector3d step = Eigen::Vector3d::Zero();  ///< m
  std::optional<int> rows;                         ///< each of `count`
  std::optional<Eigen::Vector3d> row_step;         ///< m
};
constexpr int most_copies = 100'000;

const Binding<Copies>& copies() {
  static const Binding<Copies> binding =
      Binding<Copies>("[body.copies]", "makes name1, name2, … of one description")
          .key(integer("count", "number of bodies").within(Limit::at_least_one), &Copies::count)
          .at_most(most_copies)
          .key(vector("step", dim::length, "from each body to the next"), &Copies::step)
          .optional(integer("rows", "of so many bodies each: name1_1, name1_2, …, name2_1, …, the row first")
                        .within(Limit::at_least_one),
                    &Copies::rows)
          .only_beside({"row_step"})
          .optional(vector("row_step", dim::length, "from each row to the next"), &Copies::row_step)
          .only_beside({"rows"})
          .then([](const Record& record, const Copies& c) {
            if (c.rows && *c.rows > most_copies / c.count)
              throw record.wrong("rows", fmt::format("makes more than {} bodies", most_copies), "give fewer");
          });
  return binding;
}

using ByMode = std::map<hydro::Mode, double>;

/// One key for each mode, a length or an angle over `per`, of which one acts at least.
Binding<ByMode> by_mode(const std::string& title, const std::string& meaning, const hydro::Dimension& per,
                        const std::string& what) {
  Binding<ByMode> binding(title, meaning);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto mode = static_cast<hydro::Mode>(i);
    const auto dimension = (hydro::is_rotation(mode) ? dim::angle : dim::length) / per;
    binding.key(quantity(std::string(hydro::mode_names[i]), dimension, what + " in " + si_unit(dimension)).optional(),
                [mode](const Value& value, ByMode& out) { out[mode] = value.number; });
  }
  return binding.at_least_one_of({hydro::mode_names.begin(), hydro::mode_names.end()});
}

using HullCylinders = std::vector<hh::CircularCylinder>;

/// One for each pair of ends.
void read_hull_cylinders(const Record& record, HullCylinders& out) {
  const auto &from = record["from"].points.front(), &to = record["to"].points.front();
  if (from.size() != to.size())
    throw record.wrong("to", fmt::format("gives {} points, `from` gives {}", to.size(), from.size()),
                       "each cylinder needs both ends");
  for (std::size_t i = 0; i < from.size(); ++i) {
    if ((to[i] - from[i]).norm() <= 1e-9 * record.si("diameter"))
      throw record.wrong("to", "is where the cylinder begins", "give the middle of the other end");
    out.push_back({from[i], to[i], record.si("diameter") / 2});
  }
}

Binding<HullCylinders> hull_cylinders() {
  return Binding<HullCylinders>("[body.buoyancy.cylinders]", "circular cylinders with flat ends, exact without a mesh")
      .key(points("from", "middle of one end, body axes; each ± makes two cylinders"))
      .key(points("to", "middle of the other end, body axes; as many as `from`, taken in pairs"))
      .key(quantity("diameter", dim::length, "of each").positive())
      .then(read_hull_cylinders);
}

Binding<std::vector<hh::Sphere>> hull_spheres() {
  return Binding<std::vector<hh::Sphere>>("[body.buoyancy.spheres]", "spheres, exact without a mesh")
      .key(points("at", "centres, body axes; each ± makes two"))
      .key(quantity("diameter", dim::length, "of each").positive())
      .then([](const Record& record, std::vector<hh::Sphere>& out) {
        for (const Eigen::Vector3d& at : record["at"].points.front()) out.push_back({at, record.si("diameter") / 2});
      });
}

Binding<Buoyancy> buoyancy() {
  return Binding<Buoyancy>(
             "[body.buoyancy]",
             "load of still water on the hull as it is: exact at any pose in a run, its derivative at rest "
             "in responses and modes; the hull is all that is named here")
      .key(text("mesh", "of the hull in body axes, relative to the scene: STL, OBJ or GDF").optional(), &Buoyancy::mesh)
      .key(quantity("unit", dim::length, "what one unit of the mesh is; left out: metres, or what the file says")
               .positive()
               .optional()
               .only_beside("mesh"),
           &Buoyancy::unit)
      .key(effect("mesh_of_hydrodynamics", "the hull is the mesh of [body.hydrodynamics], which is named once")
               .optional(),
           &Buoyancy::of_hydrodynamics)
      .key(quantity("freeboard", dim::length,
                    "height of walls drawn straight up from the rim of an open mesh, with a deck on them")
               .positive()
               .optional()
               .only_beside_one_of({"mesh", "mesh_of_hydrodynamics"}),
           &Buoyancy::freeboard)
      .table("cylinders", hull_cylinders(), &Buoyancy::cylinders)
      .optional()
      .table("spheres", hull_spheres(), &Buoyancy::spheres)
      .optional()
      .at_least_one_of({"mesh", "mesh_of_hydrodynamics", "cylinders", "spheres"})
      .at_most_one_of({"mesh", "mesh_of_hydrodynamics"})
      .place(&Buoyancy::place);
}

/// Data are mostly rounded to three or four digits, and a flat plate meets the bound exactly.
constexpr double inertia_rounding = 1e-3;

/// A rigid body's principal moments are positive and none exceeds the sum of the other two, because
/// I₁ + I₂ − I₃ = 2 ∫ x₃² dm >= 0 (derived in docs/guide/scenes.md).
void check_inertia(const Record& record, std::string_view key, const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d principal = hydro::dense::symmetric_eigenvalues(inertia);
  if (!(principal[0] > 1e-12 * principal[2]))  // round-off of the eigenvalues
    throw record.wrong(key, fmt::format("gives a principal moment of inertia of {:.6g} kg m^2", principal[0]),
                       "a rigid body has three positive ones; check the products of inertia");
  if (principal[2] > (principal[0] + principal[1]) * (1 + inertia_rounding))
    throw record.wrong(
        key,
        fmt::format("gives principal moments {:.6g}, {:.6g}, {:.6g} kg m^2; of a rigid body none exceeds "
                    "the sum of the other two (by more than {} of it)",
                    principal[0], principal[1], principal[2], inertia_rounding),
        "check the order of the components and the unit");
}

Eigen::Matrix3d read_inertia(const Record& record, double mass, bool needed) {
  Eigen::Matrix3d inertia = mass * Eigen::Matrix3d::Identity();
  std::string_view key = "radii_of_gyration";
  if (record.has(key)) {
    inertia = (mass * record.vector(key).array().square()).matrix().asDiagonal();
  } else if (record.has("inertia")) {
    key = record["products_of_inertia"].defaulted ? "inertia" : "products_of_inertia";
    inertia = record.vector("inertia").asDiagonal();
    const Eigen::Vector3d products = record.vector("products_of_inertia");  // I = ∫ (r² δ − r rᵀ) dm
    inertia(0, 1) = inertia(1, 0) = -products[0];
    inertia(0, 2) = inertia(2, 0) = -products[1];
    inertia(1, 2) = inertia(2, 1) = -products[2];
  } else if (needed) {
    throw record.refused("may rotate and needs radii_of_gyration or inertia",
                         "give one of them, or free only translations: free = [\"surge\", \"heave\"]");
  } else {
    return inertia;
  }
  check_inertia(record, key, inertia);
  return inertia;
}

/// Along its direction, of unit length.
void read_normal(const Value& value, Section& out) {
  const Eigen::Vector3d& given = value.points.front().front();
  out.normal = given.norm() > 0 ? Eigen::Vector3d(given.normalized()) : given;
}

Binding<Section> section() {
  return Binding<Section>(
             "[[body.section]]",
             "a plane that cuts the body, at which responses tell six loads: what the rest of the body exerts on the "
             "part that is described here, along body axes")
      .key(name_key("", "of the section; its signals are called BODY.SECTION.force_x to moment_z"), &Section::name)
      .key(vector("at", dim::length, "a point of the plane, from the body's origin, body axes; moments are about it"),
           &Section::at)
      .key(vector("normal", dim::none, "of the plane, into the part that is described, body axes, of any length")
               .or_default("(1, 0, 0)", "sections are mostly across the length, and tell loads on what is ahead"),
           read_normal)
      .key(quantity("mass", dim::mass, "of that part").positive(), &Section::mass)
      .key(vector("centre_of_gravity", dim::length, "of that part, from the body's origin, body axes"),
           &Section::centre_of_gravity)
      .key(
          vector("radii_of_gyration", dim::length,
                 "of that part about its centre of gravity along body axes: I = mass · radius²; no products of inertia")
              .positive()
              .optional())
      .key(vector("inertia", dim::inertia, "of that part, (Ixx, Iyy, Izz) about its centre of gravity, body axes")
               .positive()
               .optional())
      .key(vector("products_of_inertia", dim::inertia,
                  "of that part, (∫xy dm, ∫xz dm, ∫yz dm) from its centre of gravity")
               .or_default("(0, 0, 0) kg m^2", "body axes are mostly principal axes")
               .only_beside("inertia"))
      .key(number("accept_error",
                  "largest error by panels that its loads may have, of the peak of each, where the accuracy asked is "
                  "missed")
               .positive()
               .optional(),
           &Section::accepted_error)
      .exactly_one_of({"radii_of_gyration", "inertia"})
      .place(&Section::place)
      .then([](const Record& record, Section& out) {
        if (out.normal.norm() == 0)
          throw record.wrong("normal", "has no length", "give a direction, such as (1, 0, 0)");
        out.inertia = read_inertia(record, out.mass, true);
      });
}

/// Sections take pressures, which only a mesh has, and weigh no more than the whole.
void require_sections_of_mesh(const Record& record, const Body& body) {
  const std::vector<Record>& tables = record.tables("section");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (!body.hydrodynamics || !body.hydrodynamics->mesh)
      throw tables[i].refused("needs the pressure on the hull, and only [body.hydrodynamics] with a mesh tells it",
                              "name the hull there, mesh = \"hull.stl\", in place of a file of coefficients");
    if (body.sections[i].mass > body.mass * (1 + 1e-9))  // rounding of a sum
      throw tables[i].wrong("mass", fmt::format("is more than that of the body, {:.6g} kg", body.mass),
                            "give the mass of the part into which `normal` points");
    for (std::size_t j = 0; j < i; ++j)
      if (body.sections[j].name == body.sections[i].name)
        throw tables[i].wrong("name", "is that of an earlier section of this body", "give each its own");
  }
}

/// Linear hydrostatics hold buoyancy and weight already.
void require_nothing_twice(const Record& record, const Body& body) {
  if (!body.hydrodynamics || !body.hydrodynamics->hydrostatics) return;
  if (body.weight)
    throw record.wrong("weight", "would act twice: linear hydrostatics are about the balance of buoyancy and weight",
                       "leave out `weight`");
  if (body.buoyancy)
    throw record.table("buoyancy")
        .refused("would act twice: linear hydrostatics hold buoyancy and weight",
                 "leave out `hydrostatics` and add weight = true, or leave out buoyancy");
}

/// A hull is named once, for waves and for still water.
void share_mesh(const Record& record, Body& body) {
  if (!body.buoyancy || !body.buoyancy->of_hydrodynamics) return;
  const Record& table = record.table("buoyancy");
  if (!body.hydrodynamics || !body.hydrodynamics->mesh)
    throw table.wrong("mesh_of_hydrodynamics", "is of a body that has no mesh in [body.hydrodynamics]",
                      "name the mesh here: mesh = \"hull.stl\"");
  const HullMesh& mesh = *body.hydrodynamics->mesh;
  body.buoyancy->mesh = {mesh.file, table["mesh_of_hydrodynamics"].place};
  body.buoyancy->unit = mesh.unit;
  body.buoyancy->reverse = mesh.reverse;
}

void require_what_rotation_needs(const Record& record, Body& body) {
  const bool rotates = body.free[3] || body.free[4] || body.free[5];
  if (rotates && !record.has("centre_of_gravity"))
    throw record.refused("may rotate and needs centre_of_gravity", "add centre_of_gravity = \"(0, 0, 1.31) m\"");
  body.inertia = read_inertia(record, body.mass, rotates);
}

void require_free_modes(const Record& record, const Body& body) {
  for (const char* key : {"initial", "initial_velocity"}) {
    if (!record.has(key)) continue;
    const Record& table = record.table(key);
    for (std::size_t i = 0; i < 6; ++i)
      if (table.has(hydro::mode_names[i]) && !body.free[i])
        throw table.wrong(hydro::mode_names[i], "moves a mode that is held",
                          "add the mode to `free`, or leave it out here");
  }
}

/// The axes of cylinders are given where they pierce still water, whose height in body axes is known.
void require_at_still_water(const Record& cylinders, double height_of_origin) {
  for (const Eigen::Vector3d& p : cylinders["at"].points.front())
    if (std::abs(p.z() + height_of_origin) > 1e-9)
      throw cylinders.wrong(
          "at", fmt::format("has z = {:.6g} m; still water is at {:.6g} m in body axes", p.z(), -height_of_origin),
          "give the axes at the height of still water");
  for (const Record& other : cylinders.tables("others")) require_at_still_water(other, height_of_origin);
}

const Binding<Body>& body() {
  static const Binding<Body> binding =
      Binding<Body>("[[body]]", "a rigid body; its axes are x forward, y port, z up")
          .place(&Body::place)
          .key(name_key("", "of the body; other tables and signals refer to it"), &Body::family)
          .key(inner_table("copies", copies().table()).optional())
          .key(vector("position", dim::length, "of the body's origin at rest, global; z from still water")
                   .or_default("(0, 0, 0) m", "one body is best described about the still waterplane"),
               &Body::position)
          .key(quantity("mass", dim::mass, "of the body with all it carries").positive(), &Body::mass)
          .key(vector("centre_of_gravity", dim::length, "from the origin, body axes; needed if a rotation is free")
                   .optional(),
               &Body::centre_of_gravity)
          .key(vector("radii_of_gyration", dim::length,
                      "about the centre of gravity along body axes: I = mass · radius²; no products of inertia")
                   .positive()
                   .optional())
          .key(vector("inertia", dim::inertia, "(Ixx, Iyy, Izz) about the centre of gravity, body axes")
                   .positive()
                   .optional())
          .key(vector("products_of_inertia", dim::inertia,
                      "(∫xy dm, ∫xz dm, ∫yz dm) from the centre of gravity; the inertia matrix holds them with a minus")
                   .or_default("(0, 0, 0) kg m^2", "body axes are mostly principal axes")
                   .only_beside("inertia"))
          .key(effect("weight",
                      "gravity pulls at the centre of gravity; for a body whose hydrostatics are not linear (those "
                      "hold the weight already)"),
               &Body::weight)
          .key(effect("net_load",
                      "all loads on the body together are signals: net_force_x to net_moment_z, about its origin along "
                      "global axes"),
               &Body::net_load)
          .key(effect("energy",
                      "the body's own energy is a signal, of its mass alone: energy.kinetic, and where it has weight "
                      "energy.potential, its weight times the height of its centre of gravity above that at rest"),
               &Body::energy)
          .key(modes("free", "modes that may move; the others are held")
                   .or_default("surge, sway, heave, roll, pitch, yaw", "a body is free unless something holds it"),
               &Body::free)
          .table("initial",
                 by_mode("[body.initial]",
                         "displacement from rest at t = 0, of the body's origin; turned by yaw first, then pitch, then "
                         "roll, as records tell it",
                         dim::none, "displacement"),
                 &Body::initial)
          .optional()
          .table("initial_velocity",
                 by_mode("[body.initial_velocity]",
                         "velocity at t = 0, of the body's origin; angular velocity along global axes", dim::time,
                         "velocity"),
                 &Body::initial_velocity)
          .optional()
          .table("buoyancy", buoyancy(), &Body::buoyancy)
          .table("hydrodynamics", hydrodynamics_binding(), &Body::hydrodynamics)
          .table("second_order", second_order_binding(), &Body::second_order)
          .tables("section", section(), &Body::sections)
          .optional()
          .at_most_one_of({"radii_of_gyration", "inertia"})
          .then(require_what_rotation_needs)
          .then(require_free_modes)
          .then(require_nothing_twice)
          .then(share_mesh)
          .then(require_sections_of_mesh)
          .then([](const Record& record, const Body& body) {
            if (body.hydrodynamics && body.hydrodynamics->cylinders)
              require_at_still_water(record.table("hydrodynamics").table("cylinders"), body.position.z());
          });
  return binding;
}

}  // namespace

const Table& body_table() { return body().table(); }

std::vector<Body> build_bodies(const Record& root, Names& names) {
  std::vector<Body> bodies;
  for (const Record& record : root.tables("body")) {
    const Body one = body().read(record);
    const auto add = [&](int copy, const std::string& name, const Eigen::Vector3d& moved) {
      bodies.push_back(one);
      bodies.back().copy = copy;
      bodies.back().name = name;
      bodies.back().position += moved;
      names.add(name, record["name"].place);
    };
    if (!record.has("copies")) {
      add(0, one.family, Eigen::Vector3d::Zero());
      continue;
    }
    const Copies c = copies().read(record.table("copies"));
    for (int i = 1; i <= c.count && !c.rows; ++i) add(i, fmt::format("{}{}", one.family, i), (i - 1) * c.step);
    for (int row = 1; row <= c.rows.value_or(0); ++row)
      for (int i = 1; i <= c.count; ++i)
        add((row - 1) * c.count + i, grid_name(one.family, row, i), (i - 1) * c.step + (row - 1) * *c.row_step);
  }
  return bodies;
}

}  // namespace froude::scene
