#pragma once
/// \file  What the spectra share: the peaked shape (W30), its panels (W31), and root and peak finding. Not installed.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hydro/waves/spectra/spectrum.hpp"

namespace hydro::waves {

void require_sea(double hs_m, double tp_s);
void require_shape(const PeakShape& shape);

/// u^−p e^{−(p/q) u^−q} γ^r for u > 0.
double peaked_value(const PeakShape& shape, double u);

/// Panel edges in ω over which that shape is smooth, from where it is 1e-130 of its peak to where its exponential is
/// 1 − 1e-3 or nearer to one.
std::vector<double> peaked_edges(const PeakShape& shape, double omega_p);

/// ω of the highest density: the best of the candidates, moved to the top between its neighbours among them.
/// Candidates increase and lie so densely that there is one peak between two that stand beside a third.
template <class Density>
double highest_frequency(const Density& density, const std::vector<double>& candidates) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < candidates.size(); ++i)
    if (density(candidates[i]) > density(candidates[best])) best = i;
  double low = candidates[best == 0 ? 0 : best - 1], high = candidates[std::min(best + 1, candidates.size() - 1)];
  const double golden = 0.3819660112501051;  // (3 − √5)/2
  while (high - low > 1e-9 * high) {         // a maximum is flat: its place is known to √ε only
    const double a = low + golden * (high - low), b = high - golden * (high - low);
    (density(a) < density(b) ? low : high) = density(a) < density(b) ? a : b;
  }
  const double found = 0.5 * (low + high);
  return density(found) > density(candidates[best]) ? found : candidates[best];
}

/// The root of a function that does not decrease, between low and high, by Newton's steps while they stay inside the
/// bracket and shrink, and by halving otherwise (W46). To 1e-15 of the bracket or of the argument.
template <class F, class Slope>
double increasing_root(const F& f, const Slope& slope, double low, double high) {
  const double whole = high - low;
  double x = 0.5 * (low + high), last = whole, before_last = whole;
  for (int step = 0; step < 200; ++step) {
    const double value = f(x);
    if (value == 0) return x;
    (value < 0 ? low : high) = x;
    const double newton = x - value / slope(x);
    const bool usable = newton > low && newton < high && std::abs(newton - x) <= 0.5 * before_last;
    const double next = usable ? newton : 0.5 * (low + high);
    before_last = std::exchange(last, std::abs(next - x));
    if (last <= 1e-15 * std::max(whole, std::abs(x)) || next <= low || next >= high) return next;
    x = next;
  }
  return x;
}

}  // namespace hydro::waves
