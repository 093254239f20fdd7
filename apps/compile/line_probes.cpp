// What can be asked of lines at the samples of a run.
#include <fmt/format.h>

#include <algorithm>

#include "compile/lines.hpp"

namespace froude::compile {
namespace {

namespace dl = dynamics::line;

void add_nodes(std::size_t k, const LineModel& m, const LineModel::Part& part, std::vector<LineProbe>& out) {
  for (int i = 0; i < part.nodes; ++i) {
    const int node = part.first_node + i;
    const auto* held = m.line->held(node);
    if (held != nullptr && !held->path) continue;
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({k, fmt::format("{}.node{}.{}", part.name, i, "xyz"[axis]), "m",
                     fmt::format("{} of node {} of {}", "xyz"[axis], i, part.name),
                     [node, axis](const LineRun& r) { return r.state().position(axis, node); }});
  }
}

void add_knots(std::size_t k, const LineModel& m, std::vector<LineProbe>& out) {
  for (const LineModel::Knot& knot : m.knots)
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({k, fmt::format("{}.{}", knot.name, "xyz"[axis]), "m",
                     fmt::format("{} of {}", "xyz"[axis], knot.name),
                     [node = knot.node, axis](const LineRun& r) { return r.state().position(axis, node); }});
}

void add_curvature(std::size_t k, const LineModel::Part& part, std::vector<LineProbe>& out) {
  for (int i = 1; i < part.segments; ++i)
    out.push_back({k, fmt::format("{}.node{}.curvature", part.name, i), "1/m",
                   fmt::format("curvature at node {} of {}", i, part.name),
                   [node = part.first_node + i](const LineRun& r) { return dl::curvature(r.state(), node); }});
  if (part.segments < 2) return;
  out.push_back({k, part.name + ".largest_curvature", "1/m", "largest curvature of " + part.name,
                 [from = part.first_node + 1, to = part.first_node + part.segments](const LineRun& r) {
                   double largest = 0;
                   for (int i = from; i < to; ++i) largest = std::max(largest, dl::curvature(r.state(), i));
                   return largest;
                 }});
}

void add_links(std::size_t k, const LineModel::Part& part, std::vector<LineProbe>& out) {
  for (int j = 0; j < part.segments; ++j) {
    const auto add = [&](const char* what, const char* unit, const char* meaning, auto read) {
      out.push_back({k, fmt::format("{}.link{}.{}", part.name, j + 1, what), unit,
                     fmt::format("{} of link {} of {}", meaning, j + 1, part.name), read});
    };
    const int segment = part.first_segment + j;
    const auto at = static_cast<std::size_t>(segment);
    add("tension", "N", "tension", [segment](const LineRun& r) { return r.balance().tension[segment]; });
    add("polar", "rad", "angle below the horizontal", [at](const LineRun& r) { return r.angles()[at].polar; });
    add("azimuth", "rad", "direction from x towards y", [at](const LineRun& r) { return r.angles()[at].azimuth; });
    add("polar_rate", "rad/s", "rate of the polar angle", [at](const LineRun& r) { return r.angles()[at].polar_rate; });
    add("azimuth_rate", "rad/s", "rate of the azimuth", [at](const LineRun& r) { return r.angles()[at].azimuth_rate; });
  }
}

void add_ends(std::size_t k, const LineModel& m, const LineModel::Part& part, std::vector<LineProbe>& out) {
  const auto add = [&](const std::string& what, const char* unit, const char* meaning, auto read) {
    out.push_back({k, part.name + "." + what, unit, fmt::format("{} of {}", meaning, part.name), read});
  };
  add("largest_tension", "N", "largest tension", [first = part.first_segment, n = part.segments](const LineRun& r) {
    return r.balance().tension.segment(first, n).maxCoeff();
  });
  for (const bool first : {true, false}) {
    const int i = part.first_node + (first ? 0 : part.nodes - 1);
    if (m.line->held(i) != nullptr)
      add(first ? "from.force" : "to.force", "N",
          first ? "pull on what holds the first node" : "pull on what holds the last node",
          [i](const LineRun& r) { return r.balance().holding.col(i).norm(); });
  }
  for (const bool first : {true, false}) {
    const int i = part.first_node + (first ? 0 : part.nodes - 1);
    if (m.line->bending(i) > 0)
      add(first ? "from.moment" : "to.moment", "N m",
          first ? "moment that clamps the first node" : "moment that clamps the last node",
          [line = m.line.get(), i](const LineRun& r) { return dl::clamping_moment(*line, r.state(), i); });
  }
}

void add_whole(std::size_t k, const LineModel& m, std::vector<LineProbe>& out) {
  if (m.lyapunov)
    out.push_back({k, m.name + ".parting", "1", "logarithm of how far neighbours have parted of " + m.name,
                   [](const LineRun& r) { return r.growth()->logarithm(); }});
  const std::string of = m.parts.size() > 1 ? m.name + " and of the lines that it meets" : m.name;
  const auto energy = [&](const char* what, auto read) {
    out.push_back({k, fmt::format("energy.{}.{}", m.name, what), "J", fmt::format("energy of {}: {}", of, what),
                   [read](const LineRun& r) { return read(r.energies()); }});
  };
  energy("kinetic", [](const dl::Energies& e) { return e.kinetic; });
  energy("stored", [](const dl::Energies& e) { return e.stored(); });
  energy("supplied", [](const dl::Energies& e) { return e.supplied(); });
  energy("dissipated", [](const dl::Energies& e) { return e.dissipated(); });
  energy("residual", [](const dl::Energies& e) { return e.residual(); });
}

}  // namespace

std::vector<LineProbe> line_probes(const std::vector<LineModel>& models) {
  std::vector<LineProbe> out;
  for (std::size_t k = 0; k < models.size(); ++k) {
    for (const LineModel::Part& part : models[k].parts) {
      add_nodes(k, models[k], part, out);
      add_curvature(k, part, out);
      add_links(k, part, out);
      add_ends(k, models[k], part, out);
    }
    add_knots(k, models[k], out);
    add_whole(k, models[k], out);
  }
  return out;
}

}  // namespace froude::compile
