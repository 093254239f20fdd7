#include "compile/connections.hpp"

#include <limits>
#include <numbers>

#include "dynamics/joint/prescribed_motion.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

using dynamics::Matrix6;
using hydro::InputError;
using scene::Scene;

/// Where the scene places an end, global, m.
Eigen::Vector3d placed(const Scene& scene, std::optional<int> body, const Eigen::Vector3d& end) {
  return body ? Eigen::Vector3d(scene.bodies[static_cast<std::size_t>(*body)].position + end) : end;
}

/// All connectors of one table of the scene have one controller.
void add_switched(const scene::Connector& c, const scene::StiffnessSwitch& s, const dynamics::AxialConnector& made,
                  Prepared& out) {
  const bool same = !out.switched.empty() && out.switched.back().place.line == c.place.line &&
                    out.switched.back().place.column == c.place.column;
  if (!same) out.switched.push_back({{}, s, c.place});
  out.switched.back().connectors.push_back(made);
}

void add_connector(const Scene& scene, const scene::Connector& c, Prepared& out) {
  const Eigen::Vector3d offset = offset_of(scene, c);
  if (const auto* given = std::get_if<dynamics::BushingConnector>(&c.kind)) {
    dynamics::BushingConnector made = *given;
    made.ends = ends_of(scene, c);
    made.rest_offset = offset;
    made.name = c.name;
    out.bushing.push_back(made);
    return;
  }
  if (offset.norm() < 1e-9)
    throw InputError(fmt::format("the ends of \"{}\" coincide, so it has no direction to act along", c.name), c.place,
                     "move an end, or use kind = \"bushing\"");
  const auto& axial = std::get<scene::AxialConnector>(c.kind);
  const dynamics::AxialConnector made{ends_of(scene, c), axial, axial.rest_length.value_or(offset.norm()), c.name};
  if (axial.switching)
    add_switched(c, *axial.switching, made, out);
  else
    out.axial.push_back(made);
}

dynamics::PrescribedMotion prescribed_motion(const scene::JointPrescribedMotion& l) {
  return l.time.empty() ? dynamics::prescribed_harmonic(l.amplitude, l.omega, l.ramp)
                        : dynamics::prescribed_through(l.time, l.coordinate);
}

/// libdynamics has the body first and the ground second: a joint that names the ground first counts its coordinate
/// backwards.
void add_joint(const scene::Joint& j, Prepared& out) {
  const bool turned = !j.first;
  const auto index = static_cast<int>(out.joints.size());
  out.joints.push_back({.name = j.name,
                        .kind = j.kind,
                        .first = turned ? *j.second : *j.first,
                        .second = turned ? j.first : j.second,
                        .place = j.at,
                        .axis = turned && j.kind == dynamics::JointKind::universal ? j.second_axis : j.axis,
                        .second_axis = turned ? j.axis : j.second_axis,
                        .sign = turned ? -1.0 : 1.0});
  dynamics::Joint& made = out.joints.back();
  if (j.prescribed)
    made.prescribed = turned ? dynamics::reversed(prescribed_motion(*j.prescribed)) : prescribed_motion(*j.prescribed);
  if (!j.friction && !j.pto) return;
  const dynamics::JointCoordinate coordinate(out.bodies, made);
  if (j.friction)
    out.friction.push_back(
        {j.name, coordinate, j.friction->breakaway, j.friction->sliding, j.friction->stribeck, {}, made.sign});
  if (!j.pto) return;
  if (j.pto->latch)
    out.friction.push_back(
        {j.name, coordinate, std::numeric_limits<double>::infinity(), 0, {}, j.pto->latch, made.sign});
  if (j.pto->has_force())
    out.ptos.push_back({dynamics::JointCoordinate(out.bodies, made, index), *j.pto, made.sign, j.name});
}

/// Given about the body's origin, which is at −c from the centre of gravity.
dynamics::Restoring mooring(const Scene& scene, dynamics::Restoring m) {
  for (int mode = 0; mode < 6; ++mode)
    m.told[static_cast<std::size_t>(mode)] = !m.stiffness.row(mode).isZero() || !m.damping.row(mode).isZero();
  m.point = -scene.bodies[static_cast<std::size_t>(m.body)].centre_of_gravity;  // it acts at the body's origin
  return m;
}

/// Its place is checked by solving it once, at rest.
dynamics::CatenaryMooring catenary_mooring(const Scene& scene, const scene::CatenaryLine& l, const Prepared& p) {
  const dynamics::CatenaryMooring out{point_on(scene, l.body, l.fairlead), {l.anchor}, l.line, {}, l.name};
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
  const double lowest = l.line.on_bed ? 0.0 : -std::numeric_limits<double>::infinity();
  return {std::max(0.0, x - by), x + by, std::max(lowest, d.z() - by), d.z() + by};
}

/// Lines that are alike and equally far from their anchors share a table.
std::shared_ptr<const dynamics::CatenaryTable> catenary_table(const Scene& scene, const scene::CatenaryLine& l,
                                                              const std::vector<dynamics::CatenaryMooring>& before) {
  const dynamics::Reach reach = reach_of(scene, l);
  const auto near = [&](double a, double b) { return std::abs(a - b) <= 1e-9 * l.table->reach; };
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto& other = before[i];
    if (!other.table || other.line != l.line || scene.catenaries[i].table->tolerance != l.table->tolerance) continue;
    const dynamics::Reach& r = other.table->reach();
    if (near(r.x_low, reach.x_low) && near(r.x_high, reach.x_high) && near(r.z_low, reach.z_low) &&
        near(r.z_high, reach.z_high))
      return other.table;
  }
  try {
    return std::make_shared<dynamics::CatenaryTable>(l.line, reach, l.table->tolerance);
  } catch (const hydro::InputError& e) {
    throw InputError(fmt::format("mooring \"{}\": {}", l.name, e.rule()), l.table->place, e.remedy());
  } catch (const hydro::NumericsError& e) {
    throw InputError(fmt::format("mooring \"{}\": within its reach {}", l.name, e.what()), l.table->place,
                     "a smaller reach");
  }
}

/// Shapes from the centres of gravity; of the ground as they are.
dynamics::Contact contact(const Scene& scene, dynamics::Contact c) {
  const auto move = [&](dynamics::Shape& shape, int body) {
    shape = dynamics::moved(shape, Eigen::Matrix3d::Identity(),
                            -scene.bodies[static_cast<std::size_t>(body)].centre_of_gravity);
  };
  move(c.shapes.first, c.first);
  if (c.second) move(c.shapes.second, *c.second);
  return c;
}

}  // namespace

dynamics::PointOnBody point_on(const Scene& scene, int body, const Eigen::Vector3d& at) {
  return {body, at - scene.bodies[static_cast<std::size_t>(body)].centre_of_gravity};
}

dynamics::Point point_on(const Scene& scene, const std::optional<int>& body, const Eigen::Vector3d& at) {
  if (body) return point_on(scene, *body, at);
  return dynamics::PointOnGround{at};
}

dynamics::Ends ends_of(const Scene& scene, const scene::PointPair& p) {
  return {point_on(scene, p.first, p.first_end), point_on(scene, p.second, p.second_end)};
}

Eigen::Vector3d offset_of(const Scene& scene, const scene::PointPair& p) {
  return placed(scene, p.second, p.second_end) - placed(scene, p.first, p.first_end);
}

void add_connections(const Scene& scene, Prepared& out) {
  for (const auto& m : scene.moorings) out.moorings.push_back(mooring(scene, m));
  for (const auto& c : scene.connectors) add_connector(scene, c, out);
  for (const auto& c : scene.contacts) out.contacts.push_back(contact(scene, c));
  for (const auto& j : scene.joints) add_joint(j, out);
  for (const auto& l : scene.catenaries) {
    auto line = catenary_mooring(scene, l, out);
    if (l.table) line.table = catenary_table(scene, l, out.catenaries);
    out.catenaries.push_back(std::move(line));
  }
}

}  // namespace froude::compile
