#include "bessel.hpp"

#include <algorithm>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <numbers>

namespace hydro::cylinders {
namespace {

using std::numbers::pi;
using NoPromotion = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr double far = 30;  // beyond it Hankel's expansions of low orders reach rounding

/// Σ_k s^k a_k(ν)/x^k with Hankel's coefficients a_k, up to the smallest term; s = i for J, −1 for I, +1 for K.
template <class Number>
Number hankel_sum(double order, double x, Number s) {
  const double mu = 4 * order * order;
  Number term = 1, sum = 1;
  double last = 1;
  for (int k = 1; k < 60; ++k) {
    const double odd = 2 * k - 1;
    const double ratio = (mu - odd * odd) / (8 * k * x);
    if (std::abs(ratio) >= 1 && odd > 2 * order) break;
    term *= s * ratio;
    sum += term;
    last = std::abs(term);
    if (last < 1e-17) break;
  }
  return sum;
}

double bessel_j(double order, double x) {
  if (x < far) return boost::math::cyl_bessel_j(order, x, NoPromotion());
  const double chi = x - (order / 2 + 0.25) * pi;
  return std::sqrt(2 / (pi * x)) * (hankel_amplitude(order, x) * std::polar(1.0, chi)).real();
}

double bessel_i_scaled(double order, double x) {
  if (x < far) return std::exp(-x) * boost::math::cyl_bessel_i(order, x, NoPromotion());
  return hankel_sum(order, x, -1.0) / std::sqrt(2 * pi * x);
}

double bessel_k_scaled(int order, double x) {
  if (x < far) return std::exp(x) * boost::math::cyl_bessel_k(order, x, NoPromotion());
  return std::sqrt(pi / (2 * x)) * hankel_sum(order, x, 1.0);
}

/// Miller's algorithm: f_{ν−1} = (2ν/x) f_ν + sign f_{ν+1} downwards from an order where the wanted solution is
/// negligible. `out` holds the sequence up to a factor.
void downward(double first, double x, double sign, int from, std::span<double> out) {
  double above = 0, here = 1e-280;
  for (int k = from; k >= 0; --k) {
    if (k < static_cast<int>(out.size())) out[static_cast<std::size_t>(k)] = here;
    const double below = 2 * (first + k) / x * here + sign * above;
    above = here;
    here = below;
    if (std::abs(here) < 1e200) continue;
    above *= 1e-200;
    here *= 1e-200;
    for (std::size_t j = static_cast<std::size_t>(k); j < out.size(); ++j) out[j] *= 1e-200;
  }
}

void scale(std::span<double> out, double factor) {
  for (double& value : out) value *= factor;
}

/// I_{m+1}(x)/I_m(x) = 1/(2(m+1)/x + 1/(2(m+2)/x + …)), evaluated from below the depth at which it has converged.
double i_ratio(double order, double x) {
  const int terms = 30 + static_cast<int>(std::sqrt(90 * x));
  double fraction = 0;
  for (int k = terms; k >= 1; --k) fraction = 1 / (2 * (order + k) / x + fraction);
  return fraction;
}

}  // namespace

std::complex<double> hankel_amplitude(double order, double x) {
  return hankel_sum(order, x, std::complex<double>(0, 1));
}

void bessel_j_sequence(double first, double x, std::span<double> out) {
  const double highest = first + static_cast<double>(out.size());
  if (x >= far && x >= highest) {  // upwards is stable as long as the order is below x
    out[0] = bessel_j(first, x);
    if (out.size() > 1) out[1] = bessel_j(first + 1, x);
    for (std::size_t k = 2; k < out.size(); ++k)
      out[k] = 2 * (first + static_cast<double>(k) - 1) / x * out[k - 1] - out[k - 2];
    return;
  }
  const double turn = std::max(highest, x);
  std::vector<double> all(std::max<std::size_t>(out.size(), 2));
  downward(first, x, -1, static_cast<int>(turn + 30 + 10 * std::cbrt(turn)), all);
  const std::size_t pivot = std::abs(all[0]) >= std::abs(all[1]) ? 0 : 1;  // never near a zero of J
  scale(all, bessel_j(first + static_cast<double>(pivot), x) / all[pivot]);
  std::copy_n(all.begin(), out.size(), out.begin());
}

void bessel_i_scaled_sequence(double first, double x, std::span<double> out) {
  const double highest = static_cast<double>(out.size());
  downward(first, x, +1, static_cast<int>(std::sqrt(highest * highest + 90 * x)) + 30, out);
  scale(out, bessel_i_scaled(first, x) / out[0]);
}

void hankel_2_sequence(double x, std::span<std::complex<double>> out) {
  std::vector<double> J(out.size()), Y(std::max<std::size_t>(out.size(), 2));
  bessel_j_sequence(0, x, J);
  Y[0] = boost::math::cyl_neumann(0, x, NoPromotion());
  Y[1] = boost::math::cyl_neumann(1, x, NoPromotion());
  for (std::size_t m = 2; m < Y.size(); ++m) Y[m] = 2 * static_cast<double>(m - 1) / x * Y[m - 1] - Y[m - 2];
  for (std::size_t m = 0; m < out.size(); ++m) out[m] = {J[m], -Y[m]};
}

void bessel_k_scaled_sequence(double x, std::span<double> out) {
  out[0] = bessel_k_scaled(0, x);
  if (out.size() > 1) out[1] = bessel_k_scaled(1, x);
  for (std::size_t m = 2; m < out.size(); ++m) out[m] = 2 * static_cast<double>(m - 1) / x * out[m - 1] + out[m - 2];
}

// K_m′ = −K_{m−1} − (m/x) K_m, and the ratio r_m = K_{m−1}/K_m goes upwards by r_{m+1} = 1/(r_m + 2m/x).
void bessel_k_over_slope(double x, std::span<double> out) {
  double r = bessel_k_scaled(0, x) / bessel_k_scaled(1, x);  // K_{−1} = K_1, so r_0 = 1/r_1
  out[0] = -r;
  for (std::size_t m = 1; m < out.size(); ++m) {
    const double m_over_x = static_cast<double>(m) / x;
    out[m] = -1 / (r + m_over_x);
    r = 1 / (r + 2 * m_over_x);
  }
}

// I_m′ = I_{m+1} + (m/x) I_m, and the ratio ρ_m = I_{m+1}/I_m goes downwards by ρ_{m−1} = 1/(2m/x + ρ_m).
void bessel_i_over_slope(double x, std::span<double> out) {
  double rho = i_ratio(static_cast<double>(out.size() - 1), x);
  for (std::size_t m = out.size(); m-- > 0;) {
    const double m_over_x = static_cast<double>(m) / x;
    out[m] = 1 / (rho + m_over_x);
    rho = 1 / (2 * m_over_x + rho);
  }
}

}  // namespace hydro::cylinders
