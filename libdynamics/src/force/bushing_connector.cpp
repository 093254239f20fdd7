#include <fmt/format.h>

#include "dynamics/force/connector.hpp"
#include "pair.hpp"

namespace dynamics {
namespace {

using detail::EndPoint;

/// The second end seen from the first body.
struct RelativeMotion {
  EndPoint a, b;
  Eigen::Vector3d distance;  // from the first end to the second, global
  Eigen::Vector3d shift;     // ε: the distance along the first body's axes, less what it is at rest
};

RelativeMotion relative_motion(const Ends& ends, const Eigen::Vector3d& rest_offset, const State& state) {
  const EndPoint a = detail::end_point(ends.first, state), b = detail::end_point(ends.second, state);
  const Eigen::Vector3d distance = b.position - a.position;
  return {a, b, distance, a.rotation.transpose() * distance - rest_offset};
}

/// How the shift varies with displacements, global axes: as the distance of the ends, less its turning with the first
/// body.
detail::Matrix3x12 shift_derivative(const RelativeMotion& m) {
  detail::Matrix3x12 out = detail::relative_position_derivative(m.a, m.b);
  out.middleCols<3>(3) += cross_matrix(m.distance);
  return out;
}

/// The same along one axis of the first body.
RowOfTwo shift_row(const RelativeMotion& m, int axis) {
  return m.a.rotation.col(axis).transpose() * shift_derivative(m);
}

/// Everything seen along the first body's axes.
struct Strain : RelativeMotion {
  Eigen::Vector3d arm_to_second;          // ρ: from the first centre to the second end, global
  Eigen::Vector3d shift_rate;             // dε/dt
  Eigen::Vector3d turn, turn_rate;        // ψ, relative angular velocity
  Eigen::Vector3d relative_velocity;      // of the second end to the first body there, global
  Eigen::Vector3d force, elastic_moment;  // k ε + c dε/dt; J(ψ)⁻ᵀ κ ψ
};

Strain strain(const BushingConnector& c, const State& state) {
  Strain s;
  static_cast<RelativeMotion&>(s) = relative_motion(c.ends, c.rest_offset, state);
  const Eigen::Matrix3d to_first = s.a.rotation.transpose();
  s.arm_to_second = s.a.arm + s.distance;
  s.relative_velocity = s.b.velocity - s.a.velocity - s.a.omega.cross(s.distance);
  s.shift_rate = to_first * s.relative_velocity;
  s.turn = rotation_log(Eigen::Quaterniond(Eigen::Matrix3d(to_first * s.b.rotation)));
  s.turn_rate = to_first * (s.b.omega - s.a.omega);
  s.force = c.stiffness.cwiseProduct(s.shift) + c.damping.cwiseProduct(s.shift_rate);
  s.elastic_moment = left_jacobian_inverse(s.turn).transpose() * c.rotational_stiffness.cwiseProduct(s.turn);
  return s;
}

detail::PairLoad pair_load(const BushingConnector& c, const Strain& s) {
  detail::PairLoad p;
  p.force = s.a.rotation * s.force;
  p.first_arm = s.arm_to_second;
  p.second_arm = s.b.arm;
  p.moment = s.a.rotation * (s.elastic_moment + c.rotational_damping.cwiseProduct(s.turn_rate));
  return p;
}

/// Adds the derivatives to a load. Turning the first body by θ₁ turns the axes along which everything is measured.
void differentiate(const BushingConnector& c, const Strain& s, detail::PairLoad& p) {
  using detail::Matrix3x12;
  const Eigen::Matrix3d R = s.a.rotation;
  const auto turned = [&](const Eigen::Vector3d& diagonal) {
    return Eigen::Matrix3d(R * diagonal.asDiagonal() * R.transpose());
  };
  const Matrix3x12 shift_by_q = shift_derivative(s);
  Matrix3x12 rate_by_q = detail::relative_velocity_derivative(s.a, s.b);
  rate_by_q.leftCols<3>() = cross_matrix(s.a.omega);
  rate_by_q.middleCols<3>(3) = cross_matrix(s.relative_velocity);
  rate_by_q.middleCols<3>(6) = -cross_matrix(s.a.omega);
  rate_by_q.rightCols<3>() += cross_matrix(s.a.omega) * cross_matrix(s.b.arm);
  p.force_by_q = turned(c.stiffness) * shift_by_q + turned(c.damping) * rate_by_q;
  p.force_by_q.middleCols<3>(3) -= cross_matrix(p.force);
  p.force_by_v = turned(c.damping) * shift_by_q;

  Matrix3x12 turn_by_q = Matrix3x12::Zero();  // of the second body's attitude seen from the first, global
  turn_by_q.middleCols<3>(3) = -Eigen::Matrix3d::Identity();
  turn_by_q.rightCols<3>() = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d Ji = left_jacobian_inverse(s.turn);
  const Eigen::Vector3d spring = c.rotational_stiffness.cwiseProduct(s.turn);
  const Eigen::Matrix3d elastic = (Ji.transpose() * c.rotational_stiffness.asDiagonal().toDenseMatrix() +
                                   left_jacobian_inverse_transpose_derivative(s.turn, spring)) *
                                  Ji;
  Matrix3x12 turn_rate_by_q = Matrix3x12::Zero();
  turn_rate_by_q.middleCols<3>(3) = cross_matrix(s.b.omega - s.a.omega);
  p.moment_by_q = R * elastic * R.transpose() * turn_by_q + turned(c.rotational_damping) * turn_rate_by_q;
  p.moment_by_q.middleCols<3>(3) -= cross_matrix(p.moment);
  p.moment_by_v = turned(c.rotational_damping) * turn_by_q;

  p.first_arm_by_q << -Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity(),
      -cross_matrix(s.b.arm);
  p.second_arm_by_q = detail::arm_derivative(1, s.b.arm);
}

/// How the force along one axis of the first body varies where both are still.
Variation force_variation(const BushingConnector& c, const State& still, int axis) {
  const RowOfTwo by_q = shift_row(relative_motion(c.ends, c.rest_offset, still), axis);
  return detail::variation_of(c.ends, c.stiffness[axis] * by_q, c.damping[axis] * by_q);
}

}  // namespace

std::vector<Signal> relative_motion_signals(const std::string& name, const Ends& ends,
                                            const Eigen::Vector3d& rest_offset) {
  std::vector<Signal> out;
  for (int axis = 0; axis < 3; ++axis)
    out.push_back(
        {.name = fmt::format("{}.{}", name, "xyz"[axis]),
         .unit = "m",
         .meaning = fmt::format("second end of {} seen from its first body along that body's {}, from as placed", name,
                                "xyz"[axis]),
         .value = [ends, rest_offset,
                   axis](const Reading& r) { return relative_motion(ends, rest_offset, r.state).shift[axis]; },
         .variation =
             [ends, rest_offset, axis](const Still& still) {
               return detail::variation_of(ends, shift_row(relative_motion(ends, rest_offset, still.state), axis));
             }});
  return out;
}

std::vector<Signal> BushingConnectorKind::signals() const {
  std::vector<Signal> out;
  for (const BushingConnector& e : elements_)
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({.name = e.name + ".force_" + "xyz"[axis],
                     .unit = "N",
                     .meaning = fmt::format("force of {} on its first body along that body's {}", e.name, "xyz"[axis]),
                     .value = [e, axis](const Reading& r) { return bushing_force(e, r.state)[axis]; },
                     .variation = [e, axis](const Still& still) { return force_variation(e, still.state, axis); }});
  return out;
}

Eigen::Vector3d bushing_force(const BushingConnector& connector, const State& state) {
  return strain(connector, state).force;
}

void BushingConnectorKind::couple(BlockPattern& pattern) const {
  for (const auto& e : elements_) detail::couple(e.ends, pattern);
}

void BushingConnectorKind::add_load(const Instant& now, LoadSink& out) const {
  for (const auto& e : elements_) detail::add_load(e.ends, pair_load(e, strain(e, now.state)), out);
}

void BushingConnectorKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const auto& e : elements_) {
    const Strain s = strain(e, now.state);
    detail::PairLoad p = pair_load(e, s);
    differentiate(e, s, p);
    detail::add_jacobian(e.ends, p, out);
  }
}

std::string BushingConnectorKind::breaks_off(const State& before, const State& after) const {
  for (const auto& e : elements_)
    if (!e.rotational_stiffness.isZero(0) && jumps(strain(e, before).turn, strain(e, after).turn))
      return "a bushing is wound by more than half a turn, where its law ends";
  return {};
}

EnergyFlow BushingConnectorKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const auto& e : elements_) {
    const Strain s = strain(e, now.state);
    flow.stored += 0.5 * (s.shift.dot(e.stiffness.cwiseProduct(s.shift)) +
                          s.turn.dot(e.rotational_stiffness.cwiseProduct(s.turn)));
    flow.dissipated += s.shift_rate.dot(e.damping.cwiseProduct(s.shift_rate)) +
                       s.turn_rate.dot(e.rotational_damping.cwiseProduct(s.turn_rate));
  }
  return flow;
}

}  // namespace dynamics
