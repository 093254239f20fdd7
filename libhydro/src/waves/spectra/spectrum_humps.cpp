// Gaussian swell, and JONSWAP in water of finite depth.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectra.hpp"
#include "spectrum_shapes.hpp"

namespace hydro::waves {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

PeakShape jonswap_shape(double gamma) { return {.p = 5, .q = 4, .gamma = gamma}; }

// The highest point of peaked shape times depth factor, as a multiple of ω_p. The factor rises no faster than ω²: the
// peak lies between 1 and (5/3)^{1/4} = 1.136, where ω^2 times the shape with γ = 1 is highest (W35).
double tma_peak(const PeakShape& shape, double omega_p, const Water& water) {
  std::vector<double> candidates;
  for (int i = 0; i <= 150; ++i) candidates.push_back(1 + i * 0.001);
  return highest_frequency([&](double u) { return peaked_value(shape, u) * depth_factor(u * omega_p, water); },
                           candidates);
}

}  // namespace

// (W39)
GaussianSwell::GaussianSwell(double hs_m, double tp_s, double sigma_omega)
    : PanelSpectrum(two_pi / tp_s), width_(sigma_omega * tp_s / two_pi) {
  require_sea(hs_m, tp_s);
  require(sigma_omega > 0 && width_ <= 1.0 / 3,
          "the width sigma of a Gaussian swell must be positive and at most a third of its peak frequency of {} rad/s, "
          "got {} "
          "rad/s",
          unit(), sigma_omega);
  std::vector<double> edges{std::max(0.0, unit() - 8 * sigma_omega)};
  for (int i = -7; i <= 8; ++i)
    if (unit() + i * sigma_omega > edges.back()) edges.push_back(unit() + i * sigma_omega);
  tabulate(std::move(edges), {});
  set_variance(hs_m * hs_m / 16);
}

double GaussianSwell::shape(double u) const {
  const double x = (u - 1) / width_;
  return std::exp(-x * x / 2);
}

// (W35): 2kh/sinh 2kh without overflow, and without losing it where kh is small.
double depth_factor(double omega, const Water& water) {
  if (water.depth.is_infinite()) return 1;
  const double kh = wavenumber(omega, water) * water.depth.metres();
  const double ratio = kh > 300 ? 0.0 : 2 * kh / std::sinh(2 * kh);
  const double t = std::tanh(kh);
  return t * t / (1 + ratio);
}

Tma::Tma(double hs_m, double tp_s, double gamma, const Water& water)
    : PanelSpectrum(two_pi / tp_s), shape_(jonswap_shape(gamma)), water_(water) {
  require_sea(hs_m, tp_s);
  require_shape(shape_);
  std::vector<double> edges = peaked_edges(shape_, unit());
  if (!water.depth.is_infinite()) {
    // The tail is JONSWAP's where the depth factor is one to rounding: kh = 22, 4kh e^{−2kh} < 1e-17.
    const double deep = std::sqrt(22 * water.gravity / water.depth.metres());
    while (edges.back() < deep) edges.push_back(edges.back() * 1.2);
  }
  tabulate(std::move(edges), Tail{.coefficient = 1, .p = 5, .w = 1.25, .q = 4});
  set_variance(hs_m * hs_m / 16);
  peak_omega_ = unit() * tma_peak(shape_, unit(), water_);
}

Tma Tma::with_peak(double hs_m, double tp_s, double gamma, const Water& water) {
  require_sea(hs_m, tp_s);
  require_shape(jonswap_shape(gamma));
  const double wanted = two_pi / tp_s;
  double low = wanted / 1.2, high = wanted;
  for (int step = 0; step < 40; ++step) {  // the peak itself is known to 1e-9 only
    const double middle = 0.5 * (low + high);
    (middle * tma_peak(jonswap_shape(gamma), middle, water) < wanted ? low : high) = middle;
  }
  return {hs_m, two_pi / (0.5 * (low + high)), gamma, water};
}

double Tma::shape(double u) const { return peaked_value(shape_, u) * depth_factor(u * unit(), water_); }

double Tma::jonswap_tp() const { return two_pi / unit(); }

double Tma::deep_water_hs() const {
  const PeakedSpectrum jonswap(4, jonswap_tp(), shape_);
  // Both densities at a place beyond the peak differ by the depth factor and by m_0 alone.
  const double omega = 2 * unit();
  return 4 * std::sqrt(density(omega) / depth_factor(omega, water_) / jonswap.density(omega));
}

}  // namespace hydro::waves
