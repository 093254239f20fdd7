#include "wave_bessel.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace hydro::panels {
namespace {

using std::numbers::pi;

constexpr double table_end = 16;
constexpr int per_unit = 4;  // intervals of a quarter: Taylor's terms fall as 0.125^n/n!
constexpr int terms = 9;     // 0.125^9/9! = 2e-14
static_assert(terms % 2 == 1);

/// Taylor's series of J₀ and J₁ about the middles of intervals.
struct BesselTable {
  std::array<std::array<BesselPair, terms>, static_cast<std::size_t>(table_end* per_unit)> series;
  BesselTable() {
    for (std::size_t i = 0; i < series.size(); ++i) fill(series[i], (static_cast<double>(i) + 0.5) / per_unit);
  }

 private:
  /// From J₀′ = −J₁ and x J₁′ = x J₀ − J₁: with x = m + t, (n + 1) m b_{n+1} = m a_n + a_{n−1} − (n + 1) b_n.
  static void fill(std::array<BesselPair, terms>& s, double m) {
    s[0] = {std::cyl_bessel_j(0.0, m), std::cyl_bessel_j(1.0, m)};
    for (std::size_t n = 0; n + 1 < terms; ++n) {
      const auto next = static_cast<double>(n + 1);
      const double before = n > 0 ? s[n - 1].order0 : 0;
      s[n + 1] = {-s[n].order1 / next, (m * s[n].order0 + before - next * s[n].order1) / (next * m)};
    }
  }
};

/// P and Q of Hankel's expansion (Abramowitz & Stegun 1964, 9.2.9 and 9.2.10), J = √(2/πx)(P cos χ − Q sin χ).
struct Hankel {
  double P = 1, Q = 0;
  Hankel(double order, double x) {
    const double mu = 4 * order * order;
    double term = 1;
    for (int n = 1; n < 16; ++n) {  // at x = 16 the last is 1e-14
      const double odd = 2 * n - 1;
      term *= (mu - odd * odd) / (8 * n * x);
      const double sign = n % 4 < 2 ? 1 : -1;
      (n % 2 == 1 ? Q : P) += sign * term;
    }
  }
};

/// Amplitude and phase of both orders at once; `shift` 0 gives J, π/2 gives Y.
BesselPair far_pair(double x, bool second) {
  const Hankel h0(0, x), h1(1, x);
  const double c = std::cos(x - pi / 4), s = std::sin(x - pi / 4), size = std::sqrt(2 / (pi * x));
  if (second) return {size * (h0.P * s + h0.Q * c), size * (-h1.P * c + h1.Q * s)};
  return {size * (h0.P * c - h0.Q * s), size * (h1.P * s + h1.Q * c)};
}

}  // namespace

BesselPair bessel_j(double x) {
  static const BesselTable table;
  if (x >= table_end) return far_pair(x, false);
  const auto i = static_cast<std::size_t>(x * per_unit);
  const auto& s = table.series[i];
  const double t = x - (static_cast<double>(i) + 0.5) / per_unit;
  // Even and odd powers apart, which do not wait for each other: a fifth of a panel method's time was spent here.
  const double t2 = t * t;
  BesselPair even = s[terms - 1], odd = s[terms - 2];
  for (std::size_t n = terms - 1; n >= 2; n -= 2) {
    even = {even.order0 * t2 + s[n - 2].order0, even.order1 * t2 + s[n - 2].order1};
    if (n >= 4) odd = {odd.order0 * t2 + s[n - 3].order0, odd.order1 * t2 + s[n - 3].order1};
  }
  return {even.order0 + t * odd.order0, even.order1 + t * odd.order1};
}

BesselPair bessel_y_far(double x) { return far_pair(x, true); }

}  // namespace hydro::panels
