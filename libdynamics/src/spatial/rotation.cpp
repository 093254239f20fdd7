#include "dynamics/spatial/rotation.hpp"

#include <cmath>
#include <numbers>

namespace dynamics {
namespace {
// Below this angle the closed forms lose digits to cancellation and the next term of the series is below round-off.
constexpr double small_angle = 1e-3;
}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix<double, 6, 6> turned(const Eigen::Matrix<double, 6, 6>& m, const Eigen::Matrix3d& R) {
  Eigen::Matrix<double, 6, 6> out;
  for (const int i : {0, 3})
    for (const int j : {0, 3}) out.block<3, 3>(i, j) = R * m.block<3, 3>(i, j) * R.transpose();
  return out;
}

Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& phi) {
  const double angle = phi.norm(), half = angle / 2;
  const double s = angle < small_angle ? 0.5 - angle * angle / 48 : std::sin(half) / angle;
  return Eigen::Quaterniond(std::cos(half), s * phi.x(), s * phi.y(), s * phi.z()).normalized();
}

Eigen::Vector3d rotation_log(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1;  // q and −q are the same rotation; take the shorter turn
  const double s = q.vec().norm();
  // atan2 keeps full accuracy at both ends, where asin or acos alone would not.
  const double per_sine = s < small_angle ? 2 / std::abs(q.w()) * (1 - s * s / (3 * q.w() * q.w()))
                                          : 2 * std::atan2(s, std::abs(q.w())) / s;
  return sign * per_sine * q.vec();
}

Eigen::Quaterniond attitude_of(const Eigen::Vector3d& roll_pitch_yaw) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return AngleAxisd(roll_pitch_yaw.z(), Vector3d::UnitZ()) * AngleAxisd(roll_pitch_yaw.y(), Vector3d::UnitY()) *
         AngleAxisd(roll_pitch_yaw.x(), Vector3d::UnitX());
}

double nearest_turn(double angle, double near) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((near - angle) / turn);
}

// (D133)
Eigen::Vector3d roll_pitch_yaw(const Eigen::Quaterniond& q, const Eigen::Vector3d& near) {
  constexpr double pi = std::numbers::pi, locked = 1e-7;  // rounding in q is 1e-9 in angles there
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const double cosine = std::hypot(R(2, 1), R(2, 2));
  Eigen::Vector3d angles(std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), cosine), std::atan2(R(1, 0), R(0, 0)));
  if (cosine < locked) {
    const double up = R(2, 0) > 0 ? -1 : 1;
    const double gone = std::remainder(std::atan2(up * R(0, 1), R(1, 1)) - (near.x() - up * near.z()), 2 * pi);
    angles.x() = near.x() + gone / 2;
    angles.z() = near.z() - up * gone / 2;
  }
  const auto turned = [&](const Eigen::Vector3d& a) {
    return Eigen::Vector3d(nearest_turn(a.x(), near.x()), nearest_turn(a.y(), near.y()), nearest_turn(a.z(), near.z()));
  };
  const Eigen::Vector3d same = turned(angles), other = turned({angles.x() + pi, pi - angles.y(), angles.z() + pi});
  return (same - near).squaredNorm() <= (other - near).squaredNorm() ? same : other;
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& phi) {
  const double a2 = phi.squaredNorm(), a = std::sqrt(a2);
  const Eigen::Matrix3d X = cross_matrix(phi);
  const double c1 = a < small_angle ? 0.5 - a2 / 24 : (1 - std::cos(a)) / a2;
  const double c2 = a < small_angle ? 1.0 / 6 - a2 / 120 : (a - std::sin(a)) / (a2 * a);
  return Eigen::Matrix3d::Identity() + c1 * X + c2 * X * X;
}

Eigen::Matrix3d left_jacobian_inverse(const Eigen::Vector3d& phi) {
  const double a2 = phi.squaredNorm(), a = std::sqrt(a2);
  const Eigen::Matrix3d X = cross_matrix(phi);
  const double c2 = a < small_angle ? 1.0 / 12 + a2 / 720 : (1 - a / 2 / std::tan(a / 2)) / a2;
  return Eigen::Matrix3d::Identity() - 0.5 * X + c2 * X * X;
}

Eigen::Matrix3d left_jacobian_inverse_transpose_derivative(const Eigen::Vector3d& phi, const Eigen::Vector3d& m) {
  // J⁻ᵀ m = m + ½ φ×m + c(|φ|) φ×(φ×m), c as in left_jacobian_inverse.
  const double a2 = phi.squaredNorm(), a = std::sqrt(a2);
  const bool small = a < 1e-2;  // the closed form of c′/a loses four powers of a
  const double cot = small ? 0 : 1 / std::tan(a / 2), sine = std::sin(a / 2);
  const double c = small ? 1.0 / 12 + a2 / 720 + a2 * a2 / 30240 : (1 - a / 2 * cot) / a2;
  const double dc_over_a = small ? 1.0 / 360 + a2 / 7560 : ((a / (4 * sine * sine) - cot / 2) / a2 - 2 * c / a) / a;
  const Eigen::Vector3d once = phi.cross(m), twice = phi.cross(once);
  return -0.5 * cross_matrix(m) - c * (cross_matrix(once) + cross_matrix(phi) * cross_matrix(m)) +
         dc_over_a * twice * phi.transpose();
}

}  // namespace dynamics
