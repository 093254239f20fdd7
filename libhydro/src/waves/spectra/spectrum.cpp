#include "hydro/waves/spectra/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "spectrum_shapes.hpp"

namespace hydro::waves {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

double Spectrum::moment(int n) const {
  require(n >= -1, "moments of a spectrum are taken for n >= -1, got {}", n);
  require(n < tail_power() - 1,
          "moment m_{} of a spectrum with an omega^-{} tail is infinite; moments below m_{} exist", n, tail_power(),
          std::ceil(tail_power() - 1));
  return band_moment(n, 0, infinity);
}

double Spectrum::hs() const { return 4 * std::sqrt(moment(0)); }
double Spectrum::tp() const { return 2 * std::numbers::pi / peak_omega(); }
double Spectrum::mean_period() const { return 2 * std::numbers::pi * moment(0) / moment(1); }
double Spectrum::tz() const { return 2 * std::numbers::pi * std::sqrt(moment(0) / moment(2)); }
double Spectrum::energy_period() const { return 2 * std::numbers::pi * moment(-1) / moment(0); }

double Spectrum::omega_at_energy(double energy, double from, double to) const {
  require(std::isfinite(to), "a finite band is needed to look for a frequency in it, got {} to {} rad/s", from, to);
  const double all = band_moment(0, from, to);
  require(energy >= 0 && energy <= all, "the band from {} to {} rad/s holds {} m^2, got {} m^2 to look for", from, to,
          all, energy);
  return increasing_root([&](double omega) { return band_moment(0, from, omega) - energy; },
                         [&](double omega) { return density(omega); }, from, to);
}

PeakedSpectrum::PeakedSpectrum(double hs_m, double tp_s, const PeakShape& shape)
    : PanelSpectrum(2 * std::numbers::pi / tp_s), shape_(shape) {
  require_sea(hs_m, tp_s);
  require_shape(shape);
  tabulate(peaked_edges(shape, unit()), Tail{.coefficient = 1, .p = shape.p, .w = shape.p / shape.q, .q = shape.q});
  set_variance(hs_m * hs_m / 16);
}

double PeakedSpectrum::shape(double u) const { return peaked_value(shape_, u); }

}  // namespace hydro::waves
