#pragma once
/// \file  Interpolation in a table with uneven steps, as weights of neighbouring values, so that any kind of value can
/// be combined.
#include <array>
#include <cstddef>
#include <span>

namespace hydro {

/// Weights of up to four consecutive values from `first` on.
struct Stencil {
  std::size_t first = 0;
  std::array<double, 4> weight{};
};

/// Straight between the two neighbours of `at`. `x` increases; a point outside is extended from the end interval.
Stencil straight_stencil(std::span<const double> x, double at);

/// Between x_i and x_{i+1} the cubic that meets both values and, at each of the two, the slope of the parabola through
/// it and its neighbours (at an end of the table: of the straight line). Exact for parabolas inside; third order. (P6)
Stencil cubic_stencil(std::span<const double> x, double at);

/// Σ weight · value(index), for values that add and scale: numbers, matrices, columns.
template <class Value>
auto combined(const Stencil& s, std::size_t size, Value value) {
  auto sum = (s.weight[0] * value(s.first)).eval();
  for (std::size_t k = 1; k < s.weight.size() && s.first + k < size; ++k)
    if (s.weight[k] != 0) sum += s.weight[k] * value(s.first + k);
  return sum;
}

}  // namespace hydro
