#include "bottom_mounted.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exterior.hpp"
#include "tails.hpp"

namespace hydro::cylinders {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

int bottom_mounted_terms(double radius, double depth, double K) {
  const double reach = std::max(300 / std::min(radius, depth), std::isinf(K) ? 0 : 30 * K);
  return count_of_terms(reach * depth / std::numbers::pi);
}

Scatterer bottom_mounted(double radius, const VerticalModes& modes, int orders, int channels) {
  const Index N = channels;
  const RadialFunctions radial(modes, radius, orders, channels);
  const Exterior outside(modes, radius, modes.depth, nullptr);
  Scatterer s;
  for (int m = 0; m < orders; ++m) {
    const Index motions = m == 0 ? 1 : m == 1 ? 2 : 0;
    AzimuthalOrder o{MatrixXcd::Zero(N, N), MatrixXcd::Zero(N, motions), MatrixXcd::Zero(motions, N),
                     MatrixXcd::Zero(motions, motions)};
    for (int n = 0; n < channels; ++n) {
      const Complex slope = radial.slope_Q(m, n);
      o.T(n, n) = -radial.slope_S(m, n) / slope;
      if (m != 1) continue;
      o.R.row(n) = outside.rows().col(n).transpose().cast<Complex>() / slope;
      o.E.col(n) = modes.depth * radial.wronskian(n) * o.R.row(n).transpose();
    }
    if (m == 1) o.L = radius * modes.depth * outside.sum(1, radial);
    s.order.push_back(std::move(o));
  }
  return s;
}

}  // namespace hydro::cylinders
