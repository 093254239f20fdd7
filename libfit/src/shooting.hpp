#pragma once
/// \file  Motions with the derivatives of every sample by every unknown: the same Runge–Kutta steps in Jets; (F36),
///        docs/theory/fit.md. Heavy (Ceres): include it in few places.
///
/// A Model has
///   static constexpr int states, parameters;
///   template <class T> std::array<T, states> rate(const std::array<T, states>& y, const std::array<T, parameters>&
///   theta,
///                                                 double direction) const;
///   static constexpr int turning;   // the velocity whose sign changes the law, −1 for none
///   template <class T> bool sticks(y, theta) const;   // at rest there for good; asked where velocity `turning` is
///   zero
#include <ceres/jet.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace fit {

/// Value of a Jet or of a double.
template <class T>
double value_of(const T& x) {
  if constexpr (std::is_same_v<T, double>)
    return x;
  else
    return x.a;
}

/// One classical Runge–Kutta step of order four. `h` may be a Jet: an instant that depends on the unknowns.
template <class Model, class T, class H>
std::array<T, Model::states> runge_kutta(const Model& model, const std::array<T, Model::states>& y,
                                         const std::array<T, Model::parameters>& theta, double direction, const H& h) {
  constexpr std::size_t n = Model::states;
  std::array<T, n> at = y;
  const auto k1 = model.rate(y, theta, direction);
  for (std::size_t i = 0; i < n; ++i) at[i] = y[i] + 0.5 * h * k1[i];
  const auto k2 = model.rate(at, theta, direction);
  for (std::size_t i = 0; i < n; ++i) at[i] = y[i] + 0.5 * h * k2[i];
  const auto k3 = model.rate(at, theta, direction);
  for (std::size_t i = 0; i < n; ++i) at[i] = y[i] + h * k3[i];
  const auto k4 = model.rate(at, theta, direction);
  for (std::size_t i = 0; i < n; ++i) at[i] = y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  return at;
}

/// A motion being followed.
template <class Model, class T>
class Follower {
 public:
  using State = std::array<T, Model::states>;
  Follower(const Model& model, const State& start, const std::array<T, Model::parameters>& theta)
      : model_(model), theta_(theta), y_(start) {
    if constexpr (Model::turning >= 0) direction_ = sign(start);
  }

  const State& state() const { return y_; }

  void advance(double h) {
    if constexpr (Model::turning < 0)
      y_ = runge_kutta(model_, y_, theta_, 0.0, h);
    else
      advance_with_turning(h);
  }

 private:
  static constexpr std::size_t v = Model::turning < 0 ? 0 : static_cast<std::size_t>(Model::turning);

  /// Of the velocity; at rest, of the acceleration that follows.
  double sign(const State& y) const {
    if (value_of(y[v]) != 0) return value_of(y[v]) > 0 ? 1 : -1;
    return value_of(model_.rate(y, theta_, 0.0)[v]) >= 0 ? 1 : -1;
  }

  // A step in which the velocity changes sign ends where it is zero: h* by regula falsi, and one Newton step in Jets
  // gives h* its derivatives, so that what follows is differentiated through the event.
  void advance_with_turning(double h) {
    if (stuck_) return;
    const State whole = runge_kutta(model_, y_, theta_, direction_, h);
    if (value_of(whole[v]) * direction_ > 0) {
      y_ = whole;
      return;
    }
    double low = 0, high = h, at_low = value_of(y_[v]), at_high = value_of(whole[v]), when = h;
    for (int i = 0; i < 60 && high - low > 1e-15 * h; ++i) {
      when = i % 3 == 2 || at_low == at_high ? (low + high) / 2 : low - at_low * (high - low) / (at_high - at_low);
      const double there = value_of(runge_kutta(model_, y_, theta_, direction_, when)[v]);
      if (there * direction_ > 0)
        low = when, at_low = there;
      else
        high = when, at_high = there;
      if (there == 0) break;
    }
    const State near = runge_kutta(model_, y_, theta_, direction_, when);
    const T slope = model_.rate(near, theta_, direction_)[v];
    const T instant = when - near[v] / slope;
    y_ = runge_kutta(model_, y_, theta_, direction_, instant);
    y_[v] = T(0);
    stuck_ = model_.sticks(y_, theta_);
    if (stuck_) return;
    direction_ = -direction_;
    y_ = runge_kutta(model_, y_, theta_, direction_, T(h) - instant);
  }

  const Model& model_;
  const std::array<T, Model::parameters>& theta_;
  State y_;
  double direction_ = 0;
  bool stuck_ = false;
};

}  // namespace fit
