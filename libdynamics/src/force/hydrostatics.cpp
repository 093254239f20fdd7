#include "dynamics/force/hydrostatics.hpp"

#include <fmt/format.h>

#include <cmath>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// How a body leans: the vertical seen from it, and the rotation vector along the water that this is, body axes.
struct Tilt {
  Vector3d up;
  Vector2d sine;  ///< that vector is K times this: (u_y, −u_x)
  TiltScale K;

  Vector2d vector() const { return K.value * sine; }
  /// ∂vector/∂up.
  Matrix23 slope() const {
    Matrix23 out = Matrix23::Zero();
    out(0, 1) = K.value;
    out(1, 0) = -K.value;
    out.col(2) += K.slope * sine;
    return out;
  }
};

Tilt tilt_of(const Pose& pose) {
  const Vector3d up = pose.attitude.conjugate() * Vector3d::UnitZ();
  return {up, {up.y(), -up.x()}, tilt_scale(up.z())};
}

/// Rise of the centre of gravity and tilt, and the slopes of the potential over them.
struct Displaced {
  Tilt tilt;
  Vector3d s, slope;

  /// ∂s/∂up.
  Matrix3d by_up() const {
    Matrix3d out = Matrix3d::Zero();
    out.bottomRows<2>() = tilt.slope();
    return out;
  }
  /// ∂V/∂up: its moment is ẑ × (R of this).
  Vector3d by_up_of_potential() const { return by_up().transpose() * slope; }
};

Displaced displaced(const Hydrostatics& e, double rest_height, const Pose& pose) {
  const Tilt tilt = tilt_of(pose);
  Vector3d s;
  s << pose.centre.z() - rest_height, tilt.vector();
  Vector3d slope = e.stiffness * s;
  slope.tail<2>() -= e.moment;
  return {tilt, s, slope};
}

/// ∂(∂V/∂up)/∂up at constant slopes of the potential.
Matrix3d curvature(const Displaced& d) {
  const Vector2d g = d.slope.tail<2>();
  const Vector3d along(-g.y(), g.x(), 0);
  Matrix3d out = Matrix3d::Zero();
  out.col(2) += d.tilt.K.slope * along;
  out.row(2) += d.tilt.K.slope * along.transpose();
  out(2, 2) += d.tilt.sine.dot(g) * d.tilt.K.curvature;
  return out;
}

}  // namespace

// With x = 1 − c, K = Σ 2ⁿ (n!)² xⁿ/(2n + 1)!, from arcsin's series; (1 − c²) K′ = c K − 1 elsewhere.
TiltScale tilt_scale(double cosine) {
  const double x = 1 - cosine;
  if (x < 0.1) {
    constexpr int terms = 16;  // each a twentieth of the one before: to rounding
    TiltScale out{0, 0, 0};
    double c = 1, power = 1, before = 0, twice = 0;  // xⁿ, xⁿ⁻¹, xⁿ⁻²
    for (int n = 0; n < terms; ++n) {
      out.value += c * power;
      out.slope -= n * c * before;
      out.curvature += n * (n - 1) * c * twice;
      c *= (n + 1.0) / (2 * n + 3);
      twice = before, before = power, power *= x;
    }
    return out;
  }
  const double sine2 = x * (1 + cosine), K = std::acos(cosine) / std::sqrt(sine2), slope = (cosine * K - 1) / sine2;
  return {K, slope, (K + 3 * cosine * slope) / sine2};
}

HydrostaticsKind::HydrostaticsKind(const std::vector<RigidBody>& bodies, std::vector<Hydrostatics> elements)
    : elements_(std::move(elements)) {
  for (const Hydrostatics& e : elements_)
    rest_height_.push_back(bodies[static_cast<std::size_t>(e.body)].rest_centre().z());
}

void HydrostaticsKind::add_load(const Instant& now, LoadSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Hydrostatics& e = elements_[i];
    const Pose& pose = now.state.pose[static_cast<std::size_t>(e.body)];
    const Displaced d = displaced(e, rest_height_[i], pose);
    Vector6 load = Vector6::Zero();
    load.z() = e.lift - d.slope(0);
    load.tail<3>() = Vector3d::UnitZ().cross(pose.attitude * d.by_up_of_potential());
    out.add(e.body, load);
  }
}

// A small turn θ changes the vertical seen from the body by Rᵀ(ẑ × θ), and turns what the potential gives with it.
void HydrostaticsKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  const Matrix3d up = cross_matrix(Vector3d::UnitZ());
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Hydrostatics& e = elements_[i];
    const Pose& pose = now.state.pose[static_cast<std::size_t>(e.body)];
    const Displaced d = displaced(e, rest_height_[i], pose);
    const Matrix3d R = pose.attitude.toRotationMatrix(), up_by_turn = R.transpose() * up, by_up = d.by_up();
    const Vector3d a = d.by_up_of_potential();
    Matrix6 K = Matrix6::Zero();
    K(2, 2) = -e.stiffness(0, 0);
    K.block<1, 3>(2, 3) = -e.stiffness.row(0) * by_up * up_by_turn;
    K.block<3, 1>(3, 2) = up * R * by_up.transpose() * e.stiffness.col(0);
    K.bottomRightCorner<3, 3>() =
        up * R * (by_up.transpose() * e.stiffness * by_up + curvature(d)) * up_by_turn - up * cross_matrix(R * a);
    out.add(e.body, e.body, K, Matrix6::Zero());
  }
}

EnergyFlow HydrostaticsKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Hydrostatics& e = elements_[i];
    const Pose& pose = now.state.pose[static_cast<std::size_t>(e.body)];
    const Displaced d = displaced(e, rest_height_[i], pose);
    flow.stored +=
        0.5 * d.s.dot(e.stiffness * d.s) - e.lift * (pose.centre.z() - rest_height_[i]) - e.moment.dot(d.s.tail<2>());
  }
  return flow;
}

std::string HydrostaticsKind::breaks_off(const State& before, const State& after) const {
  for (const Hydrostatics& e : elements_) {
    if (e.stiffness.bottomRightCorner<2, 2>().isZero(0) && e.moment.isZero(0)) continue;
    const auto leans = [&](const State& state) {
      Vector3d out = Vector3d::Zero();
      out.head<2>() = tilt_of(state.pose[static_cast<std::size_t>(e.body)]).vector();
      return out;
    };
    if (jumps(leans(before), leans(after)))
      return "a body of \"hydrostatics\" leans by more than half a turn from rest, where that law ends";
  }
  return {};
}

}  // namespace dynamics
