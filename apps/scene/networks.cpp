/// \file  Lines that meet: at each `[[junction]]`, and at each other's nodes.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <numeric>

#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
namespace dl = dynamics::line;

Binding<Junction> junction_morison() {
  return Binding<Junction>("[junction.morison]", "drag, Froude-Krylov load and added mass of the sphere")
      .key(number("cd", "drag coefficient, of its section").within(Limit::not_negative), &Junction::bob, &dl::Bob::cd)
      .key(number("ca", "added mass over displaced mass")
               .within(Limit::not_negative)
               .or_default("0.5", "of a sphere in unbounded water"),
           &Junction::bob, &dl::Bob::ca);
}

const Binding<Junction>& junction() {
  static const Binding<Junction> binding =
      Binding<Junction>("[[junction]]",
                        "a place that nothing holds, at which lines meet that name it in [line.on]; where it is "
                        "follows from them. With mass or diameter a float or sinker, on one line too")
          .place(&Junction::place)
          .key(name_key("junction", "of the junction"))
          .key(quantity("mass", dim::mass, "of what is there besides the lines").positive().optional(), &Junction::mass)
          .key(quantity("diameter", dim::length, "of a sphere that the water meets").positive().optional(),
               &Junction::bob, &dl::Bob::diameter)
          .table("morison", junction_morison())
          .only_beside({"diameter"})
          .key(effect("buoyancy", "weight of the water that the sphere displaces").only_beside("diameter"),
               &Junction::bob, &dl::Bob::buoyancy)
          .key(effect("partial_immersion", "only what is under the waves is wet; left out: all of it, always")
                   .only_beside("diameter"))
          .then([](const Record& record, Junction& out) {
            if (record.has("partial_immersion")) out.bob.wet = dl::Wet::below_surface;
            if (record.has("diameter") && !out.bob.buoyancy && !record.has("morison"))
              throw record.wrong("diameter", "acts on nothing here", "leave it out, or add buoyancy or morison");
          });
  return binding;
}

/// "main.node4": the line and the node; nothing if there is no such line.
std::optional<Line::Meets> node_named(const UnresolvedEnd& end, const Scene& scene) {
  const std::string& text = end.name.value;
  const std::size_t dot = text.rfind(".node");
  if (dot == std::string::npos) return std::nullopt;
  const std::string line = text.substr(0, dot), digits = text.substr(dot + 5);
  const auto of = std::find_if(scene.lines.begin(), scene.lines.end(), [&](const Line& l) { return l.name == line; });
  if (of == scene.lines.end()) return std::nullopt;
  int node = -1;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), node);
  const int last = of->last_node();
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size() || node < 0 || node > last)
    throw hydro::InputError(
        fmt::format("[line.on] refers to \"{}\", but line \"{}\" has the nodes 0 to {}", text, line, last),
        end.name.place, fmt::format("write \"{}.node{}\"", line, last / 2));
  return Line::Meets{{}, static_cast<std::size_t>(of - scene.lines.begin()), node};
}

/// A node in the middle of a line, or its free end: those which nothing else holds already.
void require_free(const UnresolvedEnd& end, const Line::Meets& meets, const Scene& scene) {
  const Line& of = scene.lines[meets.line];
  const int last = of.last_node();
  const auto refuse = [&](const std::string& rule, const std::string& remedy) {
    throw hydro::InputError(fmt::format("[line.on] refers to \"{}\", {}", end.name.value, rule), end.name.place,
                            remedy);
  };
  if ((meets.node == 0 && !of.from.meets) || (meets.node == last && of.to.at))
    refuse("which is held already", "hold this line there too: write the place instead");
  if ((meets.node == 0 && of.from.meets) || (meets.node == last && of.to.meets))
    refuse("an end that itself meets something", "name what it meets");
  if (of.common.bending_stiffness > 0 && meets.node != 0 && meets.node != last)
    refuse(fmt::format("in the middle of a line that resists bending"),
           fmt::format("make two lines of \"{}\" that end there at a [[junction]]", of.name));
  const int own = end.first ? 0 : scene.lines[end.line].last_node();
  if (meets.line == end.line && std::abs(own - meets.node) < 2)
    refuse("the node beside it", "a loop needs two links at least");
}

Line::Meets resolve(const UnresolvedEnd& end, const Scene& scene) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < scene.junctions.size(); ++k) {
    if (scene.junctions[k].name == end.name.value) return {k};
    known.push_back(scene.junctions[k].name);
  }
  if (const auto node = node_named(end, scene)) {
    require_free(end, *node, scene);
    return *node;
  }
  for (const Body& b : scene.bodies) known.push_back(b.name);
  for (const Line& l : scene.lines) known.push_back(l.name + ".node1");
  const std::string near = hydro::nearest(end.name.value, known);
  throw hydro::InputError(
      fmt::format("[line.on] refers to \"{}\", but there is no such body, junction or node of a line", end.name.value),
      end.name.place,
      near.empty() ? "give a [[body]] or a [[junction]] this name, or write \"main.node4\""
                   : fmt::format("did you mean \"{}\"?", near));
}

/// How many ends are at each junction: one alone is no meeting, unless there is something.
void require_meetings(const Scene& scene) {
  for (std::size_t k = 0; k < scene.junctions.size(); ++k) {
    const Junction& junction = scene.junctions[k];
    int ends = 0;
    for (const Line& l : scene.lines)
      for (const auto& meets : {l.from.meets, l.to.meets}) ends += meets && meets->junction == k ? 1 : 0;
    if (ends == 0)
      throw hydro::InputError(
          fmt::format("no line is on the junction \"{}\"", junction.name), junction.place,
          fmt::format("write on = {{ to = \"{}\" }} in a [[line]], or leave it out", junction.name));
    if (ends == 1 && junction.mass == 0 && junction.bob.diameter == 0)
      throw hydro::InputError(
          fmt::format("one line alone is on the junction \"{}\", at which nothing is", junction.name), junction.place,
          "let another line be on it too, or give it mass or diameter, or let the end be free");
  }
}

/// Union-find over the lines.
std::vector<std::vector<std::size_t>> find_networks(const Scene& scene) {
  std::vector<std::size_t> root(scene.lines.size()), at_junction(scene.junctions.size(), scene.lines.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  for (std::size_t i = 0; i < scene.lines.size(); ++i)
    for (const auto& meets : {scene.lines[i].from.meets, scene.lines[i].to.meets}) {
      if (!meets) continue;
      std::size_t with = meets->line;
      if (meets->junction) {
        std::size_t& first = at_junction[*meets->junction];
        if (first == scene.lines.size()) first = i;
        with = first;
      }
      const std::size_t a = find(i), b = find(with);
      root[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::vector<std::size_t>> out;
  std::vector<std::size_t> place(scene.lines.size());
  for (std::size_t i = 0; i < scene.lines.size(); ++i) {
    if (find(i) == i) {
      place[i] = out.size();
      out.emplace_back();
    }
    out[place[find(i)]].push_back(i);
  }
  return out;
}

/// One system has one water and one bed.
void require_alike(const Line& l, const Line& first) {
  const auto differs = [&](const std::string& what, const std::string& remedy) {
    throw hydro::InputError(fmt::format("line \"{}\" meets \"{}\", but {}", l.name, first.name, what), l.place, remedy);
  };
  const auto dry = [](const Line& x) { return x.water.wet == dl::Wet::nothing; };
  if (dry(l) != dry(first)) differs("the water acts on one of them alone", "give both buoyancy or morison, or neither");
  if (l.water.buoyancy != first.water.buoyancy)
    differs("one of them alone has buoyancy", "give it to both or to neither");
  if (l.water.wet != first.water.wet)
    differs("one of them alone is immersed in part", "give partial_immersion to both or to neither");
  const auto taken_at = [](const Line& x) { return x.waves_at ? std::optional(x.waves_at->place_m) : std::nullopt; };
  if (taken_at(l) != taken_at(first)) differs("takes waves at another place", "give both the same [line.waves]");
}

void require_one_bed(const Line& l, const Line& other) {
  if (!l.bed || !other.bed) return;
  if (l.bed->stiffness != other.bed->stiffness || l.bed->damping != other.bed->damping ||
      l.bed->friction != other.bed->friction)
    throw hydro::InputError(fmt::format("line \"{}\" meets \"{}\", but lies on another bed", l.name, other.name),
                            l.place, "give both the same [line.bed]");
}

void require_one_system(const Scene& scene, const std::vector<std::size_t>& network) {
  const Line& first = scene.lines[network.front()];
  const auto fastened = [&](std::size_t i) { return scene.lines[i].fastened(); };
  const bool on_bodies = std::any_of(network.begin(), network.end(), fastened);
  int watched = 0;
  for (const std::size_t i : network) {
    const Line& l = scene.lines[i];
    require_alike(l, first);
    for (const std::size_t k : network) require_one_bed(l, scene.lines[k]);
    if (l.release)
      throw hydro::InputError(fmt::format("line \"{}\" is let go, but meets others, which begin with it", l.name),
                              l.place, "leave [line.release] out");
    if (on_bodies && l.common.is_inextensible())
      throw hydro::InputError(
          fmt::format(
              "line \"{}\" is inextensible, and meets lines that are on a body: they have no step once they are "
              "taut",
              l.name),
          l.place, "give it an axial_stiffness");
    if (on_bodies && (l.prescribed || l.lyapunov))
      throw hydro::InputError(
          fmt::format("line \"{}\" meets lines that are on a body, with which [line.{}] does not go", l.name,
                      l.prescribed ? "prescribed" : "lyapunov"),
          l.place, "leave it out, or hold the lines by the ground");
    if (l.lyapunov && ++watched > 1)
      throw hydro::InputError(
          fmt::format("line \"{}\" asks for the exponent of lines that meet, which another one asks for", l.name),
          l.lyapunov->place, "leave one of them out: they are one motion");
  }
}

}  // namespace

const Table& junction_table() { return junction().table(); }

void build_networks(const Record& root, Names& names, const std::vector<UnresolvedEnd>& unresolved, Scene& scene) {
  for (const Record& record : root.tables("junction")) {
    scene.junctions.push_back(junction().read(record));
    scene.junctions.back().name = names.of(record, 1).front();
  }
  for (const UnresolvedEnd& end : unresolved) {
    Line& line = scene.lines[end.line];
    (end.first ? line.from : line.to).meets = resolve(end, scene);
  }
  require_meetings(scene);
  scene.networks = find_networks(scene);
  for (const auto& network : scene.networks)
    if (network.size() > 1) require_one_system(scene, network);
}

}  // namespace froude::scene
