/// \file  The tables of a scene of motion: what may be written, what it means, what is filled in and why.
#include "hydro/base/types.hpp"
#include "hydro/potential/check.hpp"
#include "scene/schema.hpp"
#include "scene/schema_contact.hpp"
#include "scene/schema_joint.hpp"
#include "scene/schema_line.hpp"
#include "scene/schema_members.hpp"
#include "scene/schema_waves.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using hydro::Mode;
using enum Group::Count;

bool rotates(std::size_t mode) { return hydro::is_rotation(static_cast<Mode>(mode)); }

std::vector<std::string> mode_words() { return {hydro::mode_names.begin(), hydro::mode_names.end()}; }

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

/// The six diagonal and fifteen other entries of a symmetric 6 × 6 matrix: surge, …, yaw, surge_sway, …, pitch_yaw.
std::vector<Key> keys_of_matrix(const hydro::Dimension& translation, const std::string& what) {
  std::vector<Key> keys;
  const auto entry = [&](std::size_t i, std::size_t j) {
    auto dimension = translation;  // N/m → N/rad → N m/rad
    if (rotates(i) != rotates(j)) dimension = translation * dim::length / dim::angle;
    if (rotates(i) && rotates(j)) dimension = translation * dim::area / dim::angle;
    const std::string row(hydro::mode_names[i]), column(hydro::mode_names[j]);
    keys.push_back(i == j ? quantity(row, dimension, "load in " + row + " per " + what + " in " + row).optional()
                          : quantity(row + "_" + column, dimension,
                                     "load in " + row + " per " + what + " in " + column + ", and the reverse")
                                .optional());
  };
  for (std::size_t i = 0; i < 6; ++i) entry(i, i);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j) entry(i, j);
  return keys;
}

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}

/// A table in which each key names one thing that acts, so an empty one is a slip.
Table at_least_one_of(std::string title, std::string meaning, std::vector<Key> keys) {
  auto names = names_of(keys);
  return {.title = std::move(title),
          .meaning = std::move(meaning),
          .keys = std::move(keys),
          .groups = {{at_least_one, names}}};
}

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
               text("method",
                    "\"direct\" or \"partitioned\" convolution, \"poles\" (sum of exponentials), or, in one regular "
                    "wave and once the motion is steady, \"constant\" added mass and damping")
                   .one_of({"automatic", "direct", "partitioned", "poles", "constant"})
                   .or_default("automatic", "the program knows error and cost of each; `froude plan` shows them")},
      .groups = {{at_most_one, {"memory_tolerance", "memory"}}}};
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
      .keys = {text("file", "of coefficients, relative to the scene: any format of `froude bem info`").optional(),
               inner_table("cylinders", cylinders()).optional(),
               integer("body",
                       "which body of the file, from 1 (copies take the following ones); needed where the scene takes "
                       "fewer than the file holds")
                   .within(Limit::at_least_one)
                   .optional()
                   .only_beside("file"),
               vector("reference_point", dim::length,
                      "global, what the coefficients are about, if the file does not say")
                   .optional()
                   .only_beside("file"),
               quantity(
                   "ulen", dim::length,
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
               inner_table("radiation", radiation()).optional(),
               effect("hydrostatics", "restoring loads of buoyancy and weight"),
               text("interaction",
                    "\"full\": bodies of one file feel each other's radiated waves; \"self\": only their own")
                   .one_of({"full", "self"})
                   .or_default("full", "leaving it out would be an approximation")
                   .only_beside("radiation")},
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
  static const Table table = at_least_one_of("[body.initial]", "displacement from rest at t = 0, of the body's origin",
                                             keys_of_modes(dim::none, "displacement"));
  return table;
}

const Table& initial_velocity() {
  static const Table table = at_least_one_of("[body.initial_velocity]", "velocity at t = 0, of the body's origin",
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

const Table& mooring_stiffness() {
  static const Table table = at_least_one_of("[mooring.stiffness]", "about the body's origin, at rest; symmetric",
                                             keys_of_matrix(dim::stiffness, "displacement"));
  return table;
}

const Table& mooring_damping() {
  static const Table table = at_least_one_of("[mooring.damping]", "about the body's origin; symmetric",
                                             keys_of_matrix(dim::damping, "velocity"));
  return table;
}

const Table& mooring() {
  static const Table table{
      .title = "[[mooring]]",
      .meaning = "what holds a body in place",
      .keys = {name_key("mooring", "of the mooring"),
               texts("on", "bodies it holds, by name; * stands for any characters"), text("kind", "of mooring")},
      .chosen_by = "kind",
      .variants = {
          {.word = "linear",
           .meaning = "load proportional to displacement and velocity",
           .keys = {inner_table("stiffness", mooring_stiffness()).optional(),
                    inner_table("damping", mooring_damping()).optional()},
           .groups = {{at_least_one, {"stiffness", "damping"}}}},
          {.word = "catenary",
           .meaning = "elastic lines in their static shape, from each body to the ground",
           .keys = {points("from", "fairlead, body axes; each ± makes two lines"),
                    points("to", "anchor, global; as many as `from`, taken in pairs"),
                    quantity("length", dim::length, "of the line without tension").positive(),
                    quantity("mass_per_length", dim::mass / dim::length, "of the line, in air").positive(),
                    quantity("diameter", dim::length, "of the line, by the water that it displaces").positive(),
                    quantity("axial_stiffness", dim::force, "EA: tension per strain").positive(),
                    effect("on_bed", "the anchor lies on a flat bed, on which the line may rest, without friction")
                        .optional()}}}};
  return table;
}

Key rest_length() {
  return quantity("rest_length", dim::length, "without tension, or \"as placed\": the distance of the ends at rest")
      .positive()
      .one_of({"as placed"})
      .or_default("as placed", "so that the scene is at rest where it is placed");
}

const Table& switch_setting() {
  static const Table table{
      .title = "[[connector.switch.settings]]",
      .meaning = "a stiffness from some period on",
      .keys = {quantity("from", dim::time, "period; the first is \"0 s\"").within(Limit::not_negative),
               quantity("stiffness", dim::stiffness, "of each connector").positive()}};
  return table;
}

const Table& connector_switch() {
  static const Table table{
      .title = "[connector.switch]",
      .meaning = "sets the stiffness by the period that dominates a motion, once two checks in turn agree",
      .keys = {text("watch", "a motion, like \"m2.surge\""),
               quantity("every", dim::time, "from one check to the next").positive(),
               quantity("window", dim::time, "of the motion that a check looks at; some periods").positive(),
               quantity("hysteresis", dim::angular_velocity,
                        "by which the frequencies of two checks in turn may differ: \"0.001 Hz\"")
                   .positive(),
               quantity("dwell", dim::time, "least time between two switches")
                   .within(Limit::not_negative)
                   .or_default("0 s", "two checks that agree are enough"),
               inner_tables("settings", switch_setting())}};
  return table;
}

const Table& connector() {
  static const Table table{
      .title = "[[connector]]",
      .meaning = "joins a point of one body to a point of another, or to the ground",
      .keys = {name_key("connector", "of the connector"),
               texts("between",
                     "[\"a\", \"b\"], [\"a\", \"ground\"], or \"neighbours of m\": m1–m2, m2–m3, … of the copies m"),
               ends("ends",
                    "[end on the first, end on the second], body axes (ground: global axes); ± makes several, taken in "
                    "pairs"),
               text("kind", "of connector")},
      .chosen_by = "kind",
      .variants = {
          {.word = "axial",
           .meaning = "a load along the line between its ends",
           .keys = {quantity("stiffness", dim::stiffness, "tension per elongation").positive().optional(),
                    quantity("cubic", dim::stiffness / dim::area, "tension per elongation cubed, beside stiffness")
                        .optional()
                        .only_beside("stiffness"),
                    quantity("damping", dim::damping, "tension per rate of elongation").positive().optional(),
                    quantity("quadratic_damping", dim::force / (dim::velocity * dim::velocity),
                             "tension per rate of elongation times its size")
                        .positive()
                        .optional(),
                    rest_length().only_beside("stiffness"),
                    inner_table("switch", connector_switch()).optional().only_beside("stiffness")},
           .groups = {{at_least_one, {"stiffness", "damping", "quadratic_damping"}}}},
          {.word = "tabulated",
           .meaning = "as axial, with a spring by a table",
           .keys = {text("table",
                         "CSV beside the scene: columns elongation [m], increasing, and tension [N], not falling; "
                         "straight between points and beyond the ends"),
                    quantity("damping", dim::damping, "tension per rate of elongation").positive().optional(),
                    rest_length()},
           .groups = {}},
          {.word = "cable",
           .meaning = "as axial, but it never pushes: slack where it is shorter than its rest length",
           .keys = {quantity("stiffness", dim::stiffness, "tension per elongation").positive(),
                    quantity("damping", dim::damping, "tension per rate of elongation, as far as the cable is tight")
                        .positive()
                        .optional(),
                    rest_length()},
           .groups = {}},
          {.word = "bushing",
           .meaning = "loads and moments along the axes of the first body",
           .keys = {vector("stiffness", dim::stiffness, "along x, y, z").within(Limit::not_negative).optional(),
                    vector("damping", dim::damping, "along x, y, z").within(Limit::not_negative).optional(),
                    vector("rotational_stiffness", dim::rotational_stiffness, "about x, y, z")
                        .within(Limit::not_negative)
                        .optional(),
                    vector("rotational_damping", dim::rotational_damping, "about x, y, z")
                        .within(Limit::not_negative)
                        .optional()},
           .groups = {{at_least_one, {"stiffness", "damping", "rotational_stiffness", "rotational_damping"}}}}}};
  return table;
}

Key asked_signals() {
  return texts("of", "signals to give, like \"m*.surge\" or \"connector*.force\"; * stands for any characters")
      .or_default("*", "everything there is");
}

const Table& ask_rao_drag() {
  static const Table table{
      .title = "[ask.rao.drag]",
      .meaning =
          "drag of [member.drag] at each frequency, linear, losing as much energy as it does in waves this high; "
          "left out: without drag",
      .keys = {quantity("height", dim::length, "of the waves, at every frequency").positive().optional(),
               number("steepness", "height over length of the waves, at every frequency").positive().optional()},
      .groups = {{exactly_one, {"height", "steepness"}}}};
  return table;
}

const Table& ask_rao() {
  static const Table table{
      .title = "[ask.rao]",
      .meaning = "response per metre of wave amplitude",
      .keys = {range("periods", dim::time, "wave periods").positive().optional(),
               range("omega", dim::angular_velocity, "wave frequencies").positive().optional(),
               quantity("heading", dim::angle, "where the waves go; left out: the heading of [waves]").optional(),
               inner_table("drag", ask_rao_drag()).optional(), asked_signals()},
      .groups = {{exactly_one, {"periods", "omega"}}}};
  return table;
}

const Table& ask_run() {
  static const Table table{
      .title = "[ask.run]",
      .meaning = "time series",
      .keys = {
          quantity("duration", dim::time, "of the run, a whole multiple of `every`").positive(),
          quantity("every", dim::time, "between stored samples").positive(),
          text("start",
               "\"as placed\"; in \"equilibrium\": where the bodies balance without waves; or \"steady\", for linear "
               "scenes: as if the sea had always been there, answered by transfer functions without a step")
              .one_of({"as placed", "equilibrium", "steady"})
              .or_default("as placed", "where the scene puts them is where they begin"),
          asked_signals()}};
  return table;
}

const Table& ask_modes() {
  static const Table table{
      .title = "[ask.modes]",
      .meaning = "free motions about rest: periods, damping, shapes",
      .keys = {quantity("shortest", dim::time, "no mode of a shorter period").positive().optional(),
               quantity("longest", dim::time, "no mode of a longer period").positive().optional()}};
  return table;
}

const Table& ask() {
  static const Table table{
      .title = "[ask]",
      .meaning = "what is wanted",
      .keys = {inner_table("rao", ask_rao()).optional(), inner_table("modes", ask_modes()).optional(),
               inner_table("run", ask_run()).optional(), inner_table("waves", ask_waves_table()).optional(),
               number("accuracy", "relative, of what is asked")
                   .within(Limit::open_fraction)
                   .or_default("1e-2", "about what coefficients and measurements are good for")},
      .groups = {{at_least_one, {"rao", "modes", "run", "waves"}}}};
  return table;
}

const Table& integrator() {
  static const Table table{
      .title = "[solve.integrator]",
      .meaning = "how time is stepped",
      .keys = {
          text("name",
               "of the method: generalized_alpha; energy_momentum keeps momentum, and energy of joints and weights, "
               "and damps "
               "nothing; explicit_pair, of orders 5 and 4, cuts steps by its own error; implicit_euler and "
               "semi_implicit_euler, of order 1, show what they cost")
              .one_of(
                  {"generalized_alpha", "energy_momentum", "explicit_pair", "implicit_euler", "semi_implicit_euler"})
              .or_default("generalized_alpha", "second order, damps only what the step cannot resolve"),
          number("rho_infinity",
                 "of generalized_alpha: spectral radius at infinite frequency: 1 damps nothing, 0 all at once")
              .within(Limit::fraction)
              .or_default("0.8", "kills what is not resolved within some steps, leaves the rest alone"),
          number("tolerance", "of explicit_pair: local error of a step relative to what moves in it")
              .positive()
              .or_default("1e-8", "far below any other error of a run"),
          text("lines",
               "how each [[line]] is stepped; left out: energy_momentum, which keeps energy and lengths at any step")
              .one_of({"energy_momentum", "generalized_alpha", "gamma", "semi_implicit_euler", "explicit_euler"})
              .optional(),
          number("gamma", "share of the new state in a step of lines = \"gamma\"; left out: 0.51")
              .positive()
              .optional()}};
  return table;
}

const Table& solve() {
  static const Table table{.title = "[solve]",
                           .meaning = "overrides what the program would choose; rarely needed",
                           .keys = {quantity("step", dim::time, "time step, or \"automatic\"")
                                        .positive()
                                        .one_of({"automatic"})
                                        .or_default("automatic", "chosen from the accuracy asked"),
                                    inner_table("integrator", integrator()).or_default("", "see its keys")}};
  return table;
}

}  // namespace

const Table& motion_schema() {
  static const Table table{
      .title = "a scene",
      .meaning = "floating bodies in waves",
      .keys = {integer("schema", "version of this grammar, 1"), text("title", "for people").optional(),
               texts("include",
                     "results of `froude fit -o`: with \"fit.toml\", a text \"fit.cd\" stands for the number cd of its "
                     "[coefficients]")
                   .optional(),
               inner_table("water", water()), inner_table("waves", waves_table()).optional(),
               inner_table("current", current_table()).optional(), inner_tables("body", body()).optional(),
               inner_tables("probe", probe_table()).optional(), inner_tables("member", member_table()).optional(),
               inner_tables("line", line_table()).optional(), inner_tables("mooring", mooring()).optional(),
               inner_tables("connector", connector()).optional(), inner_tables("joint", joint_table()).optional(),
               inner_tables("load", load_table()).optional(), inner_tables("contact", contact_table()).optional(),
               inner_table("ask", ask()), inner_table("solve", solve()).or_default("", "see its keys")}};
  return table;
}

}  // namespace froude::scene
