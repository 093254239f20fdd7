#include <fmt/format.h>

#include <numbers>

#include "hydro/io/csv.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

JointKind kind_of(const std::string& word) {
  using enum JointKind;
  static const std::map<std::string, JointKind, std::less<>> kinds{{"fixed", fixed},         {"hinge", hinge},
                                                                   {"universal", universal}, {"ball", ball},
                                                                   {"slider", slider},       {"planar", planar}};
  return kinds.at(word);
}

void read_axes(const Record& record, Joint& joint) {
  if (record.has("axis")) joint.axis = record.vector("axis");
  if (!record.has("second_axis")) return;
  joint.second_axis = record.vector("second_axis");
  const double leaning = joint.axis.normalized().dot(joint.second_axis.normalized());
  if (std::abs(leaning) > 1e-9)  // round-off of two unit vectors
    throw record.wrong("second_axis",
                       fmt::format("is {:.4g} degrees off a right angle with axis",
                                   std::asin(std::abs(leaning)) * 180 / 3.14159265358979324),
                       "the two axes of a universal joint are across each other");
}

std::optional<JointFriction> read_friction(const Record& record) {
  if (!record.has("friction")) return std::nullopt;
  const Record& friction = record.table("friction");
  const double sliding = friction.si("dynamic");
  JointFriction out{sliding, sliding};
  if (friction.has("static")) out.breakaway = friction.si("static");
  if (out.breakaway < sliding)
    throw friction.wrong("static", "is below the dynamic level", "what sticks holds at least as much as what slips");
  if (friction.has("stribeck")) {
    out.stribeck = friction.si("stribeck");
    if (out.breakaway == sliding)
      throw friction.wrong("stribeck", "changes nothing: the load of slip is the static level from the start",
                           "give a static level above the dynamic one");
  }
  return out;
}

/// The sine, or the record, which must tell where the joint is from t = 0 on.
JointPrescribedMotion read_prescribed(const Record& record, JointKind kind, const std::filesystem::path& file) {
  JointPrescribedMotion out;
  if (record.has("amplitude")) {
    out.amplitude = record.si("amplitude");
    out.omega = 2 * std::numbers::pi / record.si("period");
    out.ramp = record.si("ramp");
    return out;
  }
  const auto table = hydro::io::CsvTable::read(beside(file, record.text("file")));
  out.time = rising_times(record, table);
  out.coordinate =
      kind == JointKind::hinge ? table.column("angle", hydro::dim::angle) : table.column("stroke", hydro::dim::length);
  return out;
}

/// One coordinate has one master.
void check_masters(const Record& record, const Joint& joint) {
  const bool latched = joint.pto && joint.pto->latch;
  if (joint.prescribed && joint.friction)
    throw record.wrong("prescribed",
                       "and `friction` are both of one joint: a prescribed motion neither sticks nor slips",
                       "leave one of them out");
  if (latched && (joint.friction || joint.prescribed))
    throw record.wrong("pto", "has a latch, and the joint `prescribed` or `friction`: two would hold one coordinate",
                       "leave one of them out");
}

/// Held modes of a body are held for its own sake, not by joints: a joint that asks it to leave its place holds it
/// fast.
void check_may_turn(const Record& record, const Joint& joint, const std::vector<Body>& bodies) {
  for (const std::optional<int> index : {joint.first, joint.second}) {
    if (!index) continue;
    const Body& body = bodies[static_cast<std::size_t>(*index)];
    const bool turns = body.free[3] || body.free[4] || body.free[5];
    const bool moves = body.free[0] || body.free[1] || body.free[2];
    const Eigen::Vector3d arm = joint.at - body.position - body.centre_of_gravity;
    if (turns && !moves && arm.norm() > 1e-9)
      throw record.refused(
          fmt::format("joins \"{}\", which may turn about its centre of gravity only, {:.4g} m from the joint",
                      body.name, arm.norm()),
          "a joint holds what it holds; free the translations of the body that turning about the joint needs");
  }
}

Pto read_pto(const Record& record) {
  const auto number = [&](std::string_view key) { return record.has(key) ? record.si(key) : 0.0; };
  Pto out{.stiffness = number("stiffness"),
          .cubic = number("cubic"),
          .damping = number("damping"),
          .quadratic_damping = number("quadratic_damping"),
          .preload = number("preload"),
          .force_limit = {},
          .stops = {},
          .latch = {}};
  if (record.has("force_limit")) out.force_limit = record.si("force_limit");
  if (record.has("latch")) out.latch = record.table("latch").si("hold");
  if (!record.has("stops")) return out;
  const Record& stops = record.table("stops");
  out.stops.emplace();
  if (stops.has("lower")) out.stops->lower = stops.si("lower");
  if (stops.has("upper")) out.stops->upper = stops.si("upper");
  if (out.stops->lower && out.stops->upper && !(*out.stops->lower < *out.stops->upper))
    throw stops.wrong("upper", "is not above the lower stop", "exchange the two");
  out.stops->stiffness = stops.si("stiffness");
  out.stops->damping = stops.si("damping");
  return out;
}

}  // namespace

void build_joints(const Record& root, const std::filesystem::path& file, Names& names, Scene& scene) {
  for (const Record& record : root.tables("joint")) {
    const auto pairs = read_between(record, scene.bodies, GroundFirst::allowed);
    const auto name = names.of(record, pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      if (pairs[p].first == pairs[p].second)
        throw record.wrong("between", "joins one thing to itself", "name two bodies, or a body and the ground");
      Joint joint{.name = name[p],
                  .kind = kind_of(record.text("kind")),
                  .first = pairs[p].first,
                  .second = pairs[p].second,
                  .at = record.vector("at"),
                  .pto = {},
                  .place = record.place()};
      if (p > 0)
        joint.at += scene.bodies[static_cast<std::size_t>(*pairs[p].first)].position -
                    scene.bodies[static_cast<std::size_t>(*pairs.front().first)].position;
      read_axes(record, joint);
      joint.friction = read_friction(record);
      if (record.has("pto")) joint.pto = read_pto(record.table("pto"));
      if (record.has("prescribed")) joint.prescribed = read_prescribed(record.table("prescribed"), joint.kind, file);
      check_masters(record, joint);
      check_may_turn(record, joint, scene.bodies);
      scene.joints.push_back(std::move(joint));
    }
  }
}

}  // namespace froude::scene
