#pragma once
/// \file  Right-hand sides of the laws of motion that shooting knows; (F36), (F38), docs/theory/fit.md.
#include <array>
#include <cmath>

#include "dynamics/force/damper.hpp"

namespace fit {

/// y = (x, ẋ); θ = (ω₀, b₁, b₂, b₃, c, x₀).
template <bool sine>
struct Oscillator {
  static constexpr int states = 2, parameters = 6, channels = 1, turning = 1;
  template <class T>
  T restoring(const std::array<T, 2>& y, const std::array<T, 6>& p) const {
    using std::sin;
    const T x = y[0] - p[5];
    if constexpr (sine) return p[0] * p[0] * sin(x);
    return p[0] * p[0] * x;
  }
  template <class T>
  std::array<T, 2> rate(const std::array<T, 2>& y, const std::array<T, 6>& p, double direction) const {
    const T& v = y[1];
    const T speed = direction * v;  // |ẋ|, since `direction` is the sign of ẋ
    return {v, -dynamics::damper_force(p[1], p[2], v, speed) - p[3] * v * v * v - direction * p[4] - restoring(y, p)};
  }
  template <class T>
  bool sticks(const std::array<T, 2>& y, const std::array<T, 6>& p) const {
    return std::abs(value_of(restoring(y, p))) <= value_of(p[4]);
  }
};

/// y = (x, ẋ, ζ, ζ̇); θ = (ω₀, b₁, b₂, b₃, x₀, κ, α, ω_p): the water's memory is a hidden oscillator ζ, driven by the
/// motion; (F59). |ẋ| bends where ẋ changes its sign, and the step that holds it is of lower order there.
struct WithRadiationMemory {
  static constexpr int states = 4, parameters = 8, channels = 1, turning = -1;
  template <class T>
  std::array<T, 4> rate(const std::array<T, 4>& y, const std::array<T, 8>& p, double) const {
    using std::abs;
    const T &x = y[0], &v = y[1];
    const T speed = abs(v), resisting = dynamics::damper_force(p[1], p[2], v, speed) + p[3] * v * v * v + p[5] * y[3];
    return {v, -resisting - p[0] * p[0] * (x - p[4]), y[3], v - 2.0 * p[6] * y[3] - p[7] * p[7] * y[2]};
  }
};

/// y = (h, ḣ); θ = (k, g).
struct Fall {
  static constexpr int states = 2, parameters = 2, channels = 1, turning = 1;
  template <class T>
  std::array<T, 2> rate(const std::array<T, 2>& y, const std::array<T, 2>& p, double direction) const {
    return {y[1], -p[1] - direction * p[0] * y[1] * y[1]};
  }
  template <class T>
  bool sticks(const std::array<T, 2>&, const std::array<T, 2>&) const {
    return false;
  }
};

/// y = (θ₁, θ₂, ω₁, ω₂) from the upright; θ = (α, β, γ₁, γ₂, κ₁, κ₂), all over M₁₁:
/// M₁₂ = α cos(θ₁ − θ₂), M₂₂ = β, gravity γ, friction κ₁ to the ground and κ₂ between the links.
struct DoublePendulum {
  static constexpr int states = 4, parameters = 6, channels = 2, turning = -1;
  template <class T>
  std::array<T, 4> rate(const std::array<T, 4>& y, const std::array<T, 6>& p, double) const {
    using std::cos;
    using std::sin;
    const T between = y[0] - y[1], s = sin(between), m12 = p[0] * cos(between);
    const T r1 = -p[0] * s * y[3] * y[3] + p[2] * sin(y[0]) - p[4] * y[2] - p[5] * (y[2] - y[3]);
    const T r2 = p[0] * s * y[2] * y[2] + p[3] * sin(y[1]) - p[5] * (y[3] - y[2]);
    const T determinant = p[1] - m12 * m12;
    return {y[2], y[3], (p[1] * r1 - m12 * r2) / determinant, (r2 - m12 * r1) / determinant};
  }
};

}  // namespace fit
