#include "compile/members.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/integrator.hpp"
#include "compile/waves.hpp"
#include "dynamics/force/drag.hpp"
#include "dynamics/force/member_ends.hpp"
#include "dynamics/force/morison.hpp"
#include "dynamics/force/slamming.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/kinematics.hpp"

namespace froude::compile {
namespace {

using dynamics::DragPiece;
using hydro::InputError;
using scene::Scene;

/// The velocity of the water at each piece's place at rest, three signals a piece.
dynamics::WaveSignals water_at_rest(const std::vector<dynamics::DragPiece>& pieces,
                                    const std::vector<dynamics::RigidBody>& bodies, const hydro::waves::Sea& sea,
                                    const StepGrid& grid, double ramp) {
  Eigen::MatrixXcd amplitudes(3 * static_cast<Eigen::Index>(pieces.size()),
                              static_cast<Eigen::Index>(sea.components().size()));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Eigen::Vector3d at = dynamics::rest_position(pieces[i], bodies);
    Eigen::Index column = 0;
    for (const auto& c : sea.components())
      amplitudes.block<3, 1>(3 * static_cast<Eigen::Index>(i), column++) =
          elevation_at_origin(c) * hydro::waves::velocity_transfer(c, sea.water(), at);
  }
  return signals(sea, amplitudes, grid, ramp);
}

std::unique_ptr<const dynamics::ForceKind> drag(const Scene& scene, const std::vector<dynamics::RigidBody>& bodies,
                                                const hydro::waves::Sea* sea, const StepGrid& grid) {
  if (sea != nullptr && scene.waves->stretching != hydro::waves::Stretching::vertical)
    throw InputError(
        "[member.drag] takes the water's velocity at the places at rest, with nothing but \"vertical\" above",
        scene.waves->place, "leave [waves.kinematics] out, or use [member.morison]");
  std::vector<dynamics::DragPiece> pieces = drag_at_rest(scene, bodies).pieces;
  std::optional<dynamics::WaveSignals> moving;
  if (sea != nullptr) moving = water_at_rest(pieces, bodies, *sea, grid, scene.waves->ramp);
  return std::make_unique<dynamics::DragKind>(std::move(pieces), std::move(moving));
}

CutBy cut_by(const dynamics::SlenderMember& line) { return line.pieces > 0 ? CutBy::scene : CutBy::program; }

int pieces_of(const Scene& scene, const scene::Member& m, const dynamics::SlenderMember& asked) {
  return cut_by(asked) == CutBy::scene ? asked.pieces : needed_pieces(scene, m, asked.immersion);
}

/// Where the member is on its body, cut as `asked` says or the accuracy needs.
dynamics::SlenderMember slender(const Scene& scene, const scene::Member& m, const dynamics::SlenderMember& asked) {
  const Eigen::Vector3d centre = scene.bodies[static_cast<std::size_t>(m.body)].centre_of_gravity;
  return {m.body, m.from - centre, m.to - centre, m.diameter, pieces_of(scene, m, asked), asked.immersion};
}

/// What a member tells of its loads: nothing unless the scene asks.
std::optional<dynamics::ToldLoad> loads_told(const Scene& scene, const scene::Member& m) {
  if (!m.loads) return {};
  return dynamics::ToldLoad{m.name, scene.bodies[static_cast<std::size_t>(m.body)].centre_of_gravity};
}

dynamics::MorisonMember morison(const Scene& scene, const scene::Member& m) {
  dynamics::MorisonMember out = *m.morison;
  const double height = scene.bodies[static_cast<std::size_t>(m.body)].position.z();
  if (out.line.immersion == dynamics::Immersion::whole && height + std::max(m.from.z(), m.to.z()) > 0)
    throw InputError(
        fmt::format("member \"{}\" reaches above still water, but would be loaded as if all of it were wet", m.name),
        m.place, "add partial_immersion = true to its morison, or end the member at still water");
  out.line = slender(scene, m, out.line);
  out.told = loads_told(scene, m);
  return out;
}

dynamics::SlammingMember slamming(const Scene& scene, const scene::Member& m) {
  dynamics::SlammingMember out = *m.slamming;
  out.line = slender(scene, m, out.line);
  out.told = loads_told(scene, m);
  return out;
}

/// Calls act(place, direction into the member), body axes, for the ends that are loaded.
template <class Act>
void for_each_end(const scene::Member& m, const Act& act) {
  const Eigen::Vector3d along = (m.to - m.from).normalized();
  if (m.ends->from) act(m.from, along);
  if (m.ends->to) act(m.to, Eigen::Vector3d(-along));
}

double section_area(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

void check_ends_of(const Scene& scene, const scene::Member& m) {
  const scene::Body& body = scene.bodies[static_cast<std::size_t>(m.body)];
  for_each_end(m, [&](const Eigen::Vector3d& at, const Eigen::Vector3d&) {
    if (body.position.z() + at.z() > 0)
      throw InputError(fmt::format("an end of member \"{}\" is loaded by water, but lies above it", m.name), m.place,
                       "name the end that is under water in `at` of its ends");
  });
  if (m.ends->pressure && body.hydrodynamics && body.hydrodynamics->excitation)
    throw InputError(fmt::format("waves press on the ends of member \"{}\" and, as excitation, on all of its body: "
                                 "the pressure would count twice",
                                 m.name),
                     m.place, "take pressure = true out of its ends, or excitation out of the body's hydrodynamics");
}

dynamics::MemberEnds loaded_ends(const Scene& scene, const scene::Member& m) {
  const Eigen::Vector3d centre = scene.bodies[static_cast<std::size_t>(m.body)].centre_of_gravity;
  const double plate = m.ends->diameter.value_or(m.diameter);
  dynamics::MemberEnds out{.name = m.name, .body = m.body, .ends = {}, .told = loads_told(scene, m)};
  for_each_end(m, [&](const Eigen::Vector3d& at, const Eigen::Vector3d& inward) {
    out.ends.push_back({.arm = at - centre,
                        .inward = inward,
                        .pressed = m.ends->pressure ? section_area(m.diameter) : 0,
                        .added = dynamics::end_added_mass(m.ends->ca, plate, scene.water.density),
                        .drag = 0.5 * scene.water.density * m.ends->cd * section_area(plate)});
  });
  return out;
}

/// Of the water's velocity at members: so small a share of the accuracy that it needs no estimate of its own. What cuts
/// its steps by their error takes the water where members are.
double foresight(const Scene& scene) {
  if (has_steps_by_tolerance(scene.solve)) return 0;
  return std::min(1e-4, scene.accuracy / 100);
}

/// True if what is taken for the flow under crests bends at other heights than that of still water, where members that
/// are always wet have no end of a piece.
bool has_kinks_in_water(hydro::waves::Stretching stretching) {
  return stretching == hydro::waves::Stretching::wheeler || stretching == hydro::waves::Stretching::delta;
}

/// How often a member asks for the water at an instant, counted in points, the runs that tell the error included.
double points_asked(const Scene& scene, const scene::Member& m) {
  constexpr double runs = 3;        // of steps twice and four times as long, and of pieces half as long
  constexpr double iterations = 4;  // of Newton, with differences for derivatives, where no step foresees the water
  double points = 0;                // of one run
  if (m.ends) points += iterations * ((m.ends->from ? 1 : 0) + (m.ends->to ? 1 : 0));
  if (m.morison || m.slamming) {
    const auto immersion = m.morison ? m.morison->line.immersion : m.slamming->line.immersion;
    const bool foreseen = m.morison && immersion == dynamics::Immersion::whole && foresight(scene) > 0;
    points += (foreseen ? 1 : iterations) * dynamics::points_per_piece(immersion) * needed_pieces(scene, m, immersion);
  }
  return runs * points;
}

/// The areas of a body's wet ends at rest on which waves would press vertically, but are not asked to, m²: upwards from
/// below.
double pressed_area(const Scene& scene, std::size_t body) {
  double area = 0;
  for (const scene::Member& m : scene.members) {
    if (static_cast<std::size_t>(m.body) != body || !m.morison) continue;
    const double along = (m.to - m.from).normalized().z() * section_area(m.diameter);
    const double z = scene.bodies[body].position.z();
    const bool asked = m.ends && m.ends->pressure;
    if (z + m.from.z() < 0 && !(asked && m.ends->from)) area += along;
    if (z + m.to.z() < 0 && !(asked && m.ends->to)) area -= along;
  }
  return area;
}

}  // namespace

void check_ends(const Scene& scene) {
  for (const scene::Member& m : scene.members)
    if (m.ends) check_ends_of(scene, m);
}

std::vector<std::string> ends_without_pressure(const scene::Scene& scene) {
  std::vector<std::string> out;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (!body.free[2] || !body.buoyancy || (body.hydrodynamics && body.hydrodynamics->excitation)) continue;
    const double area = std::abs(pressed_area(scene, b));
    constexpr double least = 1e-3;  // m^2; ends that press against each other leave rounding
    if (area > least)
      out.push_back(fmt::format(
          "{}: waves do not press on the ends of its members, {:.3g} m^2 seen from below: in long waves {:.3g} N "
          "per metre of amplitude are missing from its heave; add ends = {{ at = [\"from\"], pressure = "
          "true }} to the member, or give the body coefficients with excitation, if that matters",
          body.name, area, scene.water.density * scene.water.gravity * area));
  }
  return out;
}

int needed_pieces(const Scene& scene, const scene::Member& member, dynamics::Immersion immersion) {
  const bool gauss = dynamics::points_per_piece(immersion) == 2;
  const double root = std::sqrt(scene.accuracy), turning = std::ceil(gauss ? 2 : 0.5 / root);
  if (!scene.waves) return static_cast<int>(turning);
  const double k = hydro::waves::wavenumber(highest_relevant_frequency(*scene.waves), scene.water);
  const double longest = gauss ? std::pow(270 * scene.accuracy, 0.25) : std::sqrt(6 * scene.accuracy);
  const double waves = std::ceil((member.to - member.from).norm() * k / longest);
  const double kinks = has_kinks_in_water(scene.waves->stretching) ? std::ceil(0.25 / root) : 0;
  return static_cast<int>(std::max({turning, waves, kinks}));
}

bool any_member_cut(const Scene& scene, CutBy by) {
  return std::any_of(scene.members.begin(), scene.members.end(), [&](const scene::Member& m) {
    return (m.morison && cut_by(m.morison->line) == by) || (m.slamming && cut_by(m.slamming->line) == by);
  });
}

void cut_members_finer(PieceTimes times, Scene& scene) {
  for (scene::Member& m : scene.members)
    for (dynamics::SlenderMember* line :
         {m.morison ? &m.morison->line : nullptr, m.slamming ? &m.slamming->line : nullptr})
      if (line != nullptr)
        line->pieces = (cut_by(*line) == CutBy::scene ? times.given : times.chosen) * pieces_of(scene, m, *line);
}

bool any_drag_at_rest(const Scene& scene) {
  return std::any_of(scene.members.begin(), scene.members.end(), [](const auto& m) { return m.cd.has_value(); });
}

bool any_drag(const Scene& scene) { return std::any_of(scene.members.begin(), scene.members.end(), scene::has_drag); }

namespace {

/// Of a member's part that is wet at rest.
std::vector<DragPiece> wet_at_rest(const Scene& scene, const scene::Member& m, double cd,
                                   const std::vector<dynamics::RigidBody>& bodies) {
  return dynamics::drag_pieces(bodies, m.body, m.from, m.to, m.diameter, cd, scene.water.density);
}

/// Along a member's skin where that is wet at rest, ½ρ C_T πD of its length (D43): pieces of ½ρ C D with C = π C_T.
std::vector<DragPiece> skin_at_rest(const Scene& scene, const scene::Member& m,
                                    const std::vector<dynamics::RigidBody>& bodies) {
  auto out = wet_at_rest(scene, m, std::numbers::pi * m.morison->cd_tangential, bodies);
  for (DragPiece& piece : out) piece.along = true;
  return out;
}

DragPiece piece_at(const dynamics::MemberEnds& member, const dynamics::MemberEnd& end) {
  return {.body = member.body, .arm = end.arm, .axis = end.inward, .factor = end.drag, .along = true};
}

std::vector<DragPiece> drag_of_ends(const Scene& scene, const scene::Member& m) {
  std::vector<DragPiece> out;
  const dynamics::MemberEnds ends = loaded_ends(scene, m);
  for (const auto& end : ends.ends) out.push_back(piece_at(ends, end));
  return out;
}

/// Also Morison's and that of ends where `all`.
DragAtRest drag_of_members(const Scene& scene, const std::vector<dynamics::RigidBody>& bodies, bool all) {
  DragAtRest out;
  const auto add = [&](std::size_t i, const std::vector<dynamics::DragPiece>& wet) {
    out.pieces.insert(out.pieces.end(), wet.begin(), wet.end());
    out.member.resize(out.pieces.size(), i);
  };
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    const auto& m = scene.members[i];
    if (m.cd) {
      const auto wet = wet_at_rest(scene, m, *m.cd, bodies);
      if (wet.empty())
        throw InputError(fmt::format("member \"{}\" is above the water at rest and feels no drag", m.name), m.place,
                         "put it under water, or leave it out");
      add(i, wet);
    }
    if (all && m.morison && m.morison->cd > 0) add(i, wet_at_rest(scene, m, m.morison->cd, bodies));
    if (all && m.morison && m.morison->cd_tangential > 0) add(i, skin_at_rest(scene, m, bodies));
    if (all && m.ends && m.ends->cd > 0) add(i, drag_of_ends(scene, m));
  }
  for (auto& piece : out.pieces) piece.current.head<2>() = scene.current.at(dynamics::rest_position(piece, bodies).z());
  return out;
}

}  // namespace

DragAtRest drag_at_rest(const Scene& scene, const std::vector<dynamics::RigidBody>& bodies) {
  return drag_of_members(scene, bodies, false);
}

DragAtRest drag_of_responses(const Scene& scene, const std::vector<dynamics::RigidBody>& bodies) {
  return drag_of_members(scene, bodies, true);
}

// A piece of ½ρ C_D D ℓ with C_D = 1 displaces ¼πD²ρℓ.
dynamics::frequency::MemberInertia inertia_of_responses(const Scene& scene,
                                                        const std::vector<dynamics::RigidBody>& bodies) {
  dynamics::frequency::MemberInertia out{.pieces = {}, .water = scene.water, .ends = {}};
  for (const scene::Member& m : scene.members) {
    if (m.ends) {
      const dynamics::MemberEnds ends = loaded_ends(scene, m);
      for (const auto& end : ends.ends) out.ends.push_back({piece_at(ends, end), end.pressed, end.added});
    }
    if (!m.morison) continue;
    for (const dynamics::DragPiece& piece : wet_at_rest(scene, m, 1, bodies)) {
      const double displaced = piece.factor * std::numbers::pi / 2 * m.diameter;
      out.pieces.push_back({piece, displaced, m.morison->ca * displaced});
    }
  }
  return out;
}

std::optional<hydro::waves::FieldUse> water_of_members(const Scene& scene, double highest_crest, double step) {
  Eigen::AlignedBox3d members;
  double points = 0;
  for (const auto& m : scene.members) {
    if (!m.morison && !m.slamming && !m.ends) continue;
    const Eigen::Vector3d origin = scene.bodies[static_cast<std::size_t>(m.body)].position;
    members.extend(origin + m.from);
    members.extend(origin + m.to);
    points += points_asked(scene, m);
  }
  if (members.isEmpty()) return {};
  return water_around(scene, members, highest_crest, step, points);
}

void add_members(const Scene& scene, const std::vector<dynamics::RigidBody>& bodies, const RunWater& water,
                 const StepGrid& grid, std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces) {
  if (any_drag_at_rest(scene)) forces.push_back(drag(scene, bodies, water.sea ? &*water.sea : nullptr, grid));
  std::vector<dynamics::MorisonMember> moving;
  std::vector<dynamics::SlammingMember> struck;
  std::vector<dynamics::MemberEnds> ended;
  for (const auto& m : scene.members) {
    if (m.ends) ended.push_back(loaded_ends(scene, m));
    if (m.morison) moving.push_back(morison(scene, m));
    if (m.slamming) struck.push_back(slamming(scene, m));
  }
  if (!moving.empty())
    forces.push_back(std::make_unique<dynamics::MorisonKind>(std::move(moving), water.field, foresight(scene)));
  if (!ended.empty()) forces.push_back(std::make_unique<dynamics::MemberEndsKind>(std::move(ended), water.field));
  if (!struck.empty())
    forces.push_back(std::make_unique<dynamics::SlammingKind>(std::move(struck), water.field, grid.step));
}

}  // namespace froude::compile
