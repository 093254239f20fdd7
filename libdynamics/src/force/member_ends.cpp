#include "dynamics/force/member_ends.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

using Eigen::Vector3d;
using hydro::waves::Kinematics;
using hydro::waves::WaveField;
using Row6 = Eigen::Matrix<double, 1, 6>;
using Matrix3x6 = Eigen::Matrix<double, 3, 6>;

/// Where an end is and what it meets, global axes.
struct EndFlow {
  Vector3d arm, inward, omega;
  Vector3d own, turning;  // w; ω × (ω × r), the part of ẇ that is not on the left
  Kinematics water;

  double along() const { return inward.dot(water.velocity - own); }
};

Vector3d place_of(int body, const MemberEnd& end, const State& state) {
  const Pose& pose = state.pose[static_cast<std::size_t>(body)];
  return pose.centre + pose.attitude * end.arm;
}

EndFlow flow_at(int body, const MemberEnd& end, const WaveField& water, const State& state) {
  const Eigen::Quaterniond& attitude = state.pose[static_cast<std::size_t>(body)].attitude;
  const auto twist = state.twist(body);
  EndFlow f;
  f.arm = attitude * end.arm;
  f.inward = attitude * end.inward;
  f.omega = twist.tail<3>();
  const Vector3d spin = f.omega.cross(f.arm);
  f.own = twist.head<3>() + spin;
  f.turning = f.omega.cross(spin);
  f.water = water.at(state.time, place_of(body, end, state));
  return f;
}

double drag(const MemberEnd& end, const EndFlow& f) { return end.drag * std::abs(f.along()) * f.along(); }

/// Without the part of the added mass that is on the left.
double pressure_and_inertia(const MemberEnd& end, const EndFlow& f) {
  return end.pressed * f.water.dynamic_pressure + end.added * f.inward.dot(f.water.material_acceleration() - f.turning);
}

Vector6 load_along(const EndFlow& f, double force) {
  Vector6 load;
  load << force * f.inward, force * f.arm.cross(f.inward);
  return load;
}

Vector6 load_on(const MemberEnd& end, const EndFlow& f) {
  return load_along(f, drag(end, f) + pressure_and_inertia(end, f));
}

/// Derivatives by place, one-sided over a micrometre: error of about κ 1e-6 m relative. Kinematics::gradient will not
/// do, which is that of the flow under the stretched profile, not of what stretching makes of it.
struct GradientsAtEnd {
  Eigen::RowVector3d pressure;
  Eigen::Matrix3d velocity, acceleration;
};

GradientsAtEnd gradients_at(const WaveField& water, double t, const Vector3d& place, const Kinematics& here) {
  constexpr double e = 1e-6;
  GradientsAtEnd g;
  for (int axis = 0; axis < 3; ++axis) {
    const Kinematics there = water.at(t, place + e * Vector3d::Unit(axis));
    g.pressure[axis] = (there.dynamic_pressure - here.dynamic_pressure) / e;
    g.velocity.col(axis) = (there.velocity - here.velocity) / e;
    g.acceleration.col(axis) = (there.material_acceleration() - here.material_acceleration()) / e;
  }
  return g;
}

/// How an end's place, its direction and its velocity change with displacement and velocity of the body: δr = δθ × r,
/// δt = δθ × t, δw = δv + δω × r + ω × δr.
struct EndDerivatives {
  Matrix3x6 arm_by_q, inward_by_q, own_by_q, own_by_v, turning_by_q, turning_by_v;
};

EndDerivatives differentiate(const EndFlow& f) {
  EndDerivatives d;
  const Eigen::Matrix3d W = cross_matrix(f.omega), S = cross_matrix(f.arm), none = Eigen::Matrix3d::Zero();
  d.arm_by_q << none, -S;
  d.inward_by_q << none, -cross_matrix(f.inward);
  d.own_by_q = W * d.arm_by_q;
  d.own_by_v << Eigen::Matrix3d::Identity(), -S;
  d.turning_by_q = W * W * d.arm_by_q;
  d.turning_by_v << none, -cross_matrix(f.omega.cross(f.arm)) - W * S;
  return d;
}

/// Of the force along t, by the chain rule.
struct ForceAlongBy {
  Row6 q, v;
};

ForceAlongBy force_by(const MemberEnd& end, const EndFlow& f, const EndDerivatives& d, const GradientsAtEnd& g) {
  Matrix3x6 place_by_q = d.arm_by_q;
  place_by_q.leftCols<3>() += Eigen::Matrix3d::Identity();
  const double slope = 2 * end.drag * std::abs(f.along());
  const Vector3d relative = f.water.velocity - f.own, mass_flow = f.water.material_acceleration() - f.turning;
  const Row6 along_by_q =
      f.inward.transpose() * (g.velocity * place_by_q - d.own_by_q) + relative.transpose() * d.inward_by_q;
  const Row6 flow_by_q =
      f.inward.transpose() * (g.acceleration * place_by_q - d.turning_by_q) + mass_flow.transpose() * d.inward_by_q;
  return {end.pressed * g.pressure * place_by_q + end.added * flow_by_q + slope * along_by_q,
          -end.added * f.inward.transpose() * d.turning_by_v - slope * f.inward.transpose() * d.own_by_v};
}

/// m_a VᵀttᵀV, V = (1, −r×) the velocity of the end by that of the body.
Matrix6 added_mass_of(const MemberEnd& end, const Eigen::Quaterniond& attitude) {
  const Vector3d t = attitude * end.inward;
  Vector6 along;
  along << t, (attitude * end.arm).cross(t);
  return end.added * along * along.transpose();
}

}  // namespace

double end_added_mass(double ca, double diameter, double density) {
  return ca * density * std::numbers::pi / 12 * diameter * diameter * diameter;
}

std::size_t MemberEndsKind::elements() const {
  std::size_t count = 0;
  for (const MemberEnds& m : members_) count += m.ends.size();
  return count;
}

void MemberEndsKind::add_load(const Instant& now, LoadSink& out) const {
  for (const MemberEnds& m : members_)
    for (const MemberEnd& end : m.ends) out.add(m.body, load_on(end, flow_at(m.body, end, *water_, now.state)));
}

void MemberEndsKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const MemberEnds& m : members_)
    for (const MemberEnd& end : m.ends) {
      const EndFlow f = flow_at(m.body, end, *water_, now.state);
      const EndDerivatives d = differentiate(f);
      const GradientsAtEnd g = gradients_at(*water_, now.state.time, place_of(m.body, end, now.state), f.water);
      const ForceAlongBy by = force_by(end, f, d, g);
      const double force = drag(end, f) + pressure_and_inertia(end, f);
      const Matrix3x6 force_by_q = f.inward * by.q + force * d.inward_by_q, force_by_v = f.inward * by.v;
      const Eigen::Matrix3d S = cross_matrix(f.arm);
      Matrix6 by_q, by_v;
      by_q << force_by_q, S * force_by_q - force * cross_matrix(f.inward) * d.arm_by_q;
      by_v << force_by_v, S * force_by_v;
      out.add(m.body, m.body, by_q, by_v);
    }
}

void MemberEndsKind::add_mass(const State& state, MassSink& out) const {
  for (const MemberEnds& m : members_)
    for (const MemberEnd& end : m.ends)
      if (end.added > 0) out.add(m.body, added_mass_of(end, state.pose[static_cast<std::size_t>(m.body)].attitude));
}

// As Morison's (D46): of the drag F·u is the water's and F·(u − w) is lost; the rest is supplied.
EnergyFlow MemberEndsKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const MemberEnds& m : members_)
    for (const MemberEnd& end : m.ends) {
      const EndFlow f = flow_at(m.body, end, *water_, now.state);
      const double resistance = drag(end, f);
      flow.supplied += resistance * f.inward.dot(f.water.velocity) + pressure_and_inertia(end, f) * f.inward.dot(f.own);
      flow.dissipated += resistance * f.along();
    }
  flow.supplied += power_of_changing_mass(*this, now.state);
  return flow;
}

Vector6 MemberEndsKind::whole_load(std::size_t member, const Reading& now) const {
  const MemberEnds& m = members_[member];
  const Vector6 a = now.acceleration.segment<6>(6 * m.body);
  Vector6 load = Vector6::Zero();
  for (const MemberEnd& end : m.ends)
    load += load_on(end, flow_at(m.body, end, *water_, now.state)) -
            added_mass_of(end, now.state.pose[static_cast<std::size_t>(m.body)].attitude) * a;
  return load;
}

std::vector<Signal> MemberEndsKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!members_[k].told) continue;
    const auto load = [this, k](const Reading& now) { return whole_load(k, now); };
    for (Signal& s : member_load_signals(*members_[k].told, effect(), members_[k].body, load))
      out.push_back(std::move(s));
  }
  return out;
}

std::string MemberEndsKind::breaks_off(const State&, const State& after) const {
  for (const MemberEnds& m : members_)
    for (const MemberEnd& end : m.ends) {
      const Vector3d at = place_of(m.body, end, after);
      if (at.z() > water_->elevation(after.time, at.x(), at.y()))
        return fmt::format("an end of {} comes out of the water, where its loads have no law", m.name);
    }
  return {};
}

}  // namespace dynamics
