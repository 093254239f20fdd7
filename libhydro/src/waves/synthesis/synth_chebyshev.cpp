#include "synth_chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/waves/kinematics/field.hpp"

namespace hydro::waves {
namespace {

using simd::lanes;

// T_q and T′_q = q U_{q−1}. The first two packs by the recurrence of one step, the others by that of eight,
// T_{q+8} = 2 T_8 T_q − T_{q−8}, which U obeys too. `size` is a whole number of packs.
FROUDE_KERNEL void chebyshev(double s, double per_metre, std::size_t size, double* value, double* slope) {
  alignas(64) double T[2 * lanes + 1], U[2 * lanes + 1];  // U[q] = U_{q−1}
  T[0] = 1, T[1] = s, U[0] = 0, U[1] = 1;
  for (std::size_t q = 2; q <= 2 * lanes; ++q) {
    T[q] = 2 * s * T[q - 1] - T[q - 2];
    U[q] = 2 * s * U[q - 1] - U[q - 2];
  }
  simd::Pack t, t_before, u, u_before, order{0, 1, 2, 3, 4, 5, 6, 7};
  simd::load(T, t_before);
  simd::load(U, u_before);
  simd::load(T + lanes, t);
  simd::load(U + lanes, u);
  const double twice = 2 * T[lanes];
  for (std::size_t q = 0; q < size; q += lanes) {
    simd::store(t_before, value + q);
    simd::store(per_metre * order * u_before, slope + q);
    const simd::Pack t_next = twice * t - t_before, u_next = twice * u - u_before;
    t_before = t, u_before = u;
    t = t_next, u = u_next;
    order += static_cast<double>(lanes);
  }
}

}  // namespace

VerticalBasis::VerticalBasis(double bottom, double top, double kappa, double depth, double tolerance, bool curvature)
    : bottom_(bottom), top_(top) {
  for (count_ = 4; count_ <= 128; ++count_) {
    error_ = error_of(kappa, depth, curvature);
    if (error_ <= tolerance) return;
  }
  throw InputError(
      fmt::format("a table from z = {:.4g} m to {:.4g} m is {:.3g} of the shortest wavelengths high, too many for a "
                  "relative error of {}",
                  bottom, top, kappa * (top - bottom) / (2 * std::numbers::pi), tolerance),
      {}, "take a lower box, or leave out the shortest waves");
}

std::vector<double> VerticalBasis::profile(double kappa, double depth) const {
  const auto n = static_cast<double>(count_);
  std::vector<double> at_points(count_), out(count_, 0.0);
  const auto angle = [&](std::size_t i) { return std::numbers::pi * (static_cast<double>(i) + 0.5) / n; };
  for (std::size_t i = 0; i < count_; ++i)
    at_points[i] = depth_profile(kappa, depth, 0.5 * (top_ + bottom_ + (top_ - bottom_) * std::cos(angle(i)))).cosh;
  for (std::size_t q = 0; q < count_; ++q) {
    for (std::size_t i = 0; i < count_; ++i) out[q] += at_points[i] * std::cos(static_cast<double>(q) * angle(i));
    out[q] *= (q == 0 ? 1 : 2) / n;
  }
  return out;
}

void VerticalBasis::at(double z, std::span<double> value, std::span<double> slope) const {
  const double per_metre = 2 / (top_ - bottom_);
  chebyshev((z - bottom_) * per_metre - 1, per_metre, padded(), value.data(), slope.data());
  for (std::size_t q = count_; q < padded(); ++q) value[q] = slope[q] = 0;
}

// T″_q from T′: the recurrence of T, differentiated twice.
void VerticalBasis::bend_at(double z, std::span<const double> slope, std::span<double> bend) const {
  const double per_metre = 2 / (top_ - bottom_), s = (z - bottom_) * per_metre - 1;
  bend[0] = bend[1] = 0;
  for (std::size_t q = 2; q < count_; ++q) bend[q] = 4 * per_metre * slope[q - 1] + 2 * s * bend[q - 1] - bend[q - 2];
  for (std::size_t q = count_; q < padded(); ++q) bend[q] = 0;
}

double VerticalBasis::error_of(double kappa, double depth, bool curvature) const {
  const auto c = profile(kappa, depth);
  const double largest = depth_profile(kappa, depth, top_).cosh;
  std::vector<double> value(padded()), slope(padded()), bend(padded());
  double worst = 0;
  constexpr int points = 200;
  for (int i = 0; i <= points; ++i) {
    const double z = bottom_ + (top_ - bottom_) * i / points;
    at(z, value, slope);
    if (curvature) bend_at(z, slope, bend);
    const DepthProfile exact = depth_profile(kappa, depth, z);
    double cosh = 0, sinh = 0, bent = 0;
    for (std::size_t q = 0; q < count_; ++q) {
      cosh += c[q] * value[q];
      sinh += c[q] * slope[q] / kappa;
      bent += c[q] * bend[q] / (kappa * kappa);
    }
    worst = std::max({worst, std::abs(cosh - exact.cosh), std::abs(sinh - exact.sinh)});
    if (curvature) worst = std::max(worst, std::abs(bent - exact.cosh));
  }
  return worst / largest;
}

}  // namespace hydro::waves
