#pragma once
/// \file  Sizes that are computed with.

namespace hydro {

/// Zero, or so large and so small that its fourth power and the reciprocal of that are numbers still: 1e-30 to 1e30 in
/// SI. Beyond, squares of residuals overflow or vanish, and an answer would be wrong without saying so.
constexpr bool is_measurable(double si) {
  const double size = si < 0 ? -si : si;
  return size == 0 || (size >= 1e-30 && size <= 1e30);
}

}  // namespace hydro
