#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bessel.hpp"
#include "channels.hpp"
#include "radial.hpp"

namespace hydro::cylinders {
namespace {

constexpr int most_orders = 24;  // K_m of small arguments would overflow not far beyond

std::vector<double> k_scaled(double x, int count) {
  std::vector<double> K(static_cast<std::size_t>(count));
  bessel_k_scaled_sequence(x, K);
  return K;
}

struct Pair {
  double a, b, distance;
  double share;  ///< of the depth that the larger of the two occupies
};

/// How much of the depth a cylinder disturbs: its side, and about a radius below it; twice, near the surface, where
/// cos² κ_n z is 1 and not ½.
double share_of_depth(const Cylinder& c, double depth) {
  return c.draught ? std::min(1.0, 2 * (*c.draught + c.radius) / depth) : 1;
}

/// The closest pair of each pair of radii among those wanted: the others couple less.
std::vector<Pair> closest_pairs(const std::vector<Cylinder>& cylinders, double depth, const WantedPair& wanted) {
  std::map<std::pair<double, double>, Pair> nearest;
  for (std::size_t i = 0; i < cylinders.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!wanted(i, j)) continue;
      const Cylinder &a = cylinders[i], &b = cylinders[j];
      const double share = std::max(share_of_depth(a, depth), share_of_depth(b, depth));
      const Pair pair{std::min(a.radius, b.radius), std::max(a.radius, b.radius), (a.centre - b.centre).norm(), share};
      const auto [at, is_new] = nearest.try_emplace({pair.a, pair.b}, pair);
      at->second.distance = std::min(at->second.distance, pair.distance);
      at->second.share = std::max(at->second.share, pair.share);
    }
  std::vector<Pair> pairs;
  for (const auto& [radii, pair] : nearest) pairs.push_back(pair);
  return pairs;
}

/// Estimated coupling (C11) for m = 0 … most_orders.
std::vector<double> coupling(const Pair& p, double kappa, bool wave) {
  constexpr int all = 2 * most_orders + 1;
  const auto function = [&](double distance, int count) {
    return wave ? wave_scales(kappa, distance, count) : k_scaled(kappa * distance, count);
  };
  const auto at_distance = function(p.distance, all);
  const auto at_a = function(p.a, most_orders + 1), at_b = function(p.b, most_orders + 1);
  const double decay = wave ? 1 : std::exp(-kappa * (p.distance - p.a - p.b));
  std::vector<double> c;
  for (std::size_t m = 0; m <= most_orders; ++m) {
    const double wall = wave ? 1 : p.share / std::max(1.0, 2 * (kappa * p.a + static_cast<double>(m)));
    c.push_back(decay * wall * at_distance[2 * m] / (at_a[m] * at_b[m]));
  }
  return c;
}

struct Coupled {
  int highest = -1;     ///< order of one vertical mode whose coupling exceeds the threshold; −1: none does
  double largest = 0;   ///< coupling of any order
  double left_out = 0;  ///< at the highest order of all, if above the threshold
};

Coupled coupled(const std::vector<Pair>& pairs, double kappa, bool wave, double threshold) {
  Coupled all;
  for (const Pair& p : pairs) {
    const auto c = coupling(p, kappa, wave);
    for (int m = 0; m <= most_orders; ++m)
      if (c[static_cast<std::size_t>(m)] > threshold) all.highest = std::max(all.highest, m);
    all.largest = std::max(all.largest, *std::max_element(c.begin(), c.end()));
    // A short wave, or a low order, is given back whole; a high order by 1/(πm).
    const bool whole = !wave || kappa * p.b > most_orders;
    const double returned = whole ? c.back() : c.back() / (std::numbers::pi * most_orders);
    if (c.back() > threshold) all.left_out = std::max(all.left_out, returned);
  }
  return all;
}

}  // namespace

int Channels::count() const {
  int sum = 0;
  for (const int m : order) sum += 2 * m + 1;
  return sum;
}

int Channels::vertical_of(int azimuthal) const {
  return static_cast<int>(
      std::count_if(order.begin(), order.end(), [&](int highest) { return highest >= std::abs(azimuthal); }));
}

Channels Channels::united_with(const Channels& other) const {
  Channels both{std::vector<int>(std::max(order.size(), other.order.size())), std::max(left_out, other.left_out)};
  for (std::size_t n = 0; n < both.order.size(); ++n)
    both.order[n] = std::max(n < order.size() ? order[n] : 0, n < other.order.size() ? other.order[n] : 0);
  return both;
}

Channels coupled_channels(const std::vector<Cylinder>& cylinders, const VerticalModes& modes, double threshold,
                          const WantedPair& wanted) {
  const auto pairs = closest_pairs(cylinders, modes.depth, wanted);
  Channels channels{{1}};
  if (modes.has_wave()) {
    const Coupled wave = coupled(pairs, modes.k, true, threshold);
    channels = {{std::max(1, wave.highest)}, wave.left_out};
  }
  Coupled last;
  for (const double kappa : modes.kappa) {
    last = coupled(pairs, kappa, false, threshold);
    if (last.highest < 0) break;
    channels.order.push_back(last.highest);
    channels.left_out = std::max(channels.left_out, last.left_out);
  }
  if (last.highest >= 0) channels.left_out = std::max(channels.left_out, last.largest);  // there are more such modes
  for (std::size_t n = channels.order.size() - 1; n-- > 0;)
    channels.order[n] = std::max(channels.order[n], channels.order[n + 1]);
  return channels;
}

}  // namespace hydro::cylinders
