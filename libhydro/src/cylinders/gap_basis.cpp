#include "gap_basis.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "bessel.hpp"

namespace hydro::cylinders {

using std::numbers::pi;

template <class Sequence, class Sign>
void GapBasis::transform(double x, std::span<double> out, Sequence sequence, Sign sign) const {
  const auto count = static_cast<std::size_t>(per_family_);
  std::vector<double> bessel(2 * count);
  for (std::size_t f = 0; f < families.size(); ++f) {
    sequence(families[f], x, std::span<double>(bessel));
    const double factor = std::pow(x, -families[f]);
    for (std::size_t p = 0; p < count; ++p) out[f * count + p] = sign(p) * factor * bessel[2 * p];
  }
}

void GapBasis::cosine(double x, std::span<double> out) const {
  transform(x, out, bessel_j_sequence, [](std::size_t) { return 1.0; });
}

// cosh xτ = cos(ixτ) and J_ν(ix) = i^ν I_ν(x): the transform at ix is (−1)^p x^{−λ} I_{λ+2p}(x).
void GapBasis::cosh_scaled(double x, std::span<double> out) const {
  transform(x, out, bessel_i_scaled_sequence, [](std::size_t p) { return p % 2 == 0 ? 1.0 : -1.0; });
}

// Both from the first terms of J_{λ+2p}(x) x^{−λ} in powers of x².
double GapBasis::mean(int p) const {
  return degree(p) == 0 ? std::pow(2.0, -lambda(p)) / std::tgamma(1 + lambda(p)) : 0;
}

double GapBasis::second_moment(int p) const {
  if (degree(p) == 0) return mean(p) / (2 * (1 + lambda(p)));
  return degree(p) == 1 ? -2 * std::pow(2.0, -lambda(p) - 2) / std::tgamma(lambda(p) + 3) : 0;
}

std::complex<double> GapBasis::cosine_amplitude(int p, double x) const {
  const double order = lambda(p) + 2 * degree(p);
  return std::sqrt(2 / (pi * x)) * std::pow(x, -lambda(p)) * hankel_amplitude(order, x) *
         std::polar(1.0, -(order / 2 + 0.25) * pi);
}

}  // namespace hydro::cylinders
