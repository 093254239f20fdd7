#pragma once
/// \file  Three numbers along x, y and z, for inner loops: everything is inlined, whatever the compiler would choose.
#include <Eigen/Core>

#include <cmath>

namespace dynamics::line {

#define FROUDE_INLINE [[gnu::always_inline]] inline

struct Triple {
  double x, y, z;

  FROUDE_INLINE static Triple of(const double* p) { return {p[0], p[1], p[2]}; }
  FROUDE_INLINE static Triple of(const Eigen::Vector3d& v) { return of(v.data()); }
  FROUDE_INLINE Triple operator+(const Triple& b) const { return {x + b.x, y + b.y, z + b.z}; }
  FROUDE_INLINE Triple operator-(const Triple& b) const { return {x - b.x, y - b.y, z - b.z}; }
  FROUDE_INLINE Triple operator-() const { return {-x, -y, -z}; }
  FROUDE_INLINE double dot(const Triple& b) const { return x * b.x + y * b.y + z * b.z; }
  FROUDE_INLINE double norm() const { return std::sqrt(dot(*this)); }
  FROUDE_INLINE void add_to(double* p) const {
    p[0] += x;
    p[1] += y;
    p[2] += z;
  }
  FROUDE_INLINE void put(double* p) const {
    p[0] = x;
    p[1] = y;
    p[2] = z;
  }
  Eigen::Vector3d vector() const { return {x, y, z}; }
};
FROUDE_INLINE Triple operator*(double s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }

FROUDE_INLINE Triple cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Column i of (3, …).
FROUDE_INLINE Triple column(const Eigen::Ref<const Eigen::Matrix3Xd>& of, int i) {
  return Triple::of(of.data() + of.outerStride() * i);
}

FROUDE_INLINE Triple times(const Eigen::Matrix3d& m, const Triple& b) {
  const double* const e = m.data();
  return {e[0] * b.x + e[3] * b.y + e[6] * b.z, e[1] * b.x + e[4] * b.y + e[7] * b.z,
          e[2] * b.x + e[5] * b.y + e[8] * b.z};
}

/// Adds s a bᵀ, s times the unit matrix, s b, and takes a b off.
FROUDE_INLINE void add_outer(double s, const Triple& a, const Triple& b, Eigen::Matrix3d& out) {
  const Triple l = s * a;
  double* const e = out.data();
  (b.x * l).add_to(e);
  (b.y * l).add_to(e + 3);
  (b.z * l).add_to(e + 6);
}
FROUDE_INLINE void add_unit(double s, Eigen::Matrix3d& out) {
  for (int i = 0; i < 9; i += 4) out.data()[i] += s;
}
FROUDE_INLINE void add(double s, const Eigen::Matrix3d& b, Eigen::Matrix3d& out) {
  for (int i = 0; i < 9; ++i) out.data()[i] += s * b.data()[i];
}
FROUDE_INLINE void add_product(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, Eigen::Matrix3d& out) {
  for (int c = 0; c < 9; c += 3) times(a, Triple::of(b.data() + c)).add_to(out.data() + c);
}
FROUDE_INLINE void take_product_off(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, Eigen::Matrix3d& out) {
  for (int c = 0; c < 9; c += 3) (-times(a, Triple::of(b.data() + c))).add_to(out.data() + c);
}

}  // namespace dynamics::line
