#pragma once
/// \file  Vectors that know the axes their components are along, and rotations that know from where to where.
/// Adding a body-axes vector to a global one does not compile. Kernels use the plain Eigen members.
#include <Eigen/Core>

namespace dynamics {

struct World;     ///< global axes: x forward, y port, z up, origin in the still waterplane
struct BodyAxes;  ///< axes fixed to one body, parallel to World at rest

template <class Frame>
struct Vec3 {
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero();
};

template <class F>
Vec3<F> operator+(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.xyz + b.xyz};
}
template <class F>
Vec3<F> operator-(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.xyz - b.xyz};
}

template <class To, class From>
struct Rotation {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Vec3<To> operator*(const Vec3<From>& v) const { return {matrix * v.xyz}; }
};

}  // namespace dynamics
