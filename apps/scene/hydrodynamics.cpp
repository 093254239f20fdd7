/// \file  `[body.hydrodynamics]`: coefficients of a body from a file, of cylinders or of a mesh, and what of them acts.
#include "hydro/potential/doctor/check.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

Binding<Memory> radiation() {
  using enum Memory::Method;
  return Binding<Memory>("[body.hydrodynamics.radiation]",
                         "waves that the motion makes: added mass, damping and their memory; may be empty")
      .key(number("memory_tolerance",
                  "error of the force that a method may make, relative; the cheapest within it is taken")
               .within(Limit::open_fraction)
               .or_default("1e-3", "ten times less than the accuracy usually asked"),
           &Memory::tolerance)
      .key(quantity("memory", dim::time, "length of the memory of a convolution, where you want to fix it")
               .positive()
               .optional(),
           &Memory::length)
      .key(number("accept_error",
                  "error of that force, relative, that you take where no memory is within the tolerance; without "
                  "it such a run is refused")
               .positive()
               .optional(),
           &Memory::accepted_error)
      .words(text("method",
                  "\"direct\" or \"partitioned\" convolution, \"poles\" (sum of exponentials), or, in one regular "
                  "wave and once the motion is steady, \"constant\" added mass and damping")
                 .or_default("automatic", "the program knows error and cost of each; `froude plan` shows them"),
             {{"automatic", automatic},
              {"direct", direct},
              {"partitioned", partitioned},
              {"poles", poles},
              {"constant", constant}},
             &Memory::method)
      .at_most_one_of({"memory_tolerance", "memory"})
      .then([](const Record& record, Memory& out) {
        out.place = record["method"].place;
        if (out.length && (out.method == poles || out.method == constant))
          throw record.wrong("method", "has no length of memory", "leave out `memory`, or take a convolution");
      });
}

Binding<Turning> turning() {
  return Binding<Turning>("[body.hydrodynamics.turning]",
                          "excitation for the heading that a slow yaw of the body leaves, in runs")
      .key(quantity("from", dim::angle, "least yaw that is tabled, from rest"), &Turning::from)
      .key(quantity("to", dim::angle, "largest; a run in which the slow yaw goes beyond stops"), &Turning::to)
      .key(quantity("spacing", dim::angle, "of the yaws in the table; straight between them")
               .positive()
               .or_default("5 deg", "finer than the headings of most data"),
           &Turning::spacing)
      .key(quantity("slower_than", dim::time,
                    "what counts as slow: yaw is averaged over times up to this, by a lag of this over 2π")
               .positive(),
           &Turning::slower_than)
      .place(&Turning::place)
      .then([](const Record& record, const Turning& out) {
        if (!(out.from < out.to))
          throw record.wrong("to", "is not beyond `from`", "from = \"-30 deg\", to = \"30 deg\"");
      });
}

/// Equal cylinders, one for each axis.
void append_cylinders(const Record& record, Cylinders& out) {
  const std::optional<double> draught =
      record.text("draught").empty() ? std::optional(record.si("draught")) : std::nullopt;
  const std::optional<double> top = record.has("top") ? std::optional(record.si("top")) : std::nullopt;
  if (top && draught && *top >= *draught)
    throw record.wrong("top", "is not above the bottom", "both are depths, from still water down");
  for (const Eigen::Vector3d& at : record["at"].points.front())
    out.all.push_back({at.head<2>(), record.si("diameter") / 2, draught, top});
}

/// Cylinders of one size, as their own table or with what is common to all of a body.
Binding<Cylinders> equal_cylinders(const std::string& title, const std::string& meaning) {
  return Binding<Cylinders>(title, meaning)
      .key(points("at", "axes where they meet still water, body axes; each ± makes two"))
      .key(quantity("diameter", dim::length, "of each").positive())
      .key(quantity("draught", dim::length, "depth of the bottom of each, or \"to the sea bed\"")
               .positive()
               .one_of({"to the sea bed"}))
      .key(quantity("top", dim::length, "depth of the top of each; left out: they pierce the surface")
               .positive()
               .optional())
      .then(append_cylinders);
}

/// Where the program chooses frequencies: in (0, 1), its own limits are the solvers'.
Key frequency_tolerance() {
  return number(
             "frequency_tolerance",
             "largest error of B + iω(A − A(∞)) and X between solved frequencies, relative to the largest of the two "
             "modes: the program solves at `frequencies` first, five at least, then between them where responses "
             "bend, until interpolation foresees what it has not seen, and makes the table as fine as that takes; "
             "without it the table has just those of `frequencies`")
      .within(Limit::open_fraction)
      .optional();
}

Binding<Cylinders> cylinders() {
  static const Binding<Cylinders> others =
      equal_cylinders("[[body.hydrodynamics.cylinders.others]]", "cylinders of another size in the same body");
  return equal_cylinders("[body.hydrodynamics.cylinders]",
                         "vertical cylinders: the program computes their coefficients exactly, with interaction")
      .key(inner_tables("others", others.table()).optional(),
           [](const Value& value, Cylinders& out) {
             for (const Record& record : value.records) others.read_into(record, out);
           })
      .key(range("frequencies", dim::angular_velocity,
                 "of the table that is computed: \"0.2 rad/s .. 4 rad/s, 39 values\""),
           &Cylinders::omega)
      .key(frequency_tolerance(), &Cylinders::frequency_tolerance)
      .key(range("headings", dim::angle, "of the table; without it those of [waves] and [ask]").optional(),
           &Cylinders::headings);
}

/// What is said of a mesh beside it.
Binding<HullMesh> hull_mesh() {
  return Binding<HullMesh>("[body.hydrodynamics]", "the hull as a mesh")
      .key(text("mesh",
                "of the hull in body axes, closed under water, relative to the scene: STL, OBJ or GDF; the program "
                "cuts it at the still water and computes the coefficients of all bodies with meshes together, by "
                "panels")
               .optional(),
           &HullMesh::file)
      .key(quantity("unit", dim::length, "what one unit of the mesh is; left out: metres, or what the file says")
               .positive()
               .optional()
               .only_beside("mesh"),
           &HullMesh::unit)
      .key(effect("reverse", "turns the faces of a mesh that is drawn inside out").optional().only_beside("mesh"),
           &HullMesh::reverse)
      .key(range("frequencies", dim::angular_velocity,
                 "of the table that is computed of the mesh, which needs them: \"0.2 rad/s .. 3 rad/s, 29 values\"")
               .optional()
               .only_beside("mesh"),
           &HullMesh::omega)
      .key(frequency_tolerance().only_beside("mesh"), &HullMesh::frequency_tolerance)
      .key(range("headings", dim::angle, "of that table; without it those of [waves] and [ask]")
               .optional()
               .only_beside("mesh"),
           &HullMesh::headings)
      .key(number("mesh_tolerance",
                  "largest error by panels of A, B and X, relative to the two modes of an entry, that you take, where "
                  "it is not the accuracy asked; it is estimated, and a mesh that misses it is refused")
               .within(Limit::open_fraction)
               .optional()
               .only_beside("mesh"),
           &HullMesh::tolerance)
      .words(text("lid",
                  "\"panels\": on the water inside the hull, which remove irregular frequencies; \"none\": those "
                  "stay, for the doctor to find")
                 .or_default("panels", "a hull that pierces the surface has irregular frequencies")
                 .only_beside("mesh"),
             {{"panels", true}, {"none", false}}, &HullMesh::lid)
      .words(
          text("mesh_interaction",
               "\"panels\": all panels in one set of equations, hulls may be near; \"partial waves\": each kind of "
               "hull is solved once, and the partial waves that it sends out and receives, for many hulls that stand "
               "apart by more than the circles about them; \"automatic\": the quicker of those that serve")
              .or_default("automatic", "the cost of both is estimated, and `froude plan` tells which is taken")
              .only_beside("mesh"),
          {{"automatic", hydro::panels::Interaction::automatic},
           {"panels", hydro::panels::Interaction::panels},
           {"partial waves", hydro::panels::Interaction::partial_waves}},
          &HullMesh::interaction);
}

/// The keys of a mesh are read with all others of the table, and mean nothing without it.
void require_whole_mesh(const Record& record, Hydrodynamics& out) {
  if (!record.has("mesh")) return out.mesh.reset();
  if (!record.has("frequencies"))
    throw record.wrong("mesh", "needs the frequencies at which it is solved",
                       "add frequencies = \"0.2 rad/s .. 3 rad/s, 29 values\"");
}

/// Where coefficients and the choice of interaction stand.
void find_places(const Record& record, Hydrodynamics& out) {
  if (!record.has("file")) out.file.place = record[record.has("mesh") ? "mesh" : "cylinders"].place;
  const bool chosen = record.has("interaction") && !record["interaction"].defaulted;
  out.interaction_place = chosen ? record["interaction"].place : out.file.place;
}

}  // namespace

Binding<Hydrodynamics> hydrodynamics_binding() {
  return Binding<Hydrodynamics>(
             "[body.hydrodynamics]",
             "linear potential theory, with coefficients from a file, of cylinders or of a mesh; each effect is named")
      .key(text("file", "of coefficients, relative to the scene: any format of `froude bem info`").optional(),
           &Hydrodynamics::file)
      .table("cylinders", cylinders(), &Hydrodynamics::cylinders)
      .part(hull_mesh(), &Hydrodynamics::mesh)
      .key(integer("body",
                   "which body of the file, from 1 (copies take the following ones); needed where the scene takes "
                   "fewer than the file holds")
               .within(Limit::at_least_one)
               .optional()
               .only_beside("file"),
           &Hydrodynamics::body)
      .at_most(100'000)
      .key(vector("reference_point", dim::length, "global, what the coefficients are about, if the file does not say")
               .optional()
               .only_beside("file"),
           &Hydrodynamics::reference_point)
      .key(quantity("displaced_volume", dim::volume,
                    "of the body at rest, if the file does not say; a body on joints needs it, since they carry "
                    "what buoyancy and weight differ by")
               .positive()
               .optional()
               .only_beside("file"),
           &Hydrodynamics::displaced_volume)
      .key(vector("centre_of_buoyancy", dim::length,
                  "of the body at rest, body axes, if the file does not say; of a body on joints buoyancy acts "
                  "here")
               .optional()
               .only_beside("file"),
           &Hydrodynamics::centre_of_buoyancy)
      .key(quantity("ulen", dim::length,
                    "WAMIT's ULEN; only for WAMIT files, where it is 1 m unless this or the .out file says "
                    "otherwise")
               .positive()
               .optional()
               .only_beside("file"),
           &Hydrodynamics::ulen)
      .key(integer("iperout", "WAMIT's IPEROUT, 1 to 4; only for WAMIT files")
               .within(Limit::at_least_one)
               .optional()
               .only_beside("file"),
           &Hydrodynamics::iperout)
      .at_most(4)
      .key(texts("accept",
                 "findings of the doctor (`froude bem check`) that are known and shall not stop the scene; the "
                 "result records them")
               .one_of(hydro::potential::check_names())
               .optional()
               .only_beside_one_of({"file", "mesh"}),
           &Hydrodynamics::accept)
      .key(effect("excitation", "loads of the incoming waves on the body held still"), &Hydrodynamics::excitation)
      .key(modes("excitation_modes",
                 "of the loads about the body's centre of gravity, those that act; all, unless some shall be "
                 "suppressed to see what they do")
               .optional()
               .only_beside("excitation"),
           &Hydrodynamics::excited)
      .table("turning", turning(), &Hydrodynamics::turning)
      .only_beside({"excitation"})
      .table("radiation", radiation(), &Hydrodynamics::memory)
      .optional()
      .key(effect("hydrostatics", "restoring loads of buoyancy and weight"), &Hydrodynamics::hydrostatics)
      .words(text("interaction",
                  "whose waves the body feels: \"full\": those of all bodies that make waves, which one file must "
                  "hold or the program compute together; \"file\": of the bodies of its own file; \"self\": only "
                  "its own")
                 .or_default("full", "leaving it out would be an approximation; where no waves can pass it is refused")
                 .only_beside_one_of({"radiation", "excitation"}),
             {{"full", Interaction::full}, {"file", Interaction::file}, {"self", Interaction::self}},
             &Hydrodynamics::interaction)
      .exactly_one_of({"file", "cylinders", "mesh"})
      .at_least_one_of({"excitation", "radiation", "hydrostatics"})
      .then([](const Record& record, Hydrodynamics& out) { out.radiation = record.has("radiation"); })
      .then(require_whole_mesh)
      .then(find_places);
}

Binding<SecondOrder> second_order_binding() {
  using enum SecondOrder::Method;
  return Binding<SecondOrder>("[body.second_order]",
                              "wave loads of second order about the body's origin, in runs: mean and slow drift, and "
                              "loads at sums of frequencies")
      .key(text("file",
                "WAMIT's .10d, .11d, .12d (difference frequencies) or .7, .8, .9 (mean drift), relative to the "
                "scene"),
           &SecondOrder::file)
      .key(text("sum",
                "WAMIT's .10s, .11s, .12s, relative to the scene: loads at sums of frequencies beside those of "
                "`file`")
               .optional(),
           &SecondOrder::sum)
      .words(text("method",
                  "\"full\": all pairs of waves, of .10d, .11d, .12d; \"newman\": of each pair the mean of what either "
                  "wave exerts with itself, right where they are nearly alike; \"mean\": the constant part alone"),
             {{"full", full}, {"newman", newman}, {"mean", mean}}, &SecondOrder::method)
      .key(quantity("ulen", dim::length, "WAMIT's ULEN").positive().or_default("1 m", "as WAMIT has it"),
           &SecondOrder::ulen)
      .key(integer("iperout", "WAMIT's IPEROUT: 1 for periods in s, 2 for rad/s")
               .within(Limit::at_least_one)
               .or_default("1", "as WAMIT has it"),
           &SecondOrder::iperout)
      .at_most(2)
      .key(integer("body", "which body of the file, from 1").within(Limit::at_least_one).or_default("1", "the first"),
           &SecondOrder::body)
      .at_most(100'000)
      .place(&SecondOrder::place);
}

}  // namespace froude::scene
