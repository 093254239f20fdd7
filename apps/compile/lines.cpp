#include "compile/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/compile.hpp"
#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/exposure.hpp"
#include "dynamics/line/path.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

namespace dl = dynamics::line;
using hydro::InputError;
using scene::Scene;

/// A layer t around a diameter D adds ρ π t (D + t) per length, spread as the rest is. (D100)
void grow(const scene::Line::Growth& growth, dl::Segment& s) {
  const double before = s.mass, t = growth.thickness;
  s.mass += growth.density * std::numbers::pi * t * (s.diameter + t) * s.length;
  s.inertia *= s.mass / before;
  s.diameter += 2 * t;
}

/// `middle`: of the link, along the line, m.
dl::Segment segment(const scene::Line& l, const scene::Line::Link& link, double middle) {
  dl::Segment s{.length = link.length, .mass = link.mass, .centre = link.centre, .inertia = link.inertia};
  if (l.axial_stiffness) s.axial_stiffness = link.axial_stiffness.value_or(*l.axial_stiffness);
  if (l.bending_stiffness) s.bending_stiffness = link.bending_stiffness.value_or(*l.bending_stiffness);
  s.axial_damping = l.axial_damping;
  s.pulls_only = l.pulls_only;
  s.sags = l.sags;
  s.diameter = link.diameter.value_or(l.diameter);
  if (l.growth && middle > l.growth->from && middle < l.growth->to) grow(*l.growth, s);
  if (l.morison) {
    s.cd = l.morison->cd;
    s.ca = l.morison->ca;
    s.cd_tangential = l.morison->cd_tangential;
  }
  return s;
}

dl::Held end(const scene::Line& l, int node, bool first) {
  dl::Held out{.node = node};
  if (const auto& clamp = first ? l.clamp_from : l.clamp_to) out.clamp = *clamp;
  if (!l.lead || l.lead->first != first) return out;
  out.path = std::make_shared<dl::SplinePath>(l.lead->time, l.lead->place);
  const Eigen::Vector3d begins = out.path->at(0).position, stands = first ? l.from : *l.to;
  if ((begins - stands).norm() > 1e-3)  // m: what a table of a path is rounded to
    throw InputError(fmt::format("the path of \"{}\" is at ({:.4g}, {:.4g}, {:.4g}) m at t = 0, its end at ({:.4g}, "
                                 "{:.4g}, {:.4g}) m",
                                 l.name, begins.x(), begins.y(), begins.z(), stands.x(), stands.y(), stands.z()),
                     l.place, "let `from` or `to` be where the path begins");
  return out;
}

dl::Description description(const Scene& scene, const scene::Line& l,
                            std::shared_ptr<const hydro::waves::WaveField> field) {
  dl::Description d;
  const int last = static_cast<int>(l.links.size());
  d.nodes.assign(l.links.size() + 1, dl::Node{.mass = l.node_mass});
  if (l.damping)
    for (dl::Node& n : d.nodes) {
      n.damping = l.damping->linear;
      n.quadratic_damping = l.damping->quadratic;
    }
  d.componentwise_damping = l.damping && l.damping->componentwise;
  double along = 0;
  for (const auto& link : l.links) {
    d.segments.push_back(segment(l, link, along + link.length / 2));
    along += link.length;
  }
  d.held.push_back(end(l, 0, true));
  d.nodes.front().mass = 0;
  if (l.to) {
    d.held.push_back(end(l, last, false));
    d.nodes.back().mass = 0;
  }
  d.gravity = scene.water.gravity;
  if (l.bed) d.bed.push_back({-scene.water.depth.metres(), l.bed->stiffness, l.bed->damping, l.bed->friction});
  if (l.morison || l.buoyancy)
    d.water = {std::move(field), l.partial_immersion ? dl::Wet::below_surface : dl::Wet::all, l.buoyancy};
  return d;
}

/// Where the line reaches of the place at which a node is to be held before its release: places are written with few
/// digits, and a single link reaches one distance only.
Eigen::Vector3d reached(const scene::Line& l) {
  constexpr double written = 1e-3;  // of the way, that a place may be off
  const Eigen::Vector3d way = l.release->at - l.from;
  double reach = 0;
  for (int j = 0; j < l.release->node; ++j) reach += l.links[static_cast<std::size_t>(j)].length;
  const bool fixed = !l.axial_stiffness && (l.release->node == 1 || way.norm() > reach);
  return fixed && std::abs(way.norm() - reach) <= written * reach ? Eigen::Vector3d(l.from + reach * way.normalized())
                                                                  : l.release->at;
}

std::shared_ptr<const hydro::waves::WaveField> without_waves(const Scene& scene) {
  return std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, scene.water,
                                                       hydro::waves::HarmonicField::Options{}, scene.current);
}

/// Rest without waves, in the current, with the node that is to be released held.
dl::State at_rest(const Scene& scene, const scene::Line& l) {
  dl::Description d = description(scene, l, without_waves(scene));
  if (l.release) d.held.push_back({.node = l.release->node});
  const dl::Line line(std::move(d));
  dl::State places{.position = dl::Places::Zero(3, line.nodes()),
                   .velocity = dl::Places::Zero(3, line.nodes()),
                   .tension = Eigen::VectorXd::Zero(line.segments())};
  places.position.col(0) = l.from;
  if (l.to) places.position.col(line.nodes() - 1) = *l.to;
  if (l.release) places.position.col(l.release->node) = reached(l);
  dl::State guess = dl::hanging_shape(line, places);
  // What is clamped and free beyond stands or hangs as it does: from straight down it might not turn over.
  if (l.clamp_from && !l.to && !l.release)
    for (int i = 1; i < line.nodes(); ++i)
      guess.position.col(i) = guess.position.col(i - 1) + line.segment(i - 1).length * *l.clamp_from;
  return dl::equilibrium(line, guess);
}

/// Lowest and highest of some numbers: "1.2 to 1.9".
std::string range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low == *high ? fmt::format("{:.3g}", *low) : fmt::format("{:.3g} to {:.3g}", *low, *high);
}

/// Puts in what the table has for the waves that pass each segment in `places`, and tells it. (D104), (D105)
std::string take_coefficients(const Scene& scene, const scene::Line& l, const RunWater& water, const dl::Places& places,
                              dl::Description& d) {
  if (!l.morison || !l.morison->table) return "";
  const auto& given = *l.morison->table;
  try {
    std::vector<dl::CoefficientTable::Row> rows;
    for (const auto& r : given.rows) rows.push_back({r.kc, r.re, r.cd, r.ca});
    const dl::CoefficientTable table(std::move(rows));
    const double ramp = scene.waves->ramp < scene.run->duration ? scene.waves->ramp : 0;
    const auto exposures = dl::exposure(*water.field, places, ramp, scene.run->duration);
    std::vector<double> kc, re, cd, ca;
    for (std::size_t j = 0; j < d.segments.size(); ++j) {
      dl::Segment& s = d.segments[j];
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
    return fmt::format("C_D {}, C_A {} by {} at KC {}{}", range(cd), range(ca), given.file.string(), range(kc),
                       table.knows_reynolds() ? ", Re " + range(re) : "");
  } catch (const InputError& e) {
    throw e.at(given.place);
  }
}

dynamics::FastenedLine fastened_line(const Scene& scene, const scene::Line& l) {
  dl::Description still = description(scene, l, without_waves(scene));
  const int last = static_cast<int>(l.links.size());
  dynamics::FastenedLine out{.name = l.name,
                             .run = still,
                             .still = still,
                             .places = dl::Places::Zero(3, last + 1),
                             .ends = {},
                             .rho_infinity = scene.solve.rho_infinity};
  const auto add = [&](int node, std::optional<int> body, const Eigen::Vector3d& at) {
    out.places.col(node) = at;
    if (body) out.ends.push_back({node, *body, at - scene.bodies[static_cast<std::size_t>(*body)].centre_of_gravity});
  };
  add(0, l.from_on, l.from);
  if (l.to) add(last, l.to_on, *l.to);
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

/// A line and its companion are stepped so closely that their distance is no matter of tolerances.
void ask_for_neighbours(const Scene& scene, LineModel& m) {
  const hydro::Place& place = m.lyapunov->place;
  if (m.settings.scheme == dl::Scheme::generalised_alpha)
    throw InputError(
        fmt::format("line \"{}\" has no neighbours in steps of generalized_alpha, which remember more than "
                    "places and velocities",
                    m.name),
        place, "leave out [solve.integrator] lines: energy_momentum");
  if (m.line->has_massless_nodes())
    throw InputError(fmt::format("line \"{}\" has a free node without mass, so its motions have no neighbours", m.name),
                     place, "give every free node or link a mass");
  constexpr int samples = 20;  // one for each block at least
  if (scene.run && m.lyapunov->from + samples * scene.run->every > scene.run->duration)
    throw InputError(fmt::format("growth counts from {} s on, and the run ends at {} s: fewer than {} samples between",
                                 m.lyapunov->from, scene.run->duration, samples),
                     place, "let it begin earlier, or the run last longer");
  m.settings.tolerance = dl::Companion::tolerance;
}

LineModel fastened_model(const dynamics::FastenedLine& l, std::size_t at, const dynamics::State& start) {
  return {.name = l.name,
          .line = std::make_unique<const dl::Line>(l.run),
          .start = dynamics::line_at_rest(l, start),
          .settings = {.scheme = dl::Scheme::generalised_alpha, .rho_infinity = l.rho_infinity},
          .snaps = {},
          .fastened = at};
}

}  // namespace

std::vector<dynamics::FastenedLine> fastened_lines(const Scene& scene, const std::vector<dynamics::RigidBody>& bodies) {
  std::vector<dynamics::FastenedLine> out;
  for (const scene::Line& l : scene.chains) {
    if (!l.fastened()) continue;
    try {
      out.push_back(fastened_line(scene, l));
      dynamics::line_at_rest(out.back(), dynamics::rest_state(bodies));
    } catch (const InputError& e) {
      throw e.at(l.place);
    } catch (const hydro::NumericsError& e) {
      throw InputError(fmt::format("line \"{}\": {}", l.name, e.what()), l.place, "check `from`, `to` and `length`");
    }
  }
  return out;
}

std::unique_ptr<const dynamics::ForceKind> fastened_kind(const Scene& scene, const Prepared& prepared,
                                                         const RunWater& water) {
  std::vector<dynamics::FastenedLine> lines = prepared.fastened;
  if (lines.empty()) return nullptr;
  auto line = lines.begin();
  for (const scene::Line& l : scene.chains) {
    if (!l.fastened()) continue;
    require_one_step(scene, l);
    line->run = description(scene, l, water.field);
    take_coefficients(scene, l, water, dynamics::line_at_rest(*line, dynamics::rest_state(prepared.bodies)).position,
                      line->run);
    ++line;
  }
  return std::make_unique<dynamics::FastenedLineKind>(std::move(lines));
}

std::vector<LineModel> line_models(const Scene& scene, const Prepared& prepared, const RunWater& water,
                                   const dynamics::State& start) {
  std::vector<LineModel> out;
  std::size_t fastened = 0;
  for (const scene::Line& l : scene.chains) {
    try {
      if (l.fastened()) {
        const dynamics::FastenedLine& held = prepared.fastened[fastened];
        out.push_back(fastened_model(held, fastened, start));
        ++fastened;
        out.back().snaps = l.snaps;
        dl::Description in_waves = held.run;
        out.back().coefficients = take_coefficients(
            scene, l, water, dynamics::line_at_rest(held, dynamics::rest_state(prepared.bodies)).position, in_waves);
        const dl::Stepper refuses(*out.back().line, out.back().settings);
        continue;
      }
      dl::State rest = at_rest(scene, l);
      dl::Description d = description(scene, l, water.field);
      const std::string coefficients = take_coefficients(scene, l, water, rest.position, d);
      LineModel m{.name = l.name,
                  .line = std::make_unique<const dl::Line>(std::move(d)),
                  .start = std::move(rest),
                  .settings = {.scheme = dl::parse_scheme(scene.solve.line_scheme),
                               .rho_infinity = scene.solve.rho_infinity,
                               .gamma = scene.solve.gamma},
                  .snaps = l.snaps,
                  .lyapunov = l.lyapunov,
                  .coefficients = coefficients};
      const dl::Stepper refuses(*m.line, m.settings);
      if (m.lyapunov) ask_for_neighbours(scene, m);
      out.push_back(std::move(m));
    } catch (const InputError& e) {
      throw e.at(l.place);
    } catch (const hydro::NumericsError& e) {
      throw hydro::NumericsError(fmt::format("line \"{}\": {}", l.name, e.what()));
    }
  }
  if (fastened > 0 && fastened == out.size() && scene.solve.line_scheme_place)
    throw InputError("[solve.integrator] lines acts on no line: those on bodies are stepped with them",
                     *scene.solve.line_scheme_place, "leave it out");
  return out;
}

PlanLine plan_line(const LineModel& m) {
  std::string also;
  for (const dl::Bed& b : m.line->description().bed)
    if (b.friction > 0) also = fmt::format(", friction of the bed {:g}", b.friction);
  if (!m.coefficients.empty()) also += ", " + m.coefficients;
  if (m.fastened)
    return {"line " + m.name, "generalized alpha, one system with its bodies" + also,
            fmt::format("{} segments, {} unknowns", m.line->segments(), 3 * m.line->nodes() + m.line->segments()),
            true};
  std::string method(dl::name_of(m.settings.scheme));
  std::replace(method.begin(), method.end(), '_', ' ');
  return {"line " + m.name, method + " on a chain of its own, one band elimination an iteration" + also,
          fmt::format("{} segments, {} unknowns", m.line->segments(), 3 * m.line->nodes() + m.line->segments()), true};
}

void LineRun::begin() {
  first_height_ = energies().height;
  for (const dl::LinkAngles& a : model_.before) angles_.push_back({a, 0, 0});
  if (model_.snaps) snaps_.emplace(model_.line->segments(), model_.snaps->slack_below, model_.snaps->snap_above);
  look();
}

void LineRun::note(double h) {
  if (snaps_) snaps_->note(state().time, h, state().tension);
}

LineRun::LineRun(const LineModel& model, dl::DrivenLine& driven) : model_(model), driven_(&driven) { begin(); }

LineRun::LineRun(const LineModel& model)
    : model_(model), state_(model.start), stepper_(std::make_unique<dl::Stepper>(*model.line, model.settings)) {
  stepper_->start(state_);
  if (model.lyapunov) companion_ = std::make_unique<dl::Companion>(*model.line, model.settings, state_);
  begin();
}

dl::StepReport LineRun::step(double h) {
  if (driven_ != nullptr) return {};
  try {
    const dl::StepReport report = stepper_->step(state_, h);
    if (companion_) companion_->follow(state_, report, h);
    return report;
  } catch (const hydro::NumericsError& e) {
    throw hydro::NumericsError(fmt::format("line \"{}\": {}", model_.name, e.what()));
  }
}

std::optional<dynamics::Exponent> LineRun::exponent() const {
  if (!companion_) return std::nullopt;
  return companion_->growth().exponent(model_.lyapunov->from);
}

void LineRun::look() {
  const dl::Energies& e = energies();
  turnover_ = std::max(
      {turnover_, e.kinetic, e.axial, std::abs(e.height - first_height_), std::abs(e.supplied()), e.dissipated()});
  if (driven_ != nullptr) {
    balance_ = driven_->balance();
  } else if (auto found = stepper_->balance(state_)) {
    balance_ = std::move(*found);
  } else {
    balance_ = {.acceleration = dl::Places::Zero(3, model_.line->nodes()),
                .tension = state_.tension,
                .holding = dl::Places::Zero(3, model_.line->nodes())};
  }
  const bool first = angles_.empty();
  angles_.resize(static_cast<std::size_t>(model_.line->segments()));
  for (int j = 0; j < model_.line->segments(); ++j) {
    Angles& a = angles_[static_cast<std::size_t>(j)];
    const dl::LinkAngles now = first ? dl::link_angles(state(), j) : dl::link_angles(state(), j, a);
    const dl::LinkAngles rate = dl::link_rates(state(), j, now);
    a = {{now.polar, now.azimuth}, rate.polar, rate.azimuth};
  }
}

namespace {

void add_nodes(std::size_t k, const LineModel& m, std::vector<LineProbe>& out) {
  for (int i = 0; i < m.line->nodes(); ++i) {
    const auto* held = m.line->held(i);
    if (held != nullptr && !held->path) continue;
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({k, fmt::format("{}.node{}.{}", m.name, i, "xyz"[axis]), "m",
                     fmt::format("{} of node {} of {}", "xyz"[axis], i, m.name),
                     [i, axis](const LineRun& r) { return r.state().position(axis, i); }});
  }
}

void add_curvature(std::size_t k, const LineModel& m, std::vector<LineProbe>& out) {
  for (int i = 1; i < m.line->segments(); ++i)
    out.push_back({k, fmt::format("{}.node{}.curvature", m.name, i), "1/m",
                   fmt::format("curvature at node {} of {}", i, m.name),
                   [i](const LineRun& r) { return dl::curvature(r.state(), i); }});
  if (m.line->segments() < 2) return;
  out.push_back({k, m.name + ".largest_curvature", "1/m", "largest curvature of " + m.name,
                 [last = m.line->segments()](const LineRun& r) {
                   double largest = 0;
                   for (int i = 1; i < last; ++i) largest = std::max(largest, dl::curvature(r.state(), i));
                   return largest;
                 }});
}

void add_links(std::size_t k, const LineModel& m, std::vector<LineProbe>& out) {
  for (int j = 0; j < m.line->segments(); ++j) {
    const auto add = [&](const char* what, const char* unit, const char* meaning, auto read) {
      out.push_back({k, fmt::format("{}.link{}.{}", m.name, j + 1, what), unit,
                     fmt::format("{} of link {} of {}", meaning, j + 1, m.name), read});
    };
    const auto at = static_cast<std::size_t>(j);
    add("tension", "N", "tension", [j](const LineRun& r) { return r.balance().tension[j]; });
    add("polar", "rad", "angle below the horizontal", [at](const LineRun& r) { return r.angles()[at].polar; });
    add("azimuth", "rad", "direction from x towards y", [at](const LineRun& r) { return r.angles()[at].azimuth; });
    add("polar_rate", "rad/s", "rate of the polar angle", [at](const LineRun& r) { return r.angles()[at].polar_rate; });
    add("azimuth_rate", "rad/s", "rate of the azimuth", [at](const LineRun& r) { return r.angles()[at].azimuth_rate; });
  }
}

void add_whole(std::size_t k, const LineModel& m, std::vector<LineProbe>& out) {
  const auto add = [&](const std::string& what, const char* unit, const char* meaning, auto read) {
    out.push_back({k, m.name + "." + what, unit, fmt::format("{} of {}", meaning, m.name), read});
  };
  add("largest_tension", "N", "largest tension", [](const LineRun& r) { return r.balance().tension.maxCoeff(); });
  add("from.force", "N", "pull on what holds the first node",
      [](const LineRun& r) { return r.balance().holding.leftCols<1>().norm(); });
  if (m.line->held(m.line->nodes() - 1) != nullptr)
    add("to.force", "N", "pull on what holds the last node",
        [](const LineRun& r) { return r.balance().holding.rightCols<1>().norm(); });
  for (const bool first : {true, false}) {
    const int i = first ? 0 : m.line->segments();
    if (m.line->bending(i) > 0)
      add(first ? "from.moment" : "to.moment", "N m",
          first ? "moment that clamps the first node" : "moment that clamps the last node",
          [line = m.line.get(), i](const LineRun& r) { return dl::clamping_moment(*line, r.state(), i); });
  }
  if (m.lyapunov)
    add("parting", "1", "logarithm of how far neighbours have parted",
        [](const LineRun& r) { return r.growth()->logarithm(); });
  const auto energy = [&](const char* what, auto read) {
    out.push_back({k, fmt::format("energy.{}.{}", m.name, what), "J", fmt::format("energy of {}: {}", m.name, what),
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
    add_nodes(k, models[k], out);
    add_curvature(k, models[k], out);
    add_links(k, models[k], out);
    add_whole(k, models[k], out);
  }
  return out;
}

}  // namespace froude::compile
