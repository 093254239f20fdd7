#pragma once
/// \file  Even samples along one axis of a table, and the weights at a point between them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "synth_table_kernel.hpp"
#include "synth_window.hpp"

namespace hydro::waves {

/// Weights of one axis at one point, with the storage they point into.
struct AxisPoint {
  std::ptrdiff_t first = 0;
  Window::Weights weight;
  std::size_t count = 1;
  table::AxisWeights view() const { return {weight[0].data(), weight[1].data(), weight[2].data(), count}; }
};

/// Samples of functions with no frequency above `highest` (rad per unit), for points in [low, high].
struct Axis {
  const Window* window = nullptr;  ///< null: the axis has one sample, since nothing varies along it
  double low = 0, high = 0, step = 1, origin = 0;
  std::size_t count = 1;

  static Axis along(const Window& window, double low, double high, double highest) {
    // Where nothing varies any step will do.
    const double step = highest > 0 ? std::numbers::pi / (window.oversampling() * highest) : std::max(1.0, high - low);
    const auto half = static_cast<double>(window.width() / 2);
    return {&window,
            low,
            high,
            step,
            low - half * step,
            static_cast<std::size_t>(std::ceil((high - low) / step)) + window.width() + 1};
  }

  double at(std::size_t i) const { return origin + static_cast<double>(i) * step; }

  /// Rounding may take a point a billionth of a step over the end.
  bool holds(double x) const { return x >= low - 1e-9 * step && x <= high + 1e-9 * step; }

  /// Factor by which samples of e^{iκx} are divided, so that interpolation returns it.
  double transform(double kappa) const { return window != nullptr ? window->transform(kappa * step) : 1; }

  AxisPoint point(double x) const {
    AxisPoint out;
    if (window == nullptr) {
      out.weight[0][0] = 1, out.weight[1][0] = out.weight[2][0] = 0;
      return out;
    }
    const double position = std::max((x - low) / step, 0.0) + static_cast<double>(window->width() / 2);
    out.first = window->first(position);
    out.count = window->width();
    window->weights(position, 1 / step, out.weight);
    return out;
  }
};

}  // namespace hydro::waves
