#include "hydro/waves/spectra/spectrum_tabulated.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/io/csv.hpp"

namespace hydro::waves {
namespace {

struct Fault {
  std::string rule;
  std::size_t row;
  bool in_density;
};

std::optional<Fault> fault_in(const std::vector<double>& omega, const std::vector<double>& density) {
  for (std::size_t i = 0; i < omega.size(); ++i) {
    if (!std::isfinite(omega[i]) || omega[i] < 0)
      return Fault{fmt::format("frequency {} of a spectrum must be finite and >= 0, got {} rad/s", i + 1, omega[i]), i,
                   false};
    if (i > 0 && omega[i] <= omega[i - 1])
      return Fault{fmt::format("frequencies of a spectrum must increase, got {} rad/s (point {}) after {} rad/s",
                               omega[i], i + 1, omega[i - 1]),
                   i, false};
    if (!std::isfinite(density[i]) || density[i] < 0)
      return Fault{fmt::format("density {} of a spectrum must be finite and >= 0, got {} m^2 s/rad", i + 1, density[i]),
                   i, true};
  }
  return {};
}

void require_table(const std::vector<double>& omega, const std::vector<double>& density) {
  require(omega.size() == density.size(), "a table of a spectrum needs a density for each frequency, got {} and {}",
          density.size(), omega.size());
  require(omega.size() >= 2, "a table of a spectrum needs two points at least, got {}", omega.size());
  if (const auto fault = fault_in(omega, density)) throw InputError(fault->rule);
  require(*std::max_element(density.begin(), density.end()) > 0, "a table of a spectrum needs a density above zero");
}

// (W40): a line times ω^n, n >= 0, is a polynomial, for which the quadrature is exact on any panel. For n = −1 it is
// not, but 1e-16 on panels whose ends are a factor two apart at most, and exact on one from ω = 0 where S = 0.
std::vector<double> panel_edges(const std::vector<double>& omega) {
  std::vector<double> edges{omega.front()};
  for (std::size_t i = 1; i < omega.size(); ++i) {
    while (edges.back() > 0 && omega[i] > 2 * edges.back()) edges.push_back(2 * edges.back());
    edges.push_back(omega[i]);
  }
  return edges;
}

}  // namespace

TabulatedSpectrum::TabulatedSpectrum(std::vector<double> omega, std::vector<double> density,
                                     std::optional<double> tail_power)
    : PanelSpectrum(omega.empty() ? 1 : omega.back()), omega_(std::move(omega)), density_(std::move(density)) {
  require_table(omega_, density_);
  std::optional<Tail> tail;
  if (tail_power) {
    require(*tail_power > 1 && std::isfinite(*tail_power),
            "a tail beyond a table of a spectrum needs a power above 1, or its energy is infinite; got {}",
            *tail_power);
    tail = Tail{.coefficient = density_.back() * unit(), .p = *tail_power, .w = 0, .q = 1};
  }
  const auto highest = std::max_element(density_.begin(), density_.end()) - density_.begin();
  peak_omega_ = omega_[static_cast<std::size_t>(highest)];
  tabulate(panel_edges(omega_), tail);
}

double TabulatedSpectrum::shape(double u) const {
  const double at = u * unit();
  const auto above = std::upper_bound(omega_.begin() + 1, omega_.end() - 1, at) - omega_.begin();
  const auto i = static_cast<std::size_t>(above);
  const double t = std::clamp((at - omega_[i - 1]) / (omega_[i] - omega_[i - 1]), 0.0, 1.0);  // rounding of u
  return unit() * (density_[i - 1] * (1 - t) + density_[i] * t);
}

TabulatedSpectrum TabulatedSpectrum::read(const std::filesystem::path& csv, std::optional<double> tail_power) {
  const auto table = io::CsvTable::read(csv);
  const std::string frequency = table.has("omega") ? "omega" : "frequency";
  const auto& omega = table.column(frequency, dim::angular_velocity);
  const auto& density = table.column("density", dim::area / dim::angular_velocity);
  if (const auto fault = fault_in(omega, density))
    throw InputError(fault->rule, table.place_of(fault->in_density ? "density" : frequency, fault->row));
  return {omega, density, tail_power};
}

TabulatedSpectrum TabulatedSpectrum::of_record(std::span<const double> elevation, double step_s,
                                               const signal::WelchOptions& options, const signal::Band& band) {
  require(band.from_hz >= 0 && band.from_hz < band.to_hz, "a band needs 0 <= from < to, got {} and {} Hz", band.from_hz,
          band.to_hz);
  const auto estimate = signal::welch(elevation, step_s, options);
  const auto all = signal::per_rad_s(estimate.spectrum);
  std::vector<double> omega, density;
  for (std::size_t i = 0; i < all.omega.size(); ++i) {
    const double f = estimate.spectrum.frequency_hz[i];
    if (f <= 0 || f < band.from_hz || f > band.to_hz) continue;
    omega.push_back(all.omega[i]);
    density.push_back(all.density[i]);
  }
  return {std::move(omega), std::move(density)};
}

}  // namespace hydro::waves
