// Spectra of two systems and more.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hydro/waves/spectra/spectra.hpp"
#include "spectrum_shapes.hpp"

namespace hydro::waves {
namespace {

// The sum is highest near the peak of a part, moved at most by the slope of the others: those peaks, and a grid of one
// per cent between and around them.
double peak_of_sum(const SumSpectrum& spectrum) {
  std::vector<double> candidates;
  for (const auto& part : spectrum.parts()) candidates.push_back(part->peak_omega());
  const auto [least, most] = std::minmax_element(candidates.begin(), candidates.end());
  const double low = 0.5 * *least, high = 2 * *most;
  for (double omega = low; omega < high; omega *= 1.01) candidates.push_back(omega);
  std::sort(candidates.begin(), candidates.end());
  return highest_frequency([&](double omega) { return spectrum.density(omega); }, candidates);
}

}  // namespace

SumSpectrum::SumSpectrum(std::vector<std::shared_ptr<const Spectrum>> parts) : parts_(std::move(parts)) {
  require(!parts_.empty(), "a sum of spectra needs at least one, got none");
  for (const auto& part : parts_) require(part != nullptr, "a sum of spectra was given a null one");
  peak_omega_ = peak_of_sum(*this);
}

double SumSpectrum::density(double omega) const {
  double total = 0;
  for (const auto& part : parts_) total += part->density(omega);
  return total;
}

double SumSpectrum::band_moment(int n, double from, double to) const {
  double total = 0;
  for (const auto& part : parts_) total += part->band_moment(n, from, to);
  return total;
}

double SumSpectrum::tail_power() const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) least = std::min(least, part->tail_power());
  return least;
}

// (W36): Γ(λ)-normalised ω^{−4λ−1} e^{−(λ+¼)(ω_p/ω)^4} is the peaked shape with p = 4λ + 1.
SumSpectrum ochi_hubble(const OchiHubblePart& swell, const OchiHubblePart& wind_sea) {
  const auto part = [](const OchiHubblePart& from) {
    require(from.lambda > 0.125 && from.lambda <= 14.75,
            "shape lambda of Ochi-Hubble must be above 0.125 and at most 14.75, got {}", from.lambda);
    return PeakedSpectrum(from.hs_m, from.tp_s, {.p = 4 * from.lambda + 1, .q = 4, .gamma = 1});
  };
  return sum(part(swell), part(wind_sea));
}

SumSpectrum ochi_hubble_most_probable(double hs_m) {
  require_sea(hs_m, 1);
  require(hs_m <= 30,
          "the Ochi-Hubble family was fitted to seas of the North Atlantic; Hs must be at most 30 m, got {} m", hs_m);
  const double two_pi = 6.283185307179586;
  const double share = 1 / std::hypot(0.84, 0.54);
  return ochi_hubble({.hs_m = 0.84 * share * hs_m, .tp_s = two_pi / (0.70 * std::exp(-0.046 * hs_m)), .lambda = 3.00},
                     {.hs_m = 0.54 * share * hs_m,
                      .tp_s = two_pi / (1.15 * std::exp(-0.039 * hs_m)),
                      .lambda = 1.54 * std::exp(-0.062 * hs_m)});
}

// (W38), with the letters of the paper's table: a_f = 6.6, a_e = 2, a_u = 25, a_10 = 0.7, a_1 = 0.5, k_g = 35, b_1 = 2,
// a_20 = 0.6, a_2 = 0.3, a_3 = 6.
TorsethaugenSystems torsethaugen_systems(double hs_m, double tp_s, double gravity) {
  require_sea(hs_m, tp_s);
  require(std::isfinite(gravity) && gravity > 0, "gravity must be finite and positive, got {} m/s^2", gravity);
  const double developed = 6.6 * std::cbrt(hs_m), shortest = 2 * std::sqrt(hs_m), longest = 25;
  require(tp_s >= shortest && tp_s <= longest && developed < longest,
          "Torsethaugen's relations hold for 2 sqrt(Hs) = {:.3f} s <= Tp <= 25 s and 6.6 Hs^(1/3) < 25 s, got Hs = {} "
          "m and "
          "Tp = {} s",
          shortest, hs_m, tp_s);
  const auto enhancement = [&](double hs, double tp) {
    return 35 * std::pow(6.283185307179586 / gravity * hs / (tp * tp), 6.0 / 7);
  };
  TorsethaugenSystems s{};
  s.fully_developed_tp_s = developed;
  s.primary_tp_s = tp_s;
  if (tp_s <= developed) {
    const double e = (developed - tp_s) / (developed - shortest);
    s.primary_hs = hs_m * (0.7 + 0.3 * std::exp(-std::pow(e / 0.5, 2)));
    s.relation_gamma = enhancement(s.primary_hs, tp_s);
    s.secondary_tp_s = developed + 2;
  } else {
    const double e = (tp_s - developed) / (longest - developed);
    s.primary_hs = hs_m * (0.6 + 0.4 * std::exp(-std::pow(e / 0.3, 2)));
    s.relation_gamma = enhancement(hs_m, developed) * (1 + 6 * e);
  }
  s.secondary_hs = std::sqrt(std::max(0.0, hs_m * hs_m - s.primary_hs * s.primary_hs));
  if (tp_s > developed) s.secondary_tp_s = 6.6 * std::cbrt(s.secondary_hs);
  s.gamma = std::max(1.0, s.relation_gamma);
  return s;
}

SumSpectrum torsethaugen(double hs_m, double tp_s, double gravity) {
  const TorsethaugenSystems s = torsethaugen_systems(hs_m, tp_s, gravity);
  const PeakedSpectrum primary(s.primary_hs, s.primary_tp_s, {.p = 4, .q = 4, .gamma = s.gamma});
  // On the border between wind sea and swell all energy is in one system.
  if (s.secondary_hs <= 1e-6 * hs_m) return sum(PeakedSpectrum(hs_m, tp_s, primary.peak_shape()));
  return sum(primary, PeakedSpectrum(s.secondary_hs, s.secondary_tp_s, {.p = 4, .q = 4, .gamma = 1}));
}

}  // namespace hydro::waves
