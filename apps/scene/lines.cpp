#include <fmt/format.h>

#include "hydro/io/csv.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

/// Equal segments of a line or of one part of it; `mass_at` is the line's.
Line::Link equal_link(const Record& record, const std::string& mass_at) {
  const auto count = static_cast<double>(record["segments"].integer);
  const double length = record.si("length") / count, mass = record.si("mass_per_length") * length;
  return {length, mass, 0.5, mass * length * length / (mass_at == "nodes" ? 4 : 12)};
}

void append_equal(const Record& record, const Line::Link& link, std::vector<Line::Link>& out) {
  constexpr std::int64_t most = 1'000'000;
  const std::int64_t count = record["segments"].integer;
  if (count > most) throw record.wrong("segments", fmt::format("is more than {}", most));
  out.insert(out.end(), static_cast<std::size_t>(count), link);
}

/// Equal segments of a line, of its parts one after the other, or its links one by one.
std::vector<Line::Link> read_links(const Record& record) {
  std::vector<Line::Link> out;
  if (record.has("link") && !record["mass_at"].defaulted)
    throw record.wrong("mass_at", "acts on nothing: each link says where its mass is", "leave it out");
  for (const Record& link : record.tables("link")) {
    const double length = link.si("length"), mass = link.si("mass");
    out.push_back(
        {length, mass, link.si("centre"), link.has("inertia") ? link.si("inertia") : mass * length * length / 12});
  }
  for (const Record& part : record.tables("part")) {
    Line::Link link = equal_link(part, record.text("mass_at"));
    if (part.has("diameter")) link.diameter = part.si("diameter");
    if (part.has("axial_stiffness")) link.axial_stiffness = part.si("axial_stiffness");
    if (part.has("bending_stiffness")) link.bending_stiffness = part.si("bending_stiffness");
    for (const char* key : {"diameter", "axial_stiffness", "bending_stiffness"})
      if (part.has(key) && !record.has(key))
        throw part.wrong(key, fmt::format("is for this part, but the line has no {} for the others", key),
                         fmt::format("give [[line]] a {} too", key));
    append_equal(part, link, out);
  }
  if (!record.has("length")) return out;
  for (const char* key : {"segments", "mass_per_length"})
    if (!record.has(key)) throw record.refused(fmt::format("needs the key \"{}\" beside \"length\"", key));
  append_equal(record, equal_link(record, record.text("mass_at")), out);
  return out;
}

Line::Growth read_growth(const Record& record, const Record& whole, const Line& line) {
  if (whole.has("link"))
    throw record.refused("grows on links that are given one by one, each with its own mass",
                         "leave it out, or give the line a `length` or [[line.part]]");
  double length = 0;
  for (const auto& link : line.links) length += link.length;
  Line::Growth out{record.si("thickness"), record.si("density"), record.si("from"),
                   record.has("to") ? record.si("to") : length};
  if (!(out.to > out.from) || out.to > length * (1 + 1e-9))
    throw record.refused(fmt::format("reaches from {} to {} m of a line of {} m", out.from, out.to, length),
                         "count both from the line's first end");
  return out;
}

Line::CoefficientTable read_coefficients(const Record& record, const std::filesystem::path& file) {
  const auto table = hydro::io::CsvTable::read(beside(file, record.text("file")));
  const bool has_re = table.has("Re");
  if (has_re != record.has("viscosity"))
    throw has_re ? record.refused("needs a viscosity: its file has a column Re", "for example \"1.05e-6 m^2/s\"")
                 : record.wrong("viscosity", "acts on nothing: the file has no column Re", "leave it out");
  const auto &kc = table.column("KC"), &cd = table.column("cd"), &ca = table.column("ca");
  Line::CoefficientTable out{.rows = {},
                             .viscosity = has_re ? record.si("viscosity") : 1,
                             .file = record.text("file"),
                             .place = record.place()};
  for (std::size_t i = 0; i < table.rows(); ++i)
    out.rows.push_back({kc[i], has_re ? table.column("Re")[i] : 1, cd[i], ca[i]});
  return out;
}

Line::Water read_water(const Record& record, const Scene& scene, const std::filesystem::path& file) {
  Line::Water out{.cd = 0, .ca = 0, .cd_tangential = record.si("cd_tangential"), .table = {}};
  if (!record.has("file")) {
    if (!record.has("ca")) throw record.refused("needs the key \"ca\" beside \"cd\"");
    out.cd = record.si("cd");
    out.ca = record.si("ca");
    return out;
  }
  if (!scene.waves)
    throw record.wrong("file", "gives coefficients by KC, and nothing moves the water to and fro",
                       "add [waves], or give cd and ca");
  if (scene.current_place)
    throw record.wrong("file", "gives coefficients by KC, which say nothing of waves together with a current",
                       "leave [current] out, or give cd and ca");
  out.table = read_coefficients(record, file);
  return out;
}

Line::Damping read_damping(const Record& record) {
  return {record.has("linear") ? record.si("linear") : 0, record.has("quadratic") ? record.si("quadratic") : 0,
          record.has("componentwise")};
}

Line::Release read_release(const Record& record, const Line& line) {
  const auto last = static_cast<std::int64_t>(line.links.size());
  const std::int64_t node = record["node"].integer;
  if (line.from_meets || line.to_meets)
    throw record.refused("holds a node of a line that meets others, which begin with it",
                         "leave it out, or hold the line by the ground");
  if (node > last || (node == last && line.to))
    throw record.wrong("node", fmt::format("is not a free node: the line has {} segments", last),
                       "count nodes from 0 at `from`");
  return {static_cast<int>(node), record.vector("at")};
}

/// The path begins where the end is, at t = 0 or before.
Line::PrescribedMotion read_prescribed(const Record& record, const Line& line, const std::filesystem::path& file) {
  Line::PrescribedMotion out{.first = record.text("end") == "from", .time = {}, .place = {}};
  if (out.first && line.from_meets)
    throw record.wrong("end", "is not held: it meets what [line.on] names",
                       "prescribe the motion of the line that holds that");
  if (!out.first && !line.to)
    throw record.wrong("end", "is free: the line has no `to`", "add `to`, or prescribe the motion of the end \"from\"");
  const auto table = hydro::io::CsvTable::read(beside(file, record.text("file")));
  out.time = rising_times(record, table);
  const auto &x = table.column("x", hydro::dim::length), &y = table.column("y", hydro::dim::length),
             &z = table.column("z", hydro::dim::length);
  for (std::size_t i = 0; i < x.size(); ++i) out.place.emplace_back(x[i], y[i], z[i]);
  return out;
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
    if (is_body(scene, name.value)) {
      (first ? line.from_on : line.to_on) = body_named(record, name, scene.bodies);
      if (!whole.has(key))
        throw record.wrong(key, fmt::format("holds no end: the line has no `{}`", key),
                           fmt::format("add `{}`, in axes of that body", key));
      continue;
    }
    if (whole.has(key))
      throw whole.wrong(key, fmt::format("is a place, but the end is on \"{}\", which is no body", name.value),
                        "leave it out: the place of a junction or a node is found");
    (first ? line.from_meets : line.to_meets).emplace();
    unresolved.push_back({scene.chains.size(), first, name});
  }
  if (!line.fastened()) return;
  if (line.to && !line.axial_stiffness)
    throw record.refused("holds an inextensible line between two places, which has no step once it is taut",
                         "give the line an axial_stiffness");
  for (const char* key : {"prescribed", "release"})
    if (whole.has(key))
      throw whole.table(key).refused("acts on a line that is on a body, which begins with it and moves with it",
                                     "leave it out, or move the body");
}

/// Ends held by the ground alone: a body would have to bear the moment too.
void read_clamp(const Record& record, Line& line) {
  if (record.has("from")) line.clamp_from = record.vector("from").normalized();
  if (record.has("to")) line.clamp_to = record.vector("to").normalized();
  if (line.clamp_to && !line.to) throw record.wrong("to", "clamps a free end: the line has no `to`", "add `to`");
  if (line.clamp_from && line.from_meets)
    throw record.wrong("from", "clamps an end that meets others, and turns with nothing", "let the end turn freely");
  for (const char* key : {"from", "to"})
    if (record.has(key) && (std::string_view(key) == "from" ? line.from_on : line.to_on))
      throw record.wrong(key, "clamps an end that is on a body, which would have to bear its moment",
                         "let the end turn freely, or hold it by the ground");
}

Line::Lyapunov read_lyapunov(const Record& record, const Line& line) {
  if (line.fastened())
    throw record.refused("asks for neighbours of a line that is on a body, whose own neighbours are not followed",
                         "hold the line by the ground");
  return {record.si("from"), record.place()};
}

void check_surroundings(const Record& record, const Line& line, const Scene& scene) {
  const bool wet = line.morison || line.buoyancy;
  if (line.catenary_segments && line.bending_stiffness)
    throw record.wrong("bending_stiffness", "bends catenary segments, which have no straight axis",
                       "leave `catenary_segments` out");
  if (line.partial_immersion && !wet)
    throw record.refused("is immersed in part, but nothing of the water acts on it",
                         "add morison or buoyancy = true, or leave partial_immersion out");
  if (line.bed && scene.water.depth.is_infinite())
    throw record.table("bed").refused("needs a bed, but the water is infinitely deep", "give [water] a depth");
  if (!wet && !line.bed && record.has("diameter"))
    throw record.wrong("diameter", "acts on nothing here", "leave it out, or add morison, buoyancy or bed");
}

}  // namespace

void build_lines(const Record& root, const std::filesystem::path& file, Names& names, Scene& scene) {
  std::vector<UnresolvedEnd> unresolved;
  for (const Record& record : root.tables("line")) {
    Line line;
    line.name = names.of(record, 1).front();
    if (record.has("from")) line.from = record.vector("from");
    if (record.has("to")) line.to = record.vector("to");
    if (record.has("axial_stiffness")) line.axial_stiffness = record.si("axial_stiffness");
    if (record.has("on")) read_on(record.table("on"), record, scene, line, unresolved);
    if (!record.has("from") && !line.from_meets)
      throw record.refused("needs the key \"from\"",
                           "give a place, or let [line.on] name the junction or node that its first end meets");
    line.links = read_links(record);
    const auto number = [&](std::string_view key) { return record.has(key) ? record.si(key) : 0.0; };
    line.node_mass = number("node_mass");
    line.diameter = number("diameter");
    if (record.has("bending_stiffness")) line.bending_stiffness = record.si("bending_stiffness");
    line.axial_damping = number("axial_damping");
    line.tension_only = record.has("tension_only");
    line.catenary_segments = record.has("catenary_segments");
    line.buoyancy = record.has("buoyancy");
    line.partial_immersion = record.has("partial_immersion");
    if (record.has("morison")) line.morison = read_water(record.table("morison"), scene, file);
    if (record.has("damping")) line.damping = read_damping(record.table("damping"));
    if (record.has("bed")) {
      const Record& b = record.table("bed");
      line.bed = {b.si("stiffness"), b.si("damping"), b.has("friction") ? b.si("friction") : 0.0};
    }
    if (record.has("growth")) line.growth = read_growth(record.table("growth"), record, line);
    if (record.has("release")) line.release = read_release(record.table("release"), line);
    if (record.has("prescribed")) line.prescribed = read_prescribed(record.table("prescribed"), line, file);
    if (record.has("snaps")) {
      const Record& s = record.table("snaps");
      line.snaps = {s.si("slack_below"), s.si("snap_above")};
      if (!(line.snaps->snap_above > line.snaps->slack_below))
        throw s.wrong("snap_above", "is not above slack_below", "a snap is tighter than slack");
    }
    line.place = record.place();
    if (record.has("clamp")) read_clamp(record.table("clamp"), line);
    if (record.has("lyapunov")) line.lyapunov = read_lyapunov(record.table("lyapunov"), line);
    check_surroundings(record, line, scene);
    scene.chains.push_back(std::move(line));
  }
  build_networks(root, names, unresolved, scene);
}

}  // namespace froude::scene
