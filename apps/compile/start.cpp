#include "compile/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compile/step.hpp"
#include "dynamics/model/assemble.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;
using scene::Scene;

dynamics::Vector6 by_mode(const std::map<hydro::Mode, double>& values) {
  dynamics::Vector6 out = dynamics::Vector6::Zero();
  for (const auto& [mode, value] : values) out[static_cast<int>(mode)] = value;
  return out;
}

/// Puts the body where its origin has moved: R = Rz(yaw) Ry(pitch) Rx(roll), as angles are told.
void place(const scene::Body& b, const dynamics::Vector6& moved, dynamics::Pose& pose) {
  pose.attitude = dynamics::attitude_of(moved.tail<3>());
  pose.counted = moved.tail<3>();
  pose.centre = b.position + moved.head<3>() + pose.attitude * b.centre_of_gravity;
}

/// Of the centre of gravity, from that of the origin; angular velocity as it is.
dynamics::Vector6 velocity_of_centre(const scene::Body& b, const dynamics::Pose& pose, dynamics::Vector6 velocity) {
  velocity.head<3>() += velocity.tail<3>().cross(pose.attitude * b.centre_of_gravity);
  return velocity;
}

/// Into as many stages bodies are turned to where they begin that a hinge between two of them turns by less than half
/// a turn in each: so what is wound by whole turns is counted, and what hangs on it is wound with it.
int stages_of(const Scene& scene) {
  constexpr double largest = 0.5;  // rad: three angles of two bodies are 3 rad
  double farthest = 0;
  for (const auto& b : scene.bodies) farthest = std::max(farthest, by_mode(b.initial).tail<3>().cwiseAbs().maxCoeff());
  return std::max(1, static_cast<int>(std::ceil(farthest / largest)));
}

std::string told(double off, bool of_angle, const char* per) {
  return fmt::format("{:.3g} {}{}", off, of_angle ? "rad" : "m", per);
}

/// Joints that the digits of the scene leave open are closed among all bodies, and it is told; more is refused.
void close_what_digits_leave(const Scene& scene, const dynamics::Model& model, dynamics::State& state,
                             std::vector<std::string>& notes) {
  constexpr double rounding = 1e-3;  // of what is allowed: not worth telling
  const std::vector<bool> none_kept(state.pose.size(), false);
  const auto check = [&](const std::optional<dynamics::Misfit>& off, const char* what, const char* per,
                         const char* remedy) {
    if (!off) return;
    const scene::Joint& joint = scene.joints[static_cast<std::size_t>(off->joint)];
    const std::string by = told(off->off, off->of_angle, per);
    if (off->off > off->allowed)
      throw InputError(fmt::format("{} joint \"{}\" by {}, more than the {} that digits leave", what, joint.name, by,
                                   told(off->allowed, off->of_angle, per)),
                       joint.place, remedy);
    if (off->off > rounding * off->allowed)
      notes.push_back(
          fmt::format("{} joint \"{}\" by {}, which the least motion of all bodies has closed", what, joint.name, by));
  };
  check(dynamics::worst_misfit(model, state), "where the run starts, bodies open", "",
        "start both its bodies where the joint is closed, or leave `initial` of one of them out: it is carried along");
  dynamics::close_joints(model, none_kept, state);
  check(dynamics::worst_misfit_of_velocities(model, state), "where the run starts, velocities pull at", "/s",
        "give both its bodies velocities that the joint allows, or leave `initial_velocity` of one of them out");
  dynamics::close_joint_velocities(model, none_kept, state);
}

/// What a body's origin has moved by, and how fast it moves; angles near those that were counted.
BodyStart start_of(const scene::Body& b, const dynamics::Pose& pose, const dynamics::Vector6& velocity) {
  const Eigen::Vector3d arm = pose.attitude * b.centre_of_gravity;
  dynamics::Vector6 moved, moves = velocity;
  moved << pose.centre - arm - b.position, dynamics::roll_pitch_yaw(pose.attitude, pose.counted);
  moves.head<3>() -= moves.tail<3>().cross(arm);
  BodyStart out;
  for (int k = 0; k < 6; ++k) {
    const auto mode = static_cast<hydro::Mode>(k);
    if (!b.free[static_cast<std::size_t>(k)]) continue;
    out.displacement[mode] = moved[k];
    out.velocity[mode] = moves[k];
  }
  return out;
}

}  // namespace

ClosedStart closed_start(const Scene& scene, const std::vector<BodyStart>& measured) {
  const Prepared prepared = prepare(scene);
  const dynamics::Model model(prepared.bodies, {}, {}, prepared.joints);
  dynamics::State state = dynamics::rest_state(prepared.bodies);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& b = scene.bodies[i];
    place(b, by_mode(measured[i].displacement), state.pose[i]);
    state.velocity.segment<6>(6 * static_cast<Eigen::Index>(i)) =
        velocity_of_centre(b, state.pose[i], by_mode(measured[i].velocity));
  }
  ClosedStart out;
  if (const auto off = dynamics::worst_misfit(model, state))
    out.opened = fmt::format("joint \"{}\" by {}", scene.joints[static_cast<std::size_t>(off->joint)].name,
                             told(off->off, off->of_angle, ""));
  const std::vector<bool> none_kept(scene.bodies.size(), false);
  dynamics::close_joints(model, none_kept, state);
  if (const auto off = dynamics::worst_misfit(model, state); off && off->off > off->allowed)
    throw InputError(fmt::format("joint \"{}\" cannot be closed from where its bodies were measured",
                                 scene.joints[static_cast<std::size_t>(off->joint)].name),
                     scene.joints[static_cast<std::size_t>(off->joint)].place,
                     "see whether the markers sit where the scene has its points and joints");
  dynamics::close_joint_velocities(model, none_kept, state);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    out.bodies.push_back(
        start_of(scene.bodies[i], state.pose[i], state.velocity.segment<6>(6 * static_cast<Eigen::Index>(i))));
  return out;
}

dynamics::State placed_state(const Scene& scene, const Prepared& p, const dynamics::Model& model,
                             std::vector<std::string>& notes) {
  dynamics::State state = dynamics::rest_state(p.bodies);
  std::vector<bool> placed, given;
  for (const auto& b : scene.bodies) {
    placed.push_back(!b.initial.empty());
    given.push_back(!b.initial_velocity.empty());
  }
  const int stages = stages_of(scene);
  for (int stage = 1; stage <= stages; ++stage) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (placed[i])
        place(scene.bodies[i], static_cast<double>(stage) / stages * by_mode(scene.bodies[i].initial), state.pose[i]);
    dynamics::close_joints(model, placed, state);
    model.joints().count_turns(state);
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& b = scene.bodies[i];
    state.velocity.segment<6>(6 * static_cast<Eigen::Index>(i)) =
        velocity_of_centre(b, state.pose[i], by_mode(b.initial_velocity));
  }
  if (scene.run->from_equilibrium) return state;
  dynamics::close_joint_velocities(model, given, state);
  close_what_digits_leave(scene, model, state, notes);
  return state;
}

}  // namespace froude::compile
