#include "synth_chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/waves/kinematics/field.hpp"

namespace hydro::waves {
namespace {

using simd::lanes;

FROUDE_INLINE simd::Pack reversed(const simd::Pack& p) {
  return {__builtin_shufflevector(p.high, p.high, 3, 2, 1, 0), __builtin_shufflevector(p.low, p.low, 3, 2, 1, 0)};
}

// T_q and T′_q = q U_{q−1}. With T = cos qθ and U_{q−1} = sin qθ/sin θ the first nine follow by doubling the angle, the
// rest eight at a time, T_{q+8} = 2 T_8 T_q − T_{q−8}, which U obeys too. `size` is a whole number of packs.
FROUDE_KERNEL void chebyshev(double s, double per_metre, std::size_t size, double* value, double* slope) {
  alignas(64) double T[lanes + 2], U[lanes + 2];  // U[q] = U_{q−1}
  T[0] = 1, T[1] = s, U[0] = 0, U[1] = 1;
  for (std::size_t n = 1; n <= lanes / 2; ++n) {
    T[2 * n] = 2 * T[n] * T[n] - 1;
    T[2 * n + 1] = 2 * T[n] * T[n + 1] - s;
    U[2 * n] = 2 * T[n] * U[n];
    U[2 * n + 1] = 2 * T[n] * U[n + 1] - 1;
  }
  const double twice = 2 * T[lanes];
  simd::Pack t, u, t_back, u_back, order{{0, 1, 2, 3}, {4, 5, 6, 7}};
  simd::load(T, t);
  simd::load(U, u);
  simd::load(T + 1, t_back);
  simd::load(U + 1, u_back);
  // T_{q−8} = T_{8−q} and U_{q−9} = −U_{7−q}.
  simd::Pack t_before = reversed(t_back), u_before = -reversed(u_back);
  for (std::size_t q = 0; q < size; q += lanes) {
    simd::store(t, value + q);
    simd::store(per_metre * order * u, slope + q);
    const simd::Pack t_next = twice * t - t_before, u_next = twice * u - u_before;
    t_before = t, u_before = u;
    t = t_next, u = u_next;
    order = order + 1.0 * lanes;
  }
}

}  // namespace

VerticalBasis::VerticalBasis(double bottom, double top, double kappa, double depth, double tolerance, bool curvature)
    : bottom_(bottom), top_(top) {
  for (count_ = 4; count_ <= 128; ++count_)
    for (const double spread : {0.01, 0.5, 1.0, 1.5, 2.0}) {
      spread_ = spread / (top - bottom);
      range_ = std::expm1(spread);
      error_ = largest_error(kappa, depth, tolerance, curvature);
      if (error_ <= tolerance) return;
    }
  throw InputError(
      fmt::format("a table from z = {:.4g} m to {:.4g} m is {:.3g} of the shortest wavelengths high, too many for a "
                  "relative error of {}",
                  bottom, top, kappa * (top - bottom) / (2 * std::numbers::pi), tolerance),
      {}, "take a lower box, or leave out the shortest waves");
}

VerticalBasis::Mapped VerticalBasis::mapped(double z) const {
  const double up = 2 / range_ * std::expm1(spread_ * (z - bottom_));
  return {up - 1, spread_ * (up + 2 / range_)};
}

double VerticalBasis::height(double s) const { return bottom_ + std::log1p(range_ * (s + 1) / 2) / spread_; }

std::vector<double> VerticalBasis::profile(double kappa, double depth) const {
  const auto n = static_cast<double>(count_);
  std::vector<double> at_points(count_), out(count_, 0.0);
  const auto angle = [&](std::size_t i) { return std::numbers::pi * (static_cast<double>(i) + 0.5) / n; };
  for (std::size_t i = 0; i < count_; ++i)
    at_points[i] = depth_profile(kappa, depth, std::max(height(std::cos(angle(i))), -depth)).cosh;
  for (std::size_t q = 0; q < count_; ++q) {
    for (std::size_t i = 0; i < count_; ++i) out[q] += at_points[i] * std::cos(static_cast<double>(q) * angle(i));
    out[q] *= (q == 0 ? 1 : 2) / n;
  }
  return out;
}

void VerticalBasis::at(double z, std::span<double> value, std::span<double> slope) const {
  const Mapped at = mapped(z);
  chebyshev(at.s, at.by_z, padded(), value.data(), slope.data());
  for (std::size_t q = count_; q < padded(); ++q) value[q] = slope[q] = 0;
}

// T″_q from T and T′: the recurrence of T, differentiated twice. s′ grows with height as e^{cz}.
void VerticalBasis::bend_at(double z, std::span<const double> value, std::span<const double> slope,
                            std::span<double> bend) const {
  const Mapped at = mapped(z);
  bend[0] = 0, bend[1] = spread_ * at.by_z;
  for (std::size_t q = 2; q < count_; ++q)
    bend[q] = 2 * bend[1] * value[q - 1] + 4 * at.by_z * slope[q - 1] + 2 * at.s * bend[q - 1] - bend[q - 2];
  for (std::size_t q = count_; q < padded(); ++q) bend[q] = 0;
}

// Long waves bend little, but not as the polynomials do: all wavenumbers are looked at, the largest first. What is
// above the tolerance is no basis, and not looked at any further.
double VerticalBasis::largest_error(double kappa, double depth, double tolerance, bool curvature) const {
  double worst = 0, k = kappa;
  for (int i = 0; i < 20 && worst <= tolerance; ++i, k *= 0.75)
    worst = std::max(worst, error_of(k, kappa, depth, curvature));
  return worst;
}

double VerticalBasis::error_of(double kappa, double unit, double depth, bool curvature) const {
  const auto c = profile(kappa, depth);
  const double largest = depth_profile(kappa, depth, top_).cosh, share = kappa / unit;
  std::vector<double> value(padded()), slope(padded()), bend(padded());
  double worst = 0;
  constexpr int points = 200;
  for (int i = 0; i <= points; ++i) {
    const double z = bottom_ + (top_ - bottom_) * i / points;
    at(z, value, slope);
    if (curvature) bend_at(z, value, slope, bend);
    const DepthProfile exact = depth_profile(kappa, depth, z);
    double cosh = 0, sinh = 0, bent = 0;
    for (std::size_t q = 0; q < count_; ++q) {
      cosh += c[q] * value[q];
      sinh += c[q] * slope[q] / unit;
      bent += c[q] * bend[q] / (unit * unit);
    }
    worst = std::max({worst, std::abs(cosh - exact.cosh), std::abs(sinh - share * exact.sinh)});
    if (curvature) worst = std::max(worst, std::abs(bent - share * share * exact.cosh));
  }
  return worst / largest;
}

}  // namespace hydro::waves
