/// Catenary segments between their nodes, in the equations. (D88)
#include <cmath>

#include "equations.hpp"

namespace dynamics::line {

using Eigen::Vector3d;

/// Adds to the law T/k − (r − ℓ) of a segment what its sag takes off the chord.
void Equations::sag(int j, double T, Pull& p) const {
  const Vector3d d = along(x_, j);
  const double r = d.norm(), slope = d.z() / r;
  p.sag = sag_of(span_of(line_, j, x_, slope), T);
  p.level_by = -2 * slope / r * (Vector3d::UnitZ() - slope * d / r);
  p.law -= p.sag.shortening;
  p.law_by_T -= p.sag.by_tension;
}

void Equations::add_sag_derivatives(int j, const Pull& p, const Stage& stage) {
  if (stage.x_by == 0) return;
  const int row = tension_index(j), first = line_.first(j);
  for (int c = 0; c < 3; ++c) {
    matrix_(row, place_index(first) + c) += scale_ * p.sag.by_level * p.level_by[c];
    matrix_(row, place_index(first + 1) + c) -= scale_ * p.sag.by_level * p.level_by[c];
  }
  for (int i = 0; i < 2; ++i) {
    matrix_(row, place_index(first + i) + 2) -= scale_ * p.sag.by_height[i];
    matrix_(place_index(first + i) + 2, row) -= scale_ * p.sag.relief_by_tension[i];
    for (int k = 0; k < 2; ++k)
      matrix_(place_index(first + i) + 2, place_index(first + k) + 2) -= p.sag.relief_by_height[i][k];
  }
}

/// T at which the law of a state holds, by Newton from above, where the law is convex.
double Equations::tension_of_sag(int j, const Stage& stage, const State& before) const {
  const Segment& s = line_.segment(j);
  double T = std::max(before.tension.size() > j ? before.tension[j] : 0.0, line_.sag_weight(j) * s.length);
  for (int i = 0; i < 100; ++i) {
    const Pull p = pull(j, stage, before, T);
    double next = T - p.law / p.law_by_T;
    if (next <= 0) next = T / 4;
    if (std::abs(next - T) <= 1e-14 * T) return next;
    T = next;
  }
  return T;
}

}  // namespace dynamics::line
