#include "compile/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "compile/compile.hpp"
#include "compile/connections.hpp"
#include "compile/restart.hpp"
#include "compile/waves.hpp"
#include "dynamics/force/field_at_one_place.hpp"
#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/exposure.hpp"
#include "dynamics/line/path.hpp"
#include "hydro/base/error.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

namespace dl = dynamics::line;
using hydro::InputError;
using scene::Scene;

dl::Held held(const scene::Line& l, bool first) {
  dl::Held out{.node = first ? 0 : l.last_node(), .clamp = l.end(first).clamp};
  if (!l.prescribed || l.prescribed->first != first) return out;
  out.path = std::make_shared<dl::SplinePath>(l.prescribed->time, l.prescribed->place);
  const Eigen::Vector3d begins = out.path->at(0).position, stands = *l.end(first).at;
  if ((begins - stands).norm() > 1e-3)  // m: what a table of a path is rounded to
    throw InputError(fmt::format("the path of \"{}\" is at ({:.4g}, {:.4g}, {:.4g}) m at t = 0, its end at ({:.4g}, "
                                 "{:.4g}, {:.4g}) m",
                                 l.name, begins.x(), begins.y(), begins.z(), stands.x(), stands.y(), stands.z()),
                     l.place, "let `from` or `to` be where the path begins");
  return out;
}

/// One line by itself; ends that meet something are free, and what is there is the other's.
dl::Description chain(const Scene& scene, const scene::Line& l, std::shared_ptr<const hydro::waves::WaveField> field) {
  dl::Description d{.nodes = std::vector<dl::Node>(l.segments.size() + 1, l.node),
                    .segments = l.segments,
                    .held = {},
                    .gravity = scene.water.gravity,
                    .water = l.water};
  for (const bool first : {true, false}) {
    dl::Node& node = first ? d.nodes.front() : d.nodes.back();
    if (l.end(first).at) {
      d.held.push_back(held(l, first));
      node.mass = 0;
      node.bob = {};
    }
    if (l.end(first).meets) node = {};
  }
  for (const scene::Line::NodeLoad& load : l.loads) {
    dl::Node& node = d.nodes[static_cast<std::size_t>(load.node)];
    if (load.history.is_constant())
      node.force += load.force;
    else
      node.loads.push_back(load);
  }
  if (l.bed) d.bed.push_back(*l.bed);
  if (l.meets_water()) d.water.field = std::move(field);
  return d;
}

/// Which nodes of a network are one place, and what is at its junctions.
struct Meetings {
  std::vector<std::vector<int>> ties;
  std::vector<LineModel::Knot> knots;
  std::vector<const scene::Junction*> junctions;  // of the knots
};

/// `first`: the node at which each line of the scene begins in the network.
Meetings meetings(const Scene& scene, const std::vector<std::size_t>& network, const std::vector<int>& first) {
  std::map<std::pair<std::size_t, int>, std::vector<int>> at_node;  // by line and node, which is the first
  std::map<std::size_t, std::vector<int>> at_junction;
  for (const std::size_t i : network)
    for (const bool begin : {true, false}) {
      const auto& meets = scene.lines[i].end(begin).meets;
      if (!meets) continue;
      const int own = first[i] + (begin ? 0 : scene.lines[i].last_node());
      if (meets->junction) {
        at_junction[*meets->junction].push_back(own);
        continue;
      }
      auto& tie = at_node[{meets->line, meets->node}];
      if (tie.empty()) tie.push_back(first[meets->line] + meets->node);
      tie.push_back(own);
    }
  Meetings out;
  for (auto& [where, tie] : at_node) out.ties.push_back(std::move(tie));
  for (auto& [k, tie] : at_junction) {
    out.knots.push_back({scene.junctions[k].name, tie.front()});
    out.junctions.push_back(&scene.junctions[k]);
    if (tie.size() > 1) out.ties.push_back(std::move(tie));
  }
  return out;
}

/// Of lines that meet, with where each begins.
struct System {
  dl::Description d;
  std::vector<LineModel::Part> parts;
  std::vector<LineModel::Knot> knots;
};

void append(const dl::Description& more, bool first, bool rests, dl::Description& d) {
  const auto offset = static_cast<int>(d.nodes.size());
  if (!first) d.begins.push_back(offset);
  d.nodes.insert(d.nodes.end(), more.nodes.begin(), more.nodes.end());
  for (dl::Segment s : more.segments) {
    s.meets_bed = rests;
    d.segments.push_back(s);
  }
  for (dl::Held h : more.held) {
    h.node += offset;
    d.held.push_back(h);
  }
  if (!more.bed.empty()) d.bed = more.bed;
}

/// The field as a network takes it: lines that meet take it at one place, or none of them does.
std::shared_ptr<const hydro::waves::WaveField> taken_by(const Scene& scene, const std::vector<std::size_t>& network,
                                                        std::shared_ptr<const hydro::waves::WaveField> field) {
  const auto& one = scene.lines[network.front()].waves_at;
  if (!one || !field) return field;
  if (one->place_m.z() < -scene.water.depth.metres())
    throw InputError(fmt::format("waves are taken at z = {:.4g} m, below the bed", one->place_m.z()), one->place,
                     fmt::format("take them at z = {:.4g} m or above", -scene.water.depth.metres()));
  return std::make_shared<const dynamics::FieldAtOnePlace>(std::move(field), one->place_m);
}

System description(const Scene& scene, const std::vector<std::size_t>& network,
                   const std::shared_ptr<const hydro::waves::WaveField>& of_lines) {
  System out;
  const auto field = taken_by(scene, network, of_lines);
  std::vector<int> first(scene.lines.size(), 0);
  out.d.gravity = scene.water.gravity;
  for (const std::size_t i : network) {
    const scene::Line& l = scene.lines[i];
    const dl::Description own = chain(scene, l, field);
    first[i] = static_cast<int>(out.d.nodes.size());
    out.parts.push_back({.name = l.name,
                         .first_node = first[i],
                         .nodes = static_cast<int>(own.nodes.size()),
                         .first_segment = static_cast<int>(out.d.segments.size()),
                         .segments = static_cast<int>(own.segments.size()),
                         .from_on_body = l.from.body.has_value(),
                         .to_on_body = l.to.body.has_value(),
                         .snaps = l.snaps});
    append(own, i == network.front(), l.bed.has_value(), out.d);
    out.d.water = own.water;
  }
  Meetings meet = meetings(scene, network, first);
  out.d.ties = std::move(meet.ties);
  for (std::size_t k = 0; k < meet.knots.size(); ++k) {
    dl::Node& node = out.d.nodes[static_cast<std::size_t>(meet.knots[k].node)];
    node.mass += meet.junctions[k]->mass;
    node.bob = meet.junctions[k]->bob;
    if (node.bob.diameter > 0) out.d.water.field = field;
  }
  out.knots = std::move(meet.knots);
  return out;
}

/// Where the line reaches of the places at which nodes are to be held before their release, by their nodes: places are
/// written with few digits, and a single link reaches one distance only.
std::vector<scene::Line::HeldNode> reached(const scene::Line& l) {
  constexpr double written = 1e-3;  // of the way, that a place may be off
  std::vector<scene::Line::HeldNode> out = l.release->in_order();
  scene::Line::HeldNode before{0, *l.from.at};
  for (scene::Line::HeldNode& held : out) {
    const Eigen::Vector3d way = held.at - before.at;
    double reach = 0;
    for (int j = before.node; j < held.node; ++j) reach += l.segments[static_cast<std::size_t>(j)].length;
    const bool fixed = l.common.is_inextensible() && (held.node == before.node + 1 || way.norm() > reach);
    if (fixed && std::abs(way.norm() - reach) <= written * reach) held.at = before.at + reach * way.normalized();
    before = held;
  }
  return out;
}

std::string brought(const scene::Line& l) {
  constexpr double digits = 1e-6;  // of the way: not worth telling
  const auto given = l.release->in_order(), there = reached(l);
  double by = 0, way = 0;
  for (std::size_t k = 0; k < given.size(); ++k) {
    by = std::max(by, (there[k].at - given[k].at).norm());
    way = std::max(way, (given[k].at - *l.from.at).norm());
  }
  if (by <= digits * way) return "";
  return given.size() == 1
             ? fmt::format("the place of its release was brought by {:.2g} m to where its links reach", by)
             : fmt::format("the places of its release were brought by up to {:.2g} m to where its links reach", by);
}

std::shared_ptr<const hydro::waves::WaveField> without_waves(const Scene& scene) {
  return std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, scene.water,
                                                       hydro::waves::HarmonicField::Options{}, scene.current);
}

/// As it rests before a run: in the current, under what of its loads acts at t = 0.
System still_description(const Scene& scene, const std::vector<std::size_t>& network) {
  System out = description(scene, network, without_waves(scene));
  for (dl::Node& node : out.d.nodes) {
    for (const dl::TimedForce& load : node.loads) node.force += load.history.share(0) * load.force;
    node.loads.clear();
  }
  return out;
}

/// Places of what holds the lines of a network, in it; zero for all others.
dl::Places held_places(const Scene& scene, const std::vector<std::size_t>& network, const System& system) {
  dl::Places out = dl::Places::Zero(3, std::ssize(system.d.nodes));
  for (std::size_t k = 0; k < network.size(); ++k) {
    const scene::Line& l = scene.lines[network[k]];
    const LineModel::Part& part = system.parts[k];
    if (l.from.at) out.col(part.first_node) = *l.from.at;
    if (l.to.at) out.col(part.first_node + part.nodes - 1) = *l.to.at;
  }
  return out;
}

/// Rest without waves, in the current, with the nodes that are to be released held.
dl::State at_rest(const Scene& scene, const std::vector<std::size_t>& network) {
  System system = still_description(scene, network);
  dl::Places places = held_places(scene, network, system);
  const scene::Line& l = scene.lines[network.front()];
  if (l.release)
    for (const scene::Line::HeldNode& held : reached(l)) {
      system.d.held.push_back({.node = held.node});
      places.col(held.node) = held.at;
    }
  const dl::Line line(std::move(system.d));
  dl::State guess = dl::hanging_shape(line, {.position = std::move(places),
                                             .velocity = dl::Places::Zero(3, line.nodes()),
                                             .tension = Eigen::VectorXd::Zero(line.segments())});
  // What is clamped and free beyond stands or hangs as it does: from straight down it might not turn over.
  if (line.chains() == 1 && !l.from.clamp.isZero(0) && !l.to.at && !l.release && !l.to.meets)
    for (int i = 1; i < line.nodes(); ++i)
      guess.position.col(i) = guess.position.col(i - 1) + line.segment(i - 1).length * l.from.clamp;
  return dl::equilibrium(line, guess);
}

/// Lowest and highest of some numbers: "1.2 to 1.9".
std::string range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low == *high ? fmt::format("{:.3g}", *low) : fmt::format("{:.3g} to {:.3g}", *low, *high);
}

/// Puts in what the table has for the waves that pass each segment in `places`, and tells it. (D104), (D105)
std::string take_coefficients(const Scene& scene, const scene::Line& l, const RunWater& water, const dl::Places& places,
                              std::span<dl::Segment> segments) {
  if (!l.coefficients) return "";
  const scene::Line::Coefficients& given = *l.coefficients;
  return scene::placed(given.place, [&] {
    const dl::CoefficientTable table(given.rows);
    const double ramp = scene.waves->ramp < scene.run->duration ? scene.waves->ramp : 0;
    const auto exposures = dl::exposure(*water.field, places, ramp, scene.run->duration);
    std::vector<double> kc, re, cd, ca;
    for (std::size_t j = 0; j < segments.size(); ++j) {
      dl::Segment& s = segments[j];
      kc.push_back(exposures[j].keulegan_carpenter(s.diameter));
      re.push_back(exposures[j].reynolds(s.diameter, given.viscosity));
      try {
        const auto found = table.at(kc.back(), re.back());
        cd.push_back(s.cd = found.cd);
        ca.push_back(s.ca = found.ca);
      } catch (const InputError& e) {
        throw InputError(fmt::format("segment {} of line \"{}\": {}", j + 1, l.name, e.rule()), given.place,
                         "extend the table, or give cd and ca");
      }
    }
    return fmt::format("C_D {}, C_A {} by {} at KC {}{}", range(cd), range(ca), given.file, range(kc),
                       table.knows_reynolds() ? ", Re " + range(re) : "");
  });
}

/// The same for all lines of a network.
void take_coefficients(const Scene& scene, const std::vector<std::size_t>& network, const RunWater& water,
                       const dl::Places& places, System& system) {
  for (std::size_t k = 0; k < network.size(); ++k) {
    LineModel::Part& part = system.parts[k];
    part.coefficients = take_coefficients(
        scene, scene.lines[network[k]], water, places.middleCols(part.first_node, part.nodes),
        std::span(system.d.segments)
            .subspan(static_cast<std::size_t>(part.first_segment), static_cast<std::size_t>(part.segments)));
  }
}

bool on_bodies(const Scene& scene, const std::vector<std::size_t>& network) {
  return std::any_of(network.begin(), network.end(), [&](std::size_t i) { return scene.lines[i].fastened(); });
}

dynamics::FastenedLine fastened_line(const Scene& scene, const std::vector<std::size_t>& network) {
  const System still = still_description(scene, network);
  dynamics::FastenedLine out{.name = still.parts.front().name,
                             .run = still.d,
                             .still = still.d,
                             .places = held_places(scene, network, still),
                             .ends = {},
                             .rho_infinity = scene.solve.rho_infinity};
  for (std::size_t k = 0; k < network.size(); ++k) {
    const scene::Line& l = scene.lines[network[k]];
    const LineModel::Part& part = still.parts[k];
    for (const bool first : {true, false}) {
      const scene::Line::End& end = l.end(first);
      if (end.body)
        out.ends.push_back({part.first_node + (first ? 0 : l.last_node()), point_on(scene, *end.body, *end.at),
                            fmt::format("{}.{}", l.name, first ? "from" : "to")});
    }
  }
  return out;
}

/// What must step bodies that hold lines, and what must not act on them.
void require_one_step(const Scene& scene, const scene::Line& l) {
  if (scene.solve.integrator != "generalized_alpha")
    throw InputError(fmt::format("[solve.integrator] name = \"{}\" cannot step a body together with line \"{}\"",
                                 scene.solve.integrator, l.name),
                     scene.solve.integrator_place, "take generalized_alpha");
  const bool friction = std::any_of(scene.joints.begin(), scene.joints.end(), [](const auto& j) { return j.friction; });
  if (friction || !scene.contacts.empty())
    throw InputError(
        fmt::format("line \"{}\" is on a body of a scene with {}, whose jumps of velocity it has no step for", l.name,
                    friction ? "friction" : "contacts"),
        l.place, "hold the line by the ground, or take a [[mooring]] of kind catenary");
}

/// A line and its perturbed trajectory are stepped so closely that their distance is no matter of tolerances.
void ask_for_neighbours(const Scene& scene, LineModel& m) {
  const hydro::Place& place = m.lyapunov->place;
  if (dl::keeps_accelerations(m.settings.scheme))
    throw InputError(fmt::format("line \"{}\" has no neighbours in steps of {}, which keep more than places and "
                                 "velocities",
                                 m.name, dl::name_of(m.settings.scheme)),
                     place, "leave out [solve.integrator] lines: energy_momentum");
  if (m.line->has_massless_nodes())
    throw InputError(fmt::format("line \"{}\" has a free node without mass, so its motions have no neighbours", m.name),
                     place, "give every free node or link a mass");
  constexpr int samples = 20;  // one for each block at least
  if (scene.run && m.lyapunov->from + samples * scene.run->every > scene.run->duration)
    throw InputError(fmt::format("growth counts from {} s on, and the run ends at {} s: fewer than {} samples between",
                                 m.lyapunov->from, scene.run->duration, samples),
                     place, "let it begin earlier, or the run last longer");
  m.settings.tolerance = dl::PerturbedTrajectory::tolerance;
}

/// "line a", or "lines a, b, c", each between quotes.
std::string joined(const std::vector<std::string>& names, const char* quote) {
  const std::string between = fmt::format("{0}, {0}", quote);
  return fmt::format("{} {}{}{}", names.size() > 1 ? "lines" : "line", quote, fmt::join(names, between), quote);
}

std::string joined(const std::vector<LineModel::Part>& parts, const char* quote) {
  std::vector<std::string> names;
  for (const auto& part : parts) names.push_back(part.name);
  return joined(names, quote);
}

/// Those of a network: one system, in which no line fails by itself.
[[noreturn]] void blame(const Scene& scene, const std::vector<std::size_t>& network, const std::exception& e) {
  const scene::Line& first = scene.lines[network.front()];
  std::vector<std::string> names;
  for (const std::size_t i : network) names.push_back(scene.lines[i].name);
  const std::string who = joined(names, "\"");
  if (const auto* input = dynamic_cast<const InputError*>(&e)) {
    if (network.size() == 1) throw input->at(first.place);
    throw InputError(fmt::format("{}: {}", who, input->rule()), first.place, input->remedy());
  }
  throw hydro::NumericsError(fmt::format("{}: {}", who, e.what()));
}

LineModel fastened_model(const Scene& scene, const std::vector<std::size_t>& network, const dynamics::FastenedLine& l,
                         const RunWater& water, const dl::Places& placed, std::size_t at,
                         const dynamics::State& start) {
  System system = description(scene, network, water.of_lines);
  take_coefficients(scene, network, water, placed, system);
  return {.name = l.name,
          .parts = std::move(system.parts),
          .knots = std::move(system.knots),
          .line = std::make_unique<const dl::Line>(l.run),
          .start = dynamics::line_at_rest(l, start),
          .settings = {.scheme = dl::Scheme::generalised_alpha, .rho_infinity = l.rho_infinity},
          .fastened = at};
}

/// (D114)
void start_as_measured(const scene::Line& l, LineModel& m) {
  constexpr double largest = 0.03;        // of a link's length that a measured one may differ by
  constexpr double worth_telling = 1e-6;  // of the line's length
  const dl::Line& line = *m.line;
  dl::State& s = m.start;
  for (std::size_t i = 0; i < l.start->at.size(); ++i) {
    s.position.col(static_cast<Eigen::Index>(i) + 1) = l.start->at[i];
    s.velocity.col(static_cast<Eigen::Index>(i) + 1) = l.start->velocity[i];
  }
  for (int j = 0; j < line.segments(); ++j) {
    const double is = (s.position.col(j + 1) - s.position.col(j)).norm(), length = line.segment(j).length;
    if (line.segment(j).is_inextensible() && std::abs(is - length) > largest * length)
      throw InputError(
          fmt::format("link {} is {:.4g} m long where the line starts, and {:.4g} m by itself", j + 1, is, length),
          l.start->place, "give the places of its nodes to 3 % of a link and better");
  }
  const dl::Places given = s.position;
  restore_lengths(line, s);
  if (const double by = (s.position - given).colwise().norm().maxCoeff(); by > worth_telling * line.length())
    m.parts.front().released =
        fmt::format("the places where it starts were brought by up to {:.2g} m to where its links reach", by);
}

LineModel free_model(const Scene& scene, const std::vector<std::size_t>& network, const RunWater& water) {
  dl::State rest = at_rest(scene, network);
  System system = description(scene, network, water.of_lines);
  take_coefficients(scene, network, water, rest.position, system);
  LineModel m{.name = system.parts.front().name,
              .parts = std::move(system.parts),
              .knots = std::move(system.knots),
              .line = std::make_unique<const dl::Line>(std::move(system.d)),
              .start = std::move(rest),
              .settings = {.scheme = dl::parse_scheme(scene.solve.line_scheme),
                           .rho_infinity = scene.solve.rho_infinity,
                           .gamma = scene.solve.gamma,
                           .local_error = scene::line_tolerance(scene)}};
  if (const scene::Line& l = scene.lines[network.front()]; l.release) m.parts.front().released = brought(l);
  if (const scene::Line& l = scene.lines[network.front()]; l.start) start_as_measured(l, m);
  for (const std::size_t i : network)
    if (scene.lines[i].lyapunov) m.lyapunov = scene.lines[i].lyapunov;
  if (m.lyapunov) ask_for_neighbours(scene, m);
  return m;
}

}  // namespace

std::string names_of(const LineModel& model) { return joined(model.parts, ""); }
std::string quoted_names_of(const LineModel& model) { return joined(model.parts, "\""); }

void add_fastened_lines(const Scene& scene, Prepared& prepared) {
  const dynamics::State placed = dynamics::rest_state(prepared.bodies);
  for (const auto& network : scene.networks) {
    if (!on_bodies(scene, network)) continue;
    try {
      prepared.fastened.push_back(fastened_line(scene, network));
      prepared.fastened_at_rest.push_back(dynamics::line_at_rest(prepared.fastened.back(), placed).position);
    } catch (const InputError& e) {
      blame(scene, network, e);
    } catch (const hydro::NumericsError& e) {
      const scene::Line& first = scene.lines[network.front()];
      throw InputError(fmt::format("line \"{}\": {}", first.name, e.what()), first.place,
                       "check `from`, `to` and `length`");
    }
  }
}

std::unique_ptr<const dynamics::ForceKind> fastened_kind(const Scene& scene, const Prepared& prepared,
                                                         const RunWater& water) {
  std::vector<dynamics::FastenedLine> lines = prepared.fastened;
  if (lines.empty()) return nullptr;
  std::size_t at = 0;
  for (const auto& network : scene.networks) {
    if (!on_bodies(scene, network)) continue;
    require_one_step(scene, scene.lines[network.front()]);
    System system = description(scene, network, water.of_lines);
    take_coefficients(scene, network, water, prepared.fastened_at_rest[at], system);
    lines[at++].run = std::move(system.d);
  }
  return std::make_unique<dynamics::FastenedLineKind>(std::move(lines));
}

std::optional<hydro::waves::FieldUse> water_of_lines(const Scene& scene, const Prepared& prepared,
                                                     const hydro::waves::Sea& sea, double step) {
  constexpr std::size_t few = 32;  // waves, which are summed sooner than looked up
  constexpr double runs = 3;       // of steps twice and four times as long, and of segments half as long
  const bool foreseen = dl::parse_scheme(scene.solve.line_scheme) < dl::Scheme::rosenbrock;
  if (sea.components().size() < few) return {};
  Eigen::AlignedBox3d places;
  double points = 0;
  std::size_t fastened = 0;
  for (const auto& network : scene.networks) {
    const auto* known = on_bodies(scene, network) ? &prepared.fastened_at_rest[fastened++] : nullptr;
    if (std::none_of(network.begin(), network.end(), [&](std::size_t i) { return scene.lines[i].meets_water(); }))
      continue;
    try {
      const dl::Places rest = known != nullptr ? *known : at_rest(scene, network).position;
      for (Eigen::Index i = 0; i < rest.cols(); ++i) places.extend(Eigen::Vector3d(rest.col(i)));
      if (const auto& one = scene.lines[network.front()].waves_at) places.extend(one->place_m);
      const int asked = known != nullptr || foreseen ? 2 : 6;  // an instant: by stages, and by the balance
      points += asked * runs * static_cast<double>(rest.cols());
    } catch (const InputError& e) {
      blame(scene, network, e);
    } catch (const hydro::NumericsError& e) {
      blame(scene, network, e);
    }
  }
  if (places.isEmpty()) return {};
  return water_around(scene, places, sea.hs(), step, points);
}

std::vector<LineModel> line_models(const Scene& scene, const Prepared& prepared, const RunWater& water,
                                   const dynamics::State& start) {
  std::vector<LineModel> out;
  std::size_t fastened = 0;
  for (const auto& network : scene.networks) {
    try {
      if (on_bodies(scene, network)) {
        out.push_back(fastened_model(scene, network, prepared.fastened[fastened], water,
                                     prepared.fastened_at_rest[fastened], fastened, start));
        ++fastened;
      } else {
        out.push_back(free_model(scene, network, water));
      }
      const dl::Stepper refuses(*out.back().line, out.back().settings);
    } catch (const InputError& e) {
      blame(scene, network, e);
    } catch (const hydro::NumericsError& e) {
      blame(scene, network, e);
    }
  }
  if (fastened > 0 && fastened == out.size() && scene.solve.line_scheme_place)
    throw InputError("[solve.integrator] lines acts on no line: those on bodies are stepped with them",
                     *scene.solve.line_scheme_place, "leave it out");
  return out;
}

std::vector<LineModel> lines_as_placed(const Scene& scene) {
  std::vector<LineModel> out;
  std::size_t fastened = 0;
  for (const auto& network : scene.networks) {
    System system = still_description(scene, network);
    out.push_back({.name = system.parts.front().name,
                   .parts = std::move(system.parts),
                   .knots = std::move(system.knots),
                   .line = std::make_unique<const dl::Line>(std::move(system.d)),
                   .start = {},
                   .settings = {}});
    if (on_bodies(scene, network)) out.back().fastened = fastened++;
    for (const std::size_t i : network)
      if (scene.lines[i].lyapunov) out.back().lyapunov = scene.lines[i].lyapunov;
  }
  return out;
}

PlanLine plan_line(const LineModel& m) {
  std::string also;
  for (const dl::Bed& b : m.line->description().bed)
    if (b.friction > 0) also = fmt::format(", friction of the bed {:g}", b.friction);
  for (const LineModel::Part& part : m.parts)
    if (!part.coefficients.empty()) also += ", " + part.coefficients;
  const std::string size =
      fmt::format("{} segments, {} unknowns", m.line->segments(), 3 * m.line->nodes() + m.line->segments());
  if (m.fastened) return {names_of(m), "generalized alpha, one system with its bodies" + also, size, true};
  std::string method(dl::name_of(m.settings.scheme));
  std::replace(method.begin(), method.end(), '_', ' ');
  const std::string how =
      m.line->is_network()
          ? fmt::format(" on one system of {} chains, bands with a border of {} places where they meet",
                        m.line->chains(), m.line->description().ties.size())
          : " on a chain of its own, one band elimination an iteration";
  return {names_of(m), method + how + also, size, true};
}

}  // namespace froude::compile
