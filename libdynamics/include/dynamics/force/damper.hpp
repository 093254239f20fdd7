#pragma once
/// \file  What a damper answers, of numbers with or without derivatives: dampers of a run and the fits of decays have
///        their force from here. (D50)

namespace dynamics {

/// c₁ẋ + c₂|ẋ|ẋ, `speed` being |ẋ|.
template <class T, class C>
T damper_force(const C& linear, const C& quadratic, const T& rate, const T& speed) {
  return (linear + quadratic * speed) * rate;
}

}  // namespace dynamics
