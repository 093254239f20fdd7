#include "dynamics/force/restoring.hpp"

#include <fmt/format.h>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/types.hpp"

namespace dynamics {
namespace {

/// ∂load/∂(displacement and small global rotation) in a state that is displaced by `d`.
Matrix6 by_displacement(const Restoring& e, const Vector6& d) {
  const Eigen::Vector3d phi = d.tail<3>(), m = (e.stiffness * d).tail<3>() - e.moment;
  Matrix6 G = Matrix6::Identity();
  G.bottomRightCorner<3, 3>() = left_jacobian_inverse(phi);
  Matrix6 K = -G.transpose() * e.stiffness * G;
  K.bottomRightCorner<3, 3>() -= left_jacobian_inverse_transpose_derivative(phi, m) * G.bottomRightCorner<3, 3>();
  return K;
}

/// A load about the centre of gravity, or how it varies, one a column, seen from the body's origin at −`arm`.
template <int columns>
Eigen::Matrix<double, 6, columns> about_origin(Eigen::Matrix<double, 6, columns> load, const Eigen::Vector3d& arm) {
  load.template bottomRows<3>() += cross_matrix(arm) * load.template topRows<3>();
  return load;
}

Vector6 load_about_origin(const Restoring& e, const RestoringKind::Held& held, const State& state) {
  const Pose& pose = state.pose[static_cast<std::size_t>(e.body)];
  return about_origin<1>(restoring_load(e, pose.displacement(held.rest_centre), state.twist(e.body)),
                         pose.attitude * held.centre);
}

/// The arm turns with the body: δ(r × F) = r × δF + F × (r × θ).
Variation origin_variation(const Restoring& e, const RestoringKind::Held& held, const State& still, int mode) {
  const Pose& pose = still.pose[static_cast<std::size_t>(e.body)];
  const Vector6 d = pose.displacement(held.rest_centre), load = restoring_load(e, d, Vector6::Zero());
  const Eigen::Vector3d arm = pose.attitude * held.centre;
  Matrix6 by_q = about_origin<6>(by_displacement(e, d), arm);
  by_q.bottomRightCorner<3, 3>() += cross_matrix(load.head<3>()) * cross_matrix(arm);
  const Matrix6 by_v = about_origin<6>(-e.damping, arm);
  return {.parts = {{.body = e.body, .by_motion = by_q.row(mode), .by_velocity = by_v.row(mode)}}};
}

}  // namespace

Vector6 restoring_load(const Restoring& element, const Vector6& displacement, const Vector6& velocity) {
  Vector6 generalised = element.stiffness * displacement;
  generalised.tail<3>() -= element.moment;
  const Eigen::Vector3d phi = displacement.tail<3>(), m = generalised.tail<3>();
  generalised.tail<3>() = left_jacobian_inverse(phi).transpose() * m;
  return -generalised - element.damping * velocity;
}

RestoringKind::RestoringKind(std::string effect, const std::vector<RigidBody>& bodies, std::vector<Restoring> elements)
    : effect_(std::move(effect)), elements_(std::move(elements)) {
  for (const Restoring& e : elements_) {
    const RigidBody& body = bodies[static_cast<std::size_t>(e.body)];
    held_.push_back({body.name(), body.rest_centre(), body.properties().centre_of_gravity.xyz});
  }
}

std::vector<Signal> RestoringKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    for (int mode = 0; mode < 6; ++mode) {
      const Restoring& e = elements_[i];
      if (!e.told[static_cast<std::size_t>(mode)]) continue;
      const std::string name(hydro::mode_names[static_cast<std::size_t>(mode)]);
      out.push_back(
          {.name = e.name + "." + name,
           .unit = load_unit(mode),
           .meaning = fmt::format("{} load of {} on {} about its origin", name, e.name, held_[i].name),
           .value = [this, i,
                     mode](const Reading& r) { return load_about_origin(elements_[i], held_[i], r.state)[mode]; },
           .variation =
               [this, i, mode](const Still& still) {
                 return origin_variation(elements_[i], held_[i], still.state, mode);
               }});
    }
  return out;
}

void RestoringKind::add_load(const Instant& now, LoadSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const Pose& pose = now.state.pose[static_cast<std::size_t>(e.body)];
    Vector6 load = restoring_load(e, pose.displacement(held_[i].rest_centre), now.state.twist(e.body));
    load.z() += e.lift;
    out.add(e.body, load);
  }
}

void RestoringKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const Vector6 d = now.state.pose[static_cast<std::size_t>(e.body)].displacement(held_[i].rest_centre);
    out.add(e.body, e.body, by_displacement(e, d), -e.damping);
  }
}

std::string RestoringKind::breaks_off(const State& before, const State& after) const {
  for (const Restoring& e : elements_) {
    if (e.stiffness.rightCols<3>().isZero(0) && e.moment.isZero(0)) continue;
    const auto body = static_cast<std::size_t>(e.body);
    if (jumps(rotation_log(before.pose[body].attitude), rotation_log(after.pose[body].attitude)))
      return fmt::format("a body of \"{}\" has turned by more than half a turn from rest, where that law ends",
                         effect_);
  }
  return {};
}

EnergyFlow RestoringKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const Vector6 d = now.state.pose[static_cast<std::size_t>(e.body)].displacement(held_[i].rest_centre);
    const Vector6 v = now.state.twist(e.body);
    flow.stored += 0.5 * d.dot(e.stiffness * d) - e.lift * d.z() - e.moment.dot(d.tail<3>());
    flow.dissipated += v.dot(e.damping * v);
  }
  return flow;
}

}  // namespace dynamics
