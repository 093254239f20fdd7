/// \file  `[[line]]`: lines that are stepped: droppers, chains of pendulums, cables.
#include <fmt/format.h>

#include <algorithm>

#include "hydro/io/csv.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"
#include "scene/finer.hpp"
#include "scene/line_property.hpp"

namespace froude::scene {

// Each of the properties that are listed in CMakeLists.txt.
#define FROUDE_PART(name) LineProperty name##_of_lines();
#include "line_properties.inc"
#undef FROUDE_PART

const std::vector<LineProperty>& line_properties() {
#define FROUDE_PART(name) name##_of_lines(),
  static const std::vector<LineProperty> properties{
#include "line_properties.inc"
  };
#undef FROUDE_PART
  return properties;
}

void require_free_node(const Record& own, const Line& line) {
  const std::int64_t node = own["node"].integer, last = line.last_node();
  if (node > last || (node == last && line.to.at))
    throw own.wrong("node", fmt::format("is not a free node: the line has {} segments", last),
                    "count nodes from 0 at `from`");
}

std::vector<Line::HeldNode> Line::Release::in_order() const {
  std::vector<HeldNode> out = also;
  out.push_back(*this);
  std::sort(out.begin(), out.end(), [](const HeldNode& a, const HeldNode& b) { return a.node < b.node; });
  return out;
}

namespace {

namespace dim = hydro::dim;
namespace dl = dynamics::line;

const Binding<dl::Segment>& line_link() {
  static const Binding<dl::Segment> binding =
      Binding<dl::Segment>("[[line.link]]", "one rigid link, in order from `from`")
          .key(quantity("length", dim::length, "of the link").positive(), &dl::Segment::length)
          .key(quantity("mass", dim::mass, "of the link").within(Limit::not_negative), &dl::Segment::mass)
          .key(number("centre", "of its mass: share of the length from its first node")
                   .within(Limit::fraction)
                   .or_default("0.5", "the middle"),
               &dl::Segment::centre)
          .key(quantity("inertia", dim::inertia, "about that centre, across; left out: a uniform rod's, m l^2/12")
                   .within(Limit::not_negative)
                   .optional(),
               &dl::Segment::inertia)
          .then([](const Record& record, dl::Segment& out) {
            if (!record.has("inertia")) out.inertia = out.mass * out.length * out.length / 12;
          });
  return binding;
}

/// What the segments of a part have of their own; into which it is cut is for append_even().
const Binding<dl::Segment>& line_part() {
  static const Binding<dl::Segment> binding =
      Binding<dl::Segment>("[[line.part]]", "an even part of a line, in order from `from`: chain, rope, chain")
          .key(quantity("length", dim::length, "of the part without tension").positive())
          .key(integer("segments", "into which it is cut").within(Limit::at_least_one))
          .at_most(1'000'000)
          .key(quantity("mass_per_length", dim::mass / dim::length, "of the part").positive())
          .key(quantity("diameter", dim::length, "left out: that of the line").positive().optional(),
               &dl::Segment::diameter)
          .key(quantity("axial_stiffness", dim::force, "EA; left out: that of the line").positive().optional(),
               &dl::Segment::axial_stiffness)
          .key(quantity("bending_stiffness", dim::force * dim::length * dim::length, "EI; left out: that of the line")
                   .positive()
                   .optional(),
               &dl::Segment::bending_stiffness);
  return binding;
}

/// A line that is even, or one part of it; `mass_at` is the line's.
void append_even(const Record& record, const std::string& mass_at, dl::Segment whole, Line& out) {
  whole.length = record.si("length");
  whole.mass = record.si("mass_per_length") * whole.length;
  whole.inertia = whole.mass * whole.length * whole.length / (mass_at == "nodes" ? 4 : 12);
  out.parts.push_back({whole, static_cast<int>(record["segments"].integer)});
}

/// Equal segments of a line, of its parts one after the other, or its links one by one.
void read_segments(const Record& record, Line& out) {
  if (record.has("link") && !record["mass_at"].defaulted)
    throw record.wrong("mass_at", "acts on nothing: each link says where its mass is", "leave it out");
  for (const Record& link : record.tables("link")) line_link().read_into(link, out.segments.emplace_back(out.common));
  for (const Record& part : record.tables("part")) {
    dl::Segment segment = out.common;
    line_part().read_into(part, segment);
    for (const char* key : {"diameter", "axial_stiffness", "bending_stiffness"})
      if (part.has(key) && !record.has(key))
        throw part.wrong(key, fmt::format("is for this part, but the line has no {} for the others", key),
                         fmt::format("give [[line]] a {} too", key));
    append_even(part, record.text("mass_at"), segment, out);
  }
  if (record.has("length")) {
    for (const char* key : {"segments", "mass_per_length"})
      if (!record.has(key)) throw record.refused(fmt::format("needs the key \"{}\" beside \"length\"", key));
    append_even(record, record.text("mass_at"), out.common, out);
  }
  if (!out.parts.empty()) out.segments = cut(out);
}

Binding<Line> line_morison() {
  return Binding<Line>("[line.morison]",
                       "drag, Froude-Krylov load and added mass of the segments where they are at each instant")
      .key(number("cd", "drag coefficient across the segment").within(Limit::not_negative).optional(), &Line::common,
           &dl::Segment::cd)
      .key(number("ca", "added mass over displaced mass, across the segment")
               .within(Limit::not_negative)
               .optional()
               .only_beside("cd"),
           &Line::common, &dl::Segment::ca)
      .key(text("file",
                "CSV beside the scene with KC, cd, ca and perhaps Re: each segment takes what belongs to the "
                "waves that pass it at rest")
               .optional())
      .key(quantity("viscosity", dim::length * dim::velocity, "kinematic, of the water, for Re")
               .positive()
               .optional()
               .only_beside("file"))
      .key(number("cd_tangential", "drag coefficient along the segment, of its skin pi D")
               .within(Limit::not_negative)
               .or_default("0", "a smooth cylinder has some 0.01"),
           &Line::common, &dl::Segment::cd_tangential)
      .exactly_one_of({"cd", "file"})
      .then([](const Record& record, const Line&) {
        if (record.has("cd") && !record.has("ca")) throw record.refused("needs the key \"ca\" beside \"cd\"");
      });
}

Line::Coefficients read_coefficients(const Record& record, const Scene& scene) {
  if (!scene.waves)
    throw record.wrong("file", "gives coefficients by KC, and nothing moves the water to and fro",
                       "add [waves], or give cd and ca");
  if (scene.current_place)
    throw record.wrong("file", "gives coefficients by KC, which say nothing of waves together with a current",
                       "leave [current] out, or give cd and ca");
  const auto table = hydro::io::CsvTable::read(beside(scene.file, record.text("file")));
  const bool has_re = table.has("Re");
  if (has_re != record.has("viscosity"))
    throw has_re ? record.refused("needs a viscosity: its file has a column Re", "for example \"1.05e-6 m^2/s\"")
                 : record.wrong("viscosity", "acts on nothing: the file has no column Re", "leave it out");
  const auto &kc = table.column("KC"), &cd = table.column("cd"), &ca = table.column("ca");
  Line::Coefficients out{.rows = {},
                         .viscosity = has_re ? record.si("viscosity") : 1,
                         .file = record.text("file"),
                         .place = record.place()};
  for (std::size_t i = 0; i < table.rows(); ++i)
    out.rows.push_back({kc[i], has_re ? table.column("Re")[i] : 1, cd[i], ca[i]});
  return out;
}

Binding<dl::Bed> line_bed() {
  return Binding<dl::Bed>("[line.bed]", "the sea bed at the water's depth pushes back where the line sinks into it")
      .key(quantity("stiffness", dim::pressure / dim::length, "pressure per depth, on the line's diameter").positive(),
           &dl::Bed::stiffness)
      .key(quantity("damping", dim::pressure / dim::velocity, "pressure per velocity; never pulls")
               .within(Limit::not_negative)
               .or_default("0 Pa s/m", "what is not named does not act"),
           &dl::Bed::damping)
      .key(number("friction",
                  "what lies on the bed is held by up to this times its weight on it; none at rest, before "
                  "anything moves")
               .positive()
               .optional(),
           &dl::Bed::friction);
}

/// Of one that is held alone, or of the first of several.
template <class T>
Binding<T> held_node(const char* title, const char* meaning) {
  return Binding<T>(title, meaning)
      .key(integer("node", "counted from 0 at `from`").within(Limit::at_least_one), &Line::HeldNode::node)
      .key(vector("at", dim::length, "where it is held, global"), &Line::HeldNode::at);
}

Binding<Line::Release> line_release() {
  return held_node<Line::Release>("[line.release]",
                                  "the line starts at rest with one node held, or several, and is let go at t = 0")
      .tables(
          "also",
          held_node<Line::HeldNode>("[[line.release.also]]", "a further node that is held, and let go with the first"),
          &Line::Release::also)
      .optional();
}

void check_release(const Record& record, const Line& line) {
  if (line.from.meets || line.to.meets)
    throw record.refused("holds a node of a line that meets others, which begin with it",
                         "leave it out, or hold the line by the ground");
  require_free_node(record, line);
  for (const Record& also : record.tables("also")) require_free_node(also, line);
  const auto held = line.release->in_order();
  for (std::size_t k = 1; k < held.size(); ++k)
    if (held[k].node == held[k - 1].node)
      throw record.refused(fmt::format("holds node {} twice", held[k].node), "hold each node at one place");
}

/// The path begins where the end is, at t = 0 or before.
void read_path(const Record& record, const Line& line, Line::PrescribedMotion& out) {
  if (out.first && line.from.meets)
    throw record.wrong("end", "is not held: it meets what [line.on] names",
                       "prescribe the motion of the line that holds that");
  if (!out.first && !line.to.at)
    throw record.wrong("end", "is free: the line has no `to`", "add `to`, or prescribe the motion of the end \"from\"");
  const auto table = hydro::io::CsvTable::read(beside(record.place().file, record.text("file")));
  out.time = rising_times(record, table);
  const auto &x = table.column("x", dim::length), &y = table.column("y", dim::length),
             &z = table.column("z", dim::length);
  for (std::size_t i = 0; i < x.size(); ++i) out.place.emplace_back(x[i], y[i], z[i]);
}

Binding<Line::PrescribedMotion> line_prescribed() {
  return Binding<Line::PrescribedMotion>("[line.prescribed]", "the motion of one end, along a path")
      .words(text("end", "which: \"from\" or \"to\""), {{"from", true}, {"to", false}}, &Line::PrescribedMotion::first)
      .key(text("file", "CSV beside the scene with time, x, y, z; a cubic spline goes through its points"));
}

Binding<Line> line_clamp() {
  return Binding<Line>("[line.clamp]",
                       "ends that do not turn: the direction in which the line goes there, from its first node to its "
                       "last")
      .key(direction("from", "at the first node: \"x\" or \"(1, 0, -1)\"").optional(), &Line::from, &Line::End::clamp)
      .key(direction("to", "at the last node, still from first to last").optional(), &Line::to, &Line::End::clamp)
      .at_least_one_of({"from", "to"})
      .then([](const Record&, Line& out) {
        out.from.clamp.normalize();  // of an end that turns freely it stays zero
        out.to.clamp.normalize();
      });
}

/// Ends held by the ground alone: a body would have to bear the moment too.
void check_clamp(const Record& record, const Line& line) {
  if (record.has("to") && !line.to.at) throw record.wrong("to", "clamps a free end: the line has no `to`", "add `to`");
  if (record.has("from") && line.from.meets)
    throw record.wrong("from", "clamps an end that meets others, and turns with nothing", "let the end turn freely");
  for (const char* key : {"from", "to"})
    if (record.has(key) && line.end(key == std::string_view("from")).body)
      throw record.wrong(key, "clamps an end that is on a body, which would have to bear its moment",
                         "let the end turn freely, or hold it by the ground");
}

const Table& line_on() {
  static const Table table{
      .title = "[line.on]",
      .meaning =
          "what ends of the line are on: a body, and `from` or `to` is then in its axes; or a junction or a node "
          "of a line, \"main.node4\", whose place is found, so that `from` or `to` is left out",
      .keys = {text("from", "of the first node, by name").optional(),
               text("to", "of the last node, by name").optional()},
      .groups = {{Group::Count::at_least_one, {"from", "to"}}}};
  return table;
}

bool is_body(const Scene& scene, const std::string& name) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) { return b.name == name; });
}

/// Ends on bodies. An inextensible line between two places has no step where it is drawn taut by one of them.
/// Ends on anything else are left to build_networks().
void read_on(const Record& record, const Record& whole, const Scene& scene, Line& line,
             std::vector<UnresolvedEnd>& unresolved) {
  for (const bool first : {true, false}) {
    const char* key = first ? "from" : "to";
    if (!record.has(key)) continue;
    const Located<std::string> name{record.text(key), record[key].place};
    Line::End& end = first ? line.from : line.to;
    if (is_body(scene, name.value)) {
      end.body = body_named(record, name, scene.bodies);
      if (!end.at)
        throw record.wrong(key, fmt::format("holds no end: the line has no `{}`", key),
                           fmt::format("add `{}`, in axes of that body", key));
      continue;
    }
    if (end.at)
      throw whole.wrong(key, fmt::format("is a place, but the end is on \"{}\", which is no body", name.value),
                        "leave it out: the place of a junction or a node is found");
    end.meets.emplace();
    unresolved.push_back({scene.lines.size(), first, name});
  }
  if (!line.fastened()) return;
  if (line.to.at && line.common.is_inextensible())
    throw record.refused("holds an inextensible line between two places, which has no step once it is taut",
                         "give the line an axial_stiffness");
  for (const char* key : {"prescribed", "release"})
    if (whole.has(key))
      throw whole.table(key).refused("acts on a line that is on a body, which begins with it and moves with it",
                                     "leave it out, or move the body");
}

/// What of the water acts on the line.
void read_surroundings(const Record& record, Line& out) {
  const bool wet = record.has("morison") || out.water.buoyancy, partial = record.has("partial_immersion");
  if (out.common.catenary && record.has("bending_stiffness"))
    throw record.wrong("bending_stiffness", "bends catenary segments, which have no straight axis",
                       "leave `catenary_segments` out");
  if (partial && !wet)
    throw record.refused("is immersed in part, but nothing of the water acts on it",
                         "add morison or buoyancy = true, or leave partial_immersion out");
  if (!wet && record.has("waves") && !record.has("bob_cylinders"))
    throw record.table("waves").refused("is where a line takes waves, but nothing of the water acts on it",
                                        "add morison or buoyancy = true, or leave it out");
  if (!wet && !out.bed && record.has("diameter"))
    throw record.wrong("diameter", "acts on nothing here", "leave it out, or add morison, buoyancy or bed");
  if (wet) out.water.wet = partial ? dl::Wet::below_surface : dl::Wet::all;
}

/// Keys of the line's own segments and nodes, as they stand in [[line]].
Binding<Line> line_itself() {
  return Binding<Line>("[[line]]",
                       "a chain of nodes and straight segments between two places: dropper, cable, pendulums; it has "
                       "weight")
      .place(&Line::place)
      .key(name_key("line", "of the line"))
      .key(vector("from", dim::length,
                  "where its first node is held, global; of a body that holds it, in body axes; left out: it meets "
                  "what `on` names")
               .optional(),
           &Line::from, &Line::End::at)
      .key(vector("to", dim::length, "where its last node is held, as `from`; left out: a free end, or as `from`")
               .optional(),
           &Line::to, &Line::End::at)
      .key(inner_table("on", line_on()).optional())
      .key(quantity("length", dim::length, "of the line without tension").positive().optional())
      .key(integer("segments", "into which it is cut").within(Limit::at_least_one).optional().only_beside("length"))
      .at_most(1'000'000)
      .key(quantity("mass_per_length", dim::mass / dim::length, "of the line")
               .positive()
               .optional()
               .only_beside("length"))
      .key(text("mass_at", "\"nodes\": half a segment's mass at either end; \"segments\": spread along it")
               .one_of({"nodes", "segments"})
               .or_default("segments", "as a line has it"))
      .key(inner_tables("part", line_part().table()).optional())
      .key(inner_tables("link", line_link().table()).optional())
      .key(quantity("node_mass", dim::mass, "of a bob, pin or clump at every node that is not held")
               .positive()
               .optional(),
           &Line::node, &dl::Node::mass)
      .key(quantity("diameter", dim::length, "that the water and the bed meet").positive().optional(), &Line::common,
           &dl::Segment::diameter)
      .key(quantity("axial_stiffness", dim::force, "EA: tension per strain; left out: segments are inextensible")
               .positive()
               .optional(),
           &Line::common, &dl::Segment::axial_stiffness)
      .key(quantity("axial_damping", dim::force * dim::time, "tension per rate of strain")
               .positive()
               .optional()
               .only_beside("axial_stiffness"),
           &Line::common, &dl::Segment::axial_damping)
      .key(quantity("bending_stiffness", dim::force * dim::length * dim::length,
                    "EI: moment per curvature; left out: the line bends freely")
               .positive()
               .optional(),
           &Line::common, &dl::Segment::bending_stiffness);
}

const Binding<Line>& line() {
  static const Binding<Line> binding = [] {
    auto whole =
        line_itself()
            .table("clamp", line_clamp())
            .only_beside({"bending_stiffness"})
            .key(effect("tension_only", "segments go slack instead of being pressed").only_beside("axial_stiffness"),
                 &Line::common, &dl::Segment::tension_only)
            .key(effect("catenary_segments",
                        "segments hang through between their nodes by their weight in water, and rest on the bed in "
                        "part: moorings with few segments; with lines = \"generalized_alpha\"")
                     .only_beside("axial_stiffness"),
                 &Line::common, &dl::Segment::catenary)
            .key(effect("buoyancy", "weight of the water that it displaces").only_beside("diameter"), &Line::water,
                 &dl::Surroundings::buoyancy)
            .key(effect("partial_immersion", "only what is under the waves is wet; left out: all of it, always")
                     .only_beside("diameter"))
            .table("morison", line_morison())
            .only_beside({"diameter"})
            .table("bed", line_bed(), &Line::bed)
            .only_beside({"diameter"})
            .table("release", line_release(), &Line::release)
            .table("prescribed", line_prescribed(), &Line::prescribed)
            .exactly_one_of({"length", "part", "link"})
            .at_most_one_of({"tension_only", "catenary_segments"})
            .then(read_surroundings)
            .then(read_segments);
    for (const LineProperty& property : line_properties()) whole.key(property.key);
    return whole;
  }();
  return binding;
}

/// What follows from how its ends are held, and from the water.
void place_line(const Record& record, const Scene& scene, Line& line) {
  if (!line.from.at && !line.from.meets)
    throw record.refused("needs the key \"from\"",
                         "give a place, or let [line.on] name the junction or node that its first end meets");
  if (record.has("morison") && record.table("morison").has("file"))
    line.coefficients = read_coefficients(record.table("morison"), scene);
  if (line.release) check_release(record.table("release"), line);
  if (line.prescribed) read_path(record.table("prescribed"), line, *line.prescribed);
  if (record.has("clamp")) check_clamp(record.table("clamp"), line);
  for (const LineProperty& property : line_properties())
    for (const Record& own : record.tables(property.key.name)) property.read(own, record, line);
  if (!line.bed) return;
  if (scene.water.depth.is_infinite())
    throw record.table("bed").refused("needs a bed, but the water is infinitely deep", "give [water] a depth");
  line.bed->z = -scene.water.depth.metres();
}

}  // namespace

const Table& line_table() { return line().table(); }

void build_lines(const Record& root, Names& names, Scene& scene) {
  std::vector<UnresolvedEnd> unresolved;
  for (const Record& record : root.tables("line")) {
    Line one = line().read(record);
    one.name = names.of(record, 1).front();
    if (record.has("on")) read_on(record.table("on"), record, scene, one, unresolved);
    place_line(record, scene, one);
    scene.lines.push_back(std::move(one));
  }
  build_networks(root, names, unresolved, scene);
}

}  // namespace froude::scene
