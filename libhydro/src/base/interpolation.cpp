#include "hydro/base/interpolation.hpp"

#include <algorithm>

namespace hydro {
namespace {

/// Index i of the interval [x_i, x_{i+1}] that holds `at`, or is nearest to it.
std::size_t interval(std::span<const double> x, double at) {
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  return std::clamp<std::size_t>(above, 1, x.size() - 1) - 1;
}

/// Derivative at x[j] of the parabola through x[j−1], x[j], x[j+1], as weights of the three values.
std::array<double, 3> slope_weights(std::span<const double> x, std::size_t j) {
  const double a = x[j] - x[j - 1], b = x[j + 1] - x[j];
  return {-b / (a * (a + b)), (b - a) / (a * b), a / (b * (a + b))};
}

}  // namespace

Stencil straight_stencil(std::span<const double> x, double at) {
  if (x.size() == 1) return {0, {1, 0, 0, 0}};
  const std::size_t i = interval(x, at);
  const double s = (at - x[i]) / (x[i + 1] - x[i]);
  return {i, {1 - s, s, 0, 0}};
}

Stencil cubic_stencil(std::span<const double> x, double at) {
  if (x.size() < 3) return straight_stencil(x, at);
  const std::size_t i = interval(x, at);
  const double h = x[i + 1] - x[i], s = (at - x[i]) / h;
  const bool has_before = i > 0, has_after = i + 2 < x.size();
  Stencil out{has_before ? i - 1 : i, {}};
  const std::size_t here = i - out.first;
  out.weight[here] += (1 + 2 * s) * (1 - s) * (1 - s);  // Hermite's cubics: values …
  out.weight[here + 1] += s * s * (3 - 2 * s);
  const auto add_slope = [&](std::size_t node, double factor, bool inside) {
    if (inside) {
      const auto w = slope_weights(x, node);
      for (std::size_t k = 0; k < w.size(); ++k) out.weight[node - 1 + k - out.first] += factor * w[k];
    } else {
      out.weight[here] -= factor / h;
      out.weight[here + 1] += factor / h;
    }
  };
  add_slope(i, h * s * (1 - s) * (1 - s), has_before);  // … and slopes
  add_slope(i + 1, -h * s * s * (1 - s), has_after);
  return out;
}

}  // namespace hydro
