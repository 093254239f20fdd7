/// \file  The tables of a scene of motion: what may be written, what it means, what is filled in and why.
#include "hydro/potential/check.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"
#include "scene/schema.hpp"
#include "scene/schema_connections.hpp"
#include "scene/schema_contact.hpp"
#include "scene/schema_joint.hpp"
#include "scene/schema_line.hpp"
#include "scene/schema_members.hpp"
#include "scene/schema_modes.hpp"
#include "scene/schema_signals.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using enum Group::Count;

/// One key for each mode, a length or an angle over `per`.
std::vector<Key> keys_of_modes(const hydro::Dimension& per, const std::string& what) {
  std::vector<Key> keys;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto dimension = (rotates(i) ? dim::angle : dim::length) / per;
    keys.push_back(
        quantity(std::string(hydro::mode_names[i]), dimension, what + " in " + si_unit(dimension)).optional());
  }
  return keys;
}

std::vector<std::string> mode_words() { return {hydro::mode_names.begin(), hydro::mode_names.end()}; }

const Table& water() {
  static const Table table{.title = "[water]",
                           .meaning = "the water, still",
                           .keys = {quantity("density", dim::density, "of the water").positive(),
                                    quantity("gravity", dim::acceleration, "acceleration of free fall")
                                        .positive()
                                        .or_default("9.81 m/s^2", "what hydrodynamic data are mostly computed with"),
                                    quantity("depth", dim::length, "from still water to the bottom, or \"infinite\"")
                                        .positive()
                                        .one_of({"infinite"})}};
  return table;
}

const Table& copies() {
  static const Table table{.title = "[body.copies]",
                           .meaning = "makes name1, name2, … of one description",
                           .keys = {integer("count", "number of bodies").within(Limit::at_least_one),
                                    vector("step", dim::length, "from each body to the next")}};
  return table;
}

const Table& radiation() {
  static const Table table{
      .title = "[body.hydrodynamics.radiation]",
      .meaning = "waves that the motion makes: added mass, damping and their memory; may be empty",
      .keys = {number("memory_tolerance",
                      "error of the force that a method may make, relative; the cheapest within it is taken")
                   .within(Limit::open_fraction)
                   .or_default("1e-3", "ten times less than the accuracy usually asked"),
               quantity("memory", dim::time, "length of the memory of a convolution, where you want to fix it")
                   .positive()
                   .optional(),
               number(
                   "accept_error",
                   "error of that force, relative, that you take where no memory is within the tolerance; without it "
                   "such a run is refused")
                   .positive()
                   .optional(),
               text("method",
                    "\"direct\" or \"partitioned\" convolution, \"poles\" (sum of exponentials), or, in one regular "
                    "wave and once the motion is steady, \"constant\" added mass and damping")
                   .one_of({"automatic", "direct", "partitioned", "poles", "constant"})
                   .or_default("automatic", "the program knows error and cost of each; `froude plan` shows them")},
      .groups = {{at_most_one, {"memory_tolerance", "memory"}}}};
  return table;
}

const Table& turning() {
  static const Table table{
      .title = "[body.hydrodynamics.turning]",
      .meaning = "excitation for the heading that a slow yaw of the body leaves, in runs",
      .keys = {quantity("from", dim::angle, "least yaw that is tabled, from rest"),
               quantity("to", dim::angle, "largest; a run in which the slow yaw goes beyond stops"),
               quantity("spacing", dim::angle, "of the yaws in the table; straight between them")
                   .positive()
                   .or_default("5 deg", "finer than the headings of most data"),
               quantity("slower_than", dim::time,
                        "what counts as slow: yaw is averaged over times up to this, by a lag of this over 2π")
                   .positive()}};
  return table;
}

std::vector<Key> keys_of_equal_cylinders() {
  return {points("at", "axes where they meet still water, body axes; each ± makes two"),
          quantity("diameter", dim::length, "of each").positive(),
          quantity("draught", dim::length, "depth of the bottom of each, or \"to the sea bed\"")
              .positive()
              .one_of({"to the sea bed"}),
          quantity("top", dim::length, "depth of the top of each; left out: they pierce the surface")
              .positive()
              .optional()};
}

const Table& other_cylinders() {
  static const Table table{.title = "[[body.hydrodynamics.cylinders.others]]",
                           .meaning = "cylinders of another size in the same body",
                           .keys = keys_of_equal_cylinders()};
  return table;
}

const Table& cylinders() {
  static const Table table = [] {
    Table out{.title = "[body.hydrodynamics.cylinders]",
              .meaning = "vertical cylinders: the program computes their coefficients exactly, with interaction",
              .keys = keys_of_equal_cylinders()};
    out.keys.push_back(inner_tables("others", other_cylinders()).optional());
    out.keys.push_back(range("frequencies", dim::angular_velocity,
                             "of the table that is computed: \"0.2 rad/s .. 4 rad/s, 39 values\""));
    out.keys.push_back(range("headings", dim::angle, "of the table; without it those of [waves] and [ask]").optional());
    return out;
  }();
  return table;
}

const Table& hydrodynamics() {
  static const Table table{
      .title = "[body.hydrodynamics]",
      .meaning = "linear potential theory, with coefficients from a file or of cylinders; each effect is named",
      .keys =
          {text("file", "of coefficients, relative to the scene: any format of `froude bem info`").optional(),
           inner_table("cylinders", cylinders()).optional(),
           integer("body",
                   "which body of the file, from 1 (copies take the following ones); needed where the scene takes "
                   "fewer than the file holds")
               .within(Limit::at_least_one)
               .optional()
               .only_beside("file"),
           vector("reference_point", dim::length, "global, what the coefficients are about, if the file does not say")
               .optional()
               .only_beside("file"),
           quantity("displaced_volume", dim::volume,
                    "of the body at rest, if the file does not say; a body on joints needs it, since they carry what "
                    "buoyancy and weight differ by")
               .positive()
               .optional()
               .only_beside("file"),
           vector("centre_of_buoyancy", dim::length,
                  "of the body at rest, body axes, if the file does not say; of a body on joints buoyancy acts here")
               .optional()
               .only_beside("file"),
           quantity("ulen", dim::length,
                    "WAMIT's ULEN; only for WAMIT files, where it is 1 m unless this or the .out file says otherwise")
               .positive()
               .optional()
               .only_beside("file"),
           integer("iperout", "WAMIT's IPEROUT, 1 to 4; only for WAMIT files")
               .within(Limit::at_least_one)
               .optional()
               .only_beside("file"),
           texts("accept",
                 "findings of the doctor (`froude bem check`) that are known and shall not stop the scene; the "
                 "result records them")
               .one_of(hydro::potential::check_names())
               .optional()
               .only_beside("file"),
           effect("excitation", "loads of the incoming waves on the body held still"),
           texts("excitation_modes",
                 "of the loads about the body's centre of gravity, those that act; all, unless some shall be "
                 "suppressed to see what they do")
               .one_of(mode_words())
               .optional()
               .only_beside("excitation"),
           inner_table("turning", turning()).optional().only_beside("excitation"),
           inner_table("radiation", radiation()).optional(),
           effect("hydrostatics", "restoring loads of buoyancy and weight"),
           text(
               "interaction",
               "whose waves the body feels: \"full\": those of all bodies that make waves, which one file must hold or "
               "the program compute together; \"file\": of the bodies of its own file; \"self\": only its own")
               .one_of({"full", "file", "self"})
               .or_default("full", "leaving it out would be an approximation; where no waves can pass it is refused")
               .only_beside_one_of({"radiation", "excitation"})},
      .groups = {{exactly_one, {"file", "cylinders"}}, {at_least_one, {"excitation", "radiation", "hydrostatics"}}}};
  return table;
}

const Table& buoyant_cylinders() {
  static const Table table{
      .title = "[body.buoyancy.cylinders]",
      .meaning = "circular cylinders with flat ends, exact without a mesh",
      .keys = {points("from", "middle of one end, body axes; each ± makes two cylinders"),
               points("to", "middle of the other end, body axes; as many as `from`, taken in pairs"),
               quantity("diameter", dim::length, "of each").positive()}};
  return table;
}

const Table& buoyant_spheres() {
  static const Table table{.title = "[body.buoyancy.spheres]",
                           .meaning = "spheres, exact without a mesh",
                           .keys = {points("at", "centres, body axes; each ± makes two"),
                                    quantity("diameter", dim::length, "of each").positive()}};
  return table;
}

const Table& buoyancy() {
  static const Table table{
      .title = "[body.buoyancy]",
      .meaning =
          "load of still water on the hull as it is: exact at any pose in a run, its derivative at rest in "
          "responses and modes; the hull is all that is named here",
      .keys = {text("mesh", "of the hull in body axes, relative to the scene: STL, OBJ or GDF").optional(),
               quantity("unit", dim::length, "what one unit of the mesh is; left out: metres, or what the file says")
                   .positive()
                   .optional()
                   .only_beside("mesh"),
               quantity("freeboard", dim::length,
                        "height of walls drawn straight up from the rim of an open mesh, with a deck on them")
                   .positive()
                   .optional()
                   .only_beside("mesh"),
               inner_table("cylinders", buoyant_cylinders()).optional(),
               inner_table("spheres", buoyant_spheres()).optional()},
      .groups = {{at_least_one, {"mesh", "cylinders", "spheres"}}}};
  return table;
}

const Table& initial() {
  static const Table table = at_least_one_of("[body.initial]",
                                             "displacement from rest at t = 0, of the body's origin; turned by yaw "
                                             "first, then pitch, then roll, as records tell it",
                                             keys_of_modes(dim::none, "displacement"));
  return table;
}

const Table& initial_velocity() {
  static const Table table = at_least_one_of("[body.initial_velocity]",
                                             "velocity at t = 0, of the body's origin; angular velocity along global "
                                             "axes",
                                             keys_of_modes(dim::time, "velocity"));
  return table;
}

const Table& body() {
  static const Table table{
      .title = "[[body]]",
      .meaning = "a rigid body; its axes are x forward, y port, z up",
      .keys = {name_key("", "of the body; other tables and signals refer to it"),
               inner_table("copies", copies()).optional(),
               vector("position", dim::length, "of the body's origin at rest, global; z from still water")
                   .or_default("(0, 0, 0) m", "one body is best described about the still waterplane"),
               quantity("mass", dim::mass, "of the body with all it carries").positive(),
               vector("centre_of_gravity", dim::length, "from the origin, body axes; needed if a rotation is free")
                   .optional(),
               vector("radii_of_gyration", dim::length,
                      "about the centre of gravity along body axes: I = mass · radius²; no products of inertia")
                   .positive()
                   .optional(),
               vector("inertia", dim::inertia, "(Ixx, Iyy, Izz) about the centre of gravity, body axes")
                   .positive()
                   .optional(),
               vector("products_of_inertia", dim::inertia,
                      "(∫xy dm, ∫xz dm, ∫yz dm) from the centre of gravity; the inertia matrix holds them with a minus")
                   .or_default("(0, 0, 0) kg m^2", "body axes are mostly principal axes")
                   .only_beside("inertia"),
               effect("weight",
                      "gravity pulls at the centre of gravity; for a body whose hydrostatics are not linear (those "
                      "hold the weight already)"),
               effect("net_load",
                      "all loads on the body together are signals: net_force_x to net_moment_z, about its origin along "
                      "global axes"),
               texts("free", "modes that may move; the others are held")
                   .one_of(mode_words())
                   .or_default("surge, sway, heave, roll, pitch, yaw", "a body is free unless something holds it"),
               inner_table("initial", initial()).optional(),
               inner_table("initial_velocity", initial_velocity()).optional(),
               inner_table("buoyancy", buoyancy()).optional(),
               inner_table("hydrodynamics", hydrodynamics()).optional()},
      .groups = {{at_most_one, {"radii_of_gyration", "inertia"}}}};
  return table;
}

}  // namespace

const Table& motion_schema() {
  static const Table table{
      .title = "a scene",
      .meaning = "floating bodies in waves",
      .keys = {integer("schema", "version of this grammar, 1"),
               text("title", "for people").optional(),
               texts("include",
                     "results of `froude fit -o`: with \"fit.toml\", a text \"fit.cd\" stands for the number cd of its "
                     "[coefficients]")
                   .optional(),
               inner_table("water", water()),
               inner_table("waves", waves_binding().table()).optional(),
               inner_table("current", current_table()).optional(),
               inner_tables("body", body()).optional(),
               inner_tables("probe", probe_table()).optional(),
               inner_tables("point", point_table()).optional(),
               inner_tables("relative_motion", relative_motion_table()).optional(),
               inner_tables("member", member_table()).optional(),
               inner_tables("line", line_table()).optional(),
               inner_tables("junction", junction_table()).optional(),
               inner_tables("mooring", mooring_table()).optional(),
               inner_tables("connector", connector_table()).optional(),
               inner_tables("joint", joint_table()).optional(),
               inner_tables("load", load_table()).optional(),
               inner_tables("contact", contact_table()).optional(),
               inner_table("ask", ask_binding().table()),
               inner_table("solve", solve_binding().table()).or_default("", "see its keys")}};
  return table;
}

}  // namespace froude::scene
