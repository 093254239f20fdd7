#include "compile/joint_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/element.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;

/// The joints whose forces are set, as elements of a scene.
class CommandedJoints final : public scene::Elements {
 public:
  explicit CommandedJoints(std::vector<dynamics::Pto> all) : all_(std::move(all)) {}
  std::string table() const override { return "joint.pto"; }
  std::size_t count() const override { return all_.size(); }
  std::unique_ptr<const dynamics::ForceKind> force(const Site&) const override {
    return std::make_unique<dynamics::CommandedForceKind>(all_);
  }
  std::unique_ptr<const dynamics::ForceKind> force_of(const Site&, const std::vector<bool>& counts) const override {
    std::vector<dynamics::Pto> some;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (counts[i]) some.push_back(all_[i]);
    return std::make_unique<dynamics::CommandedForceKind>(std::move(some));
  }
  std::vector<scene::Attack> attacks(const Site& site) const override {
    std::vector<scene::Attack> out;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const auto joint =
          std::find_if(site.joints.begin(), site.joints.end(), [&](const auto& j) { return j.name == all_[i].name; });
      const dynamics::JointArms arms = dynamics::arms_at_rest(site.bodies, *joint);
      out.push_back({i, joint->name, joint->first, arms.first});
      if (joint->second) out.push_back({i, joint->name, *joint->second, arms.second});
    }
    return out;
  }

 private:
  std::vector<dynamics::Pto> all_;
};

void require_one_coordinate(const scene::Joint& j) {
  if (j.kind != dynamics::JointKind::slider && j.kind != dynamics::JointKind::hinge)
    throw InputError(fmt::format("joint \"{}\" is of kind \"{}\", which has no one coordinate that a controller could "
                                 "work along",
                                 j.name, name_of(j.kind)),
                     j.place, "rule sliders and hinges");
  if (j.prescribed)
    throw InputError(fmt::format("joint \"{}\" moves as `prescribed`, whatever a controller does", j.name), j.place,
                     "leave `prescribed` out, or rule another joint");
}

/// Those that one name stands for. \throws InputError where there is none
void add_ruled(const scene::Scene& scene, const JointControl& control, const Prepared& p,
               std::vector<RuledJoint>& out) {
  const auto shared = std::make_shared<const JointControl>(control);
  const std::size_t before = out.size();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const scene::Joint& j = scene.joints[i];
    names.push_back(j.name);
    if (!scene::matches(control.joints, j.name)) continue;
    require_one_coordinate(j);
    for (const RuledJoint& other : out)
      if (other.pto.name == j.name)
        throw InputError(fmt::format("two controllers rule the joint \"{}\"", j.name), j.place,
                         "leave one to each joint");
    const dynamics::Joint& made = p.joints[i];
    dynamics::PtoLaw law;
    if (j.pto) law = *j.pto;
    out.push_back({{dynamics::JointCoordinate(p.bodies, made, static_cast<int>(i)), law, made.sign, j.name}, shared});
  }
  if (out.size() == before)
    throw InputError(fmt::format("no joint \"{}\" is there for a controller", control.joints), {},
                     names.empty() ? "the scene has none" : fmt::format("joints are: {}", fmt::join(names, ", ")));
}

const dynamics::Command& finite(const dynamics::Command& asked, const std::string& joint, double time) {
  if (std::isfinite(asked.force) && std::isfinite(asked.stiffness) && std::isfinite(asked.damping)) return asked;
  throw hydro::NumericsError(
      fmt::format("the controller of \"{}\" asks for a force of {}, with slopes {} and {}, at t = {:.6g} s; it must "
                  "return numbers, "
                  "or nothing to leave what acts",
                  joint, asked.force, asked.stiffness, asked.damping, time));
}

}  // namespace

std::vector<RuledJoint> set_joint_controllers(const scene::Scene& scene, const std::vector<JointControl>& controls,
                                              Prepared& p) {
  std::vector<RuledJoint> out;
  for (const JointControl& control : controls) add_ruled(scene, control, p, out);
  if (out.empty()) return out;
  std::vector<dynamics::Pto> commanded;
  for (const RuledJoint& joint : out) {
    commanded.push_back(joint.pto);
    std::erase_if(p.ptos, [&](const dynamics::Pto& pto) { return pto.name == joint.pto.name; });
  }
  p.elements.push_back(std::make_shared<const CommandedJoints>(std::move(commanded)));
  return out;
}

JointControllers::JointControllers(std::vector<RuledJoint> joints, const std::vector<Signal>& signals)
    : joints_(std::move(joints)), signals_(joints_.empty() ? nullptr : by_name(signals)) {}

bool JointControllers::decide(const Moment& now) const {
  bool jumped = false;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const dynamics::State& state = now.workspace.state;
    const auto& [pto, control] = joints_[i];
    const dynamics::PtoState at = pto_state(pto, state);
    const SampleOfRun sample(*signals_, now);
    if (const auto asked = control->decide({sample, pto.name, at.coordinate, at.rate}))
      jumped |=
          now.workspace.find_memory<dynamics::CommandMemory>()->set(i, finite(*asked, pto.name, state.time), state);
  }
  return jumped;
}

}  // namespace froude::compile
