/// \file  `[[joint]]`
#include <fmt/format.h>

#include <numbers>

#include "hydro/io/csv.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"
#include "scene/joint_property.hpp"

namespace froude::scene {
namespace dim = hydro::dim;

const Measure of_slider{"slider", "stroke", "force", dim::length, dim::force, "0 N s/m"};
const Measure of_hinge{"hinge", "angle", "moment", dim::angle, dim::moment, "0 N m s/rad"};

// Each of the properties that are listed in CMakeLists.txt.
#define FROUDE_PART(name) std::unique_ptr<const JointProperty> name##_of_joints();
#include "joint_properties.inc"
#undef FROUDE_PART

const std::vector<std::unique_ptr<const JointProperty>>& joint_properties() {
  static const auto properties = [] {
    std::vector<std::unique_ptr<const JointProperty>> all;
#define FROUDE_PART(name) all.push_back(name##_of_joints());
#include "joint_properties.inc"
#undef FROUDE_PART
    return all;
  }();
  return properties;
}

namespace {

Binding<JointFriction> friction(const Measure& m) {
  using F = JointFriction;
  const std::string load = m.load;
  return Binding<F>(
             m.of("[joint.friction]"),
             "Coulomb friction: the joint sticks until the static level is reached, and slips against the dynamic one")
      .key(positive("dynamic", m.force, load + " that resists while it slips"), &F::sliding)
      .optional(positive("static", m.force, load + " that it holds while it sticks; left out: the dynamic one"),
                &F::breakaway)
      .optional(positive("stribeck", m.coordinate / dim::time,
                         "rate over which the load of slip falls from the static level to the dynamic one; left out: "
                         "it falls at once"),
                &F::stribeck)
      .then([](const Record& record, F& out) {
        if (!record.has("static")) out.breakaway = out.sliding;
        if (out.breakaway < out.sliding)
          throw record.wrong("static", "is below the dynamic level",
                             "what sticks holds at least as much as what slips");
        if (out.stribeck && out.breakaway == out.sliding)
          throw record.wrong("stribeck", "changes nothing: the load of slip is the static level from the start",
                             "give a static level above the dynamic one");
      });
}

/// A sine, or a record, which must tell where the joint is from t = 0 on.
Binding<JointPrescribedMotion> prescribed(const Measure& m) {
  using P = JointPrescribedMotion;
  return Binding<P>(m.of("[joint.prescribed]"), std::string("what the coordinate of the ") + m.joint +
                                                    " is, whatever it takes: a forced oscillation or a recorded motion")
      .optional(quantity("amplitude", m.coordinate, "of a sine that begins at rest").only_beside("period"),
                &P::amplitude)
      .optional(positive("period", dim::time, "of the sine").only_beside("amplitude"))
      .key(quantity("ramp", dim::time, "over which the sine grows, by half a cosine")
               .within(Limit::not_negative)
               .or_default("0 s", "the sine begins at once, with its full speed"),
           &P::ramp)
      .optional(text(
          "file", "CSV beside the scene with time and stroke, of hinges angle; a cubic spline goes through its points"))
      .exactly_one_of({"amplitude", "file"})
      .then([m](const Record& record, P& out) {
        if (record.has("period")) out.omega = 2 * std::numbers::pi / record.si("period");
        if (!record.has("file")) return;
        const auto table = hydro::io::CsvTable::read(beside(record.place().file, record.text("file")));
        out.time = rising_times(record, table);
        out.coordinate = table.column(m.coordinate_name, m.coordinate);
      });
}

Binding<dynamics::PtoLaw> stops(const Measure& m) {
  using dynamics::EndStop, dynamics::PtoLaw;
  return Binding<PtoLaw>(m.of("[joint.pto.stops]"),
                         "ends of the stroke: pressed in by d at the rate v, a spring S = kd and a damper D = cv push "
                         "with S + S D/(S + abs D), not max(0, S + D)")
      .optional(quantity("lower", m.coordinate, "coordinate at which the lower one begins"))
      .optional(quantity("upper", m.coordinate, "coordinate at which the upper one begins"))
      .key(positive("stiffness", m.force / m.coordinate, "of the stop"))
      .key(quantity("damping", m.force / (m.coordinate / dim::time),
                    "c: of D = cv acts S/(S + abs D), nearly nothing at first touch")
               .within(Limit::not_negative)
               .or_default(m.no_damping, "a stop gives back what it takes"))
      .at_least_one_of({"lower", "upper"})
      .then([](const Record& record, PtoLaw& out) {
        const auto stop = [&](std::string_view end) {
          return EndStop{record.si(end), record.si("stiffness"), record.si("damping")};
        };
        if (record.has("lower")) out.lower = stop("lower");
        if (record.has("upper")) out.upper = stop("upper");
        if (out.lower && out.upper && !(out.lower->at < out.upper->at))
          throw record.wrong("upper", "is not above the lower stop", "exchange the two");
      });
}

Binding<dynamics::LineLaw> spring_and_damper(const Measure& m) {
  using dynamics::LineLaw;
  const auto x = m.coordinate, rate = m.coordinate / dim::time;
  return Binding<LineLaw>("", "")
      .optional(quantity("stiffness", m.force / x, "of the spring; negative ones push away from rest"),
                &LineLaw::stiffness)
      .optional(quantity("cubic", m.force / (x * x * x), "of the spring, times the coordinate cubed"), &LineLaw::cubic)
      .optional(positive("damping", m.force / rate, "of the damper"), &LineLaw::damping)
      .optional(positive("quadratic_damping", m.force / (rate * rate), "of the damper, times rate times its size"),
                &LineLaw::quadratic_damping);
}

Binding<Pto> pto(const Measure& m) {
  const auto latch =
      Binding<Pto>(m.of("[joint.pto.latch]"),
                   "holds the coordinate wherever it comes to rest, whatever the load, and lets it go again")
          .key(positive("hold", dim::time, "for which it holds"), &Pto::latch);
  return Binding<Pto>(m.of("[joint.pto]"),
                      std::string("works against the coordinate of the ") + m.joint + ", zero at rest")
      .part(spring_and_damper(m), &Pto::line)
      .optional(quantity("preload", m.force, "constant, against a growing coordinate"), &Pto::preload)
      .optional(positive("force_limit", m.force, "that spring, damper and preload together cannot exceed"),
                &Pto::force_limit)
      .table("stops", stops(m))
      .table("latch", latch)
      .at_least_one_of({"stiffness", "cubic", "damping", "quadratic_damping", "preload", "stops", "latch"});
}

using dynamics::JointKind;

Binding<Joint> of_kind(JointKind kind, const std::string& meaning) {
  return Binding<Joint>("", meaning).then([kind](const Record&, Joint& out) { out.kind = kind; });
}
Binding<Joint> of_kind(JointKind kind, const std::string& meaning, const std::string& axis) {
  return of_kind(kind, meaning).key(direction("axis", axis), &Joint::axis);
}
/// One that has a coordinate.
Binding<Joint> of_kind(JointKind kind, const std::string& meaning, const std::string& axis, const Measure& m) {
  auto out = of_kind(kind, meaning, axis)
                 .table("pto", pto(m), &Joint::pto)
                 .table("friction", friction(m), &Joint::friction)
                 .table("prescribed", prescribed(m), &Joint::prescribed);
  for (const auto& property : joint_properties()) out.key(inner_table(property->name(), property->keys(m)).optional());
  return out;
}

void check_axes(const Record& record, const Joint& joint) {
  const double leaning = joint.axis.normalized().dot(joint.second_axis.normalized());
  if (std::abs(leaning) > 1e-9)  // round-off of two unit vectors
    throw record.wrong("second_axis",
                       fmt::format("is {:.4g} degrees off a right angle with axis",
                                   std::asin(std::abs(leaning)) * 180 / std::numbers::pi),
                       "the two axes of a universal joint are across each other");
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

const Binding<Joint>& joint_binding() {
  static const auto binding =
      Binding<Joint>("[[joint]]", "keeps two bodies, or a body and the ground, together exactly, whatever the forces")
          .keys(
              {name_key("joint", "of the joint"),
               texts(
                   "between",
                   "[\"a\", \"b\"], [\"ground\", \"a\"], [\"a*\", \"b*\"]: the first a with the first b and so on, or "
                   "\"neighbours of m\": m1–m2, m2–m3, … of the copies m, of a grid within each row")})
          .key(vector("at", dim::length,
                      "where the joint is at rest, global; of neighbours the first pair's, and the others' moves with "
                      "them"),
               &Joint::at)
          .key(text("kind", "of joint"))
          .variant("fixed", of_kind(JointKind::fixed, "nothing moves"))
          .variant("hinge", of_kind(JointKind::hinge, "the two turn about one axis",
                                    "about which they turn, global at rest", of_hinge))
          .variant("universal", of_kind(JointKind::universal, "the two turn about two axes across each other",
                                        "that the first body holds, global at rest")
                                    .key(direction("second_axis", "that the second body holds, across the first"),
                                         &Joint::second_axis)
                                    .then(check_axes))
          .variant("ball", of_kind(JointKind::ball, "the two turn freely about the point"))
          .variant("slider",
                   of_kind(JointKind::slider, "the second slides along an axis of the first and turns about nothing",
                           "along which it slides, held by the first, global at rest", of_slider))
          .variant("planar",
                   of_kind(JointKind::planar, "the second slides in a plane of the first and turns about its normal",
                           "across the plane, held by the first, global at rest"))
          .then(check_masters)
          .place(&Joint::place);
  return binding;
}

}  // namespace

const Table& joint_table() { return joint_binding().table(); }

void build_joints(const Record& root, Names& names, Scene& scene) {
  std::vector<JointRecords> properties(joint_properties().size());
  for (const Record& record : root.tables("joint")) {
    const Joint made = joint_binding().read(record);
    const auto pairs = read_between(record, scene.bodies, GroundFirst::allowed);
    const auto name = names.of(record, pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      Joint joint = made;
      joint.name = name[p];
      joint.first = pairs[p].first;
      joint.second = pairs[p].second;
      if (p > 0)
        joint.at += scene.bodies[static_cast<std::size_t>(*pairs[p].first)].position -
                    scene.bodies[static_cast<std::size_t>(*pairs.front().first)].position;
      check_may_turn(record, joint, scene.bodies);
      for (std::size_t i = 0; i < properties.size(); ++i)
        if (const auto& key = joint_properties()[i]->name(); record.has(key))
          properties[i].emplace_back(scene.joints.size(), &record.table(key));
      scene.joints.push_back(std::move(joint));
    }
  }
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (!properties[i].empty()) scene.elements.push_back(joint_properties()[i]->read(properties[i], scene));
}

}  // namespace froude::scene
