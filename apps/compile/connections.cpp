#include "compile/connections.hpp"

#include <limits>
#include <numbers>

#include "dynamics/control/dominant_period.hpp"
#include "dynamics/joint/prescribed_motion.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

using dynamics::Matrix6;
using hydro::InputError;
using scene::Scene;

/// All connectors of one table of the scene have one controller.
void add_switched(const scene::Connector& c, const scene::StiffnessSwitch& s, const dynamics::AxialConnector& made,
                  Prepared& out) {
  const bool same = !out.switched.empty() && out.switched_places.back().line == c.place.line &&
                    out.switched_places.back().column == c.place.column;
  if (!same) {
    dynamics::PeriodSwitching law{
        .signal =
            [body = out.bodies[static_cast<std::size_t>(s.body)], index = static_cast<std::size_t>(s.body),
             mode = static_cast<int>(s.mode)](const dynamics::State& state) {
              return dynamics::motion_from_rest(body, state.pose[index], mode);
            },
        .every = s.every,
        .window = s.window,
        .hysteresis = s.hysteresis / (2 * std::numbers::pi),
        .dwell = s.dwell,
        .settings = {}};
    for (const auto& setting : s.settings) law.settings.push_back({setting.from, setting.stiffness});
    out.switched.push_back({{}, [law] { return std::make_unique<dynamics::DominantPeriodController>(law); }});
    out.switched_places.push_back(c.place);
  }
  out.switched.back().connectors.push_back(made);
}

void add_connector(const Scene& scene, const scene::Connector& c, Prepared& out) {
  const dynamics::Ends ends{point_on(scene, c.first, c.first_end), point_on(scene, c.second, c.second_end)};
  const Eigen::Vector3d offset = placed(scene, c.second, c.second_end) - placed(scene, c.first, c.first_end);
  if (const auto* axial = std::get_if<scene::AxialConnector>(&c.kind)) {
    if (offset.norm() < 1e-9)
      throw InputError(fmt::format("the ends of \"{}\" coincide, so it has no direction to act along", c.name), c.place,
                       "move an end, or use kind = \"bushing\"");
    const dynamics::LineLaw law{.stiffness = axial->stiffness,
                                .damping = axial->damping,
                                .cubic = axial->cubic,
                                .quadratic_damping = axial->quadratic_damping,
                                .table_x = axial->elongations,
                                .table_force = axial->tensions,
                                .tension_only = axial->tension_only};
    const dynamics::AxialConnector made{ends, law, axial->rest_length.value_or(offset.norm()), c.name};
    if (axial->switching) {
      add_switched(c, *axial->switching, made, out);
      return;
    }
    out.axial.push_back(made);
    return;
  }
  const auto& b = std::get<scene::BushingConnector>(c.kind);
  out.bushing.push_back({ends, b.stiffness, b.damping, b.rotational_stiffness, b.rotational_damping, offset, c.name});
}

dynamics::PrescribedMotion prescribed_motion(const scene::JointPrescribedMotion& l) {
  return l.time.empty() ? dynamics::prescribed_harmonic(l.amplitude, l.omega, l.ramp)
                        : dynamics::prescribed_through(l.time, l.coordinate);
}

/// libdynamics has the body first and the ground second.
void add_joint(const scene::Joint& j, Prepared& out) {
  const bool turned = !j.first;
  out.joints.push_back({.name = j.name,
                        .kind = static_cast<dynamics::JointKind>(j.kind),
                        .first = turned ? *j.second : *j.first,
                        .second = turned ? j.first : j.second,
                        .place = j.at,
                        .axis = turned && j.kind == scene::JointKind::universal ? j.second_axis : j.axis,
                        .second_axis = turned ? j.axis : j.second_axis,
                        .sign = turned ? -1.0 : 1.0});
  if (j.prescribed)
    out.joints.back().prescribed =
        turned ? dynamics::reversed(prescribed_motion(*j.prescribed)) : prescribed_motion(*j.prescribed);
  const auto coordinate = [&] { return dynamics::JointCoordinate(out.bodies, out.joints.back()); };
  if (j.friction)
    out.friction.push_back({j.name,
                            coordinate(),
                            j.friction->breakaway,
                            j.friction->sliding,
                            j.friction->stribeck,
                            {},
                            out.joints.back().sign});
  if (j.pto && j.pto->latch)
    out.friction.push_back(
        {j.name, coordinate(), std::numeric_limits<double>::infinity(), 0, {}, j.pto->latch, out.joints.back().sign});
}

void add_mooring(const Scene& scene, const scene::Mooring& m, Prepared& out) {
  // Given about the body's origin; the origin seen from the centre of gravity is −c.
  const Matrix6 T = dynamics::shift_from_centre(-scene.bodies[static_cast<std::size_t>(m.body)].centre_of_gravity);
  std::array<bool, 6> told{};
  for (int mode = 0; mode < 6; ++mode)
    told[static_cast<std::size_t>(mode)] = !m.stiffness.row(mode).isZero() || !m.damping.row(mode).isZero();
  out.moorings.push_back({.body = m.body,
                          .stiffness = T.transpose() * m.stiffness * T,
                          .damping = T.transpose() * m.damping * T,
                          .name = m.name,
                          .told = told});
}

/// What the scene lets work along the coordinates of joints. A joint that names the ground first counts its coordinate
/// backwards.
std::vector<dynamics::Pto> ptos(const Scene& scene, const Prepared& p) {
  std::vector<dynamics::Pto> out;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    if (!scene.joints[j].pto || !scene.joints[j].pto->has_force()) continue;
    const scene::Pto& s = *scene.joints[j].pto;
    dynamics::PtoLaw law{.line = {.stiffness = s.stiffness,
                                  .damping = s.damping,
                                  .cubic = s.cubic,
                                  .quadratic_damping = s.quadratic_damping},
                         .preload = s.preload,
                         .lower = {},
                         .upper = {}};
    if (s.force_limit) law.force_limit = *s.force_limit;
    if (s.stops) {
      if (s.stops->lower) law.lower = dynamics::EndStop{*s.stops->lower, s.stops->stiffness, s.stops->damping};
      if (s.stops->upper) law.upper = dynamics::EndStop{*s.stops->upper, s.stops->stiffness, s.stops->damping};
    }
    out.push_back({dynamics::JointCoordinate(p.bodies, p.joints[j], static_cast<int>(j)), law, p.joints[j].sign,
                   p.joints[j].name});
  }
  return out;
}

dynamics::ConstantLoad constant_load(const Scene& scene, const scene::Load& l) {
  return {point_on(scene, l.body, l.at), l.force, l.moment};
}

/// The line as it hangs in water; its place is checked by solving it once, at rest.
dynamics::CatenaryMooring catenary_mooring(const Scene& scene, const scene::CatenaryLine& l, const Prepared& p) {
  const double displaced = scene.water.density * std::numbers::pi / 4 * l.diameter * l.diameter;
  dynamics::CatenaryMooring out{point_on(scene, l.body, l.fairlead),
                                {l.anchor},
                                {.length = l.length,
                                 .weight = (l.mass_per_length - displaced) * scene.water.gravity,
                                 .axial_stiffness = l.axial_stiffness,
                                 .on_bed = l.on_bed},
                                {},
                                l.name};
  try {
    dynamics::tension_of(out, dynamics::rest_state(p.bodies));
  } catch (const hydro::NumericsError& e) {
    throw InputError(fmt::format("mooring \"{}\": {}", l.name, e.what()), l.place, "check `from`, `to` and `on_bed`");
  }
  return out;
}

/// Around the place of the fairlead at rest, on this side of the anchor and above the bed.
dynamics::Reach reach_of(const Scene& scene, const scene::CatenaryLine& l) {
  const Eigen::Vector3d d = scene.bodies[static_cast<std::size_t>(l.body)].position + l.fairlead - l.anchor;
  const double x = d.head<2>().norm(), by = l.table->reach;
  const double lowest = l.on_bed ? 0.0 : -std::numeric_limits<double>::infinity();
  return {std::max(0.0, x - by), x + by, std::max(lowest, d.z() - by), d.z() + by};
}

/// Lines that are alike and equally far from their anchors share a table.
std::shared_ptr<const dynamics::CatenaryTable> catenary_table(const Scene& scene, const scene::CatenaryLine& l,
                                                              const dynamics::LineProperties& line,
                                                              const std::vector<dynamics::CatenaryMooring>& before) {
  const dynamics::Reach reach = reach_of(scene, l);
  const auto near = [&](double a, double b) { return std::abs(a - b) <= 1e-9 * l.table->reach; };
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto& other = before[i];
    if (!other.table || !(other.line == line) || scene.lines[i].table->tolerance != l.table->tolerance) continue;
    const dynamics::Reach& r = other.table->reach();
    if (near(r.x_low, reach.x_low) && near(r.x_high, reach.x_high) && near(r.z_low, reach.z_low) &&
        near(r.z_high, reach.z_high))
      return other.table;
  }
  try {
    return std::make_shared<dynamics::CatenaryTable>(line, reach, l.table->tolerance);
  } catch (const hydro::InputError& e) {
    throw InputError(fmt::format("mooring \"{}\": {}", l.name, e.rule()), l.table->place, e.remedy());
  } catch (const hydro::NumericsError& e) {
    throw InputError(fmt::format("mooring \"{}\": within its reach {}", l.name, e.what()), l.table->place,
                     "a smaller reach");
  }
}

dynamics::Shape as_shape(const scene::ContactRod& rod) {
  if (rod.from == rod.to) return dynamics::Ball{rod.from, rod.radius};
  return dynamics::Rod{rod.from, rod.to, rod.radius};
}
dynamics::Shape as_shape(const scene::ContactPlane& plane) { return dynamics::HalfSpace{plane.at, plane.normal}; }
dynamics::Shape as_shape(const scene::ContactBox& box) { return dynamics::Box{box.centre, box.half}; }

/// Shapes from the centres of gravity; of the ground as they are.
dynamics::Contact contact(const Scene& scene, const scene::Contact& c) {
  const auto from_centre = [&](const dynamics::Shape& shape, int body) {
    return dynamics::moved(shape, Eigen::Matrix3d::Identity(),
                           -scene.bodies[static_cast<std::size_t>(body)].centre_of_gravity);
  };
  dynamics::Shape second = std::visit([](const auto& shape) { return as_shape(shape); }, c.on_second);
  if (c.second) second = from_centre(second, *c.second);
  return {c.name, c.first, c.second, {from_centre(as_shape(c.on_first), c.first), second}, c.restitution, c.friction};
}

}  // namespace

dynamics::PointOnBody point_on(const Scene& scene, int body, const Eigen::Vector3d& at) {
  return {body, at - scene.bodies[static_cast<std::size_t>(body)].centre_of_gravity};
}

dynamics::Point point_on(const Scene& scene, const std::optional<int>& body, const Eigen::Vector3d& at) {
  if (body) return point_on(scene, *body, at);
  return dynamics::PointOnGround{at};
}

Eigen::Vector3d placed(const Scene& scene, std::optional<int> body, const Eigen::Vector3d& end) {
  return body ? Eigen::Vector3d(scene.bodies[static_cast<std::size_t>(*body)].position + end) : end;
}

void add_connections(const Scene& scene, Prepared& out) {
  for (const auto& m : scene.moorings) add_mooring(scene, m, out);
  for (const auto& c : scene.connectors) add_connector(scene, c, out);
  for (const auto& c : scene.contacts) out.contacts.push_back(contact(scene, c));
  for (const auto& j : scene.joints) add_joint(j, out);
  out.ptos = ptos(scene, out);
  for (const auto& l : scene.lines) {
    auto line = catenary_mooring(scene, l, out);
    if (l.table) line.table = catenary_table(scene, l, line.line, out.lines);
    out.lines.push_back(std::move(line));
  }
  for (const auto& l : scene.loads) out.loads.push_back(constant_load(scene, l));
}

}  // namespace froude::compile
