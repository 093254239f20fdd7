// What lines tell of themselves.
#include <fmt/format.h>

#include <algorithm>

#include "compile/lines.hpp"
#include "compile/signal_list.hpp"

namespace froude::compile {
namespace {

namespace dl = dynamics::line;

/// The signals of line number k of a run.
class Teller {
 public:
  Teller(std::size_t k, const LineModel& m, std::vector<Signal>& out)
      : k_(k),
        why_(m.fastened ? "lines on bodies are in their static shape in small motions, which their pulls on bodies tell"
                        : "lines that are on no body are left out of small motions"),
        out_(out) {}
  template <class Read>
  void operator()(std::string name, const char* unit, std::string meaning, Read read) {
    out_.push_back({std::move(name),
                    unit,
                    std::move(meaning),
                    [k = k_, read](const Moment& m) {
                      m.lines[k]->look();
                      return read(*m.lines[k]);
                    },
                    {},
                    why_});
  }

 private:
  std::size_t k_;
  std::string why_;
  std::vector<Signal>& out_;
};

void add_nodes(const LineModel& m, const LineModel::Part& part, Teller& tell) {
  for (int i = 0; i < part.nodes; ++i) {
    const int node = part.first_node + i;
    const auto* held = m.line->held(node);
    const bool on_body = (i == 0 && part.from_on_body) || (i == part.nodes - 1 && part.to_on_body);
    if (held != nullptr && !held->path && !on_body) continue;  // it stays where it is
    for (int axis = 0; axis < 3; ++axis)
      tell(fmt::format("{}.node{}.{}", part.name, i, "xyz"[axis]), "m",
           fmt::format("{} of node {} of {}", "xyz"[axis], i, part.name),
           [node, axis](const LineRun& r) { return r.state().position(axis, node); });
  }
}

void add_knots(const LineModel& m, Teller& tell) {
  for (const LineModel::Knot& knot : m.knots)
    for (int axis = 0; axis < 3; ++axis)
      tell(fmt::format("{}.{}", knot.name, "xyz"[axis]), "m", fmt::format("{} of {}", "xyz"[axis], knot.name),
           [node = knot.node, axis](const LineRun& r) { return r.state().position(axis, node); });
}

void add_curvature(const LineModel::Part& part, Teller& tell) {
  for (int i = 1; i < part.segments; ++i)
    tell(fmt::format("{}.node{}.curvature", part.name, i), "1/m",
         fmt::format("curvature at node {} of {}", i, part.name),
         [node = part.first_node + i](const LineRun& r) { return dl::curvature(r.state(), node); });
  if (part.segments < 2) return;
  tell(part.name + ".largest_curvature", "1/m", "largest curvature of " + part.name,
       [from = part.first_node + 1, to = part.first_node + part.segments](const LineRun& r) {
         double largest = 0;
         for (int i = from; i < to; ++i) largest = std::max(largest, dl::curvature(r.state(), i));
         return largest;
       });
}

void add_links(const LineModel::Part& part, Teller& tell) {
  for (int j = 0; j < part.segments; ++j) {
    const auto add = [&](const char* what, const char* unit, const char* meaning, auto read) {
      tell(fmt::format("{}.link{}.{}", part.name, j + 1, what), unit,
           fmt::format("{} of link {} of {}", meaning, j + 1, part.name), read);
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

void add_ends(const LineModel& m, const LineModel::Part& part, Teller& tell) {
  const auto add = [&](const std::string& what, const char* unit, const char* meaning, auto read) {
    tell(part.name + "." + what, unit, fmt::format("{} of {}", meaning, part.name), read);
  };
  add("largest_tension", "N", "largest tension", [first = part.first_segment, n = part.segments](const LineRun& r) {
    return r.balance().tension.segment(first, n).maxCoeff();
  });
  for (const bool first : {true, false}) {
    const int i = part.first_node + (first ? 0 : part.nodes - 1);
    if (m.line->held(i) != nullptr && !(first ? part.from_on_body : part.to_on_body))
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

void add_whole(const LineModel& m, Teller& tell) {
  if (m.lyapunov)
    tell(m.name + ".parting", "1", "logarithm of how far neighbours have parted of " + m.name,
         [](const LineRun& r) { return r.growth()->logarithm(); });
  const std::string of = m.parts.size() > 1 ? m.name + " and of the lines that it meets" : m.name;
  const auto energy = [&](const char* what, auto read) {
    tell(fmt::format("energy.{}.{}", m.name, what), "J", fmt::format("energy of {}: {}", of, what),
         [read](const LineRun& r) { return read(r.energies()); });
  };
  energy("kinetic", [](const dl::Energies& e) { return e.kinetic; });
  energy("stored", [](const dl::Energies& e) { return e.stored(); });
  energy("supplied", [](const dl::Energies& e) { return e.supplied(); });
  energy("dissipated", [](const dl::Energies& e) { return e.dissipated(); });
  energy("residual", [](const dl::Energies& e) { return e.residual(); });
}

}  // namespace

void add_line_signals(const std::vector<LineModel>& models, std::vector<Signal>& out) {
  for (std::size_t k = 0; k < models.size(); ++k) {
    Teller tell(k, models[k], out);
    for (const LineModel::Part& part : models[k].parts) {
      add_nodes(models[k], part, tell);
      add_curvature(part, tell);
      add_links(part, tell);
      add_ends(models[k], part, tell);
    }
    add_knots(models[k], tell);
    add_whole(models[k], tell);
  }
}

}  // namespace froude::compile
