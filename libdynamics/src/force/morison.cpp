#include "dynamics/force/morison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "dynamics/spatial/rotation.hpp"
#include "foreseen_flow.hpp"

namespace dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using hydro::waves::Kinematics;
using hydro::waves::WaveField;
using Matrix3x6 = Eigen::Matrix<double, 3, 6>;

/// Coefficients of a member per length, with that of drag along its axis, ½ρC_T πD.
struct PerLength : MorisonPerLength {
  double tangential;

  PerLength(const MorisonMember& m, double density)
      : MorisonPerLength(m.line.diameter, density, m.cd, m.ca),
        tangential(0.5 * density * m.cd_tangential * std::numbers::pi * m.line.diameter) {}
};

/// Flow past one point of a member, global axes.
struct Flow {
  Vector3d arm, axis, omega;
  Vector3d water, water_acceleration;
  Vector3d own, turning;      // w; ω × (ω × r), the part of ẇ that is not on the left
  Vector3d relative, across;  // u − w and its part across the axis
};

Flow flow_past(const PlacedMember& at, const Vector3d& arm, const Kinematics& water) {
  Flow f;
  f.arm = arm;
  f.axis = at.axis;
  f.omega = at.omega;
  f.water = water.velocity;
  f.water_acceleration = water.material_acceleration();
  const Vector3d spin = at.omega.cross(arm);
  f.own = at.velocity + spin;
  f.turning = at.omega.cross(spin);
  f.relative = f.water - f.own;
  f.across = f.relative - f.axis * f.axis.dot(f.relative);
  return f;
}

Vector3d drag(const PerLength& c, const Flow& f) {
  const double along = f.axis.dot(f.relative);
  return c.drag(f.across, f.across.norm()) + c.tangential * std::abs(along) * along * f.axis;
}

/// Without the part of the added mass that is on the left.
Vector3d inertia(const PerLength& c, const Flow& f) {
  const Vector3d y = c.inertia(f.water_acceleration, f.turning);
  return y - f.axis * f.axis.dot(y);
}

/// How a point of the member and what it meets change with displacement and velocity of the body, (3, 6) each.
struct FlowDerivatives {
  Matrix3x6 arm_by_q, axis_by_q;
  Matrix3x6 relative_by_q, relative_by_v;
  Matrix3x6 water_acceleration_by_q, turning_by_q, turning_by_v;
};

/// Derivatives of the water's velocity and of its particles' acceleration by place.
struct WaterGradients {
  Matrix3d velocity, acceleration;
};

/// By the chain rule (D45).
FlowDerivatives differentiate(const Flow& f, const WetPiece& piece, const WaterGradients& water) {
  FlowDerivatives d;
  const Matrix3d W = cross_matrix(f.omega), S = cross_matrix(f.arm);
  d.arm_by_q << Matrix3d::Zero(), -S;
  d.arm_by_q += f.axis * piece.place_by;  // the wet middle moves along the member
  Matrix3x6 place_by_q = d.arm_by_q;
  place_by_q.leftCols<3>() += Matrix3d::Identity();
  d.axis_by_q << Matrix3d::Zero(), -cross_matrix(f.axis);
  d.relative_by_q = water.velocity * place_by_q - W * d.arm_by_q;
  d.relative_by_v << -Matrix3d::Identity(), S;
  d.water_acceleration_by_q = water.acceleration * place_by_q;
  d.turning_by_q = W * W * d.arm_by_q;
  d.turning_by_v << Matrix3d::Zero(), -cross_matrix(f.omega.cross(f.arm)) - W * S;
  return d;
}

struct ForceDerivatives {
  Matrix3x6 by_q, by_v;
};

/// δ(P y) of a vector that itself changes by δy, as the axis turns.
Matrix3x6 across_by(const Flow& f, const Vector3d& y, const Matrix3x6& y_by, const Matrix3x6& axis_by) {
  return y_by - f.axis * (f.axis.transpose() * y_by) - f.axis.dot(y) * axis_by - f.axis * (y.transpose() * axis_by);
}

ForceDerivatives drag_derivatives(const PerLength& c, const Flow& f, const FlowDerivatives& d) {
  const double speed = f.across.norm(), along = f.axis.dot(f.relative);
  Matrix3d by_across = Matrix3d::Zero();  // |w| w is flat at w = 0
  if (speed > 0) by_across = c.normal * (speed * Matrix3d::Identity() + f.across * f.across.transpose() / speed);
  const auto total = [&](const Matrix3x6& relative_by, const Matrix3x6& axis_by) {
    const WetPiece::Row along_by = f.axis.transpose() * relative_by + f.relative.transpose() * axis_by;
    return Matrix3x6(by_across * across_by(f, f.relative, relative_by, axis_by) +
                     c.tangential * std::abs(along) * (2 * f.axis * along_by + along * axis_by));
  };
  return {total(d.relative_by_q, d.axis_by_q), total(d.relative_by_v, Matrix3x6::Zero())};
}

ForceDerivatives inertia_derivatives(const PerLength& c, const Flow& f, const FlowDerivatives& d) {
  const Vector3d y = c.inertia(f.water_acceleration, f.turning);
  const Matrix3x6 y_by_q = (c.displaced + c.added) * d.water_acceleration_by_q - c.added * d.turning_by_q;
  return {across_by(f, y, y_by_q, d.axis_by_q), across_by(f, y, -c.added * d.turning_by_v, Matrix3x6::Zero())};
}

/// The wet pieces of a member, the water at each, and how that changes with place.
struct MemberFlow {
  PlacedMember at;
  std::vector<WetPiece> pieces;
  std::span<const Kinematics> water;
  std::vector<Kinematics> asked, moved;
  std::vector<WaterGradients> gradients;
  std::vector<Vector3d> points;  // that the water is asked for
};

/// A kind of force is shared between threads and has no room of its own: each thread keeps that of one member, so that
/// a step asks for no memory.
MemberFlow& kept_flow() {
  thread_local MemberFlow flow;
  return flow;
}

void find_water(const WaveField& field, double t, const Vector3d& shift, MemberFlow& flow,
                std::vector<Kinematics>& out) {
  flow.points.clear();
  for (const WetPiece& p : flow.pieces) flow.points.push_back(flow.at.centre + p.arm + shift);
  out.resize(flow.points.size());
  field.at(t, flow.points, out);
}

/// Where the member is, in the flow that was foreseen.
void take_foreseen(const ForeseenFlow::Flow& foreseen, MemberFlow& out) {
  out.at = foreseen.at;
  out.pieces.clear();
  for (const ForeseenFlow::Point& p : foreseen.points) out.pieces.push_back({p.length, out.at.arm(p.share)});
  out.water = foreseen.water;
}

/// At each piece, one-sided over a millionth of the diameter: error of about (κD) 1e-6 relative. Kinematics::gradient
/// will not do, which is that of the flow under the stretched profile, not of what stretching makes of it.
void find_gradients(const MorisonMember& m, const WaveField& field, double t, MemberFlow& flow) {
  const double e = 1e-6 * m.line.diameter;
  flow.gradients.resize(flow.pieces.size());
  for (int axis = 0; axis < 3; ++axis) {
    find_water(field, t, e * Vector3d::Unit(axis), flow, flow.moved);
    for (std::size_t i = 0; i < flow.gradients.size(); ++i) {
      const Kinematics &there = flow.moved[i], &here = flow.water[i];
      flow.gradients[i].velocity.col(axis) = (there.velocity - here.velocity) / e;
      flow.gradients[i].acceleration.col(axis) = (there.material_acceleration() - here.material_acceleration()) / e;
    }
  }
}

/// Members one after the other, each with its pieces and the water there.
class Flows {
 public:
  Flows(const std::vector<MorisonMember>& members, const WaveField& field, const Instant& now)
      : members_(members), field_(field), state_(now.state), foreseen_(static_cast<ForeseenFlow*>(now.memory)) {
    if (foreseen_ != nullptr) foreseen_->look(state_);
  }

  /// Leaves a member out.
  void skip() {
    if (foreseen_ != nullptr && members_[member_].line.immersion == Immersion::whole) ++foreseen_members_;
    ++member_;
  }

  /// Of the member after the last one, with gradients where they are asked for. It stands until the next.
  MemberFlow& next(bool derivatives) {
    const MorisonMember& m = members_[member_++];
    MemberFlow& out = kept_flow();
    if (foreseen_ != nullptr && m.line.immersion == Immersion::whole) {
      take_foreseen(foreseen_->of(foreseen_members_++), out);
      if (derivatives) out.gradients.assign(out.pieces.size(), {Matrix3d::Zero(), Matrix3d::Zero()});
      return out;
    }
    out.at = placed(m.line, state_);
    find_wet_pieces(m.line, out.at, field_, state_.time, derivatives, out.pieces);
    find_water(field_, state_.time, Vector3d::Zero(), out, out.asked);
    out.water = out.asked;
    if (derivatives) find_gradients(m, field_, state_.time, out);
    return out;
  }

 private:
  const std::vector<MorisonMember>& members_;
  const WaveField& field_;
  const State& state_;
  ForeseenFlow* foreseen_;
  std::size_t member_ = 0, foreseen_members_ = 0;
};

/// About the centre of gravity, without the part of the added mass that is on the left.
Vector6 load_of(const PerLength& c, const MemberFlow& flow) {
  Vector6 load = Vector6::Zero();
  for (std::size_t i = 0; i < flow.pieces.size(); ++i) {
    const Flow f = flow_past(flow.at, flow.pieces[i].arm, flow.water[i]);
    const Vector3d force = flow.pieces[i].length * (drag(c, f) + inertia(c, f));
    load.head<3>() += force;
    load.tail<3>() += f.arm.cross(force);
  }
  return load;
}

// ∫c VᵀPV over the wet parts, V = (1, −r×) the velocity of a point by that of the body, P = 1 − ttᵀ: sums of c, cr and
// crrᵀ, and Vᵀt = (t, r×t), which is the same at all points of a line along t.
Matrix6 added_mass(double per_length, const PlacedMember& at, const std::vector<WetPiece>& pieces) {
  double whole = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (const WetPiece& piece : pieces) {
    const Vector3d moment = per_length * piece.length * piece.arm;
    whole += per_length * piece.length;
    first += moment;
    second += moment * piece.arm.transpose();
  }
  Vector6 along;
  along << at.axis, at.from.cross(at.axis);
  const Matrix3d S = cross_matrix(first);
  Matrix6 mass;
  mass << whole * Matrix3d::Identity(), -S, S, second.trace() * Matrix3d::Identity() - second;
  mass -= whole * along * along.transpose();
  return mass;
}

/// A member on a body whose axes are the global ones.
PlacedMember in_body_axes(const SlenderMember& line) {
  PlacedMember out{};
  out.from = line.from;
  out.along = line.to - line.from;
  out.length = out.along.norm();
  out.axis = out.along / out.length;
  return out;
}

}  // namespace

// What is always wet carries the same water along with the body wherever that is.
MorisonKind::MorisonKind(std::vector<MorisonMember> members, std::shared_ptr<const WaveField> water, double foresight)
    : members_(std::move(members)), water_(std::move(water)), foresight_(foresight) {
  for (const MorisonMember& m : members_) {
    if (m.ca == 0 || m.line.immersion != Immersion::whole) continue;
    const auto known =
        std::find_if(always_.begin(), always_.end(), [&](const auto& b) { return b.body == m.line.body; });
    BodyMass& of_body = known != always_.end() ? *known : always_.emplace_back(BodyMass{m.line.body, Matrix6::Zero()});
    const PlacedMember at = in_body_axes(m.line);
    of_body.added +=
        added_mass(PerLength(m, water_->water().density).added, at, wet_pieces(m.line, at, *water_, 0, false));
  }
}

MorisonPerLength::MorisonPerLength(double diameter, double density, double cd, double ca)
    : normal(0.5 * density * cd * diameter),
      displaced(density * std::numbers::pi / 4 * diameter * diameter),
      added(displaced * ca) {}

std::string MorisonKind::method() const {
  std::size_t pieces = 0;
  for (const auto& m : members_) pieces += static_cast<std::size_t>(m.line.pieces);
  const char* water = foresight_ > 0 ? "in the water where a step foresees it" : "in the water where it is";
  return fmt::format("drag and inertia of the member {}, added mass on the left, {} pieces", water, pieces);
}

std::unique_ptr<Memory> MorisonKind::make_memory(const State&) const {
  if (foresight_ == 0) return nullptr;
  std::vector<SlenderMember> always_wet;
  for (const MorisonMember& m : members_)
    if (m.line.immersion == Immersion::whole) always_wet.push_back(m.line);
  if (always_wet.empty()) return nullptr;
  return std::make_unique<ForeseenFlow>(std::move(always_wet), *water_, foresight_);
}

[[gnu::flatten]] void MorisonKind::add_load(const Instant& now, LoadSink& out) const {
  Flows flows(members_, *water_, now);
  for (const MorisonMember& m : members_) {
    const PerLength c(m, water_->water().density);
    out.add(m.line.body, load_of(c, flows.next(false)));
  }
}

Vector6 MorisonKind::whole_load(std::size_t member, const Reading& now) const {
  const MorisonMember& m = members_[member];
  const PerLength c(m, water_->water().density);
  Flows flows(members_, *water_, {now.state, now.memory});
  for (std::size_t k = 0; k < member; ++k) flows.skip();
  const MemberFlow& flow = flows.next(false);
  const Vector6 a = now.acceleration.segment<6>(6 * m.line.body);
  return load_of(c, flow) - added_mass(c.added, flow.at, flow.pieces) * a;
}

std::vector<Signal> MorisonKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!members_[k].told) continue;
    const auto load = [this, k](const Reading& now) { return whole_load(k, now); };
    for (Signal& s : member_load_signals(*members_[k].told, effect(), members_[k].line.body, load))
      out.push_back(std::move(s));
  }
  return out;
}

void MorisonKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  Flows flows(members_, *water_, now);
  for (const MorisonMember& m : members_) {
    const PerLength c(m, water_->water().density);
    const MemberFlow& flow = flows.next(true);
    Matrix6 by_q = Matrix6::Zero(), by_v = Matrix6::Zero();
    for (std::size_t i = 0; i < flow.pieces.size(); ++i) {
      const WetPiece& piece = flow.pieces[i];
      const Flow f = flow_past(flow.at, piece.arm, flow.water[i]);
      const FlowDerivatives d = differentiate(f, piece, flow.gradients[i]);
      const ForceDerivatives D = drag_derivatives(c, f, d), I = inertia_derivatives(c, f, d);
      const Vector3d per_length = drag(c, f) + inertia(c, f);
      const Matrix3x6 force_by_q = piece.length * (D.by_q + I.by_q) + per_length * piece.length_by;
      const Matrix3x6 force_by_v = piece.length * (D.by_v + I.by_v);
      const Matrix3d S = cross_matrix(f.arm);
      by_q.topRows<3>() += force_by_q;
      by_q.bottomRows<3>() += S * force_by_q - piece.length * cross_matrix(per_length) * d.arm_by_q;
      by_v.topRows<3>() += force_by_v;
      by_v.bottomRows<3>() += S * force_by_v;
    }
    out.add(m.line.body, m.line.body, by_q, by_v);
  }
}

void MorisonKind::add_mass(const State& state, MassSink& out) const {
  for (const BodyMass& m : always_)
    out.add_along(state.pose[static_cast<std::size_t>(m.body)].attitude.toRotationMatrix(), m.body, m.added);
  for (const MorisonMember& m : members_) {
    if (m.ca == 0 || m.line.immersion == Immersion::whole) continue;
    const PlacedMember at = placed(m.line, state);
    auto& pieces = kept_flow().pieces;
    find_wet_pieces(m.line, at, *water_, state.time, false, pieces);
    out.add(m.line.body, added_mass(PerLength(m, water_->water().density).added, at, pieces));
  }
}

// Of F·w the part F·u of the drag is the water's, F·(u − w) is lost; inertia loads take nothing for good (D46).
EnergyFlow MorisonKind::energy(const Instant& now) const {
  EnergyFlow flow;
  Flows flows(members_, *water_, now);
  for (const MorisonMember& m : members_) {
    const PerLength c(m, water_->water().density);
    const MemberFlow& member = flows.next(false);
    for (std::size_t i = 0; i < member.pieces.size(); ++i) {
      const Flow f = flow_past(member.at, member.pieces[i].arm, member.water[i]);
      const Vector3d resistance = drag(c, f);
      flow.supplied += member.pieces[i].length * (resistance.dot(f.water) + inertia(c, f).dot(f.own));
      flow.dissipated += member.pieces[i].length * resistance.dot(f.relative);
    }
  }
  flow.supplied += power_of_changing_mass(*this, now.state);
  return flow;
}

}  // namespace dynamics
