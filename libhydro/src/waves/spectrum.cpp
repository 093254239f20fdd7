#include "hydro/waves/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gauss_legendre.hpp"

// Everything below is in u = ω/ω_p, where the shape of (W6) is
//   u^-5 e^{−5/4 u^-4} γ^r,   r = e^{−(u−1)²/2σ²}
// split into the part of γ = 1, integrated in closed form, and the rest, which lives within 10σ of the peak.
namespace hydro::waves {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double sigma_below = 0.07, sigma_above = 0.09;
constexpr double reach = 10;  // in σ: beyond, r < 2e-22

double fully_developed(double u) {
  const double v = 1.25 / (u * u * u * u);
  return v > 745 ? 0.0 : std::exp(-v) / (u * u * u * u * u);  // e^-745 is the least double; avoids 0·∞ at u → 0
}

// γ^r − 1, without cancellation where r is small.
double enhancement(double u, double log_gamma) {
  const double x = (u - 1) / (u <= 1 ? sigma_below : sigma_above);
  return std::expm1(log_gamma * std::exp(-x * x / 2));
}

// ∫ u^-5 e^{−5/4 u^-4} du = ⅕ e^{−5/4 u^-4}, as a difference that keeps its digits in narrow bands.
double fully_developed_energy(double from, double to) {
  const double v_to = 1.25 / (to * to * to * to);
  if (v_to > 745) return 0;
  const double v_from = 1.25 / (from * from * from * from);
  return -0.2 * std::exp(-v_to) * std::expm1(v_to - v_from);
}

// ∫ u^n u^-5 e^{…} (γ^r − 1) du over a stretch that does not cross u = 1, where r has a kink in its second derivative.
double peak_on_one_side(int n, double from, double to, double sigma, double log_gamma) {
  static const GaussLegendre<16> rule;
  if (!(from < to)) return 0;
  const int panels = std::max(1, static_cast<int>(std::ceil((to - from) / sigma)));
  double sum = 0;
  for (int p = 0; p < panels; ++p)
    sum += rule.integrate([&](double u) { return std::pow(u, n) * fully_developed(u) * enhancement(u, log_gamma); },
                          from + (to - from) * p / panels, from + (to - from) * (p + 1) / panels);
  return sum;
}

double peak(int n, double from, double to, double log_gamma) {
  if (log_gamma == 0) return 0;
  const double lowest = std::max(from, 1 - reach * sigma_below), highest = std::min(to, 1 + reach * sigma_above);
  return peak_on_one_side(n, lowest, std::min(highest, 1.0), sigma_below, log_gamma) +
         peak_on_one_side(n, std::max(lowest, 1.0), highest, sigma_above, log_gamma);
}

}  // namespace

double Spectrum::hs() const { return 4 * std::sqrt(moment(0)); }
double Spectrum::tz() const { return 2 * std::numbers::pi * std::sqrt(moment(0) / moment(2)); }

Jonswap::Jonswap(double hs_m, double tp_s, double gamma)
    : hs_(hs_m), omega_p_(2 * std::numbers::pi / tp_s), gamma_(gamma) {
  require(std::isfinite(hs_m) && hs_m > 0, "significant wave height must be finite and positive, got {} m", hs_m);
  require(std::isfinite(tp_s) && tp_s > 0, "peak period must be finite and positive, got {} s", tp_s);
  require(gamma >= 1 && gamma <= 20, "peak enhancement gamma of JONSWAP must be between 1 and 20, got {}", gamma);
  scale_ = hs_ * hs_ / 16 / (0.2 + peak(0, 0, infinity, std::log(gamma_)));
}

double Jonswap::tp() const noexcept { return 2 * std::numbers::pi / omega_p_; }

double Jonswap::density(double omega) const {
  require(std::isfinite(omega) && omega >= 0, "a one-sided spectrum needs a frequency >= 0, got {} rad/s", omega);
  const double u = omega / omega_p_;
  return scale_ / omega_p_ * fully_developed(u) * (1 + enhancement(u, std::log(gamma_)));
}

double Jonswap::energy(double from, double to) const {
  require(from >= 0 && from <= to, "a band needs 0 <= from <= to, got {} and {} rad/s", from, to);
  const double u_from = from / omega_p_, u_to = to / omega_p_;
  return scale_ * (fully_developed_energy(u_from, u_to) + peak(0, u_from, u_to, std::log(gamma_)));
}

double Jonswap::moment(int n) const {
  require(n <= 3, "moment m_{} of a spectrum with an omega^-5 tail is infinite; moments up to m_3 exist", n);
  const double of_fully_developed = 0.2 * std::pow(1.25, n / 4.0) * std::tgamma(1 - n / 4.0);  // (W7)
  return scale_ * std::pow(omega_p_, n) * (of_fully_developed + peak(n, 0, infinity, std::log(gamma_)));
}

}  // namespace hydro::waves
