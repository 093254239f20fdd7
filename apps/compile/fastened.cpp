#include "compile/fastened.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "dynamics/spatial/rotation.hpp"

namespace froude::compile {
namespace {

using dynamics::Matrix6;
using dynamics::PointOnBody;
using dynamics::Variation;
using dynamics::Vector6;
using Eigen::Index;
using Eigen::Vector3d;
using hydro::InputError;
using scene::Scene;
using scene::Section;

/// The plane of a section, and the points of its body on either side of it.
class CutPlane {
 public:
  CutPlane(const scene::Body& body, int index, const Section& section)
      : body_(body), index_(index), section_(section) {}

  /// True if what acts on bodies at these points acts on the part that is described. \throws InputError where it lies
  /// in the plane, or on both sides of it
  bool has(const std::string& what, const std::vector<PointOnBody>& points) const {
    std::vector<bool> sides;
    for (const PointOnBody& point : points)
      if (point.body == index_) sides.push_back(is_ahead(what, point.arm));
    if (sides.empty()) return false;
    if (std::any_of(sides.begin(), sides.end(), [&](bool side) { return side != sides.front(); }))
      throw refused(what + " acts on both sides of", "fasten what is on either side by lines of their own");
    return sides.front();
  }

  InputError refused(const std::string& what_acts_how, const std::string& remedy) const {
    return InputError(fmt::format("{} section \"{}\" of \"{}\", and its share of the load there cannot be told",
                                  what_acts_how, section_.name, body_.name),
                      section_.place, remedy);
  }

 private:
  bool is_ahead(const std::string& what, const Vector3d& arm) const {
    constexpr double rounding = 1e-9;  // of sums of lengths that scenes give
    const Vector3d at = body_.centre_of_gravity + arm;
    const double ahead = section_.normal.dot(at - section_.at);
    if (std::abs(ahead) <= rounding * (at.norm() + section_.at.norm()))
      throw refused(fmt::format("{} acts at ({:.4g}, {:.4g}, {:.4g}) m, in the plane of", what, at.x(), at.y(), at.z()),
                    "move the section off it");
    return ahead > 0;
  }

  const scene::Body& body_;
  int index_;
  const Section& section_;
};

std::vector<PointOnBody> points_of(const dynamics::Ends& ends) {
  std::vector<PointOnBody> out{ends.first};
  if (const auto* second = std::get_if<PointOnBody>(&ends.second)) out.push_back(*second);
  return out;
}

std::vector<PointOnBody> points_of(const std::vector<dynamics::RigidBody>& bodies, const dynamics::Joint& joint) {
  const dynamics::JointArms arms = dynamics::arms_at_rest(bodies, joint);
  std::vector<PointOnBody> out{{joint.first, arms.first}};
  if (joint.second) out.push_back({*joint.second, arms.second});
  return out;
}

std::vector<PointOnBody> points_of(const dynamics::FastenedLine& line) {
  std::vector<PointOnBody> out;
  for (const auto& end : line.ends) out.push_back(end.at);
  return out;
}

/// Those that act on the part.
template <class Element, class Points>
std::vector<Element> of_part(const CutPlane& plane, const std::vector<Element>& all, Points points) {
  std::vector<Element> out;
  for (const Element& e : all)
    if (plane.has(e.name.empty() ? "a [[mooring]]" : e.name, points(e))) out.push_back(e);
  return out;
}

using Forces = std::vector<std::unique_ptr<const dynamics::ForceKind>>;

template <class Kind, class Element>
void add_kind(std::vector<Element> elements, Forces& out) {
  if (!elements.empty()) out.push_back(std::make_unique<Kind>(std::move(elements)));
}

/// Connectors with a switch have the stiffness that they begin with.
std::vector<dynamics::AxialConnector> axial_connectors(const Prepared& p) {
  std::vector<dynamics::AxialConnector> out = p.axial;
  for (const RuledConnectors& group : p.switched)
    out.insert(out.end(), group.connectors.begin(), group.connectors.end());
  return out;
}

std::vector<dynamics::Pto> ptos_of_part(const CutPlane& plane, const Prepared& p) {
  return of_part(plane, p.ptos, [&](const dynamics::Pto& pto) {
    const auto joint =
        std::find_if(p.joints.begin(), p.joints.end(), [&](const auto& j) { return j.name == pto.name; });
    return points_of(p.bodies, *joint);
  });
}

/// Elements of tables that scenes may be given more of.
void add_elements(const CutPlane& plane, const Prepared& p, int body, Forces& out) {
  const Site site{p.bodies, p.water, p.joints};
  for (const auto& elements : p.elements) {
    std::vector<bool> counts(elements->count(), false);
    for (const scene::Attack& attack : elements->attacks(site)) {
      if (attack.body != body) continue;
      const std::string what = fmt::format("{} (of [[{}]])", attack.name, elements->table());
      if (!attack.arm)
        throw plane.refused(what + " names no point where it acts on the body of",
                            "leave out that table, or the section");
      if (plane.has(what, {{body, *attack.arm}})) counts[attack.element] = true;
    }
    if (std::find(counts.begin(), counts.end(), true) != counts.end()) out.push_back(elements->force_of(site, counts));
  }
}

Forces forces_on_part(const CutPlane& plane, const Prepared& p, int body) {
  Forces out;
  const auto by_ends = [](const auto& connector) { return points_of(connector.ends); };
  add_kind<dynamics::AxialConnectorKind>(of_part(plane, axial_connectors(p), by_ends), out);
  add_kind<dynamics::BushingConnectorKind>(of_part(plane, p.bushing, by_ends), out);
  add_kind<dynamics::PtoKind>(ptos_of_part(plane, p), out);
  auto moorings = of_part(plane, p.moorings, [](const dynamics::Restoring& m) {
    return std::vector<PointOnBody>{{m.body, m.point}};
  });
  if (!moorings.empty())
    out.push_back(std::make_unique<dynamics::RestoringKind>("mooring", p.bodies, std::move(moorings)));
  add_kind<dynamics::CatenaryMooringKind>(
      of_part(plane, p.catenaries,
              [](const dynamics::CatenaryMooring& m) { return std::vector<PointOnBody>{m.fairlead}; }),
      out);
  add_kind<dynamics::FastenedLineKind>(
      of_part(plane, p.fastened, [](const dynamics::FastenedLine& line) { return points_of(line); }), out);
  add_elements(plane, p, body, out);
  return out;
}

/// Loads of waves and drag on members have no part in those that are told.
void require_members_on_other_part(const Scene& scene, int body, const CutPlane& plane) {
  for (const scene::Member& member : scene.members) {
    if (member.body != body) continue;
    const Vector3d centre = scene.bodies[static_cast<std::size_t>(body)].centre_of_gravity;
    if (plane.has(member.name, {{body, member.from - centre}, {body, member.to - centre}}))
      throw plane.refused(member.name + " is a member on the part described by",
                          "describe the other part: turn `normal` round, and give mass and centre_of_gravity of that");
  }
}

/// A load about a point `arm` from the centre of gravity, about that centre.
Matrix6 from_point(const Vector3d& arm) {
  Matrix6 out = Matrix6::Identity();
  out.bottomLeftCorner<3, 3>() = dynamics::cross_matrix(arm);
  return out;
}

Vector6 load_of(const dynamics::Model& model, int body, const dynamics::State& still) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.modes());
  dynamics::LoadSink sink(load);
  for (const auto& kind : model.forces())
    if (kind->linear_at_rest()) kind->add_load({still, nullptr}, sink);
  return load.segment<6>(6 * body);
}

/// From global axes to those of the body.
Matrix6 to_body_axes(const dynamics::State& still, int body) {
  Matrix6 out = Matrix6::Zero();
  out.topLeftCorner<3, 3>() = still.pose[static_cast<std::size_t>(body)].attitude.toRotationMatrix().transpose();
  out.bottomRightCorner<3, 3>() = out.topLeftCorner<3, 3>();
  return out;
}

/// Body axes turn with the body: δ(Rᵀf) = δf − θ × f where R is one.
Matrix6 by_turn(const Vector6& load) {
  Matrix6 out = Matrix6::Zero();
  out.topRightCorner<3, 3>() = dynamics::cross_matrix(load.head<3>());
  out.bottomRightCorner<3, 3>() = dynamics::cross_matrix(load.tail<3>());
  return out;
}

}  // namespace

std::vector<Variation> product(const Matrix6& m, const std::vector<Variation>& six) {
  std::vector<Variation> out(6);
  for (Index i = 0; i < 6; ++i)
    for (Index k = 0; k < 6; ++k) {
      if (m(i, k) == 0) continue;
      const Variation& of = six[static_cast<std::size_t>(k)];
      Variation& to = out[static_cast<std::size_t>(i)];
      for (const Variation::Part& part : of.parts)
        to.parts.push_back({.body = part.body,
                            .by_motion = m(i, k) * part.by_motion,
                            .by_velocity = m(i, k) * part.by_velocity,
                            .by_acceleration = m(i, k) * part.by_acceleration});
      for (const auto& [multiplier, factor] : of.by_multiplier)
        to.by_multiplier.emplace_back(multiplier, m(i, k) * factor);
    }
  return out;
}

FastenedToPart::FastenedToPart(const Scene& scene, const Prepared& prepared, const dynamics::Model& model, int body,
                               const Section& section)
    : joints_(model.joints()), body_(body) {
  const CutPlane plane(scene.bodies[static_cast<std::size_t>(body)], body, section);
  require_members_on_other_part(scene, body, plane);
  Forces forces = forces_on_part(plane, prepared, body);
  if (!forces.empty())
    forces_ =
        std::make_shared<const dynamics::Model>(prepared.bodies, std::vector<dynamics::AddedMass>{}, std::move(forces));
  for (std::size_t j = 0; j < prepared.joints.size(); ++j) {
    const dynamics::Joint& joint = prepared.joints[j];
    const auto points = points_of(prepared.bodies, joint);
    if (!plane.has(joint.name, points)) continue;
    if (!model.redundant().empty())
      throw plane.refused(fmt::format("joint {} holds what others hold ({}), on the part described by", joint.name,
                                      fmt::join(model.redundant(), "; ")),
                          "take out joints until none holds what others do");
    const bool first = joint.first == body;
    ends_.push_back({static_cast<int>(j), first ? dynamics::End::first : dynamics::End::second,
                     from_point(points[first ? 0 : 1].arm)});
  }
}

Vector6 FastenedToPart::at_rest(const dynamics::Still& still) const {
  Vector6 out = Vector6::Zero();
  if (forces_) out = to_body_axes(still.state, body_) * load_of(*forces_, body_, still.state);
  for (const JointEnd& e : ends_) out += e.to_centre * joints_.load_on(e.joint, e.end, still.state, still.multipliers);
  return out;
}

void FastenedToPart::add_forces(std::vector<Variation>& out, const dynamics::State& still) const {
  const dynamics::Model::Linear linear = forces_->linear_at(still);
  const Matrix6 turned = to_body_axes(still, body_), turn = by_turn(load_of(*forces_, body_, still));
  for (int b = 0; b < static_cast<int>(still.pose.size()); ++b) {
    Matrix6 by_motion = -linear.stiffness.block<6, 6>(6 * body_, 6 * b);
    if (b == body_) by_motion += turn;
    by_motion = turned * by_motion;
    const Matrix6 by_velocity = -turned * linear.damping.block<6, 6>(6 * body_, 6 * b);
    if (by_motion.isZero(0) && by_velocity.isZero(0)) continue;
    for (Index i = 0; i < 6; ++i)
      out[static_cast<std::size_t>(i)].parts.push_back(
          {.body = b, .by_motion = by_motion.row(i), .by_velocity = by_velocity.row(i)});
  }
}

std::vector<Variation> FastenedToPart::variations(const dynamics::Still& still) const {
  std::vector<Variation> out(6);
  if (forces_) add_forces(out, still.state);
  for (const JointEnd& e : ends_) {
    const auto of_joint = product(e.to_centre, joints_.load_variations(e.joint, e.end, still.state, still.multipliers));
    for (std::size_t i = 0; i < 6; ++i) {
      out[i].parts.insert(out[i].parts.end(), of_joint[i].parts.begin(), of_joint[i].parts.end());
      out[i].by_multiplier.insert(out[i].by_multiplier.end(), of_joint[i].by_multiplier.begin(),
                                  of_joint[i].by_multiplier.end());
    }
  }
  return out;
}

}  // namespace froude::compile
