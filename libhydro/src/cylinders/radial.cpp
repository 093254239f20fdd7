#include "radial.hpp"

#include <cmath>
#include <numbers>

#include "bessel.hpp"

namespace hydro::cylinders {

using Complex = std::complex<double>;

std::vector<double> wave_scales(double k, double radius, int orders) {
  std::vector<double> s(static_cast<std::size_t>(orders), 1.0);
  if (k <= 0) return s;
  std::vector<Complex> H(s.size());
  hankel_2_sequence(k * radius, H);
  for (std::size_t m = 0; m < s.size(); ++m) s[m] = std::abs(H[m]);
  return s;
}

RadialFunctions::RadialFunctions(const VerticalModes& modes, double radius, int orders, int channels) {
  const auto count = static_cast<std::size_t>(orders);
  wave_.assign(count, {0, 1, 0});
  if (modes.has_wave()) {
    std::vector<Complex> H(count + 1);
    const double x = modes.k * radius;
    hankel_2_sequence(x, H);
    for (std::size_t m = 0; m < count; ++m) {
      const Complex slope = static_cast<double>(m) / x * H[m] - H[m + 1];  // C_m′ = (m/x) C_m − C_{m+1}
      const double s = std::abs(H[m]);
      wave_[m] = {H[m] / (modes.k * slope), modes.k * slope / s, modes.k * slope.real() * s};
    }
  }
  ratio_.assign(modes.kappa.size(), std::vector<double>(count));
  for (std::size_t n = 0; n < modes.kappa.size(); ++n) {
    bessel_k_over_slope(modes.kappa[n] * radius, ratio_[n]);
    for (double& r : ratio_[n]) r /= modes.kappa[n];
  }
  for (int n = 1; n < channels; ++n) {
    // S′ = κ K_m I_m′ where K_m I_m′ − K_m′ I_m = 1/x, hence 1/S′ = a (1 − (I/I′)/(K/K′)).
    const double kappa = modes.kappa[static_cast<std::size_t>(n - 1)];
    std::vector<double> I(count);
    bessel_i_over_slope(kappa * radius, I);
    std::vector<double> slope(count);
    for (std::size_t m = 0; m < count; ++m)
      slope[m] = ratio_[static_cast<std::size_t>(n - 1)][m] /
                 (radius * (ratio_[static_cast<std::size_t>(n - 1)][m] - I[m] / kappa));
    slope_S_.push_back(slope);
  }
}

Complex RadialFunctions::slope_Q(int m, int n) const {
  return n == 0 ? wave_[static_cast<std::size_t>(m)].slope_Q : Complex(1 / ratio(m, n));
}

double RadialFunctions::slope_S(int m, int n) const {
  return n == 0 ? wave_[static_cast<std::size_t>(m)].slope_S
                : slope_S_[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(m)];
}

Complex RadialFunctions::wronskian(int n) const { return n == 0 ? Complex(0, -2 / std::numbers::pi) : Complex(-1); }

void to_amplitudes(AzimuthalOrder& o, int m, const RadialFunctions& radial, double radius) {
  const auto channels = static_cast<int>(o.T.cols());
  for (int n = 0; n < channels; ++n) {
    const Complex slope = radial.slope_Q(m, n), psi = radial.wronskian(n) / (radius * slope);
    o.T.col(n) *= psi;
    o.E.col(n) *= psi;
    o.T(n, n) -= radial.slope_S(m, n);
    o.R.row(n) /= slope;
  }
  for (int n = 0; n < channels; ++n) o.T.row(n) /= radial.slope_Q(m, n);
}

}  // namespace hydro::cylinders
